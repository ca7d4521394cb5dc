//! Calls that describe a thing of a machine, such as `frame(x = 0 mm, ...)` or `output(12)`.

use super::decimal_comma;
use super::field_ranges::Range;
use super::names::did_you_mean;
use super::read::{Reader, looks_like};
use super::report::{Checked, Reports};
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Argument, Expr};

/// A named value of a call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameter<'p> {
    pub(crate) name: &'p str,
    pub(crate) range: Range,
    pub(crate) typical: &'p str,
}

/// A call that a field takes.
pub(crate) struct Arguments<'a> {
    /// Which of the calls that the field takes.
    pub(crate) function: &'static str,
    /// How a whole call looks.
    example: &'a str,
    /// The whole call.
    pub(crate) span: Span,
    given: Vec<&'a Argument>,
}

/// The call that a field's value is. `known` are the calls it takes, each with an example.
pub(crate) fn calls<'a>(
    field: &str,
    expr: &'a Spanned<Expr>,
    known: &[(&'static str, &'a str)],
    reports: &mut Reports,
) -> Checked<Arguments<'a>> {
    let forms: Vec<String> = known
        .iter()
        .map(|(_, example)| format!("`{field} = {example}`"))
        .collect();
    let help = format!("write it like {}", forms.join(" or "));
    let Expr::Call { function, arguments } = &expr.node else {
        let names: Vec<String> = known.iter().map(|(name, _)| format!("`{name}(...)`")).collect();
        let wanted = names.join(" or ");
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!("`{field}` takes {wanted}, not {}", looks_like(&expr.node)),
            expr.span,
            format!("expected {wanted} here"),
        );
        return Err(reports.push(diagnostic.help(help)));
    };
    if let Some(diagnostic) = decimal_comma::between(arguments.iter().map(|argument| &argument.value)) {
        return Err(reports.push(diagnostic));
    }
    if let Some(&(name, example)) = known.iter().find(|(name, _)| *name == function.node) {
        return Ok(Arguments {
            function: name,
            example,
            span: expr.span,
            given: arguments.iter().collect(),
        });
    }
    let diagnostic = Diagnostic::new(
        Code::WrongKind,
        format!("`{field}` does not take `{}(...)`", function.node),
        function.span,
        "not allowed here",
    );
    let near = nearest(&function.node, known.iter().map(|(name, _)| *name));
    Err(reports.push(did_you_mean(diagnostic, function.span, &near).help(help)))
}

