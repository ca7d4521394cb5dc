//! Values of the wrong dimension: the diagnostic, and the change that corrects it.
//!
//! By far the most frequent slip is a forgotten unit. The compiler can offer the change, whether the number
//! is in the field itself or in the `let` that the field names.

use super::dimension::Dimension;
use super::quantity::Quantity;
use super::scope::{Let, Operand, Scope};
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// A value where another dimension is wanted.
pub(crate) struct Mismatch<'a> {
    /// What takes it, as it goes into a sentence: `` `rake` ``.
    pub(crate) taker: &'a str,
    pub(crate) wanted: Dimension,
    pub(crate) expr: &'a Spanned<Expr>,
    /// Its value.
    pub(crate) found: Quantity,
    /// A value that works, such as `60 deg`, for use where no number was given.
    pub(crate) typical: Option<&'a str>,
}

impl Mismatch<'_> {
    pub(crate) fn diagnostic(&self, scope: &Scope<'_>) -> Diagnostic {
        let (wanted, found) = (self.wanted.words(), self.found.dimension.words());
        let (label, is_literal) = match literal(self.expr) {
            Some(Literal { unit: None, .. }) if self.wanted != Dimension::PURE => {
                ("its unit is missing".to_owned(), true)
            }
            Some(_) => (format!("this is {found}"), true),
            None => (format!("this is {found}, {}", self.found.text()), false),
        };
        let diagnostic = Diagnostic::new(
            Code::WrongDimension,
            format!("{} takes {wanted}, but this is {found}", self.taker),
            self.expr.span,
            label,
        );
        if is_literal {
            return self.of_number(diagnostic, self.expr);
        }
        match scope.let_named_by(self.expr) {
            Some(by) => self.through_name(diagnostic, by),
            None => self.of_expression(diagnostic),
        }
    }

    /// The value is a name: what must change is its definition.
    fn through_name(&self, diagnostic: Diagnostic, by: &Let<'_>) -> Diagnostic {
        let name = &by.name.node;
        let diagnostic = diagnostic.and(
            by.value.span,
            format!("`{name}` is {} because of this", self.found.dimension.words()),
        );
        if by.original.is_none() {
            return match literal(by.value) {
                Some(_) => self.of_number(diagnostic, by.value),
                None => self.of_expression(diagnostic),
            };
        }
        let unit = self.wanted.unit();
        let number = literal(by.value).map_or(self.found.value, |literal| literal.value);
        diagnostic.help(format!("give it as `--set \"{name}={number} {unit}\"`"))
    }

    /// The value is a number as it is written: its unit has to change.
    fn of_number(&self, diagnostic: Diagnostic, expr: &Spanned<Expr>) -> Diagnostic {
        let is_share =
            self.wanted == Dimension::PURE && self.typical.is_some_and(|typical| typical.ends_with('%'));
        match literal(expr) {
            // What is stated in percent mostly cannot be as large as the number alone.
            Some(Literal {
                value,
                unit: Some(unit),
            }) if is_share => diagnostic.fix(format!("write `{value} %`"), unit.span, "%"),
            _ => offer_units(diagnostic, expr, self.wanted),
        }
    }

    /// The value is a calculation, which only its author can correct.
    fn of_expression(&self, diagnostic: Diagnostic) -> Diagnostic {
        let unit = self.wanted.unit();
        let diagnostic = if self.found.dimension == Dimension::PURE && !unit.contains(['*', '^']) {
            let radians = match self.wanted {
                Dimension::ANGLE => ", or by `1 rad` where it counts radians",
                _ => "",
            };
            diagnostic.help(format!("multiply it by `1 {unit}`{radians}"))
        } else {
            let factor = self.wanted.over(self.found.dimension);
            match factor.filter(|factor| factor.unit().len() <= 8 && *factor != Dimension::PURE) {
                Some(factor) => diagnostic.help(format!("a factor in {} is missing", factor.unit())),
                None => diagnostic,
            }
        };
        match self.typical {
            Some("auto") => diagnostic.help("or write `auto` to let the compiler choose"),
            Some(typical) => diagnostic.help(format!("a typical value is `{typical}`")),
            None => diagnostic,
        }
    }
}

/// The common dimension of two values that are added or compared; `joint` is what joins them, as it is written.
pub(crate) fn same_dimension(
    joint: &str,
    left: Operand<'_>,
    right: Operand<'_>,
) -> Result<Dimension, Box<Diagnostic>> {
    let (a, b) = (left.quantity.dimension, right.quantity.dimension);
    if a == b {
        return Ok(a);
    }
    let diagnostic = Diagnostic::new(
        Code::WrongDimension,
        format!(
            "`{joint}` takes values of one kind, not {} and {}",
            a.words(),
            b.words()
        ),
        right.expr.span,
        format!("this is {}", b.words()),
    )
    .and(left.expr.span, format!("this is {}", a.words()));
    // The one without a unit is the one to change.
    let diagnostic = match (a == Dimension::PURE, b == Dimension::PURE) {
        (true, false) => offer_units(diagnostic, left.expr, b),
        (false, true) => offer_units(diagnostic, right.expr, a),
        _ => diagnostic.help("give both the same kind of unit"),
    };
    Err(Box::new(diagnostic))
}

/// A number as it is written, a minus before it included.
struct Literal<'a> {
    value: f64,
    unit: Option<&'a Spanned<String>>,
}

fn literal(expr: &Spanned<Expr>) -> Option<Literal<'_>> {
    let (sign, number) = if let Expr::Negate(inner) = &expr.node {
        (-1.0, &inner.node)
    } else {
        (1.0, &expr.node)
    };
    let Expr::Number { value, unit } = number else {
        return None;
    };
    Some(Literal {
        value: sign * value,
        unit: unit.as_ref(),
    })
}

/// Offers the units that make a number what is wanted.
pub(crate) fn offer_units(diagnostic: Diagnostic, expr: &Spanned<Expr>, wanted: Dimension) -> Diagnostic {
    let Some(Literal { value, unit }) = literal(expr) else {
        return diagnostic;
    };
    match unit {
        None => units_for(wanted).iter().fold(diagnostic, |diagnostic, unit| {
            let title = format!("write `{value} {unit}`");
            diagnostic.fix(title, expr.span.after(), format!(" {unit}"))
        }),
        Some(unit) => match units_for(wanted).first() {
            Some(better) => {
                let title = format!("write `{value} {better}`");
                diagnostic.fix(title, unit.span, better.clone())
            }
            None => diagnostic.fix(format!("delete the unit: `{value}`"), unit.span, ""),
        },
    }
}

/// The units to offer for a dimension, the most usual first; none for a pure number.
fn units_for(wanted: Dimension) -> Vec<String> {
    match wanted {
        Dimension::PURE => Vec::new(),
        Dimension::ANGLE => vec!["deg".to_owned(), "rad".to_owned()],
        other => vec![other.unit()],
    }
}
