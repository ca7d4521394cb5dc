//! `tips (x, z) ...`: where the blade runs, point by point, instead of a lattice.
//!
//! What lays a lattice out has no meaning beside given tips and is refused. The planner still asks what the tips come nearest
//! to: how tall the teeth are that a layer leaves, and how wide. The commonest distance of heights stands for the layer, the
//! commonest distance of neighbours in a row for the step.

use crate::asked::{Lattice, Limits, OF_A_LATTICE, Redundant, Residual, RoughVcut, Sequence, Tip, Tips};
use core::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::Arc;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::sema::eval::Scope;
use vcutc_job::sema::fields::Fields;
use vcutc_job::sema::point::point;
use vcutc_job::sema::quantity::mm;
use vcutc_job::sema::read::sourced;
use vcutc_job::sema::report::{Checked, Reported, Reports};
use vcutc_job::sema::session::Session;
use vcutc_job::{Auto, Bounds};
use vcutc_syntax::ast::Point;

/// Tips with the distances that are commonest among them.
pub(super) struct Given {
    tips: Tips,
    layer: Length,
    step: Length,
}

/// The tips, if they are given.
pub(super) fn check(
    fields: &Fields<'_>,
    stock: Option<Spanned<Stock>>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Given>> {
    let Some((points, span)) = fields.points("tips")? else {
        return Ok(None);
    };
    let reports = &mut session.reports;
    let mut fault: Option<Reported> = None;
    for name in OF_A_LATTICE {
        if let Some(field) = fields.place_of(name) {
            fault = Some(reports.push(beside_tips(name, field, span)));
        }
    }
    let mut tips = Vec::with_capacity(points.len());
    for written in points {
        match tip(written, stock, scope, reports) {
            Ok(tip) => tips.push(tip),
            Err(reported) => fault = Some(reported),
        }
    }
    if let Some(reported) = fault {
        return Err(reported);
    }
    let (top, width) = stock.map_or((f64::INFINITY, f64::INFINITY), |stock| {
        (stock.node.height.to_mm(), stock.node.width.to_mm())
    });
    let (layer, step) = (layer_of(&tips, top), step_of(&tips).unwrap_or(width));
    Ok(Some(Given {
        layer: Length::mm(layer),
        step: Length::mm(step),
        tips: Tips { tips, span },
    }))
}

/// A tip within the stock. A stock that is at fault has no say.
fn tip(
    written: &Point,
    stock: Option<Spanned<Stock>>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<Tip> {
    let place = point(written, &scope, reports)?;
    let Some(stock) = stock else {
        return Ok(Tip {
            point: place,
            span: written.span,
        });
    };
    let (width, height) = (stock.node.width.to_mm(), stock.node.height.to_mm());
    let inside = (0.0..=width).contains(&place.x) && place.z >= 0.0 && place.z < height;
    if inside {
        return Ok(Tip {
            point: place,
            span: written.span,
        });
    }
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!(
            "a tip at x {}, z {} lies outside the stock",
            mm(place.x),
            mm(place.z)
        ),
        written.span,
        "no blade would cut here",
    )
    .and(
        stock.span,
        format!(
            "tips lie at x from 0 mm to {} and z from 0 mm to below {}",
            mm(width),
            mm(height)
        ),
    );
    Err(reports.push(diagnostic.help("delete the tip, or make the stock larger")))
}

/// The operation along these tips.
pub(super) fn over(
    given: Given,
    mut operation: RoughVcut,
    fields: &Fields<'_>,
    reports: &mut Reports,
) -> Checked<RoughVcut> {
    let span = given.tips.span;
    if operation.swing.value == Auto::Auto {
        let place = operation.swing.span.unwrap_or(operation.setup.head_span);
        let diagnostic = Diagnostic::new(
            Code::TipsBesideField,
            "given tips need a `swing`",
            place,
            "there is nothing to derive it from",
        )
        .and(span, "the tips are given here");
        return Err(reports.push(diagnostic.help("give it, for example `swing = 34 deg`")));
    }
    if let Some((name, place)) = limit_of_a_lattice(&operation.limits) {
        let place = place
            .or_else(|| fields.place_of("limits"))
            .unwrap_or(operation.setup.head_span);
        return Err(reports.push(beside_tips(name, place, span)));
    }
    operation.lattice = sourced(Auto::Given(Lattice::Free), span);
    operation.layer = sourced(Auto::Given(given.layer), span);
    operation.step = sourced(Auto::Given(given.step), span);
    operation.residual = sourced(Auto::Given(Residual::Discard), span);
    operation.redundant = sourced(Auto::Given(Redundant::Keep), span);
    operation.sequence = sourced(Auto::Given(Sequence::Rows), span);
    operation.tips = Some(Arc::new(given.tips));
    Ok(operation)
}

/// A limit on something that is not chosen where tips are given.
fn limit_of_a_lattice(limits: &Limits) -> Option<(&'static str, Option<Span>)> {
    let bound = |bounds: &Bounds<Length>| bounds.least.or(bounds.most).map(|bound| bound.span);
    let layer = bound(&limits.layer).map(|span| ("limits { layer }", span));
    let step = bound(&limits.step).map(|span| ("limits { step }", span));
    let time = limits.time.map(|limit| ("limits { time }", limit.span));
    let cuts = limits.cuts.map(|limit| ("limits { cuts }", limit.span));
    layer.or(step).or(time).or(cuts)
}

fn beside_tips(name: &str, place: Span, tips: Span) -> Diagnostic {
    Diagnostic::new(
        Code::TipsBesideField,
        format!("`{name}` does not go with given tips"),
        place,
        "lays tips out, or chooses how",
    )
    .and(tips, "the tips are given here")
    .help(format!("delete either `{name}` or the tips"))
}

/// Micrometres: the grid that tips lie on.
#[expect(
    clippy::cast_possible_truncation,
    reason = "lengths of a stock in micrometres; saturates"
)]
fn grid(mm: f64) -> i64 {
    (mm * 1000.0).round() as i64
}

/// The commonest of some distances in micrometres, as mm; the largest among equals.
fn commonest(distances: impl Iterator<Item = i64>) -> Option<f64> {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for distance in distances.filter(|&distance| distance > 0) {
        *counts.entry(distance).or_default() += 1;
    }
    let best = counts
        .into_iter()
        .max_by_key(|&(distance, count)| (count, distance))?;
    Some(best.0 as f64 / 1000.0)
}

/// The commonest distance of heights, the first of them counted from the stock's top.
fn layer_of(tips: &[Tip], top: f64) -> f64 {
    let lowest = tips.iter().map(|tip| tip.point.z).fold(f64::INFINITY, f64::min);
    let top = if top.is_finite() { top } else { lowest + 1.0 };
    let mut heights: Vec<i64> = tips.iter().map(|tip| grid(tip.point.z)).collect();
    heights.push(grid(top));
    heights.sort_by_key(|&height| Reverse(height));
    commonest(heights.windows(2).map(|pair| match pair {
        [upper, lower] => upper - lower,
        _ => 0,
    }))
    .unwrap_or(top)
}

/// The commonest distance of tips that follow one another at one height.
fn step_of(tips: &[Tip]) -> Option<f64> {
    let aside = |a: Point2, b: Point2| {
        if grid(a.z) == grid(b.z) {
            grid(b.x) - grid(a.x)
        } else {
            0
        }
    };
    commonest(tips.windows(2).map(|pair| match pair {
        [a, b] => aside(a.point, b.point).abs(),
        _ => 0,
    }))
}
