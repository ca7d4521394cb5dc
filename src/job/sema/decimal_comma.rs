//! A decimal comma between values: `45,5 mm` reads as two of them.

use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// The first number without a unit that has nothing but a comma between it and a next one with a unit.
pub(super) fn between<'v>(values: impl IntoIterator<Item = &'v Spanned<Expr>>) -> Option<Diagnostic> {
    let mut values = values.into_iter();
    let mut before = values.next()?;
    values.find_map(|value| diagnose(core::mem::replace(&mut before, value), value))
}

fn diagnose(before: &Spanned<Expr>, after: &Spanned<Expr>) -> Option<Diagnostic> {
    let Expr::Number { value, unit: None } = before.node else {
        return None;
    };
    let Expr::Number { unit: Some(_), .. } = after.node else {
        return None;
    };
    let comma = Span {
        start: before.span.end,
        end: after.span.start,
        ..before.span
    };
    let is_it = value.fract() == 0.0 && comma.bytes().len() == 1;
    is_it.then(|| {
        Diagnostic::new(
            Code::WrongKind,
            "a decimal comma",
            before.span.to(after.span),
            format!("decimals are written with a point; `{value}` has no unit"),
        )
        .fix("write a point, `.`, instead of the comma", comma, ".")
    })
}
