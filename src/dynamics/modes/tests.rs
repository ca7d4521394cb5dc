//! Modes against published cases, against one spring by hand, and against the matrices of [Ha 2019].

use super::meeting::shares;
use super::*;
use crate::arm::tests::{bodies, parts_of_the_paper, states};
use crate::push::tests::{STIFFNESS, along_normals_in_a_v, joints_in_a_v};
use crate::springs::Spring;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use vcutc_geometry::number::Interval;
use vcutc_machine::body::{Body, MILLIMETRES};
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::linkage::Linkage;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::samples::{irb2400, kr210};

pub(crate) fn springs(stiffness: [f64; JOINTS]) -> Springs {
    Springs::of(stiffness.map(|stiffness| Spring {
        stated: 1.0 / stiffness,
        off: Interval::ZERO,
    }))
}

#[track_caller]
fn assert_frequencies(modes: &[Mode; JOINTS], wanted: &[f64], within: &[f64]) {
    for ((mode, wanted), within) in modes.iter().zip(wanted).zip(within) {
        let apart = (mode.frequency - wanted).abs();
        assert!(apart <= *within, "{wanted}: {modes:?}");
    }
}

#[test]
fn the_arm_of_the_paper_has_the_modes_of_another_program() {
    let (mechanism, bodies) = parts_of_the_paper();
    let arm = Arm::new(&mechanism, bodies, None, DVec3::Z).unwrap();
    let degrees = |angles: [f64; 6]| angles.map(f64::to_radians);
    let start = degrees([14.4786, -67.6482, 23.2665, -79.5438, 100.0712, 136.5421]);
    let within = [1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2];
    let modes = arm.modes(&start, &springs(STIFFNESS)).unwrap();
    assert_frequencies(&modes, &[9.130, 11.439, 27.315, 102.17, 107.74, 113.18], &within);
    // After 18.84 s, a hundredth of a second before the middle.
    let middle = [-2.0399, -97.2454, 55.7688, -182.7218, 48.5554, 181.8023];
    let rates = [-1.594806, 0.401185, -0.362349, -8.491348, 0.239121, 5.619002];
    let early = 18.84 - 6.0 * PI;
    let there = degrees(array::from_fn(|axis| middle[axis] + early * rates[axis]));
    let modes = arm.modes(&there, &springs(STIFFNESS)).unwrap();
    assert_frequencies(&modes, &[12.148, 12.867, 23.588, 100.26, 119.21, 152.51], &within);
}

/// `a`, `d`, the twist and the angle with all axes of the controller at zero; mass, centre and inertias (xx, yy, zz, xy, xz, yz) about it in the
/// frame of Denavit and Hartenberg.
type Row = ([f64; 4], f64, [f64; 3], [f64; 6]);

/// The links of a KR 210 with a spindle, as GBT-ADL/Interactive-Coupling-Simulation-for-Robotic-Milling (2023) has them.
#[rustfmt::skip]
const SPINDLE_ARM: [Row; JOINTS] = [
    ([0.350, 0.675, -FRAC_PI_2, 0.0], 259.85, [-0.36493, 0.22028, 0.00434], [8.8821, 13.7205, 16.2660, -0.4015, 1.0397, -0.3202]),
    ([1.150, 0.0, 0.0, 0.0], 334.71, [-0.71793, 0.02787, -0.23573], [6.1923, 55.8635, 55.1699, -1.6859, -6.1251, 0.2354]),
    ([0.041, 0.0, -FRAC_PI_2, FRAC_PI_2], 217.46, [-0.02558, 0.02189, -0.31108], [25.4402, 25.9246, 2.3116, -0.0781, 0.0171, 1.1022]),
    ([0.0, -1.2, FRAC_PI_2, 0.0], 12.17, [0.0, 0.12343, 0.00135], [0.1285, 0.0298, 0.1302, 0.0, 0.0, -0.0028]),
    ([0.0, 0.0, -FRAC_PI_2, 0.0], 29.53, [0.00005, -0.02400, -0.04670], [0.4021, 0.2383, 0.2879, -0.0001, -0.0001, -0.0463]),
    ([0.0, -0.42, PI, 0.0], 46.50, [0.13734, 0.0, -0.09334], [0.2591, 1.1944, 1.1005, 0.0, 0.0621, 0.0]),
];

