//! What a job asks of freeing a pocket.

use vcutc_backend_api::units::{Area, Length, Speed};
use vcutc_diagnostics::source::Span;
use vcutc_job::{Auto, Disc, NamedRegion, Setup, Sourced, StraightBlade};
use vcutc_process::slits::fit::Asked;

/// Air that the shank of the disc keeps from what stands: a judgement, from no source.
pub(crate) const AIR: Length = Length::mm(1.0);

/// Freeing a pocket with a straight blade and a disc. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct FreePocket {
    /// What all operations state: the cutting speed is that of the straight blade.
    pub setup: Setup,
    /// The blade that cuts slits; it has two edges.
    pub blade: StraightBlade,
    /// The disc that frees strips. It stands upright.
    pub disc: Disc,
    pub region: NamedRegion,
    /// Where the operation names it.
    pub region_span: Span,
    /// The height of the floor over the bottom of the stock; zero or more, and below the top of the stock.
    pub floor: Sourced<Length>,
    /// Width of strips; positive.
    pub step: Sourced<Auto<Length>>,
    /// The thickest layer; positive, and at most what the disc takes.
    pub layer: Sourced<Auto<Length>>,
    /// How many layers slits go through; at least 1. Default 1.
    pub through: Sourced<u32>,
    /// How long strips may be that come out whole; positive. Default 150 mm.
    pub chip: Sourced<Length>,
    /// Core that must stay on walls; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// The speed of the straight blade down into the material; positive.
    pub plunge_feed: Sourced<Speed>,
    /// The speed of the disc in the material; positive.
    pub free_feed: Sourced<Speed>,
    pub limits: Limits,
}

/// Bounds on the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How much ground may stay uncut in a layer, of what the disc reaches. Default 1 mm2.
    pub uncut: Sourced<Area>,
    /// How much may stay in corners of walls that the rim does not reach.
    pub pillars: Option<Sourced<Area>>,
    /// How much may stay at the foot of walls, beyond the allowance; positive. Default 0.1 mm.
    pub residual: Sourced<Length>,
}

impl FreePocket {
    /// What is asked of the slits along walls.
    pub(crate) fn fit(&self) -> Asked<'_> {
        Asked {
            blade: &self.blade,
            region: &self.region,
            region_span: self.region_span,
            floor: self.floor,
            allowance: self.allowance,
            setup: &self.setup,
            otherwise: None,
        }
    }
}
