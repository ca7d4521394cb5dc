//! The arm of [Ha 2019] under milling forces: what its own model makes of them, and what springs do.
//!
//! The paper computes the torques of the drives with the forces of one material, and the motion with those of another. Its tool goes
//! along a half circle, with a trihedron that turns with the way. Masses, the place of the work and the law of time are not in the paper: those of
//! [`parts_of_the_paper`] are made up, the speed is constant, and the work lies at (1500, 0, 600) mm.

use super::*;
use crate::arm::tests::{parts_of_the_paper, torques};
use crate::arm::{Arm, JOINTS};
use crate::chain::Chain;
use crate::modes::Mode;
use crate::modes::tests::springs;
use glam::{DMat3, DVec3};
use nalgebra::{SMatrix, SVector};
use vcutc_machine::body::MILLIMETRES;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// Radius of the half circle, in m, and the speed on it, in m/s.
const RADIUS: f64 = 0.04;
const SPEED: f64 = 0.01 / 3.0;
/// How fast the tool turns, in rev/s.
const SPIN: f64 = 1000.0 / 60.0;
const START: [f64; JOINTS] = [14.4786, -67.6482, 23.2665, -79.5438, 100.0712, 136.5421];
const HALF_WAY: [f64; JOINTS] = [-2.0399, -97.2454, 55.7688, -182.7218, 48.5554, 181.8023];
/// That of a KR 210, which is another arm.
const STIFFNESS: [f64; JOINTS] = [2.2072e6, 3.3767e6, 2.7757e6, 2.3502e6, 2.1575e6, 0.4671e6];
const END: [f64; JOINTS] = [-13.7558, -62.1245, 16.0161, -279.6326, 99.8669, 225.2751];

/// The page about this case has these figures.
const PAGE: &str = include_str!("../../../../docs/forces_case.md");

type Six = SVector<f64, JOINTS>;

struct Case {
    mechanism: Mechanism,
    chain: Chain,
    arm: Arm,
}

impl Case {
    fn new() -> Self {
        let (mechanism, bodies) = parts_of_the_paper();
        Self {
            chain: Chain::of(&mechanism).unwrap(),
            arm: Arm::new(&mechanism, bodies, None, DVec3::new(0.0, 0.0, 9.81)).unwrap(),
            mechanism,
        }
    }

    /// The tool in the root, in m: along x of its trihedron it goes, and its axis is square to axis 6.
    fn tool(&self, joints: &Joints) -> Pose {
        let flange = self.mechanism.flange_in_root(joints);
        Pose {
            rotation: flange.rotation * DMat3::from_rotation_x(PI) * DMat3::from_rotation_y(FRAC_PI_2),
            position: flange.position / MILLIMETRES,
        }
    }

    /// How the axes move the tip and turn the hand, in the root.
    fn jacobian(&self, joints: &Joints) -> SMatrix<f64, JOINTS, JOINTS> {
        let seen =
            self.mechanism.flange_in_root(joints).rotation * self.chain.flange_at_zero.rotation.transpose();
        let point = self.chain.in_hand(Pose::IDENTITY).position.to_array();
        let columns = self.chain.columns(&self.chain.turns(joints), point);
        SMatrix::from_fn(|row, axis| {
            let direction = (seen.transpose() * DVec3::AXES[row % 3]).to_array();
            if row < 3 {
                columns[axis].of(direction, [0.0; 3])
            } else {
                columns[axis].of([0.0; 3], direction)
            }
        })
    }

    /// The axes where the tool is so far on its way, found from axes nearby.
    fn joints(&self, time: f64, near: &Joints) -> Joints {
        self.found(&held(time), near).expect("within reach").0
    }

