//! Arms without a closed form: against the closed form of arms that have one, and against sampling.

use super::*;
use vcutc_machine::kinematics::mounted::Mounted;
use vcutc_machine::kinematics::samples;
use vcutc_machine::kinematics::serial::SerialArm;

const ONLY: Branch = Branch::Numbered(0);

#[test]
fn both_methods_prove_the_same() {
    both_prove_the_same(random_move);
}

#[test]
fn both_methods_prove_the_same_on_arcs() {
    both_prove_the_same(random_arc);
}

fn both_prove_the_same(draw: Draw) {
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
        for _ in 0..30 {
            let (course, branch, start) = draw(&mut dice, &closed_rig, &model.axes, 100.0, 0.3);
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
                    let same = (one.at - other.at).abs() < 1e-4;
                    let before = matches!(one.what, Violation::Singular(_)) && one.at < other.at;
                    assert!(same || before, "{one:?} {other:?}");
                }
            }
        }
        assert!(both > 5 && closed_only == 0, "{both} and {closed_only}");
    }
}

#[test]
fn an_arm_without_a_spherical_wrist_agrees_with_sampling() {
    agrees_with_sampling(random_move);
}

#[test]
fn an_arm_without_a_spherical_wrist_agrees_with_sampling_on_arcs() {
    agrees_with_sampling(random_arc);
}

fn agrees_with_sampling(draw: Draw) {
    let mut model = unbound(kuka());
    model.mechanism = Mechanism::Serial(samples::ur10e());
    for axis in &mut model.axes {
        axis.rate = Some(2.0);
    }
    let ranges = vec![
        Axis {
            min: -3.0,
            max: 3.0,
            ..model.axes[0].clone()
        };
        6
    ];
    let blade = Frame::from(Pose {
        rotation: DMat3::from_rotation_y(0.4),
        position: DVec3::new(20.0, 0.0, 150.0),
    });
    let rig = Rig::new(&model, blade, Frame::from(Pose::IDENTITY));
    let mut dice = Dice(33);
    let mut proven = 0;
    for number in 0..40 {
        let (mut course, _, start) = draw(&mut dice, &rig, &ranges, 60.0, 0.4);
        course.duration *= 3.0;
        let Ok(proof) = prove(&rig, &course, ONLY, &start, &LEAST) else {
            continue;
        };
        proven += 1;
        assert!(
            proof.rate.iter().all(|rate| *rate <= 2.0 * (1.0 + 1e-6)),
            "{number}"
        );
        let mut last = start;
        for k in 1..=300 {
            let flange = rig.flange_in_root(&blade_at(&course, f64::from(k) / 300.0));
            let joints = rig.mechanism.on_branch(&flange, ONLY, &last).unwrap();
            for i in 0..6 {
                assert!(
                    proof.low[i] <= joints[i] && joints[i] <= proof.high[i],
                    "{number}, axis {i}"
                );
                let rate = (joints[i] - last[i]).abs() * 300.0 / course.duration;
                assert!(rate <= proof.rate[i] + 1e-6, "{number}, axis {i}");
            }
            last = joints;
        }
        assert!((0..6).all(|i| (proof.end[i] - last[i]).abs() < 1e-8), "{number}");
    }
    assert!(proven >= 20, "{proven}");
}

/// Far from limits, proofs may be this much too wide, in rad.
const NEAR: f64 = 0.05;

/// Both proofs are of the same motion, so that their ranges overlap and the wider is not much wider.
fn agree(closed: &Proof, general: &Proof) {
    for i in 0..6 {
        assert!(
            (closed.end[i] - general.end[i]).abs() < 1e-8,
            "{closed:?} {general:?}"
        );
        assert!(
            (closed.low[i] - general.low[i]).abs() < NEAR,
            "{closed:?} {general:?}"
        );
        assert!(
            (closed.high[i] - general.high[i]).abs() < NEAR,
            "{closed:?} {general:?}"
        );
        let more = general.rate[i] - closed.rate[i];
        assert!(more.abs() < 0.05 + 0.1 * closed.rate[i], "{closed:?} {general:?}");
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