/// A robot that holds a spindle, in both flanks of a V.
fn spindle_arm() -> (Arm, [Joints; 2]) {
    let (opw, joints) = joints_in_a_v();
    let mechanism = Mechanism::OrthoParallel(opw);
    let lines = Linkage::from(&mechanism).tool;
    let mut frame = Pose::IDENTITY;
    let bodies = array::from_fn(|place| {
        let ([a, d, twist, angle], mass, centre, [xx, yy, zz, xy, xz, yz]) = SPINDLE_ARM[place];
        let line = lines[place].line;
        assert!(line.direction.cross(frame.rotation.z_axis).length() < 1e-9);
        assert!((frame.position - line.point).cross(line.direction).length() < 1e-6);
        let turned = |rotation: DMat3, position: DVec3| Pose {
            rotation,
            position: position * MILLIMETRES,
        };
        frame = frame
            * turned(DMat3::from_rotation_z(angle), DVec3::Z * d)
            * turned(DMat3::from_rotation_x(twist), DVec3::X * a);
        let inertia = DMat3::from_cols(
            DVec3::new(xx, xy, xz),
            DVec3::new(xy, yy, yz),
            DVec3::new(xz, yz, zz),
        );
        Body {
            mass,
            centre: frame.position / MILLIMETRES + frame.rotation * DVec3::from_array(centre),
            inertia: frame.rotation * inertia * frame.rotation.transpose(),
        }
    });
    (Arm::new(&mechanism, bodies, None, DVec3::Z).unwrap(), joints)
}

#[test]
fn a_robot_that_mills_has_the_modes_of_another_program() {
    let (arm, [left, right]) = spindle_arm();
    let modes = arm.modes(&left, &springs(STIFFNESS)).unwrap();
    let within = [5e-3, 5e-3, 5e-3, 0.5, 0.5, 0.5];
    assert_frequencies(&modes, &[9.92, 11.78, 20.20, 84.0, 112.0, 202.0], &within);
    // In the right flank that program holds the spindle a little differently.
    let modes = arm.modes(&right, &springs(STIFFNESS)).unwrap();
    assert_frequencies(&modes, &[7.69, 10.29, 25.43], &[0.02; 3]);
}

/// How many times as far the blade swings across its flank as it yields to a steady push, where it goes through cells of 3.2 mm at these
/// speeds and each mode has 3 % of damping: values of another program.
#[test]
fn walls_move_a_blade_by_the_shares_of_its_modes() {
    let (arm, joints) = spindle_arm();
    let wanted = [
        (30.0, [2.0, 3.0]),
        (80.0, [0.9, 4.5]),
        (100.0, [0.35, 0.32]),
        (200.0, [0.01, 0.46]),
    ];
    for (flank, along_normal) in along_normals_in_a_v().into_iter().enumerate() {
        let modes = arm.modes(&joints[flank], &springs(STIFFNESS)).unwrap();
        let shares = shares(&modes, along_normal);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        for (speed, wanted) in wanted {
            let [mut in_step, mut out_of_step] = [0.0, 0.0];
            for (mode, share) in modes.iter().zip(shares) {
                let ratio = speed / 3.2 / mode.frequency;
                let (real, imaginary) = (1.0 - ratio * ratio, 2.0 * 0.03 * ratio);
                let square = real * real + imaginary * imaginary;
                in_step += share * real / square;
                out_of_step += share * imaginary / square;
            }
            let times = libm::hypot(in_step, out_of_step);
            // Half of the last digit; in the right flank that program holds the spindle a little differently.
            let within = [if wanted[flank] < 0.5 { 0.005 } else { 0.05 }, 0.1][flank];
            assert!(
                (times - wanted[flank]).abs() <= within,
                "{flank} {speed}: {times}"
            );
        }
    }
}

/// The mass matrix as [Ha 2019], equations 20 to 22, have it: from the Jacobians of the bodies.
fn by_jacobians(mechanism: &Mechanism, bodies: &[Body; JOINTS], joints: &Joints) -> [[f64; JOINTS]; JOINTS] {
    let mut moved = Pose::IDENTITY;
    let mut lines = Vec::new();
    let mut masses = [[0.0; JOINTS]; JOINTS];
    for (joint, body) in Linkage::from(mechanism).tool.iter().zip(bodies) {
        let point = moved.rotation * joint.line.point + moved.position;
        lines.push((joint.weights, moved.rotation * joint.line.direction, point));
        moved = moved * joint.moved(joints);
        let body = body.moved(&moved);
        let columns: [(DVec3, DVec3); JOINTS] = array::from_fn(|axis| {
            let each = lines.iter().map(|(weights, direction, point)| {
                let turn = *direction * weights[axis];
                (turn.cross(body.centre - *point / MILLIMETRES), turn)
            });
            each.fold((DVec3::ZERO, DVec3::ZERO), |sum, next| {
                (sum.0 + next.0, sum.1 + next.1)
            })
        });
        for (row, (way, turn)) in columns.iter().enumerate() {
            for (column, (other_way, other_turn)) in columns.iter().enumerate() {
                masses[row][column] += body.mass * way.dot(*other_way) + turn.dot(body.inertia * *other_turn);
            }
        }
    }
    masses
}

