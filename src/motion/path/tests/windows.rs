//! Moves that break a bound in a small window only, that come near singular poses, and how many solves a cut takes.

use super::*;

/// Axis values every 0.05 mm of a move.
fn trace(rig: &Rig<'_>, course: &Course, branch: Branch, start: &Joints) -> Option<Vec<Joints>> {
    let length = course.from.position.distance(course.to.position);
    let steps = (length / 0.05).ceil();
    let mut near = *start;
    (0..=steps as u32)
        .map(|k| {
            let blade = blade_at(course, f64::from(k) / steps);
            near = rig
                .mechanism
                .on_branch(&rig.flange_in_root(&blade), branch, &near)?;
            Some(near)
        })
        .collect()
}

/// The place of the largest number that is not within 1 mm of either end.
fn inner_peak(numbers: &[f64]) -> Option<usize> {
    let place = (0..numbers.len()).max_by(|a, b| numbers[*a].total_cmp(&numbers[*b]))?;
    (20 < place && place + 20 < numbers.len()).then_some(place)
}

#[test]
fn a_limit_that_is_passed_for_a_fifth_of_a_millimetre_is_found() {
    for model in [kuka(), beside(), rods()] {
        let (axes, mut model) = (model.axes.clone(), unbound(model));
        let mut dice = Dice(11);
        let mut found = 0;
        while found < 60 {
            let (course, branch, start) = random_move(&mut dice, &rig(&model), &axes, 150.0, 0.8);
            let open = model.clone();
            let Some(trace) = trace(&rig(&open), &course, branch, &start) else {
                continue;
            };
            for axis in 0..6 {
                let values: Vec<f64> = trace.iter().map(|joints| joints[axis]).collect();
                let Some(peak) = inner_peak(&values) else {
                    continue;
                };
                // Beyond the limit from 0.1 mm before the peak to 0.1 mm after it.
                let limit = values[peak - 2].max(values[peak + 2]);
                if values[peak] - limit < 1e-8 || prove(&rig(&open), &course, branch, &start, &LEAST).is_err()
                {
                    continue;
                }
                model.axes[axis].max = limit;
                let breach = prove(&rig(&model), &course, branch, &start, &LEAST).unwrap_err();
                assert!(
                    matches!(breach.what, Violation::Limit { axis: a, value } if a == axis && value > limit)
                );
                let window = (peak - 3) as f64..=(peak + 3) as f64;
                assert!(
                    window.contains(&(breach.at * (values.len() - 1) as f64)),
                    "{breach:?}, {peak}"
                );
                // Samples may miss the peak itself.
                model.axes[axis].max = values[peak] + 0.3 * (values[peak] - limit) + 1e-8;
                assert!(prove(&rig(&model), &course, branch, &start, &LEAST).is_ok());
                model.axes[axis].max = 100.0;
                found += 1;
            }
        }
    }
}

#[test]
fn a_rate_that_is_passed_for_a_fifth_of_a_millimetre_is_found() {
    for model in [kuka(), beside(), rods()] {
        let (axes, mut model) = (model.axes.clone(), unbound(model));
        let mut dice = Dice(12);
        let mut found = 0;
        while found < 60 {
            let (course, branch, start) = random_move(&mut dice, &rig(&model), &axes, 150.0, 0.8);
            let open = model.clone();
            let Some(trace) = trace(&rig(&open), &course, branch, &start) else {
                continue;
            };
            let step = course.duration / (trace.len() - 1) as f64;
            for axis in 0..6 {
                let rates: Vec<f64> = trace
                    .windows(2)
                    .map(|pair| (pair[1][axis] - pair[0][axis]).abs() / step)
                    .collect();
                let Some(peak) = inner_peak(&rates) else {
                    continue;
                };
                let limit = rates[peak - 2].max(rates[peak + 2]);
                if rates[peak] < limit * (1.0 + 1e-6)
                    || prove(&rig(&open), &course, branch, &start, &LEAST).is_err()
                {
                    continue;
                }
                model.axes[axis].rate = Some(limit);
                let breach = prove(&rig(&model), &course, branch, &start, &LEAST).unwrap_err();
                assert!(
                    matches!(breach.what, Violation::Rate { axis: a, rate } if a == axis && rate > limit)
                );
                model.axes[axis].rate = Some(rates[peak] * 1.001);
                assert!(prove(&rig(&model), &course, branch, &start, &LEAST).is_ok());
                model.axes[axis].rate = None;
                found += 1;
            }
        }
    }
}

