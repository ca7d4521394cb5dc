//! What the command line says over what a job says.

use super::effort::EffortArg;
use crate::cli::Targets;
use crate::cli::files::Disk;
use clap::Args;
use vcutc_driver::{Request, Typed};
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

    #[command(flatten)]
    pub(in crate::cli) effort: EffortArg,
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
            effort: self.effort.effort.into(),
            operations: OPERATIONS,
            targets,
        }
    }
}
