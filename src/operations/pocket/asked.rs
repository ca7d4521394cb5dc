//! What a job asks of clearing a pocket.

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Opening;
use vcutc_backend_api::units::{Angle, Area, Length, Speed};
use vcutc_diagnostics::source::Span;
use vcutc_geometry::grid;
use vcutc_job::{Auto, Crusher, Hole, NamedRegion, Setup, Sourced, words};

/// Clearing a pocket with a crusher. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearPocket {
    /// What all operations state. The crusher stands upright.
    pub setup: Setup,
    pub crusher: Crusher,
    pub region: NamedRegion,
    /// Where the operation names it.
    pub region_span: Span,
    /// The height of the floor over the bottom of the stock; zero or more, and below the top of the stock.
    pub floor: Sourced<Length>,
    pub pattern: Sourced<Auto<Pattern>>,
    /// Distance of passes; positive, and below the diameter of the crusher.
    pub step: Sourced<Auto<Length>>,
    /// The thickest layer; positive, and at most the height of the crusher.
    pub layer: Sourced<Auto<Length>>,
    /// The largest radius of rounded corners of passes; zero or more.
    pub corners: Sourced<Auto<Length>>,
    /// Where the rows of a zigzag go, from x towards y.
    pub angle: Sourced<Auto<Angle>>,
    /// How far the lines of a sound field lie over its sources, which rounds their corners; positive.
    pub lift: Sourced<Auto<Length>>,
    /// Where these sources lie. Default `exact`.
    pub axis: Sourced<Axis>,
    /// How the tool gets down where it comes neither through an open side nor into a hole.
    pub entry: Sourced<Auto<WayIn>>,
    /// A hole within the region that is open to its floor, at least as wide as the crusher.
    pub opening: Option<Sourced<Hole>>,
    /// Core that must stay on walls; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// The speed down into the material, and of ways with half the rim in it; positive.
    pub plunge_feed: Sourced<Speed>,
    pub limits: Limits,
}

/// Bounds on the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How much ground may stay uncut in a layer, of what the crusher reaches. Default 1 mm2.
    pub uncut: Sourced<Area>,
    /// How much of the crusher's rim may be in the material at the speed of cutting.
    pub engagement: Option<Sourced<Angle>>,
    /// How far the forces of the crusher may push it off along the normals of walls; positive.
    pub deviation: Option<Sourced<Length>>,
}

impl ClearPocket {
    /// The hole, as programs state it: on their grid, so that a tool as wide as the hole goes into it.
    pub(crate) fn opening_in_program(&self) -> Option<Opening> {
        let Hole { x, y, radius } = self.opening?.value;
        let [x, y] = [x, y].map(|at| grid::nearest(at.to_mm()));
        let ground = Point3::new(x, y, self.floor.value.to_mm());
        Some(Opening { ground, radius })
    }
}

/// How passes lie over a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// At equal distances from the walls.
    Offset,
    /// The same with rounded inward corners, as a synthesised sound field has them.
    Sfs,
    /// In rows, and along the walls.
    Zigzag,
    /// Along the lines of a synthesised sound field, as it is, for study.
    Field,
}

/// Where the sources of a sound field lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along the medial axis of the region.
    Exact,
    /// Along straight lines between its ends and branches, as in the paper.
    Simplified,
}

/// How a tool gets down into the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayIn {
    /// To and fro along a line.
    Ramp,
    /// Round and round.
    Helix,
    /// Not at all: it comes from beside the stock, or into a hole.
    Open,
}

impl Pattern {
    /// Those that are compared where the pattern is left open.
    pub(crate) const COMPARED: [Self; 3] = [Self::Offset, Self::Sfs, Self::Zigzag];
}

words! {
    Pattern { Offset = "offset", Sfs = "sfs", Zigzag = "zigzag", Field = "field" }
    Axis { Exact = "exact", Simplified = "simplified" }
    WayIn { Ramp = "ramp", Helix = "helix", Open = "open" }
}
