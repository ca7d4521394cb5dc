//! What a job asks of slitting walls.

use vcutc_backend_api::units::{Length, Speed};
use vcutc_diagnostics::source::Span;
use vcutc_job::{NamedRegion, Setup, Sourced, StraightBlade};
use vcutc_process::slits::fit::Asked;

/// Slitting the walls of a region. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct SlitWalls {
    /// What all operations state.
    pub setup: Setup,
    pub blade: StraightBlade,
    pub region: NamedRegion,
    /// Where the operation names it.
    pub region_span: Span,
    /// The height of the floor over the bottom of the stock; zero or more, and below the top of the stock.
    pub floor: Sourced<Length>,
    /// How far the sides of the blade keep from walls; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// The speed down into the material; positive.
    pub plunge_feed: Sourced<Speed>,
    /// How much may stay at the foot of walls, beyond the allowance; positive. Default 0.1 mm.
    pub residual: Sourced<Length>,
}

impl SlitWalls {
    /// What is asked of the slits.
    pub(crate) fn fit(&self) -> Asked<'_> {
        Asked {
            blade: &self.blade,
            region: &self.region,
            region_span: self.region_span,
            floor: self.floor,
            allowance: self.allowance,
            setup: &self.setup,
            otherwise: Some("leave `slit walls` out, and let the crusher make the walls"),
        }
    }
}
