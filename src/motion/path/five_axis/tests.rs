//! Tests of the five-axis path check against dense sampling, with linear axes found by solving for the tip.

use super::*;
use crate::path::{Through, prove_through};
use glam::{DMat3, DQuat};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use vcutc_backend_api::ir::AxisKind;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::five_axis::{Arrangement, Direction, SpindleSense};

fn at(about: Direction, x: f64, y: f64, z: f64) -> Rotary {
    Rotary {
        about,
        centre: DVec3::new(x, y, z),
    }
}

fn machine(arrangement: usize) -> FiveAxis {
    use Direction::{MinusX, PlusX, PlusY, PlusZ};
    let arrangement = match arrangement {
        0 => Arrangement::HeadHead([at(PlusY, 3.0, -4.0, 250.0), at(PlusX, -6.0, 5.0, 210.0)]),
        1 => Arrangement::HeadHead([at(PlusZ, 2.0, 1.0, 400.0), at(PlusX, 7.0, -3.0, 240.0)]),
        2 => Arrangement::HeadTable {
            head: at(PlusX, 1.0, 2.0, 230.0),
            table: at(PlusY, 500.0, 300.0, -120.0),
        },
        _ => Arrangement::TableTable([at(MinusX, 510.0, 310.0, -90.0), at(PlusZ, 505.0, 295.0, -60.0)]),
    };
    let (nose, mount) = (DVec3::new(4.0, -2.0, 30.0), DVec3::new(480.0, 290.0, -10.0));
    FiveAxis::new(arrangement, Some(SpindleSense::PlusZ), nose, mount).unwrap()
}

fn axes(reach: f64) -> Vec<Axis> {
    ["X", "Y", "Z", "B", "C", "S"]
        .into_iter()
        .enumerate()
        .map(|(place, name)| Axis {
            name: name.to_owned(),
            kind: if place < 3 {
                AxisKind::Linear
            } else {
                AxisKind::Rotary
            },
            min: -reach,
            max: reach,
            rate: None,
            acceleration: None,
            jerk: None,
        })
        .collect()
}

fn rig<'m>(mechanism: &'m Mechanism, axes: &'m [Axis]) -> Rig<'m> {
    Rig {
        mechanism,
        axes,
        flange_in_blade: Pose {
            rotation: DMat3::from_rotation_z(1.5),
            position: DVec3::new(12.0, -7.0, 180.0),
        }
        .inverse(),
        work_in_root: Pose {
            rotation: DMat3::from_rotation_z(0.4),
            position: DVec3::new(40.0, 20.0, 15.0),
        },
    }
}

/// X, Y and Z with which the tip is where it should be, from how it moves with each of them.
fn solved(rig: &Rig<'_>, rotary: [f64; 3], tip: DVec3) -> DVec3 {
    let tip_at = |x, y, z| {
        let [first, second, spun] = rotary;
        let position = rig.blade_in_work(&[x, y, z, first, second, spun]).position;
        Vector3::new(position.x, position.y, position.z)
    };
    let zero = tip_at(0.0, 0.0, 0.0);
    let columns = [
        tip_at(1.0, 0.0, 0.0),
        tip_at(0.0, 1.0, 0.0),
        tip_at(0.0, 0.0, 1.0),
    ];
    let matrix = Matrix3::from_columns(&columns.map(|column| column - zero));
    let xyz = matrix.try_inverse().unwrap() * (Vector3::new(tip.x, tip.y, tip.z) - zero);
    DVec3::new(xyz.x, xyz.y, xyz.z)
}

/// A course from and to what axis values give, in a second and a half.
fn course(rig: &Rig<'_>, start: &Joints, end: &Joints) -> Course {
    Course {
        arc: None,
        from: rig.blade_in_work(start),
        to: rig.blade_in_work(end),
        duration: 1.5,
    }
}

