//! The passes of a field that clear a region.
//!
//! The lines of a field alone are not passes: they come nearer to walls than the tool may, they end where
//! fronts of neighbouring sources do not meet, and they leave ground between them. So the pass next to the
//! walls is the true offset, lines keep as far from the walls as that, they run out beyond open sides, and
//! extra passes clear what the others leave.

use crate::axis::{AxisError, Detail, axis};
use crate::domain::open_sides;
use crate::field::{Field, FieldError};
use crate::lines::{LinesError, Run, lines};
use crate::source::Tuning;
use vcutc_region::coverage::{self, Coverage, CoverageFault, Spot, coverage};
use vcutc_region::distance::Walls;
use vcutc_region::offset::{OffsetFault, Offsets};
use vcutc_region::pass::Pass;
use vcutc_region::pattern::Tool;
use vcutc_region::piece::Piece;
use vcutc_region::region::{Inside, Region};

mod clip;
mod extra;
mod fewer;

/// How far the axis may be off its straight pieces, in steps.
const AXIS_OFF: f64 = 0.01;

/// Length of the ray at which the gain of a field is 1, in steps.
const REFERENCE: f64 = 3.0;

/// Lines shorter than this, in steps, are left out: what they would cut is looked for again.
const SHORTEST: f64 = 0.25;

/// How often what is still left is cleared by more passes.
const ROUNDS: u32 = 6;

/// How the passes of a field lie. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// From line to line, half a wave.
    pub step: f64,
    /// Height of the plane of the lines over the sources, above 0: it rounds their corners.
    pub lift: f64,
    /// Where the sources lie.
    pub detail: Detail,
    /// Extra passes are laid as long as more than this stays uncut, in mm2; 0 or more.
    pub uncut: f64,
}

/// Why there are no passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PassesError {
    /// An invalid length or area.
    Parameter,
    /// The tool fits nowhere.
    TooWide,
    /// The axis of the region could not be found.
    Axis(AxisError),
    /// The field cannot be computed.
    Field(FieldError),
    /// The field has no lines.
    Lines(LinesError),
    /// The pass next to the walls, or an extra one, could not be computed.
    Level(OffsetFault),
    /// What the passes leave could not be found.
    Coverage(CoverageFault),
}

impl From<OffsetFault> for PassesError {
    fn from(fault: OffsetFault) -> Self {
        Self::Level(fault)
    }
}

impl From<CoverageFault> for PassesError {
    fn from(fault: CoverageFault) -> Self {
        Self::Coverage(fault)
    }
}

/// Passes along the lines of a field, and what else was needed.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldPasses {
    /// The passes next to the walls, of level 0, and those along lines, from the walls inwards. What is farther from the walls lies
    /// to their left.
    pub passes: Vec<Pass>,
    /// Passes that clear what these leave. They may be cut in any order, after all others.
    pub extra: Vec<Pass>,
    /// How many lines the field has, with those that the pass next to the walls replaces.
    pub lines: usize,
    /// How many of them end within the region.
    pub broken: usize,
    /// How much ground the extra passes clear, in mm2.
    pub cleared: f64,
    /// What stays uncut.
    pub left: Coverage,
}

impl FieldPasses {
    /// All passes, the extra ones last.
    #[must_use]
    pub fn all(&self) -> Vec<Pass> {
        self.passes.iter().chain(&self.extra).cloned().collect()
    }
}

