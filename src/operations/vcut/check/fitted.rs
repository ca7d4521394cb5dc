//! What does not go with tips that are fitted to the part.

use crate::asked::{Avoid, Formulas, Lattice, RoughVcut};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Auto;
use vcutc_job::follow::Family;

/// A field that has no meaning for fitted tips, or that asks for others.
pub(crate) fn beside_fitted(operation: &RoughVcut) -> Option<Diagnostic> {
    let head = operation.setup.head_span;
    let is_fitted = operation.lattice.value == Auto::Given(Lattice::Fitted);
    let (written, span, why) = misfit(operation).filter(|_| is_fitted)?;
    let diagnostic = Diagnostic::new(
        Code::FieldBesideFitted,
        format!("`{written}` does not go with `lattice = fitted`"),
        span.unwrap_or(head),
        why,
    )
    .and(
        operation.lattice.span.unwrap_or(head),
        "tips are fitted to the part here",
    )
    .help("delete it, or use another `lattice`");
    Some(diagnostic)
}

/// The first of these as it is written, its place, and why it does not fit.
fn misfit(operation: &RoughVcut) -> Option<(String, Option<Span>, &'static str)> {
    if let Auto::Given(residual) = operation.residual.value {
        let written = format!("residual = {}", residual.word());
        let why = "fitted tips never cut the part";
        return Some((written, operation.residual.span, why));
    }
    if operation.avoid.value == Avoid::Swing {
        let written = format!("avoid = {}", Avoid::Swing.word());
        let why = "all fitted tips have the swing of the operation";
        return Some((written, operation.avoid.span, why));
    }
    if operation.family != Family::Straight {
        let written = format!("follow = {}", operation.family.word());
        return Some((written, operation.follow.span, "fitted tips are cut level"));
    }
    if operation.formulas.value == Formulas::Paper {
        let written = format!("model = {}", Formulas::Paper.word());
        let why = "the paper has no formulas for fitted tips";
        return Some((written, operation.formulas.span, why));
    }
    operation.limits.step.least.map(|least| {
        let why = "tips are as close as the limit on the scallop asks for";
        ("limits { step >= ... }".to_owned(), least.span, why)
    })
}
