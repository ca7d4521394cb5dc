//! Changes of a job that are tried before they are offered.
//!
//! What is offered has been planned, written down and replayed. All changes that are tried for one job share an amount of
//! work ([`Effort`]), so that a refusal does not take many times as long as a plan.

use super::{planned_and_proven, scallop_excess};
use crate::plan::is_plannable;
use vcutc_backend_api::ir::OperationId;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_job::operation::{Operation, Trials};
use vcutc_job::search::RouteSet;
use vcutc_job::{CheckedJob, PlannedOperation};

/// What it counts as, in cuts, to plan and prove all of a job with more than one operation.
const WHOLE_JOB: usize = 20_000;

/// Changes of one operation of a job.
pub(super) struct Attempts<'a> {
    job: &'a CheckedJob,
    /// Whether anybody still waits for them.
    wanted: &'a Wanted,
    operation: OperationId,
    effort: &'a mut Effort,
}

impl<'a> Attempts<'a> {
    pub(super) const fn new(
        job: &'a CheckedJob,
        wanted: &'a Wanted,
        operation: OperationId,
        effort: &'a mut Effort,
    ) -> Self {
        Self {
            job,
            wanted,
            operation,
            effort,
        }
    }
}

impl Attempts<'_> {
    /// Whether changes are still to be planned.
    pub(super) fn are_wanted(&self) -> bool {
        !self.wanted.is_needless()
    }

    /// Takes the work of a replay of so many cuts, if there is any left.
    pub(super) const fn spend(&mut self, cuts: usize) -> bool {
        let is_left = !self.effort.is_spent();
        self.effort.spend(cuts);
        is_left
    }
}

impl Trials for Attempts<'_> {
    fn proves(&mut self, change: &dyn Fn(&mut dyn Operation)) -> bool {
        if self.effort.is_spent() {
            return false;
        }
        let Some(changed) = changed(self.job, self.operation, change) else {
            return false;
        };
        match is_plannable(&changed, self.effort, self.wanted) {
            // Bodies are looked at in whole programs only.
            Some(true) if has_body(&changed) => {}
            Some(answer) => return answer,
            None => self.effort.spend(WHOLE_JOB),
        }
        planned_and_proven(&changed, self.wanted, RouteSet::Full)
            .is_some_and(|(plan, proven)| scallop_excess(&plan, &proven.report).is_none())
    }

    fn planned(&mut self, change: &dyn Fn(&mut dyn Operation)) -> Option<Box<dyn PlannedOperation>> {
        let changed = changed(self.job, self.operation, change)?;
        let (mut plan, _) = planned_and_proven(&changed, self.wanted, RouteSet::Full)?;
        let place = usize::from(self.operation.0);
        (place < plan.operations.len()).then(|| plan.operations.swap_remove(place))
    }
}

/// Whether a blade of a job states its body.
fn has_body(job: &CheckedJob) -> bool {
    let mut blades = job.operations.iter().flat_map(|operation| operation.blades());
    blades.any(|blade| blade.body().is_some())
}

/// The job with a change of one operation.
pub(super) fn changed(
    job: &CheckedJob,
    operation: OperationId,
    change: &dyn Fn(&mut dyn Operation),
) -> Option<CheckedJob> {
    let mut changed = job.clone();
    change(&mut **changed.operations.get_mut(usize::from(operation.0))?);
    Some(changed)
}
