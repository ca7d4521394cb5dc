//! Recognition against arms of known lengths, in any mounting.

use super::{FIT, closed_form};
use crate::kinematics::mounted::Mounted;
use crate::kinematics::opw::{Coupling, Opw};
use crate::kinematics::pose::Pose;
use crate::kinematics::samples::{irb2400, kr210, ur10e};
use crate::kinematics::serial::SerialArm;
use crate::kinematics::{Joints, Mechanism};
use core::f64::consts::FRAC_PI_2;
use glam::{DMat3, DQuat, DVec3, EulerRot};
use proptest::prelude::*;

fn joints() -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-3.1..3.1)
}

fn any_pose() -> impl Strategy<Value = Pose> {
    (
        prop::array::uniform3(-3.0..3.0),
        prop::array::uniform3(-2000.0..2000.0),
    )
        .prop_map(|([z, y, x], position): ([f64; 3], [f64; 3])| Pose {
            rotation: DMat3::from_euler(EulerRot::ZYX, z, y, x),
            position: DVec3::from(position),
        })
}

/// Arms of any lengths, senses and zero positions.
fn any_arm() -> impl Strategy<Value = Opw> {
    let lengths = (
        -500.0..500.0,
        -300.0..300.0,
        -200.0..200.0,
        0.0..1000.0,
        200.0..1500.0,
        100.0..1500.0,
        0.0..400.0,
    );
    let signs = prop::array::uniform6(prop::bool::ANY.prop_map(|up| if up { 1.0 } else { -1.0 }));
    (lengths, joints(), signs).prop_map(|((a1, a2, b, c1, c2, c3, c4), offsets, signs)| Opw {
        a1,
        a2,
        b,
        c1,
        c2,
        c3,
        c4,
        offsets,
        signs,
        coupling: Coupling::Serial,
    })
}

fn assert_same_lengths(found: &Opw, wanted: &Opw) {
    let numbers = |arm: &Opw| {
        let lengths = [arm.a1, arm.a2, arm.b, arm.c1, arm.c2, arm.c3, arm.c4];
        let all: Vec<f64> = lengths.into_iter().chain(arm.offsets).chain(arm.signs).collect();
        all
    };
    for (found, wanted) in numbers(found).iter().zip(numbers(wanted)) {
        assert!((found - wanted).abs() < 1e-9, "{found} for {wanted}");
    }
}

proptest! {
    #[test]
    fn any_ortho_parallel_arm_is_recognised_in_any_mounting(
        arm in any_arm(), foot_in_root in any_pose(), flange_in_hand in any_pose(), joints in joints()
    ) {
        let arm = SerialArm::from(&Mounted { foot_in_root, arm, flange_in_hand });
        let found = closed_form(&arm).expect("it is one");
        let flange = arm.forward(&joints);
        let (apart, turned) = found.flange_in_root(&joints).apart(&flange);
        prop_assert!(apart < 1e-7 && turned < 1e-10, "{apart} mm, {turned}");
        // And its closed form leads back.
        let back = found.all(&flange);
        prop_assert!(back.iter().count() >= 1);
        for solution in back.iter() {
            prop_assert!(arm.forward(&solution.joints).apart(&flange).0 < 1e-5);
        }
    }

    #[test]
    fn what_is_bent_by_more_than_rounding_is_not_taken(axis in 1_usize..6, tilt in 0.002..0.3) {
        let arm = SerialArm::from(&kr210());
        let mut axes = *arm.axes();
        // Axes 2 and 3 towards axis 1, axes 4 and 6 out of the arm's plane, axis 5 towards axis 4. Axis 5 in the other
        // direction would be a hand that is rolled at zero.
        let about = if axis < 3 { DVec3::X } else { DVec3::Z };
        axes[axis].direction = DQuat::from_axis_angle(about, tilt) * axes[axis].direction;
        let bent = SerialArm::new(axes, *arm.flange_at_zero()).expect("an arm");
        prop_assert_eq!(closed_form(&bent), None);
    }

    #[test]
    fn a_wrist_whose_axes_miss_one_another_is_not_taken(miss in 0.2..50.0) {
        let arm = SerialArm::from(&kr210());
        let mut axes = *arm.axes();
        axes[5].point += DVec3::new(0.0, 0.0, miss);
        let offset = SerialArm::new(axes, *arm.flange_at_zero()).expect("an arm");
        prop_assert_eq!(closed_form(&offset), None);
    }
}

#[test]
fn arms_come_out_as_their_data_sheets_have_them() {
    let abb = Opw {
        coupling: Coupling::Serial,
        ..irb2400()
    };
    for wanted in [kr210(), abb] {
        let Some(Mechanism::OrthoParallel(found)) = closed_form(&SerialArm::from(&wanted)) else {
            panic!("{wanted:?} needs no mounting");
        };
        assert_same_lengths(&found, &wanted);
    }
}

#[test]
fn rounded_right_angles_are_right_angles() {
    let arm = SerialArm::from(&kr210());
    // A right angle to four decimals.
    let rounding = (FRAC_PI_2 * 1e4).round() / 1e4 - FRAC_PI_2;
    let mut axes = *arm.axes();
    for axis in &mut axes[1..4] {
        axis.direction = DQuat::from_rotation_x(rounding) * axis.direction;
    }
    let rounded = SerialArm::new(axes, *arm.flange_at_zero()).expect("an arm");
    let found = closed_form(&rounded).expect("near enough");
    for joints in [
        [0.4, -1.2, 1.4, -0.6, 1.1, 0.3],
        [1.4, -0.8, 0.9, 2.6, -1.1, -2.3],
    ] {
        let (apart, _) = found.flange_in_root(&joints).apart(&rounded.forward(&joints));
        assert!(apart > 1e-6, "the rounding is seen");
        assert!(apart <= FIT.0, "{apart} mm");
    }
}

#[test]
fn other_arms_have_no_closed_form() {
    assert_eq!(closed_form(&ur10e()), None);
    // A rod keeps the upper arm's inclination: the lines alone do not determine it.
    assert_eq!(closed_form(&SerialArm::from(&irb2400())), None);
}
