//! What a proof found wrong with V-cuts, in the user's words, and which change fixes it.

mod attempts;
mod chip_remedy;
mod given_tips;
mod not_freed;
mod scallop;
mod stays;

pub(crate) use scallop::helped;
pub(crate) use stays::much_stays;

use crate::asked::RoughVcut;
use crate::plan::PlannedVcut;
use attempts::Attempts;
use not_freed::{Chips, not_freed};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::{Trials, WorksThere};
use vcutc_process::verdict::{explained, overcut, place, point};
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
        CutFault::Blocked { at } => blocked(&vcut.asked, finding, at),
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

fn blocked(asked: &RoughVcut, finding: Finding, at: Point2) -> Diagnostic {
    Diagnostic::new(
        Code::BladeBlocked,
        format!(
            "above {}, uncut material is in the way of the blade",
            place(&finding)
        ),
        asked.swing.span.unwrap_or(asked.setup.head_span),
        format!("the blade meets material at {}", point(at)),
    )
    .note("an operation before this one left walls steeper than this operation's flanks")
    .help("give both operations the same `swing`, or let this one come first")
}
