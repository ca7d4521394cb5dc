//! The value of an expression.
//!
//! Arithmetic keeps dimensions, every step must come out finite, and both sides of an operator are evaluated even
//! when one fails, so that one run shows all faults. Long chains such as `a + b + c + ...` lean to the left in the
//! tree and are walked in a loop; only real nesting costs depth, and that is bounded.

use super::dimension::Dimension;
use super::functions;
use super::mismatch::{Mismatch, offer_units, same_dimension};
use super::names::{Thing, did_you_mean};
use super::quantity::{Quantity, number};
use super::report::{Checked, Reports};
pub use super::scope::{Operand, Scope};
use super::units;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Expr, Operator};

/// Deepest nesting of an expression.
const DEEPEST: usize = 200;

impl Scope<'_> {
    /// The value of an expression.
    pub fn evaluate(&self, expr: &Spanned<Expr>, reports: &mut Reports) -> Checked<Quantity> {
        self.at_depth(expr, 0, reports)
    }

    /// The value of an expression that must have a certain dimension, in mm, rad, s, kg.
    pub fn expect(
        &self,
        expr: &Spanned<Expr>,
        wanted: Dimension,
        taker: &str,
        typical: Option<&str>,
        reports: &mut Reports,
    ) -> Checked<f64> {
        if let Some(unit) = unit_of(expr).filter(|unit| units::quantity(1.0, &unit.node).is_none()) {
            return Err(reports.push(unknown_unit(unit, Some(wanted))));
        }
        let found = self.evaluate(expr, reports)?;
        if found.dimension == wanted {
            return Ok(found.value);
        }
        let mismatch = Mismatch {
            taker,
            wanted,
            expr,
            found,
            typical,
        };
        Err(reports.push(mismatch.diagnostic(self)))
    }

    /// The value of an expression `depth` levels deep in another.
    pub fn at_depth(&self, expr: &Spanned<Expr>, depth: usize, reports: &mut Reports) -> Checked<Quantity> {
        if depth > DEEPEST {
            let diagnostic = Diagnostic::new(
                Code::NestedTooDeeply,
                "this expression is nested too deeply",
                expr.span,
                format!("more than {DEEPEST} levels deep"),
            )
            .help("give a part of it a name with `let`");
            return Err(reports.push(diagnostic));
        }
        let value = match &expr.node {
            Expr::Number { value, unit: None } => Quantity::pure(*value),
            Expr::Number {
                value,
                unit: Some(unit),
            } => units::quantity(*value, &unit.node).ok_or_else(|| reports.push(unknown_unit(unit, None)))?,
            Expr::Name(name) => return self.name(name, expr.span, reports),
            Expr::Call { function, arguments } => {
                functions::call(self, expr.span, function, arguments, depth, reports)?
            }
            Expr::Negate(inner) => {
                let inner = self.at_depth(inner, depth + 1, reports)?;
                Quantity::new(-inner.value, inner.dimension)
            }
            Expr::Binary { .. } => return self.chain(expr, depth, reports),
            Expr::Text(_) => return Err(reports.push(wrong_kind(expr.span, "a text"))),
            Expr::Tuple(_) => return Err(reports.push(wrong_kind(expr.span, "a list of values"))),
        };
        sensible(value, expr.span, reports)
    }

    /// Walks down the left sides of operators, then computes upwards again.
    fn chain(&self, expr: &Spanned<Expr>, depth: usize, reports: &mut Reports) -> Checked<Quantity> {
        let mut steps = Vec::new();
        let mut first = expr;
        while let Expr::Binary {
            operator,
            left,
            right,
        } = &first.node
        {
            steps.push((first, operator, left.as_ref(), right.as_ref()));
            first = left;
        }
        let mut value = self.at_depth(first, depth + 1, reports);
        for (whole, operator, left, right) in steps.into_iter().rev() {
            let beside = self.at_depth(right, depth + 1, reports);
            value = value.and_then(|quantity| {
                let left = Operand { expr: left, quantity };
                let right = Operand {
                    expr: right,
                    quantity: beside?,
                };
                let result = combine(*operator, left, right).map_err(|fault| reports.push(*fault))?;
                sensible(result, whole.span, reports)
            });
        }
        value
    }

    fn name(&self, name: &str, span: Span, reports: &mut Reports) -> Checked<Quantity> {
        if let Some((_, value)) = self.variables.iter().find(|(variable, _)| *variable == name) {
            return Ok(*value);
        }
        match name {
            "pi" => return Ok(Quantity::pure(core::f64::consts::PI)),
            "auto" => {
                let diagnostic = Diagnostic::new(
                    Code::WrongKind,
                    "`auto` is not a value to calculate with",
                    span,
                    "a value is needed here",
                )
                .help("write `auto` alone, as the whole value of a field that the compiler may choose");
                return Err(reports.push(diagnostic));
            }
            _ => {}
        }
        let is_let = |thing| matches!(thing, Thing::Let(_));
        match self.names.get(name).map(|definition| definition.thing) {
            Some(Thing::Let(index)) => match self.values.get(index) {
                Some(Some(value)) => *value,
                // Only in trials, before all values are known; the order of work avoids it elsewhere.
                Some(None) | None => Err(reports.push(Diagnostic::new(
                    Code::Internal,
                    format!("`{name}` is needed before its value is known"),
                    span,
                    "needed here",
                ))),
            },
            Some(Thing::Blade(_) | Thing::Region(_) | Thing::Machine(_)) | None => {
                Err(self.names.not_a("value", name, span, is_let, reports))
            }
        }
    }
}

