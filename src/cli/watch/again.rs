//! A run of a job that is watched: compiled, made into its program and reported, and made once more where something was in the way
//! of its files.

use super::stamps::{Asked, Recorder};
use crate::cli::Targets;
use crate::cli::args::WatchArgs;
use crate::cli::compile::{Product, make, nothing, program_of, report_outcome};
use crate::cli::console::{Console, Failure};
use crate::cli::failures::unreadable;
use crate::cli::files::Disk;
use crate::cli::meant::{Driven, pointless_output};
use crate::cli::patience::Waiting;
use crate::cli::progress::{Following, Progress};
use crate::cli::summary::Summary;
use std::slice;
use std::time::Duration;
use vcutc_cancellation::{Needless, Wanted};
use vcutc_driver::memory::Memory;
use vcutc_driver::{self as driver, Outcome, Request, RequestError, Run};

/// A job that is compiled again and again.
pub(super) struct Watched<'a> {
    args: &'a WatchArgs,
    targets: &'a Targets,
    product: Product,
}

/// What else a run needs.
pub(super) struct Means<'m> {
    /// Which files it asks for.
    pub(super) asked: &'m Asked,
    /// What is kept of runs before.
    pub(super) memory: &'m mut Memory,
    /// Whether the run has not been overtaken.
    pub(super) wanted: &'m Wanted,
    pub(super) console: &'m Console,
}

/// What there is to see of a run.
pub(super) enum Seen<'s> {
    /// The job cannot be read.
    Unreadable(&'s Failure),
    /// The result, and what keeps its program from being written.
    Outcome(&'s Outcome, Option<&'s Failure>),
}

/// How a run ended.
pub(super) enum Came {
    /// All is done and reported.
    Reported,
    /// It was overtaken, and nothing is reported.
    Needless,
    /// All is reported, but the program is not written.
    Unwritten(Box<Unwritten>),
}

/// A program that something is in the way of.
pub(super) struct Unwritten {
    outcome: Outcome,
    failure: Failure,
    timings: Vec<(&'static str, Duration)>,
    /// The files that nothing is written over.
    disk: Disk,
}

impl<'a> Watched<'a> {
    /// What the command line asks for.
    pub(super) fn new(args: &'a WatchArgs, targets: &'a Targets) -> Result<Self, Failure> {
        let output = args.output.as_deref();
        let asking = || Driven::of(slice::from_ref(&args.job), &args.overrides, targets);
        let product = match (&args.target, output) {
            (Some(target), _) => program_of(target, output, &args.options.option, targets, &asking)?,
            (None, Some(output)) => return Err(pointless_output(output, targets, &asking())),
            (None, None) if args.serve.is_some() => Product::Verdict { remark: None },
            (None, None) => nothing(targets),
        };
        Ok(Self {
            args,
            targets,
            product,
        })
    }

    /// The job's path as given.
    pub(super) fn job(&self) -> &'a str {
        &self.args.job
    }

    /// Compiles the job once more. `see` gets the result before it is reported.
    pub(super) fn run(&self, means: Means<'_>, see: &dyn Fn(&Seen<'_>)) -> Came {
        let Means {
            asked,
            memory,
            wanted,
            console,
        } = means;
        let mut progress = Progress::start(console.shows_progress());
        let disk = Disk::around(self.job());
        let request = Request {
            loader: &Recorder::new(&disk, asked),
            options: self.product.typed(),
            ..self.args.overrides.request(&disk, self.targets)
        };
        let enter = &mut |stage| progress.enter(stage);
        let run = Run {
            memory,
            wanted,
            patience: &mut Waiting::unseen(console.help_budget()),
        };
        let outcome = match wanted.answer(|| driver::compile_in(run, request, enter)) {
            Err(Needless) => return Came::Needless,
            Ok(Err(RequestError::Unreadable(reason))) => {
                drop(progress);
                let failure = unreadable(self.job(), &reason);
                see(&Seen::Unreadable(&failure));
                console.fruitless(&failure, &self.summary(None, &[]));
                return Came::Reported;
            }
            Ok(Ok(outcome)) => outcome,
        };
        see(&Seen::Outcome(&outcome, None));
        let made = make(&self.product, &outcome, &disk, console.warnings(), &mut progress);
        let timings = progress.finish();
        match made {
            Ok(made) => {
                report_outcome(self.job(), &outcome, &made, &timings, &self.product, console);
                Came::Reported
            }
            Err(failure) => {
                see(&Seen::Outcome(&outcome, Some(&failure)));
                console.diagnostics(&outcome.diagnostics, &outcome.sources);
                console.fruitless(&failure, &self.summary(Some(&outcome), &timings));
                Came::Unwritten(Box::new(Unwritten {
                    outcome,
                    failure,
                    timings,
                    disk,
                }))
            }
        }
    }

    /// Tries once more to write a program. Nothing is reported while the same is in its way.
    pub(super) fn write_again(
        &self,
        mut unwritten: Box<Unwritten>,
        console: &Console,
        see: &dyn Fn(&Seen<'_>),
    ) -> Came {
        let outcome = &unwritten.outcome;
        let mut progress = Progress::start(Following::Silent);
        match make(
            &self.product,
            outcome,
            &unwritten.disk,
            console.warnings(),
            &mut progress,
        ) {
            Ok(made) => {
                see(&Seen::Outcome(outcome, None));
                console.clear_screen();
                report_outcome(
                    self.job(),
                    outcome,
                    &made,
                    &unwritten.timings,
                    &self.product,
                    console,
                );
                Came::Reported
            }
            Err(failure) => {
                if failure != unwritten.failure {
                    see(&Seen::Outcome(outcome, Some(&failure)));
                    console.fruitless(&failure, &self.summary(Some(outcome), &unwritten.timings));
                    unwritten.failure = failure;
                }
                Came::Unwritten(unwritten)
            }
        }
    }

    /// The summary of a run without a program.
    fn summary<'s>(
        &'s self,
        outcome: Option<&'s Outcome>,
        timings: &'s [(&'static str, Duration)],
    ) -> Summary<'s> {
        let compiled = outcome.and_then(|outcome| outcome.compiled.as_ref());
        Summary {
            job: self.job(),
            diagnostics: outcome.map_or(&[], |outcome| &outcome.diagnostics),
            lines: compiled.map_or(&[], |compiled| &compiled.summary),
            numbers: compiled.map(|compiled| &compiled.numbers),
            times: compiled.map(|compiled| &compiled.times),
            reach: compiled.and_then(|compiled| compiled.figures.as_ref()),
            dynamics: compiled.map(|compiled| &compiled.dynamics),
            checks: compiled.map(|compiled| compiled.checks.clone()),
            parameters: compiled.map_or(&[], |compiled| &compiled.parameters),
            placed: &[],
            remark: None,
            timings,
        }
    }
}
