//! The forms that a job has between its text and the program.

use clap::ValueEnum;

/// What `--emit` shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum InnerForm {
    /// The syntax tree, for people who work on the compiler
    Ast,
    /// The planned cuts, as CSV with a row for each
    Plan,
    /// The verified intermediate program, as JSON
    Ir,
    /// The machine's axis values along the program, as CSV with a row at least every 5 mm or 2 degrees
    Joints,
    /// The torques of a robot's axes at the same places, as CSV: of its weight, and of its motion
    Dynamics,
    /// A part given as `surface`, as PLY with the height that straight cuts leave above each vertex, for MeshLab and CloudCompare
    Deviation,
}
