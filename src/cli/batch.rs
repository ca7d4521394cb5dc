//! Several programs in one run: compiled side by side, reported in order, each written whole or not at all.
//!
//! Nothing is written before all are compiled, since only then it is known whether two of them want the same file. Each job
//! gets a thread; what its own proof does in parallel goes to the one pool that all share, so there are never more proofs at
//! work than processors.

use super::baseline::Keeper;
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::{Destination, Placed};
use super::snapshot::{self, Complete, Fate, Made, NotReady};
use super::summary::Summary;
use super::warnings::Warnings;
use super::{Exit, Targets, failures, targets};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic, has_errors};
use vcutc_driver::checks::Checks;
use vcutc_driver::numbers::Numbers;
use vcutc_driver::numbers::baseline::{Name, Record};
use vcutc_driver::summary::chosen::OperationFigures;
use vcutc_driver::summary::times::TimeFigures;
use vcutc_driver::{self as driver, Request, RequestError, SearchEffort, Typed};
use vcutc_registry::OPERATIONS;

/// One program to make.
pub(super) struct Unit {
    /// The job's file.
    pub(super) job: String,
    /// Who writes the program.
    pub(super) backend: &'static dyn Backend,
    /// The folder that it goes to.
    pub(super) folder: PathBuf,
    /// As `--air-cut`.
    pub(super) air_cut: Option<Length>,
    /// As `--set`.
    pub(super) set: Vec<String>,
    /// As `--machine`.
    pub(super) machine: Option<String>,
    /// As `--option`.
    pub(super) options: Vec<String>,
    /// The file that names of files in options are relative to.
    pub(super) beside: String,
    /// Where a list of programs asks for it.
    pub(super) asked_at: Option<Span>,
    /// What its figures are kept under.
    pub(super) recorded_as: Option<Name>,
}

/// Who asks for programs: a list.
pub(super) struct Asking<'a> {
    pub(super) sources: &'a SourceMap,
    /// The figures that it holds programs to.
    pub(super) keeper: Option<&'a Keeper>,
}

/// The result of a run.
pub(super) struct Ran {
    pub(super) exit: Exit,
    /// The figures of the programs that were made.
    pub(super) records: Vec<Record>,
}

impl From<Exit> for Ran {
    fn from(exit: Exit) -> Self {
        Self {
            exit,
            records: Vec::new(),
        }
    }
}

/// The figures of a program.
struct Figures {
    numbers: Numbers,
    times: TimeFigures,
    checks: Checks,
    parameters: Vec<OperationFigures>,
}

/// A program that was made, or why not.
struct Done {
    sources: SourceMap,
    diagnostics: Vec<Diagnostic>,
    figures: Option<Figures>,
    made: Result<Option<Complete>, Failure>,
}

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Written,
    Unchanged,
    Different,
    Failed,
}

/// How all of them ended.
#[derive(Default, Serialize)]
struct Total {
    programs: usize,
    written: usize,
    unchanged: usize,
    different: usize,
    failed: usize,
    seconds: f64,
}

/// Makes all programs.
pub(super) fn run(
    units: &[Unit],
    fate: Fate,
    targets: &Targets,
    list: Option<&Asking<'_>>,
    console: &Console,
) -> Ran {
    let start = Instant::now();
    let done = all(units, fate, targets);
    if let Some((first, second, name)) = same_file(units, &done) {
        return refuse(first, second, &name, list.map(|list| list.sources), console).into();
    }
    let mut ran = Ran::from(Exit::Success);
    let mut total = Total {
        programs: units.len(),
        ..Total::default()
    };
    for (unit, done) in units.iter().zip(done) {
        let numbers = done.figures.as_ref().map(|figures| figures.numbers.clone());
        let record = unit.recorded_as.clone().zip(numbers);
        let (end, ended) = settle(unit, done, fate, list, console);
        match end {
            End::Written => total.written += 1,
            End::Unchanged => total.unchanged += 1,
            End::Different => total.different += 1,
            End::Failed => total.failed += 1,
        }
        ran.exit = ran.exit.max(ended);
        if end != End::Failed {
            ran.records
                .extend(record.map(|(name, numbers)| Record { name, numbers }));
        }
    }
    total.seconds = start.elapsed().as_secs_f64();
    console.total(&total.in_words(), &total);
    ran
}

