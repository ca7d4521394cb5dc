//! What a job asks of finishing with a disc.

use vcutc_backend_api::units::{Angle, Length};
use vcutc_job::{Auto, Disc, Setup, Sourced, words};

/// Air that the body of the disc keeps from what stands: a judgement, from no source.
pub(crate) const AIR: Length = Length::mm(1.0);

/// Finishing with a disc. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct FinishDisc {
    /// What all operations state. Its rake is that of the tilt that the lead leaves.
    pub setup: Setup,
    pub disc: Disc,
    /// Distance of tracks over x; positive.
    pub step: Sourced<Auto<Length>>,
    /// How far the disc's axis leans along its feed, seen from the normal of the part; above 0 and below 90 degrees.
    pub lead: Sourced<Auto<Angle>>,
    /// How far it leans to the side that tracks step to; zero or more.
    pub side: Sourced<Auto<Angle>>,
    /// In which order the tracks are cut.
    pub sequence: Sourced<Auto<Sequence>>,
    /// The least lead where it is left open; above 0 and below 90 degrees. Default 3 degrees [Yu 2019, 3.1].
    pub relief: Sourced<Angle>,
    /// How thick a strip may be that runs over the body of the disc; zero or more. Default 0.
    pub over_hub: Sourced<Length>,
    /// Material that must stay on the part, measured along its normal; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    pub limits: Limits,
}

/// Bounds on what may be chosen, and on the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The most material that may stay on the part, with the allowance.
    pub scallop: Sourced<Length>,
    /// The greatest lead where it is left open; above 0 and below 90 degrees. Default 15 degrees.
    pub lead: Sourced<Angle>,
}

/// In which order tracks are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sequence {
    /// From every crest of the part down to both sides, the highest crest first.
    Crests,
    /// The highest one first, whatever side of a crest it is on: "from high to low" [Yang, Hu, Wang].
    Descending,
    /// Towards +x.
    Rightwards,
    /// Towards -x.
    Leftwards,
}

words! {
    Sequence { Crests = "crests", Descending = "descending", Rightwards = "rightwards", Leftwards = "leftwards" }
}
