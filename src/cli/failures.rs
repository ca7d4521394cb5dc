//! Failures that several commands report.

use super::args::Arguments;
use super::console::Failure;
use super::files::job_near;
use std::path::Path;

/// A job whose part is the same at every y, where what is left above a surface is asked for.
pub(super) fn without_surface() -> Failure {
    Failure::new("the job's part is a profile, and the deviation is that of a `surface`")
        .help("`vcutc plot JOB --what deviation` draws the deviation from a profile")
}

/// A job on a machine whose torques are not known, where they are asked for.
pub(super) fn without_masses() -> Failure {
    Failure::new("the torques of the job's machine are not known: they take the masses of its links, and the load on its flange")
        .help("state `load = load(mass = , x = , y = , z = )` in the machine, and its masses in a sheet (docs/machines.md)")
}

/// A job without a machine, where axes are asked for.
pub(super) fn without_machine() -> Failure {
    Failure::new("the job has no machine, so there are no axes to show").help(
        "add a block such as `machine cell = robot \"kuka/kr210_r3100_ultra\" { ... }`, or `use` a file that has one",
    )
}

/// A job that cannot be read.
pub(super) fn unreadable(job: &str, reason: &str) -> Failure {
    let failure = Failure::new(format!("cannot read the job {job}: {reason}"));
    if let Some(file) = job_near(job).filter(|_| !Path::new(job).exists()) {
        return failure.help(format!("did you mean the job `{file}`?"));
    }
    match Arguments::command_near(job) {
        Some(command) => failure.help(format!("did you mean the command `vcutc {command}`?")),
        None => failure,
    }
}
