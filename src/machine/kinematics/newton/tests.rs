//! Newton against round trips and against the closed form.

use super::{follow, most_turn, refine, same, search};
use crate::kinematics::pose::Pose;
use crate::kinematics::samples::{irb2400, kr210, ur10e};
use crate::kinematics::serial::SerialArm;
use crate::kinematics::{Joints, Mechanism, Solution};
use core::f64::consts::{PI, TAU};
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

fn arms() -> [SerialArm; 3] {
    [SerialArm::from(&kr210()), SerialArm::from(&irb2400()), ur10e()]
}

fn joints() -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-3.1..3.1)
}

/// Turns of each joint up to `most` rad.
fn moved(most: f64) -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-most..most)
}

fn sum(a: &Joints, b: &Joints) -> Joints {
    core::array::from_fn(|i| a[i] + b[i])
}

fn conditioning(arm: &SerialArm, joints: &Joints) -> f64 {
    arm.jacobian(joints, DVec3::ZERO).conditioning()
}

proptest! {
    #[test]
    fn a_near_start_leads_back(joints in joints(), moved in moved(0.02)) {
        for arm in arms() {
            prop_assume!(conditioning(&arm, &joints) > 0.05);
            let found = refine(&arm, &arm.forward(&joints), &sum(&joints, &moved)).expect("near");
            prop_assert!(most_turn(&found, &joints) < 1e-9, "{found:?} {joints:?}");
        }
    }

    #[test]
    fn whatever_comes_out_brings_the_flange_there(joints in joints(), start in joints()) {
        for arm in arms() {
            let target = arm.forward(&joints);
            if let Some(found) = refine(&arm, &target, &start) {
                let (apart, turned) = arm.forward(&found).apart(&target);
                prop_assert!(apart < 1e-6 && turned < 1e-9);
            }
        }
    }

    #[test]
    fn a_short_way_is_followed(joints in joints(), moved in moved(0.05)) {
        for arm in arms() {
            prop_assume!(conditioning(&arm, &joints) > 0.05);
            let wanted = sum(&joints, &moved);
            let found = follow(&arm, &arm.forward(&wanted), &joints).expect("near");
            prop_assert!(most_turn(&found, &wanted) < 1e-9, "{found:?} {wanted:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The closed form says which branch the arm is on; the followed solution has to be the one on it.
    #[test]
    fn following_keeps_to_the_branch_of_the_closed_form(joints in joints(), moved in moved(0.5)) {
        let closed = kr210();
        let arm = SerialArm::from(&closed);
        let target = arm.forward(&sum(&joints, &moved));
        prop_assume!(conditioning(&arm, &joints) > 0.01);
        let begun = closed.inverse(&arm.forward(&joints));
        let begun = begun.iter().find(|begun| same(&begun.joints, &joints)).expect("it stands there");
        if let Some(found) = follow(&arm, &target, &joints) {
            let wanted = closed.on_branch(&target, begun.branch, &joints).expect("on the branch");
            prop_assert!(same(&found, &wanted), "{found:?} {wanted:?}");
            prop_assert!(most_turn(&found, &joints) <= PI + 1e-9);
        }
    }

    #[test]
    fn a_search_finds_what_the_closed_form_has(joints in joints()) {
        for closed in [kr210(), irb2400()] {
            let arm = SerialArm::from(&closed);
            let target = arm.forward(&joints);
            let found = search(&arm, &target);
            for wanted in closed.inverse(&target).iter() {
                prop_assume!(conditioning(&arm, &wanted.joints) > 1e-3);
                prop_assert!(
                    found.iter().any(|found| same(&found.joints, &wanted.joints)),
                    "{:?} is missing", wanted
                );
            }
            for found in found.iter() {
                prop_assert!(
                    closed.inverse(&target).iter().any(|wanted| same(&wanted.joints, &found.joints)),
                    "{:?} is none", found
                );
            }
        }
    }

    #[test]
    fn a_search_finds_the_joints_it_was_asked_from(joints in joints()) {
        let arm = ur10e();
        prop_assume!(conditioning(&arm, &joints) > 1e-3);
        let found = search(&arm, &arm.forward(&joints));
        prop_assert!(found.iter().any(|found| same(&found.joints, &joints)));
        // An arm of this kind always has its solutions in pairs.
        prop_assert_eq!(found.iter().count() % 2, 0);
    }
}

#[test]
fn solutions_are_numbered_by_their_angles_and_always_the_same() {
    let arm = ur10e();
    let target = arm.forward(&[0.4, -1.2, 1.4, -0.6, 1.1, 0.3]);
    let first: Vec<Solution> = search(&arm, &target).iter().copied().collect();
    let again: Vec<Solution> = search(&arm, &target).iter().copied().collect();
    assert_eq!(first, again);
    assert_eq!(first.len(), 8);
    for (number, solution) in (0..).zip(&first) {
        assert_eq!(solution.branch, Branch::Numbered(number));
        assert!(solution.joints.iter().all(|angle| angle.abs() <= PI));
    }
    let ordered = first
        .windows(2)
        .all(|pair| pair[0].joints[0] < pair[1].joints[0] + 1e-4);
    assert!(ordered, "{first:?}");
}

#[test]
fn following_counts_turns_from_the_start() {
    let arm = ur10e();
    let here = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3];
    let beyond = [0.4 + TAU, -1.2, 1.4, -0.6, 1.1, 0.3 - TAU];
    let target = arm.forward(&[0.5, -1.1, 1.3, -0.5, 1.2, 0.5]);
    let found = follow(&arm, &target, &here).expect("near");
    let found_beyond = follow(&arm, &target, &beyond).expect("near");
    assert!((found_beyond[0] - found[0] - TAU).abs() < 1e-9);
    assert!((found_beyond[5] - found[5] + TAU).abs() < 1e-9);
}

#[test]
fn half_turns_of_the_flange_are_found() {
    // The error is then turned by 180 degrees, where axis and angle are hardest to read from a matrix.
    let arm = ur10e();
    let here = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3];
    let turned = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3 + PI];
    let found = refine(&arm, &arm.forward(&turned), &here).expect("by axis 6 alone");
    assert!(arm.forward(&found).apart(&arm.forward(&turned)).0 < 1e-6);
}