    /// The same by Newton and Raphson (equations 8 to 11), and in how many steps; none where these lead nowhere.
    fn found(&self, tool: &Pose, near: &Joints) -> Option<(Joints, usize)> {
        let (place, turn) = (tool.position, tool.rotation);
        let mut joints = *near;
        for steps in 0..100 {
            let tool = self.tool(&joints);
            let off = turn * tool.rotation.transpose();
            let turned = DVec3::new(
                off.y_axis.z - off.z_axis.y,
                off.z_axis.x - off.x_axis.z,
                off.x_axis.y - off.y_axis.x,
            ) * 0.5;
            let moved = place - tool.position;
            let twist = Six::from_iterator(moved.to_array().into_iter().chain(turned.to_array()));
            let is_there = off.x_axis.x + off.y_axis.y + off.z_axis.z > 2.9 && twist.norm() < 1e-13;
            if is_there {
                return Some((joints, steps));
            }
            let step = self.jacobian(&joints).lu().solve(&twist)?;
            joints = array::from_fn(|axis| joints[axis] + step[axis]);
        }
        None
    }

    /// The axes, their rates and their accelerations on the way.
    fn course(&self, time: f64, near: &Joints) -> [Joints; 3] {
        let step = 1e-3;
        let [before, here, after] = [time - step, time, time + step].map(|time| self.joints(time, near));
        let rates = array::from_fn(|axis| (after[axis] - before[axis]) / (2.0 * step));
        let bend = |axis: usize| (after[axis] - 2.0 * here[axis] + before[axis]) / (step * step);
        [here, rates, array::from_fn(bend)]
    }

    /// What a force on the tip pushes the axes with, in Nm.
    fn pushed(&self, joints: &Joints, force: DVec3) -> Six {
        let jacobian = self.jacobian(joints);
        let force = SVector::<f64, 3>::from(force.to_array());
        jacobian.fixed_rows::<3>(0).transpose() * force
    }

    /// How the axes accelerate under these torques and this force.
    fn accelerations(&self, joints: &Joints, rates: &Joints, drives: &Six, force: DVec3) -> Six {
        let still = Six::from(torques(&self.arm, *joints, *rates, [0.0; JOINTS]));
        let masses = SMatrix::<f64, JOINTS, JOINTS>::from_row_iterator(
            self.arm.mass_matrix(joints).into_iter().flatten(),
        );
        let moving = drives + self.pushed(joints, force) - still;
        masses.cholesky().unwrap().solve(&moving)
    }
}

/// Where the tip is to be after so long, in the root, in m.
fn place(time: f64) -> DVec3 {
    let angle = -PI + SPEED / RADIUS * time;
    DVec3::new(1.5, 0.0, 0.6) + RADIUS * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
}

/// The trihedron that turns with the way: half way it is parallel to the root.
fn trihedron(time: f64) -> DMat3 {
    DMat3::from_rotation_z(SPEED / RADIUS * time - FRAC_PI_2)
}

/// How the tool is to be held after so long.
fn held(time: f64) -> Pose {
    Pose {
        position: place(time),
        rotation: trihedron(time),
    }
}

/// The force of a case after so long, in the root, in N.
fn force(teeth: &Teeth, time: f64) -> DVec3 {
    let angle = (TAU * SPIN * time).rem_euclid(TAU);
    trihedron(time) * DVec3::from_array(by_equation_38(teeth, PAPER, angle))
}

#[track_caller]
fn assert_degrees(found: Joints, wanted: [f64; JOINTS], within: f64) {
    for (found, wanted) in found.iter().zip(wanted) {
        let found = found.to_degrees();
        assert!((found - wanted).abs() <= within, "{found} {wanted}");
    }
}

/// How long the tool takes.
const DURATION: f64 = PI * RADIUS / SPEED;

#[test]
fn the_tool_goes_along_half_a_circle() {
    assert!((PI * RADIUS * 1000.0 - 125.6637).abs() < 1e-4);
    assert!((DURATION - 37.69911).abs() < 1e-5);
    assert!((SPEED / RADIUS - 1.0 / 12.0).abs() < 1e-12);
    assert!((2.0 * SPIN - 33.3333).abs() < 1e-4);
}

