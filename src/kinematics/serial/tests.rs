//! Serial arms and their Jacobians against chains of nalgebra, the closed form, and finite differences.

use super::SerialArm;
use crate::kinematics::jacobian::Twist;
use crate::kinematics::mounted::Mounted;
use crate::kinematics::pose::Pose;
use crate::kinematics::samples::{irb2400, kr210, pose, ur10e, ur10e_frames};
use crate::kinematics::{Joints, Mechanism};
use glam::{DMat3, DVec3, EulerRot};
use proptest::prelude::*;

fn mechanisms() -> [Mechanism; 4] {
    let mounted = Mounted {
        foot_in_root: Pose {
            rotation: DMat3::from_euler(EulerRot::ZYX, 0.3, -1.2, 2.0),
            position: DVec3::new(120.0, -40.0, 900.0),
        },
        arm: kr210(),
        flange_in_hand: Pose {
            rotation: DMat3::from_euler(EulerRot::ZYX, -0.4, 0.9, 1.0),
            position: DVec3::new(3.0, -5.0, 17.0),
        },
    };
    [
        Mechanism::OrthoParallel(kr210()),
        Mechanism::OrthoParallel(irb2400()),
        Mechanism::Mounted(mounted),
        Mechanism::Serial(ur10e()),
    ]
}

fn joints() -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-3.1..3.1)
}

fn point() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-600.0..600.0).prop_map(DVec3::from)
}

/// Half the difference of two poses on either side of one: of a point fixed to the flange, and the rotation between them.
fn difference(after: &Pose, before: &Pose, point: DVec3) -> Twist {
    let place = |pose: &Pose| pose.rotation * point + pose.position;
    let turned = after.rotation * before.rotation.transpose();
    // The skew part of a small rotation is its rotation vector.
    let skew = DVec3::new(
        turned.y_axis.z - turned.z_axis.y,
        turned.z_axis.x - turned.x_axis.z,
        turned.x_axis.y - turned.y_axis.x,
    );
    Twist {
        linear: (place(after) - place(before)) / 2.0,
        angular: skew / 4.0,
    }
}

proptest! {
    #[test]
    fn a_chain_of_denavit_hartenberg_frames_gives_the_same_pose(joints in joints()) {
        let (apart, turned) = ur10e().forward(&joints).apart(&pose(&ur10e_frames(&joints)[6]));
        prop_assert!(apart < 1e-9 && turned < 1e-12, "{apart} mm, {turned}");
    }

    #[test]
    fn closed_form_arms_stand_the_same_as_screws(joints in joints()) {
        let [kuka, abb, mounted, _] = mechanisms();
        for mechanism in [kuka, abb, mounted] {
            let arm = match &mechanism {
                Mechanism::OrthoParallel(arm) => SerialArm::from(arm),
                Mechanism::Mounted(arm) => SerialArm::from(arm),
                Mechanism::Serial(arm) => arm.clone(),
                Mechanism::FiveAxis(_) => unreachable!("these are arms"),
            };
            let (apart, turned) = arm.forward(&joints).apart(&mechanism.flange_in_root(&joints));
            prop_assert!(apart < 1e-9 && turned < 1e-12, "{apart} mm, {turned}");
        }
    }

    #[test]
    fn columns_are_central_differences(joints in joints(), point in point()) {
        const STEP: f64 = 1e-5;
        for mechanism in mechanisms() {
            let jacobian = mechanism.jacobian(&joints, point);
            for (axis, column) in jacobian.columns.iter().enumerate() {
                let at = |step: f64| {
                    let mut moved = joints;
                    moved[axis] += step;
                    mechanism.flange_in_root(&moved)
                };
                let seen = difference(&at(STEP), &at(-STEP), point);
                let (linear, angular) = (seen.linear / STEP, seen.angular / STEP);
                prop_assert!(linear.distance(column.linear) < 1e-4, "{axis}: {linear} {}", column.linear);
                prop_assert!(angular.distance(column.angular) < 1e-8, "{axis}: {angular} {}", column.angular);
            }
        }
    }

    #[test]
    fn rates_lead_the_point_along_the_twist(joints in joints(), point in point(), feed in point(), turning in point()) {
        let twist = Twist { linear: feed, angular: turning / 600.0 };
        for mechanism in mechanisms() {
            let jacobian = mechanism.jacobian(&joints, point);
            prop_assume!(jacobian.conditioning() > 1e-4);
            let rates = mechanism.joint_rates(&joints, point, &twist).expect("not singular");
            // Where the flange really is a moment before and after.
            const STEP: f64 = 1e-7;
            let at = |step: f64| {
                let moved: Joints = core::array::from_fn(|i| joints[i] + rates[i] * step);
                mechanism.flange_in_root(&moved)
            };
            let seen = difference(&at(STEP), &at(-STEP), point);
            prop_assert!((seen.linear / STEP).distance(twist.linear) < 1e-1 , "{} {}", seen.linear / STEP, twist.linear);
            prop_assert!((seen.angular / STEP).distance(twist.angular) < 1e-4);
        }
    }
}

