//! Upright slits, and passes of a disc that free the strips between them, as a program states them.

use super::findings::note;
use super::flank::FlankGeometry;
use super::{Cut, CutFault, Finding, Player};
use crate::cross_section::Guard;
use crate::disc::{Disc, DiscPass, SkinPass};
use crate::rim::{Drift, Rim};
use crate::surface::{Side, Surface};
use std::sync::Arc;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{self, Blade, OperationId, Program, Shape, Stock};
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::UPRIGHT;
use vcutc_geometry::curve::Point2;

/// What an operation takes its disc for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passes {
    /// To free strips between slits.
    Strips(Strips),
    /// To take the skin off the part.
    Skin(Skin),
    /// To take the skin off a surface, in tracks that change along y: no section shows them.
    Tracks(Tracks),
    /// To clear a region of the plan with a round tool: no section shows that.
    Region,
}

/// What holds of tracks on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracks {
    /// What holds in each section.
    pub skin: Skin,
    /// The most material that may stay on the part.
    pub scallop: Length,
    /// How deep the disc may enter the part between two poses, along z.
    pub gouge: Length,
}

/// What the tracks of an operation do, and leave on the part. Found from the program where the surface is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracked {
    pub operation: OperationId,
    /// How many there are.
    pub tracks: usize,
    /// How many poses they have.
    pub poses: usize,
    /// The least and the greatest lead of their moves.
    pub leads: [Angle; 2],
    /// How deep the disc may enter the part, at most, along z.
    pub entry: Length,
    /// In how many sections across them they were looked at.
    pub sections: usize,
    /// The most that stays on the part in these.
    pub left: Length,
    /// Where, in mm.
    pub at: [f64; 3],
    /// The mean height of what stays: the area that stays in the sections over their length.
    pub mean: Length,
    /// What they leave in each of these sections, by growing y.
    pub across: Arc<[Across]>,
}

/// What tracks leave in a section across them.
#[derive(Clone, Debug, PartialEq)]
pub struct Across {
    /// Where along y, in mm.
    pub y: f64,
    /// The machined contour, from left to right. Where no track cuts after cuts along a spine, it lies as high as these may leave it.
    pub machined: Vec<Point2>,
}

impl Tracks {
    /// The disc of a blade, with these limits; none for other blades.
    #[must_use]
    pub fn disc(&self, blade: &Blade) -> Option<Disc> {
        match blade.shape {
            Shape::Disc(edge) => Some(disc(blade, edge, Some(Passes::Tracks(*self)))),
            Shape::Straight(_) | Shape::Crusher(_) => None,
        }
    }
}

/// What holds of passes that take the skin off the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skin {
    /// The thickest strip.
    pub depth: Length,
    /// The widest one.
    pub width: Length,
    /// The thickest one over the body of the disc.
    pub over_hub: Length,
    /// Air around the body.
    pub clearance: Length,
}

/// What holds of passes that free strips between slits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strips {
    /// The thickest chip.
    pub depth: Length,
    /// The widest strip.
    pub width: Length,
    /// How far the rim may go on below what stands beside a strip.
    pub beyond: Length,
    /// Air around the body.
    pub clearance: Length,
}

/// For a replay of a pass without its faults.
const UNLIMITED: Skin = Skin {
    depth: Length::mm(f64::INFINITY),
    width: Length::mm(f64::INFINITY),
    over_hub: Length::mm(f64::INFINITY),
    clearance: Length::ZERO,
};

/// Coordinates this close are equal, in mm.
const SAME: f64 = 1e-6;

/// A disc on its way along y through all of the stock, the centre of its edge in the section, and its lead.
pub(super) struct Through {
    pub(super) disc: Disc,
    pub(super) centre: Point2,
    lead: Angle,
    roll: Angle,
    passes: Option<Passes>,
}

