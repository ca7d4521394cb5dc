//! What keeps a region from being cut into a stock.

use crate::NamedRegion;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_region::place::Place;
use vcutc_region::region::Side;

/// Coordinates that should be equal may differ by this, in mm.
const SAME: f64 = 1e-6;

/// What is wrong with a region that leaves the stock, or is open towards core. `named` is where an operation names it.
#[must_use]
pub fn beyond_stock(region: &NamedRegion, named: Span, stock: Spanned<Stock>) -> Option<Diagnostic> {
    let [width, depth] = [stock.node.width, stock.node.depth].map(Length::to_mm);
    let bounds = region.region.bounds();
    let (low, high) = (bounds.low, bounds.high);
    let is_within = low.x >= -SAME && low.y >= -SAME && high.x <= width + SAME && high.y <= depth + SAME;
    if !is_within {
        let diagnostic = Diagnostic::new(
            Code::PocketOutside,
            format!(
                "`{}` reaches from ({} mm, {} mm) to ({} mm, {} mm), the stock from (0 mm, 0 mm) to ({} mm, {} mm)",
                region.name,
                show(low.x),
                show(low.y),
                show(high.x),
                show(high.y),
                show(width),
                show(depth)
            ),
            named,
            "reaches out of the stock",
        );
        return Some(
            diagnostic
                .and(region.span, "defined here")
                .and(stock.span, "the stock")
                .help("end the region at the side of the stock, with `open to` along it"),
        );
    }
    let open = region.region.edges().filter(|edge| edge.side == Side::Open);
    let mut inner = open.filter(|edge| {
        let ends = [edge.piece.from, edge.piece.to];
        let on = |is_on: &dyn Fn(Place) -> bool| ends.iter().all(|&end| is_on(end));
        let is_at_a_side = on(&|end| end.x.abs() <= SAME)
            || on(&|end| (end.x - width).abs() <= SAME)
            || on(&|end| end.y.abs() <= SAME)
            || on(&|end| (end.y - depth).abs() <= SAME);
        !is_at_a_side
    });
    let edge = inner.next()?;
    let (from, to) = (edge.piece.from, edge.piece.to);
    Some(
        Diagnostic::new(
            Code::OpenSideBlocked,
            format!(
                "core stands beyond the open side from ({} mm, {} mm) to ({} mm, {} mm) of `{}`",
                show(from.x),
                show(from.y),
                show(to.x),
                show(to.y),
                region.name
            ),
            named,
            "open where core stands",
        )
        .and(region.span, "defined here")
        .help("draw it with `line to`, or along a side of the stock"),
    )
}
