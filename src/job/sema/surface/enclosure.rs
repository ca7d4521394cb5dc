//! A formula of x and y over boxes of the plan: its values, slopes and curvatures, enclosed.
//!
//! The expression is compiled once: what does not depend on x and y becomes a number, as it is worth anywhere else. Units and
//! dimensions are settled before: everything is in mm, rad, s and kg.

use crate::sema::eval::Scope;
use crate::sema::functions::{self, Height, Over};
use crate::sema::part::Part;
use crate::sema::quantity::Quantity;
use crate::sema::report::Reports;
use std::cell::Cell;
use vcutc_diagnostics::source::Spanned;
use vcutc_geometry::number::{Interval, Scalar};
use vcutc_surface::curvature::Curvature;
use vcutc_syntax::ast::{Argument, Expr, Operator};

/// Most steps of evaluation that a formula is worth: some seconds where nothing is optimised.
const MOST_STEPS: u64 = 8_000_000;

/// Distances in mm at which a height that grows without limit shows, and by how much it grows at least from one to the other:
/// that of the inverse of a root grows by 32.
const NEAR: [f64; 2] = [1e-3, 1e-6];
const GROWTH: f64 = 10.0;

/// Slopes and second derivatives (in 1/mm) that are enclosed more widely are not known.
const UNSURE: f64 = 1e-6;

/// Directions in which it is looked for: none along an axis, on which formulas like to change.
const RING: [[f64; 2]; 8] = [
    [1.0, 0.3],
    [0.3, 1.0],
    [-0.3, 1.0],
    [-1.0, 0.3],
    [-1.0, -0.3],
    [-0.3, -1.0],
    [0.3, -1.0],
    [1.0, -0.3],
];

/// What heights do about a place that triangles do not follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Around {
    /// They grow without limit.
    Grows,
    /// They differ however near they are.
    Steps,
    /// Neither shows.
    Unknown,
}

/// A part of a formula.
enum Node {
    /// x (0) or y (1).
    Variable(usize),
    Constant(f64),
    Negated(Box<Node>),
    Binary(Operator, Box<[Node; 2]>),
    Call(Over, Vec<Node>),
}

/// A formula ready to be evaluated.
pub(super) struct Compiled {
    root: Node,
    parts: u64,
}

impl Compiled {
    /// Compiles a formula that has a value somewhere. None if a part that does not depend on x and y has none.
    pub(super) fn of(expr: &Spanned<Expr>, variables: [&str; 2], scope: Scope<'_>) -> Option<Self> {
        let mut compiler = Compiler {
            variables,
            scope,
            parts: 0,
        };
        let root = compiler.node(expr)?;
        Some(Self {
            root,
            parts: compiler.parts.max(1),
        })
    }

    /// What the heights do about a place, in mm.
    pub(super) fn around(&self, place: [f64; 2]) -> Around {
        let [far, near] = NEAR.map(|distance| self.ring(place, distance));
        let largest = |heights: &[f64]| {
            heights
                .iter()
                .fold(0.0_f64, |most, height| most.max(height.abs()))
        };
        if largest(&near) > GROWTH * largest(&far) {
            return Around::Grows;
        }
        let end = |pick: fn(f64, f64) -> f64| near.iter().copied().reduce(pick).unwrap_or_default();
        let is_known = near.len() == RING.len();
        if is_known && end(f64::max) - end(f64::min) > Part::SURFACE_TOLERANCE.to_mm() {
            return Around::Steps;
        }
        Around::Unknown
    }

    /// The curvature at a place, in mm, by the derivatives there. None at an edge, at which they are not known.
    pub(super) fn curvature(&self, [x, y]: [f64; 2]) -> Option<Curvature> {
        let exactly = |axis, value| Height::coordinate(axis, Interval::exactly(value));
        let height = self.root.value([exactly(0, x), exactly(1, y)])?;
        let is_known = |part: &Interval| part.width() < UNSURE;
        let is_known = height.by.iter().chain(&height.curve).all(is_known);
        is_known.then(|| {
            Curvature::of_height(
                height.by.map(Interval::middle),
                height.curve.map(Interval::middle),
            )
        })?
    }

