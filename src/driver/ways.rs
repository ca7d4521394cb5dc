//! A job that leaves a choice between operations, compiled in each way: the fastest that compiles is taken.
//!
//! Each way is planned, proven and put to the machine, so what is compared is what the machine would take. Where two take as
//! long, the one that the language names first is taken. Where none compiles, the first way is what there is to report.

use super::Run;
use super::Stage;
use super::routes::{Ended, Made, along_its_routes};
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Duration;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Diagnostic, Severity};
use vcutc_job::{CheckedJob, Operation};
use vcutc_process::comparison::PlanTime;

/// Ways to do an operation, compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The operation, by its number from 0.
    pub operation: usize,
    /// Where its head is.
    pub head: Span,
    /// The ways, the one that is taken first.
    pub ways: Vec<ComparedWay>,
}

/// A way to do an operation.
#[derive(Clone, Debug)]
pub struct ComparedWay {
    /// What it is called in the language.
    pub word: &'static str,
    /// What the job asks for, done in this way.
    pub operation: Box<dyn Operation>,
    pub came: Came,
}

/// The result of a way.
#[derive(Clone, Debug)]
pub enum Came {
    /// It compiles.
    Compiled(WayFigures),
    /// It does not, for this reason.
    Refused(Option<Diagnostic>),
}

/// Figures of a job done in one way.
#[derive(Clone, Copy, Debug)]
pub struct WayFigures {
    /// The time of the whole program, as its machine takes it.
    pub time: Duration,
    pub cuts: usize,
    /// The same for other depths and feeds.
    pub planned: PlanTime,
}

/// A job whose operations are each done in one way.
pub(super) struct Decided {
    pub(super) job: CheckedJob,
    pub(super) comparisons: Vec<Comparison>,
    /// Its result; none where it does not compile.
    pub(super) made: Option<Made>,
}

/// Makes the choices that a job leaves open, one after the other; none where it leaves none open, or the
/// answer is not wanted.
pub(super) fn decided(
    job: &CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Option<Decided> {
    let mut comparisons = Vec::new();
    let mut decided: Option<(CheckedJob, Option<Made>)> = None;
    loop {
        let open = decided.as_ref().map_or(job, |(job, _)| job);
        let Some(ways) = open.each_way() else { break };
        let operation = open.open.first()?.operation;
        let (next, comparison) = fastest(operation, ways, sources, run, progress)?;
        comparisons.push(comparison);
        decided = Some(next);
    }
    let (job, made) = decided?;
    Some(Decided {
        job,
        comparisons,
        made,
    })
}

/// The fastest of some ways, and how they compare.
fn fastest(
    operation: usize,
    ways: Vec<(&'static str, CheckedJob)>,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Option<((CheckedJob, Option<Made>), Comparison)> {
    let mut best: Option<(CheckedJob, Option<Made>)> = None;
    let mut compared: Vec<ComparedWay> = Vec::new();
    let mut head = None;
    for (word, job) in ways {
        let (came, made) = match along_its_routes(&job, sources, run, progress) {
            Ended::Compiled(made) => (figures(&made, operation), Some(made)),
            Ended::Refused(refused) => (Came::Refused(first_error(refused.at_once(&job))), None),
            Ended::Cancelled => return None,
        };
        head = head.or_else(|| Some(job.operations.get(operation)?.setup().head_span));
        let Some(asked) = job.operations.get(operation) else {
            continue;
        };
        let asked = asked.clone();
        let is_better = match (&best, &made) {
            (None, _) | (Some((_, None)), Some(_)) => true,
            (Some((_, Some(best))), Some(made)) => made.time() < best.time(),
            (Some(_), None) => false,
        };
        let way = ComparedWay {
            word,
            operation: asked,
            came,
        };
        if is_better {
            compared.insert(0, way);
            best = Some((job, made));
        } else {
            compared.push(way);
        }
    }
    let comparison = Comparison {
        operation,
        head: head?,
        ways: compared,
    };
    Some((best?, comparison))
}

fn figures(made: &Made, operation: usize) -> Came {
    let compared = OperationId(u16::try_from(operation).unwrap_or(u16::MAX));
    PlanTime::of(&made.plan, compared).map_or(Came::Refused(None), |planned| {
        Came::Compiled(WayFigures {
            time: made.time(),
            cuts: made.plan.cuts(),
            planned: planned.taking(made.time()),
        })
    })
}

pub(super) fn first_error(found: Vec<Diagnostic>) -> Option<Diagnostic> {
    found.into_iter().find(|one| one.severity() == Severity::Error)
}
