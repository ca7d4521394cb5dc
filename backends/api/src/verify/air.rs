//! Rules of ways through the air: the blade meets the stock in cuts only.
//!
//! On a way the tip of a straight blade counts, for its edge leans back from the work; of a round one everything up to where its
//! body begins. What both carry above that is for the proof of bodies, which knows the section.

use super::{Capability, Rule, SAME, Walk};
use crate::geometry::{Orientation, Point3};
use crate::ir::{Blade, Extent, OrientationId, Program, Shape, ToolId};
use crate::segments::Segment;
use crate::state::{Place, TipPose};
use crate::units::Length;

/// How far blades reach in turns: a program has a handful of them for all its ops.
pub(super) struct Extents(Vec<(Turn, Extent)>);

/// A blade that turns from one orientation to another, or keeps one.
type Turn = (ToolId, [OrientationId; 2]);

impl Extents {
    pub(super) const NONE_YET: Self = Self(Vec::new());

    /// Programs of more turns than a few compute the rest anew, so that looking never takes long.
    const MOST: usize = 32;

    fn of(&mut self, turn: Turn, blade: &Blade, held: [Orientation; 2]) -> Extent {
        if let Some((_, known)) = self.0.iter().find(|(known, _)| *known == turn) {
            return *known;
        }
        let found = blade.extent(held);
        if self.0.len() < Self::MOST {
            self.0.push((turn, found));
        }
        found
    }
}