/// An expression and all that are in it, from left to right, each before its parts.
pub fn walk(expr: &Spanned<Expr>) -> impl Iterator<Item = &Spanned<Expr>> {
    // A stack of its own: expressions may be long.
    let mut open = vec![expr];
    core::iter::from_fn(move || {
        let next = open.pop()?;
        match &next.node {
            Expr::Number { .. } | Expr::Text(_) | Expr::Name(_) => {}
            Expr::Call { arguments, .. } => {
                open.extend(arguments.iter().map(|argument| &argument.value).rev())
            }
            Expr::Negate(inner) => open.push(inner),
            Expr::Binary { left, right, .. } => open.extend([right.as_ref(), left.as_ref()]),
            Expr::Tuple(values) => open.extend(values.iter().rev()),
        }
        Some(next)
    })
}

/// A result that is a number and of a size that can mean something.
fn sensible(value: Quantity, span: Span, reports: &mut Reports) -> Checked<Quantity> {
    if value.is_sensible() {
        return Ok(value);
    }
    let label = if value.value.is_finite() {
        format!("the result is {}", value.text())
    } else {
        "this is too large to hold".to_owned()
    };
    let diagnostic = Diagnostic::new(Code::NotFinite, "this value is too large for a job", span, label)
        .note("values are limited to 1e9 mm, rad, s or kg")
        .help("check the units, and what is divided by what");
    Err(reports.push(diagnostic))
}

/// What an operator makes of its two sides.
fn combine(
    operator: Spanned<Operator>,
    left: Operand<'_>,
    right: Operand<'_>,
) -> Result<Quantity, Box<Diagnostic>> {
    let (a, b) = (left.quantity, right.quantity);
    match operator.node {
        Operator::Add => {
            same_dimension("+", left, right).map(|dimension| Quantity::new(a.value + b.value, dimension))
        }
        Operator::Subtract => {
            same_dimension("-", left, right).map(|dimension| Quantity::new(a.value - b.value, dimension))
        }
        Operator::Multiply => match a.dimension.times(b.dimension) {
            Some(dimension) => Ok(Quantity::new(a.value * b.value, dimension)),
            None => Err(no_dimension(operator.span)),
        },
        Operator::Divide if b.value == 0.0 => Err(Box::new(
            Diagnostic::new(
                Code::NotFinite,
                "division by zero",
                right.expr.span,
                "this is zero",
            )
            .and(left.expr.span, format!("{} is divided by it", a.text()))
            .help("make sure that the divisor cannot become zero"),
        )),
        Operator::Divide => match a.dimension.over(b.dimension) {
            Some(dimension) => Ok(Quantity::new(a.value / b.value, dimension)),
            None => Err(no_dimension(operator.span)),
        },
        Operator::Power => power(left, right),
    }
}