impl Through {
    /// The pass that a segment is; none where it is not a straight way along y with a disc that leans along
    /// it. One that is also rolled is a pass that takes the skin off.
    pub(super) fn of(program: &Program, segment: &Segment<'_>, passes: Option<Passes>) -> Option<Self> {
        let blade = program.blade(segment.before.tool)?;
        let Shape::Disc(edge) = blade.shape else {
            return None;
        };
        let line = segment
            .line()
            .filter(|line| line.via.is_none() && !line.turns())?;
        let held = program.orientation(line.to.orientation)?;
        let (lead, roll) = lean(held, &line).filter(|_| is_through(&line, program.stock))?;
        let is_taken = match passes {
            Some(Passes::Skin(_)) => lead > Angle::ZERO,
            Some(Passes::Strips(_)) => roll == Angle::ZERO,
            Some(Passes::Tracks(_) | Passes::Region) => false,
            None => roll == Angle::ZERO || lead > Angle::ZERO,
        };
        is_taken.then(|| Self {
            disc: disc(blade, edge, passes),
            centre: Point2::new(line.to.tip.x, line.to.tip.z),
            lead,
            roll,
            passes,
        })
    }

    /// The same as a pass that takes the skin off a part.
    fn skin(&self, skin: Skin, part: Option<&Guard<'_>>) -> SkinPass {
        let rim = Rim::rolled(self.centre, self.disc.radius, self.lead, self.roll);
        let nearest = part.and_then(|part| part.nearest(&rim));
        SkinPass {
            centre: self.centre,
            contact: nearest.map_or(self.centre.x, |(at, _)| at.x),
            lead: self.lead,
            roll: self.roll,
            drift: Drift::NONE,
            over_hub: skin.over_hub,
            clearance: skin.clearance,
        }
    }

    /// The pass. Its strip is on the side of the centre on which more stands above the rim: on the other one the disc has to have
    /// room.
    fn strip(&self, strips: Option<Strips>, surface: &mut Surface) -> DiscPass {
        let radius = self.disc.radius.to_mm();
        let Point2 { x, z } = self.centre;
        let above = |surface: &mut Surface, from: f64, to: f64| {
            let (from, to) = (from.max(0.0), to.min(surface.width()));
            if from >= to {
                return 0.0;
            }
            let line: Vec<Point2> = surface.stretch(from, to).collect();
            let pairs = line.windows(2).map(|pair| match pair {
                [a, b] => area_above(*a, *b, z),
                _ => 0.0,
            });
            pairs.sum()
        };
        let left = above(surface, x - radius, x);
        let right: f64 = above(surface, x, x + radius);
        DiscPass {
            centre: self.centre,
            lead: self.lead,
            side: if left > right { Side::Left } else { Side::Right },
            beyond: strips.map_or(Length::ZERO, |strips| strips.beyond),
            shave: None,
            clearance: strips.map_or(Length::ZERO, |strips| strips.clearance),
        }
    }
}

/// The area between a straight piece and a height that it is above, in mm2.
fn area_above(from: Point2, to: Point2, z: f64) -> f64 {
    let (width, heights) = (to.x - from.x, [from.z - z, to.z - z]);
    let [low, high] = [heights[0].min(heights[1]), heights[0].max(heights[1])];
    if low >= 0.0 {
        width * (low + high) / 2.0
    } else if high > 0.0 {
        width * high * high / (high - low) / 2.0
    } else {
        0.0
    }
}

fn disc(blade: &Blade, edge: ir::Disc, passes: Option<Passes>) -> Disc {
    let limits = passes.and_then(|passes| match passes {
        Passes::Strips(strips) => Some((strips.depth, strips.width)),
        Passes::Skin(skin) | Passes::Tracks(Tracks { skin, .. }) => Some((skin.depth, skin.width)),
        Passes::Region => None,
    });
    let (depth, width) = limits.unzip();
    Disc {
        radius: edge.radius,
        depth,
        width,
        body: blade.body.clone().unwrap_or_default(),
    }
}

/// How far the axis leans along the way, and by how much it is rolled towards -x; none where it leans back or lies.
fn lean(held: Orientation, line: &LinearSegment) -> Option<(Angle, Angle)> {
    let m = held.matrix();
    // From the edge to the shank is -z_t.
    let (aside, along, up) = (-m[0][2], -m[1][2], -m[2][2]);
    let forwards = line.to.tip.y > line.from.tip.y;
    let along = if forwards { along } else { -along };
    if up <= 0.0 || along < -SAME {
        return None;
    }
    let along = along.max(0.0);
    if aside.abs() <= UPRIGHT {
        let lead = Angle::rad(libm::atan2(along, up));
        return Some((lead, Angle::ZERO));
    }
    let lead = Angle::rad(libm::atan2(along, libm::hypot(aside, up)));
    Some((lead, Angle::rad(libm::atan2(-aside, up))))
}

