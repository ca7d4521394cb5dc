//! Ortho-parallel arms against the product formula, through round trips, in and near singular poses, and on nonsense.

use super::*;
use crate::kinematics::batch::{Answers, BranchAnswers, Poses};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use glam::{DMat3, DVec3};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// KUKA KR 210 R3100 ultra.
const KUKA: Opw = Opw {
    a1: 350.0,
    a2: 41.0,
    b: 0.0,
    c1: 675.0,
    c2: 1350.0,
    c3: 1400.0,
    c4: 240.0,
    offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
    signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
    coupling: Coupling::Serial,
};

/// ABB IRB 6660-205/1.9, whose J3 counts from a parallelogram.
const ABB: Opw = Opw {
    a1: 300.0,
    a2: -280.0,
    b: 0.0,
    c1: 814.5,
    c2: 700.0,
    c3: 893.0,
    c4: 200.0,
    offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
    signs: [1.0; 6],
    coupling: Coupling::Parallelogram,
};

fn arms() -> impl Strategy<Value = Opw> {
    let sign = || prop_oneof![Just(1.0), Just(-1.0)];
    (
        (0.0..500.0, -300.0..300.0, -150.0..150.0, 0.0..1000.0),
        (200.0..1500.0, 200.0..1500.0, 0.0..500.0),
        prop::array::uniform6(-3.0..3.0),
        prop::array::uniform6(sign()),
        any::<bool>(),
    )
        .prop_map(|((a1, a2, b, c1), (c2, c3, c4), offsets, signs, is_coupled)| {
            let [o1, o2, o3, o4, _, o6] = offsets;
            Opw {
                a1,
                a2,
                b,
                c1,
                c2,
                c3,
                c4,
                offsets: [o1, o2, o3, o4, 0.0, o6],
                signs,
                coupling: if is_coupled {
                    Coupling::Parallelogram
                } else {
                    Coupling::Serial
                },
            }
        })
}

fn joints() -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-PI..PI)
}

/// How far joints are apart, at most, whole turns aside.
fn apart(one: &Joints, other: &Joints) -> f64 {
    one.iter()
        .zip(other)
        .map(|(one, other)| ((one - other) - TAU * ((one - other) / TAU).round()).abs())
        .fold(0.0, f64::max)
}

/// That answers are exact, and each on its branch once.
fn assert_exact(arm: &Opw, pose: &Pose, solutions: &Solutions) {
    let branches: Vec<Branch> = solutions.iter().map(|solution| solution.branch).collect();
    assert!(branches.is_sorted_by_key(|branch| BRANCHES.iter().position(|one| one == branch)));
    for solution in solutions.iter() {
        let (apart, turned) = arm.forward(&solution.joints).apart(pose);
        assert!(
            apart < 1e-9 && turned < 1e-12,
            "{solution:?}: {apart} mm, {turned}"
        );
        assert!(solution.joints.iter().all(|joint| joint.abs() <= PI));
    }
}

