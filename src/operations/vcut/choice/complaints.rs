//! Why an operation has no plan, in two steps: what to report is known at once, and what helps takes plans to find out.

use super::Unplanned;
use super::bench::Bench;
use super::offers;
use crate::asked::RoughVcut;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::Diagnostic;
use vcutc_job::operation::{self, WorksThere};

/// An operation for which changes can be tried.
pub(super) struct Sought<'j> {
    pub(super) bench: Bench<'j>,
    pub(super) asked: RoughVcut,
    pub(super) unplanned: Unplanned,
}

impl operation::Unplanned for Sought<'_> {
    fn diagnostics(
        &self,
        wanted: &Wanted,
        effort: &mut Effort,
        works: &mut WorksThere<'_>,
    ) -> Vec<Diagnostic> {
        let bench = self.bench.for_whom(wanted);
        offers::diagnostics((&bench, &self.asked), self.unplanned.clone(), effort, works)
    }
}