/// Whether a way leads along y from one side of the stock to the other.
fn is_through(line: &LinearSegment, stock: Stock) -> bool {
    let (from, to) = (line.from.tip, line.to.tip);
    let straight = (to.x - from.x).abs() <= SAME && (to.z - from.z).abs() <= SAME;
    let (low, high) = (from.y.min(to.y), from.y.max(to.y));
    straight && low <= 0.0 && high >= stock.depth.to_mm()
}

/// Cracks deeper than this that are left at the end have freed nothing, in mm. A disc whose rim ends at its slit leaves less: by a
/// micrometre of rounding it rises there by 0.22 mm with a radius of 100 mm and a lead of 30 degrees.
const IDLE: f64 = 0.25;

impl<'p> Player<'p> {
    /// An upright slit with its bottom in the material. It frees nothing by itself.
    pub(super) fn slit(&mut self, cut: &Cut, geometry: FlankGeometry) {
        let program = self.program;
        let Point2 { x, z } = cut.tip;
        let uncut = self.section.uncut(x, z).max(0.0);
        self.use_edge(uncut * geometry.edge_per_height, cut);
        self.section.slit(x, z);
        let available = self.usable_edge.map_or(Length::ZERO, Length::mm);
        let idle = CutFault::NotFreed {
            needed: Length::mm(f64::INFINITY),
            available,
        };
        self.slits.push((x, cut.finding(program, idle)));
        let entry = self
            .guard(cut.operation)
            .and_then(|(guard, aside)| guard.below_slit(cut.tip, aside));
        if let Some(depth) = entry {
            self.note_entry(cut.tip, depth, |fault| cut.finding(program, fault));
        }
    }

    /// The part that an operation must stay out of, for rims and slits, and how far beside a slit the sides of the blade are.
    fn guard(&mut self, operation: OperationId) -> Option<(&Guard<'p>, f64)> {
        let bound = self.bounds.get(usize::from(operation.0))?;
        let guard = self.kept.entry(operation);
        Some((
            guard.or_insert_with(|| Guard::new(bound.part)),
            bound.aside.to_mm(),
        ))
    }

    /// A disc that goes along y through all of the stock.
    pub(super) fn pass(
        &mut self,
        through: &Through,
        operation: OperationId,
        finding: impl Fn(CutFault) -> Finding,
    ) {
        let rim = Rim::rolled(through.centre, through.disc.radius, through.lead, through.roll);
        let entry = self.guard(operation).and_then(|(guard, _)| guard.deepest(&rim));
        if let Some((at, depth)) = entry {
            self.note_entry(at, depth, &finding);
        }
        let engaged = self.section.engaged(&rim, through.disc.radius);
        self.keep_engaged(engaged);
        let outcome = match through.passes {
            Some(Passes::Skin(skin)) => {
                let part = self.guard(operation).map(|(guard, _)| guard);
                let pass = through.skin(skin, part);
                self.section.skim(&through.disc, &pass)
            }
            Some(Passes::Strips(strips)) => {
                let pass = through.strip(Some(strips), self.section.surface());
                self.section.pass_unguarded(&through.disc, &pass)
            }
            // They are not passes, see `Through::of`.
            Some(Passes::Tracks(_) | Passes::Region) => return,
            // What a pass takes off does not depend on what it is for.
            None if through.roll == Angle::ZERO => {
                let pass = through.strip(None, self.section.surface());
                self.section.pass_unguarded(&through.disc, &pass);
                return;
            }
            None => {
                self.section.skim(&through.disc, &through.skin(UNLIMITED, None));
                return;
            }
        };
        for fault in outcome.faults {
            note(
                &mut self.findings.strips,
                finding(CutFault::Strip(fault)),
                |_, _| false,
            );
        }
    }

    /// Notes slits that are still there at the end: what they were to free hangs on beside them.
    pub(super) fn note_idle_slits(&mut self) {
        if self.slits.is_empty() {
            return;
        }
        for crack in self.section.cracks_deeper(IDLE) {
            let here = self.slits.iter().rfind(|(x, _)| (x - crack.x).abs() <= SAME);
            if let Some(&(_, finding)) = here {
                note(&mut self.findings.not_freed, finding, |_, _| false);
            }
        }
    }
}