/// The same with its tip on an arc about a centre off its start, round a direction; its end is where the arc ends.
fn on_arc(mut course: Course, off: DVec3, about: DVec3, sweep: f64) -> Course {
    let from = course.from.position;
    // Square to the axis.
    let about = about.normalize();
    let centre = from + (off - about * about.dot(off));
    let at = |share: f64| centre + DQuat::from_axis_angle(about, share * sweep) * (from - centre);
    let points = [0.0, 0.45, 1.0].map(|share| at(share).to_array());
    course.arc = CircularArc::through(points);
    assert!(course.arc.is_some());
    course.to.position = at(1.0);
    course
}

fn tip_at(course: &Course, s: f64) -> DVec3 {
    match course.arc {
        None => course.from.position.lerp(course.to.position, s),
        Some(arc) => {
            let (centre, about) = (DVec3::from_array(arc.centre()), DVec3::from_array(arc.axis()));
            let turned = DQuat::from_axis_angle(about, s * arc.sweep().to_rad());
            centre + turned * (course.from.position - centre)
        }
    }
}

fn solved_at(rig: &Rig<'_>, course: &Course, proof: &Proof, s: f64) -> DVec3 {
    let rotary = [3, 4, 5].map(|axis| proof.start[axis] + s * (proof.end[axis] - proof.start[axis]));
    solved(rig, rotary, tip_at(course, s))
}

/// Parts of a course in which dense samples are taken.
const SAMPLES: u32 = 400;

fn parts(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(move |i| from + (to - from) * f64::from(i) / f64::from(SAMPLES))
}

/// How high a linear axis comes, and where: sampled twice, the second time around the highest of the first.
fn peak(rig: &Rig<'_>, course: &Course, proof: &Proof, axis: usize) -> (f64, f64) {
    let highest = |from: f64, to: f64| {
        parts(from.max(0.0), to.min(1.0))
            .map(|s| (s, solved_at(rig, course, proof, s)[axis]))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap()
    };
    let (about, _) = highest(0.0, 1.0);
    let step = 1.0 / f64::from(SAMPLES);
    highest(about - step, about + step)
}

fn joints() -> impl Strategy<Value = Joints> {
    let slide = -400.0..400.0_f64;
    (
        slide.clone(),
        slide.clone(),
        slide,
        -1.2..1.2_f64,
        0.05..1.2_f64,
        -1.2..1.2_f64,
    )
        .prop_map(|(x, y, z, first, second, spun)| [x, y, z, first, second, spun])
}

/// Arcs: the centre off the start, the axis, how far round; none for a line.
fn arcs() -> impl Strategy<Value = Option<(DVec3, DVec3, f64)>> {
    let vector = || prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array);
    let round = (vector(), vector(), 0.05..5.0_f64)
        .prop_filter("an axis and a radius", |(off, about, _)| {
            about.length() > 0.1 && off.cross(about.normalize()).length() > 0.05
        })
        .prop_map(|(off, about, sweep)| (off * 300.0, about, sweep));
    prop::option::weighted(0.7, round)
}

