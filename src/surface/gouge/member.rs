//! A part of a disc, and how it moves between two poses.

use super::slopes::Box2;
use crate::disc::{Disc, Pose, Stage};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Angle;

/// Added to boxes in mm, for the rounding of places.
const ROUNDING: f64 = 1e-9;

/// The least height of the tip of an axis on its way. Below it the bound is useless.
const LEAST_RISE: f64 = 1e-3;

/// A cylinder about the axis of a disc, or its face, which has no height. In mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    radius: f64,
    from: f64,
    to: f64,
}

impl Member {
    pub(super) const fn face(disc: &Disc) -> Self {
        Self {
            radius: disc.radius().to_mm(),
            from: 0.0,
            to: 0.0,
        }
    }

    pub(super) const fn stage(stage: &Stage) -> Self {
        Self {
            radius: stage.radius.to_mm(),
            from: stage.from.to_mm(),
            to: stage.to.to_mm(),
        }
    }
}

/// A part that moves from one pose to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    member: Member,
    ends: [Pose; 2],
    /// How far the centre moves along x, y.
    moves: [f64; 2],
    /// How far a point may move by the turn of the axis, and deviate from its chord.
    swings: f64,
    strays: f64,
    /// The angle.
    angle: f64,
}

impl Turn {
    pub(super) fn new(member: Member, ends: [Pose; 2], turn: Angle) -> Self {
        let [a, b] = ends;
        let angle = a.axis.angle_to(b.axis).max(turn).to_rad();
        let away = libm::hypot(member.radius, member.to);
        Self {
            member,
            ends,
            moves: [b.centre.x - a.centre.x, b.centre.y - a.centre.y],
            swings: away * angle,
            strays: away * angle * angle / 8.0,
            angle,
        }
    }

    /// How far the part reaches at one end of the move in a direction of the plan, of length 1.
    pub(super) fn support(&self, end: usize, [x, y]: [f64; 2]) -> f64 {
        let Pose { centre, axis } = self.ends[end];
        let a = axis.to_array();
        let along = a[0] * x + a[1] * y;
        let out = self.member.radius * (1.0 - along * along).max(0.0).sqrt();
        centre.x * x + centre.y * y + (self.member.from * along).max(self.member.to * along) + out
    }

    /// How far it reaches in a direction at any time.
    pub(super) fn reach(&self, direction: [f64; 2]) -> f64 {
        // Each point stays near its chord, which reaches no farther than its ends.
        let ends = self.support(0, direction).max(self.support(1, direction));
        ends + self.strays + ROUNDING
    }

    /// The box in plan that it stays in: least x and y, greatest x and y.
    pub(super) fn bounds(&self) -> [f64; 4] {
        [
            -self.reach([-1.0, 0.0]),
            -self.reach([0.0, -1.0]),
            self.reach([1.0, 0.0]),
            self.reach([0.0, 1.0]),
        ]
    }

    /// Whether the box about the part at one end of the move meets a rectangle, by its middle and half its size.
    pub(super) fn is_over(&self, end: usize, middle: [f64; 2], half: [f64; 2]) -> bool {
        let meets = |direction: [f64; 2], place: f64, half: f64| {
            self.support(end, direction) + ROUNDING >= place - half
        };
        meets([1.0, 0.0], middle[0], half[0])
            && meets([-1.0, 0.0], -middle[0], half[0])
            && meets([0.0, 1.0], middle[1], half[1])
            && meets([0.0, -1.0], -middle[1], half[1])
    }

    /// The height over a place, and the slope, of the plane that the part lies above at one end of the move.
    pub(super) fn plane(&self, end: usize, place: [f64; 2]) -> (f64, [f64; 2]) {
        let Pose { centre, axis } = self.ends[end];
        let [x, y, z] = axis.to_array();
        let slope = [-x / z, -y / z];
        let height = centre.z + slope[0] * (place[0] - centre.x) + slope[1] * (place[1] - centre.y);
        (height + self.member.from / z, slope)
    }

    /// How deep a place of the surface lies in the part's plane, the greater of both ends.
    pub(super) fn depth(&self, place: Point3) -> f64 {
        let at = |end: usize| place.z - self.plane(end, [place.x, place.y]).0;
        at(0).max(at(1))
    }

    /// How far the height of the plane over a fixed place under the part comes below its chord at most.
    pub(super) fn bend(&self) -> f64 {
        let [a, b] = self.ends.map(|pose| pose.axis.to_array()[2]);
        // The axis of length 1 has no second derivative above angle^2, so that its height stays above its chord less an eighth.
        let square_of_angle = self.angle * self.angle;
        let rise = (a.min(b) - square_of_angle / 8.0).max(LEAST_RISE);
        let square = rise * rise;
        let tangent = (1.0 - square).max(0.0).sqrt() / rise;
        let length = libm::hypot(self.moves[0], self.moves[1]);
        // The slope of the plane is the axis seen on the plane z = 1. It changes by no more than the angle by the square of the
        // cosine. Its second derivative is at most `2 tan/cos^2` along great circles, and another `1/cos^2` for leaving them; that of
        // one by the cosine `2/cos^3`, and another `tan/cos`. The part lies within its own size of the centre.
        let size = self.member.radius + self.member.to + length;
        let second = square_of_angle * (2.0 * tangent + 1.0) / square * size
            + 2.0 * self.angle / square * length
            + square_of_angle * (2.0 / square + tangent) / rise * self.member.from;
        second / 8.0
    }

    /// How many bins of a size a way may lead to either side, along x and along y.
    pub(super) fn window(&self, [low, high]: [[f64; 2]; 2]) -> [[usize; 2]; 2] {
        [0, 1].map(|axis| {
            let size = high[axis] - low[axis];
            let by = self.swings + ROUNDING;
            let [back, forth] = [by - self.moves[axis].min(0.0), by + self.moves[axis].max(0.0)];
            // Casting is to the nearest number there is.
            [back, forth].map(|reach| (reach / size).ceil() as usize)
        })
    }

    /// How far a way may sag below its ends over slopes within a box.
    pub(super) fn sag(&self, slopes: Box2) -> f64 {
        let [x, y] = slopes.spread();
        let [dx, dy] = self.moves.map(f64::abs);
        let spread = (x * x + y * y).sqrt();
        let steepest = slopes.steepest();
        (dx * x + dy * y + self.swings * spread) / 4.0
            + ((1.0 + steepest * steepest).sqrt() + 8.0 / 3.0 * spread) * self.strays
    }
}
