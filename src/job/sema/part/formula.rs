//! A part's height by formula: the expression as it is written, with the values that its names stand for.

use crate::sema::dimension::Dimension;
use crate::sema::eval::{Scope, walk};
use crate::sema::names::{Names, Thing};
use crate::sema::quantity::Quantity;
use crate::sema::report::{Checked, Reports};
use std::cell::Cell;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_geometry::curve::{Point2, SampleError, sample};
use vcutc_syntax::ast::Expr;

/// Most steps of evaluation that a formula is worth.
const MOST_STEPS: u64 = 200_000_000;

/// A height `z` over a variable.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Formula {
    variable: String,
    value: Spanned<Expr>,
    /// The values of the names in it, each with its place in the formula.
    values: Vec<(Spanned<String>, Quantity)>,
}

/// A formula while it is sampled.
#[derive(Clone, Copy)]
pub(crate) struct Sampling<'a> {
    pub(crate) variable: &'a str,
    pub(crate) value: &'a Spanned<Expr>,
    pub(crate) scope: Scope<'a>,
}

impl Sampling<'_> {
    /// The height at an x, both in mm.
    pub(crate) fn height(&self, x: f64, reports: &mut Reports) -> Checked<f64> {
        let variables = [(self.variable, Quantity::length(x))];
        let scope = Scope {
            variables: &variables,
            ..self.scope
        };
        scope.expect(self.value, Dimension::LENGTH, "`z`", Some("10 mm"), reports)
    }

    /// The polyline from x = 0 to a width in mm. Where a value is missing because the formula took too many steps, there are
    /// too many points.
    pub(crate) fn points(&self, width: f64, tolerance: Length) -> Result<Vec<Point2>, SampleError> {
        // A rough formula of a thousand operators must not keep the compiler busy for hours.
        let parts = walk(self.value).count() as u64;
        let left = Cell::new(MOST_STEPS / parts.max(1));
        let trial = |x: f64| {
            left.set(left.get().checked_sub(1)?);
            self.height(x, &mut Reports::default()).ok()
        };
        sample(&trial, 0.0, width, tolerance).map_err(|error| match error {
            SampleError::NoValue { .. } if left.get() == 0 => SampleError::TooManyPoints,
            error => error,
        })
    }

    /// The formula for itself: with the values of the names in it.
    pub(crate) fn closed(&self) -> Formula {
        let mut values: Vec<(Spanned<String>, Quantity)> = Vec::new();
        for part in walk(self.value) {
            let Expr::Name(name) = &part.node else { continue };
            let thing = self.scope.names.get(name).map(|definition| definition.thing);
            let Some(Thing::Let(index)) = thing else { continue };
            let is_new = values.iter().all(|(known, _)| known.node != *name);
            if let (true, Some(Some(Ok(value)))) = (is_new, self.scope.values.get(index)) {
                let name = Spanned {
                    node: name.clone(),
                    span: part.span,
                };
                values.push((name, *value));
            }
        }
        Formula {
            variable: self.variable.to_owned(),
            value: self.value.clone(),
            values,
        }
    }
}

impl Formula {
    /// As [`Sampling::points`].
    pub(super) fn points(&self, width: f64, tolerance: Length) -> Option<Vec<Point2>> {
        let mut names = Names::default();
        for (index, (name, _)) in self.values.iter().enumerate() {
            let name = Spanned {
                node: name.node.as_str(),
                span: name.span,
            };
            names.define(name, Thing::Let(index), &mut Reports::default());
        }
        let values: Vec<Option<Checked<Quantity>>> =
            self.values.iter().map(|(_, value)| Some(Ok(*value))).collect();
        let sampling = Sampling {
            variable: &self.variable,
            value: &self.value,
            scope: Scope {
                names: &names,
                lets: &[],
                values: &values,
                variables: &[],
            },
        };
        sampling.points(width, tolerance).ok()
    }

    /// Replaces every place in the job's text by this one.
    pub(super) fn forget_places(&mut self, place: Span) {
        forget(&mut self.value, place);
        for (name, _) in &mut self.values {
            name.span = place;
        }
    }
}

/// The depth of an expression, which the parser bounds, bounds the recursion.
fn forget(expr: &mut Spanned<Expr>, place: Span) {
    expr.span = place;
    match &mut expr.node {
        Expr::Number { unit, .. } => {
            if let Some(unit) = unit {
                unit.span = place;
            }
        }
        Expr::Text(_) | Expr::Name(_) => {}
        Expr::Call { function, arguments } => {
            function.span = place;
            for argument in arguments {
                if let Some(name) = &mut argument.name {
                    name.span = place;
                }
                forget(&mut argument.value, place);
            }
        }
        Expr::Negate(inner) => forget(inner, place),
        Expr::Binary {
            operator,
            left,
            right,
        } => {
            operator.span = place;
            forget(left, place);
            forget(right, place);
        }
        Expr::Tuple(values) => values.iter_mut().for_each(|value| forget(value, place)),
    }
}
