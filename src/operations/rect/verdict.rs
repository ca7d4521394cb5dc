//! What a proof found wrong with slits and strips, in the user's words.

use crate::decided::Planned;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::operation::Operation;
use vcutc_process::verdict::explained;
use vcutc_simulation::prove::Finding;

/// Explains a slit or a strip; so many have the same fault. Plans are made so that none has: what a proof finds is between the plan
/// and the program.
pub(crate) fn explain(planned: &Planned, finding: Finding, count: usize) -> Diagnostic {
    let asked: &dyn Operation = &planned.asked;
    let told = explained(asked, finding);
    match count {
        0 | 1 => told,
        2 => told.note("the same holds for one more slit or strip"),
        _ => told.note(format!("the same holds for {} more slits and strips", count - 1)),
    }
}
