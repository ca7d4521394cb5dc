//! Arms, random moves, and dense sampling, against which the proofs are tested.

mod abreast;
mod axes;
mod joint;
mod sampling;
mod serial;
mod windows;

use super::*;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DMat3, DQuat, DVec3};
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Axis, AxisKind, Maker};
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::path_limits::PathLimits;
use vcutc_machine::{Model, catalogue};

/// How near singular poses the tests let an arm come.
const LEAST: Clearance = Clearance {
    wrist: 0.02,
    elbow: 0.02,
    shoulder: 5.0,
};

/// Random numbers, the same in every run (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
struct Dice(u64);

impl Dice {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        low + (high - low) * ((bits >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let vector = DVec3::from_array(core::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.1..=1.0).contains(&vector.length()) {
                return vector.normalize();
            }
        }
    }

    fn rotation(&mut self, most: f64) -> DMat3 {
        let axis = self.direction();
        let (sin, cos) = libm::sincos(0.5 * self.between(0.0, most));
        DMat3::from_quat(DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos))
    }
}

fn kuka() -> Model {
    catalogue::find("kuka/kr210_r3100_ultra").unwrap()
}

/// Made up: an arm whose plane lies beside axis 1, with the forearm's axis above the elbow.
fn beside() -> Model {
    made_up(
        Opw {
            a1: 320.0,
            a2: -200.0,
            b: 85.0,
            c1: 780.0,
            c2: 1125.0,
            c3: 1142.5,
            c4: 200.0,
            offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
            signs: [1.0; 6],
            coupling: Coupling::Serial,
        },
        [
            (-170.0, 170.0),
            (-65.0, 85.0),
            (-180.0, 70.0),
            (-300.0, 300.0),
            (-130.0, 130.0),
            (-360.0, 360.0),
        ],
    )
}

/// Made up: an arm with a parallelogram.
fn rods() -> Model {
    made_up(
        Opw {
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
        },
        [
            (-180.0, 180.0),
            (-42.0, 85.0),
            (-20.0, 120.0),
            (-300.0, 300.0),
            (-120.0, 120.0),
            (-360.0, 360.0),
        ],
    )
}

fn made_up(arm: Opw, limits: [(f64, f64); 6]) -> Model {
    let axes = limits.map(|(min, max)| Axis {
        name: "J".to_owned(),
        kind: AxisKind::Rotary,
        min: f64::to_radians(min),
        max: f64::to_radians(max),
        rate: Some(f64::to_radians(110.0)),
        acceleration: None,
        jerk: None,
    });
    Model {
        name: "test/made_up".to_owned(),
        maker: Maker::Other,
        axes: axes.to_vec(),
        mechanism: Mechanism::OrthoParallel(arm),
        path: PathLimits::UNKNOWN,
        payload: Default::default(),
        masses: None,
        torques: None,
        elasticity: None,
    }
}

/// A model whose axes have no end and no highest rate.
fn unbound(mut model: Model) -> Model {
    for axis in &mut model.axes {
        (axis.min, axis.max, axis.rate) = (-100.0, 100.0, None);
    }
    model
}

fn arm_of(model: &Model) -> Opw {
    *model.mechanism.ortho_parallel().expect("a closed-form arm")
}

/// A blade held at an angle on the flange, and work that stands before the robot, turned.
fn rig(model: &Model) -> Rig<'_> {
    let mut dice = Dice(7);
    let placed = |x, y, z, rotation| {
        Frame::from(Pose {
            rotation,
            position: DVec3::new(x, y, z),
        })
    };
    let tool = placed(40.0, -25.0, 310.0, dice.rotation(1.0));
    let base = placed(1400.0, -300.0, 400.0, dice.rotation(0.5));
    Rig::new(model, tool, base)
}

/// A move from within the axes' ranges, and the branch and the axis values that it begins with.
fn random_move(
    dice: &mut Dice,
    rig: &Rig<'_>,
    ranges: &[Axis],
    longest: f64,
    most_turn: f64,
) -> (Course, Branch, Joints) {
    let start = random_joints(dice, ranges);
    let from = rig.blade_in_work(&start);
    let length = dice.between(1.0, longest);
    let to = Pose {
        rotation: dice.rotation(most_turn) * from.rotation,
        position: from.position + dice.direction() * length,
    };
    let duration = length / dice.between(20.0, 600.0);
    let course = Course {
        arc: None,
        from,
        to,
        duration,
    };
    (course, branch_of(rig, &start), start)
}

fn random_joints(dice: &mut Dice, ranges: &[Axis]) -> Joints {
    let mut joints = [0.0; 6];
    for (value, axis) in joints.iter_mut().zip(ranges) {
        let inside = 0.02 * (axis.max - axis.min);
        *value = dice.between(axis.min + inside, axis.max - inside);
    }
    joints
}

