//! The proof of a plan's program, and what it found wrong in the user's words.
//!
//! A suggestion is only made after the job has been planned and proven again with it: what the help line offers works.

mod attempts;
mod bodies;
mod changes;
pub mod floors;
pub mod unloaded;
pub mod words;

use crate::lower;
use crate::plan::plan_while;
use attempts::Attempts;
pub use bodies::headline as body_in_work;
pub use changes::with_smaller_swing;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_backend_api::verify::{Fault, VerifiedProgram, verify};
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::WorksThere;
use vcutc_job::operation::judged::Judged;
use vcutc_job::planned::Balance;
use vcutc_job::search::{RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, PlannedJob, PlannedOperation, Sourced};
use vcutc_simulation::body::{self, Bodies};
use vcutc_simulation::prove::{self, Bound, Findings, Replay};
use vcutc_simulation::report::{Report, report};
use vcutc_simulation::timing::{timing, total};
use words::point;

/// A program with its proof, good or bad.
#[derive(Debug)]
pub struct Proven {
    /// The program.
    pub program: VerifiedProgram,
    /// What is wrong with its cuts.
    pub findings: Findings,
    /// How the bodies of its blades pass the work.
    pub bodies: Bodies,
    /// Its figures.
    pub report: Report,
}

impl Proven {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.findings == Findings::default() && self.bodies.contact.is_none()
    }
}

/// Writes a plan down as a program and proves it.
///
/// # Errors
/// When the program breaks a rule of the IR, which is a fault of the compiler.
pub fn prove(plan: &PlannedJob, sources: &SourceMap) -> Result<Proven, Vec<Fault>> {
    let program = verify(lower::lower(plan, sources))?;
    let replay = replay(plan, &program);
    let findings = replay.findings.clone();
    let timing = timing(&program);
    let mut report = report(replay, plan.stock, &plan.profile, timing);
    let bodies = bodies(plan, &program);
    report.body = bodies.nearest;
    Ok(Proven {
        program,
        findings,
        bodies,
        report,
    })
}

/// How the bodies of a program's blades pass the work.
#[must_use]
pub fn bodies(plan: &PlannedJob, program: &VerifiedProgram) -> Bodies {
    body::bodies(program, &bounds(plan))
}

/// Replays the cuts of a program, each operation compared with what the plan keeps it out of.
#[must_use]
pub fn replay(plan: &PlannedJob, program: &VerifiedProgram) -> Replay {
    let mut replay = prove::replay(program, &bounds(plan));
    for (operation, planned) in (0..).map(OperationId).zip(&plan.operations) {
        let judged = Judged {
            plan,
            program: program.program(),
            operation,
        };
        planned.judge(judged, &mut replay);
    }
    replay
}

/// What each operation must stay out of.
#[must_use]
pub fn bounds(plan: &PlannedJob) -> Vec<Bound<'_>> {
    plan.operations.iter().map(|planned| planned.bound()).collect()
}

/// Puts everything that is wrong with a proven program into words.
#[must_use]
pub fn diagnose(job: &CheckedJob, plan: &PlannedJob, proven: &Proven) -> Vec<Diagnostic> {
    diagnose_while(job, plan, proven, &Wanted::ALWAYS, &mut |_| true)
}

/// As [`diagnose`] while that is wanted: no more changes are tried afterwards, which may then be missing ([`Wanted::answer`]).
/// Of the values that prove, one is offered that the stages after planning accept.
#[must_use]
pub fn diagnose_while(
    job: &CheckedJob,
    plan: &PlannedJob,
    proven: &Proven,
    wanted: &Wanted,
    works_there: &mut WorksThere<'_>,
) -> Vec<Diagnostic> {
    let mut effort = Effort::OF_A_REFUSAL;
    let mut diagnostics: Vec<Diagnostic> = Vec::new();
    for (count, finding) in proven.findings.iter() {
        let Some(planned) = plan.operation(finding.operation) else {
            continue;
        };
        let mut trials = Attempts::new(job, wanted, finding.operation, &mut effort);
        diagnostics.push(planned.explain(finding, count, &mut trials, works_there));
    }
    if let Some(found) = proven.bodies.contact {
        let (_, contact) = found;
        let mut trials = Attempts::new(job, wanted, contact.passage.operation, &mut effort);
        diagnostics.extend(bodies::explained(plan, proven, found, &mut trials, works_there));
    }
    if diagnostics.is_empty()
        && let Some((operation, limit)) = scallop_excess(plan, &proven.report)
        && let Some(planned) = plan.operation(operation)
    {
        let found = over_limit(job, planned, limit, &proven.report);
        let mut trials = Attempts::new(job, wanted, operation, &mut effort);
        diagnostics.push(planned.help_with_scallop(found, &proven.report, &mut trials));
    }
    diagnostics.extend(plan.operations.iter().flat_map(|planned| planned.warnings()));
    diagnostics
}