/// A turn of the hand of 0.6 rad about the axis of joint 5, on which the hand is stretched in the middle but for an angle
/// to the side.
fn past_the_stretched_hand(rig: &Rig<'_>, arm: &Opw, aside: f64) -> (Course, Branch, Joints) {
    let bent = |angle: f64| [0.0, -1.2, 1.4, 0.0, angle, 0.0];
    let stretched = arm.forward(&bent(0.0));
    let hand = stretched.rotation.z_axis;
    let centre = stretched.position - hand * arm.c4;
    let tilt = DMat3::from_quat(DQuat::from_axis_angle(hand.cross(DVec3::Y), aside));
    let at = |angle: f64| {
        let rotation = tilt * arm.forward(&bent(angle)).rotation;
        let flange = Pose {
            rotation,
            position: centre + rotation.z_axis * arm.c4,
        };
        rig.work_in_root.inverse() * flange * rig.flange_in_blade.inverse()
    };
    let course = Course {
        arc: None,
        from: at(-0.3),
        to: at(0.3),
        duration: 1.0,
    };
    let solutions = rig.mechanism.all(&rig.flange_in_root(&course.from));
    let near = |joints: &Joints| (joints[1] + 1.2).abs() + (joints[3] - PI).abs().min((joints[3] + PI).abs());
    let begin = solutions
        .iter()
        .min_by(|a, b| near(&a.joints).total_cmp(&near(&b.joints)));
    let begin = begin.unwrap();
    (course, begin.branch, begin.joints)
}

#[test]
fn the_hand_is_not_turned_through_its_stretched_position() {
    let model = unbound(kuka());
    let (rig, arm) = (rig(&model), arm_of(&model));
    let none = Clearance {
        wrist: 0.0,
        elbow: 0.0,
        shoulder: 0.0,
    };
    let (course, branch, start) = past_the_stretched_hand(&rig, &arm, 0.0);
    let breach = prove(&rig, &course, branch, &start, &none).unwrap_err();
    assert!((0.4..0.6).contains(&breach.at), "{breach:?}");
    assert!(
        matches!(breach.what, Violation::Singular(Singularity::Wrist(_))),
        "{breach:?}"
    );
}

#[test]
fn beside_its_stretched_position_the_rates_tell() {
    let mut model = unbound(kuka());
    for aside in [0.2, 0.05, 0.01] {
        model.axes[3].rate = None;
        let open = model.clone();
        let (rig, arm) = (rig(&open), arm_of(&open));
        let (course, branch, start) = past_the_stretched_hand(&rig, &arm, aside);
        let least = Clearance {
            wrist: 0.5 * aside,
            ..LEAST
        };
        let proof = prove(&rig, &course, branch, &start, &least).unwrap();
        assert!((0.9..1.1).contains(&(proof.clearance.wrist / aside)), "{proof:?}");
        // Axis 4 has to turn the hand's plane by nearly half a turn while the hand passes.
        let expected = 0.6 / libm::sin(aside);
        assert!((0.8..1.25).contains(&(proof.rate[3] / expected)), "{proof:?}");
        model.axes[3].rate = Some(0.95 * proof.rate[3]);
        let tight = Rig {
            axes: &model.axes,
            ..rig.clone()
        };
        let breach = prove(&tight, &course, branch, &start, &least).unwrap_err();
        assert!(
            matches!(breach.what, Violation::Rate { axis: 3, .. }),
            "{breach:?}"
        );
        let worst = worst(&tight, &course, branch, &start, &breach, Look::Close);
        assert!(
            matches!(worst.what, Violation::Rate { axis: 3, rate } if rate > 0.8 * expected),
            "{worst:?}"
        );
    }
}

