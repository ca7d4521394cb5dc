//! What `vcutc tools` is given.

use super::Overrides;
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(in crate::cli) struct ToolsArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// Write the tools in this form [default: print a table]
    #[arg(long, value_enum, value_name = "FORM")]
    pub(in crate::cli) emit: Option<ToolForm>,

    /// For apt and csv, the file or - for standard output (the default); for fctb and stl, the folder (default: the current one)
    ///
    /// Files in a folder are named after the tools, which are named after the blades: long_dagger_cylinder.stl and so on.
    #[arg(short, long, value_name = "FILE|DIR|-", requires = "emit")]
    pub(in crate::cli) output: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

/// What `vcutc tools --emit` writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ToolForm {
    /// Statements CUTTER of APT, for CATIA, NX and Vericut
    Apt,
    /// A line for each tool
    Csv,
    /// Tool bits of FreeCAD, a file each
    Fctb,
    /// Solids as facets, a file each
    Stl,
}
