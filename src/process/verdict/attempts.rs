//! Changes of a job that are tried before they are offered.
//!
//! What is offered has been planned, written down and replayed. All changes that are tried for one job share an amount of
//! work ([`Effort`]), so that a refusal does not take many times as long as a plan.

use super::{Proven, prove, scallop_excess};
use crate::choice::{self, Effort, Latitude, Leeway};
use crate::plan::PlannedJob;
use crate::plan::refusal::Offer;
use vcutc_backend_api::ir::OperationId;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::{CheckedJob, Operation, RoughVcut};
use vcutc_simulation::prove::Findings;

/// What it counts as, in cuts, to plan and prove all of a job with more than one operation.
const WHOLE_JOB: usize = 20_000;

/// A job of which changes are tried.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub(super) job: &'a CheckedJob,
    /// Whether anybody still waits for them.
    pub(super) wanted: &'a Wanted,
}

/// Changes of one operation of a job.
pub(super) struct Attempts<'a> {
    case: Case<'a>,
    operation: OperationId,
    effort: &'a mut Effort,
}

impl<'a> Attempts<'a> {
    pub(super) const fn new(case: Case<'a>, operation: OperationId, effort: &'a mut Effort) -> Self {
        Self {
            case,
            operation,
            effort,
        }
    }

    /// What is changed.
    pub(super) const fn case(&self) -> Case<'a> {
        self.case
    }

    /// The first of what the operation gives of its cuts that works left to the compiler, or all of it.
    pub(super) fn opened(&mut self, asked: &RoughVcut) -> Option<Offer> {
        Offer::openings(asked)
            .into_iter()
            .find(|offer| self.prove(|asked| asked.clone_from(&offer.changed)))
    }

    /// Whether the job plans and proves with a change, within all its limits.
    pub(super) fn prove(&mut self, change: impl Fn(&mut RoughVcut)) -> bool {
        if self.effort.is_spent() {
            return false;
        }
        let Some(changed) = changed(self.case.job, self.operation, change) else {
            return false;
        };
        if let [_] = changed.operations[..] {
            return choice::is_sound(&changed, self.effort, self.case.wanted);
        }
        self.effort.spend(WHOLE_JOB);
        let changed = Case {
            job: &changed,
            ..self.case
        };
        planned_and_proven(changed, Latitude::Full)
            .is_some_and(|(plan, proven)| scallop_excess(&plan, &proven.report).is_none())
    }
}

/// The job with a change of one operation.
pub(super) fn changed(
    job: &CheckedJob,
    operation: OperationId,
    change: impl Fn(&mut RoughVcut),
) -> Option<CheckedJob> {
    let mut changed = job.clone();
    let Operation::RoughVcut(asked) = changed.operations.get_mut(usize::from(operation.0))?;
    change(asked);
    Some(changed)
}

/// Plans and proves the job with a change of one operation; nothing where the change makes it contradict itself.
pub(super) fn attempt(
    case: Case<'_>,
    operation: OperationId,
    change: impl Fn(&mut RoughVcut),
) -> Option<(PlannedJob, Proven)> {
    let changed = changed(case.job, operation, change)?;
    let changed = Case {
        job: &changed,
        ..case
    };
    planned_and_proven(changed, Latitude::Full)
}

/// The plan and proof of a job in which nothing is wrong. None for who no longer wants it.
pub(super) fn planned_and_proven(case: Case<'_>, latitude: Latitude) -> Option<(PlannedJob, Proven)> {
    let choose = || choice::choose_while(case.job, Leeway::along(latitude), case.wanted);
    let plan = case.wanted.answer(choose).ok()?.ok()?;
    let proven = prove(&plan, &SourceMap::default()).ok()?;
    (proven.findings == Findings::default()).then_some((plan, proven))
}
