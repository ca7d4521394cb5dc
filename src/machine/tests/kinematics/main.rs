//! Inverse kinematics of the catalogue's robots: beside another author's, and on published poses.
//!
//! Built with `--release`, the comparison takes millions of poses, and the fingerprint shows that vector instructions give the
//! bits that unoptimised code does.
#![allow(
    clippy::disallowed_methods,
    clippy::unwrap_used,
    reason = "tests compute with what is at hand, and stop at the first surprise"
)]

mod peer;

use core::f64::consts::TAU;
use glam::{DMat3, DQuat, DVec3};
use peer::{FINGERPRINT, Random, Robot, compare, fingerprint};
use std::sync::atomic::{AtomicU64, Ordering};
use vcutc_machine::catalogue;
use vcutc_machine::kinematics::pose::Pose;

/// Random poses of each robot.
const POSES: usize = if cfg!(debug_assertions) { 1_000 } else { 100_000 };

#[test]
fn inverse_kinematics_agree_with_another_authors() {
    let robots = Robot::all();
    assert_eq!(robots.len(), 33);
    let next = AtomicU64::new(0);
    let work = || {
        while let (seed, Some(robot)) = {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            (seed, robots.get(seed as usize))
        } {
            let tally = compare(robot, POSES, &mut Random(seed));
            let name = robot.name;
            assert!(tally.answers > 4 * POSES, "{name}: {tally:?}");
            assert!(tally.apart < 1e-9 && tally.turned < 1e-12, "{name}: {tally:?}");
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(work);
        }
    });
}

#[test]
fn published_poses_lead_back_to_their_joints() {
    for robot in Robot::all() {
        let sheet = catalogue::sheet(robot.name).unwrap();
        for check in &sheet.facts.fk_checks {
            let joints = check.joints_deg.map(f64::to_radians);
            let Some([w, x, y, z]) = check.quaternion else {
                continue;
            };
            let published = Pose {
                rotation: DMat3::from_quat(DQuat::from_xyzw(x, y, z, w).normalize()),
                position: DVec3::from_array(check.xyz_mm),
            };
            // Poses are printed to so many digits that joints come back to a hundredth of a degree, those from a slightly
            // different geometry as far as that leads, over half a metre of arm. Where the hand is stretched, axes 4 and 6
            // come back together.
            let within = 0.01_f64.to_radians() + check.position_tolerance_mm / 500.0;
            let is_stretched = joints[4].abs() < 1e-3;
            let comes_back = robot.arm.inverse(&published).iter().any(|answer| {
                let apart = |axis: usize| {
                    let apart = answer.joints[axis] - joints[axis];
                    apart - TAU * (apart / TAU).round()
                };
                let hand = [apart(3), apart(5)];
                let hand = if is_stretched {
                    [0.0, (hand[0] + hand[1]) % TAU]
                } else {
                    hand
                };
                [apart(0), apart(1), apart(2), apart(4)]
                    .into_iter()
                    .chain(hand)
                    .all(|apart| apart.abs() < within)
            });
            assert!(comes_back, "{} {:?}", robot.name, check.joints_deg);
        }
    }
}

#[test]
fn answers_have_the_same_bits_however_they_are_compiled() {
    assert_eq!(fingerprint(), FINGERPRINT);
}
