//! Rules of chains: pieces of a way through the work that go on into each other.

use super::{Capability, Rule, Walk};
use crate::geometry::{Orientation, Point3};
use crate::ir::{Action, Edges, Joint, Op, OrientationId, Shape, Site, Straight};
use crate::segments::{LinearSegment, Segment};
use crate::state::TipPose;
use crate::units::{Angle, Length};
use crate::vector::{cross, dot, length, minus, scaled};
use std::collections::BTreeSet;

/// Arcs go round by less than this: beyond it a small error of the point between its ends makes a large one of the arc.
pub const LARGEST_SWEEP: Angle = Angle::deg(340.0);

/// How far the direction may change at once where a chain continues: rounding of the points of small arcs.
pub const LARGEST_KINK: Angle = Angle::deg(0.5);

/// How far the way may lie out of the plane of a straight blade.
pub const LARGEST_SLIP: Angle = Angle::deg(0.45);

/// Shorter pieces have no direction that could be relied on.
const SHORTEST: Length = Length::mm(1e-3);

/// The end of a piece that the next one continues.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenChain {
    site: Site,
    direction: [f64; 3],
}

impl Walk<'_> {
    /// A chain that is not at its end continues with this op.
    pub(super) fn chain_goes_on(&mut self, op: &Op) {
        let Some(chain) = self.chain else { return };
        let follows = matches!(op.action, Action::Follow { .. }) && op.site == chain.site;
        self.require(follows, Rule::ChainJoint);
        if !follows {
            self.chain = None;
        }
    }

    /// A piece of a chain.
    pub(super) fn follow(&mut self, segment: &Segment<'_>, to: Point3, joint: Joint) {
        self.needs = self.needs.with(Capability::Chain);
        self.require(to.is_finite(), Rule::Number);
        let before = self.chain.take();
        let (Some(_), Some(line)) = (segment.start(), segment.line()) else {
            self.fault(Rule::KnownStart);
            return;
        };
        self.rotation(segment);
        self.is_driven(segment.before);
        let Some([begins, ends]) = directions(&line) else {
            self.fault(Rule::Arc);
            return;
        };
        let site = segment.op.site;
        self.require(matches!(site, Site::Cut { .. }), Rule::CutFlanks);
        let blade = self.program.blade(segment.before.tool);
        self.require(blade.is_some(), Rule::OtherBlade);
        let held = [line.from, line.to].map(|pose| self.program.orientation(pose.orientation));
        if let (Some(blade), [Some(from), Some(to)]) = (blade, held) {
            let course = Course {
                line: &line,
                held: [from, to],
                directions: [begins, ends],
            };
            let good = match blade.shape {
                Shape::Straight(straight) => course.is_in_plane_of(straight),
                Shape::Disc(_) => course.descends_at_most(Angle::ZERO),
                Shape::Crusher(crusher) => {
                    course.descends_at_most(crusher.ramp)
                        || self.cleared.are_returned_to(&course)
                        || self.goes_into_an_opening(&course, site, crusher.radius)
                }
            };
            self.require(good, Rule::ChainPosture);
            if let Shape::Crusher(_) = blade.shape {
                self.cleared.add(&course);
            }
        }
        let goes_on = before.is_none_or(|before| angle(before.direction, begins) <= LARGEST_KINK);
        self.require(goes_on, Rule::ChainJoint);
        self.chain = match joint {
            Joint::Through => Some(OpenChain {
                site,
                direction: ends,
            }),
            Joint::Stop => None,
        };
    }
}

impl Walk<'_> {
    /// Whether a piece leads straight down an upright axis into a hole that is open before its operation.
    fn goes_into_an_opening(&self, course: &Course<'_>, site: Site, radius: Length) -> bool {
        let Site::Cut { operation, .. } = site else {
            return false;
        };
        let operation = self.program.operation(operation);
        let openings = operation.map_or(&[][..], |operation| &operation.openings);
        let is_upright = course.axis(0, 2)[2] <= STRAIGHT - 1.0;
        let tip = course.line.to.tip;
        course.goes_straight_down() && is_upright && openings.iter().any(|hole| hole.holds(tip, radius))
    }
}

