//! Regions of the plan as a job draws them.

use std::sync::Arc;
use vcutc_backend_api::units::{Angle, Area, Length, Speed};
use vcutc_diagnostics::source::Span;
use vcutc_region::region::Region;

/// A region with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedRegion {
    pub name: String,
    /// Where it is defined.
    pub span: Span,
    pub region: Arc<Region>,
}

/// What an operation that clears a region is held to.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearing {
    pub region: Arc<Region>,
    /// The height of the floor.
    pub floor: Length,
    /// How far the edge of the tool keeps from walls.
    pub allowance: Length,
    /// How much ground may stay uncut in a layer, of what the tool reaches.
    pub uncut: Area,
    /// How much of the tool's rim may be in the material where the tool is not slow.
    pub engagement: Option<Angle>,
    /// How fast the tool goes at most where it is slow: it may cut with half of its rim there.
    pub slow: Speed,
    /// The sound field whose lines its passes follow, if they follow one: for pictures.
    pub field: Option<SoundField>,
}

/// What an operation that slits the walls of a region is held to.
#[derive(Clone, Debug, PartialEq)]
pub struct Slitting {
    pub region: Arc<Region>,
    /// The height of the floor.
    pub floor: Length,
    /// How far the sides of the blade keep from walls.
    pub allowance: Length,
    /// How much more may stay at the foot of walls.
    pub residual: Length,
}

/// A sound field over a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoundField {
    /// The distance of its lines, half a wave.
    pub step: Length,
    /// How far they lie over its sources.
    pub lift: Length,
    pub sources: Sources,
    /// The radius of the tool that follows them.
    pub radius: Length,
}

/// Where the sources of a sound field lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sources {
    /// Along the medial axis.
    OnAxis,
    /// Along straight lines between its ends and branches.
    Simplified,
}
