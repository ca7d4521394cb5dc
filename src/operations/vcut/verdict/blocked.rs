//! A cut with uncut material in the way of the blade, and which change clears it.

use super::attempts::Attempts;
use crate::asked::Residual;
use crate::plan::PlannedVcut;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::curve::Point2;
use vcutc_job::Auto;
use vcutc_job::operation::{Trials, WorksThere};
use vcutc_process::verdict;
use vcutc_simulation::prove::Finding;

/// Explains it: where the material stands, and how much of it, along z.
pub(super) fn blocked(
    vcut: &PlannedVcut,
    (finding, at, by): (Finding, Point2, Length),
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let asked = &vcut.asked;
    let span = asked.swing.span.unwrap_or(asked.setup.head_span);
    let diagnostic = verdict::words::blocked(span, finding, at, by)
        .note("an operation before this one left walls steeper than this operation's flanks");
    let diagnostic = with_mixed_residual(diagnostic, vcut, trials, works_there);
    let diagnostic = verdict::with_smaller_swing(diagnostic, vcut, trials, works_there);
    if diagnostic.fixes.is_empty() && diagnostic.help.is_empty() {
        diagnostic.help("give both operations the same `swing`, or let this one come first")
    } else {
        diagnostic
    }
}

/// Offers to raise cuts until they are clear, where the job asks for another strategy.
fn with_mixed_residual(
    diagnostic: Diagnostic,
    vcut: &PlannedVcut,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let residual = vcut.asked.residual;
    let Some(span) = residual.span.filter(|_| vcut.strategy != Residual::Mixed) else {
        return diagnostic;
    };
    let word = Residual::Mixed.word();
    let is_clear = Attempts(trials).prove(|asked| asked.residual.value = Auto::Given(Residual::Mixed))
        && works_there(&[(span, word.to_owned())]);
    if is_clear {
        diagnostic.fix(
            format!("use `residual = {word}`, which raises cuts until they are clear"),
            span,
            word.to_owned(),
        )
    } else {
        diagnostic
    }
}
