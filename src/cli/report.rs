//! `vcutc report JOB -o FILE.html`: all there is to see of a job as one page, or its set-up sheet.

use super::args::ReportArgs;
use super::compile::unreadable;
use super::console::{Console, Failure, Summary};
use super::files::Disk;
use super::output::{Placed, one_file};
use super::progress::Progress;
use super::{Exit, Targets, targets};
use crate::diag::has_errors;
use crate::driver::{self, EmitFailure, Outcome, Request, RequestError, Stage, Typed};
use crate::report::page::page;
use crate::report::sheet::sheet;
use std::path::Path;
use vcutc_backend_api::backend::Backend;

/// Reports one job.
pub(super) fn report(args: &ReportArgs, targets: &Targets, console: &Console) -> Exit {
    if args.output != "-" && !args.output.to_ascii_lowercase().ends_with(".html") {
        return console.failure(&Failure::new(format!(
            "the report is a page in HTML: give `-o` the name of a file that ends in .html, not {}",
            args.output
        )));
    }
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let target = match args
        .target
        .as_deref()
        .map(|name| targets::find(targets, name))
        .transpose()
    {
        Ok(target) => target,
        Err(failure) => return console.failure(&failure),
    };
    let request = Request {
        options: target.map_or_else(Typed::default, |target| Typed {
            target: target.id(),
            given: &args.options.option,
            beside: "",
        }),
        ..args.overrides.request(&disk, targets)
    };
    let mut outcome = match driver::compile(request, &mut |stage| progress.enter(stage)) {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => {
            drop(progress);
            return console.failure(&unreadable(&args.job, &reason));
        }
    };
    progress.enter(Stage::Emitting);
    let page = match document(args, target, &outcome) {
        Ok(page) => page,
        Err(EmitFailure::Diagnostics(refused)) => {
            outcome.diagnostics.extend(refused);
            None
        }
        Err(EmitFailure::Sink(reason)) => return console.failure(&Failure::new(reason)),
    };
    let timings = progress.finish();
    let placed = match page
        .as_deref()
        .map(|page| write(page, &args.output, &disk, console))
    {
        Some(Err(exit)) => return exit,
        Some(Ok(placed)) => placed,
        None => Vec::new(),
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    let compiled = outcome.compiled.as_ref();
    console.summary(&Summary {
        job: disk.job(),
        diagnostics: &outcome.diagnostics,
        lines: compiled.map_or(&[], |compiled| &compiled.summary),
        numbers: compiled.map(|compiled| &compiled.numbers),
        times: compiled.map(|compiled| &compiled.times),
        reach: compiled.and_then(|compiled| compiled.figures.as_ref()),
        placed: &placed,
        remark: has_errors(&outcome.diagnostics).then_some("nothing was written"),
        timings: &timings,
    });
    exit(&outcome)
}

/// The report or the sheet; none while the job has errors.
fn document(
    args: &ReportArgs,
    target: Option<&'static dyn Backend>,
    outcome: &Outcome,
) -> Result<Option<String>, EmitFailure> {
    if !args.sheet {
        return Ok(page(outcome));
    }
    let written = match target {
        Some(target) => driver::write(outcome, target)?,
        None => None,
    };
    let files: Vec<(&str, &[u8])> = written
        .iter()
        .flat_map(|written| written.bundle.files())
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
        .collect();
    Ok(sheet(outcome, &files))
}

fn exit(outcome: &Outcome) -> Exit {
    if has_errors(&outcome.diagnostics) {
        Exit::JobHasErrors
    } else {
        Exit::Success
    }
}

/// Writes the page, or tells why not.
fn write(page: &str, to: &str, disk: &Disk, console: &Console) -> Result<Vec<Placed>, Exit> {
    if to == "-" {
        return match console.document(page) {
            Exit::Success => Ok(Vec::new()),
            exit @ (Exit::JobHasErrors | Exit::CannotRun) => Err(exit),
        };
    }
    let to = Path::new(to);
    disk.spares(to)
        .and_then(|()| one_file(to, page.as_bytes()))
        .map_err(|reason| console.failure(&Failure::new(reason)))
}
