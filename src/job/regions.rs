//! Regions of the plan as a job draws them.

use std::sync::Arc;
use vcutc_backend_api::units::Length;
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

/// A round hole in the stock, upright and open from the top down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Its middle in the plan.
    pub x: Length,
    pub y: Length,
    pub radius: Length,
}

/// A sound field over a region.
#[derive(Clone, Debug, PartialEq)]
pub struct SoundField {
    pub region: Arc<Region>,
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
