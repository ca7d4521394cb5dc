//! Changes of a job that are tried before they are offered.
//!
//! What is offered has been planned, written down and replayed. All changes that are tried for one job share an amount of
//! work ([`Work`]), so that a refusal does not take many times as long as a plan.

use super::{Proven, prove, scallop_excess};
use crate::choice::{self, Latitude, Leeway, Work};
use crate::job::{CheckedJob, Operation, RoughVcut};
use crate::plan::PlannedJob;
use crate::plan::refusal::Offer;
use crate::sim::prove::Findings;
use crate::source::SourceMap;
use vcutc_backend_api::ir::OperationId;

/// What it counts as, in cuts, to plan and prove all of a job with more than one operation.
const WHOLE_JOB: usize = 20_000;

/// Changes of one operation of a job.
pub(super) struct Attempts<'a> {
    job: &'a CheckedJob,
    operation: OperationId,
    work: &'a mut Work,
}

impl<'a> Attempts<'a> {
    pub(super) const fn new(job: &'a CheckedJob, operation: OperationId, work: &'a mut Work) -> Self {
        Self { job, operation, work }
    }

    /// Whether swings may be changed: a machine that follows one need not follow another, and is not asked here.
    pub(super) const fn may_change_swings(&self) -> bool {
        self.job.machine.is_none()
    }

    /// All that the operation gives of its cuts left to the compiler, if that works.
    pub(super) fn all_open(&mut self, asked: &RoughVcut) -> Option<Offer> {
        if !self.may_change_swings() {
            return None;
        }
        Offer::all_open(asked).filter(|offer| self.prove(|asked| asked.clone_from(&offer.changed)))
    }

    /// Whether the job plans and proves with a change, within all its limits.
    pub(super) fn prove(&mut self, change: impl Fn(&mut RoughVcut)) -> bool {
        if self.work.is_spent() {
            return false;
        }
        let Some(changed) = changed(self.job, self.operation, change) else {
            return false;
        };
        if let [_] = changed.operations[..] {
            return choice::is_sound(&changed, self.work);
        }
        self.work.spend(WHOLE_JOB);
        planned_and_proven(&changed, Latitude::Full)
            .is_some_and(|(plan, proven)| scallop_excess(&plan, &proven.report).is_none())
    }
}

fn changed(job: &CheckedJob, operation: OperationId, change: impl Fn(&mut RoughVcut)) -> Option<CheckedJob> {
    let mut changed = job.clone();
    let Operation::RoughVcut(asked) = changed.operations.get_mut(usize::from(operation.0))?;
    change(asked);
    Some(changed)
}

/// Plans and proves the job with a change of one operation; nothing where the change makes it contradict itself.
pub(super) fn attempt(
    job: &CheckedJob,
    operation: OperationId,
    change: impl Fn(&mut RoughVcut),
) -> Option<(PlannedJob, Proven)> {
    planned_and_proven(&changed(job, operation, change)?, Latitude::Full)
}

pub(super) fn planned_and_proven(job: &CheckedJob, latitude: Latitude) -> Option<(PlannedJob, Proven)> {
    let (plan, diagnostics) = choice::choose_within(job, Leeway::along(latitude));
    let plan = plan.filter(|_| diagnostics.is_empty())?;
    let proven = prove(&plan, &SourceMap::default()).ok()?;
    (proven.findings == Findings::default()).then_some((plan, proven))
}
