//! Values: from the grammar's flat row of operands and operators to a tree.

use super::ast::{Argument, Expr, Operator};
use super::builder::Builder;
use super::grammar::Rule;
use super::place::unquoted;
use pest::iterators::Pair;
use pest::pratt_parser::{Assoc, ConstPrattParser, Op};
use vcutc_diagnostics::source::Spanned;
use vcutc_diagnostics::{Code, Diagnostic};

/// How many operators one value can have, with all that is in its brackets. Bounds the depth of the tree, and so the
/// recursion of everything that walks it.
const MOST_OPERATORS: usize = 250;

/// From loose to tight.
static PRECEDENCE: ConstPrattParser<Rule, 6> = ConstPrattParser::new_const([
    (Op::infix(Rule::add, Assoc::Left), true),
    (Op::infix(Rule::subtract, Assoc::Left), false),
    (Op::infix(Rule::multiply, Assoc::Left), true),
    (Op::infix(Rule::divide, Assoc::Left), false),
    (Op::prefix(Rule::negate), true),
    (Op::infix(Rule::power, Assoc::Right), true),
]);

impl Builder<'_> {
    /// A whole value; `None` when it is too large, which has then been reported.
    pub(super) fn value(&mut self, pair: Pair<'_, Rule>) -> Option<Spanned<Expr>> {
        if self.is_small(&pair) {
            self.expression(pair)
        } else {
            None
        }
    }

    /// What is in round brackets; `None` when it is too large, which has then been reported.
    pub(super) fn group_value(&mut self, pair: Pair<'_, Rule>) -> Option<Spanned<Expr>> {
        let span = self.place.span_of(&pair);
        if !self.is_small(&pair) {
            return None;
        }
        Some(Spanned::new(self.group(pair)?, span))
    }

    /// Whether a value has few enough operators, which is reported otherwise.
    fn is_small(&mut self, pair: &Pair<'_, Rule>) -> bool {
        let operators = pair
            .clone()
            .into_inner()
            .flatten()
            .filter(|part| operator(part.as_rule()).is_some() || part.as_rule() == Rule::negate)
            .count();
        if operators > MOST_OPERATORS {
            self.reports.push(
                Diagnostic::new(
                    Code::NestedTooDeeply,
                    format!("a value of {operators} operators"),
                    self.place.span_of(pair),
                    format!("one value can have at most {MOST_OPERATORS} operators"),
                )
                .help("name parts of it with `let`"),
            );
        }
        operators <= MOST_OPERATORS
    }

    fn expression(&mut self, pair: Pair<'_, Rule>) -> Option<Spanned<Expr>> {
        let place = self.place;
        PRECEDENCE
            .map_primary(|primary| self.primary(primary))
            .map_prefix(|minus, value| {
                let value = value?;
                let span = place.span_of(&minus).to(value.span);
                Some(Spanned::new(Expr::Negate(Box::new(value)), span))
            })
            .map_infix(|left, sign, right| {
                let (left, right) = (left?, right?);
                let span = left.span.to(right.span);
                let operator = Spanned::new(operator(sign.as_rule())?, place.span_of(&sign));
                let (left, right) = (Box::new(left), Box::new(right));
                Some(Spanned::new(
                    Expr::Binary {
                        operator,
                        left,
                        right,
                    },
                    span,
                ))
            })
            .parse(pair.into_inner())
    }

    fn primary(&mut self, pair: Pair<'_, Rule>) -> Option<Spanned<Expr>> {
        let span = self.place.span_of(&pair);
        let node = match pair.as_rule() {
            Rule::number => self.number(pair)?,
            Rule::text => Expr::Text(unquoted(pair.as_str())),
            Rule::name => Expr::Name(pair.as_str().to_owned()),
            Rule::call => self.call(pair)?,
            Rule::group => self.group(pair)?,
            _ => return None,
        };
        Some(Spanned::new(node, span))
    }

    fn number(&mut self, pair: Pair<'_, Rule>) -> Option<Expr> {
        let mut parts = pair.into_inner();
        let decimal = parts.next()?;
        let value: f64 = decimal.as_str().parse().ok()?;
        if !value.is_finite() {
            self.reports.push(
                Diagnostic::new(
                    Code::NumberTooLarge,
                    "this number is too large",
                    self.place.span_of(&decimal),
                    "numbers go up to about 1.8e308",
                )
                .help("check the exponent: `1.5e3` is 1500"),
            );
            return None;
        }
        let unit = parts.next().map(|unit| self.place.spanned(&unit));
        Some(Expr::Number { value, unit })
    }

    fn call(&mut self, pair: Pair<'_, Rule>) -> Option<Expr> {
        let mut parts = pair.into_inner();
        let function = self.place.spanned(&parts.next()?);
        let mut arguments = Vec::new();
        for part in parts.filter(|part| part.as_rule() == Rule::argument) {
            arguments.push(self.argument(part)?);
        }
        Some(Expr::Call { function, arguments })
    }

    fn argument(&mut self, pair: Pair<'_, Rule>) -> Option<Argument> {
        let mut name = None;
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::argument_name => name = Some(self.place.spanned(&part)),
                Rule::expression => {
                    let value = self.expression(part)?;
                    return Some(Argument { name, value });
                }
                _ => {}
            }
        }
        None
    }

    /// One value in brackets is that value, several are a tuple.
    fn group(&mut self, pair: Pair<'_, Rule>) -> Option<Expr> {
        let mut values = Vec::new();
        for part in pair
            .into_inner()
            .filter(|part| part.as_rule() == Rule::expression)
        {
            values.push(self.expression(part)?);
        }
        match values.pop() {
            Some(only) if values.is_empty() => Some(only.node),
            Some(last) => {
                values.push(last);
                Some(Expr::Tuple(values))
            }
            None => None,
        }
    }
}

const fn operator(rule: Rule) -> Option<Operator> {
    match rule {
        Rule::add => Some(Operator::Add),
        Rule::subtract => Some(Operator::Subtract),
        Rule::multiply => Some(Operator::Multiply),
        Rule::divide => Some(Operator::Divide),
        Rule::power => Some(Operator::Power),
        _ => None,
    }
}