proptest! {
    /// The formula of the module's documentation, by another library.
    #[test]
    fn the_flange_is_where_the_product_says(arm in arms(), joints in joints()) {
        let [j1, j2, j3, j4, j5, j6] = joints;
        let elbow = match arm.coupling {
            Coupling::Serial => j3,
            Coupling::Parallelogram => j3 - j2,
        };
        let mut q = [j1, j2, elbow, j4, j5, j6];
        for (axis, angle) in q.iter_mut().enumerate() {
            *angle = arm.signs[axis] * *angle - arm.offsets[axis];
        }
        let turned = |axis: Vector3<f64>, angle: f64| {
            Isometry3::from_parts(Translation3::identity(), UnitQuaternion::new(axis * angle))
        };
        let moved = |x, y, z| Isometry3::translation(x, y, z);
        let (y, z) = (Vector3::y(), Vector3::z());
        let product = moved(0.0, 0.0, arm.c1) * turned(z, q[0]) * moved(arm.a1, arm.b, 0.0) * turned(y, q[1])
            * moved(0.0, 0.0, arm.c2) * turned(y, q[2]) * moved(arm.a2, 0.0, arm.c3)
            * turned(z, q[3]) * turned(y, q[4]) * turned(z, q[5]) * moved(0.0, 0.0, arm.c4);
        let flange = arm.forward(&joints);
        for (column, axis) in [Vector3::x(), y, z].into_iter().enumerate() {
            let axis = product.rotation * axis;
            let ours = flange.rotation.col(column);
            prop_assert!(ours.abs_diff_eq(DVec3::new(axis.x, axis.y, axis.z), 1e-13));
        }
        let place = product.translation.vector;
        prop_assert!(flange.position.abs_diff_eq(DVec3::new(place.x, place.y, place.z), 1e-10));
    }

    #[test]
    fn joints_are_among_the_answers_to_their_pose(arm in arms(), joints in joints()) {
        let pose = arm.forward(&joints);
        let solutions = arm.inverse(&pose);
        assert_exact(&arm, &pose, &solutions);
        let nearest = solutions.iter().map(|solution| apart(&solution.joints, &joints)).fold(f64::MAX, f64::min);
        prop_assert!(nearest < 1e-6, "{nearest}");
    }

    #[test]
    fn answers_are_on_the_branch_that_they_name(arm in arms(), joints in joints()) {
        let pose = arm.forward(&joints);
        for solution in arm.inverse(&pose).iter() {
            let Branch::Arm { shoulder, elbow, wrist } = solution.branch else {
                panic!("an arm has no numbered branches");
            };
            let [j1, j2, j3, _, j5, _] = solution.joints;
            let q1 = arm.signs[0] * j1 - arm.offsets[0];
            let centre = pose.position - pose.rotation.z_axis * arm.c4;
            let x = libm::cos(q1) * centre.x + libm::sin(q1) * centre.y;
            let between = match arm.coupling {
                Coupling::Serial => j3,
                Coupling::Parallelogram => j3 - j2,
            };
            let psi = arm.signs[2] * between - arm.offsets[2] + libm::atan2(arm.a2, arm.c3);
            let (x, sine) = (x / 1000.0, libm::sin(psi));
            prop_assert!(x.abs() < 1e-9 || (shoulder == Shoulder::Front) == (x > 0.0));
            prop_assert!(sine.abs() < 1e-7 || (elbow == Elbow::Forward) == (sine > 0.0));
            prop_assert!(j5.abs() < 1e-9 || (wrist == Wrist::Positive) == (j5 > 0.0));
        }
    }

    /// Each way of asking gives the same bits, turns of axes aside.
    #[test]
    fn all_ways_of_asking_agree(arm in arms(), joints in prop::collection::vec(joints(), 1..20), turns in prop::array::uniform6(-2i8..=2)) {
        let poses: Vec<Pose> = joints.iter().map(|joints| arm.forward(joints)).collect();
        let mut batch = Poses::default();
        poses.iter().for_each(|pose| batch.push(pose));
        let (mut answers, mut on_branch) = (Answers::default(), BranchAnswers::default());
        arm.inverse_many(&batch, &mut answers);
        for (number, pose) in poses.iter().enumerate() {
            let solutions: Vec<Solution> = arm.inverse(pose).iter().copied().collect();
            let of_batch: Vec<Solution> = answers.of(number).collect();
            prop_assert_eq!(&solutions, &of_batch);
        }
        for (place, branch) in BRANCHES.into_iter().enumerate() {
            arm.on_branch_many(&batch, branch, &mut on_branch);
            for (number, pose) in poses.iter().enumerate() {
                let answer = answers.joints(number, place);
                prop_assert_eq!(on_branch.joints(number), answer);
                prop_assert_eq!(arm.on_branch(pose, branch, &[0.0; 6]), answer);
                let Some(answer) = answer else { continue };
                let near = core::array::from_fn(|axis| answer[axis] + TAU * f64::from(turns[axis]));
                let turned = arm.on_branch(pose, branch, &near);
                let is_near = turned.is_some_and(|turned| {
                    turned.iter().zip(near).all(|(turned, near)| (turned - near).abs() < 1e-9)
                });
                prop_assert!(is_near);
            }
        }
    }

    /// Hand stretched, arm stretched or folded, wrist centre over axis 1: each missed by ever less, and not at all.
    #[test]
    fn near_singular_poses_are_met_as_exactly(is_abb in any::<bool>(), joints in joints(), places in prop::array::uniform3(any::<bool>()), small in 0..18i32) {
        let arm = if is_abb { ABB } else { KUKA };
        let missed = if small == 17 { 0.0 } else { libm::pow(10.0, -f64::from(small)) };
        let mut joints = joints;
        let [is_hand, is_elbow, is_shoulder] = places;
        if is_hand {
            joints[4] = missed;
        }
        if is_elbow {
            joints[2] = missed - libm::atan2(arm.a2, arm.c3) + arm.offsets[2];
            if arm.coupling == Coupling::Parallelogram {
                joints[2] += joints[1];
            }
        }
        if is_shoulder {
            over_axis_1(&arm, &mut joints, missed);
        }
        let pose = arm.forward(&joints);
        let solutions = arm.inverse(&pose);
        assert_exact(&arm, &pose, &solutions);
        prop_assert!(solutions.iter().len() >= 2);
        // The branch that the joints are on is among them, and stays where axes are free.
        let near = solutions.iter().filter_map(|solution| arm.on_branch(&pose, solution.branch, &joints));
        for near in near {
            let (apart, turned) = arm.forward(&near).apart(&pose);
            prop_assert!(apart < 1e-9 && turned < 1e-12, "{} mm, {}", apart, turned);
        }
    }

    #[test]
    fn nonsense_has_no_answer_and_no_nan(numbers in prop::collection::vec(prop::num::f64::ANY, 12), near in prop::array::uniform6(prop::num::f64::ANY), is_abb in any::<bool>()) {
        let arm = if is_abb { ABB } else { KUKA };
        let columns: [f64; 9] = core::array::from_fn(|number| numbers[number]);
        let pose = Pose {
            rotation: DMat3::from_cols_array(&columns),
            position: DVec3::new(numbers[9], numbers[10], numbers[11]),
        };
        prop_assert_eq!(arm.inverse(&pose).iter().len(), 0);
        let home = arm.forward(&[0.3; 6]);
        for branch in BRANCHES {
            prop_assert_eq!(arm.on_branch(&pose, branch, &near), None);
            if let Some(joints) = arm.on_branch(&home, branch, &near) {
                let (apart, turned) = arm.forward(&joints).apart(&home);
                prop_assert!(apart <= 1e-6 && turned <= 1e-9, "{:?}", joints);
            }
        }
    }
}