#[test]
fn what_is_out_of_reach_or_not_a_number_has_no_answer() {
    let arm = ur10e();
    let mut far = arm.forward(&[0.4, -1.2, 1.4, -0.6, 1.1, 0.3]);
    far.position.x = 5000.0;
    assert_eq!(search(&arm, &far).iter().count(), 0);
    assert_eq!(follow(&arm, &far, &[0.3; 6]), None);

    let poses = [f64::NAN, f64::INFINITY, 1e300].map(|wild| Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(wild, 0.0, 0.0),
    });
    let skewed = Pose {
        rotation: DMat3::from_diagonal(DVec3::new(1.0, f64::NAN, 1.0)),
        position: DVec3::new(300.0, 0.0, 0.0),
    };
    for pose in poses.into_iter().chain([skewed]) {
        assert_eq!(search(&arm, &pose).iter().count(), 0);
        assert_eq!(follow(&arm, &pose, &[0.3; 6]), None);
    }
    assert_eq!(refine(&arm, &arm.forward(&[0.3; 6]), &[f64::NAN; 6]), None);
    assert_eq!(follow(&arm, &arm.forward(&[0.3; 6]), &[f64::INFINITY; 6]), None);
    // A mirrored pose is not the pose of a flange.
    let mirrored = Pose {
        rotation: DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0)),
        position: DVec3::new(700.0, 0.0, 200.0),
    };
    assert_eq!(search(&arm, &mirrored).iter().count(), 0);
}

#[test]
fn singular_ways_are_left_out() {
    // Axis 5 at zero: axes 4 and 6 of this arm are parallel then, and the elbow can trade with both.
    let arm = ur10e();
    let singular = [0.4, -1.2, 1.4, -0.6, 0.0, 0.3];
    for found in search(&arm, &arm.forward(&singular)).iter() {
        assert!(conditioning(&arm, &found.joints) > 1e-7);
    }
}

#[test]
fn a_mechanism_answers_by_number_only() {
    let arm = ur10e();
    let near = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3];
    let target = arm.forward(&near);
    let mechanism = Mechanism::Serial(arm);
    let named = Branch::Arm {
        shoulder: Shoulder::Front,
        elbow: Elbow::Forward,
        wrist: Wrist::Positive,
    };
    assert_eq!(mechanism.on_branch(&target, named, &near), None);
    assert!(mechanism.on_branch(&target, Branch::Numbered(0), &near).is_some());
}
