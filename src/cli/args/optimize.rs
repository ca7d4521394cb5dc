//! What `vcutc optimize` is asked.

use super::Overrides;
use clap::{Args, ValueEnum};
use vcutc_optimize::Against;

#[derive(Debug, Args)]
pub(in crate::cli) struct OptimizeArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// What time is traded against: plans are made under a series of limits on it
    #[arg(long, value_name = "MEASURE", value_enum, default_value_t = AgainstWord::Scallop)]
    pub(in crate::cli) against: AgainstWord,

    /// The number of limits to try for the trade-off
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(2..=100))]
    pub(in crate::cli) points: u32,

    /// Draw the trade-off in this file
    ///
    /// A job with several operations gets one picture for each, with its number after the name.
    #[arg(short, long, value_name = "FILE.svg")]
    pub(in crate::cli) output: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

/// A measure of plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum AgainstWord {
    /// The most material that is left on the part
    Scallop,
    /// The number of cuts
    Cuts,
    /// The longest edge in use
    Edge,
}

impl From<AgainstWord> for Against {
    fn from(word: AgainstWord) -> Self {
        match word {
            AgainstWord::Scallop => Self::Scallop,
            AgainstWord::Cuts => Self::Cuts,
            AgainstWord::Edge => Self::Edge,
        }
    }
}
