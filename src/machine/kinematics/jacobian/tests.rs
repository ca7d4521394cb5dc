//! Jacobians against finite differences, and rates against the motion that they give.

use super::{Twist, keeps_from_singular};
use crate::kinematics::five_axis::{Arrangement, Direction, FiveAxis, Rotary, SpindleSense};
use crate::kinematics::pose::Pose;
use crate::kinematics::samples::{irb2400, kr210, mounted, ur10e};
use crate::kinematics::{Joints, Mechanism};
use glam::DVec3;
use proptest::prelude::*;

/// Machines of every kind.
fn mechanisms() -> [Mechanism; 7] {
    let rotary = |about, x, y, z| Rotary {
        about,
        centre: DVec3::new(x, y, z),
    };
    let five_axis = |arrangement, spindle| {
        let (nose, mount) = (DVec3::new(4.0, -2.0, 30.0), DVec3::new(480.0, 290.0, -10.0));
        FiveAxis::new(arrangement, spindle, nose, mount).expect("a good machine")
    };
    let outer = rotary(Direction::PlusY, 3.0, -4.0, 250.0);
    let inner = rotary(Direction::MinusX, -6.0, 5.0, 210.0);
    [
        Mechanism::OrthoParallel(kr210()),
        Mechanism::OrthoParallel(irb2400()),
        Mechanism::Mounted(mounted()),
        Mechanism::Serial(ur10e()),
        Mechanism::FiveAxis(five_axis(Arrangement::HeadHead([outer, inner]), None)),
        Mechanism::FiveAxis(five_axis(
            Arrangement::HeadTable {
                head: inner,
                table: outer,
            },
            Some(SpindleSense::PlusZ),
        )),
        Mechanism::FiveAxis(five_axis(
            Arrangement::TableTable([inner, outer]),
            Some(SpindleSense::MinusZ),
        )),
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
    fn rates_are_found_again_from_their_twist(joints in joints(), point in point(), wanted in joints()) {
        for mechanism in mechanisms() {
            let jacobian = mechanism.jacobian(&joints, point);
            prop_assume!(jacobian.conditioning() > 1e-5);
            let twist = jacobian.twist(&wanted);
            let found = jacobian.rates(&twist).expect("not singular");
            for ((found, wanted), column) in found.iter().zip(wanted).zip(jacobian.columns) {
                let wanted = if column == Twist::ZERO { 0.0 } else { wanted };
                prop_assert!((found - wanted).abs() < 1e-7, "{found} for {wanted}");
            }
        }
    }
}

#[test]
fn a_stretched_hand_has_no_rates() {
    // Axes 4 and 6 in line: only their sum is determined.
    let mechanism = Mechanism::OrthoParallel(kr210());
    let stretched = [0.1, -1.3, 1.2, 0.4, 0.0, -0.7];
    let jacobian = mechanism.jacobian(&stretched, DVec3::ZERO);
    assert!(jacobian.conditioning() < 1e-12);
    let along = Twist {
        linear: DVec3::X,
        angular: DVec3::ZERO,
    };
    assert_eq!(jacobian.rates(&along), None);
    let bent = [0.1, -1.3, 1.2, 0.4, 0.5, -0.7];
    assert!(mechanism.jacobian(&bent, DVec3::ZERO).rates(&along).is_some());
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
}

#[test]
fn the_distance_from_singular_is_the_least_singular_value() {
    for joints in [[0.3, -1.0, 1.2, 0.2, 1.1, 0.4], [2.1, 0.4, -0.9, 1.7, -0.05, 2.9]] {
        let square = Mechanism::Serial(ur10e())
            .jacobian(&joints, DVec3::ZERO)
            .square(1000.0);
        let least = square.singular_values().min();
        assert!(keeps_from_singular(&square, 0.999 * least));
        assert!(!keeps_from_singular(&square, 1.001 * least));
        assert!(!keeps_from_singular(&square, f64::NAN));
    }
}
