//! `vcutc JOB` and `vcutc check JOB...`: jobs through the pipeline.

use super::args::{Arguments, CheckArgs, CompileArgs, InnerForm, Overrides};
use super::console::{Console, Failure, Summary};
use super::files::Disk;
use super::inner::{self, Progressed};
use super::output::{Destination, Headings, Output};
use super::progress::Progress;
use super::targets;
use super::{Exit, Targets};
use crate::diag::{Diagnostic, has_errors};
use crate::driver::{self, EmitFailure, Outcome, Request, RequestError, Stage};
use std::path::PathBuf;
use std::time::Duration;
use vcutc_backend_api::backend::Backend;

/// What is made of a job.
enum Product {
    /// A program.
    Program(&'static dyn Backend, Destination),
    /// One of its inner forms.
    Inner(InnerForm, Destination),
    /// Nothing: the job is only judged. The remark says why, where that needs saying.
    Verdict {
        /// Why nothing is made of it.
        remark: Option<String>,
    },
}

/// What came of making it.
#[derive(Default)]
struct Made {
    files: Vec<String>,
    diagnostics: Vec<Diagnostic>,
}

/// Compiles one job.
pub(super) fn compile(args: &CompileArgs, targets: &Targets, console: &Console) -> Exit {
    // Without a job clap has printed the help already.
    let job = args.job.as_deref().unwrap_or_default();
    match product(args, targets) {
        Ok(product) => judge(job, &args.overrides, targets, &product, console),
        Err(failure) => console.failure(&failure),
    }
}

/// Checks jobs, each on its own. The worst of them decides how the run ends.
pub(super) fn check(args: &CheckArgs, targets: &Targets, console: &Console) -> Exit {
    let product = Product::Verdict { remark: None };
    args.jobs
        .iter()
        .map(|job| judge(job, &args.overrides, targets, &product, console))
        .max()
        .unwrap_or(Exit::Success)
}

fn product(args: &CompileArgs, targets: &Targets) -> Result<Product, Failure> {
    let output = args.output.as_deref();
    match (&args.target, args.emit) {
        (Some(target), _) => {
            let backend = targets::find(targets, target)?;
            Ok(Product::Program(backend, program_destination(output)))
        }
        (None, Some(form)) => Ok(Product::Inner(form, inner_destination(output))),
        (None, None) => Ok(Product::Verdict {
            remark: Some(format!(
                "no --target was given (targets: {}), so nothing was written",
                targets::names(targets)
            )),
        }),
    }
}

fn program_destination(output: Option<&str>) -> Destination {
    match output {
        None => Destination::Folder(PathBuf::from(".")),
        Some("-") => Destination::Stdout(Headings::Shown),
        Some(folder) => Destination::Folder(PathBuf::from(folder)),
    }
}

fn inner_destination(output: Option<&str>) -> Destination {
    match output {
        None | Some("-") => Destination::Stdout(Headings::Omitted),
        Some(folder) => Destination::Folder(PathBuf::from(folder)),
    }
}

/// Takes one job through the pipeline and tells what came of it.
fn judge(job: &str, overrides: &Overrides, targets: &Targets, product: &Product, console: &Console) -> Exit {
    let disk = Disk::around(job);
    let mut progress = Progress::start(console.shows_progress());
    let request = Request {
        path: disk.job(),
        loader: &disk,
        overrides: &overrides.set,
        machine: overrides.machine.as_deref(),
        targets,
    };
    let outcome = match driver::compile(request, &mut |stage| progress.enter(stage)) {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => {
            drop(progress);
            return console.failure(&unreadable(job, &reason));
        }
    };
    let made = make(product, &outcome, disk.job(), &mut progress);
    let timings = progress.finish();

    match made {
        Ok(made) => tell(disk.job(), outcome, &made, &timings, product, console),
        Err(failure) => {
            console.diagnostics(&outcome.diagnostics, &outcome.sources);
            console.failure(&failure)
        }
    }
}

/// Tells what came of a job.
fn tell(
    job: &str,
    mut outcome: Outcome,
    made: &Made,
    timings: &[(&'static str, Duration)],
    product: &Product,
    console: &Console,
) -> Exit {
    outcome.diagnostics.extend_from_slice(&made.diagnostics);
    let exit = if has_errors(&outcome.diagnostics) {
        Exit::JobHasErrors
    } else {
        Exit::Success
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    console.summary(&Summary {
        job,
        diagnostics: &outcome.diagnostics,
        lines: outcome
            .compiled
            .as_ref()
            .map_or(&[], |compiled| &compiled.summary),
        reach: outcome
            .compiled
            .as_ref()
            .and_then(|compiled| compiled.figures.as_ref()),
        files: &made.files,
        remark: remark(product, exit),
        timings,
    });
    exit
}

/// What needs saying of files that are not there.
fn remark(product: &Product, exit: Exit) -> Option<&str> {
    let is_well = exit == Exit::Success;
    match product {
        Product::Program(..) if !is_well => Some("nothing was written"),
        Product::Verdict { remark } if is_well => remark.as_deref(),
        Product::Program(..) | Product::Inner(..) | Product::Verdict { .. } => None,
    }
}

/// Makes the product of a job that got far enough for it.
fn make(product: &Product, outcome: &Outcome, job: &str, progress: &mut Progress) -> Result<Made, Failure> {
    match product {
        Product::Program(backend, destination) => {
            if outcome.compiled.is_none() {
                return Ok(Made::default());
            }
            progress.enter(Stage::Emitting);
            write_program(*backend, destination, outcome)
        }
        Product::Inner(form, destination) => write_inner(*form, destination, outcome, job),
        Product::Verdict { .. } => Ok(Made::default()),
    }
}

fn write_program(backend: &dyn Backend, to: &Destination, outcome: &Outcome) -> Result<Made, Failure> {
    let mut output = Output::to(to);
    match driver::emit(outcome, backend, &mut output) {
        Ok(()) => published(output),
        Err(EmitFailure::Diagnostics(diagnostics)) => Ok(Made {
            diagnostics,
            ..Made::default()
        }),
        Err(EmitFailure::Sink(reason)) => Err(Failure::new(reason)),
    }
}

fn write_inner(form: InnerForm, to: &Destination, outcome: &Outcome, job: &str) -> Result<Made, Failure> {
    let mut output = Output::to(to);
    match inner::write(form, outcome, job, &mut output) {
        Ok(Progressed::Written) => published(output),
        Ok(Progressed::NotSoFar) => Ok(Made::default()),
        Ok(Progressed::WithoutMachine) => {
            Err(Failure::new("the job has no machine, so there are no axes to show").help(
                "add a block such as `machine cell = robot \"kuka/kr210_r3100_ultra\" { ... }`, or `use` a file that has one",
            ))
        }
        Err(error) => Err(Failure::new(error.to_string())),
    }
}

fn published(output: Output) -> Result<Made, Failure> {
    let files = output.publish().map_err(Failure::new)?;
    Ok(Made {
        files,
        ..Made::default()
    })
}

pub(super) fn unreadable(job: &str, reason: &str) -> Failure {
    let failure = Failure::new(format!("cannot read the job {job}: {reason}"));
    match Arguments::command_near(job) {
        Some(command) => failure.help(format!("did you mean the command `vcutc {command}`?")),
        None => failure,
    }
}
