//! Values of the wrong dimension: the diagnostic, and the change that mends it.
//!
//! By far the most frequent slip is a forgotten unit. It has a mend that a machine can make, whether the number
//! stands in the field itself or in the `let` that the field names.

use super::dimension::Dimension;
use super::eval::Scope;
use super::lets::Let;
use super::quantity::Quantity;
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// What stands where another dimension is wanted.
pub(crate) struct Mismatch<'a> {
    /// Who wants it, as it goes into a sentence: `` `rake` ``.
    pub(crate) taker: &'a str,
    pub(crate) wanted: Dimension,
    pub(crate) expr: &'a Spanned<Expr>,
    /// What that comes out as.
    pub(crate) found: Quantity,
    /// A value that works, such as `60 deg`, for those who gave no number to build on.
    pub(crate) typical: Option<&'a str>,
}

impl Mismatch<'_> {
    pub(crate) fn diagnostic(&self, scope: &Scope<'_>) -> Diagnostic {
        let (wanted, found) = (self.wanted.words(), self.found.dimension.words());
        let (label, mends) = match literal(self.expr) {
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
        if mends {
            return mend(diagnostic, self.expr, self.wanted);
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
                Some(_) => mend(diagnostic, by.value, self.wanted),
                None => self.of_expression(diagnostic),
            };
        }
        let unit = self.wanted.unit();
        let number = literal(by.value).map_or(self.found.value, |literal| literal.value);
        diagnostic.help(format!("give it as `--set \"{name}={number} {unit}\"`"))
    }

    /// The value is a calculation, which only its author can put right.
    fn of_expression(&self, diagnostic: Diagnostic) -> Diagnostic {
        let unit = self.wanted.unit();
        let diagnostic = if self.found.dimension == Dimension::PURE && !unit.contains(['*', '^']) {
            diagnostic.help(format!("multiply it by `1 {unit}`"))
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

/// A number as it stands in the text, a minus before it included.
struct Literal<'a> {
    value: f64,
    unit: Option<&'a Spanned<String>>,
}

fn literal(expr: &Spanned<Expr>) -> Option<Literal<'_>> {
    match &expr.node {
        Expr::Number { value, unit } => Some(Literal {
            value: *value,
            unit: unit.as_ref(),
        }),
        Expr::Negate(inner) => match &inner.node {
            Expr::Number { value, unit } => Some(Literal {
                value: -value,
                unit: unit.as_ref(),
            }),
            Expr::Text(_)
            | Expr::Name(_)
            | Expr::Call { .. }
            | Expr::Negate(_)
            | Expr::Binary { .. }
            | Expr::Tuple(_) => None,
        },
        Expr::Text(_) | Expr::Name(_) | Expr::Call { .. } | Expr::Binary { .. } | Expr::Tuple(_) => None,
    }
}

/// Offers the units that make a number what is wanted.
pub(crate) fn mend(diagnostic: Diagnostic, expr: &Spanned<Expr>, wanted: Dimension) -> Diagnostic {
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
