//! A plan that a machine does not carry out, and the loop over changes for it.

use crate::budget::{Budget, Size};
use crate::change::Change;
use crate::trial;
use vcutc_cancellation::Wanted;
use vcutc_job::operation::WorksThere;
use vcutc_job::{CheckedJob, Machine, PlannedJob};
use vcutc_motion::solve::Unreachable;

/// Most cuts of a job that is planned again. Beyond it only the machine's side is changed, which leaves the cuts as they are.
const MOST_CUTS_PLANNED_AGAIN: usize = 20_000;

/// What remedies are sought for.
pub(crate) struct Case<'c> {
    pub(crate) job: &'c CheckedJob,
    pub(crate) plan: &'c PlannedJob,
    pub(crate) machine: &'c Machine,
    pub(crate) unreachable: &'c Unreachable,
    pub(crate) budget: Budget,
    works: &'c mut WorksThere<'c>,
}

impl<'c> Case<'c> {
    pub(crate) fn of(
        job: &'c CheckedJob,
        plan: &'c PlannedJob,
        unreachable: &'c Unreachable,
        wanted: &Wanted,
        works: &'c mut WorksThere<'c>,
    ) -> Option<Self> {
        Some(Self {
            job,
            plan,
            machine: job.machine.as_ref()?,
            unreachable,
            budget: Budget::new(Size::REMEDIES, wanted),
            works,
        })
    }

    /// The first of some changes that works.
    pub(crate) fn first(&mut self, candidates: impl IntoIterator<Item = Change>) -> Option<Change> {
        let found = candidates
            .into_iter()
            .find(|change| self.is_carried_out(change))?;
        self.confirmed(found)
    }

    /// A change, if the resulting text compiles: as soon as it is found, so that none is lost when time is
    /// over.
    pub(crate) fn confirmed(&mut self, change: Change) -> Option<Change> {
        (change.edits.is_empty() || self.compiles(&change)).then_some(change)
    }

    /// Whether the text compiles with a change.
    pub(crate) fn compiles(&mut self, change: &Change) -> bool {
        (self.works)(&change.edits)
    }

    /// Whether the machine carries out the job with a change, if a try is left for it.
    fn is_carried_out(&mut self, change: &Change) -> bool {
        let may_plan = !self.is_of_cuts(change) || self.may_plan_again();
        may_plan && self.may_try() && self.passes(change)
    }

    /// Whether a change passes the whole pipeline. The job is planned again only where its operations change: the cuts do not
    /// depend on the machine, so they stay proven.
    pub(crate) fn passes(&self, change: &Change) -> bool {
        let wanted = &self.budget.wanted;
        if self.is_of_cuts(change) {
            return trial::planned_again(change.job.clone(), wanted).is_some();
        }
        let machine = change.job.machine.as_ref();
        machine.is_some_and(|machine| trial::carried_out(self.plan, machine, wanted).is_ok())
    }

    fn is_of_cuts(&self, change: &Change) -> bool {
        change.job.operations != self.job.operations
    }

    /// Takes a try from those that are left.
    pub(crate) fn may_try(&mut self) -> bool {
        self.budget.take(self.plan.cuts())
    }

    /// Whether planning the cuts again is affordable.
    pub(crate) fn may_plan_again(&self) -> bool {
        self.plan.cuts() <= MOST_CUTS_PLANNED_AGAIN
    }
}
