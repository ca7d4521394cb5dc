//! `stock { ... }`: the box that is cut from.

use super::decimal_comma;
use super::eval::Scope;
use super::field_ranges::SIZE;
use super::fields::{BlockSpec, Fields, Inner, Place, value};
use super::read::{Reader, looks_like};
use super::report::{Checked, Reported};
use super::session::Session;
use crate::Sourced;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, Expr};

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`stock`",
    fields: &[
        value("size", "(85 mm, 50 mm, 50 mm)").required().within(SIZE),
        value("cell_size", "3.2 mm").within(SIZE),
    ],
    inner: Inner::Refused,
};

/// What a block says of the stock.
pub(crate) struct CheckedStock {
    pub(crate) size: Spanned<Stock>,
    /// From wall to wall of the core's cells.
    pub(crate) cell_size: Option<Sourced<Length>>,
}

/// The stock and where its size is.
pub(crate) fn check(
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<CheckedStock> {
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let cell_size = reader.optional(&fields, "cell_size");
    let size = fields.required_value("size", reader.reports)?;
    let Expr::Tuple(sides) = &size.node else {
        return Err(reader.reports.push(not_three(size.span, looks_like(&size.node))));
    };
    let [width, depth, height] = sides.as_slice() else {
        let count = format!("a list of {}", sides.len());
        let diagnostic = decimal_comma::between(sides).unwrap_or_else(|| not_three(size.span, &count));
        return Err(reader.reports.push(diagnostic));
    };
    let mut side = |expr: &Spanned<Expr>, taker: &str| -> Result<Length, Reported> {
        reader.within(expr, SIZE, taker, Some("50 mm")).map(Length::mm)
    };
    let width = side(width, "the width (along x)");
    let depth = side(depth, "the depth (along y)");
    let height = side(height, "the height (along z)");
    let stock = Stock {
        width: width?,
        depth: depth?,
        height: height?,
    };
    Ok(CheckedStock {
        size: Spanned::new(stock, size.span),
        cell_size: cell_size?,
    })
}

fn not_three(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(
        Code::WrongKind,
        format!("`size` takes three lengths, not {what}"),
        span,
        "expected three lengths here",
    )
    .help("give width (x), depth (y) and height (z), like `size = (85 mm, 50 mm, 50 mm)`")
}
