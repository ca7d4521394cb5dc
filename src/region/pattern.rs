//! Patterns: passes of a round tool that clear a region.
//!
//! Offsets leave nothing where their step is at most the radius: every place between two passes is within a step of the outer one,
//! straight towards the nearest wall. Rounded inward corners move passes in; how far they may is in [`cover`].

use crate::boxes::Dense;
use crate::offset::{OffsetFault, Offsets};
use crate::pass::Pass;
use crate::region::Region;

mod smooth;
mod zigzag;

/// Most passes of a region, and most rows.
const MOST_PASSES: usize = 100_000;

/// Most pieces of all passes together.
const MOST_PIECES: usize = 5_000_000;

/// A round tool over a region. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Its radius.
    pub radius: f64,
    /// How much farther than its radius the pass next to the walls keeps from them; 0 or more.
    pub standoff: f64,
    /// How much farther than its radius passes run on beyond open sides; 0 or more.
    pub run_out: f64,
}

impl Tool {
    /// How far the pass next to the walls keeps from them.
    #[must_use]
    pub fn wall_distance(&self) -> f64 {
        self.radius + self.standoff
    }

    /// How far passes run on beyond open sides.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.radius + self.run_out
    }
}

/// How passes lie. Lengths in mm, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// Offsets of the walls.
    Offset {
        /// From pass to pass.
        step: f64,
    },
    /// Offsets whose inward corners, but on the pass next to the walls, are arcs.
    Smooth {
        /// From pass to pass.
        step: f64,
        /// The largest radius of such an arc.
        corner: f64,
    },
    /// Rows, joined along the walls, and a pass next to the walls.
    Zigzag {
        /// From row to row, at most.
        step: f64,
        /// The direction of the rows, from x towards y.
        angle: f64,
    },
}

/// Why there are no passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PatternFault {
    /// An invalid radius, step or angle.
    Parameter,
    /// The tool fits nowhere.
    TooWide,
    /// There are more passes, or more of their pieces, than are looked at.
    TooMany,
    /// A level could not be computed.
    Offset(OffsetFault),
}

impl From<OffsetFault> for PatternFault {
    fn from(fault: OffsetFault) -> Self {
        Self::Offset(fault)
    }
}

impl From<Dense> for PatternFault {
    fn from(_: Dense) -> Self {
        Self::TooMany
    }
}

/// The passes of a pattern, from the walls inwards. Nothing that lies deeper than a level is without a pass of it.
///
/// # Errors
/// See [`PatternFault`].
pub fn passes(region: &Region, tool: &Tool, pattern: Pattern) -> Result<Vec<Pass>, PatternFault> {
    let (step, other) = match pattern {
        Pattern::Offset { step } => (step, 0.0),
        Pattern::Smooth { step, corner } => (step, corner),
        Pattern::Zigzag { step, angle } => (step, angle.abs()),
    };
    let is_length = |length: f64| length > 0.0 && length.is_finite();
    let is_more = |length: f64| length >= 0.0 && length.is_finite();
    let is_tool = is_length(tool.radius) && is_more(tool.standoff) && is_more(tool.run_out);
    if !is_tool || !is_length(step) || !is_more(other) {
        return Err(PatternFault::Parameter);
    }
    let mut offsets = Offsets::of(region, tool.reach());
    let passes = match pattern {
        Pattern::Offset { .. } => levels(&mut offsets, tool, step, None)?,
        Pattern::Smooth { corner, .. } => {
            let rule = smooth::Rule {
                radius: tool.radius,
                step,
                most: corner,
            };
            levels(&mut offsets, tool, step, Some(rule))?
        }
        Pattern::Zigzag { angle, .. } => zigzag::passes(&mut offsets, tool, step, angle)?,
    };
    if passes.is_empty() {
        return Err(PatternFault::TooWide);
    }
    Ok(passes)
}

/// The passes of all levels, their inward corners rounded by a rule.
fn levels(
    offsets: &mut Offsets,
    tool: &Tool,
    step: f64,
    rule: Option<smooth::Rule>,
) -> Result<Vec<Pass>, PatternFault> {
    let mut passes: Vec<Pass> = Vec::new();
    let mut before: Option<smooth::Before> = None;
    let mut count = 0;
    for level in 0_u32.. {
        let distance = tool.wall_distance() + f64::from(level) * step;
        let ways = offsets.level(distance)?;
        if ways.is_empty() {
            break;
        }
        let first = passes.len();
        for way in &ways {
            let pieces = match (rule, &before) {
                (Some(rule), Some(before)) => smooth::smoothed(way, distance, rule, before, offsets.walls()),
                _ => way.pieces.clone(),
            };
            count += pieces.len();
            passes.push(Pass { level, pieces });
        }
        if passes.len() > MOST_PASSES || count > MOST_PIECES {
            return Err(PatternFault::TooMany);
        }
        if rule.is_some() {
            let cut = passes.get(first..).unwrap_or(&[]).iter();
            let cut = cut.flat_map(|pass| pass.pieces.iter().copied());
            before = Some(smooth::Before::of(cut, &ways));
        }
    }
    Ok(passes)
}

/// The largest radius with which the inward corners of all passes but the one next to the walls may be rounded so that nothing stays
/// uncut in a corner of this half angle, in rad, between straight walls. Endless for no corner; 0 or less where a sharp one
/// leaves something already.
///
/// Let x run along the bisector from the corner of the pass next to the walls, which is sharp. That pass cuts up to `x = radius / sin`,
/// where both its legs are a radius away. The next one has its corner at `step / sin`, moved in by b, and cuts from a radius before
/// that on. So b is at most `(radius (1 + sin) - step) / sin`, and an arc of radius rho moves the corner in by `rho (1 / sin - 1)`.
#[must_use]
pub fn cover(radius: f64, step: f64, half_angle: f64) -> f64 {
    cover_of_sine(radius, step, libm::sin(half_angle))
}

fn cover_of_sine(radius: f64, step: f64, sine: f64) -> f64 {
    let room = radius * (1.0 + sine) - step;
    if sine < 1.0 {
        room / (1.0 - sine)
    } else {
        f64::INFINITY.copysign(room)
    }
}

#[cfg(test)]
mod tests;
