//! `vcutc plot JOB --what ...`: one picture of a job.

use super::args::{PlotArgs, What};
use super::compile::{unreadable, without_machine};
use super::console::{Console, Failure, Summary};
use super::files::Disk;
use super::output::{Placed, one_file};
use super::patience;
use super::progress::Progress;
use super::{Exit, Targets};
use crate::driver::{Outcome, RequestError};
use crate::memory::Memory;
use crate::picture::Prefix;
use crate::report::{Material, pictures};
use std::path::Path;

/// Draws a picture of one job.
pub(super) fn plot(args: &PlotArgs, targets: &Targets, console: &Console) -> Exit {
    let file = match file(args.output.as_deref()) {
        Ok(file) => file,
        Err(failure) => return console.failure(&failure),
    };
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = args.overrides.request(&disk, targets);
    let budget = console.help_budget();
    let compiled = patience::compile(request, &mut Memory::none(), budget, &mut progress);
    progress.finish();
    let outcome = match compiled {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => return console.failure(&unreadable(&args.job, &reason)),
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    let Some(material) = Material::of(&outcome) else {
        tell(disk.job(), &outcome, &[], Some("nothing was drawn"), console);
        return Exit::JobHasErrors;
    };
    let Some(svg) = picture(args.what, &material) else {
        return console.failure(&without_machine());
    };
    let Some(path) = file else {
        return console.document(&svg);
    };
    let path = Path::new(path);
    match disk.spares(path).and_then(|()| one_file(path, svg.as_bytes())) {
        Ok(placed) => {
            tell(disk.job(), &outcome, &placed, None, console);
            Exit::Success
        }
        Err(reason) => console.failure(&Failure::new(reason)),
    }
}

/// The file to draw into; none for standard output.
fn file(output: Option<&str>) -> Result<Option<&str>, Failure> {
    match output {
        None | Some("-") => Ok(None),
        Some(path) if path.to_ascii_lowercase().ends_with(".svg") => Ok(Some(path)),
        Some(path) => Err(Failure::new(format!(
            "pictures are in SVG: give `-o` the name of a file that ends in .svg, not {path}"
        ))),
    }
}

/// The picture; none where it is about the machine and the job has none.
fn picture(what: What, material: &Material<'_>) -> Option<String> {
    let ids = Prefix::NONE;
    match what {
        What::Lattice => Some(pictures::lattice(material, ids)),
        What::Contour => Some(pictures::contour(material, ids)),
        What::Deviation => Some(pictures::deviation(material, ids)),
        What::Correlation => Some(pictures::correlation(material, ids)),
        What::Joints => pictures::joints(material, ids),
        What::Time => Some(pictures::time(material, ids)),
    }
}

/// Tells what was drawn. The figures are in the picture.
fn tell(job: &str, outcome: &Outcome, placed: &[Placed], remark: Option<&str>, console: &Console) {
    console.summary(&Summary {
        job,
        diagnostics: &outcome.diagnostics,
        lines: &[],
        numbers: None,
        times: None,
        reach: None,
        placed,
        remark,
        timings: &[],
    });
}