/// Where pieces of chains have led a crusher, and how it was held: its way down there is free.
#[derive(Debug, Default)]
pub(super) struct Cleared(BTreeSet<[u64; 4]>);

impl Cleared {
    /// With the bits of numbers that a program states, so that nothing near is taken for the same.
    fn key(pose: TipPose) -> [u64; 4] {
        let [x, y, z] = pose.tip.to_array().map(|part| (part + 0.0).to_bits());
        [x, y, z, u64::from(pose.orientation.0)]
    }

    fn add(&mut self, course: &Course<'_>) {
        self.0.insert(Self::key(course.line.to));
    }

    /// Whether a piece leads straight down its own axis to a place where the tool has been.
    fn are_returned_to(&self, course: &Course<'_>) -> bool {
        course.goes_straight_down() && self.0.contains(&Self::key(course.line.to))
    }
}

/// How far a way straight down may be off the axis of its tool, as the cosine that it lacks: rounding.
const STRAIGHT: f64 = 1e-12;

/// The directions in which a piece begins and ends, of unit length; none where it is neither a line nor an arc.
fn directions(line: &LinearSegment) -> Option<[[f64; 3]; 2]> {
    let way = line.length();
    if !way.is_finite() || way < SHORTEST {
        return None;
    }
    match (line.via, line.arc()) {
        (Some(_), Some(arc)) if arc.sweep() < LARGEST_SWEEP => {
            Some([arc.direction(0.0), arc.direction(arc.sweep().to_rad())])
        }
        (Some(_), _) => None,
        (None, _) => {
            let [from, to] = [line.from.tip, line.to.tip].map(Point3::to_array);
            Some([scaled(minus(to, from), 1.0 / way.to_mm()); 2])
        }
    }
}

/// A piece of a chain with how the blade is held, and where it goes, at both ends.
struct Course<'l> {
    line: &'l LinearSegment,
    held: [Orientation; 2],
    directions: [[f64; 3]; 2],
}

/// How steeply a shank may lean back by rounding, as a sine.
const LEANS_BACK: f64 = 1e-6;