/// More stays on the part than a limit on scallop allows.
fn over_limit(
    job: &CheckedJob,
    planned: &dyn PlannedOperation,
    limit: Sourced<Length>,
    report: &Report,
) -> Diagnostic {
    let (height, peak) = (show(report.scallop.height.to_mm()), report.scallop.peak);
    let headline = format!(
        "{height} mm of material remain on the part at x {} mm, the limit is {} mm",
        show(peak.x),
        show(limit.value.to_mm())
    );
    let span = limit.span.unwrap_or(planned.asked().setup().head_span);
    Diagnostic::new(Code::ScallopOverLimit, headline, span, "the limit").and(
        job.profile_span,
        format!(
            "the part lies {height} mm below the highest material, {}",
            point(peak)
        ),
    )
}

/// Compiles a changed job, as far as its machine; none where it has errors.
pub type Compile<'c> = dyn Fn(&CheckedJob) -> Option<(PlannedJob, Report)> + 'c;

/// The warning that much of what is to be cut away stays, if it does. What it offers was compiled.
#[must_use]
pub fn much_stays(
    job: &CheckedJob,
    plan: &PlannedJob,
    report: &Report,
    compile: &Compile<'_>,
) -> Option<Diagnostic> {
    let balance = Balance::of(plan, report)?;
    let planned = plan.operation(balance.operation)?;
    planned.explain_what_stays(balance, &|change| {
        compile(&attempts::changed(job, balance.operation, change)?)
    })
}

/// The limits on time and cuts that a plan breaks, which was made without them, with what the plan keeps.
#[must_use]
pub fn broken_limits(job: &CheckedJob, plan: &PlannedJob) -> Vec<Diagnostic> {
    limits_broken_by(job, plan, |_| Duration::ZERO)
}

/// The same of a plan whose operations take so much longer than by themselves.
#[must_use]
pub fn limits_broken_by(
    job: &CheckedJob,
    plan: &PlannedJob,
    longer: impl Fn(OperationId) -> Duration,
) -> Vec<Diagnostic> {
    let operations = job.operations.iter().zip(&plan.operations);
    (0..)
        .map(OperationId)
        .zip(operations)
        .filter_map(|(operation, (asked, planned))| {
            planned.broken_limits(&**asked, time_alone(job, &**planned)? + longer(operation))
        })
        .collect()
}

/// How long an operation takes by itself; none where the compiler is at fault, which the proof of the whole then shows.
fn time_alone(job: &CheckedJob, planned: &dyn PlannedOperation) -> Option<Duration> {
    let program = verify(lower::alone(job, planned)).ok()?;
    Some(total(&program))
}

/// The plan and proof of a job that has nothing wrong with its cuts, along the route that any machine follows best, as the
/// compiler takes it when the machine follows no other. None if the answer is not wanted any more.
#[must_use]
pub fn sound(job: &CheckedJob, wanted: &Wanted) -> Option<(PlannedJob, Proven)> {
    planned_and_proven(job, wanted, RouteSet::RowsByPoint)
        .filter(|(plan, proven)| scallop_excess(plan, &proven.report).is_none())
}

/// The plan and proof of a job in which nothing is wrong. None if the answer is not wanted any more.
fn planned_and_proven(job: &CheckedJob, wanted: &Wanted, routes: RouteSet) -> Option<(PlannedJob, Proven)> {
    let plan = || plan_while(job, SearchSpace::along(routes), wanted);
    let plan = wanted.answer(plan).ok()?.ok()?;
    let proven = prove(&plan, &SourceMap::default()).ok()?;
    proven.is_sound().then_some((plan, proven))
}

/// The operation with the tightest scallop limit, if the machined contour is above it.
#[must_use]
pub fn scallop_excess(plan: &PlannedJob, report: &Report) -> Option<(OperationId, Sourced<Length>)> {
    let tightest = plan.scallop_limit()?;
    // The search for the highest point works in floating point; a micrometre over the limit is not an excess.
    (report.scallop.height > tightest.1.value + Length::mm(1e-3)).then_some(tightest)
}
