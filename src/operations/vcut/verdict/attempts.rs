//! Changes of V-shaped roughing that are tried before they are offered.

use crate::asked::RoughVcut;
use crate::plan::PlannedVcut;
use crate::plan::refusal::Offer;
use core::any::Any;
use vcutc_job::operation::{Operation, Trials};

/// Changes of one operation of a job.
pub(super) struct Attempts<'t>(pub(super) &'t mut dyn Trials);

impl Attempts<'_> {
    /// The first of what the operation gives of its cuts that works left to the compiler, or all of it.
    pub(super) fn opened(&mut self, asked: &RoughVcut) -> Option<Offer> {
        Offer::openings(asked)
            .into_iter()
            .find(|offer| self.prove(|asked| asked.clone_from(&offer.changed)))
    }

    /// Whether the job plans and proves with a change, within all its limits.
    pub(super) fn prove(&mut self, change: impl Fn(&mut RoughVcut)) -> bool {
        self.0.proves(&|operation| changed(operation, &change))
    }

    /// The plan with a change; none where something is wrong with it.
    pub(super) fn planned(&mut self, change: impl Fn(&mut RoughVcut)) -> Option<PlannedVcut> {
        let planned = self.0.planned(&|operation| changed(operation, &change))?;
        PlannedVcut::of(&*planned).cloned()
    }
}

/// Changes an operation that is V-shaped roughing.
pub(super) fn changed(operation: &mut dyn Operation, change: &impl Fn(&mut RoughVcut)) {
    let operation: &mut dyn Any = operation;
    if let Some(asked) = operation.downcast_mut() {
        change(asked);
    }
}
