//! `vcutc report JOB -o FILE.html`: all there is to see of a job as one page, or its set-up sheet.

use super::args::ReportArgs;
use super::browser;
use super::console::{Console, Failure};
use super::failures::unreadable;
use super::files::{Disk, stem};
use super::hints::of_a_page;
use super::meant::Driven;
use super::output::{Placed, one_file};
use super::patience::{self, HelpBudget};
use super::progress::Progress;
use super::snapshot::read_back;
use super::summary::Summary;
use super::{Exit, Targets, targets};
use std::path::Path;
use std::slice;
use std::time::Duration;
use vcutc_backend_api::backend::Backend;
use vcutc_diagnostics::has_errors;
use vcutc_driver::checks::ReadBack;
use vcutc_driver::hints::Hint;
use vcutc_driver::memory::Memory;
use vcutc_driver::{self as driver, EmitFailure, Outcome, Request, RequestError, Stage, Typed};
use vcutc_readback::Written;
use vcutc_report::page::{Further, page};
use vcutc_report::sheet::sheet;

/// Reports one job.
pub(super) fn report(args: &ReportArgs, targets: &Targets, console: &Console) -> Exit {
    let disk = Disk::around(&args.job);
    let output = match destination(args, &disk) {
        Ok(output) => output,
        Err(failure) => return console.failure(&failure),
    };
    let mut progress = Progress::start(console.shows_progress());
    let (mut outcome, target) = match compiled(args, targets, &disk, console.help_budget(), &mut progress) {
        Ok(compiled) => compiled,
        Err(failure) => {
            drop(progress);
            return console.failure(&failure);
        }
    };
    progress.enter(Stage::Emitting);
    let found = if args.sheet {
        Vec::new()
    } else {
        of_a_page(&outcome, console.help_budget())
    };
    let written = match target.map(|target| driver::write(&outcome, target)) {
        None => Ok(None),
        Some(Ok(written)) => Ok(written),
        Some(Err(EmitFailure::Diagnostics(refused))) => Err(refused),
        Some(Err(EmitFailure::Sink(reason))) => return console.failure(&Failure::new(reason)),
    };
    let read_back = written.as_ref().ok().and_then(Option::as_ref).map(read_back);
    let page = match written {
        Ok(written) => document(args, &outcome, written.as_ref(), &found),
        Err(refused) => {
            outcome.diagnostics.extend(refused);
            None
        }
    };
    let timings = progress.finish();
    let placed = match page.as_deref().map(|page| write(page, &output, &disk, console)) {
        Some(Err(exit)) => return exit,
        Some(Ok(placed)) => placed,
        None => Vec::new(),
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    summarize(&outcome, read_back, (disk.job(), &placed, &timings), console);
    if args.open && !placed.is_empty() {
        return shown(&output, exit(&outcome), console);
    }
    exit(&outcome)
}

/// The job, compiled with the options of the target whose program is read back, where one is named.
fn compiled(
    args: &ReportArgs,
    targets: &Targets,
    disk: &Disk,
    budget: HelpBudget,
    progress: &mut Progress,
) -> Result<(Outcome, Option<&'static dyn Backend>), Failure> {
    let asking = || Driven::of(slice::from_ref(&args.job), &args.overrides, targets);
    let named = args.target.as_deref();
    let target = named
        .map(|name| targets::find(targets, name, &asking))
        .transpose()?;
    let request = Request {
        options: target.map_or_else(Typed::default, |target| Typed {
            target: target.id(),
            given: &args.options.option,
            beside: "",
        }),
        ..args.overrides.request(disk, targets)
    };
    match patience::compile(request, &mut Memory::none(), budget, progress) {
        Ok(outcome) => Ok((outcome, target)),
        Err(RequestError::Unreadable(reason)) => Err(unreadable(&args.job, &reason)),
    }
}

/// Prints the summary.
fn summarize(
    outcome: &Outcome,
    read_back: Option<ReadBack>,
    (job, placed, timings): (&str, &[Placed], &[(&'static str, Duration)]),
    console: &Console,
) {
    let compiled = outcome.compiled.as_ref();
    console.summary(&Summary {
        job,
        diagnostics: &outcome.diagnostics,
        lines: compiled.map_or(&[], |compiled| &compiled.summary),
        numbers: compiled.map(|compiled| &compiled.numbers),
        times: compiled.map(|compiled| &compiled.times),
        reach: compiled.and_then(|compiled| compiled.figures.as_ref()),
        dynamics: compiled.map(|compiled| &compiled.dynamics),
        checks: compiled.map(|compiled| compiled.checks.with(read_back)),
        parameters: compiled.map_or(&[], |compiled| &compiled.parameters),
        placed,
        remark: has_errors(&outcome.diagnostics).then_some("nothing was written"),
        timings,
    });
}

/// Where the page goes: the file of `-o`, or one named after the job in the current folder.
fn destination(args: &ReportArgs, disk: &Disk) -> Result<String, Failure> {
    let output = match &args.output {
        Some(output) => output.clone(),
        None => format!("{}.html", stem(disk.job())),
    };
    if output == "-" && args.open {
        return Err(
            Failure::new("`--open` shows a file, but `-o -` writes none").help("leave one of the two out")
        );
    }
    if output != "-" && !output.to_ascii_lowercase().ends_with(".html") {
        return Err(Failure::new(format!(
            "the report is a page in HTML: give `-o` the name of a file that ends in .html, not {output}"
        )));
    }
    Ok(output)
}

/// Opens a page that has been written; the run ends as it would have without.
fn shown(page: &str, exit: Exit, console: &Console) -> Exit {
    match browser::open(Path::new(page)) {
        Ok(()) => exit,
        Err(reason) => console.failure(
            &Failure::new(format!("cannot open {page}: {reason}"))
                .help("the page is written: open it by hand, or name a browser in the variable BROWSER"),
        ),
    }
}

/// The report or the sheet, with the files of the program that was written; none while the job has errors.
fn document(
    args: &ReportArgs,
    outcome: &Outcome,
    written: Option<&Written>,
    hints: &[Hint],
) -> Option<String> {
    let read_back = written.map(read_back);
    let files: Vec<(&str, &[u8])> = written
        .into_iter()
        .flat_map(|written| written.bundle.files())
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
        .collect();
    let files = files.as_slice();
    if args.sheet {
        sheet(outcome, files, read_back)
    } else {
        let further = Further {
            files,
            read_back,
            hints,
        };
        page(outcome, further)
    }
}

fn exit(outcome: &Outcome) -> Exit {
    if has_errors(&outcome.diagnostics) {
        Exit::JobHasErrors
    } else {
        Exit::Success
    }
}

/// Writes the page, or reports why not.
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
