//! `stock { ... }`: the box that is cut from.

use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, Place, value};
use super::range::SIZE;
use super::read::{Reader, looks_like};
use super::report::{Checked, Reported};
use super::session::Session;
use crate::diag::{Code, Diagnostic};
use crate::source::{Span, Spanned};
use crate::syntax::ast::{Block, Expr};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`stock`",
    fields: &[value("size", "(85 mm, 50 mm, 50 mm)").required().within(SIZE)],
    inner: Inner::Refused,
};

/// The stock and where its size stands.
pub(crate) fn check(
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Spanned<Stock>> {
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let size = fields.required_value("size", reader.reports)?;
    let Expr::Tuple(sides) = &size.node else {
        return Err(reader.reports.push(not_three(size.span, looks_like(&size.node))));
    };
    let [width, depth, height] = sides.as_slice() else {
        let count = format!("a list of {}", sides.len());
        let diagnostic = decimal_comma(sides).unwrap_or_else(|| not_three(size.span, &count));
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
    Ok(Spanned::new(stock, size.span))
}

/// `45,5 mm` among the sides: a number without a unit, and with nothing but a comma between it and the next.
fn decimal_comma(sides: &[Spanned<Expr>]) -> Option<Diagnostic> {
    let whole = |side: &Spanned<Expr>| match side.node {
        Expr::Number { value, unit: None } if value.fract() == 0.0 => Some(value),
        _ => None,
    };
    sides.windows(2).find_map(|pair| {
        let [before, behind] = pair else { return None };
        let value = whole(before)?;
        let Expr::Number { unit: Some(_), .. } = behind.node else {
            return None;
        };
        let comma = Span {
            start: before.span.end,
            end: behind.span.start,
            ..before.span
        };
        (comma.bytes().len() == 1).then(|| {
            Diagnostic::new(
                Code::WrongKind,
                "a decimal comma",
                before.span.to(behind.span),
                format!("decimals are written with a point; `{value}` has no unit"),
            )
            .fix("write a point", comma, ".")
        })
    })
}

fn not_three(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(
        Code::WrongKind,
        format!("`size` takes three lengths, not {what}"),
        span,
        "three lengths are wanted here",
    )
    .help("give width (x), depth (y) and height (z), like `size = (85 mm, 50 mm, 50 mm)`")
}
