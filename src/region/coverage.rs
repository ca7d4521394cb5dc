//! What passes of a round tool leave of a region: the proof that they leave nothing, or where they do and how much.
//!
//! Let `r` be the tool's radius, and let its centre keep a distance from the walls. A place is *reachable* if it lies within `r` of a
//! place that the centre may take, and *uncut* if it is reachable and no pass comes within `r` of it. What no round tool reaches,
//! the corners of walls, is not uncut; [`unreachable()`] bounds it.
//!
//! - **Where the centre may go** a quadtree of boxes decides. A box is cut if a pass has all its corners within `r` (what is
//!   within `r` of a line is convex). Boxes that are smallest and not decided are clipped by half planes: what a pass leaves of a
//!   small box lies beyond the tangent of its reach, give or take the reach's sagitta over the box. The area of what remains
//!   counts as uncut. So the area is an upper bound, and too large by second order only.
//! - **Along the walls** the edge of what is reachable and the edge of what is cut are the same, so no box decides. There the
//!   triangle inequality does: a reachable place where the centre may not go is within `r` of the edge of where it may go. If
//!   passes follow that edge at most `f` aside, the place is within `r + f` of a pass. Passes that follow it exactly leave nothing
//!   there; passes that are rounded leave at most a fringe of width `f` at the foot of the walls, which [`Coverage::fringe`] states
//!   and the area leaves out. Parts of the edge that nothing follows send their surroundings to the quadtree.

use crate::curve::Curve;
use crate::pass::Pass;
use crate::place::Place;
use crate::region::Region;

mod boxes;
mod clip;
mod edge;
mod grid;
mod spots;

/// A round tool, and how near to walls it works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Its radius, in mm.
    pub radius: f64,
    /// What its centre keeps from walls, in mm: at least the radius.
    pub keep: f64,
}

impl Tool {
    /// A tool whose rim may touch the walls.
    #[must_use]
    pub const fn touching(radius: f64) -> Self {
        Self { radius, keep: radius }
    }

    fn is_sound(self) -> bool {
        self.radius > 0.0 && self.keep >= self.radius && self.keep.is_finite()
    }
}

/// What passes leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// The area of all uncut places, in mm2: never below the truth but for the fringe.
    pub uncut: f64,
    /// Width of a strip along the edge of what is reachable that is not looked at, in mm: by so much passes leave that edge.
    pub fringe: f64,
    /// Uncut places that hang together, the largest first.
    pub spots: Vec<Spot>,
}

/// Uncut ground that hangs together.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Its area, in mm2, an upper bound.
    pub area: f64,
    /// Diameter of the largest circle in it, in mm, an upper bound.
    pub width: f64,
    /// The middle of a circle of that size.
    pub at: Place,
    /// Squares that cover it, for pictures.
    pub squares: Vec<Square>,
}

/// A square with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Square {
    /// Its corner of the least coordinates.
    pub low: Place,
    /// Its side, in mm.
    pub side: f64,
}

/// Why nothing is proven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoverageFault {
    /// The tool has no radius, or keeps less than it from the walls.
    Tool,
    /// The tool is so small for the region, or so much is uncut, that more boxes are needed than are looked at.
    Fine {
        /// How many boxes are looked at.
        most: usize,
    },
}

/// Bounds what passes leave of a region.
///
/// # Errors
/// The tool is not valid, or the work is beyond its bound.
pub fn coverage(region: &Region, passes: &[Pass], tool: Tool) -> Result<Coverage, CoverageFault> {
    if !tool.is_sound() {
        return Err(CoverageFault::Tool);
    }
    let pieces = passes.iter().flat_map(|pass| &pass.pieces);
    let passes: Vec<Curve> = pieces
        .filter(|piece| piece.is_sound())
        .map(|&piece| Curve::of(piece))
        .collect();
    let edge = edge::Edge::of(region, tool);
    let (missed, fringe) = edge.missed_by(&passes);
    let ground = boxes::Ground::new(region, passes, missed, tool);
    let left = ground.uncut()?;
    let spots = spots::spots(&ground, &left);
    let uncut = left.area();
    Ok(Coverage { uncut, fringe, spots })
}

/// Bounds what of a region a round tool does not reach at all, in mm2: mostly the corners of its walls.
///
/// It is what passes would leave that went along the whole edge of where the centre may go, with the tool's own radius there, and
/// everywhere within.
///
/// # Errors
/// The tool is not valid, or the work is beyond its bound.
pub fn unreachable(region: &Region, tool: Tool) -> Result<Coverage, CoverageFault> {
    if !tool.is_sound() {
        return Err(CoverageFault::Tool);
    }
    let edge = edge::Edge::of(region, tool);
    let ground = boxes::Ground::beyond(region, edge.into_parts(), tool);
    let left = ground.uncut()?;
    let spots = spots::spots(&ground, &left);
    let uncut = left.area();
    Ok(Coverage {
        uncut,
        fringe: 0.0,
        spots,
    })
}

#[cfg(test)]
mod tests;
