//! What `vcutc report` and `vcutc plot` are given.

use super::{Overrides, TargetOptions};
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(in crate::cli) job: String,

    /// The file to write, or - for standard output
    ///
    /// The default is JOB.html in the current folder.
    #[arg(short, long, value_name = "FILE.html|-")]
    pub(in crate::cli) output: Option<String>,

    /// Open the page in a browser: the one in the variable BROWSER, or the system default
    #[arg(long)]
    pub(in crate::cli) open: bool,

    /// Write the set-up sheet instead: one page to print, for the operator
    ///
    /// It shows the blade, frames with a sketch of the work's zero, the stock, cuts by layer, the time, and what to
    /// check by hand.
    #[arg(long)]
    pub(in crate::cli) sheet: bool,

    /// List the program files for this target, with their SHA-256
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

    /// For one picture, the file or - for standard output (the default); for all, the folder (default: the current one)
    ///
    /// Pictures are named after the job: rib_lattice.svg, rib_contour.svg and so on. Those about axes need a machine, those of torques and of the deviation by forces an arm and blades of which these are known, that of processes `rough auto`, those of the surface, its curvature and class, and the residual a `surface` (or `clear pocket`), those of finishing and of the tilt a `surface` and `finish disc`, that of tracks `finish disc`, that of passes `clear pocket`, `slit walls` or `free pocket`.
    #[arg(short, long, value_name = "FILE.svg|DIR|-")]
    pub(in crate::cli) output: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) overrides: Overrides,
}

/// What `vcutc plot` draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum What {
    /// The tips of all cuts, coloured by origin, with their flanks and layers
    Lattice,
    /// The part, the machined contour, the chips, and the highest scallop
    Contour,
    /// The distance between the machined contour and the part, along the profile
    Deviation,
    /// The correlation of machined contour and part, shifted against each other
    Correlation,
    /// Positions, speeds and margins of the machine's axes over time
    Joints,
    /// The torques of an arm's axes over time, with the most that each needs anywhere
    Torques,
    /// How far the forces of the blade push each cut off, along the profile
    DeviationByForces,
    /// The time by kind of motion and by layer
    Time,
    /// The times of both processes of `rough auto` over the depth of the work, and where they cross
    Process,
    /// The height of a part that changes along y, from above
    Surface,
    /// The greatest curvature of such a part at each place, positive where it is hollow, with the smallest hollow radius
    Curvature,
    /// What such a part is like at each place: bowl, trough, saddle, flat, ridge or dome
    Class,
    /// How high material stands above such a part after all cuts, each cell at its worst place; of pockets, the ground that stays
    Residual,
    /// How high material stands above such a part after `finish disc`, in sections across its tracks
    Finished,
    /// How far the disc of `finish disc` leans from the normal of such a part, each cell where it is the largest
    Tilt,
    /// The tracks of `finish disc` from above, with their directions and the ways between them
    Tracks,
    /// The passes of pockets from above, coloured by how much of the tool's rim is in the material, and the slits along walls
    Passes,
    /// The wave of the sound field that a pocket is cleared along, and its zero lines
    Field,
}
