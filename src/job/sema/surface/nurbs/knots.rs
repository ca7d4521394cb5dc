//! Knots of a surface: given as a list, or uniform and clamped.

use super::Direction;
use crate::sema::fields::Fields;
use crate::sema::quantity::number;
use crate::sema::read::{Reader, looks_like};
use crate::sema::report::Checked;
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::schema::range::Range;
use vcutc_diagnostics::source::{SourceMap, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

const KNOT: Range = Range::closed(Dimension::PURE, -1e9, 1e9);

/// The knots in a direction, of a degree and so many control points: those that are given, or uniform ones.
pub(super) fn read(
    fields: &Fields<'_>,
    direction: Direction,
    [degree, count]: [usize; 2],
    sources: &SourceMap,
    reader: &mut Reader<'_>,
) -> Checked<Vec<f64>> {
    let name = direction.knots();
    let uniform = uniform(degree, count);
    let Some(expr) = fields.value(name)? else {
        return Ok(uniform);
    };
    let offer = |diagnostic: Diagnostic| {
        let text: Vec<String> = uniform.iter().map(|knot| number(*knot)).collect();
        diagnostic.fix("take uniform knots", expr.span, format!("({})", text.join(", ")))
    };
    let Expr::Tuple(parts) = &expr.node else {
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!("`{name}` takes a list of knots, not {}", looks_like(&expr.node)),
            expr.span,
            "expected numbers in round brackets here",
        );
        return Err(reader.reports.push(offer(diagnostic)));
    };
    let taker = format!("a knot of `{name}`");
    let read: Vec<Checked<f64>> = parts
        .iter()
        .map(|part| reader.within(part, KNOT, &taker, None))
        .collect();
    let knots: Vec<f64> = read.into_iter().collect::<Checked<_>>()?;
    let expected = count + degree + 1;
    let at = |index: usize| parts.get(index).map_or(expr.span, |part| part.span);
    let fault = if let Some(index) = knots.windows(2).position(|pair| pair[0] > pair[1]) {
        let diagnostic = Diagnostic::new(
            Code::ImpossibleSurface,
            format!("the knots of `{name}` do not ascend"),
            at(index + 1),
            "less than the one before",
        )
        .and(at(index), "the one before");
        Some(diagnostic.fix(
            "put the knots in order",
            expr.span,
            in_order(parts, &knots, sources),
        ))
    } else if knots.len() != expected {
        let diagnostic = Diagnostic::new(
            Code::ImpossibleSurface,
            format!("`{name}` has {} knots, where {expected} are needed", knots.len()),
            expr.span,
            format!(
                "{} and degree {degree} take {expected} knots",
                direction.counted(count)
            ),
        );
        Some(offer(diagnostic))
    } else {
        repeated(&knots, degree).map(|index| {
            let diagnostic = Diagnostic::new(
                Code::ImpossibleSurface,
                format!("a knot of `{name}` repeats too often"),
                at(index),
                format!(
                    "at degree {degree} at most {} knots are equal at either end, and {degree} in between",
                    degree + 1
                ),
            );
            offer(diagnostic)
        })
    };
    match fault {
        Some(fault) => Err(reader.reports.push(fault)),
        None => Ok(knots),
    }
}

/// Knots at equal distances, so often at the ends that the surface reaches its outer control points.
fn uniform(degree: usize, count: usize) -> Vec<f64> {
    let end = count.saturating_sub(degree);
    let knot = |index: usize| index.saturating_sub(degree).min(end) as f64;
    (0..count + degree + 1).map(knot).collect()
}

/// The first knot that repeats so often that the surface falls apart there, or has no extent.
fn repeated(knots: &[f64], degree: usize) -> Option<usize> {
    let inner = knots.get(1..knots.len().saturating_sub(1))?;
    let start = inner
        .windows(degree + 1)
        .position(|window| window.first() == window.last())?;
    Some(start + degree + 1)
}

/// The knots as they are written, in the order of their values.
fn in_order(parts: &[Spanned<Expr>], knots: &[f64], sources: &SourceMap) -> String {
    let mut texts: Vec<(f64, &str)> = knots
        .iter()
        .zip(parts)
        .map(|(knot, part)| (*knot, sources.slice(part.span)))
        .collect();
    texts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let texts: Vec<&str> = texts.into_iter().map(|(_, text)| text).collect();
    format!("({})", texts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_knots_are_clamped() {
        assert_eq!(uniform(1, 2), [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(uniform(2, 5), [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]);
        for degree in 1..6 {
            for count in degree + 1..degree + 5 {
                assert_eq!(repeated(&uniform(degree, count), degree), None);
            }
        }
        assert_eq!(repeated(&[0.0, 0.0, 0.0, 1.0], 1), Some(2));
        assert_eq!(repeated(&[0.0, 0.0, 1.0, 1.0, 2.0, 2.0], 1), Some(3));
    }
}
