//! What a proof found wrong with slits and strips, in the user's words.

use crate::decided::Planned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::Operation;
use vcutc_process::verdict::{explained, place};
use vcutc_simulation::prove::{CutFault, Finding};

/// A slit that is still there when all strips are out.
fn idle(asked: &dyn Operation, finding: &Finding) -> Diagnostic {
    Diagnostic::new(
        Code::ChipNotFreed,
        format!(
            "the slit of {} goes on below what its strips leave",
            place(finding)
        ),
        asked.setup().head_span,
        "a slit of this operation",
    )
    .help("let the rim run farther beyond its slits, such as `beyond = 0.5 mm`")
}

/// Explains a slit or a strip; so many have the same fault. Plans are made so that none has: what a proof finds is between the plan
/// and the program.
pub(crate) fn explain(planned: &Planned, finding: Finding, count: usize) -> Diagnostic {
    let asked: &dyn Operation = &planned.asked;
    let told = match finding.fault {
        CutFault::NotFreed { needed, .. } if !needed.is_finite() => idle(asked, &finding),
        CutFault::NotFreed { .. }
        | CutFault::Blocked { .. }
        | CutFault::Overcut { .. }
        | CutFault::Strip(_) => explained(asked, finding),
    };
    match count {
        0 | 1 => told,
        2 => told.note("the same holds for one more slit or strip"),
        _ => told.note(format!("the same holds for {} more slits and strips", count - 1)),
    }
}
