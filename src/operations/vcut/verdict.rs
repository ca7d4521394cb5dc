//! What a proof found wrong with V-cuts, in the user's words, and which change fixes it.

mod attempts;
mod blocked;
mod chip_remedy;
mod given_tips;
mod not_freed;
mod scallop;
mod stays;
mod usable_edge;

pub(crate) use scallop::helped;
pub(crate) use stays::much_stays;

use crate::plan::PlannedVcut;
use attempts::Attempts;
use blocked::blocked;
use not_freed::{Chips, not_freed};
use vcutc_diagnostics::Diagnostic;
use vcutc_job::operation::{Trials, WorksThere};
use vcutc_process::verdict::words::{explained, overcut};
use vcutc_simulation::prove::{CutFault, Finding};

/// Explains a cut whose chip does not come free, or whose way is blocked.
pub(crate) fn explain(
    vcut: &PlannedVcut,
    finding: Finding,
    count: usize,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    match finding.fault {
        CutFault::NotFreed { needed, available } => {
            let chips = Chips {
                finding,
                count,
                needed,
                available,
            };
            not_freed(&mut Attempts(trials), vcut, chips, works_there)
        }
        CutFault::Blocked { at, by } => blocked(vcut, (finding, at, by), trials, works_there),
        CutFault::Overcut { at, depth } => overcut(&vcut.asked, finding, at, depth),
        CutFault::Strays { .. }
        | CutFault::Strip(_)
        | CutFault::Clearing(_)
        | CutFault::Slit(_)
        | CutFault::Stays { .. } => explained(&vcut.asked, finding),
    }
}

/// Tips that the job gives and that cut nothing.
pub(crate) fn idle_tips(vcut: &PlannedVcut) -> Option<Diagnostic> {
    crate::plan::given::idle(vcut.course.as_ref()?, vcut.asked.tips.as_ref()?)
}