impl Course<'_> {
    /// Whether a straight blade follows the piece in its own plane, with an edge in front that does not lean back, or into the
    /// material and out of it within its own outline.
    ///
    /// With `y` the normal of the blade's plane, which turns by the vector `b`, and `t` the direction of the way, which turns by `a`
    /// (both in rad a piece), `(y t)' = (b - a) (y x t)`. As `y x t` is square to `y`, that is at most `|(b - a) x y|`; and `y`
    /// is off `y(0)` by `|b x y(0)|` at most. So between its ends `y t` exceeds the greater value there by no more than half of this.
    fn is_in_plane_of(&self, blade: Straight) -> bool {
        let between = self.changes_by_at_most(self.axis(0, 1));
        let slips = self.ends().map(|(end, way)| dot(self.axis(end, 1), way).abs());
        let slip = slips.fold(0.0, f64::max) + 0.5 * between;
        let stands = self.ends().all(|(end, _)| self.stands(end));
        let leads = self.ends().all(|(end, way)| self.leads(blade, end, way));
        slip <= libm::sin(LARGEST_SLIP.to_rad()) && stands && (leads || self.stays_within_its_outline(blade))
    }

    /// Whether an edge that cuts is in front and does not lean back: it may stand square to the way, as where a slit ends at a corner.
    /// Where a way bends, the blade lies between its directions.
    fn leads(&self, blade: Straight, end: usize, way: [f64; 3]) -> bool {
        let ahead = dot(self.axis(end, 0), way);
        let front = match blade.edges {
            Edges::Double if ahead < 0.0 => -1.0,
            Edges::Double => 1.0,
            Edges::Single if ahead > 0.0 => 1.0,
            Edges::Single => return false,
        };
        dot(self.edge(blade, end, front), way) >= -libm::sin(LARGEST_SLIP.to_rad())
    }

    /// Whether a blade goes straight into the material or out of it, between the directions of its edges: all that it passes lies
    /// within its outline at the deeper end. A back that does not cut goes along itself.
    fn stays_within_its_outline(&self, blade: Straight) -> bool {
        let (Some((_, way)), false, None) = (self.ends().next(), self.line.turns(), self.line.via) else {
            return false;
        };
        let along = |direction: [f64; 3], widest: Angle| dot(direction, way) >= libm::cos(widest.to_rad());
        let outline = blade.half_apex + LARGEST_SLIP;
        let goes_out = along(scaled(self.axis(0, 2), -1.0), outline);
        let goes_in = match blade.edges {
            Edges::Double => along(self.axis(0, 2), outline),
            Edges::Single => along(scaled(self.edge(blade, 0, -1.0), -1.0), LARGEST_SLIP),
        };
        goes_in || goes_out
    }

    /// The direction of an edge from the tip up: the leading one (1), or the other one (-1).
    fn edge(&self, blade: Straight, end: usize, side: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(blade.half_apex.to_rad());
        minus(
            scaled(self.axis(end, 0), side * sin),
            scaled(self.axis(end, 2), cos),
        )
    }

    /// Whether a round blade goes down, seen along its own axis, no more steeply than this. For the axis holds what
    /// [`Self::is_in_plane_of`] says of the normal.
    fn descends_at_most(&self, ramp: Angle) -> bool {
        let between = self.changes_by_at_most(self.axis(0, 2));
        let leans = self.ends().map(|(end, way)| -dot(self.axis(end, 2), way));
        let least = leans.fold(f64::INFINITY, f64::min) - 0.5 * between;
        least >= -libm::sin(ramp.to_rad()) - LEANS_BACK && self.ends().all(|(end, _)| self.stands(end))
    }

    /// Whether a blade goes on a line along its own axis, without turning.
    fn goes_straight_down(&self) -> bool {
        let [down, _] = self.directions;
        let is_straight = self.line.via.is_none() && !self.line.turns();
        is_straight && dot(self.axis(0, 2), down) >= 1.0 - STRAIGHT
    }

    fn ends(&self) -> impl Iterator<Item = (usize, [f64; 3])> {
        (0..2).zip(self.directions)
    }

    /// An axis of the blade frame at an end.
    fn axis(&self, end: usize, column: usize) -> [f64; 3] {
        self.held.get(end).map_or([0.0; 3], |held| {
            let matrix = held.matrix();
            core::array::from_fn(|row| matrix[row][column])
        })
    }

    /// Whether the shank points up.
    fn stands(&self, end: usize) -> bool {
        self.axis(end, 2)[2] < 0.0
    }

    /// How much the cosine between the way and an axis of the blade, which lies so at the start, changes along the piece at most.
    fn changes_by_at_most(&self, axis: [f64; 3]) -> f64 {
        let [from, to] = self.held;
        let blade_turns = from.rotation_to(to);
        let arc = self.line.arc();
        let way_turns = arc.map_or([0.0; 3], |arc| scaled(arc.axis(), arc.sweep().to_rad()));
        let apart = minus(blade_turns, way_turns);
        length(cross(apart, axis)) + length(apart) * length(cross(blade_turns, axis))
    }
}

/// Whether a disc that is led straight from one pose to the next would go down through its own face, which [`Rule::ChainPosture`]
/// does not allow: for planners.
#[must_use]
pub fn goes_face_first([from, to]: [(Point3, Orientation); 2]) -> bool {
    let pose = |tip| TipPose {
        tip,
        orientation: OrientationId(0),
    };
    let line = LinearSegment {
        from: pose(from.0),
        to: pose(to.0),
        via: None,
        turn: Angle::ZERO,
        feed: None,
        rate: None,
    };
    directions(&line).is_some_and(|directions| {
        let course = Course {
            line: &line,
            held: [from.1, to.1],
            directions,
        };
        !course.descends_at_most(Angle::ZERO)
    })
}

/// The angle between two directions of unit length.
fn angle(one: [f64; 3], other: [f64; 3]) -> Angle {
    Angle::rad(libm::atan2(length(cross(one, other)), dot(one, other)))
}
