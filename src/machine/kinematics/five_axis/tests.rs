//! Tests of five-axis kinematics against chains of nalgebra isometries and a search over both rotary axes.

use super::*;
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

fn at(about: Direction, x: f64, y: f64, z: f64) -> Rotary {
    Rotary {
        about,
        centre: DVec3::new(x, y, z),
    }
}

/// The arrangements of the catalogue, with centres that all lie apart, so that no offset is without effect.
fn arrangements() -> [Arrangement; 7] {
    use Direction::{MinusX, PlusX, PlusY, PlusZ};
    [
        Arrangement::HeadHead([at(PlusY, 3.0, -4.0, 250.0), at(PlusX, -6.0, 5.0, 210.0)]),
        Arrangement::HeadHead([at(PlusZ, 2.0, 1.0, 400.0), at(PlusX, 7.0, -3.0, 240.0)]),
        Arrangement::HeadHead([at(PlusZ, 2.0, 1.0, 400.0), at(PlusY, 7.0, -3.0, 240.0)]),
        Arrangement::HeadTable {
            head: at(PlusX, 1.0, 2.0, 230.0),
            table: at(PlusY, 500.0, 300.0, -120.0),
        },
        Arrangement::TableTable([at(MinusX, 510.0, 310.0, -90.0), at(PlusY, 505.0, 295.0, -60.0)]),
        Arrangement::TableTable([at(PlusX, 510.0, 310.0, -90.0), at(PlusZ, 505.0, 295.0, -60.0)]),
        Arrangement::HeadTable {
            head: at(PlusY, 1.0, 2.0, 230.0),
            table: at(PlusZ, 500.0, 300.0, -120.0),
        },
    ]
}

const SPINDLES: [Option<SpindleSense>; 3] = [None, Some(SpindleSense::PlusZ), Some(SpindleSense::MinusZ)];
const MOUNT: DVec3 = DVec3::new(480.0, 290.0, -10.0);
const NOSE_AT: DVec3 = DVec3::new(4.0, -2.0, 30.0);

fn machine(arrangement: usize, spindle: usize) -> FiveAxis {
    FiveAxis::new(arrangements()[arrangement], SPINDLES[spindle], NOSE_AT, MOUNT).unwrap()
}

fn vector(v: DVec3) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

/// A turn about a line, by nalgebra.
fn about(rotary: Rotary, angle: f64) -> Isometry3<f64> {
    let axis = Unit::new_normalize(vector(rotary.about.vector()));
    Isometry3::rotation_wrt_point(
        UnitQuaternion::from_axis_angle(&axis, angle),
        Point3::from(vector(rotary.centre)),
    )
}

/// The nose in the mount, each body moved by the axes that carry it.
fn by_isometries(machine: &FiveAxis, joints: &Joints) -> Isometry3<f64> {
    let [x, y, z, first, second, spun] = *joints;
    let slide = Isometry3::translation(x, y, z);
    let (head, table) = match machine.arrangement {
        Arrangement::HeadHead([outer, inner]) => (
            slide * about(outer, first) * about(inner, second),
            Isometry3::identity(),
        ),
        Arrangement::HeadTable { head, table } => (slide * about(head, first), about(table, second)),
        Arrangement::TableTable([outer, inner]) => (slide, about(outer, first) * about(inner, second)),
    };
    let axis = match machine.spindle {
        None => Vector3::zeros(),
        Some(SpindleSense::PlusZ) => Vector3::z(),
        Some(SpindleSense::MinusZ) => -Vector3::z(),
    };
    let spindle = UnitQuaternion::from_scaled_axis(axis * spun);
    let half_turn = UnitQuaternion::from_scaled_axis(Vector3::x() * PI);
    let nose = Isometry3::from_parts(Translation3::from(vector(machine.nose)), spindle * half_turn);
    (table * Isometry3::from(Translation3::from(vector(machine.mount)))).inverse() * (head * nose)
}

fn apart(pose: &Pose, other: &Isometry3<f64>) -> f64 {
    let matrix = other.rotation.to_rotation_matrix();
    let columns = [pose.rotation.x_axis, pose.rotation.y_axis, pose.rotation.z_axis];
    let turned: f64 = (0..3)
        .map(|column| (vector(columns[column]) - matrix.matrix().column(column)).norm())
        .sum();
    (vector(pose.position) - other.translation.vector).norm() + 1000.0 * turned
}