/// The passes of a tool along the lines of the synthesised field of a region. All of them keep the tool's wall distance from all walls.
///
/// Joints of pieces along a line turn by less than 0.1 deg where the line is smooth; where it has the tip of a cusp, as unlifted
/// fields do, it has a corner.
///
/// # Errors
/// See [`PassesError`].
pub fn passes(region: &Region, tool: &Tool, wanted: &Wanted) -> Result<FieldPasses, PassesError> {
    let is_length = |length: f64| length > 0.0 && length.is_finite();
    let is_more = |length: f64| length >= 0.0 && length.is_finite();
    let is_tool = is_length(tool.radius) && is_more(tool.standoff) && is_more(tool.run_out);
    if !is_tool || !is_length(wanted.step) || !is_length(wanted.lift) || !is_more(wanted.uncut) {
        return Err(PassesError::Parameter);
    }
    let mut offsets = Offsets::of(region, tool.reach());
    let walls = offsets.level(tool.wall_distance())?.into_iter();
    let mut passes: Vec<Pass> = walls
        .map(|way| Pass {
            level: 0,
            pieces: way.pieces,
        })
        .collect();
    if passes.is_empty() {
        return Err(PassesError::TooWide);
    }
    let drawn = drawn(region, tool, wanted)?;
    let shortest = SHORTEST * wanted.step;
    let open = open_sides(region);
    let inside = Inside::of(region);
    for line in drawn.iter().filter(|line| line.pass.level > 0) {
        let pieces = fewer::fewer(&turned(&line.pass.pieces, offsets.walls()));
        let pieces = clip::run_out(&pieces, &open, tool.reach());
        let parts = clip::kept(&pieces, offsets.walls(), tool.wall_distance());
        let parts = parts.into_iter().map(|pieces| Pass {
            level: line.pass.level,
            pieces,
        });
        // What keeps off all walls is in the region as a whole, or left it through an open side, or was never in it.
        let is_within = |pass: &Pass| pass.pieces.iter().any(|piece| inside.contains(piece.at(0.5)));
        passes.extend(parts.filter(|pass| pass.length() >= shortest && is_within(pass)));
    }
    passes.sort_by_key(|pass| pass.level);
    let reach = coverage::Tool {
        radius: tool.radius,
        keep: tool.wall_distance(),
    };
    let before = coverage(region, &passes, reach)?;
    let mut found = FieldPasses {
        passes,
        extra: Vec::new(),
        lines: drawn.len(),
        broken: drawn.iter().filter(|line| line.run == Run::Broken).count(),
        cleared: before.uncut,
        left: before,
    };
    for _ in 0..ROUNDS {
        if found.left.uncut <= wanted.uncut {
            break;
        }
        let spots = largest(&found.left, wanted.uncut);
        let more = extra::through(spots, &mut offsets, tool, wanted.step)?;
        let count = found.extra.len();
        found.extra.extend(more);
        let left = coverage(region, &found.all(), reach)?;
        if left.uncut >= found.left.uncut {
            found.extra.truncate(count);
            break;
        }
        found.left = left;
    }
    found.cleared -= found.left.uncut;
    Ok(found)
}

/// The largest spots, without those that together are small enough to stay, in mm2.
fn largest(left: &Coverage, uncut: f64) -> &[Spot] {
    let mut rest = 0.0;
    let small = left.spots.iter().rev().take_while(|spot| {
        rest += spot.area;
        rest <= uncut
    });
    let count = left.spots.len() - small.count();
    left.spots.get(..count).unwrap_or_default()
}

/// The lines of the field, half a wave apart from where the pass next to the walls is.
fn drawn(region: &Region, tool: &Tool, wanted: &Wanted) -> Result<Vec<crate::lines::Line>, PassesError> {
    let axis = axis(region, wanted.detail, AXIS_OFF * wanted.step).map_err(PassesError::Axis)?;
    let tuning = Tuning {
        step: wanted.step,
        lift: wanted.lift,
        reference: REFERENCE * wanted.step,
    };
    let field = Field::new(&axis.segments, &tuning).map_err(PassesError::Field)?;
    lines(region, &field, tool.wall_distance()).map_err(PassesError::Lines)
}

/// The pieces of a line in the sense in which what is farther from the walls lies to the left, as on the levels of offsets: of
/// neighbouring lines the field is positive on alternate sides.
fn turned(pieces: &[Piece], walls: &Walls) -> Vec<Piece> {
    let side = |piece: &Piece| {
        let middle = piece.at(0.5);
        let away = walls.nearest(middle).map(|nearest| middle.minus(nearest.at));
        away.map_or(0.0, |away| {
            piece.length() * piece.direction(0.5).cross(away).signum()
        })
    };
    if pieces.iter().map(side).sum::<f64>() < 0.0 {
        pieces.iter().rev().map(|piece| piece.reversed()).collect()
    } else {
        pieces.to_vec()
    }
}

#[cfg(test)]
mod tests;
