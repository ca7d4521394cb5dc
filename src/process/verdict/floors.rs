//! Floors of pockets that have nothing above them.

use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{NamedRegion, Sourced};

/// The operations before have left nothing of the stock over the region above the floor. `head` is the operation.
#[must_use]
pub fn nothing_left_above(
    floor: Sourced<Length>,
    head: Span,
    region: &NamedRegion,
    top: Length,
) -> Diagnostic {
    let of_stock = format!("the stock over `{}`", region.name);
    nothing_above(floor, head, &of_stock, top)
}

/// The floor lies above the stock.
#[must_use]
pub fn above_the_stock(floor: Sourced<Length>, head: Span, stock: Spanned<Stock>) -> Diagnostic {
    nothing_above(floor, head, "the stock", stock.node.height).and(stock.span, "the stock")
}

/// Offers a floor over which the body of a straight blade, `by` below the top of the stock in a slit, is clear of it.
#[must_use]
pub fn with_higher_floor(diagnostic: Diagnostic, floor: Length, by: Length) -> Diagnostic {
    diagnostic.help(format!(
        "use a longer blade, or a floor at {} mm or above",
        show(((floor + by).to_mm() * 100.0).ceil() / 100.0)
    ))
}

fn nothing_above(floor: Sourced<Length>, head: Span, of_stock: &str, top: Length) -> Diagnostic {
    let top = show(top.to_mm());
    Diagnostic::new(
        Code::PocketOutside,
        format!(
            "the floor of the pocket is {} mm high, {of_stock} {top} mm",
            show(floor.value.to_mm())
        ),
        floor.span.unwrap_or(head),
        "nothing to clear above it",
    )
    .help(format!("use a floor below {top} mm"))
}