#[test]
fn one_soft_spring_swings_what_hangs_on_it() {
    // 50 kg, 2 m from axis 1, on links without mass, each with an inertia of 1 kg m2.
    let bodies = array::from_fn(|place| Body {
        mass: if place == 5 { 50.0 } else { 0.0 },
        centre: DVec3::new(0.0, 2.0, 1.0),
        inertia: DMat3::IDENTITY,
    });
    let arm = Arm::new(&Mechanism::OrthoParallel(kr210()), bodies, None, DVec3::Z).unwrap();
    let mut stiffness = [1e9; JOINTS];
    stiffness[0] = 1e5;
    let springs = springs(stiffness);
    let [slowest, ..] = arm.modes(&[0.0; JOINTS], &springs).unwrap();
    let (axis, share) = slowest.softest(&springs);
    assert!(axis == 0 && share > 0.999 && share <= 1.0, "{axis} {share}");
    let wanted = libm::sqrt(1e5 / (50.0 * 4.0 + 6.0)) / TAU;
    assert!(
        (slowest.frequency / wanted - 1.0).abs() < 1e-3,
        "{slowest:?} {wanted}"
    );
    // An energy of 1/2 J, all of it in the spring of axis 1.
    assert!(
        (slowest.swings[0] * slowest.swings[0] * 1e5 - 1.0).abs() < 1e-3,
        "{slowest:?}"
    );
    assert!(slowest.swings[0] > 0.0);
}

#[test]
fn a_joint_that_moves_no_mass_has_no_mode() {
    let mechanism = Mechanism::OrthoParallel(kr210());
    let lines = Linkage::from(&mechanism).tool;
    let bodies = array::from_fn(|place| {
        let on_axis = lines[place].line.point / MILLIMETRES;
        let off = if place == 5 { 0.0 } else { 0.3 };
        Body::point(10.0, on_axis + DVec3::splat(off))
    });
    let arm = Arm::new(&mechanism, bodies, None, DVec3::Z).unwrap();
    assert_eq!(arm.modes(&[0.1; JOINTS], &springs(STIFFNESS)), None);
}

proptest! {
    #[test]
    fn a_mass_matrix_is_that_of_lagrange(bodies in bodies(), [joints, ..] in states(), coupled in any::<bool>()) {
        let arm = if coupled { irb2400() } else { kr210() };
        let mechanism = Mechanism::OrthoParallel(arm);
        let found = Arm::new(&mechanism, bodies, None, 9.81 * DVec3::Z).unwrap().mass_matrix(&joints);
        let wanted = by_jacobians(&mechanism, &bodies, &joints);
        let size = wanted.iter().flatten().fold(1.0_f64, |size, entry| size.max(entry.abs()));
        for row in 0..JOINTS {
            for column in 0..JOINTS {
                prop_assert!((found[row][column] - wanted[row][column]).abs() < 1e-12 * size, "{found:?} {wanted:?}");
            }
        }
    }

    /// What springs pull is what masses need, mode by mode; and modes are apart from each other.
    #[test]
    fn modes_solve_their_equation(bodies in bodies(), [joints, ..] in states(), soft in prop::array::uniform6(3.0..7.0_f64)) {
        let mechanism = Mechanism::OrthoParallel(kr210());
        let arm = Arm::new(&mechanism, bodies, None, DVec3::Z).unwrap();
        let stiffness = soft.map(|power| libm::pow(10.0, power));
        let Some(modes) = arm.modes(&joints, &springs(stiffness)) else {
            return Ok(());
        };
        let masses = by_jacobians(&mechanism, &bodies, &joints);
        prop_assert!(modes.windows(2).all(|two| two[0].frequency <= two[1].frequency));
        let slowest = modes[0].frequency;
        for mode in modes {
            let square = TAU * mode.frequency * TAU * mode.frequency;
            let energy = |axis: usize| libm::sqrt(stiffness[axis]);
            for axis in 0..JOINTS {
                let pull = stiffness[axis] * mode.swings[axis];
                let needs: f64 = (0..JOINTS).map(|other| masses[axis][other] * mode.swings[other]).sum();
                // What is left over is rounding of the slowest mode.
                let within = 1e-9 * square / (TAU * slowest * TAU * slowest);
                prop_assert!((pull - square * needs).abs() <= within * energy(axis), "{mode:?} {axis}: {pull} {}", square * needs);
            }
        }
        for (place, one) in modes.iter().enumerate() {
            for (other_place, other) in modes.iter().enumerate() {
                let shared: f64 = (0..JOINTS).map(|axis| one.swings[axis] * stiffness[axis] * other.swings[axis]).sum();
                let wanted = if place == other_place { 1.0 } else { 0.0 };
                prop_assert!((shared - wanted).abs() < 1e-12, "{shared}");
            }
        }
    }
}
