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
        let reach = self.on_ways(tool, [pose.orientation; 2], pose.tip.z);
        let retracted = self.is_outside(pose.tip, reach);
        self.require(retracted, Rule::AirMoveThroughStock);
    }

    pub(super) fn travel(&mut self, segment: &Segment<'_>, to: Point3) {
        self.rotation(segment);
        self.straight(segment, to);
        if let (Some(from), Some(there)) = (segment.start(), segment.end())
            && from.orientation != there.orientation
        {
            let postures = [from.orientation, there.orientation];
            self.turns_clear(segment.before.tool, from.tip, postures);
            self.turns_clear(segment.before.tool, to, postures);
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
        let reach = self.on_ways(tool, [pose.orientation; 2], pose.tip.z);
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
        let reach = self.on_ways(segment.before.tool, held, from.tip.z.min(to.z));
        self.air([from.tip, to], reach);
    }

    /// The blade's way through the air stays on one outer side of the stock (which is convex, so both ends tell).
    fn air(&mut self, ends: [Point3; 2], reach: Extent) {
        let stock = self.program.stock;
        let [width, depth, height] = [stock.width, stock.depth, stock.height].map(Length::to_mm);
        let beside = reach.x.is_some_and(|[low, high]| {
            let left = ends.iter().all(|tip| tip.x + high <= SAME);
            left || ends.iter().all(|tip| tip.x + low >= width - SAME)
        });
        let in_front = ends.iter().all(|tip| tip.y + reach.y[1] <= SAME);
        let behind = ends.iter().all(|tip| tip.y + reach.y[0] >= depth - SAME);
        let above = ends.iter().all(|tip| tip.z - reach.down >= height - SAME);
        self.require(beside || in_front || behind || above, Rule::AirMoveThroughStock);
    }

    /// How far the blade reaches from its tip on a way through the air, with the tip no lower than this, in mm.
    fn on_ways(&mut self, tool: ToolId, held: [OrientationId; 2], lowest: f64) -> Extent {
        match self.program.blade(tool) {
            Some(blade) if blade.straight().is_none() => {
                let known = held.map(|id| self.program.orientation(id));
                match known {
                    [Some(from), Some(to)] => self.extents.of((tool, held), blade, [from, to]),
                    _ => Extent::TIP,
                }
            }
            Some(blade) => {
                // Held alike all along it may pass the stock at its sides too: there its edges count as far up as the stock stands.
                let below = self.program.stock.height.to_mm() - lowest;
                let [from, to] = held;
                let held = self.program.orientation(from).filter(|_| from == to);
                let across = blade.straight().zip(held);
                Extent {
                    x: across.map(|(straight, held)| straight.across(held, below)),
                    ..Extent::TIP
                }
            }
            None => Extent::TIP,
        }
    }

    pub(super) fn is_outside(&self, tip: Point3, reach: Extent) -> bool {
        let stock = self.program.stock;
        let beside = reach
            .x
            .is_some_and(|[low, high]| tip.x + high <= SAME || tip.x + low >= stock.width.to_mm() - SAME);
        beside
            || tip.y + reach.y[1] <= SAME
            || tip.y + reach.y[0] >= stock.depth.to_mm() - SAME
            || tip.z - reach.down >= stock.height.to_mm() - SAME
    }

    /// The blade is clear of the stock while it turns from one posture to the other with its tip at that point.
    pub(super) fn turns_clear(&mut self, tool: ToolId, tip: Point3, postures: [OrientationId; 2]) {
        let program = self.program;
        let held = postures.map(|id| program.orientation(id));
        let clear = match (program.blade(tool), held) {
            (Some(blade), [Some(from), Some(to)]) => {
                let extent = self.extents.of((tool, postures), blade, [from, to]);
                self.is_clear(tip, extent)
            }
            _ => true,
        };
        self.require(clear, Rule::TurnInStock);
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
