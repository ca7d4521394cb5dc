//! How hard to search.

use clap::{Args, ValueEnum};
use vcutc_driver::SearchEffort;

/// The option that says so.
#[derive(Clone, Copy, Debug, Args)]
pub(in crate::cli) struct EffortArg {
    /// How hard to search for the parameters of V cuts that the job leaves open
    ///
    /// `high` makes up to ten times as many plans. Programs differ, and so do the hashes in their heads.
    #[arg(long, value_name = "EFFORT", value_enum, default_value_t = EffortWord::Normal)]
    pub(in crate::cli) effort: EffortWord,
}

/// How hard to search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum EffortWord {
    Normal,
    High,
}

impl From<EffortWord> for SearchEffort {
    fn from(word: EffortWord) -> Self {
        match word {
            EffortWord::Normal => Self::Normal,
            EffortWord::High => Self::High,
        }
    }
}
