//! Columns against the kinematics of whole arms, and against the paper's case.

use super::*;
use crate::arm::tests::parts_of_the_paper;
use glam::DMat3;
use proptest::prelude::*;
use vcutc_machine::kinematics::samples::{irb2400, kr210, mounted, ur10e};

fn mechanisms() -> [Mechanism; 4] {
    [
        Mechanism::OrthoParallel(kr210()),
        Mechanism::OrthoParallel(irb2400()),
        Mechanism::Mounted(mounted()),
        Mechanism::Serial(ur10e()),
    ]
}

/// The hand in the root.
fn hand(chain: &Chain, mechanism: &Mechanism, joints: &Joints) -> DMat3 {
    mechanism.flange_in_root(joints).rotation * chain.flange_at_zero.rotation.transpose()
}

proptest! {
    #[test]
    fn columns_are_those_of_the_jacobian(
        which in 0..4_usize,
        joints in prop::array::uniform6(-2.0..2.0_f64),
        place in prop::array::uniform3(-300.0..300.0_f64),
    ) {
        let mechanism = &mechanisms()[which];
        let chain = Chain::of(mechanism).unwrap();
        let in_flange = Pose { rotation: DMat3::IDENTITY, position: DVec3::from_array(place) };
        let point = chain.in_hand(in_flange).position.to_array();
        let columns = chain.columns(&chain.turns(&joints), point);
        let rotation = hand(&chain, mechanism, &joints);
        let jacobian = mechanism.jacobian(&joints, in_flange.position);
        for (column, twist) in columns.iter().zip(jacobian.columns) {
            for direction in [DVec3::X, DVec3::Y, DVec3::Z] {
                let seen = (rotation.transpose() * direction).to_array();
                let (way, turn) = (column.of(seen, [0.0; 3]), column.of([0.0; 3], seen));
                prop_assert!((way - twist.linear.dot(direction) / MILLIMETRES).abs() < 1e-9);
                prop_assert!((turn - twist.angular.dot(direction)).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn columns_along_a_part_hold_those_in_its_places(
        joints in prop::array::uniform6(-2.0..2.0_f64),
        slopes in prop::array::uniform6(-0.2..0.2_f64),
        place in -1.0..1.0_f64,
    ) {
        let chain = Chain::of(&Mechanism::OrthoParallel(kr210())).unwrap();
        let along = core::array::from_fn(|axis| Along::line(joints[axis], slopes[axis]));
        let point = [0.1, -0.2, 0.5];
        let all = chain.columns(&chain.turns_along(along), point);
        let there: Joints = core::array::from_fn(|axis| joints[axis] + slopes[axis] * place);
        let here = chain.columns(&chain.turns(&there), point);
        for (all, here) in all.iter().zip(&here) {
            let (force, moment) = ([0.3, -0.7, 0.2], [0.1, 0.2, -0.4]);
            let (bound, found) = (all.of(force, moment).value(), here.of(force, moment));
            prop_assert!(bound.low <= found && found <= bound.high, "{found} {bound:?}");
        }
    }
}

/// Half way along the path of [Ha 2019] the trihedron of the tool is parallel to the root, with the tip on axis 6.
const HALF_WAY: [f64; 6] = [-2.0399, -97.2454, 55.7688, -182.7218, 48.5554, 181.8023];

/// Its rates there, in deg/s.
const RATES: [f64; 6] = [-1.594806, 0.401185, -0.362349, -8.491348, 0.239121, 5.619002];

/// The columns so many seconds later, and the hand in the root.
fn half_way(later: f64) -> ([Column<f64>; JOINTS], DMat3) {
    let (mechanism, _) = parts_of_the_paper();
    let chain = Chain::of(&mechanism).unwrap();
    let joints: Joints = core::array::from_fn(|axis| (HALF_WAY[axis] + later * RATES[axis]).to_radians());
    let point = chain.in_hand(Pose::IDENTITY).position.to_array();
    let rotation = hand(&chain, &mechanism, &joints);
    (chain.columns(&chain.turns(&joints), point), rotation)
}

/// Equations 30 and 31, with the milling force of case 1 at an immersion of 100 deg. The trihedron turns by a twelfth of a rad a
/// second.
#[test]
fn the_force_of_the_paper_has_its_torques() {
    let later = 18.856_667 - 6.0 * core::f64::consts::PI;
    let (columns, rotation) = half_way(later);
    let force = DMat3::from_rotation_z(later / 12.0) * DVec3::new(-49.259738, 113.790469, 37.224250);
    let seen = (rotation.transpose() * force).to_array();
    let wanted = [168.6715, -49.2504, -15.4762, -31.8030, 15.4054, 0.0];
    for (column, wanted) in columns.iter().zip(wanted) {
        let found = column.of(seen, [0.0; 3]);
        assert!((found - wanted).abs() < 1e-3, "{found} {wanted}");
    }
}

/// With the stiffness of a KR 210, which is another arm.
#[test]
fn the_arm_of_the_paper_yields_as_computed_before() {
    let (columns, rotation) = half_way(0.0);
    let stiffness = [2.2072e6, 3.3767e6, 2.7757e6, 2.3502e6, 2.1575e6, 0.4671e6];
    let compliance = |one: DVec3, other: DVec3| {
        let torques = [one, other].map(|direction| {
            let seen = (rotation.transpose() * direction).to_array();
            columns.map(|column| column.of(seen, [0.0; 3]))
        });
        let each = (0..JOINTS).map(|axis| torques[0][axis] * torques[1][axis] / stiffness[axis]);
        1e6 * each.sum::<f64>()
    };
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    for (one, other, wanted) in [(x, x, 0.13626), (y, y, 1.05356), (z, z, 1.09100), (x, z, 0.25217)] {
        let found = compliance(one, other);
        assert!((found - wanted).abs() < 2e-3, "{found} {wanted}");
    }
}