/// Four ways to reach the start: elbow up and over, each with the wrist both ways.
#[test]
fn the_start_is_reached_in_four_ways() {
    let case = Case::new();
    let mut ways: Vec<Joints> = Vec::new();
    let mut random = 1_u64;
    let mut any = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((random >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * TAU
    };
    for _ in 0..400 {
        let near = array::from_fn(|_| any());
        let Some((joints, _)) = case.found(&held(0.0), &near) else {
            continue;
        };
        let within_a_turn = joints.map(|angle| (angle + PI).rem_euclid(TAU) - PI);
        let is_known = |way: &Joints| way.iter().zip(within_a_turn).all(|(a, b)| (a - b).abs() < 1e-6);
        if !ways.iter().any(is_known) {
            ways.push(within_a_turn);
        }
    }
    assert_eq!(ways.len(), 4, "{ways:?}");
    let over = [14.4786, 59.5504, -173.6794, -96.0257, 103.1896, 65.1738];
    for wanted in [START, over] {
        let [a, b, c, d, e, f] = wanted;
        for wanted in [wanted, [a, b, c, d + 180.0, -e, f - 180.0]] {
            let near = |way: &&Joints| {
                way.iter()
                    .zip(wanted)
                    .all(|(a, b)| (a.to_degrees() - b).abs() < 1e-3)
            };
            assert!(ways.iter().any(|way| near(&way)), "{wanted:?} {ways:?}");
        }
    }
}

#[test]
fn the_arm_follows_the_way_in_few_steps() {
    let case = Case::new();
    let quarters = [
        START,
        [11.1850, -88.3598, 47.2169, -116.7674, 68.5215, 144.0248],
        HALF_WAY,
        [-13.1541, -83.1032, 41.6595, -245.0329, 69.5595, 216.8722],
        END,
    ];
    let mut joints = radians(START);
    let mut most = 0;
    for place in 0..=720_u32 {
        let (there, steps) = case
            .found(&held(DURATION * f64::from(place) / 720.0), &joints)
            .unwrap();
        joints = there;
        // The start itself is known to four digits.
        most = if place == 0 { 0 } else { steps.max(most) };
        if place % 180 == 0 {
            assert_degrees(joints, quarters[place as usize / 180], 1e-4);
        }
    }
    assert!(most <= 3, "{most}");
    let [_, rates, accelerations] = case.course(0.5 * DURATION, &radians(HALF_WAY));
    assert_degrees(
        rates,
        [-1.594806, 0.401185, -0.362349, -8.491348, 0.239121, 5.619002],
        1e-5,
    );
    assert_degrees(
        accelerations,
        [0.031536, 0.311124, -0.283128, 0.105794, 0.651044, -0.101900],
        1e-4,
    );
}

#[test]
fn without_force_the_drives_hold_the_arm_up() {
    let case = Case::new();
    let ends = [
        (
            0.0,
            START,
            [-1.0252, -3833.4297, -2214.1467, -106.4329, 114.0735, 0.0],
        ),
        (
            DURATION,
            END,
            [1.0155, -4230.8254, -2239.9459, 110.0040, 110.5947, 0.0],
        ),
    ];
    for (time, near, wanted) in ends {
        let [joints, rates, accelerations] = case.course(time, &radians(near));
        let found = torques(&case.arm, joints, rates, accelerations);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 2e-3, "{found} {wanted}");
        }
    }
}

fn radians(degrees: [f64; JOINTS]) -> Joints {
    degrees.map(f64::to_radians)
}