fn joints() -> impl Strategy<Value = Joints> {
    let slide = -900.0..900.0_f64;
    let turn = -3.1..3.1_f64;
    (
        slide.clone(),
        slide.clone(),
        slide,
        turn.clone(),
        turn.clone(),
        turn,
    )
        .prop_map(|(x, y, z, first, second, spun)| [x, y, z, first, second, spun])
}

fn rotations() -> impl Strategy<Value = DMat3> {
    (-3.1..3.1_f64, -1.5..1.5_f64, -3.1..3.1_f64).prop_map(|(a, b, c)| {
        DMat3::from_rotation_z(a) * DMat3::from_rotation_y(b) * DMat3::from_rotation_x(c)
    })
}

/// Whether axis values are the same up to whole turns.
fn same(a: &Joints, b: &Joints) -> bool {
    a.iter().zip(b).enumerate().all(|(axis, (a, b))| {
        let difference = a - b;
        let turns = if axis < 3 { 0.0 } else { (difference / TAU).round() };
        (difference - TAU * turns).abs() < 1e-6
    })
}

/// The blade's postures (`docs/process.md`, "Frames and posture") with the blade frame a quarter turn about the nose's z, so
/// that the blade is in the middle of its range with all axes at zero.
fn posture(alpha: f64, lean: f64) -> DMat3 {
    let upright = DMat3::from_cols(DVec3::Y, DVec3::X, DVec3::NEG_Z);
    let blade_in_nose = DMat3::from_rotation_z(-FRAC_PI_2);
    DMat3::from_rotation_y(alpha) * DMat3::from_rotation_x(lean) * upright * blade_in_nose.transpose()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn the_nose_is_where_the_axes_carry_it(arrangement in 0..7_usize, spindle in 0..3_usize, joints in joints()) {
        let machine = machine(arrangement, spindle);
        prop_assert!(apart(&machine.forward(&joints), &by_isometries(&machine, &joints)) < 1e-9);
    }

    #[test]
    fn ways_lead_there_and_the_axis_values_are_among_them(
        arrangement in 0..7_usize, spindle in 0..3_usize, joints in joints(),
    ) {
        let machine = machine(arrangement, spindle);
        let joints = if spindle == 0 { [joints[0], joints[1], joints[2], joints[3], joints[4], 0.0] } else { joints };
        let pose = machine.forward(&joints);
        let ways = machine.inverse(&pose);
        prop_assert!(ways.iter().any(|way| same(&way.joints, &joints)), "{ways:?}");
        prop_assert_eq!(ways.iter().count(), if spindle == 0 { 1 } else { 2 });
        for way in ways.iter() {
            prop_assert!(apart(&pose, &by_isometries(&machine, &way.joints)) < 1e-8);
            let again = machine.on_branch(&pose, way.branch, &joints).unwrap();
            prop_assert!(again.iter().zip(&joints).skip(3).all(|(a, b)| (a - b).abs() <= PI + 1e-9));
        }
    }

    #[test]
    fn only_swing_then_rake_reaches_all_postures(alpha in 0.05..1.4_f64, lean in 0.05..1.2_f64, left: bool, back: bool) {
        let alpha = if left { -alpha } else { alpha };
        let lean = if back { -lean } else { lean };
        let pose = Pose { rotation: posture(alpha, lean), position: DVec3::ZERO };
        for arrangement in 0..7 {
            let bare = machine(arrangement, 0);
            prop_assert_eq!(bare.inverse(&pose).iter().count(), usize::from(bare.swings_then_rakes()));
            prop_assert_eq!(bare.blade_turned(&pose).is_none(), bare.swings_then_rakes());
            prop_assert_eq!(machine(arrangement, 1).inverse(&pose).iter().count(), 2);
        }
    }
}

