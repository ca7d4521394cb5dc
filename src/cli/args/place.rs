//! What `vcutc place` is asked.

use super::Overrides;
use clap::{Args, ValueEnum};
use vcutc_place::Objective;

#[derive(Debug, Args)]
pub(in crate::cli) struct PlaceArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// What the place is to be best in
    #[arg(long, value_name = "OBJECTIVE", value_enum, default_value_t = ObjectiveWord::Margin)]
    pub(in crate::cli) objective: ObjectiveWord,

    /// The range for x of the base, in the machine's root [default: within 500 mm of its present value]
    ///
    /// A range such as 1000..2500 (in mm) or 1 m..2.5 m, or a single fixed value.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(in crate::cli) x: Option<String>,

    /// The range for y of the base [default: within 500 mm of its present value]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(in crate::cli) y: Option<String>,

    /// The range for z of the base [default: within 300 mm of its present value]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(in crate::cli) z: Option<String>,

    /// The range of rotation of the work about the root's z, relative to its present value [default: -90..90 deg]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(in crate::cli) yaw: Option<String>,

    /// Draw a map of the margin, or of the deviation, over x and y into this file
    #[arg(short, long, value_name = "FILE.svg")]
    pub(in crate::cli) output: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

/// What a place is to be best in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ObjectiveWord {
    /// The largest margin of the axes and from singular poses
    Margin,
    /// The smallest deviation of the cuts, with a margin of at least 10 %
    Deviation,
}

impl From<ObjectiveWord> for Objective {
    fn from(word: ObjectiveWord) -> Self {
        match word {
            ObjectiveWord::Margin => Self::Margin,
            ObjectiveWord::Deviation => Self::Deviation,
        }
    }
}