#[test]
fn what_is_broken_at_the_start_is_reported_there() {
    let mut model = kuka();
    let open = model.clone();
    let (rig_of_all, mut dice) = (rig(&open), Dice(13));
    let (course, branch, start) = random_move(&mut dice, &rig_of_all, &open.axes, 100.0, 0.3);
    model.axes[0].max = start[0] - 0.1;
    let breach = prove(&rig(&model), &course, branch, &start, &LEAST).unwrap_err();
    let what = Violation::Limit {
        axis: 0,
        value: start[0],
    };
    assert_eq!(breach, Breach { at: 0.0, what });
    // Another turn of axis 6 than the solution's is the caller's to choose; another value is not.
    let mut turned = start;
    turned[5] += 0.01;
    let breach = prove(&rig_of_all, &course, branch, &turned, &LEAST).unwrap_err();
    assert_eq!(
        breach,
        Breach {
            at: 0.0,
            what: Violation::OutOfReach
        }
    );
}

#[test]
fn courses_that_are_no_courses_are_refused() {
    let model = kuka();
    let rig = rig(&model);
    let (course, branch, start) = random_move(&mut Dice(14), &rig, &model.axes, 100.0, 0.3);
    let mut nowhere = course;
    nowhere.to.position.x = f64::NAN;
    let mut far = course;
    far.to.position.x = 1e300;
    let mut sudden = course;
    sudden.duration = 0.0;
    for broken in [nowhere, far, sudden] {
        let breach = prove(&rig, &broken, branch, &start, &LEAST).unwrap_err();
        assert_eq!(
            breach,
            Breach {
                at: 0.0,
                what: Violation::OutOfReach
            }
        );
    }
    let still = Course {
        to: course.from,
        ..course
    };
    let proof = prove(
        &rig,
        &still,
        branch,
        &start,
        &Clearance {
            wrist: 0.0,
            elbow: 0.0,
            shoulder: 0.0,
        },
    )
    .unwrap();
    assert!(proof.rate.iter().all(|rate| *rate < 1e-9), "{proof:?}");
}

/// Cuts of 1 m before the robot, as V-cutting holds the blade (`docs/process.md`, "Frames and posture").
fn cuts_of_a_metre(model: &Model) -> Vec<(Rig<'_>, Course, Branch, Joints)> {
    let tool = Frame::from(Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(0.0, 0.0, 300.0),
    });
    let base = Frame::from(Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(1500.0, -500.0, 500.0),
    });
    let mut courses = Vec::new();
    for (swing, rake, sense) in [
        (0.5, 1.1, 1.0),
        (-0.5, 1.1, -1.0),
        (0.6, 0.8, 1.0),
        (-0.3, 1.4, 1.0),
    ] {
        for (x, z) in [(0.0, 0.0), (200.0, 100.0), (500.0, 300.0), (700.0, 50.0)] {
            let straight = DMat3::from_cols(DVec3::Y, DVec3::X, -DVec3::Z);
            let rotation = DMat3::from_rotation_y(swing)
                * DMat3::from_rotation_x(-sense * (FRAC_PI_2 - rake))
                * straight;
            let at = |y| Pose {
                rotation,
                position: DVec3::new(x, y, z),
            };
            let course = Course {
                arc: None,
                from: at(0.0),
                to: at(1000.0),
                duration: 1000.0 / 300.0,
            };
            let rig = Rig::new(model, tool, base);
            for solution in rig.mechanism.all(&rig.flange_in_root(&course.from)).iter() {
                courses.push((rig.clone(), course, solution.branch, solution.joints));
            }
        }
    }
    courses
}

#[test]
fn a_cut_of_a_metre_takes_few_solves() {
    let model = kuka();
    let mut proven = 0;
    for (rig, course, branch, start) in cuts_of_a_metre(&model) {
        if let Ok(proof) = prove(&rig, &course, branch, &start, &LEAST) {
            assert!(proof.solves <= 40, "{}", proof.solves);
            proven += 1;
        }
    }
    assert!(proven >= 16, "{proven}");
}
