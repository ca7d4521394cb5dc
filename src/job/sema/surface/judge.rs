//! A surface compared with the stock: it has a height everywhere and lies within.

use super::Drawn;
use crate::sema::part::{Part, SAME};
use crate::sema::profile::shape::up;
use crate::sema::quantity::{mm, number, to_um};
use crate::sema::report::{Checked, Reported, Reports};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::coverage::{Coverage, Gap, Tangled};
use vcutc_surface::surface::{Surface, SurfaceError};

/// What adds to a message how the surface comes to lie on the stock.
pub(super) type Offer<'a> = dyn Fn(Diagnostic) -> Diagnostic + 'a;

/// The part of a surface that covers the stock and lies within it.
pub(super) fn part(
    Drawn {
        surface,
        profile,
        exact,
    }: Drawn,
    span: Span,
    stock: Spanned<Stock>,
    offer: &Offer<'_>,
    reports: &mut Reports,
) -> Checked<Part> {
    let coverage = surface
        .coverage()
        .map_err(|error| tangled(error, span, reports))?;
    if let Some(gap) = coverage.gaps.first() {
        return Err(reports.push(offer(incomplete(&coverage, gap, span, stock))));
    }
    if let Some(warning) = undercut(&coverage, span) {
        reports.push(warning);
    }
    within(&surface, span, stock, offer, reports)?;
    let shadow = match profile {
        Some(profile) => Ok(profile),
        // What the triangles stand for may lie higher by their tolerance, but not above the stock.
        None => {
            let tolerance = surface.accuracy().tolerance;
            surface
                .shadow()
                .map(|shadow| shadow.raised(tolerance, stock.node.height))
        }
    };
    match shadow {
        Ok(shadow) => Ok(Part::of_surface(surface, exact, shadow)),
        // Not of a surface that covers the stock.
        Err(error) => Err(reports.push(Diagnostic::new(
            Code::SurfaceIncomplete,
            "the surface has no height over part of the stock",
            span,
            error.to_string(),
        ))),
    }
}

fn tangled(error: Tangled, span: Span, reports: &mut Reports) -> Reported {
    let [x, y] = error.place.map(|part| shown(part.to_mm()));
    reports.push(
        Diagnostic::new(
            Code::ImpossibleSurface,
            "the surface is too tangled to work with",
            span,
            format!("too many triangles lie over each other near x = {x}, y = {y}"),
        )
        .help("export the upper side of the part only, or with fewer and larger triangles there"),
    )
}

fn incomplete(coverage: &Coverage, gap: &Gap, span: Span, stock: Spanned<Stock>) -> Diagnostic {
    let plan = stock.node.width.to_mm() * stock.node.depth.to_mm();
    let area = coverage.uncovered.to_mm2();
    let [x, y] = gap.place.map(|part| shown(part.to_mm()));
    let [from, to] = [gap.low, gap.high].map(|corner| corner.map(|part| shown(part.to_mm())));
    let largest = match coverage.gaps.as_slice() {
        [_] => format!("nothing lies over x = {x}, y = {y}"),
        _ => format!(
            "the largest gap, {} mm2, is at x = {x}, y = {y}",
            number(gap.area.to_mm2())
        ),
    };
    Diagnostic::new(
        Code::SurfaceIncomplete,
        format!(
            "the surface has no height over {} mm2 of the stock ({} %)",
            number(area),
            number(shown_share(100.0 * area / plan))
        ),
        span,
        largest,
    )
    .and(stock.span, reach(stock.node))
    .note(format!(
        "the gap reaches from x = {} to x = {} and from y = {} to y = {}",
        from[0], to[0], from[1], to[1]
    ))
    .help("close the gap, or make the stock as large as the surface")
}

/// A coordinate in digits that matter.
fn shown(coordinate: f64) -> String {
    mm(to_um(coordinate))
}

/// A percentage in digits that matter.
fn shown_share(percent: f64) -> f64 {
    let parts = if percent >= 1.0 { 10.0 } else { 1000.0 };
    (percent * parts).ceil() / parts
}

/// The stock in plan.
fn reach(stock: Stock) -> String {
    format!(
        "the stock reaches to x = {} and y = {}",
        mm(stock.width.to_mm()),
        mm(stock.depth.to_mm())
    )
}

/// A mesh that lies beside the stock altogether.
pub(super) fn elsewhere(error: SurfaceError, span: Span, stock: Spanned<Stock>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::SurfaceIncomplete,
        "the surface lies beside the stock",
        span,
        "no height over all of the stock",
    )
    .and(stock.span, reach(stock.node));
    match error {
        SurfaceError::Elsewhere { low, high } => diagnostic.note(format!(
            "it reaches from x = {} to x = {} and from y = {} to y = {}",
            shown(low.x),
            shown(high.x),
            shown(low.y),
            shown(high.y)
        )),
        SurfaceError::BadPlan | SurfaceError::OutOfRange => diagnostic,
    }
}

/// The figure presumes that neighbouring triangles face the same way.
fn undercut(coverage: &Coverage, span: Span) -> Option<Diagnostic> {
    let area = coverage.undercut.to_mm2();
    (coverage.turned_edges == 0 && area > 0.0).then(|| {
        Diagnostic::new(
            Code::Undercut,
            format!("{} mm2 of the surface lie under other parts of it", number(area)),
            span,
            "this part has undercuts",
        )
        .note("the area is in plan, in all: where several parts of the surface lie under the highest one, each of them counts")
        .note("blades come from above, so what lies under the highest part of the surface stays")
        .help("leave it for another set-up, or turn the part by `place`")
    })
}

/// Checks that a surface lies within the height of the stock.
fn within(
    surface: &Surface,
    span: Span,
    stock: Spanned<Stock>,
    offer: &Offer<'_>,
    reports: &mut Reports,
) -> Checked<()> {
    let height = stock.node.height.to_mm();
    let mut fault = None;
    let above = surface.highest().filter(|place| place.z - height > SAME);
    if let Some(place) = above {
        let excess = mm(up(place.z - height));
        let diagnostic = outside(
            "the surface rises above the stock",
            place,
            place.z - height,
            span,
            stock,
        );
        fault = Some(reports.push(offer(diagnostic.help(format!(
            "make the stock at least {} high, or lower the surface by {excess}",
            mm(up(place.z))
        )))));
    }
    let below = surface.lowest_below(Length::mm(-SAME));
    let below = below.map_err(|error| tangled(error, span, reports))?;
    if let Some(place) = below {
        let diagnostic = outside("the surface sinks below the stock", place, -place.z, span, stock);
        let help = format!("raise the surface by {}", mm(up(-place.z)));
        fault = Some(reports.push(offer(diagnostic.help(help))));
    }
    fault.map_or(Ok(()), Err)
}

fn outside(headline: &str, place: Point3, by: f64, span: Span, stock: Spanned<Stock>) -> Diagnostic {
    let label = format!(
        "by up to {}, at x = {}, y = {}",
        mm(up(by)),
        shown(place.x),
        shown(place.y)
    );
    Diagnostic::new(Code::SurfaceOutsideStock, headline, span, label).and(
        stock.span,
        format!(
            "the stock reaches from z = 0 mm to z = {}",
            mm(stock.node.height.to_mm())
        ),
    )
}
