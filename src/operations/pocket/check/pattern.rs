//! Fields that only one pattern uses.

use crate::asked::{ClearPocket, Pattern};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::{Auto, Sourced};

/// The first field that is given for a pattern which is neither asked for nor compared.
pub(super) fn field_of_another(asked: &ClearPocket) -> Option<Diagnostic> {
    let given = [
        ("corners", place(&asked.corners), Pattern::Sfs),
        ("angle", place(&asked.angle), Pattern::Zigzag),
        ("lift", place(&asked.lift), Pattern::Field),
        ("axis", asked.axis.span, Pattern::Field),
    ];
    let is_used = |pattern: Pattern| match asked.pattern.value {
        Auto::Given(given) => given == pattern,
        Auto::Auto => Pattern::COMPARED.contains(&pattern),
    };
    given.into_iter().find_map(|(field, span, pattern)| {
        let span = span.filter(|_| !is_used(pattern))?;
        Some(diagnostic(asked, (field, span), pattern))
    })
}

/// Where a value is given; none where it is left open.
fn place<T>(field: &Sourced<Auto<T>>) -> Option<Span> {
    match field.value {
        Auto::Given(_) => field.span,
        Auto::Auto => None,
    }
}

fn diagnostic(asked: &ClearPocket, (field, span): (&str, Span), pattern: Pattern) -> Diagnostic {
    let word = pattern.word();
    let (now, why) = match asked.pattern.value {
        Auto::Given(given) => (given.word(), "this pattern does not use it"),
        Auto::Auto => ("auto", "compares the other patterns only"),
    };
    let diagnostic = Diagnostic::new(
        Code::FieldOfAnotherPattern,
        format!("`{field}` has no effect with `pattern = {now}`"),
        span,
        format!("only `pattern = {word}` uses it"),
    );
    match asked.pattern.span {
        Some(place) => diagnostic.and(place, why).fix(
            format!("use `pattern = {word}`, or delete `{field}`"),
            place,
            word,
        ),
        None => diagnostic.help(format!("add `pattern = {word}`, or delete `{field}`")),
    }
}
