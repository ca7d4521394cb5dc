//! `vcutc JOB` and `vcutc check JOB...`: jobs through the pipeline.

use super::args::{Arguments, CheckArgs, CompileArgs, InnerForm};
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
use vcutc_backend_api::backend::Backend;

/// What is made of a job.
enum Product {
    /// A program.
    Program(&'static dyn Backend, Destination),
    /// One of its inner forms.
    Inner(InnerForm, Destination),
    /// Nothing: the job is only judged. The remark says why, where that is not plain.
    Verdict(Option<String>),
}

/// What came of making it.
#[derive(Default)]
struct Made {
    files: Vec<String>,
    diagnostics: Vec<Diagnostic>,
    remark: Option<String>,
}

/// Compiles one job.
pub(super) fn compile(args: &CompileArgs, targets: &Targets, console: &Console) -> Exit {
    // Without a job clap has printed the help already.
    let job = args.job.as_deref().unwrap_or_default();
    match product(args, targets) {
        Ok(product) => judge(job, &args.overrides.set, &product, console),
        Err(failure) => console.failure(&failure),
    }
}

/// Checks jobs, each on its own. The worst of them decides how the run ends.
pub(super) fn check(args: &CheckArgs, console: &Console) -> Exit {
    let product = Product::Verdict(None);
    args.jobs
        .iter()
        .map(|job| judge(job, &args.overrides.set, &product, console))
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
        (None, None) => Ok(Product::Verdict(Some(format!(
            "nothing was written because no --target was given (targets: {})",
            targets::names(targets)
        )))),
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
fn judge(job: &str, overrides: &[String], product: &Product, console: &Console) -> Exit {
    let disk = Disk::around(job);
    let mut progress = Progress::start(console.shows_progress());
    let request = Request {
        path: disk.job(),
        loader: &disk,
        overrides,
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

    let (made, failure) = match made {
        Ok(made) => (made, None),
        Err(failure) => (Made::default(), Some(failure)),
    };
    let diagnostics = [outcome.diagnostics, made.diagnostics].concat();
    console.diagnostics(&diagnostics, &outcome.sources);
    if let Some(failure) = failure {
        return console.failure(&failure);
    }
    console.summary(&Summary {
        job: disk.job(),
        diagnostics: &diagnostics,
        lines: outcome
            .compiled
            .as_ref()
            .map_or(&[], |compiled| &compiled.summary),
        files: &made.files,
        remark: made.remark,
        timings: &timings,
    });
    if has_errors(&diagnostics) {
        Exit::JobHasErrors
    } else {
        Exit::Success
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
        Product::Verdict(remark) => Ok(Made {
            remark: remark.clone(),
            ..Made::default()
        }),
    }
}

fn write_program(backend: &dyn Backend, to: &Destination, outcome: &Outcome) -> Result<Made, Failure> {
    let mut output = Output::open(to).map_err(Failure::new)?;
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
    let mut output = Output::open(to).map_err(Failure::new)?;
    match inner::write(form, outcome, job, &mut output) {
        Ok(Progressed::Written) => published(output),
        Ok(Progressed::NotSoFar) => Ok(Made::default()),
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

fn unreadable(job: &str, reason: &str) -> Failure {
    let failure = Failure::new(format!("cannot read the job {job}: {reason}"));
    match Arguments::command_near(job) {
        Some(command) => failure.help(format!("did you mean the command `vcutc {command}`?")),
        None => failure,
    }
}