/// Equations 30 and 31 a sixtieth of a second from the start.
#[test]
fn both_forces_have_their_torques() {
    let case = Case::new();
    let time = 0.016_667;
    let joints = case.joints(time, &radians(START));
    let wanted = [
        [72.1562, -30.9820, -100.3951, -40.1705, -19.3198, 0.0],
        [41.1547, -26.5723, -86.3639, -35.5587, -17.6174, 0.0],
    ];
    for (teeth, wanted) in cases().iter().zip(wanted) {
        let found = case.pushed(&joints, force(teeth, time));
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 0.02, "{found} {wanted}");
        }
    }
}

/// The drives hold against the first force, and the second one pushes: the tip leaves its way ever faster. No arm is controlled so.
#[test]
fn without_a_control_the_tip_leaves_its_way() {
    let case = Case::new();
    let [first, second] = cases();
    let near = case.joints(0.0, &radians(START));
    let drives = |time: f64| {
        let [joints, rates, accelerations] = case.course(time, &near);
        Six::from(torques(&case.arm, joints, rates, accelerations))
            - case.pushed(&joints, force(&first, time))
    };
    let [joints, rates, _] = case.course(0.0, &near);
    let (mut joints, mut rates) = (Six::from(joints), Six::from(rates));
    let step = 2e-4;
    let slope = |time: f64, joints: &Six, rates: &Six| {
        let (there, going) = ((*joints).into(), (*rates).into());
        case.accelerations(&there, &going, &drives(time), force(&second, time))
    };
    let mut off = Vec::new();
    for number in 0..300 {
        let time = f64::from(number) * step;
        // Runge and Kutta, of the fourth order.
        let a = slope(time, &joints, &rates);
        let b = slope(
            time + 0.5 * step,
            &(joints + rates * (0.5 * step)),
            &(rates + a * (0.5 * step)),
        );
        let c = slope(
            time + 0.5 * step,
            &(joints + (rates + a * (0.5 * step)) * (0.5 * step)),
            &(rates + b * (0.5 * step)),
        );
        let d = slope(
            time + step,
            &(joints + (rates + b * (0.5 * step)) * step),
            &(rates + c * step),
        );
        joints += (rates + (a + b + c) * (step / 6.0)) * step;
        rates += (a + b * 2.0 + c * 2.0 + d) * (step / 6.0);
        if number == 149 || number == 299 {
            let tip = case.tool(&joints.into()).position;
            off.push((tip - place(time + step)).length() * 1000.0);
        }
    }
    for (found, wanted) in off.iter().zip([0.04021, 0.23264]) {
        assert!(PAGE.contains(&format!("{found:.4} mm after")), "{found}");
        assert!((found - wanted).abs() < 0.002 * wanted, "{found} {wanted}");
    }
}

/// How far the tip yields along a direction to a force along it, in um/N.
fn yields(case: &Case, joints: &Joints, direction: DVec3) -> f64 {
    let torques = case.pushed(joints, direction);
    let each = torques.iter().zip(STIFFNESS);
    1e6 * each
        .map(|(torque, stiffness)| torque * torque / stiffness)
        .sum::<f64>()
}

/// The mean force, and a tool that is turned about itself: its axis is square to axis 6, so the arm is held otherwise then.
#[test]
fn on_springs_the_tip_yields_to_the_mean_force() {
    let case = Case::new();
    let joints = case.joints(18.84, &radians(HALF_WAY));
    let turn = case.tool(&joints).rotation;
    let mean = turn * DVec3::new(0.7599, 42.5318, 12.1479);
    let pushed = case.pushed(&joints, mean);
    let across = case.pushed(&joints, turn * DVec3::Y);
    let each = (0..JOINTS).map(|axis| across[axis] * pushed[axis] / STIFFNESS[axis]);
    let off = 1e6 * each.sum::<f64>();
    assert!((off - 44.7323).abs() < 0.01, "{off}");
    assert!(PAGE.contains(&format!("{off:.1} um across the way")));
    let there = held(18.84);
    let turned = (0..=90_u32).fold(joints, |near, angle| {
        let about_itself = DMat3::from_rotation_z(f64::from(angle).to_radians());
        let tool = Pose {
            rotation: there.rotation * about_itself,
            ..there
        };
        case.found(&tool, &near).unwrap().0
    });
    let up = turn * DVec3::Z;
    let (before, after) = (yields(&case, &joints, up), yields(&case, &turned, up));
    assert!(
        (before - 1.091).abs() < 2e-3 && (after - 0.719).abs() < 2e-3,
        "{before} {after}"
    );
    let (before, after) = (
        yields(&case, &joints, turn * DVec3::Y),
        yields(&case, &turned, turn * DVec3::Y),
    );
    assert!(
        (before - 1.054).abs() < 2e-3 && (after - 1.027).abs() < 2e-3,
        "{before} {after}"
    );
}