#[test]
fn a_stretched_hand_has_no_rates() {
    // Axes 4 and 6 in line: only their sum is determined.
    let mechanism = Mechanism::OrthoParallel(kr210());
    let stretched = [0.1, -1.3, 1.2, 0.4, 0.0, -0.7];
    assert!(mechanism.jacobian(&stretched, DVec3::ZERO).conditioning() < 1e-12);
    let along = Twist {
        linear: DVec3::X,
        angular: DVec3::ZERO,
    };
    assert_eq!(mechanism.joint_rates(&stretched, DVec3::ZERO, &along), None);
    let bent = [0.1, -1.3, 1.2, 0.4, 0.5, -0.7];
    assert!(mechanism.joint_rates(&bent, DVec3::ZERO, &along).is_some());
}

#[test]
fn axis_1_alone_carries_the_flange_round() {
    // At 0, -90, 90, 0, 0, 0 the flange lies 350 + 1400 + 240 mm before axis 1, and A1 turns clockwise seen from above.
    let mechanism = Mechanism::OrthoParallel(kr210());
    let quarter = core::f64::consts::FRAC_PI_2;
    let jacobian = mechanism.jacobian(&[0.0, -quarter, quarter, 0.0, 0.0, 0.0], DVec3::ZERO);
    let [first, ..] = jacobian.columns;
    assert!(
        first.linear.distance(DVec3::new(0.0, -1990.0, 0.0)) < 1e-9,
        "{}",
        first.linear
    );
    assert!(first.angular.distance(-DVec3::Z) < 1e-12);
}

#[test]
fn missing_axes_rest_and_what_five_cannot_do_is_refused() {
    let mut jacobian = Mechanism::Serial(ur10e()).jacobian(&[0.3, -1.0, 1.2, 0.2, 1.1, 0.4], DVec3::ZERO);
    let last = jacobian.columns[5];
    jacobian.columns[5] = Twist::ZERO;
    let possible = jacobian.twist(&[0.1, 0.2, -0.3, 0.4, 0.5, 0.0]);
    let rates = jacobian.rates(&possible).expect("five axes do it");
    for (rate, wanted) in rates.iter().zip([0.1, 0.2, -0.3, 0.4, 0.5, 0.0]) {
        assert!((rate - wanted).abs() < 1e-10, "{rates:?}");
    }
    assert_eq!(jacobian.rates(&last), None);
}

#[test]
fn numbers_that_are_not_finite_give_nothing() {
    let mut jacobian = Mechanism::Serial(ur10e()).jacobian(&[0.3; 6], DVec3::ZERO);
    jacobian.columns[2].linear.y = f64::NAN;
    let along = Twist {
        linear: DVec3::X,
        angular: DVec3::ZERO,
    };
    assert_eq!(jacobian.rates(&along), None);
    assert_eq!(jacobian.conditioning(), 0.0);

    let mut axes = *ur10e().axes();
    let flange = *ur10e().flange_at_zero();
    axes[3].direction = DVec3::ZERO;
    assert_eq!(SerialArm::new(axes, flange), None);
    axes[3].direction = DVec3::new(0.0, f64::INFINITY, 0.0);
    assert_eq!(SerialArm::new(axes, flange), None);
}
