//! `body (height, radius) ...`: the body of a blade above its edge.

use crate::sema::fields::Fields;
use crate::sema::quantity::{Measured, mm};
use crate::sema::range::SIZE;
use crate::sema::read::{Reader, sourced};
use crate::sema::report::{Checked, Reported};
use crate::{Body, BodyStage, Sourced};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Expr, Point};

/// The body, if it is given. An edge that is at fault has no say.
pub(super) fn check(
    fields: &Fields<'_>,
    edge: Option<Sourced<Length>>,
    reader: &mut Reader<'_>,
) -> Checked<Option<Body>> {
    let Some((points, span)) = fields.points("body")? else {
        return Ok(None);
    };
    let mut fault: Option<Reported> = None;
    let mut stages: Vec<BodyStage> = Vec::with_capacity(points.len());
    let mut below: Option<Span> = None;
    for written in points {
        match stage(written, reader) {
            Ok(stage) => {
                let found = beside_edge(stage, written, edge).or_else(|| {
                    let (before, place) = (stages.last()?, below?);
                    not_above(*before, place, stage, written)
                });
                if let Some(diagnostic) = found {
                    fault = Some(reader.reports.push(diagnostic));
                }
                stages.push(stage);
                below = Some(written.span);
            }
            Err(reported) => fault = Some(reported),
        }
    }
    match fault {
        Some(reported) => Err(reported),
        None => Ok(Some(Body {
            span: below.map_or(span, |last| span.to(last)),
            stages,
        })),
    }
}

fn stage(written: &Point, reader: &mut Reader<'_>) -> Checked<BodyStage> {
    let mut length = |expr: &Spanned<Expr>, taker: &str, typical: &str| {
        let value = reader.within(expr, SIZE, taker, Some(typical))?;
        Ok(sourced(Length::from_base(value), expr.span))
    };
    let from = length(&written.x, "the height of a stage", "40 mm");
    let radius = length(&written.z, "the radius of a stage", "8 mm");
    Ok(BodyStage {
        from: from?,
        radius: radius?,
    })
}

/// A stage that would hide part of the edge.
fn beside_edge(stage: BodyStage, written: &Point, edge: Option<Sourced<Length>>) -> Option<Diagnostic> {
    let edge = edge.filter(|edge| stage.from.value < edge.value)?;
    let (from, length) = (mm(stage.from.value.to_mm()), mm(edge.value.to_mm()));
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!("the body begins at {from}, beside the edge of {length}"),
        written.x.span,
        "would hide part of the edge",
    );
    let diagnostic = match edge.span {
        Some(span) => diagnostic.and(span, "the edge is this long"),
        None => diagnostic,
    };
    Some(diagnostic.fix(
        format!("let it begin at {length} or above"),
        written.x.span,
        length,
    ))
}

/// A stage that does not begin above the one before it.
fn not_above(before: BodyStage, place: Span, stage: BodyStage, written: &Point) -> Option<Diagnostic> {
    if stage.from.value > before.from.value {
        return None;
    }
    let heights = [before, stage].map(|stage| mm(stage.from.value.to_mm()));
    let [below, from] = heights;
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!("a stage of the body begins at {from}, not above the one before it at {below}"),
        written.x.span,
        "heights must rise",
    );
    Some(
        diagnostic
            .and(place, "the stage before")
            .help("give the stages from the tip up, each with a greater height"),
    )
}