fn drawn(course: Course, round: Option<(DVec3, DVec3, f64)>) -> Course {
    round.map_or(course, |(off, about, sweep)| on_arc(course, off, about, sweep))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn what_is_proven_holds_for_dense_samples_and_is_not_much_more(
        arrangement in 0..4_usize, start in joints(), end in joints(), round in arcs(),
    ) {
        let machine = machine(arrangement);
        let (mechanism, axes) = (Mechanism::FiveAxis(machine), axes(1e5));
        let rig = rig(&mechanism, &axes);
        let course = drawn(course(&rig, &start, &end), round);
        let branch = Branch::Numbered(0);
        // Begin on the branch itself: the strategy's values may lie on the other one.
        let start = machine.on_branch(&rig.flange_in_root(&course.from), branch, &start).unwrap();
        let proof = prove(&machine, &rig, &course, branch, &start).unwrap();
        let samples: Vec<_> = parts(0.0, 1.0).map(|s| solved_at(&rig, &course, &proof, s)).collect();
        for axis in 0..3 {
            let values: Vec<f64> = samples.iter().map(|xyz| xyz[axis]).collect();
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let rate = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max) * f64::from(SAMPLES) / 1.5;
            // Between samples a value comes closer to its extreme than this: 2 m of way, of which an arc of 5 rad is most.
            prop_assert!(proof.low[axis] <= low + 1e-8 && proof.low[axis] >= low - 0.05);
            prop_assert!(proof.high[axis] >= high - 1e-8 && proof.high[axis] <= high + 0.05);
            // Mean rates of short pieces: never above the highest, and below it by how much it changes in half a piece.
            prop_assert!(proof.rate[axis] >= rate - 1e-5 && proof.rate[axis] <= rate * 1.01 + 5.0);
        }
        for (low, (from, to)) in proof.low.iter().zip(start.iter().zip(&proof.end)).skip(3) {
            prop_assert_eq!(*low, from.min(*to));
        }
        prop_assert!(rig.blade_in_work(&proof.end).apart(&course.to).0 < 1e-6);
    }

    #[test]
    fn no_violation_on_an_arc_is_missed_and_no_arc_that_keeps_its_bounds_is_refused(
        arrangement in 0..4_usize, start in joints(), end in joints(), round in arcs(),
        axis in 0..3_usize, share in 0.0..1.0_f64,
    ) {
        let machine = machine(arrangement);
        let mechanism = Mechanism::FiveAxis(machine);
        let mut axes = axes(1e5);
        let free = axes.clone();
        let course = drawn(course(&rig(&mechanism, &free), &start, &end), round);
        let branch = Branch::Numbered(0);
        let start = machine.on_branch(&rig(&mechanism, &free).flange_in_root(&course.from), branch, &start).unwrap();
        let proof = prove(&machine, &rig(&mechanism, &free), &course, branch, &start).unwrap();
        let (_, high) = peak(&rig(&mechanism, &free), &course, &proof, axis);
        // Sampled again around the highest: within a micrometre of the true one.
        axes[axis].max = high - 1e-3 - share;
        prop_assert!(prove(&machine, &rig(&mechanism, &axes), &course, branch, &start).is_err());
        axes[axis].max = high + 1e-3;
        prop_assert!(prove(&machine, &rig(&mechanism, &axes), &course, branch, &start).is_ok());
    }

    #[test]
    fn a_limit_that_only_a_peak_between_the_ends_crosses_is_found(
        arrangement in 0..4_usize, start in joints(), turn in 0.3..1.2_f64, axis in 0..3_usize,
    ) {
        // The tip stays where it is, and an axis comes to a peak on the way.
        let machine = machine(arrangement);
        let mechanism = Mechanism::FiveAxis(machine);
        let mut axes = axes(1e5);
        let free = axes.clone();
        let mut from = rig(&mechanism, &free).blade_in_work(&start);
        let branch = Branch::Numbered(0);
        let start = machine.on_branch(&rig(&mechanism, &free).flange_in_root(&from), branch, &start).unwrap();
        from = rig(&mechanism, &free).blade_in_work(&start);
        let mut end = start;
        end[3] += turn;
        let to = Pose { position: from.position, ..rig(&mechanism, &free).blade_in_work(&end) };
        let course = Course { arc: None, from, to, duration: 1.0 };
        let proof = prove(&machine, &rig(&mechanism, &free), &course, branch, &start).unwrap();
        let (place, high) = peak(&rig(&mechanism, &free), &course, &proof, axis);
        let ends = start[axis].max(proof.end[axis]);
        prop_assume!(high > ends + 1e-3);
        axes[axis].max = high - 1e-4;
        let breach = prove(&machine, &rig(&mechanism, &axes), &course, branch, &start).unwrap_err();
        prop_assert!(matches!(breach.what, Violation::Limit { axis: which, .. } if which == axis), "{breach:?}");
        // Above high - 1e-4 the axis is only near the peak.
        let there = solved_at(&rig(&mechanism, &free), &course, &proof, breach.at)[axis];
        prop_assert!(there > high - 2e-4, "{} {place}", breach.at);
        axes[axis].max = high + 1e-4;
        prop_assert!(prove(&machine, &rig(&mechanism, &axes), &course, branch, &start).is_ok());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_way_through_a_joint_leaves_the_bounds(
        arrangement in 0..4_usize, at in joints(), away in prop::array::uniform2(joints()), round in arcs(), blend in 0.05..3.0_f64,
        ways in prop::collection::vec(prop::array::uniform12(0.0..1.0_f64), 60),
    ) {
        let machine = machine(arrangement);
        let (mechanism, axes) = (Mechanism::FiveAxis(machine), axes(1e5));
        let rig = rig(&mechanism, &axes);
        let branch = Branch::Numbered(0);
        let on_branch = |joints: &Joints| {
            machine.on_branch(&rig.flange_in_root(&rig.blade_in_work(joints)), branch, joints).unwrap()
        };
        let at = on_branch(&at);
        // The arc is that of the second piece, which begins at the joint.
        let near = |joints: &Joints| on_branch(&core::array::from_fn(|axis| at[axis] + 0.3 * (joints[axis] - at[axis])));
        let start = near(&away[0]);
        let before = course(&rig, &start, &at);
        let after = drawn(course(&rig, &at, &near(&away[1])), round);
        let end = machine.on_branch(&rig.flange_in_root(&after.to), branch, &at).unwrap();
        let standing = Proof {
            start, end: at, low: at, high: at, rate: [0.0; 6], clearance: Clearance::UNLIMITED, solves: 0,
        };
        let through = Through { before: &before, after: &after, blend };
        let proof = prove_through(&rig, &through, branch, &standing, &Clearance::UNLIMITED).unwrap();
        let length = |course: &Course| course.arc.map_or_else(
            || course.from.position.distance(course.to.position),
            |arc| arc.length().to_mm(),
        );
        let shares = [&before, &after].map(|course| (blend / length(course)).min(1.0));
        let velocity = |course: &Course, s: f64| (tip_at(course, s + 1e-6) - tip_at(course, s)) / (1e-6 * 1.5);
        let mut most = (0.0_f64, 0.0_f64);
        for way in &ways {
            let places = [1.0 - shares[0] * way[0], shares[1] * way[1]];
            let on_piece = if way[2] < 0.5 { tip_at(&before, places[0]) } else { tip_at(&after, places[1]) };
            let off = DVec3::new(way[3] - 0.5, way[4] - 0.5, way[5] - 0.5).normalize_or(DVec3::X) * (blend * way[6]);
            // Each rotary axis somewhere between the values of both pieces in the zone.
            let rotary = [3, 4, 5].map(|axis| {
                let ends = [at[axis] + (start[axis] - at[axis]) * shares[0], at[axis], at[axis] + (end[axis] - at[axis]) * shares[1]];
                let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
                let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                low + (high - low) * way[4 + axis]
            });
            let xyz = solved(&rig, rotary, on_piece + off);
            let moving = (velocity(&before, places[0]) * way[10] + velocity(&after, places[1]) * (1.0 - way[10])) * way[11];
            let rates = [3, 4, 5].map(|axis| {
                (way[3] * (at[axis] - start[axis]) + (1.0 - way[3]) * (end[axis] - at[axis])) / 1.5
            });
            let step = 1e-5;
            let next = solved(&rig, core::array::from_fn(|i| rotary[i] + step * rates[i]), on_piece + off + moving * step);
            for axis in 0..3 {
                prop_assert!(proof.low[axis] <= xyz[axis] && xyz[axis] <= proof.high[axis], "{axis}");
                let rate = (next[axis] - xyz[axis]).abs() / step;
                prop_assert!(rate <= proof.rate[axis] + 0.05, "{axis}: {rate} {}", proof.rate[axis]);
                most = (most.0.max((xyz[axis] - at[axis]).abs()), most.1.max(rate));
            }
        }
        let wide = (0..3).map(|axis| proof.high[axis] - proof.low[axis]).fold(0.0, f64::max);
        prop_assert!(wide <= 24.0 * most.0 + 1e-6, "{wide} {}", most.0);
    }
}

