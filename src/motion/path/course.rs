//! The motion of the blade as controllers interpolate it, seen from the machine's root.

use super::types::Course;
use crate::rig::Rig;
use glam::{DMat3, DQuat, DVec3};
use vcutc_backend_api::arc::CircularArc;
use vcutc_geometry::number::{Along, Interval, Number};
use vcutc_machine::kinematics::pose::Pose;

/// Farther out (mm) there is nothing to work on, and nothing to compute with.
const FARTHEST: f64 = 1e9;

/// What positions on the course may be off by rounding, in mm; and velocities on an arc, for each rad that it goes round.
const ROUNDING: f64 = 1e-9;

/// A part of a course: all places within `half` of `middle`, in parts of the course from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) middle: f64,
    pub(super) half: f64,
}

/// The flange on its way: a fixed point of it (where the blade's tip is) on a line or an arc, its orientation turning about an axis
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
    /// The arc on which it moves instead of a line.
    arc: Option<Arc>,
    /// What the flange turns about, in the root; of unit length.
    axis: DVec3,
    /// How far it turns, in rad; zero or more.
    angle: f64,
    /// The flange in the root at the start.
    start: Pose,
}

/// The points `centre + cos(s sweep) first + sin(s sweep) second` in the root.
#[derive(Clone, Copy, Debug)]
struct Arc {
    centre: DVec3,
    first: DVec3,
    second: DVec3,
    /// How far it goes round, in rad.
    sweep: f64,
}

impl Arc {
    fn new(rig: &Rig<'_>, in_work: &CircularArc) -> Self {
        let work = rig.work_in_root;
        let [first, second] = in_work
            .radii()
            .map(|radius| work.rotation * DVec3::from_array(radius));
        Self {
            centre: work.rotation * DVec3::from_array(in_work.centre()) + work.position,
            first,
            second,
            sweep: in_work.sweep().to_rad(),
        }
    }

    fn at(&self, s: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(s * self.sweep);
        self.centre + self.first * cos + self.second * sin
    }

    /// How fast the point moves, in mm a course.
    fn velocity(&self, s: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(s * self.sweep);
        (self.second * cos - self.first * sin) * self.sweep
    }

    /// How its velocity changes, in mm a course squared.
    fn acceleration(&self, s: f64) -> DVec3 {
        (self.centre - self.at(s)) * (self.sweep * self.sweep)
    }

    /// Its sweep and its two radii, in the order in which [`Flange::over`] takes them.
    fn numbers(&self) -> [f64; ROUND] {
        let ([a, b, c], [d, e, f]) = (self.first.to_array(), self.second.to_array());
        [self.sweep, a, b, c, d, e, f]
    }

