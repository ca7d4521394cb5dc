//! The pipeline as one call: from a path and a loader to a checked program and its report, and from there to files.
//!
//! Pure: what it needs it asks of the [`Loader`], what it finds out it returns, and what a backend writes goes into the
//! caller's [`Sink`](vcutc_backend_api::bundle::Sink).

mod air;
pub mod air_cut;
mod asked;
mod axis_moves;
mod cells;
pub mod checks;
mod compensation;
pub mod dynamics;
mod emitting;
pub mod families;
pub mod hints;
mod home;
pub mod left_over;
pub mod manifest;
pub mod memory;
mod mount;
pub mod numbers;
mod reaching;
mod refusal;
mod routes;
pub mod starter;
pub mod summary;
mod target;
mod teeth;
mod trials;
pub mod ways;

pub use air::{air_cut_height, into_air_cut};
pub use asked::{machine_words, misfits, understood};
pub use emitting::{EmitFailure, emit, write};
pub use refusal::{Patience, Unhurried};
pub use trials::changed;

pub use vcutc_job::search::SearchEffort;
pub use vcutc_job::sema::Typed;
pub use vcutc_remedy::fallback::NotFollowed;

use crate::checks::{Bodies, Carried, Checks};
use crate::dynamics::Dynamics;
use crate::left_over::LeftOver;
use crate::memory::Memory;
use crate::numbers::Numbers;
use crate::summary::chosen::{self, OperationFigures};
use crate::summary::times::{TimeFigures, figures as time_figures};
use crate::summary::{summary, with_choices, with_surface};
use families::{Chosen, ComparedFamily};
use refusal::{NotTaken, Refused, Unhelped};
use routes::{Ended, Made};
use trials::{Machine, Trials};
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::ir::{Head, OpId, Purpose};
use vcutc_backend_api::motion::MotionFault;
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::verify::{Fault, VerifiedProgram};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::{Loader, SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic, Severity, has_errors};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_job::sema;
use vcutc_job::sema::kind::Operations;
use vcutc_motion::figures::{self as reach_figures, ReachFigures};
use vcutc_motion::pace::{self, Paced};
use vcutc_motion::solve::Reached;
use vcutc_motion::verdict as reach_verdict;
use vcutc_process::plan;
use vcutc_process::verdict;
use vcutc_simulation::report::Report;
use vcutc_simulation::timing::times;
use vcutc_syntax::ast::Ast;
use vcutc_syntax::fingerprint;
use ways::Comparison;

/// What to compile.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// Path of the job, as the loader knows it and as people see it.
    pub path: &'a str,
    /// Where files come from.
    pub loader: &'a dyn Loader,
    /// `name=value` texts that replace `let`s.
    pub overrides: &'a [String],
    /// The machine to cut on, over what the job says.
    pub machine: Option<&'a str>,
    /// Options of a target, over those of the job.
    pub options: Typed<'a>,
    /// How hard the best of what the job leaves open is searched for.
    pub effort: SearchEffort,
    /// The operations of the language.
    pub operations: Operations,
    /// Targets whose options the machine may hold.
    pub targets: &'a [&'static dyn Backend],
}

impl<'a> Request<'a> {
    const fn choices(&self) -> sema::Choices<'a> {
        sema::Choices {
            overrides: self.overrides,
            machine: self.machine,
            options: self.options,
            effort: self.effort,
            operations: self.operations,
            surfaces: None,
        }
    }
}

/// The stage that is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading and understanding the text.
    Reading,
    /// Choosing the cuts.
    Planning,
    /// Proving that every chip comes free and no cut enters the part.
    Proving,
    /// Proving that the machine can carry it out.
    Reaching,
    /// Searching for the best place of the work.
    Placing,
    /// Searching for changes that make a refused job compile.
    Helping,
    /// Solving for other parameters.
    Optimising,
    /// Writing the program.
    Emitting,
    /// Holding a program against its job.
    Verifying,
}