    /// The heights at so many mm from a place, where there are any.
    fn ring(&self, [x, y]: [f64; 2], distance: f64) -> Vec<f64> {
        let exactly = |axis, value| Height::coordinate(axis, Interval::exactly(value));
        let heights = RING.iter().filter_map(|[across, along]| {
            let at = [
                exactly(0, x + distance * across),
                exactly(1, y + distance * along),
            ];
            self.root.value(at).map(|height| height.value.middle())
        });
        heights.collect()
    }

    /// The formula with a bound on how often it is evaluated.
    pub(super) const fn metered(&self) -> Metered<'_> {
        Metered {
            formula: self,
            left: Cell::new(MOST_STEPS / self.parts),
        }
    }
}

/// A formula that is evaluated a limited number of times.
pub(super) struct Metered<'a> {
    formula: &'a Compiled,
    left: Cell<u64>,
}

impl Metered<'_> {
    /// The height over a box; none where it has no value in it, and once it was evaluated too often.
    pub(super) fn value(&self, x: Height, y: Height) -> Option<Height> {
        self.left.set(self.left.get().checked_sub(1)?);
        self.formula.root.value([x, y])
    }

    pub(super) const fn is_used_up(&self) -> bool {
        self.left.get() == 0
    }
}

impl Node {
    /// The depth of an expression, which the parser bounds, bounds the recursion.
    fn value(&self, place: [Height; 2]) -> Option<Height> {
        let value = match self {
            Self::Variable(number) => return place.get(*number).copied(),
            Self::Constant(value) => return Some(Height::constant(*value)),
            Self::Negated(inner) => inner.value(place)?.negated(),
            Self::Binary(operator, sides) => {
                let [left, right] = &**sides;
                let (left, right) = (left.value(place)?, right.value(place)?);
                match operator {
                    Operator::Add => left + right,
                    Operator::Subtract => left - right,
                    Operator::Multiply => left * right,
                    Operator::Divide => left.divided(right)?,
                    Operator::Power => left.power(right)?,
                }
            }
            Self::Call(over, arguments) => call(*over, arguments, place)?,
        };
        value.tamed()
    }
}

fn call(over: Over, arguments: &[Node], place: [Height; 2]) -> Option<Height> {
    match (over, arguments) {
        (Over::One(f), [a]) => f(a.value(place)?),
        (Over::Two(f), [first, rest @ ..]) if !rest.is_empty() => {
            let mut value = first.value(place)?;
            for next in rest {
                value = f(value, next.value(place)?)?.tamed()?;
            }
            Some(value)
        }
        (Over::Three(f), [a, b, c]) => f(a.value(place)?, b.value(place)?, c.value(place)?),
        // The count of values was checked before.
        (Over::One(_) | Over::Two(_) | Over::Three(_), _) => None,
    }
}

struct Compiler<'a> {
    variables: [&'a str; 2],
    scope: Scope<'a>,
    parts: u64,
}