#[test]
fn a_cut_needs_two_looks() {
    for arrangement in 0..4 {
        let machine = machine(arrangement);
        let (mechanism, mut axes) = (Mechanism::FiveAxis(machine), axes(1e5));
        axes[0].rate = Some(1000.0);
        axes[1].rate = Some(1000.0);
        let rig = rig(&mechanism, &axes);
        let start = [10.0, 20.0, 30.0, 0.3, 0.4, 0.2];
        let from = rig.blade_in_work(&start);
        let course = |duration| Course {
            arc: None,
            from,
            to: Pose {
                position: from.position + DVec3::new(0.0, 1000.0, 0.0),
                ..from
            },
            duration,
        };
        let branch = Branch::Numbered(0);
        let proof = prove(&machine, &rig, &course(5.0), branch, &start).unwrap();
        assert_eq!(proof.solves, 3);
        let speed: f64 = (0..3).map(|axis| proof.rate[axis] * proof.rate[axis]).sum();
        assert!((speed.sqrt() - 200.0).abs() < 1e-6);
        // Ten times as fast, the axis that goes farthest is too slow.
        let breach = prove(&machine, &rig, &course(0.5), branch, &start).unwrap_err();
        assert!(
            matches!(breach.what, Violation::Rate { axis: 0 | 1, .. }),
            "{breach:?}"
        );
    }
}