/// Sets J3 so that the wrist centre is so far from axis 1, if the arm can.
fn over_axis_1(arm: &Opw, joints: &mut Joints, along: f64) {
    let q2 = arm.signs[1] * joints[1] - arm.offsets[1];
    let fore = libm::hypot(arm.a2, arm.c3);
    let sine = (along - arm.a1 - arm.c2 * libm::sin(q2)) / fore;
    if sine.abs() < 1.0 {
        let q3 = libm::asin(sine) - q2 - libm::atan2(arm.a2, arm.c3);
        joints[2] = arm.signs[2] * (q3 + arm.offsets[2]);
        if arm.coupling == Coupling::Parallelogram {
            joints[2] += joints[1];
        }
    }
}

#[test]
fn a_stretched_hand_keeps_axis_4() {
    let joints = [0.2, -1.2, 1.3, 2.5, 0.0, -0.7];
    let pose = KUKA.forward(&joints);
    for wrist in [Wrist::Positive, Wrist::Negative] {
        let branch = Branch::Arm {
            shoulder: Shoulder::Front,
            elbow: Elbow::Forward,
            wrist,
        };
        let kept = KUKA.on_branch(&pose, branch, &joints).unwrap();
        assert!(apart(&kept, &joints) < 1e-12, "{kept:?}");
        let solutions = KUKA.inverse(&pose);
        let listed = solutions.iter().find(|one| one.branch == branch).unwrap();
        assert!(listed.joints[3].abs() < 1e-12, "{listed:?}");
    }
}

#[test]
fn a_wrist_over_axis_1_keeps_axis_1() {
    let mut joints = [1.1, -0.3, 0.0, 0.4, 0.8, -0.7];
    joints[1] = KUKA.offsets[1] - 0.5;
    over_axis_1(&KUKA, &mut joints, 0.0);
    let pose = KUKA.forward(&joints);
    // Rounding may leave the wrist centre 1e-13 mm from the axis.
    let kept = BRANCHES
        .into_iter()
        .filter_map(|branch| KUKA.on_branch(&pose, branch, &joints))
        .any(|kept| apart(&kept, &joints) < 1e-9);
    assert!(kept, "{joints:?}");
}

#[test]
fn what_is_out_of_reach_has_no_answer() {
    let mut pose = KUKA.forward(&[0.0, -FRAC_PI_2, FRAC_PI_2, 0.0, 0.5, 0.0]);
    pose.position.x += 5000.0;
    assert_eq!(KUKA.inverse(&pose), Solutions::NONE);
    let turned_over = Branch::Numbered(0);
    assert_eq!(KUKA.on_branch(&pose, turned_over, &[0.0; 6]), None);
    // A reflection is not a rotation.
    let mut mirrored = KUKA.forward(&[0.3; 6]);
    mirrored.rotation.x_axis = -mirrored.rotation.x_axis;
    assert_eq!(KUKA.inverse(&mirrored), Solutions::NONE);
}

#[test]
fn arms_without_length_answer_nothing_worse_than_none() {
    let point = Opw {
        a1: 0.0,
        a2: 0.0,
        c1: 0.0,
        c2: 0.0,
        c3: 0.0,
        c4: 0.0,
        ..KUKA
    };
    for arm in [
        point,
        Opw { c2: 0.0, ..KUKA },
        Opw {
            a2: 0.0,
            c3: 0.0,
            ..KUKA
        },
        Opw { a1: f64::NAN, ..KUKA },
        Opw {
            offsets: [1e300; 6],
            ..KUKA
        },
    ] {
        for solution in arm.inverse(&KUKA.forward(&[0.3; 6])).iter() {
            assert!(solution.joints.iter().all(|joint| joint.is_finite()));
        }
    }
}

/// A rod keeps the forearm's inclination while only axis 2 moves.
#[test]
fn a_parallelogram_keeps_the_forearm_level() {
    let level = |j2: f64| ABB.forward(&[0.4, j2, 0.1, 0.3, -0.6, 1.2]).rotation;
    assert!(level(-0.4).abs_diff_eq(level(0.9), 1e-14));
}
