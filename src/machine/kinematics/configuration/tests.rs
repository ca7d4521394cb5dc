//! Configurations of poses worked out by hand.

use super::*;
use crate::catalogue;
use crate::kinematics::Mechanism;
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::ir::AxisValues;
use vcutc_backend_api::status::kuka_status;

fn arm(name: &str) -> Opw {
    let mechanism = catalogue::find(name).unwrap().mechanism;
    *mechanism.ortho_parallel().expect("an arm")
}

fn kuka(joints_deg: [f64; 6]) -> (u8, u8) {
    let joints = joints_deg.map(f64::to_radians);
    let branch = branch_of(&arm("kuka/kr210_r3100_ultra"), &joints);
    (kuka_status(branch).unwrap(), kuka_turn(&joints))
}

fn abb(name: &str, joints_deg: [f64; 6]) -> [i32; 4] {
    let joints = joints_deg.map(f64::to_radians);
    let arm = arm(name);
    confdata(branch_of(&arm, &joints), &AxisValues(joints)).unwrap()
}

#[test]
fn status_and_turn_of_a_kuka() {
    // Home: forearm forward, only A2 negative.
    assert_eq!(kuka([0.0, -90.0, 90.0, 0.0, 0.0, 0.0]), (0b010, 0b00_0010));
    // The hand bent up, and axes 4 and 6 turned.
    assert_eq!(kuka([0.0, -90.0, 90.0, 0.0, -45.0, 0.0]), (0b110, 0b01_0010));
    assert_eq!(kuka([-10.0, -90.0, 90.0, -30.0, 45.0, 200.0]), (0b010, 0b00_1011));
    // Leaning back until the wrist is overhead: x = 350 - 1350 sin 40 + ... < 0.
    assert_eq!(kuka([0.0, -130.0, 40.0, 0.0, 10.0, 0.0]), (0b011, 0b00_0010));
    // phi of the KR 210 R3100 ultra is -1.68 deg: the bit changes there.
    assert_eq!(kuka([0.0, -60.0, -1.6, 0.0, 10.0, 0.0]).0, 0b010);
    assert_eq!(kuka([0.0, -60.0, -1.7, 0.0, 10.0, 0.0]).0, 0b000);
}

#[test]
fn what_is_negative_by_rounding_only_is_zero() {
    assert_eq!(
        kuka([-1e-12, -90.0, 90.0, -1e-12, -1e-12, -0.0]),
        (0b010, 0b00_0010)
    );
}

#[test]
fn confdata_of_an_abb() {
    let name = "abb/irb6700_200_260";
    // Zero pose: upper arm up, forearm forward, axis 5 at 0.
    assert_eq!(abb(name, [0.0; 6]), [0, 0, 0, 0]);
    assert_eq!(abb(name, [-1.0, 0.0, 0.0, 95.0, -30.0, -100.0]), [-1, 1, -2, 1]);
    assert_eq!(abb(name, [90.0, 0.0, 0.0, -90.0, 30.0, 179.0]), [1, -1, 1, 0]);
    // Forearm folded back over the upper arm: J3 beyond straight up.
    assert_eq!(abb(name, [0.0, 60.0, -100.0, 0.0, 30.0, 0.0])[3], 2);
    // The whole arm leaning back.
    assert_eq!(abb(name, [0.0, -60.0, -20.0, 0.0, 30.0, 0.0])[3], 4);
    assert_eq!(abb(name, [0.0, -50.0, -100.0, 0.0, -30.0, 0.0])[3], 7);
}

/// Every published pose: the branch found from axis values is the one on which the inverse finds them again.
#[test]
fn ways_are_those_of_the_inverse_kinematics() {
    let mut compared = 0;
    for name in catalogue::names() {
        let sheet = catalogue::sheet(name).unwrap();
        let Mechanism::OrthoParallel(arm) = sheet.mechanism else {
            continue;
        };
        for check in &sheet.facts.fk_checks {
            let joints = check.joints_deg.map(f64::to_radians);
            if borders(&arm, &joints).next().is_some() {
                continue;
            }
            let found = arm
                .on_branch(&arm.forward(&joints), branch_of(&arm, &joints), &joints)
                .unwrap();
            let apart = found
                .iter()
                .zip(&joints)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            assert!(apart < 1e-6, "{name}: {found:?} {joints:?}");
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

#[test]
fn borders_are_named() {
    let arm = arm("kuka/kr210_r3100_ultra");
    let on = |joints_deg: [f64; 6]| borders(&arm, &joints_deg.map(f64::to_radians)).collect::<Vec<_>>();
    assert_eq!(on([0.0, -90.0, 90.0, 0.0, 0.0, 0.0]), [Border::Wrist]);
    assert_eq!(on([0.0, -90.0, 90.0, 0.0, 30.0, 0.0]), []);
    let phi = -libm::atan2(arm.a2, arm.c3).to_degrees();
    assert_eq!(on([0.0, -60.0, phi, 0.0, 30.0, 0.0]), [Border::Elbow]);
    // Upper arm back by 15.03 deg: 350 - 1350 sin(15.03 deg) = 0, forearm and its offset upright above that.
    let lean = libm::asin((arm.a1 + arm.a2) / arm.c2).to_degrees();
    assert_eq!(on([0.0, -90.0 - lean, lean, 0.0, 30.0, 0.0]), [Border::Shoulder]);
}
