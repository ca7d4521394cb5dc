//! `vcutc optimize JOB`: what open parameters come out as, what binds them, and what a finer surface would cost.

use super::args::OptimizeArgs;
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::{Destination, Output, Placed};
use super::progress::Progress;
use super::{Exit, Targets};
use crate::driver::{Request, Typed};
use crate::optimisation::{self, Optimisation, Refusal, report};
use std::path::{Path, PathBuf};
use vcutc_backend_api::bundle::Sink;

/// Optimises one job.
pub(super) fn optimize(args: &OptimizeArgs, targets: &Targets, console: &Console) -> Exit {
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = Request {
        path: disk.job(),
        loader: &disk,
        overrides: &args.overrides.set,
        machine: args.overrides.machine.as_deref(),
        options: Typed::default(),
        targets,
    };
    let optimised = optimisation::optimise(request, args.points, &mut |stage| progress.enter(stage));
    progress.finish();
    match optimised {
        Ok(optimisation) => tell(&optimisation, args.output.as_deref(), console),
        Err(Refusal::Unreadable(reason)) => console.failure(&Failure::new(format!(
            "cannot read the job {}: {reason}",
            args.job
        ))),
        Err(Refusal::Diagnostics(diagnostics, sources)) => {
            console.diagnostics(&diagnostics, &sources);
            Exit::JobHasErrors
        }
    }
}

fn tell(optimisation: &Optimisation, output: Option<&str>, console: &Console) -> Exit {
    console.diagnostics(&optimisation.warnings, &optimisation.sources);
    let written = match output
        .map(|path| write_pictures(optimisation, Path::new(path)))
        .transpose()
    {
        Ok(files) => files.unwrap_or_default(),
        Err(reason) => return console.failure(&Failure::new(reason)),
    };
    let mut text = report::text(optimisation);
    for file in &written {
        text += &format!("\nwrote {}\n", file.path());
    }
    console.answer("optimisation", &text, report::body(optimisation))
}

/// Writes the Pareto picture of each operation, all or none: into the file that is named, or files of a folder.
fn write_pictures(optimisation: &Optimisation, path: &Path) -> Result<Vec<Placed>, String> {
    let (folder, stem) = folder_and_stem(path, &optimisation.job)?;
    let mut output = Output::to(&Destination::Folder(folder));
    let alone = optimisation.operations.len() == 1;
    for operation in &optimisation.operations {
        let name = if alone {
            format!("{stem}.svg")
        } else {
            format!("{stem}_{}.svg", operation.number)
        };
        output.file(&name).map_err(|error| error.to_string())?;
        output
            .write(optimisation.svg(operation).as_bytes())
            .map_err(|error| error.to_string())?;
    }
    output.publish()
}

/// `out/rib.svg` is the folder `out` and the stem `rib`; anything else is a folder, and the stem says what is in it.
fn folder_and_stem(path: &Path, job: &str) -> Result<(PathBuf, String), String> {
    let is_picture = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
    if !is_picture {
        return Ok((path.to_owned(), format!("{job}_pareto")));
    }
    let stem = path
        .file_stem()
        .and_then(|stem| stem.to_str())
        .ok_or_else(|| format!("{} is no name for a file", path.display()))?;
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        Some(_) | None => PathBuf::from("."),
    };
    Ok((folder, stem.to_owned()))
}