/// Compiles all of them, on as many threads as there are processors.
fn all(units: &[Unit], fate: Fate, targets: &Targets) -> Vec<Done> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(BTreeMap::new());
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(unit) = units.get(index) else { return };
            let one = make(unit, fate, targets);
            if let Ok(mut done) = done.lock() {
                done.insert(index, one);
            }
        }
    };
    let threads = thread::available_parallelism()
        .map_or(1, usize::from)
        .min(units.len());
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    done.into_inner().unwrap_or_default().into_values().collect()
}

fn make(unit: &Unit, fate: Fate, targets: &Targets) -> Done {
    let disk = Disk::around(&unit.job);
    let request = Request {
        path: disk.job(),
        loader: &disk,
        overrides: &unit.set,
        machine: unit.machine.as_deref(),
        options: Typed {
            target: unit.backend.id(),
            given: &unit.options,
            beside: &unit.beside,
        },
        effort: SearchEffort::Normal,
        operations: OPERATIONS,
        targets,
    };
    let mut outcome = match driver::compile(request, &mut |_| {}) {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => {
            return Done {
                sources: SourceMap::default(),
                diagnostics: Vec::new(),
                figures: None,
                made: Err(failures::unreadable(&unit.job, &reason)),
            };
        }
    };
    if let Some(height) = unit.air_cut {
        driver::into_air_cut(&mut outcome, height, &mut |_| {});
    }
    let to = Destination::Folder(unit.folder.clone());
    let made = match snapshot::make(&outcome, unit.backend, &to, fate) {
        Ok(made) => Ok(made),
        Err(NotReady::Diagnostics(diagnostics)) => {
            outcome.diagnostics.extend(diagnostics);
            Ok(None)
        }
        Err(NotReady::Trouble(reason)) => Err(Failure::new(reason)),
    };
    Done {
        sources: outcome.sources,
        diagnostics: outcome.diagnostics,
        figures: outcome
            .compiled
            .filter(|compiled| compiled.numbers_of_cuts().is_some())
            .map(|compiled| Figures {
                numbers: compiled.numbers,
                times: compiled.times,
                checks: compiled.checks,
                parameters: compiled.parameters,
            }),
        made,
    }
}

/// Two programs with a file of one name in one folder, whatever its case.
fn same_file<'u>(units: &'u [Unit], done: &[Done]) -> Option<(&'u Unit, &'u Unit, String)> {
    let mut first: BTreeMap<String, &Unit> = BTreeMap::new();
    for (unit, done) in units.iter().zip(done) {
        let Ok(Some(complete)) = &done.made else {
            continue;
        };
        for name in &complete.names {
            let path = unit.folder.join(name).display().to_string();
            if let Some(earlier) = first.insert(path.to_lowercase(), unit) {
                return Some((earlier, unit, path));
            }
        }
    }
    None
}

fn refuse(first: &Unit, second: &Unit, path: &str, list: Option<&SourceMap>, console: &Console) -> Exit {
    let message = if first.job == second.job {
        format!("{} would write {path} twice", first.job)
    } else {
        format!("{} and {} would both write {path}", first.job, second.job)
    };
    let help = "give them separate folders, or rename one of the jobs; nothing was written";
    if let (Some(sources), Some(first), Some(place)) = (list, first.asked_at, second.asked_at) {
        let diagnostic = Diagnostic::new(Code::SameFile, message, place, "asked for here");
        let diagnostic = if first == place {
            diagnostic
        } else {
            diagnostic.and(first, "and here")
        };
        console.diagnostics(&[diagnostic.help(help)], sources);
        return Exit::JobHasErrors;
    }
    console.failure(&Failure::new(message).help(help))
}