impl Compiler<'_> {
    fn node(&mut self, expr: &Spanned<Expr>) -> Option<Node> {
        self.parts += 1;
        Some(match &expr.node {
            Expr::Name(name) => match self.variables.iter().position(|variable| variable == name) {
                Some(number) => Node::Variable(number),
                None => self.constant(expr)?,
            },
            Expr::Number { .. } => self.constant(expr)?,
            Expr::Negate(inner) => match self.node(inner)? {
                Node::Constant(value) => Node::Constant(-value),
                inner => Node::Negated(Box::new(inner)),
            },
            Expr::Binary {
                operator,
                left,
                right,
            } => match [self.node(left)?, self.node(right)?] {
                [Node::Constant(_), Node::Constant(_)] => self.constant(expr)?,
                sides => Node::Binary(operator.node, Box::new(sides)),
            },
            Expr::Call { function, arguments } => self.call(expr, &function.node, arguments)?,
            Expr::Text(_) | Expr::Tuple(_) => return None,
        })
    }

    fn call(&mut self, expr: &Spanned<Expr>, function: &str, arguments: &[Argument]) -> Option<Node> {
        let values = arguments.iter().map(|argument| self.node(&argument.value));
        let values: Vec<Node> = values.collect::<Option<_>>()?;
        if values.iter().all(|value| matches!(value, Node::Constant(_))) {
            return self.constant(expr);
        }
        Some(Node::Call(functions::over(function)?, values))
    }

    /// What an expression without x and y is worth.
    fn constant(&self, expr: &Spanned<Expr>) -> Option<Node> {
        let value: Quantity = self.scope.evaluate(expr, &mut Reports::default()).ok()?;
        Some(Node::Constant(value.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sema::names::Names;
    use crate::sema::report::Checked;
    use vcutc_diagnostics::source::SourceMap;
    use vcutc_syntax as syntax;

    /// Every function, and operators in all positions.
    const FORMULAS: &[&str] = &[
        "40 mm - (x - 30 mm)^2 / 300 mm - (y - 50 mm)^2 / 600 mm",
        "10 mm * sin(x / 50 mm * 1 rad) * cos(y / 80 mm * 1 rad) + 20 mm",
        "sqrt(x^2 + y^2 + 1 mm^2)",
        "min(x, y, 30 mm) + max(x / 2, y / 3)",
        "clamp(x - y, -10 mm, 10 mm) + abs(x - 20 mm)",
        "30 mm * 2^(-(x / 30 mm)^2)",
        "x * y / (x + 100 mm) - -y",
        "atan2(y + 1 mm, x - 30 mm) / (1 rad) * 1 mm",
        "1 mm * (tan(x / 100 mm * 1 rad) + asin(y / 200 mm) / (1 rad) + acos(x / 200 mm) / (1 rad) + atan(y / x) / (1 rad))",
        "(x / 1 mm)^0.5 * 1 mm + (y / 10 mm)^-1 * 1 mm",
    ];

    fn both(text: &str, low: [f64; 2], size: [f64; 2], share: [f64; 2]) -> (Option<Height>, Checked<f64>) {
        let file = SourceMap::default().add("", text);
        let expr = syntax::parse_expression(file, text, 0, &mut Vec::new()).unwrap();
        let names = Names::default();
        let [x, y] = [0, 1].map(|axis| low[axis] + size[axis] * share[axis]);
        let variables = [("x", Quantity::length(x)), ("y", Quantity::length(y))];
        let scope = Scope {
            names: &names,
            lets: &[],
            values: &[],
            variables: &[],
        };
        let compiled = Compiled::of(&expr, ["x", "y"], scope).unwrap();
        let range = |axis: usize| {
            Height::coordinate(
                axis,
                Interval {
                    low: low[axis],
                    high: low[axis] + size[axis],
                },
            )
        };
        let enclosed = compiled.metered().value(range(0), range(1));
        let scope = Scope {
            variables: &variables,
            ..scope
        };
        let plain = scope.evaluate(&expr, &mut Reports::default());
        (enclosed, plain.map(|quantity| quantity.value))
    }

    #[test]
    fn values_at_places_lie_in_what_is_enclosed_over_the_box() {
        // Multiples of the golden ratio fill the interval from 0 to 1 evenly.
        let mut state = 0.0_f64;
        let mut share = || {
            state = (state + 0.618_033_988_749_894_9).fract();
            state
        };
        for _ in 0..400 {
            let [low, size, place] = [0; 3].map(|_| [share(), share()]);
            let (low, size) = (low.map(|low| 0.1 + 100.0 * low), size.map(|size| 20.0 * size));
            for text in FORMULAS {
                if let (Some(enclosed), Ok(plain)) = both(text, low, size, place) {
                    let slack = 1e-12 * (1.0 + plain.abs());
                    let (low, high) = (enclosed.value.low - slack, enclosed.value.high + slack);
                    assert!(
                        low <= plain && plain <= high,
                        "{text}: {plain} in {:?}",
                        enclosed.value
                    );
                }
            }
        }
    }

    #[test]
    fn narrow_boxes_are_enclosed_narrowly() {
        for text in FORMULAS {
            let (enclosed, plain) = both(text, [40.0, 70.0], [1e-6, 1e-6], [0.5, 0.5]);
            let enclosed = enclosed.unwrap_or_else(|| panic!("{text} has no value"));
            assert!(plain.is_ok(), "{text}");
            assert!(enclosed.value.width() < 1e-4, "{text}: {:?}", enclosed.value);
        }
    }
}
