//! Reading fields: from an expression to a typed value within its range.

use super::dimension::Dimension;
use super::eval::Scope;
use super::field_ranges::Range;
use super::fields::Fields;
use super::quantity::{Measured, Quantity, number};
use super::report::{Checked, Reports};
use crate::{Auto, Sourced};
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// Reads values, and reports what is wrong with them.
pub struct Reader<'s> {
    /// What names stand for.
    pub scope: Scope<'s>,
    /// Where faults go.
    pub reports: &'s mut Reports,
}

/// A field that may be missing.
pub fn optional<T>(
    fields: &Fields<'_>,
    name: &str,
    reader: &mut Reader<'_>,
    read: fn(&str, &Spanned<Expr>, &mut Reader<'_>) -> Checked<T>,
) -> Checked<Option<Sourced<T>>> {
    match fields.value(name)? {
        Some(expr) => Ok(Some(sourced(read(name, expr, reader)?, expr.span))),
        None => Ok(None),
    }
}

/// A value that the text states.
pub const fn sourced<T>(value: T, span: Span) -> Sourced<T> {
    Sourced {
        value,
        span: Some(span),
    }
}

/// A value that is a default.
pub const fn default<T>(value: T) -> Sourced<T> {
    Sourced { value, span: None }
}

/// A plain number that is a share of the range once it is read as a percentage, written as that.
fn as_percent(expr: &Spanned<Expr>, value: f64, range: Range) -> Option<String> {
    let is_plain = matches!(&expr.node, Expr::Number { unit: None, .. });
    let is_share = range.dimension == Dimension::PURE && !range.holds(2.0) && range.holds(value / 100.0);
    (is_plain && is_share && value >= 1.0).then(|| format!("{} %", number(value)))
}

impl<'s> Reader<'s> {
    pub const fn new(scope: Scope<'s>, reports: &'s mut Reports) -> Self {
        Self { scope, reports }
    }

    /// The value of an expression within a range, in mm, rad, s, kg. `taker` names what takes it,
    /// such as `` `rake` ``.
    pub fn within(
        &mut self,
        expr: &Spanned<Expr>,
        range: Range,
        taker: &str,
        typical: Option<&str>,
    ) -> Checked<f64> {
        let value = self
            .scope
            .expect(expr, range.dimension, taker, typical, self.reports)?;
        if range.holds(value) {
            return Ok(value);
        }
        let text = Quantity::new(value, range.dimension).text();
        let diagnostic = faults::out_of_range(Code::OutOfRange, taker, range, &text, expr.span);
        let diagnostic = match self.scope.let_named_by(expr) {
            Some(by) => diagnostic.and(by.value.span, format!("`{}` gets its value here", by.name.node)),
            None => diagnostic,
        };
        let diagnostic = match as_percent(expr, value, range) {
            Some(percent) => diagnostic.fix(format!("use `{percent}`"), expr.span, percent),
            None => diagnostic,
        };
        let diagnostic = match typical {
            Some("auto") => diagnostic.help(format!("write a value that is {}, or `auto`", range.words())),
            Some(typical) => diagnostic.help(format!("a typical value is `{typical}`")),
            None => diagnostic.help(format!("give a value that is {}", range.words())),
        };
        Err(self.reports.push(diagnostic))
    }

    /// The value of a field, if it is given.
    pub fn optional<T: Measured>(&mut self, fields: &Fields<'_>, name: &str) -> Checked<Option<Sourced<T>>> {
        match fields.value(name)? {
            Some(expr) => self.field(fields, name, expr).map(Some),
            None => Ok(None),
        }
    }

    /// The value that a field is to be at least, if it is given.
    pub fn least<T: Measured>(&mut self, fields: &Fields<'_>, name: &str) -> Checked<Option<Sourced<T>>> {
        match fields.least(name)? {
            Some(expr) => self.field(fields, name, expr).map(Some),
            None => Ok(None),
        }
    }

    /// The value of a field that must be given.
    pub fn required<T: Measured>(&mut self, fields: &Fields<'_>, name: &str) -> Checked<Sourced<T>> {
        let expr = fields.required_value(name, self.reports)?;
        self.field(fields, name, expr)
    }

    /// The value of a field that has a default.
    pub fn defaulted<T: Measured>(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        otherwise: T,
    ) -> Checked<Sourced<T>> {
        let given = self.optional(fields, name)?;
        Ok(given.unwrap_or(default(otherwise)))
    }

    /// The value of a field that may be left to the compiler, which is also its default.
    pub fn auto<T: Measured>(&mut self, fields: &Fields<'_>, name: &str) -> Checked<Sourced<Auto<T>>> {
        let Some(expr) = fields.value(name)? else {
            return Ok(default(Auto::Auto));
        };
        if matches!(&expr.node, Expr::Name(word) if word == "auto") {
            return Ok(sourced(Auto::Auto, expr.span));
        }
        let given: Sourced<T> = self.field(fields, name, expr)?;
        Ok(sourced(Auto::Given(given.value), expr.span))
    }

    fn field<T: Measured>(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        expr: &Spanned<Expr>,
    ) -> Checked<Sourced<T>> {
        if matches!(&expr.node, Expr::Name(word) if word == "auto") {
            let diagnostic = Diagnostic::new(
                Code::WrongKind,
                format!("`{name}` cannot be `auto`"),
                expr.span,
                "`auto` is not allowed here",
            );
            let diagnostic = match fields.typical(name) {
                Some(typical) => diagnostic.help(format!("give a value, for example `{name} = {typical}`")),
                None => diagnostic.help("give a value"),
            };
            return Err(self.reports.push(diagnostic));
        }
        let range = fields.range(name, T::DIMENSION);
        debug_assert_eq!(range.dimension, T::DIMENSION, "the range of `{name}`");
        let value = self.within(expr, range, &format!("`{name}`"), fields.typical(name))?;
        Ok(sourced(T::from_base(value), expr.span))
    }

    /// One of a few words, or `auto`, which is also its default.
    pub fn auto_choice<T: Copy>(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        words: &[(&'static str, T)],
    ) -> Checked<Sourced<Auto<T>>> {
        let Some(expr) = fields.value(name)? else {
            return Ok(default(Auto::Auto));
        };
        let given = words.iter().map(|&(word, choice)| (word, Auto::Given(choice)));
        let all: Vec<_> = given.chain([("auto", Auto::Auto)]).collect();
        self.word(name, expr, &all)
    }

    /// One of a few words, if the field is given.
    pub fn choice<T: Copy>(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        words: &[(&'static str, T)],
    ) -> Checked<Option<Sourced<T>>> {
        match fields.value(name)? {
            Some(expr) => self.word(name, expr, words).map(Some),
            None => Ok(None),
        }
    }

    /// One of a few words.
    pub fn word<T: Copy>(
        &mut self,
        name: &str,
        expr: &Spanned<Expr>,
        words: &[(&'static str, T)],
    ) -> Checked<Sourced<T>> {
        let find = |given: &str| words.iter().find(|(word, _)| *word == given);
        let known = words_of(words);
        let taker = format!("`{name}`");
        let wrong_kind =
            |wanted: &str, found: &str| faults::wrong_kind(Code::WrongKind, &taker, wanted, found, expr.span);
        let list = format!("{taker} takes one of {}", known.join(", "));
        let diagnostic = match &expr.node {
            Expr::Name(word) => match find(word) {
                Some((_, choice)) => return Ok(sourced(*choice, expr.span)),
                None => {
                    let word = Spanned::new(word.as_str(), expr.span);
                    faults::unknown_word(Code::UnknownChoice, &taker, word, &known, str::to_owned)
                }
            },
            Expr::Text(text) => match find(text) {
                Some((word, _)) => wrong_kind("a word", "a text").fix("delete the quotes", expr.span, *word),
                None => wrong_kind("a word", "a text").help(list),
            },
            Expr::Number { .. }
            | Expr::Call { .. }
            | Expr::Negate(_)
            | Expr::Binary { .. }
            | Expr::Tuple(_) => wrong_kind("a word", "a value").help(list),
        };
        Err(self.reports.push(diagnostic))
    }

    /// A text in quotes, if the field is given.
    pub fn text(&mut self, fields: &Fields<'_>, name: &str) -> Checked<Option<Spanned<String>>> {
        let Some(expr) = fields.value(name)? else {
            return Ok(None);
        };
        if let Expr::Text(text) = &expr.node {
            return Ok(Some(Spanned::new(text.clone(), expr.span)));
        }
        let found = looks_like(&expr.node);
        let diagnostic = faults::wrong_kind(
            Code::WrongKind,
            &format!("`{name}`"),
            "a text in quotes",
            found,
            expr.span,
        );
        Err(self.reports.push(if let Expr::Name(word) = &expr.node {
            diagnostic.fix("put it in quotes", expr.span, format!("\"{word}\""))
        } else if let Some(typical) = fields.typical(name) {
            diagnostic.help(format!("write it like `{name} = {typical}`"))
        } else {
            diagnostic
        }))
    }

    /// A whole number within a range.
    pub fn whole(&mut self, expr: &Spanned<Expr>, range: Range, taker: &str) -> Checked<u32> {
        let value = self.within(expr, range, taker, None)?;
        faults::whole(Code::OutOfRange, taker, value, expr.span).map_err(|fault| self.reports.push(*fault))
    }
}

/// The words of a choice.
pub fn words_of<T>(choice: &[(&'static str, T)]) -> Vec<&'static str> {
    choice.iter().map(|(word, _)| *word).collect()
}

/// What an expression is called in a sentence, by its looks.
pub const fn looks_like(expr: &Expr) -> &'static str {
    match expr {
        Expr::Number { .. } | Expr::Negate(_) => "a number",
        Expr::Text(_) => "a text",
        Expr::Name(_) => "a name",
        Expr::Call { .. } => "a call",
        Expr::Binary { .. } => "a calculation",
        Expr::Tuple(_) => "a list of values",
    }
}
