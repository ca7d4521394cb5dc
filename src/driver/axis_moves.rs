//! A program that its machine follows only because all axes move at once in the place of many of its travels.
//!
//! Such a move is proven to stay out of the stock, but it is not a line and takes longer than the travel, and
//! the arm changes its posture each time. A few are what a large part may need; where they are many, another
//! place of the work is mostly better, and the author of the job has to know.

use vcutc_backend_api::ir::Action;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::CheckedJob;
use vcutc_motion::solve::Reached;

/// So few are reported in the summary only.
const FEW: usize = 10;

/// What to report where more than a quarter of the travels, and more than [`FEW`], are made with all axes.
pub(super) fn many(job: &CheckedJob, reached: &Reached) -> Option<Diagnostic> {
    let machine = job.machine.as_ref()?;
    let changes = reached.report.changes.len();
    let left = reached.program.program().ops.iter();
    let left = left
        .filter(|op| matches!(op.action, Action::Travel { .. }))
        .count();
    let all = changes + left;
    if changes <= FEW || changes * 4 <= all {
        return None;
    }
    Some(
        Diagnostic::new(
            Code::ManyAxisMoves,
            format!("{changes} of {all} travels are axis moves, because the arm cannot keep its configuration"),
            machine.base.span.unwrap_or(machine.head_span),
            "with the work in this place",
        )
        .note("the blade does not follow a line there, and axis moves take longer than the travels that they replace")
        .help("run `vcutc place` on this job: it searches for a place of the work where one configuration is enough"),
    )
}
