//! Against dense samples of points of the blade, turned by quaternions of another package.

use super::*;
use glam::DVec3;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::five_axis::{Arrangement, Direction, FiveAxis, Rotary, SpindleSense};
use vcutc_machine::kinematics::pose::Pose;

const RADIUS: f64 = 120.0;

fn machine(is_table: bool) -> Mechanism {
    let rotary = |about| Rotary {
        about,
        centre: DVec3::new(3.0, -4.0, 250.0),
    };
    let arrangement = if is_table {
        Arrangement::TableTable([rotary(Direction::MinusX), rotary(Direction::MinusZ)])
    } else {
        Arrangement::HeadHead([rotary(Direction::PlusZ), rotary(Direction::PlusX)])
    };
    let (nose, mount) = (DVec3::new(4.0, -2.0, 30.0), DVec3::new(480.0, 290.0, -10.0));
    Mechanism::FiveAxis(FiveAxis::new(arrangement, Some(SpindleSense::PlusZ), nose, mount).unwrap())
}

fn rig(mechanism: &Mechanism) -> Rig<'_> {
    Rig {
        mechanism,
        axes: &[],
        flange_in_blade: Pose {
            rotation: DMat3::from_rotation_z(1.2),
            position: DVec3::new(0.0, 0.0, 60.0),
        }
        .inverse(),
        work_in_root: Pose {
            rotation: DMat3::from_rotation_z(0.4),
            position: DVec3::new(40.0, 20.0, 15.0),
        },
    }
}

fn rotation(rig: &Rig<'_>, joints: &Joints) -> Rotation3<f64> {
    let matrix = rig.blade_in_work(joints).rotation.to_cols_array();
    Rotation3::from_matrix_unchecked(Matrix3::from_column_slice(&matrix))
}

fn turn<'t>(rig: &'t Rig<'t>, axes: [Joints; 2]) -> Turn<'t, 't> {
    let held = axes.map(|joints| {
        let q = UnitQuaternion::from_rotation_matrix(&rotation(rig, &joints));
        Orientation::from_quaternion(q.w, q.i, q.j, q.k).unwrap()
    });
    Turn {
        rig,
        held,
        axes,
        radius: RADIUS,
    }
}

/// How far points on a sphere about the tip are off, by slerp and by the axes.
fn sampled(rig: &Rig<'_>, [from, to]: [Joints; 2]) -> f64 {
    let quaternion = |joints: &Joints| UnitQuaternion::from_rotation_matrix(&rotation(rig, joints));
    let (start, end) = (quaternion(&from), quaternion(&to));
    let mut farthest = 0.0_f64;
    for step in 0..=400 {
        let place = f64::from(step) / 400.0;
        let joints = core::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * place);
        let (is, should) = (quaternion(&joints), start.slerp(&end, place));
        for direction in 0..200_u32 {
            // Points all over the sphere (a spiral of Fibonacci).
            let z = 1.0 - (2.0 * f64::from(direction) + 1.0) / 200.0;
            let (sin, cos) = libm::sincos(2.399_963 * f64::from(direction));
            let flat = (1.0 - z * z).sqrt();
            let point = Vector3::new(flat * cos, flat * sin, z) * RADIUS;
            farthest = farthest.max((is * point - should * point).norm());
        }
    }
    farthest
}

fn joints() -> impl Strategy<Value = [Joints; 2]> {
    let start = (-1.2..1.2_f64, 0.05..1.2_f64, -1.2..1.2_f64);
    // Some turns are small enough to stray by about as much as they may.
    let change = (prop::array::uniform3(-1.0..1.0_f64), -2.5..0.0_f64);
    (start, change).prop_map(|((a, b, c), (by, size))| {
        let by = by.map(|by| by * libm::pow(10.0, size));
        [
            [0.0, 0.0, 0.0, a, b, c],
            [0.0, 0.0, 0.0, a + by[0], b + by[1], c + by[2]],
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn what_is_proven_no_sample_leaves_and_what_is_refused_some_do(is_table in any::<bool>(), axes in joints()) {
        let mechanism = machine(is_table);
        let rig = rig(&mechanism);
        let most = sampled(&rig, axes);
        match turn(&rig, axes).strays() {
            None => prop_assert!(most <= LARGEST + 1e-9, "{most}"),
            // The points of the sphere are 14 deg apart.
            Some((_, by)) => {
                prop_assert!(most >= 0.97 * (LARGEST - FINE), "{most}");
                prop_assert!(most <= by * 1.001 && most >= 0.97 * by, "{most} {by}");
            }
        }
    }
}

#[test]
fn a_single_axis_turns_the_blade_as_the_program_does() {
    for (is_table, axis) in [
        (false, 3),
        (false, 4),
        (true, 3),
        (true, 4),
        (true, 5),
        (false, 5),
    ] {
        let mechanism = machine(is_table);
        let rig = rig(&mechanism);
        let start = [0.0, 0.0, 0.0, 0.3, 0.6, -0.4];
        let mut end = start;
        end[axis] += 1.4;
        assert_eq!(turn(&rig, [start, end]).strays(), None, "{is_table} {axis}");
        // The other way round it is not the shortest turn.
        end[axis] -= 2.0 * core::f64::consts::PI;
        let (_, by) = turn(&rig, [start, end]).strays().unwrap();
        assert!(by > RADIUS, "{by}");
    }
}