impl<'a> Arguments<'a> {
    /// The only value, without a name.
    pub(crate) fn single(&self, reports: &mut Reports) -> Checked<&'a Spanned<Expr>> {
        match self.given.as_slice() {
            [Argument { name: None, value }] => Ok(value),
            [
                Argument {
                    name: Some(label), ..
                },
            ] => Err(reports.push(self.misfit(
                format!("the value of `{}` has no name", self.function),
                label.span,
                "not expected here",
            ))),
            several => Err(reports.push(self.misfit(
                format!("`{}` takes one value, not {}", self.function, several.len()),
                self.span,
                "expected one value here",
            ))),
        }
    }

    /// The values, however many and whether they have names or not.
    pub(crate) fn all(&self) -> &[&'a Argument] {
        &self.given
    }

    /// Takes the values of these names out, for a caller who reads them in another way.
    pub(crate) fn take(&mut self, names: &[&str]) -> Vec<&'a Argument> {
        let is_wanted = |argument: &&Argument| {
            let label = argument.name.as_ref();
            label.is_some_and(|label| names.contains(&label.node.as_str()))
        };
        let (taken, rest) = self.given.iter().partition(|argument| is_wanted(argument));
        self.given = rest;
        taken
    }

    /// A fixed count of values without names.
    pub(crate) fn listed<const N: usize>(
        &self,
        range: Range,
        taker: &str,
        reader: &mut Reader<'_>,
    ) -> Checked<[f64; N]> {
        if let Some(label) = self.given.iter().find_map(|argument| argument.name.as_ref()) {
            let message = format!("the values of `{}` have no names", self.function);
            return Err(reader
                .reports
                .push(self.misfit(message, label.span, "not expected here")));
        }
        let values: Vec<Checked<f64>> = self
            .given
            .iter()
            .map(|argument| reader.within(&argument.value, range, taker, None))
            .collect();
        let count = values.len();
        let values: Vec<f64> = values.into_iter().collect::<Checked<_>>()?;
        <[f64; N]>::try_from(values).map_err(|_| {
            let message = format!("`{}` takes {N} values, not {count}", self.function);
            reader
                .reports
                .push(self.misfit(message, self.span, format!("{count} values")))
        })
    }

    /// Values with names, all of which must be given, in the order of the parameters.
    pub(crate) fn named<const N: usize>(
        &self,
        parameters: &[Parameter<'_>; N],
        reader: &mut Reader<'_>,
    ) -> Checked<[f64; N]> {
        let values = self.read_all(parameters, reader)?;
        <[f64; N]>::try_from(values).map_err(|_| {
            reader.reports.push(Diagnostic::new(
                Code::Internal,
                format!("`{}` is read with a wrong count of values", self.function),
                self.span,
                "here",
            ))
        })
    }

    /// Values with names, all of which must be given, in the order of the parameters.
    pub(crate) fn read_all(
        &self,
        parameters: &[Parameter<'_>],
        reader: &mut Reader<'_>,
    ) -> Checked<Vec<f64>> {
        let mut fault = self
            .nameless(parameters)
            .map(|diagnostic| reader.reports.push(diagnostic));
        let named = if fault.is_some() { &[][..] } else { &self.given[..] };
        for (at, argument) in named.iter().enumerate() {
            if let Some(diagnostic) = self.misnamed(at, argument, parameters) {
                fault = Some(reader.reports.push(diagnostic));
            }
        }
        // A misnamed value may be the one that is missing.
        let is_misnamed = fault.is_some();
        let (mut values, mut missing) = (Vec::new(), Vec::new());
        for parameter in parameters {
            match self.find(parameter.name) {
                Some(argument) => {
                    let taker = format!("`{}`", parameter.name);
                    match reader.within(&argument.value, parameter.range, &taker, Some(parameter.typical)) {
                        Ok(value) => values.push(value),
                        Err(reported) => fault = Some(reported),
                    }
                }
                None => missing.push(parameter),
            }
        }
        if !is_misnamed && !missing.is_empty() {
            fault = Some(reader.reports.push(self.lacks(&missing)));
        }
        match fault {
            None => Ok(values),
            Some(reported) => Err(reported),
        }
    }

    /// The value of that name.
    pub(crate) fn find(&self, name: &str) -> Option<&'a Argument> {
        let is_it = |argument: &Argument| argument.name.as_ref().is_some_and(|label| label.node == name);
        self.given.iter().copied().find(|argument| is_it(argument))
    }

    /// What is wrong with the name of an argument.
    fn misnamed(&self, at: usize, argument: &Argument, parameters: &[Parameter<'_>]) -> Option<Diagnostic> {
        let Some(label) = &argument.name else {
            let diagnostic = self.misfit(
                format!("the values of `{}` need names", self.function),
                argument.value.span,
                "which value is this?",
            );
            return Some(diagnostic);
        };
        let earlier = self.given.iter().take(at).filter_map(|other| other.name.as_ref());
        if let Some(first) = earlier.into_iter().find(|other| other.node == label.node) {
            return Some(faults::twice(
                Code::FieldTwice,
                &label.node,
                label.span,
                first.span,
            ));
        }
        if parameters.iter().any(|parameter| parameter.name == label.node) {
            return None;
        }
        let diagnostic = self.misfit(
            format!("`{}` has no `{}`", self.function, label.node),
            label.span,
            "not one of its values",
        );
        let near = nearest(&label.node, parameters.iter().map(|parameter| parameter.name));
        Some(did_you_mean(diagnostic, label.span, &near))
    }

    /// Values that all lack their names: with the names in the order of the parameters, where there are as many.
    fn nameless(&self, parameters: &[Parameter<'_>]) -> Option<Diagnostic> {
        let first = self.given.first()?;
        if self.given.len() < 2 || self.given.iter().any(|argument| argument.name.is_some()) {
            return None;
        }
        let diagnostic = Diagnostic::new(
            Code::BadCall,
            format!("the values of `{}` need names", self.function),
            first.value.span,
            "which value is this?",
        );
        if self.given.len() != parameters.len() {
            return Some(diagnostic.help(format!("write it like `{}`", self.example)));
        }
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
        let written: Vec<String> = names.iter().map(|name| format!("`{name} =`")).collect();
        let pairs = self.given.iter().zip(&names);
        let edits: Vec<(Span, String)> = pairs
            .map(|(argument, name)| (argument.value.span.before(), format!("{name} = ")))
            .collect();
        Some(diagnostic.fix_all(format!("name them: {}", written.join(", ")), &edits))
    }

    /// Parameters that are not given.
    fn lacks(&self, missing: &[&Parameter<'_>]) -> Diagnostic {
        let names: Vec<String> = missing
            .iter()
            .map(|parameter| format!("`{}`", parameter.name))
            .collect();
        let (names, are) = match names.as_slice() {
            [first @ .., last] if !first.is_empty() => (format!("{} and {last}", first.join(", ")), "are"),
            few => (few.concat(), "is"),
        };
        let diagnostic = Diagnostic::new(
            Code::BadCall,
            format!("`{}` needs {names}", self.function),
            self.span,
            format!("{names} {are} missing here"),
        );
        let samples: Vec<String> = missing
            .iter()
            .map(|parameter| format!("{} = {}", parameter.name, parameter.typical))
            .collect();
        let samples = samples.join(", ");
        match self.given.last() {
            Some(last) => diagnostic.fix(
                format!("add `, {samples}`"),
                last.value.span.after(),
                format!(", {samples}"),
            ),
            None => diagnostic.help(format!("write it like `{}`", self.example)),
        }
    }

    /// The diagnostic for values that do not fit the call.
    pub(crate) fn misfit(&self, message: String, span: Span, label: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Code::BadCall, message, span, label).help(format!("write it like `{}`", self.example))
    }
}