impl Walk<'_> {
    /// A move to axis values begins outside of the stock.
    pub(super) fn leaves_for_axis_values(&mut self, from: Place, tool: ToolId) {
        let Some(pose) = from.pose() else { return };
        let retracted = self.keeps_outside(tool, [pose.orientation; 2], &[pose.tip]);
        self.require(retracted, Rule::AirMoveThroughStock);
    }

    pub(super) fn travel(&mut self, segment: &Segment<'_>, to: Point3) {
        self.rotation(segment);
        self.straight(segment, to);
        if let (Some(from), Some(there)) = (segment.start(), segment.end())
            && from.orientation != there.orientation
        {
            let postures = [from.orientation, there.orientation];
            self.turns_clear(segment.before.tool, &[from.tip, to], postures);
        }
    }

    /// The way of the tip is not a line, so both ends must lie above the stock; that the way between them does too is for
    /// reach to prove, which knows the machine.
    pub(super) fn axis_travel(&mut self, segment: &Segment<'_>, to: Point3) {
        self.needs = self.needs.with(Capability::JointMove);
        self.require(to.is_finite(), Rule::Number);
        let (tool, end) = (segment.before.tool, segment.end());
        let from_above = match segment.before.place {
            Place::Pose(from) => self.is_above(tool, from),
            Place::Home | Place::Change => true,
            Place::Unknown => {
                self.require(!self.has_home(), Rule::KnownStart);
                true
            }
        };
        let ends_above = end.is_none_or(|end| self.is_above(tool, end));
        self.require(from_above && ends_above, Rule::AirMoveThroughStock);
    }

    fn is_above(&mut self, tool: ToolId, pose: TipPose) -> bool {
        let reach = self.on_ways(tool, [pose.orientation; 2]);
        pose.tip.z - reach.down >= self.program.stock.height.to_mm() - SAME
    }

    /// Through the air on a straight line.
    pub(super) fn straight(&mut self, segment: &Segment<'_>, to: Point3) {
        self.needs = self.needs.with(Capability::LinearMove);
        self.require(to.is_finite(), Rule::Number);
        let (Some(from), Some(end)) = (segment.start(), segment.end()) else {
            self.fault(Rule::KnownStart);
            return;
        };
        let held = [from.orientation, end.orientation];
        let clear = self.keeps_outside(segment.before.tool, held, &[from.tip, to]);
        self.require(clear, Rule::AirMoveThroughStock);
    }

    /// The blade stays on one outer side of the stock (which is convex, so the ends of a way tell).
    fn keeps_outside(&mut self, tool: ToolId, held: [OrientationId; 2], ends: &[Point3]) -> bool {
        let reach = self.on_ways(tool, held);
        // How far a straight blade reaches to the sides is computed only where nothing else keeps it outside.
        self.is_outside(ends, reach)
            || self
                .sideways(tool, held, ends)
                .is_some_and(|x| self.is_outside(ends, Extent { x: Some(x), ..reach }))
    }

    /// How far the blade reaches from its tip on a way through the air; of a straight one the tip alone.
    fn on_ways(&mut self, tool: ToolId, held: [OrientationId; 2]) -> Extent {
        let blade = self.program.blade(tool);
        let Some(round) = blade.filter(|blade| blade.straight().is_none()) else {
            return Extent::TIP;
        };
        match held.map(|id| self.program.orientation(id)) {
            [Some(from), Some(to)] => self.extents.of((tool, held), round, [from, to]),
            _ => Extent::TIP,
        }
    }

    /// How far a straight blade that is held alike all along reaches to the sides, as far up from the tip as the stock stands.
    fn sideways(&self, tool: ToolId, [from, to]: [OrientationId; 2], ends: &[Point3]) -> Option<[f64; 2]> {
        let straight = self.program.blade(tool)?.straight()?;
        let held = self.program.orientation(from).filter(|_| from == to)?;
        let lowest = ends.iter().map(|tip| tip.z).fold(f64::INFINITY, f64::min);
        let below = self.program.stock.height.to_mm() - lowest;
        Some(straight.across(held, below))
    }

    /// Whether a blade that reaches that far from its tip lies on one outer side of the stock with its tip at any of these places.
    pub(super) fn is_outside(&self, tips: &[Point3], reach: Extent) -> bool {
        let stock = self.program.stock;
        let [width, depth, height] = [stock.width, stock.depth, stock.height].map(Length::to_mm);
        let beside = |[low, high]: [f64; 2]| {
            let left = tips.iter().all(|tip| tip.x + high <= SAME);
            left || tips.iter().all(|tip| tip.x + low >= width - SAME)
        };
        tips.iter().all(|tip| tip.y + reach.y[1] <= SAME)
            || tips.iter().all(|tip| tip.y + reach.y[0] >= depth - SAME)
            || tips.iter().all(|tip| tip.z - reach.down >= height - SAME)
            || reach.x.is_some_and(beside)
    }

    /// The blade is clear of the stock while it turns from one posture to the other with its tip at one of these points.
    pub(super) fn turns_clear(&mut self, tool: ToolId, tips: &[Point3], postures: [OrientationId; 2]) {
        let program = self.program;
        let held = postures.map(|id| program.orientation(id));
        let (Some(blade), [Some(from), Some(to)]) = (program.blade(tool), held) else {
            return;
        };
        let extent = self.extents.of((tool, postures), blade, [from, to]);
        for &tip in tips {
            self.require(self.is_clear(tip, extent), Rule::TurnInStock);
        }
    }

    /// Whether the blade, reaching that far, is clear of the stock with its tip at `tip` [Cui 5].
    fn is_clear(&self, tip: Point3, reach: Extent) -> bool {
        let stock = self.program.stock;
        if tip.z - reach.down >= stock.height.to_mm() - SAME {
            return true;
        }
        let (gap, over_the_work) = if tip.y < 0.0 {
            (-tip.y, reach.y[1])
        } else {
            (tip.y - stock.depth.to_mm(), -reach.y[0])
        };
        gap >= -SAME && over_the_work <= gap + SAME
    }
}

/// How far below its tip a blade of a program hangs at most: a straight one half its thickness, held as it cuts or upright, a
/// round one the lower side of its edge.
#[must_use]
pub fn hang(program: &Program) -> Length {
    let blades = program.blades.iter().map(|blade| match blade.shape {
        Shape::Straight(straight) => straight.thickness * 0.5,
        Shape::Disc(_) | Shape::Crusher(_) => {
            let held = program.orientations.iter();
            let down = held.map(|&held| blade.extent([held; 2]).down);
            Length::mm(down.fold(0.0, f64::max))
        }
    });
    blades.fold(Length::ZERO, Length::max)
}
