//! The motion of the blade as controllers interpolate it, seen from the machine's root.

use super::along::Along;
use super::interval::Interval;
use super::{Course, Rig};
use crate::kinematics::pose::Pose;
use glam::{DMat3, DQuat, DVec3};

/// Farther out (mm) there is nothing to work on, and nothing to compute with.
const FARTHEST: f64 = 1e9;

/// What positions on the course may be off by rounding, in mm.
const ROUNDING: f64 = 1e-9;

/// A part of a course: all places within `half` of `middle`, in parts of the course from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) middle: f64,
    pub(super) half: f64,
}

/// The flange on its way: a fixed point of it (where the blade's tip is) on a line, its orientation turning about an axis
/// that is fixed in the root.
///
/// With `R(s) = R0 exp(s angle [axis in blade])`, the rotation `B R(s) F` of the flange in the root is
/// `exp(s angle [axis in root]) B R0 F`, where `axis in root = B R0 (axis in blade)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    /// The tip in the root at the start, in mm.
    tip: DVec3,
    /// What the tip moves by, in mm.
    way: DVec3,
    /// What the flange turns about, in the root; of unit length.
    axis: DVec3,
    /// How far it turns, in rad; zero or more.
    angle: f64,
    /// The flange in the root at the start.
    start: Pose,
}

impl Flight {
    /// `None` for poses that are no numbers or beyond all machines.
    pub(super) fn new(rig: &Rig<'_>, course: &Course) -> Option<Self> {
        let start = rig.flange_in_root(&course.from);
        let tip_at = |blade: &Pose| (rig.work_in_root * *blade).position;
        let (tip, end) = (tip_at(&course.from), tip_at(&course.to));
        let (axis, angle) = rotation(&course.from.rotation, &course.to.rotation);
        let axis = rig.work_in_root.rotation * course.from.rotation * axis;
        let flight = Self {
            tip,
            way: end - tip,
            axis,
            angle,
            start,
        };
        let is_near = |point: DVec3| point.is_finite() && point.abs().max_element() <= FARTHEST;
        let is_sound = is_near(tip)
            && is_near(end)
            && is_near(start.position)
            && start.rotation.is_finite()
            && axis.is_finite()
            && angle.is_finite();
        is_sound.then_some(flight)
    }

    /// The blade at a place of the course, as the flange in the root.
    pub(super) fn flange_at(&self, s: f64) -> Pose {
        let turned = DMat3::from_quat(quaternion(self.axis, s * self.angle));
        Pose {
            rotation: turned * self.start.rotation,
            position: self.tip + self.way * s + turned * (self.start.position - self.tip),
        }
    }

    /// How fast the tip moves, in mm a course, and how fast the flange turns, as a vector in rad a course.
    pub(super) fn velocity(&self) -> (DVec3, DVec3) {
        (self.way, self.axis * self.angle)
    }

    /// Where the tip is on the flange.
    pub(super) fn tip_in_flange(&self) -> DVec3 {
        self.start.rotation.transpose() * (self.tip - self.start.position)
    }

    /// Where the tip is in the root on a span.
    pub(super) fn tip_over(&self, span: Span) -> [Interval; 3] {
        let (tip, slope) = (self.tip + self.way * span.middle, self.way * span.half);
        core::array::from_fn(|i| Interval::around(tip[i], slope[i].abs() + ROUNDING))
    }

    /// The flange on a span.
    #[inline(always)]
    pub(super) fn over(&self, span: Span) -> Flange {
        let (sin, cos) = Along::line(self.angle * span.middle, self.angle * span.half).sin_cos();
        Flange {
            flight: *self,
            span,
            sin,
            cos,
        }
    }
}

/// The flange on a span of its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flange {
    flight: Flight,
    span: Span,
    sin: Along,
    cos: Along,
}

impl Flange {
    /// A direction that is fixed to the flange, seen from the root.
    #[inline(always)]
    pub(super) fn direction(&self, in_flange: DVec3) -> [Along; 3] {
        self.turned(self.flight.start.rotation * in_flange)
    }

    /// A point that is fixed to the flange, seen from the root.
    #[inline(always)]
    pub(super) fn point(&self, in_flange: DVec3) -> [Along; 3] {
        let start = &self.flight.start;
        let from_tip = start.rotation * in_flange + start.position - self.flight.tip;
        let turned = self.turned(from_tip);
        let tip = self.flight.tip + self.flight.way * self.span.middle;
        let slope = self.flight.way * self.span.half;
        let [x, y, z] = turned;
        [
            Along::line(tip.x, slope.x) + x,
            Along::line(tip.y, slope.y) + y,
            Along::line(tip.z, slope.z) + z,
        ]
    }

    #[inline(always)]
    fn rodrigues(&self, along: f64, square: f64, across: f64) -> Along {
        Along::constant(along) + self.cos * square + self.sin * across
    }

    /// Rodrigues' formula.
    #[inline(always)]
    fn turned(&self, vector: DVec3) -> [Along; 3] {
        let axis = self.flight.axis;
        if self.flight.angle == 0.0 {
            return [
                Along::constant(vector.x),
                Along::constant(vector.y),
                Along::constant(vector.z),
            ];
        }
        let (along, across) = (axis * axis.dot(vector), axis.cross(vector));
        let square = vector - along;
        [
            self.rodrigues(along.x, square.x, across.x),
            self.rodrigues(along.y, square.y, across.y),
            self.rodrigues(along.z, square.z, across.z),
        ]
    }
}

/// The rotation that leads from one orientation to another: its axis in the first one, and its angle from 0 to a half turn.
fn rotation(from: &DMat3, to: &DMat3) -> (DVec3, f64) {
    let between = DQuat::from_mat3(&(from.transpose() * *to));
    let vector = DVec3::new(between.x, between.y, between.z);
    let vector = if between.w < 0.0 { -vector } else { vector };
    let length = vector.length();
    // Below this the matrices differ by rounding only.
    if length < 1e-14 {
        return (DVec3::Z, 0.0);
    }
    (vector / length, 2.0 * libm::atan2(length, between.w.abs()))
}

fn quaternion(axis: DVec3, angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle);
    DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
}
