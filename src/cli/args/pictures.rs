//! What `vcutc report` and `vcutc plot` are given.

use super::{Overrides, TargetOptions};
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// The file to write, or - for standard output
    ///
    /// Without it: JOB.html in the current folder.
    #[arg(short, long, value_name = "FILE.html|-")]
    pub(in crate::cli) output: Option<String>,

    /// Open the page in a browser: that of the variable BROWSER, or the system's
    #[arg(long)]
    pub(in crate::cli) open: bool,

    /// Write the set-up sheet instead: one page to print, for the person at the machine
    ///
    /// Blade, frames with a sketch of the work's zero, stock, cuts by layer, time, and what has to be checked by hand.
    #[arg(long)]
    pub(in crate::cli) sheet: bool,

    /// Name the files of the program for this target, with their SHA-256
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) target: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) options: TargetOptions,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct PlotArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// What to draw [default: all pictures]
    #[arg(long, value_enum, value_name = "PICTURE")]
    pub(in crate::cli) what: Option<What>,

    /// One picture: the file to draw into, or - for standard output (the default); all: the folder (the current one by default)
    ///
    /// All pictures are named after the job: rib_lattice.svg, rib_contour.svg and so on. Those about axes need a machine.
    #[arg(short, long, value_name = "FILE.svg|DIR|-")]
    pub(in crate::cli) output: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

/// What `vcutc plot` draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum What {
    /// The tips of all cuts by how they came to be there, their flanks and layers
    Lattice,
    /// The part, the machined contour, the chips, and the highest scallop
    Contour,
    /// How far the machined contour stands off the part, all along it
    Deviation,
    /// How machined contour and part correlate, shifted against each other
    Correlation,
    /// Angles, rates and margins of the machine's axes over time
    Joints,
    /// What the time is spent on, by kind of motion and by layer
    Time,
}