#[test]
fn ranges_and_rates_of_rotary_axes_are_kept() {
    let machine = machine(0);
    let (mechanism, mut axes) = (Mechanism::FiveAxis(machine), axes(1e5));
    axes[3].max = 0.5;
    axes[4].rate = Some(0.1);
    let rig = rig(&mechanism, &axes);
    let start = [0.0, 0.0, 0.0, 0.1, 0.1, 0.0];
    let far = course(&rig, &start, &[0.0, 0.0, 0.0, 0.6, 0.1, 0.0]);
    let breach = prove(&machine, &rig, &far, Branch::Numbered(0), &start).unwrap_err();
    assert!(matches!(breach.what, Violation::Limit { axis: 3, value } if (value - 0.6).abs() < 1e-9));
    let fast = course(&rig, &start, &[0.0, 0.0, 0.0, 0.1, 0.4, 0.0]);
    let breach = prove(&machine, &rig, &fast, Branch::Numbered(0), &start).unwrap_err();
    assert!(matches!(breach.what, Violation::Rate { axis: 4, rate } if (rate - 0.2).abs() < 1e-9));
}

#[test]
fn courses_that_are_none_are_out_of_reach() {
    let machine = machine(1);
    let (mechanism, axes) = (Mechanism::FiveAxis(machine), axes(1e5));
    let rig = rig(&mechanism, &axes);
    let start = [0.0, 0.0, 0.0, 0.1, 0.1, 0.0];
    let good = course(&rig, &start, &start);
    let mut nowhere = good;
    nowhere.to.position.x = f64::NAN;
    let timeless = Course {
        duration: 0.0,
        ..good
    };
    let endless = Course {
        duration: f64::NAN,
        ..good
    };
    let point = |x: f64, y: f64| (good.from.position + DVec3::new(x, y, 0.0)).to_array();
    let arc = CircularArc::through([point(0.0, 0.0), point(5.0, 5.0), point(10.0, 0.0)]);
    assert!(arc.is_some());
    // An arc that ends elsewhere.
    let round = Course { arc, ..good };
    assert!(prove(&machine, &rig, &good, Branch::Numbered(0), &start).is_ok());
    for course in [nowhere, timeless, endless, round] {
        let breach = prove(&machine, &rig, &course, Branch::Numbered(0), &start).unwrap_err();
        assert_eq!(breach.what, Violation::OutOfReach);
    }
    let elsewhere = [1.0, 0.0, 0.0, 0.1, 0.1, 0.0];
    let breach = prove(&machine, &rig, &good, Branch::Numbered(0), &elsewhere).unwrap_err();
    assert_eq!((breach.at, breach.what), (0.0, Violation::OutOfReach));
}
