//! Arms without a closed form: against the closed form of arms that have one, and against sampling.

use super::*;
use crate::kinematics::mounted::Mounted;
use crate::kinematics::serial::SerialArm;

const ONLY: Branch = Branch::Numbered(0);

#[test]
fn both_methods_prove_the_same() {
    for model in [kuka(), beside(), rods()] {
        let arm = arm_of(&model);
        let mut general = model.clone();
        general.mechanism = Mechanism::Serial(SerialArm::from(&arm));
        let (closed_rig, general_rig) = (rig(&model), rig(&general));
        let mut dice = Dice(31);
        let least = Clearance {
            wrist: 0.2,
            elbow: 0.2,
            shoulder: 100.0,
        };
        let (mut both, mut closed_only) = (0, 0);
        for _ in 0..150 {
            let (course, branch, start) = random_move(&mut dice, &closed_rig, &model.axes, 200.0, 0.4);
            let closed = prove(&closed_rig, &course, branch, &start, &least);
            let general = prove(&general_rig, &course, ONLY, &start, &least);
            match (closed, general) {
                (Ok(closed), Ok(general)) => {
                    both += 1;
                    agree(&closed, &general);
                }
                (Ok(_), Err(_)) => closed_only += 1,
                // It knows nothing of clearances.
                (Err(breach), Ok(_)) => assert!(matches!(breach.what, Violation::Singular(_)), "{breach:?}"),
                (Err(one), Err(other)) => {
                    assert!(other.at < one.at + 1e-6, "{one:?} {other:?}");
                }
            }
        }
        assert!(both > 30 && closed_only == 0, "{both} and {closed_only}");
    }
}

/// Both proofs are of the same motion, so that their ranges overlap and the wider is not much wider.
fn agree(closed: &Proof, general: &Proof) {
    for i in 0..6 {
        assert!(
            (closed.end[i] - general.end[i]).abs() < 1e-8,
            "{closed:?} {general:?}"
        );
        assert!(
            (closed.low[i] - general.low[i]).abs() < 0.01,
            "{closed:?} {general:?}"
        );
        assert!(
            (closed.high[i] - general.high[i]).abs() < 0.01,
            "{closed:?} {general:?}"
        );
        let rate = (closed.rate[i] - general.rate[i]).abs();
        assert!(rate < 0.05 + 0.02 * closed.rate[i], "{closed:?} {general:?}");
    }
}

#[test]
fn a_mounting_changes_nothing_but_where_the_arm_stands() {
    let model = kuka();
    let mut dice = Dice(32);
    let mounting = |dice: &mut Dice| Pose {
        rotation: dice.rotation(3.0),
        position: dice.direction() * 500.0,
    };
    let (foot_in_root, flange_in_hand) = (mounting(&mut dice), mounting(&mut dice));
    let mut mounted = model.clone();
    mounted.mechanism = Mechanism::Mounted(Mounted {
        foot_in_root,
        arm: arm_of(&model),
        flange_in_hand,
    });
    let plain = rig(&model);
    // The same work and blade, seen from the other root and the other flange.
    let other = Rig {
        mechanism: &mounted.mechanism,
        work_in_root: foot_in_root * plain.work_in_root,
        flange_in_blade: plain.flange_in_blade * flange_in_hand,
        ..plain.clone()
    };
    let mut proven = 0;
    for _ in 0..100 {
        let (course, branch, start) = random_move(&mut dice, &plain, &model.axes, 200.0, 0.4);
        let one = prove(&plain, &course, branch, &start, &LEAST);
        let two = prove(&other, &course, branch, &start, &LEAST);
        if let (Ok(one), Ok(two)) = (one, two) {
            agree(&one, &two);
            proven += 1;
        } else {
            assert_eq!(one.is_ok(), two.is_ok());
        }
    }
    assert!(proven > 20, "{proven}");
}