/// What came of a run.
#[derive(Debug, Default)]
pub struct Outcome {
    /// All texts that diagnostics point into.
    pub sources: SourceMap,
    /// What there is to tell, in the order of the source.
    pub diagnostics: Vec<Diagnostic>,
    /// The root file's tree, when it could be loaded.
    pub ast: Option<Ast>,
    /// The checked job, when it has no errors of meaning.
    pub job: Option<CheckedJob>,
    /// The plan, when one could be made.
    pub plan: Option<PlannedJob>,
    /// The program, when the job is without errors.
    pub compiled: Option<Compiled>,
    /// How other ways to do its operations compare, where the job leaves that open.
    pub comparisons: Vec<Comparison>,
    /// How other ways for its cuts to follow the part compare, the one that is taken first, where the job leaves that open.
    pub families: Vec<ComparedFamily>,
    /// The targets of this build that drive the job's machine.
    pub drivers: Vec<&'static str>,
}

/// A program as far as its job takes it.
#[derive(Debug)]
pub enum Finished {
    /// Of a job without a machine: nothing moves it.
    WithoutMachine(Box<VerifiedProgram>),
    /// With the motion of the job's machine.
    Reached(Box<Reached>),
}

impl Finished {
    #[must_use]
    pub const fn verified(&self) -> &VerifiedProgram {
        match self {
            Self::WithoutMachine(program) => program,
            Self::Reached(reached) => reached.program.verified(),
        }
    }

    /// The same with another head of the program.
    fn headed(self, head: Option<Head>) -> Self {
        match self {
            Self::WithoutMachine(program) => Self::WithoutMachine(Box::new(program.headed(head))),
            Self::Reached(reached) => Self::Reached(Box::new(Reached {
                program: reached.program.headed(head),
                report: reached.report,
            })),
        }
    }

    /// How the machine carries it out.
    #[must_use]
    pub const fn reached(&self) -> Option<&Reached> {
        match self {
            Self::WithoutMachine(_) => None,
            Self::Reached(reached) => Some(reached),
        }
    }
}

/// A job that can be emitted.
#[derive(Debug)]
pub struct Compiled {
    pub program: Finished,
    /// What it asks of the machine.
    pub figures: Option<ReachFigures>,
    /// What it asks of the machine's drives, and how far its forces push it off.
    pub dynamics: Dynamics,
    /// Its figures.
    pub report: Report,
    /// What is left over a part that changes along y; none over a profile, which the report measures.
    pub left_over: Option<LeftOver>,
    /// How long each op takes.
    pub op_times: Vec<Duration>,
    /// Its figures for other programs.
    pub numbers: Numbers,
    /// Where the time goes, and what it is based on.
    pub times: TimeFigures,
    /// Which checks were made, and which were not.
    pub checks: Checks,
    /// The parameters of its operations.
    pub parameters: Vec<OperationFigures>,
    /// The figures for people, a line each.
    pub summary: Vec<String>,
    /// What its machine did not follow before; none where it follows what the job makes of itself.
    pub not_followed: Option<Box<NotFollowed>>,
}

impl Compiled {
    /// The figures of what it leaves of the stock; none of an air cut, which cuts nothing.
    #[must_use]
    pub fn numbers_of_cuts(&self) -> Option<&Numbers> {
        match self.program.verified().program().purpose {
            Purpose::Work => Some(&self.numbers),
            Purpose::AirCut { .. } => None,
        }
    }
}

/// Why nothing was compiled at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RequestError {
    /// The job file itself cannot be read.
    Unreadable(String),
}

/// What a run knows of others.
pub struct Run<'r> {
    /// What they found.
    pub memory: &'r mut Memory,
    /// Whether a later one has made it needless. What was found by then is kept as far as it is complete.
    pub wanted: &'r Wanted,
    pub patience: &'r mut dyn Patience,
}