fn branch_of(rig: &Rig<'_>, joints: &Joints) -> Branch {
    let flange = rig.mechanism.flange_in_root(joints);
    let apart = |other: &Joints| -> f64 {
        (0..6)
            .map(|i| libm::sin(0.5 * (other[i] - joints[i])).abs())
            .sum()
    };
    let solutions = rig.mechanism.all(&flange);
    let nearest = solutions
        .iter()
        .min_by(|a, b| apart(&a.joints).total_cmp(&apart(&b.joints)));
    nearest.map_or(Branch::Numbered(0), |solution| solution.branch)
}

/// How moves are drawn: on lines or on arcs.
type Draw = fn(&mut Dice, &Rig<'_>, &[Axis], f64, f64) -> (Course, Branch, Joints);

/// A random move whose tip goes round an arc, by up to 300 deg.
fn random_arc(
    dice: &mut Dice,
    rig: &Rig<'_>,
    ranges: &[Axis],
    longest: f64,
    most_turn: f64,
) -> (Course, Branch, Joints) {
    let (course, branch, start) = random_move(dice, rig, ranges, longest, most_turn);
    let axis = dice.direction();
    let centre = course.from.position + axis.any_orthonormal_vector() * dice.between(1.0, longest);
    let sweep = dice.between(0.05, 300.0_f64.to_radians());
    let at = |share: f64| {
        let turned = DQuat::from_axis_angle(axis, share * sweep);
        centre + turned * (course.from.position - centre)
    };
    let points = [at(0.0), at(0.6), at(1.0)].map(|point| point.to_array());
    let arc = CircularArc::through(points).expect("points that lie apart");
    let to = Pose {
        position: at(1.0),
        ..course.to
    };
    let duration = arc.length().to_mm() / dice.between(20.0, 600.0);
    let arc = Some(arc);
    let course = Course {
        to,
        arc,
        duration,
        ..course
    };
    (course, branch, start)
}

/// The interpolation by another formula than the proof's.
fn blade_at(course: &Course, s: f64) -> Pose {
    let (one, other) = (
        DQuat::from_mat3(&course.from.rotation),
        DQuat::from_mat3(&course.to.rotation),
    );
    Pose {
        rotation: DMat3::from_quat(one.slerp(other, s)),
        position: match course.arc {
            None => course.from.position.lerp(course.to.position, s),
            Some(arc) => {
                let centre = DVec3::from_array(arc.centre());
                let turned = DQuat::from_axis_angle(DVec3::from_array(arc.axis()), s * arc.sweep().to_rad());
                centre + turned * (course.from.position - centre)
            }
        },
    }
}

/// What sampling finds: values, rates and clearances at places at most 0.05 mm apart, by numbers and a formula of its own
/// for the interpolation.
struct Sampled {
    low: Joints,
    high: Joints,
    rate: Joints,
    clearance: Clearance,
    end: Joints,
}

fn sample(rig: &Rig<'_>, arm: &Opw, course: &Course, branch: Branch, start: &Joints) -> Option<Sampled> {
    let length = match course.arc {
        None => course.from.position.distance(course.to.position),
        Some(arc) => arc.length().to_mm(),
    };
    let steps = (length / 0.05).ceil().max(200.0);
    let mut found = Sampled {
        low: *start,
        high: *start,
        rate: [0.0; 6],
        clearance: clearance_at(arm, start),
        end: *start,
    };
    for k in 1..=steps as u32 {
        let blade = blade_at(course, f64::from(k) / steps);
        let joints = rig
            .mechanism
            .on_branch(&rig.flange_in_root(&blade), branch, &found.end)?;
        for (i, joint) in joints.into_iter().enumerate() {
            found.low[i] = found.low[i].min(joint);
            found.high[i] = found.high[i].max(joint);
            let rate = (joint - found.end[i]).abs() * steps / course.duration;
            found.rate[i] = found.rate[i].max(rate);
        }
        found.clearance = found.clearance.least(&clearance_at(arm, &joints));
        found.end = joints;
    }
    Some(found)
}

fn clearance_at(arm: &Opw, joints: &Joints) -> Clearance {
    let elbow = match arm.coupling {
        Coupling::Serial => joints[2],
        Coupling::Parallelogram => joints[2] - joints[1],
    };
    let psi = arm.signs[2] * elbow - arm.offsets[2] + libm::atan2(arm.a2, arm.c3);
    let flange = arm.forward(joints);
    let centre = flange.position - flange.rotation.z_axis * arm.c4;
    let (sin, cos) = libm::sincos(arm.signs[0] * joints[0] - arm.offsets[0]);
    let from_line = |angle: f64| libm::asin(libm::sin(angle).abs());
    Clearance {
        wrist: from_line(joints[4]),
        elbow: from_line(psi),
        shoulder: (cos * centre.x + sin * centre.y).abs(),
    }
}