proptest! {
    // Each case is a search of its own.
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_search_finds_no_other_ways(arrangement in 0..7_usize, rotation in rotations()) {
        let machine = machine(arrangement, 1);
        let pose = Pose { rotation, position: DVec3::new(10.0, 20.0, 30.0) };
        let ways: Vec<_> = machine.inverse(&pose).iter().map(|way| way.joints).collect();
        for (first, second) in search(&machine, rotation.z_axis) {
            let found = [0.0, 0.0, 0.0, first, second, 0.0];
            let known = ways.iter().any(|way| same(&[0.0, 0.0, 0.0, way[3], way[4], 0.0], &found));
            // Where the spindle points along the first axis that one is free; the search then finds any value.
            let tilting = machine.tilting();
            let off_k = rotation.z_axis.cross(tilting.k).length();
            prop_assert!(known || off_k < 0.05, "{found:?} of {ways:?}");
        }
    }

    #[test]
    fn what_is_left_to_the_blade_is_what_the_search_leaves(arrangement in 0..7_usize, rotation in rotations()) {
        let machine = machine(arrangement, 0);
        prop_assume!(rotation.z_axis.cross(machine.tilting().k).length() > 0.05);
        let pose = Pose { rotation, position: DVec3::ZERO };
        let left = search(&machine, rotation.z_axis)
            .into_iter()
            .map(|(first, second)| {
                let reached = machine.forward(&[0.0, 0.0, 0.0, first, second, 0.0]).rotation;
                libm::atan2(reached.x_axis.cross(rotation.x_axis).dot(rotation.z_axis), reached.x_axis.dot(rotation.x_axis))
            })
            .min_by(|a, b| a.abs().total_cmp(&b.abs()))
            .unwrap();
        prop_assert!((machine.blade_turned(&pose).unwrap_or(0.0) - left).abs() < 1e-5);
        prop_assert_eq!(machine.inverse(&pose).iter().count() == 0, left.abs() > 1e-8);
    }
}

/// All pairs of rotary values that point the nose's z as wanted: a grid, and from each of its cells Newton's method with
/// finite differences.
fn search(machine: &FiveAxis, wanted: DVec3) -> Vec<(f64, f64)> {
    let direction = |(first, second): (f64, f64)| {
        let nose = by_isometries(machine, &[0.0, 0.0, 0.0, first, second, 0.0]);
        nose.rotation * Vector3::z()
    };
    let wanted = vector(wanted);
    let mut found: Vec<(f64, f64)> = Vec::new();
    for cell in 0..144 {
        let mut at = (
            f64::from(cell / 12) * PI / 6.0 - PI,
            f64::from(cell % 12) * PI / 6.0 - PI,
        );
        for _ in 0..12 {
            let here = direction(at);
            let h = 1e-6;
            let by_first = (direction((at.0 + h, at.1)) - direction((at.0 - h, at.1))) / (2.0 * h);
            let by_second = (direction((at.0, at.1 + h)) - direction((at.0, at.1 - h))) / (2.0 * h);
            let matrix = nalgebra::Matrix3x2::from_columns(&[by_first, by_second]);
            let Ok(inverse) = matrix.pseudo_inverse(1e-9) else {
                break;
            };
            let step = inverse * (wanted - here);
            at = (at.0 + step.x.clamp(-0.5, 0.5), at.1 + step.y.clamp(-0.5, 0.5));
        }
        if (direction(at) - wanted).norm() < 1e-9 {
            let fresh = found.iter().all(|old| {
                !same(
                    &[0.0, 0.0, 0.0, old.0, old.1, 0.0],
                    &[0.0, 0.0, 0.0, at.0, at.1, 0.0],
                )
            });
            if fresh {
                found.push(at);
            }
        }
    }
    found
}

#[test]
fn the_usual_way_is_the_one_with_small_angles() {
    for arrangement in 0..7 {
        let machine = machine(arrangement, 1);
        let pose = machine.forward(&[0.0, 0.0, 0.0, 0.2, 0.3, 0.0]);
        let usual = machine
            .on_branch(&pose, Branch::Numbered(0), &Joints::default())
            .unwrap();
        assert!(
            (usual[3] - 0.2).abs() < 1e-9 && (usual[4] - 0.3).abs() < 1e-9,
            "{usual:?}"
        );
    }
}

