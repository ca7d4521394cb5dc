//! What a job asks of rectangular roughing.

use vcutc_backend_api::units::{Angle, Duration, Length, Speed};
use vcutc_job::{Auto, Bounds, Disc, Setup, Sourced, StraightBlade, words};

/// Air that the body of the disc keeps from what stands beside a strip: a judgement, from no source.
pub(crate) const AIR: Length = Length::mm(1.0);

/// Rectangular roughing. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughRect {
    /// What all operations state: rake and cutting speed are those of the straight blade.
    pub setup: Setup,
    /// The blade that cuts slits.
    pub blade: StraightBlade,
    /// The disc that frees strips.
    pub disc: Disc,
    /// How far the disc's axis leans along its feed; 0 to below 90 degrees. Default 3 degrees [Yu 2019, 3.1].
    pub lead: Sourced<Angle>,
    /// Speed of the disc in the material; positive.
    pub free_feed: Sourced<Speed>,
    /// Height of layers; positive.
    pub layer: Sourced<Auto<Length>>,
    /// Width of strips; positive.
    pub step: Sourced<Auto<Length>>,
    /// How many layers slits go through; at least 1.
    pub through: Sourced<Auto<u32>>,
    /// What becomes of places where a strip of a whole layer would enter the part.
    pub residual: Sourced<Auto<Residual>>,
    /// How far the disc's rim runs beyond the slit of a strip; zero or more and less than its radius. Default 0.5 mm.
    pub beyond: Sourced<Length>,
    /// Nothing below is cut; zero or more. Default 0.
    pub down_to: Sourced<Length>,
    /// Material that must stay on the part, measured along its normal; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// Distance of the straight blade's middle plane from the material that stays; `auto` is half its thickness.
    pub standoff: Sourced<Auto<Length>>,
    /// Bounds.
    pub limits: Limits,
}

/// Bounds on what may be chosen, and on the result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Height of layers.
    pub layer: Bounds<Length>,
    /// Width of strips.
    pub step: Bounds<Length>,
    /// The most material that may stay on the part.
    pub scallop: Option<Sourced<Length>>,
    /// Most changes of blade.
    pub changes: Option<Sourced<f64>>,
    /// Most slits and strips together.
    pub cuts: Option<Sourced<f64>>,
    /// Longest time.
    pub time: Option<Sourced<Duration>>,
}

/// What becomes of places where a strip of a whole layer would enter the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Residual {
    /// They stay.
    Discard,
    /// A last strip of the column ends on the part.
    Lift,
    /// Every layer is cut up to the part, in equal strips.
    Shift,
    /// At every place what keeps the limit on scallop with the fewest strips.
    Mixed,
}

words! {
    Residual { Discard = "discard", Lift = "lift", Shift = "shift", Mixed = "mixed" }
}