fn no_dimension(span: Span) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(
        Code::WrongDimension,
        "this product has no sensible dimension",
        span,
        "an exponent of its unit grows beyond 127",
    );
    Box::new(diagnostic.help("check which values are multiplied"))
}

fn power(base: Operand<'_>, exponent: Operand<'_>) -> Result<Quantity, Box<Diagnostic>> {
    let (a, b) = (base.quantity, exponent.quantity);
    if b.dimension != Dimension::PURE {
        let diagnostic = Diagnostic::new(
            Code::WrongDimension,
            format!("an exponent is a pure number, not {}", b.dimension.words()),
            exponent.expr.span,
            format!("this is {}", b.dimension.words()),
        );
        return Err(Box::new(offer_units(diagnostic, exponent.expr, Dimension::PURE)));
    }
    if a.value == 0.0 && b.value < 0.0 {
        let diagnostic = Diagnostic::new(
            Code::NotFinite,
            "division by zero",
            base.expr.span,
            "this is zero",
        )
        .and(exponent.expr.span, "a negative power divides by it");
        return Err(Box::new(diagnostic));
    }
    let is_whole = b.value.fract() == 0.0;
    if a.value < 0.0 && !is_whole {
        let diagnostic = Diagnostic::new(
            Code::NotFinite,
            format!("a negative number has no power of {}", number(b.value)),
            base.expr.span,
            format!("this is {}", a.text()),
        )
        .and(exponent.expr.span, "not a whole number");
        return Err(Box::new(diagnostic));
    }
    let dimension = if a.dimension == Dimension::PURE {
        Some(Dimension::PURE)
    } else {
        whole_exponent(b.value).and_then(|whole| a.dimension.power(whole))
    };
    match dimension {
        Some(dimension) => Ok(Quantity::new(libm::pow(a.value, b.value), dimension)),
        None => Err(Box::new(
            Diagnostic::new(
                Code::WrongDimension,
                format!(
                    "{} to the power {} has no dimension",
                    a.dimension.words(),
                    number(b.value)
                ),
                exponent.expr.span,
                "a value with a unit can only have small whole powers",
            )
            .and(base.expr.span, format!("this is {}", a.dimension.words()))
            .help("take `sqrt(...)` for a square root, or divide by one unit first to get a pure number"),
        )),
    }
}

/// A whole number small enough for an exponent of a dimension.
fn whole_exponent(value: f64) -> Option<i8> {
    let fits = value.fract() == 0.0 && value.abs() <= f64::from(i8::MAX);
    #[expect(clippy::cast_possible_truncation, reason = "whole and within the range")]
    fits.then_some(value as i8)
}

/// The unit of a number that is all of an expression.
fn unit_of(expr: &Spanned<Expr>) -> Option<&Spanned<String>> {
    let number = match &expr.node {
        Expr::Negate(inner) => &inner.node,
        number => number,
    };
    match number {
        Expr::Number { unit, .. } => unit.as_ref(),
        _ => None,
    }
}

/// The diagnostic for a unit that the language lacks; `wanted` is what the value has to be, where that is known.
fn unknown_unit(unit: &Spanned<String>, wanted: Option<Dimension>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownUnit,
        format!("there is no unit `{}`", unit.node),
        unit.span,
        "not a unit of the language",
    );
    let meant = match wanted {
        Some(wanted) => units::meant_for(&unit.node, wanted),
        None => units::meant(&unit.node),
    };
    let near: Vec<&str> = meant.iter().map(String::as_str).collect();
    let diagnostic = did_you_mean(diagnostic, unit.span, &near);
    let diagnostic = match units::conversion(&unit.node) {
        Some(words) => diagnostic.help(words),
        None => diagnostic,
    };
    diagnostic.note(format!(
        "units are {}, and quotients of two such as mm/s",
        units::list()
    ))
}

fn wrong_kind(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(
        Code::WrongKind,
        format!("{what} instead of a single value"),
        span,
        format!("this is {what}"),
    )
    .help("give one value with its unit, such as `4 mm`")
}
