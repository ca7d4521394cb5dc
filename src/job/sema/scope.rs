//! What names stand for in an expression.

use super::names::{Names, Thing};
use super::quantity::Quantity;
use super::report::Checked;
use vcutc_diagnostics::source::Spanned;
use vcutc_syntax::ast::Expr;

/// A `let`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Let<'a> {
    pub(crate) name: &'a Spanned<String>,
    /// What it is worth: the file's word, or that of the command line.
    pub(crate) value: &'a Spanned<Expr>,
    /// What the file says, when the command line says something else.
    pub(crate) original: Option<&'a Spanned<Expr>>,
}

/// What names stand for while an expression is evaluated.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    /// All names of the job.
    pub names: &'a Names<'a>,
    /// The job's `let`s.
    pub(crate) lets: &'a [Let<'a>],
    /// Their values; none while they are still being worked out.
    pub values: &'a [Option<Checked<Quantity>>],
    /// The variables of a formula.
    pub variables: &'a [(&'a str, Quantity)],
}

/// A value with the expression it came from.
#[derive(Clone, Copy)]
pub struct Operand<'e> {
    /// The expression.
    pub expr: &'e Spanned<Expr>,
    /// Its value.
    pub quantity: Quantity,
}

impl Scope<'_> {
    /// The `let` whose name the expression is.
    pub(crate) fn let_named_by(&self, expr: &Spanned<Expr>) -> Option<&Let<'_>> {
        let Expr::Name(name) = &expr.node else { return None };
        match self.names.get(name)?.thing {
            Thing::Let(index) => self.lets.get(index),
            Thing::Blade(_) | Thing::Region(_) | Thing::Machine(_) => None,
        }
    }
}