/// Compiles a job as far as it goes.
///
/// # Errors
/// When the job file itself cannot be read; everything else is in the outcome's diagnostics.
pub fn compile(request: Request<'_>, progress: &mut dyn FnMut(Stage)) -> Result<Outcome, RequestError> {
    let run = Run {
        memory: &mut Memory::none(),
        wanted: &Wanted::ALWAYS,
        patience: &mut Unhurried,
    };
    compile_in(run, request, progress)
}

/// As [`compile`], for who wants to know whether a job compiles, and not what would help one that does not.
pub(crate) fn compile_unhelped(request: Request<'_>) -> Result<Outcome, RequestError> {
    let run = Run {
        memory: &mut Memory::none(),
        wanted: &Wanted::ALWAYS,
        patience: &mut Unhelped,
    };
    compile_in(run, request, &mut |_| ())
}

/// As [`compile`], in a run among others. The outcome is the same, sooner, if it is still wanted then ([`Wanted::answer`]).
///
/// # Errors
/// As for [`compile`].
pub fn compile_in(
    mut run: Run<'_>,
    request: Request<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Result<Outcome, RequestError> {
    progress(Stage::Reading);
    let mut outcome = Outcome::default();
    let (sources, diagnostics) = (&mut outcome.sources, &mut outcome.diagnostics);
    let choices = sema::Choices {
        surfaces: run.memory.surfaces(),
        ..request.choices()
    };
    let (ast, job) = sema::check(request.path, request.loader, choices, sources, diagnostics)
        .map_err(|error| RequestError::Unreadable(error.to_string()))?;
    outcome.ast = ast;
    if let Some(job) = &job {
        outcome
            .diagnostics
            .extend(target::unknown_targets(job, request.targets));
        outcome.drivers = target::drivers(job, request.targets);
        outcome.diagnostics.extend(mount::doubts(job));
        outcome.diagnostics.extend(reach_verdict::too_large(job));
    }
    outcome.job = job;
    if has_errors(&outcome.diagnostics) {
        home::try_offers(&mut outcome, request, &mut run, progress);
    } else {
        plan_and_prove(&mut outcome, request, &mut run, progress);
    }
    Ok(outcome)
}

/// The job with the choices made that it leaves open; as it is where it leaves none.
#[must_use]
pub fn decided(job: CheckedJob, wanted: &Wanted) -> CheckedJob {
    let mut run = Run {
        memory: &mut Memory::none(),
        wanted,
        patience: &mut Unhurried,
    };
    let chosen = families::decided(&job, &SourceMap::default(), &mut run, &mut |_| ());
    chosen.map_or(job, |chosen| chosen.decided.job)
}

/// Compiles a job that was checked before, perhaps changed since. None where it has errors, or is not wanted any more.
#[must_use]
pub fn compile_checked(job: &CheckedJob, wanted: &Wanted) -> Option<(PlannedJob, Compiled)> {
    let mut run = Run {
        memory: &mut Memory::none(),
        wanted,
        patience: &mut Unhurried,
    };
    match compensation::ended(None, job, &SourceMap::default(), &mut run, &mut |_| ()) {
        Ended::Compiled(made) if !wanted.is_needless() => Some((*made.plan, *made.compiled)),
        Ended::Compiled(_) | Ended::Refused(_) | Ended::Cancelled => None,
    }
}

fn plan_and_prove(
    outcome: &mut Outcome,
    request: Request<'_>,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) {
    let mut made = None;
    if let Some(job) = &outcome.job
        && let Some(Chosen { decided, families }) = families::decided(job, &outcome.sources, run, progress)
    {
        outcome.job = Some(decided.job);
        outcome.comparisons = decided.comparisons;
        outcome.families = families;
        made = decided.made;
    }
    let Some(job) = &outcome.job else { return };
    let ended = match compensation::ended(made, job, &outcome.sources, run, progress) {
        Ended::Compiled(made) => checked(job, made, request, &outcome.sources, run),
        ended @ (Ended::Refused(_) | Ended::Cancelled) => ended,
    };
    match ended {
        Ended::Cancelled => {}
        Ended::Compiled(Made {
            plan,
            warnings,
            compiled,
            ..
        }) => {
            let compile = |changed: &CheckedJob| {
                let (plan, compiled) = compile_checked(changed, run.wanted)?;
                Some((plan, compiled.report))
            };
            let much_stays = verdict::much_stays(job, &plan, &compiled.report, &compile);
            let carried = job.machine.as_ref().zip(compiled.program.reached());
            let warned = carried.map(|(machine, reached)| compiled.checks.warnings(machine, reached));
            outcome.diagnostics.extend(warnings);
            outcome.diagnostics.extend(much_stays);
            outcome.diagnostics.extend(warned.into_iter().flatten());
            let mut compiled = *compiled;
            with_choices(&mut compiled.summary, &outcome.families, &outcome.comparisons);
            (outcome.plan, outcome.compiled) = (Some(*plan), Some(compiled));
        }
        Ended::Refused(refused) => {
            let before = (&outcome.sources, outcome.diagnostics.as_slice());
            let mut found = helped(job, &refused, before, request, run, progress);
            summary::families::explain(&mut found, &outcome.families);
            outcome.plan = refused.into_plan();
            outcome.diagnostics.extend(found);
        }
    }
}

/// A program with the forces on its machine, and without objections of its target.
fn checked<'j>(
    job: &CheckedJob,
    mut made: Made,
    request: Request<'_>,
    sources: &SourceMap,
    run: &mut Run<'_>,
) -> Ended<'j> {
    let mut found = dynamics::add(job, &mut made.compiled);
    found.extend(dynamics::verdicts(job, &made.compiled, sources, run));
    found.extend(cells::compare(job, &mut made.compiled));
    found.extend(teeth::compare(job, &mut made.compiled));
    let mut objections = target::objections(job, &made.compiled, request);
    let (errors, warnings): (Vec<_>, Vec<_>) = found
        .into_iter()
        .partition(|diagnostic| diagnostic.severity() == Severity::Error);
    objections.extend(errors.into_iter().map(Into::into));
    made.warnings.extend(warnings);
    if objections.is_empty() {
        Ended::Compiled(made)
    } else {
        Ended::Refused(Refused::ByTarget(Box::new(NotTaken {
            plan: *made.plan,
            warnings: made.warnings,
            objections,
        })))
    }
}