    /// What each coordinate is off the centre by at most.
    fn farthest(&self) -> DVec3 {
        let [first, second] = [self.first.to_array(), self.second.to_array()];
        DVec3::from_array(core::array::from_fn(|i| libm::hypot(first[i], second[i])))
    }
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
            arc: course.arc.map(|arc| Arc::new(rig, &arc)),
            axis,
            angle,
            start,
        };
        let is_near = |point: DVec3| point.is_finite() && point.abs().max_element() <= FARTHEST;
        let is_sound = is_near(tip)
            && is_near(end)
            && flight
                .arc
                .is_none_or(|arc| is_near(arc.centre) && arc.sweep.is_finite())
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
            position: self.tip_at(s) + turned * (self.start.position - self.tip),
        }
    }

    fn tip_at(&self, s: f64) -> DVec3 {
        self.arc.map_or(self.tip + self.way * s, |arc| arc.at(s))
    }

    /// How fast the tip moves at a place, in mm a course.
    pub(super) fn velocity_at(&self, s: f64) -> DVec3 {
        self.arc.map_or(self.way, |arc| arc.velocity(s))
    }

    /// How far the tip goes, in mm.
    pub(super) fn length(&self) -> f64 {
        self.arc
            .map_or(self.way.length(), |arc| arc.first.length() * arc.sweep)
    }

    /// How much the direction of the way turns, in rad a course.
    pub(super) fn bends(&self) -> f64 {
        self.arc.map_or(0.0, |arc| arc.sweep)
    }

    /// How fast the flange turns, as a vector in rad a course.
    pub(super) fn spin(&self) -> DVec3 {
        self.axis * self.angle
    }

    /// How fast the tip moves on a span, in mm a course: on an arc what it is in the middle, and what it may change by.
    pub(super) fn velocity_over(&self, span: Span) -> [Interval; 3] {
        let middle = self.velocity_at(span.middle).to_array();
        let Some(arc) = self.arc else {
            return middle.map(Interval::exactly);
        };
        let change = arc.farthest() * (arc.sweep * arc.sweep * span.half);
        core::array::from_fn(|i| Interval::around(middle[i], change[i] + ROUNDING * arc.sweep))
    }

    /// How the tip's velocity changes on a span, in mm a course squared.
    pub(super) fn acceleration_over(&self, span: Span) -> [Interval; 3] {
        let Some(arc) = self.arc else {
            return [Interval::ZERO; 3];
        };
        let (middle, square) = (arc.acceleration(span.middle), arc.sweep * arc.sweep);
        let change = arc.farthest() * (square * arc.sweep * span.half);
        core::array::from_fn(|i| Interval::around(middle[i], change[i] + ROUNDING * square))
    }

    /// Where the tip is on the flange.
    pub(super) fn tip_in_flange(&self) -> DVec3 {
        self.start.rotation.transpose() * (self.tip - self.start.position)
    }

    /// Where the tip is in the root on a span.
    pub(super) fn tip_over(&self, span: Span) -> [Interval; 3] {
        let (tip, slope) = (
            self.tip_at(span.middle),
            self.velocity_at(span.middle) * span.half,
        );
        // What an arc bends away from its tangent in the middle, by Taylor's theorem.
        let bends = self.arc.map_or(DVec3::ZERO, |arc| {
            let angle = arc.sweep * span.half;
            arc.farthest() * (0.5 * angle * angle)
        });
        core::array::from_fn(|i| Interval::around(tip[i], slope[i].abs() + bends[i] + ROUNDING))
    }

    /// What the flange's points and directions are on the way: the point that is given, and the flange's three axes.
    pub(super) fn carried(&self, point: DVec3) -> Carried {
        let start = &self.start;
        let from_tip = start.rotation * point + start.position - self.tip;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| start.rotation * axis);
        let [x, y, z] = axes;
        Carried {
            tip: self.arc.map_or(self.tip, |arc| arc.centre),
            way: self.way,
            angle: self.angle,
            turned: [from_tip, x, y, z].map(|vector| self.parts(vector)),
        }
    }

    /// The numbers of the arc on which the tip moves, if it does.
    pub(super) fn round(&self) -> Option<[f64; ROUND]> {
        self.arc.map(|arc| arc.numbers())
    }

    /// What it is computed by.
    pub(super) const fn shape(&self) -> Shape {
        if self.arc.is_some() {
            Shape::Arc
        } else if self.angle == 0.0 {
            Shape::Straight
        } else {
            Shape::Turning
        }
    }

    /// A vector as Rodrigues' formula takes it.
    fn parts(&self, vector: DVec3) -> Parts {
        match self.shape() {
            Shape::Straight => Parts {
                along: vector,
                square: DVec3::ZERO,
                across: DVec3::ZERO,
            },
            Shape::Turning | Shape::Arc => {
                let along = self.axis * self.axis.dot(vector);
                Parts {
                    along,
                    square: vector - along,
                    across: self.axis.cross(vector),
                }
            }
        }
    }
}

/// How a flange is on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// It only moves along a line.
    Straight,
    /// It turns while its point moves along a line.
    Turning,
    /// Its point goes round, whether it turns or not.
    Arc,
}

/// A vector that is carried along: its part along the axis of the turn, and what cosine and sine belong to.
#[derive(Clone, Copy, Debug)]
struct Parts {
    along: DVec3,
    square: DVec3,
    across: DVec3,
}

/// What does not change on a course that carries a point of the flange and the flange's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried {
    /// At the start; of an arc its centre.
    tip: DVec3,
    way: DVec3,
    angle: f64,
    turned: [Parts; 4],
}

