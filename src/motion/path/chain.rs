//! Where axes carry a point, computed along a span on which they move: forward kinematics of every mechanism.

use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_geometry::number::Along;
use vcutc_machine::kinematics::five_axis::FiveAxis;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// A point that moves.
pub(super) type Point = [Along; 3];

/// A machine as lines about which its axes turn a point, one after the other.
#[derive(Clone, Debug)]
pub(super) enum Chain<'m> {
    Serial(Box<SerialArm>),
    FiveAxis(&'m FiveAxis),
}

impl<'m> Chain<'m> {
    pub(super) fn of(mechanism: &'m Mechanism) -> Self {
        match mechanism {
            Mechanism::OrthoParallel(arm) => Self::Serial(Box::new(SerialArm::from(arm))),
            Mechanism::Mounted(arm) => Self::Serial(Box::new(SerialArm::from(arm))),
            Mechanism::Serial(arm) => Self::Serial(Box::new(arm.clone())),
            Mechanism::FiveAxis(machine) => Self::FiveAxis(machine),
        }
    }

    /// A point fixed to the flange, seen from the root, while the axes move.
    pub(super) fn point_in_root(&self, joints: &[Along; MOST_AXES], in_flange: DVec3) -> Point {
        match self {
            Self::Serial(arm) => {
                let turns = arm.turns_of(*joints, |third, second| third - second);
                let at_zero = placed(arm.flange_at_zero(), in_flange);
                let lines = arm.axes().iter().zip(turns).rev();
                lines.fold(at_zero, |point, (line, turn)| {
                    about(line.point, line.direction, turn, point)
                })
            }
            Self::FiveAxis(machine) => {
                let at_zero = placed(&machine.nose_at_zero(), in_flange);
                let on_head = machine.head().rev().fold(at_zero, |point, (rotary, place)| {
                    about(rotary.centre, rotary.about.vector(), joints[place], point)
                });
                let in_frame = core::array::from_fn(|i| on_head[i] + joints[i]);
                // The work is turned, so the point is turned back.
                let on_table = machine.table().fold(in_frame, |point, (rotary, place)| {
                    about(rotary.centre, rotary.about.vector(), -joints[place], point)
                });
                moved(&machine.mount_at_zero().inverse(), on_table)
            }
        }
    }
}

fn placed(pose: &Pose, point: DVec3) -> Point {
    (pose.rotation * point + pose.position)
        .to_array()
        .map(Along::constant)
}

/// A point seen from an outer frame that does not move.
pub(super) fn moved(inner_in_outer: &Pose, point: Point) -> Point {
    let turned = times(&inner_in_outer.rotation, point);
    core::array::from_fn(|i| turned[i].plus(inner_in_outer.position[i]))
}

fn times(matrix: &DMat3, [x, y, z]: Point) -> Point {
    core::array::from_fn(|i| {
        let row = matrix.row(i);
        x * row.x + y * row.y + z * row.z
    })
}

/// Turned about a line, by Rodrigues' formula: `c + k (k.v) + cos (v - k (k.v)) + sin (k x v)` with `v` from `c`.
fn about(centre: DVec3, direction: DVec3, angle: Along, point: Point) -> Point {
    let from_line: Point = core::array::from_fn(|i| point[i].plus(-centre[i]));
    let along = times(&outer_product(direction), from_line);
    let across = times(&cross_product(direction), from_line);
    let (sin, cos) = angle.sin_cos();
    core::array::from_fn(|i| (along[i] + cos * (from_line[i] - along[i]) + sin * across[i]).plus(centre[i]))
}

fn outer_product(k: DVec3) -> DMat3 {
    DMat3::from_cols(k * k.x, k * k.y, k * k.z)
}

fn cross_product(k: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, k.z, -k.y),
        DVec3::new(-k.z, 0.0, k.x),
        DVec3::new(k.y, -k.x, 0.0),
    )
}

/// The axes on a span on which each moves evenly from one value to another.
pub fn evenly(from: &Joints, to: &Joints, middle: f64, half: f64) -> [Along; MOST_AXES] {
    core::array::from_fn(|i| {
        let way = to[i] - from[i];
        Along::line(from[i] + way * middle, way * half)
    })
}
