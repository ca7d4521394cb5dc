//! `z(x) = ...`: a profile by formula.

use super::{Formula, Trace};
use crate::sema::eval::Scope;
use crate::sema::part::{self, Part, Sampling};
use crate::sema::quantity::mm;
use crate::sema::report::{Checked, Reports};
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::SampleError;

/// A profile's formula is called `z`.
pub(super) fn check_name(formula: &Formula<'_>, reports: &mut Reports) -> Checked<()> {
    if formula.name.node == "z" {
        return Ok(());
    }
    let diagnostic = Diagnostic::new(
        Code::UnknownField,
        format!("a profile gives the height `z`, not `{}`", formula.name.node),
        formula.name.span,
        "not what a profile gives",
    );
    Err(reports.push(diagnostic.fix("call it `z`", formula.name.span, "z")))
}

/// The formula's polyline across the stock.
pub(super) fn trace(
    formula: &Formula<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<Trace> {
    let sampling = Sampling {
        variable: &formula.variable.node,
        value: formula.value,
        scope,
    };
    let points = sampling.points(stock.node.width.to_mm(), Part::TOLERANCE);
    let points = points.map_err(|error| {
        let span = formula.value.span;
        let diagnostic = match error {
            SampleError::NoValue { x } => {
                // Once more, to hear why; the reason is the same wherever the formula fails first.
                let mut why = Reports::default();
                let outcome = sampling.height(x, &mut why);
                match (outcome, why.into_vec().into_iter().next()) {
                    (Err(_), Some(reason)) => {
                        reason.note(format!("this is so at {} = {}", formula.variable.node, mm(x)))
                    }
                    _ => no_value(formula, x),
                }
            }
            SampleError::Jump { x } => Diagnostic::new(
                Code::NotSingleValued,
                format!("the formula jumps at x = {}", mm(x)),
                span,
                "a profile has no vertical steps",
            )
            .help("replace the jump by a steep ramp"),
            SampleError::BadRange | SampleError::TooManyPoints => too_rough(span),
        };
        reports.push(diagnostic)
    })?;
    let mut trace = Trace::default();
    trace.begin(formula.span);
    trace.drawn.push(part::Piece::Formula(sampling.closed()));
    trace.extend(points);
    Ok(trace)
}

fn no_value(formula: &Formula<'_>, x: f64) -> Diagnostic {
    Diagnostic::new(
        Code::NotFinite,
        format!(
            "the formula has no value at {} = {}",
            formula.variable.node,
            mm(x)
        ),
        formula.value.span,
        "this gives no height",
    )
}

fn too_rough(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::ImpossibleCurve,
        "the formula is too rough to follow within 1 um",
        span,
        "millions of points are not enough for it",
    )
    .help("check its units: an angle in radians instead of degrees turns 57 times as fast")
}