/// How many numbers that is: the angle, tip and way, and four vectors in three parts.
pub(super) const CARRIED: usize = 1 + 2 * 3 + 4 * 3 * 3;

/// How many come on top on an arc: its sweep and two radii.
pub(super) const ROUND: usize = 1 + 2 * 3;

impl Carried {
    /// All of it, in the order in which [`Flange::over`] takes it.
    pub(super) fn numbers(&self) -> [f64; CARRIED] {
        let parts = self
            .turned
            .iter()
            .flat_map(|part| [part.along, part.square, part.across]);
        let vectors = [self.tip, self.way].into_iter().chain(parts);
        let mut all = [self.angle; CARRIED];
        for (place, number) in all
            .iter_mut()
            .skip(1)
            .zip(vectors.flat_map(|vector| vector.to_array()))
        {
            *place = number;
        }
        all
    }
}

/// The flange on a span of its way: a point of it and its axes, seen from the root.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flange<N> {
    pub(super) point: [Along<N>; 3],
    /// The directions of its axes.
    pub(super) axes: [[Along<N>; 3]; 3],
}

impl<N: Number> Flange<N> {
    /// The flange on the span within `half` of `middle`, by the numbers of [`Carried::numbers`] and, on an arc, of
    /// [`Flight::round`].
    #[inline(always)]
    pub(super) fn over(
        carried: &[N; CARRIED],
        round: Option<&[N; ROUND]>,
        shape: Shape,
        [middle, half]: [N; 2],
    ) -> Self {
        let (angle, tip, way) = (carried[0], vector(carried, 1), vector(carried, 4));
        let sin_cos = match shape {
            Shape::Straight => None,
            Shape::Turning | Shape::Arc => Some(Along::line(angle * middle, angle * half).sin_cos()),
        };
        let tip = match round {
            None => [
                Along::line(tip[0] + way[0] * middle, way[0] * half),
                Along::line(tip[1] + way[1] * middle, way[1] * half),
                Along::line(tip[2] + way[2] * middle, way[2] * half),
            ],
            Some(round) => {
                let sweep = round[0];
                let (sin, cos) = Along::line(sweep * middle, sweep * half).sin_cos();
                let (first, second) = (vector(round, 1), vector(round, 4));
                [
                    rodrigues(sin, cos, tip[0], first[0], second[0]),
                    rodrigues(sin, cos, tip[1], first[1], second[1]),
                    rodrigues(sin, cos, tip[2], first[2], second[2]),
                ]
            }
        };
        let [x, y, z] = turned(carried, 0, sin_cos);
        Self {
            point: [tip[0] + x, tip[1] + y, tip[2] + z],
            axes: [
                turned(carried, 1, sin_cos),
                turned(carried, 2, sin_cos),
                turned(carried, 3, sin_cos),
            ],
        }
    }
}

#[inline(always)]
fn vector<N: Number, const COUNT: usize>(numbers: &[N; COUNT], first: usize) -> [N; 3] {
    [numbers[first], numbers[first + 1], numbers[first + 2]]
}

/// A vector that is carried along.
#[inline(always)]
fn turned<N: Number>(
    carried: &[N; CARRIED],
    index: usize,
    sin_cos: Option<(Along<N>, Along<N>)>,
) -> [Along<N>; 3] {
    let first = 7 + 9 * index;
    let along = vector(carried, first);
    let (square, across) = (vector(carried, first + 3), vector(carried, first + 6));
    match sin_cos {
        Some((sin, cos)) => [
            rodrigues(sin, cos, along[0], square[0], across[0]),
            rodrigues(sin, cos, along[1], square[1], across[1]),
            rodrigues(sin, cos, along[2], square[2], across[2]),
        ],
        None => [
            Along::constant(along[0]),
            Along::constant(along[1]),
            Along::constant(along[2]),
        ],
    }
}

/// Rodrigues' formula.
#[inline(always)]
fn rodrigues<N: Number>(sin: Along<N>, cos: Along<N>, along: N, square: N, across: N) -> Along<N> {
    Along::constant(along) + cos.scaled(square) + sin.scaled(across)
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