#[test]
fn where_the_first_axis_is_free_it_stays_where_it_is() {
    // Fork head: C carries A; the blade points down.
    let machine = machine(1, 1);
    let pose = machine.forward(&[1.0, 2.0, 3.0, 0.0, 0.0, 0.5]);
    let near = [0.0, 0.0, 0.0, 1.25, 0.0, 0.0];
    for number in [0, 1] {
        let joints = machine.on_branch(&pose, Branch::Numbered(number), &near).unwrap();
        assert_eq!(joints[3], 1.25);
        assert!(joints[4].abs() < 1e-9);
        // C and the spindle turn in the same sense there.
        assert!((joints[3] + joints[5] - 0.5).abs() < 1e-9, "{joints:?}");
    }
}

proptest! {
    /// Between close places of an even motion the blade turns no faster than said, and somewhere nearly as fast.
    #[test]
    fn the_fastest_turn_is_that_of_close_samples(
        arrangement in 0..7_usize,
        spindle in 0..3_usize,
        from in prop::array::uniform3(-PI..PI),
        to in prop::array::uniform3(-PI..PI),
    ) {
        let machine = machine(arrangement, spindle);
        let joints = |[a, b, c]: [f64; 3]| [0.0, 0.0, 0.0, a, b, if spindle == 0 { 0.0 } else { c }];
        let (from, to) = (joints(from), joints(to));
        const STEPS: u32 = 2000;
        let held = |step: u32| {
            let place = f64::from(step) / f64::from(STEPS);
            by_isometries(&machine, &core::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * place)).rotation
        };
        let rates = (0..STEPS).map(|step| held(step).angle_to(&held(step + 1)) * f64::from(STEPS));
        let sampled = rates.fold(0.0, f64::max);
        let said = machine.fastest_turn(&from, &to);
        // Between samples a rate that is highest at an end is a mean over their distance.
        prop_assert!(sampled <= said + 1e-4, "{said} {sampled}");
        prop_assert!(sampled >= said - 1e-2, "{said} {sampled}");
    }
}

#[test]
fn parallel_axes_and_an_axis_along_the_spindle_are_refused() {
    let pair = |outer, inner| Arrangement::HeadHead([at(outer, 0.0, 0.0, 0.0), at(inner, 0.0, 0.0, 0.0)]);
    let made = |arrangement| FiveAxis::new(arrangement, None, NOSE_AT, MOUNT);
    assert_eq!(
        made(pair(Direction::PlusX, Direction::MinusX)),
        Err(Unfit::Parallel)
    );
    assert_eq!(
        made(pair(Direction::PlusX, Direction::PlusZ)),
        Err(Unfit::AlongSpindle)
    );
    let trunnion =
        |outer, inner| Arrangement::TableTable([at(outer, 0.0, 0.0, 0.0), at(inner, 0.0, 0.0, 0.0)]);
    assert!(made(trunnion(Direction::PlusX, Direction::PlusZ)).is_ok());
    assert_eq!(
        made(trunnion(Direction::PlusZ, Direction::PlusX)),
        Err(Unfit::AlongSpindle)
    );
}

#[test]
fn what_is_not_a_number_has_no_way() {
    for spindle in 0..3 {
        let machine = machine(0, spindle);
        let good = machine.forward(&[1.0, 2.0, 3.0, 0.1, 0.2, 0.0]);
        let mut bad = good;
        bad.position.x = f64::NAN;
        assert_eq!(machine.inverse(&bad), Solutions::NONE);
        bad = good;
        bad.rotation.y_axis.z = f64::INFINITY;
        assert_eq!(machine.inverse(&bad), Solutions::NONE);
        bad.rotation = DMat3::ZERO;
        assert_eq!(machine.inverse(&bad), Solutions::NONE);
        for wild in [f64::NAN, f64::INFINITY, 1e300] {
            let joints = machine.on_branch(&good, Branch::Numbered(0), &[wild; 6]);
            assert!(joints.is_none_or(|joints| joints.iter().all(|joint| joint.is_finite())));
        }
        assert_eq!(machine.on_branch(&good, Branch::Numbered(2), &[0.0; 6]), None);
    }
}
