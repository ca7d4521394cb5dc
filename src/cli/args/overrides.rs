//! What the command line says over what a job says, and how hard to search.

use crate::cli::Targets;
use crate::cli::files::Disk;
use clap::{Args, ValueEnum};
use vcutc_driver::{Request, SearchEffort, Typed};
use vcutc_registry::OPERATIONS;

/// What the command line says over what the job says.
#[derive(Debug, Args)]
pub(in crate::cli) struct Overrides {
    /// Replace the value of a `let` of the job; can be given several times
    ///
    /// Write the value as in the job, with its unit: --set width=90mm, --set 'height = 2 in'.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    /// Use this machine of the job, regardless of its `cell` block
    ///
    /// For jobs that define or use several machines, such as all cells of a shop.
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) machine: Option<String>,

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

impl Overrides {
    /// To compile a job with them, whatever its target.
    pub(in crate::cli) fn request<'a>(&'a self, disk: &'a Disk, targets: &'a Targets) -> Request<'a> {
        Request {
            path: disk.job(),
            loader: disk,
            overrides: &self.set,
            machine: self.machine.as_deref(),
            options: Typed::default(),
            effort: self.effort.into(),
            operations: OPERATIONS,
            targets,
        }
    }
}
