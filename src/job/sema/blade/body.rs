//! `body (height, radius) ...`: the body of a blade above its edge.

use crate::sema::field_ranges::{DISTANCE, Range, SIZE};
use crate::sema::fields::Fields;
use crate::sema::quantity::{Measured, mm};
use crate::sema::read::{Reader, sourced};
use crate::sema::report::{Checked, Reported};
use crate::{Body, BodyStage, Sourced};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Expr, Point};

/// What a body must not hide.
#[derive(Clone, Copy)]
pub(super) enum Edge {
    /// An edge that reaches up to this height.
    UpTo(Sourced<Length>),
    /// The rim of a disc.
    Rim {
        radius: Sourced<Length>,
        thickness: Sourced<Length>,
    },
}

/// The body, if it is given. An edge that is at fault has no say.
pub(super) fn check(
    fields: &Fields<'_>,
    edge: Option<Edge>,
    reader: &mut Reader<'_>,
) -> Checked<Option<Body>> {
    match fields.points("body")? {
        Some(row) => stages(row, edge, reader).map(Some),
        None => Ok(None),
    }
}

/// The body, which must be given.
pub(super) fn required(fields: &Fields<'_>, edge: Option<Edge>, reader: &mut Reader<'_>) -> Checked<Body> {
    let row = fields.required_points("body", reader.reports)?;
    stages(row, edge, reader)
}

fn stages((points, span): (&[Point], Span), edge: Option<Edge>, reader: &mut Reader<'_>) -> Checked<Body> {
    // The body of a disc may begin in the plane of its edge.
    let heights = match edge {
        Some(Edge::Rim { .. }) => DISTANCE,
        Some(Edge::UpTo(_)) | None => SIZE,
    };
    let mut fault: Option<Reported> = None;
    let mut stages: Vec<BodyStage> = Vec::with_capacity(points.len());
    let mut below: Option<Span> = None;
    for written in points {
        match stage(written, heights, reader) {
            Ok(stage) => {
                let hidden = edge.and_then(|edge| edge.hidden_by(stage, written));
                let found = hidden.or_else(|| {
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
        None => Ok(Body {
            span: below.map_or(span, |last| span.to(last)),
            stages,
        }),
    }
}

fn stage(written: &Point, heights: Range, reader: &mut Reader<'_>) -> Checked<BodyStage> {
    let mut length = |expr: &Spanned<Expr>, range: Range, taker: &str, typical: &str| {
        let value = reader.within(expr, range, taker, Some(typical))?;
        Ok(sourced(Length::from_base(value), expr.span))
    };
    let from = length(&written.first, heights, "the height of a stage", "40 mm");
    let radius = length(&written.second, SIZE, "the radius of a stage", "8 mm");
    Ok(BodyStage {
        from: from?,
        radius: radius?,
    })
}

impl Edge {
    /// A stage that would hide part of the edge.
    fn hidden_by(self, stage: BodyStage, written: &Point) -> Option<Diagnostic> {
        match self {
            Self::UpTo(height) => beside_edge(stage, written, height),
            Self::Rim { radius, thickness } => over_rim(stage, written, radius, thickness),
        }
    }
}

/// A stage beside a disc that is as wide as its edge: the edge would not stand out.
fn over_rim(
    stage: BodyStage,
    written: &Point,
    edge: Sourced<Length>,
    thickness: Sourced<Length>,
) -> Option<Diagnostic> {
    if stage.from.value >= thickness.value || stage.radius.value < edge.value {
        return None;
    }
    let (radius, rim) = (mm(stage.radius.value.to_mm()), mm(edge.value.to_mm()));
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!("the body has a radius of {radius} beside the disc, whose edge has {rim}"),
        written.second.span,
        "would hide the edge",
    );
    let diagnostic = match edge.span {
        Some(span) => diagnostic.and(span, "the radius of the edge"),
        None => diagnostic,
    };
    let above = mm(thickness.value.to_mm());
    Some(diagnostic.help(format!(
        "give a radius below {rim}, or let the stage begin at {above} or above"
    )))
}

/// A stage that would hide part of an edge up to a height.
fn beside_edge(stage: BodyStage, written: &Point, edge: Sourced<Length>) -> Option<Diagnostic> {
    if stage.from.value >= edge.value {
        return None;
    }
    let (from, length) = (mm(stage.from.value.to_mm()), mm(edge.value.to_mm()));
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!("the body begins at {from}, beside the edge of {length}"),
        written.first.span,
        "would hide part of the edge",
    );
    let diagnostic = match edge.span {
        Some(span) => diagnostic.and(span, "the edge is this long"),
        None => diagnostic,
    };
    Some(diagnostic.fix(
        format!("let it begin at {length} or above"),
        written.first.span,
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
        written.first.span,
        "heights must rise",
    );
    Some(
        diagnostic
            .and(place, "the stage before")
            .help("give the stages from the tip up, each with a greater height"),
    )
}