/// On springs the arm swings with the teeth. Damping is not published: 3 % and 1 % of the critical one are made up.
#[test]
fn on_springs_the_tip_swings_with_the_teeth() {
    let case = Case::new();
    let joints = case.joints(18.84, &radians(HALF_WAY));
    let springs = springs(STIFFNESS);
    let modes = case.arm.modes(&joints, &springs).unwrap();
    let frequencies = [12.148, 12.867, 23.588, 100.26, 119.21, 152.51];
    for (mode, wanted) in modes.iter().zip(frequencies) {
        assert!((mode.frequency / wanted - 1.0).abs() < 1e-3, "{mode:?} {wanted}");
    }
    for (damping, peak, apart) in [(0.03, 53.15, 17.23), (0.01, 54.98, 20.11)] {
        let course = swinging(&case, &joints, &modes, damping);
        let high = course.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = course.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((high - peak).abs() < 0.3, "{high} {peak}");
        assert!((high - low - apart).abs() < 0.3, "{} {apart}", high - low);
        let line = format!("up to {high:.2} um, by {:.2} um", high - low);
        assert!(PAGE.contains(&line), "{line}");
    }
}

/// Where the tip is across the way while a tooth passes, in um: each mode answers each harmonic of the force.
fn swinging(case: &Case, joints: &Joints, modes: &[Mode; JOINTS], damping: f64) -> Vec<f64> {
    let places = 720_usize;
    let turn = case.tool(joints).rotation;
    let [teeth, _] = cases();
    let forces: Vec<Six> = (0..places)
        .map(|place| {
            let angle = place as f64 / places as f64 * PI;
            case.pushed(
                joints,
                turn * DVec3::from_array(by_equation_38(&teeth, PAPER, angle)),
            )
        })
        .collect();
    let across = case.pushed(joints, turn * DVec3::Y);
    let mut course = vec![0.0; places];
    for mode in modes {
        let swings = Six::from(mode.swings);
        let push: Vec<f64> = forces.iter().map(|force| force.dot(&swings)).collect();
        for harmonic in 0..60_usize {
            let phase = |place: usize| TAU * (harmonic * place % places) as f64 / places as f64;
            let parts = push.iter().enumerate().map(|(place, push)| {
                let (sine, cosine) = libm::sincos(phase(place));
                [push * cosine, push * sine]
            });
            let [real, imaginary] = parts.fold([0.0; 2], |sum, next| [sum[0] + next[0], sum[1] + next[1]]);
            let weight = if harmonic == 0 { 1.0 } else { 2.0 } / places as f64;
            // Two teeth pass in each turn.
            let ratio = harmonic as f64 * 2.0 * SPIN / mode.frequency;
            let (stiff, damped) = (1.0 - ratio * ratio, 2.0 * damping * ratio);
            let square = stiff * stiff + damped * damped;
            for (place, off) in course.iter_mut().enumerate() {
                let (sine, cosine) = libm::sincos(phase(place));
                let in_step = real * cosine + imaginary * sine;
                let late = real * sine - imaginary * cosine;
                *off += 1e6 * across.dot(&swings) * weight * (in_step * stiff + late * damped) / square;
            }
        }
    }
    course
}