/// The diagnostics of a job that is refused, with what helps. They are reported before help is looked for.
fn helped(
    job: &CheckedJob,
    refused: &Refused<'_>,
    (sources, before): (&SourceMap, &[Diagnostic]),
    request: Request<'_>,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Vec<Diagnostic> {
    if run.wanted.is_needless() {
        return Vec::new();
    }
    let at_once = refused.at_once(job);
    let limited = run.patience.refused(&[before, &at_once].concat(), sources);
    let wanted = run.wanted.and(&limited);
    progress(Stage::Helping);
    let machine = match &job.machine {
        Some(_) => Machine::Here,
        None => Machine::None,
    };
    let mut trials = Trials::of(request, sources, &at_once, machine, &wanted);
    let works = &mut |edits: &[(Span, String)]| trials.works(edits);
    let found = match with_limits_that_are_kept(job, (refused, &at_once), &wanted) {
        Some(found) => found,
        None => refused.with_help(job, &wanted, works),
    };
    let mut found = refusal::tried(found, &at_once, works);
    if wanted.is_needless()
        && let Some(words) = run.patience.cut_short()
        && let Some(first) = found.iter_mut().find(|one| one.severity() == Severity::Error)
    {
        first.notes.push(words);
    }
    found
}

/// The message about a limit that no plan keeps offers what the fastest plan keeps; but its machine may follow only a slower one.
/// So the job is compiled without these limits, and the message reports the result.
fn with_limits_that_are_kept(
    job: &CheckedJob,
    (refused, at_once): (&Refused<'_>, &[Diagnostic]),
    wanted: &Wanted,
) -> Option<Vec<Diagnostic>> {
    let is_of_limits = match refused {
        Refused::Unplanned(_) => at_once.iter().all(|one| one.code == Code::LimitsConflict),
        Refused::Broken(..) | Refused::Unsound(..) | Refused::Unreached(_) | Refused::ByTarget(_) => false,
    };
    let free = plan::without_plan_limits(job).filter(|free| is_of_limits && free.machine.is_some())?;
    let plan = compile_checked(&free, wanted).map(|(plan, _)| plan)?;
    Some(verdict::broken_limits(job, &plan)).filter(|found| !found.is_empty())
}

fn compiled(
    job: &CheckedJob,
    program: Finished,
    plan: &PlannedJob,
    mut report: Report,
    sources: &SourceMap,
) -> Compiled {
    let figures = program.reached().map(reach_figures::figures);
    let paced = paced(job, &program);
    report.times = times(program.verified(), &paced.times);
    let program = program.headed(Some(Head {
        job: fingerprint::of_job(sources),
        time: report.times.all.total(),
    }));
    let carried = job.machine.as_ref().zip(program.reached());
    let carried = carried.map(|(machine, reached)| Carried { machine, reached });
    let left_over = LeftOver::of(job, &report);
    Compiled {
        checks: Checks::of(carried, paced.basis, Bodies::of(job), &report),
        parameters: chosen::figures(plan),
        numbers: Numbers::of(plan, &report),
        summary: with_surface(
            summary(plan, &report, paced.basis, figures.as_ref()),
            left_over.as_ref(),
            &report.tracked,
        ),
        times: time_figures(&report, paced.basis),
        op_times: paced.times,
        program,
        figures,
        dynamics: Dynamics::default(),
        report,
        left_over,
        not_followed: None,
    }
}

/// How long each op takes on the job's machine, or without one.
fn paced(job: &CheckedJob, program: &Finished) -> Paced {
    match (program.reached(), &job.machine) {
        (Some(reached), Some(machine)) => pace::paced(&reached.program, &machine.model),
        (None, _) | (_, None) => pace::programmed(program.verified()),
    }
}

/// A program that breaks a rule of its own form is the compiler's fault, whatever the job says.
pub fn internal(job: &CheckedJob, faults: &[(Option<OpId>, String)]) -> Diagnostic {
    let mut diagnostic = Diagnostic::new(
        Code::Internal,
        "the program made from this job breaks a rule, which is a fault of the compiler",
        job.name_span,
        "made from this job",
    );
    for (op, rule) in faults.iter().take(3) {
        let place = op.map_or(String::new(), |op| format!("op {}: ", op.0));
        diagnostic = diagnostic.note(format!("{place}{rule}"));
    }
    diagnostic.help("nothing was written; please report the job together with this message")
}

/// Broken rules of a program, as [`internal`] takes them.
pub fn rules_broken(faults: &[Fault]) -> Vec<(Option<OpId>, String)> {
    let words = |fault: &Fault| (fault.op, fault.rule.to_string());
    faults.iter().map(words).collect()
}

fn motions_broken(faults: &[MotionFault]) -> Vec<(Option<OpId>, String)> {
    let words = |fault: &MotionFault| (fault.op, fault.what.to_string());
    faults.iter().map(words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::verify::Rule;
    use vcutc_geometry::curve::Point2;
    use vcutc_vcut::samples::paper_job;

    #[test]
    fn a_program_that_breaks_a_rule_is_the_compilers_fault() {
        let job = paper_job(vec![Point2 { x: 0.0, z: 5.0 }, Point2 { x: 85.0, z: 5.0 }]);
        let fault = |op| Fault {
            op,
            rule: Rule::Number,
        };
        let faults = [fault(Some(vcutc_backend_api::ir::OpId(7))), fault(None)];
        let diagnostic = internal(&job, &rules_broken(&faults));
        assert_eq!(diagnostic.code, Code::Internal);
        assert_eq!(diagnostic.primary.span, job.name_span);
        assert_eq!(
            diagnostic.notes,
            [format!("op 7: {}", Rule::Number), Rule::Number.to_string()]
        );
    }
}