/// Puts a program in its place, and reports the result.
fn settle(unit: &Unit, done: Done, fate: Fate, list: Option<&Asking<'_>>, console: &Console) -> (End, Exit) {
    let Done {
        sources,
        mut diagnostics,
        figures,
        made,
    } = done;
    let made = match against_baseline(unit, figures.as_ref(), list) {
        complaints if complaints.is_empty() || has_errors(&diagnostics) => made,
        complaints => {
            console.diagnostics(&diagnostics, &sources);
            if let Some(list) = list {
                console.diagnostics(&complaints, list.sources);
            }
            report_program(
                unit,
                &complaints,
                &Made::default(),
                (fate, figures.as_ref()),
                console,
            );
            return (End::Failed, Exit::JobHasErrors);
        }
    };
    let made = match made {
        Ok(Some(complete)) if is_denied(&diagnostics, &complete, console) => {
            diagnostics.extend_from_slice(complete.ready.warnings());
            Ok(None)
        }
        other => other,
    };
    let settled = made.and_then(|complete| {
        complete
            .map(|complete| complete.settle().map_err(Failure::new))
            .transpose()
    });
    let made = match settled {
        Ok(made) => made.unwrap_or_default(),
        Err(failure) => {
            console.diagnostics(&diagnostics, &sources);
            return (End::Failed, console.failure(&failure));
        }
    };
    diagnostics.extend_from_slice(&made.diagnostics);
    console.diagnostics(&diagnostics, &sources);
    if let Some(found) = &made.differences {
        console.differences(&unit.job, found);
    }
    let end = end(&diagnostics, &made, console);
    report_program(unit, &diagnostics, &made, (fate, figures.as_ref()), console);
    let exit = match end {
        End::Written | End::Unchanged => Exit::Success,
        End::Different | End::Failed => Exit::JobHasErrors,
    };
    (end, exit)
}

/// Whether warnings keep a complete program from being written.
fn is_denied(diagnostics: &[Diagnostic], complete: &Complete, console: &Console) -> bool {
    let all = [diagnostics, complete.ready.warnings()].concat();
    console.warnings().remark(&all).is_some()
}

/// What has become worse than the list allows.
fn against_baseline(unit: &Unit, figures: Option<&Figures>, list: Option<&Asking<'_>>) -> Vec<Diagnostic> {
    match (list.and_then(|list| list.keeper), &unit.recorded_as, figures) {
        (Some(keeper), Some(name), Some(figures)) => keeper.judge(name, &figures.numbers, unit.asked_at),
        _ => Vec::new(),
    }
}

fn report_program(
    unit: &Unit,
    diagnostics: &[Diagnostic],
    made: &Made,
    (fate, figures): (Fate, Option<&Figures>),
    console: &Console,
) {
    console.summary(&Summary {
        job: &unit.job,
        diagnostics,
        numbers: figures.map(|figures| &figures.numbers),
        times: figures.map(|figures| &figures.times),
        checks: figures.map(|figures| figures.checks.with(made.read_back)),
        parameters: figures.map_or(&[], |figures| &figures.parameters),
        placed: &made.placed,
        remark: Some(&remark(unit, diagnostics, made, fate, console.warnings())),
        ..Summary::default()
    });
}

fn end(diagnostics: &[Diagnostic], made: &Made, console: &Console) -> End {
    let differs = made.differences.as_ref().map(|found| !found.changes.is_empty());
    match differs {
        _ if console.warnings().refuse(diagnostics) => End::Failed,
        Some(true) => End::Different,
        Some(false) => End::Unchanged,
        None if made.placed.iter().any(Placed::is_new) => End::Written,
        None => End::Unchanged,
    }
}

fn remark(unit: &Unit, diagnostics: &[Diagnostic], made: &Made, fate: Fate, warnings: &Warnings) -> String {
    let target = format!("for {}", unit.backend.id());
    if warnings.refuse(diagnostics) {
        let nothing = match fate {
            Fate::Write => format!("{target} nothing was written"),
            Fate::Compare => format!("{target} nothing was compared"),
        };
        return match warnings.remark(diagnostics) {
            Some(why) => format!("{why}; {nothing}"),
            None => nothing,
        };
    }
    let said = match &made.differences {
        Some(found) => format!("{target} {}", found.in_words()),
        None => format!("program {target}"),
    };
    match targets::not_read_back(unit.backend) {
        Some(unread) => format!("{said}; {unread}"),
        None => said,
    }
}

impl Total {
    fn in_words(&self) -> String {
        let counts = [
            (self.written, "written"),
            (self.unchanged, "unchanged"),
            (self.different, "different"),
            (self.failed, "failed"),
        ];
        let parts: Vec<String> = counts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, word)| format!("{count} {word}"))
            .collect();
        let programs = counted(self.programs, "program");
        format!("{programs}: {} ({:.1} s)\n", parts.join(", "), self.seconds)
    }
}
