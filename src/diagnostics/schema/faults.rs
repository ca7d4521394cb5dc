//! The faults of fields, in the same words for blocks of jobs and tables of sheets.

use super::range::Range;
use crate::number::number;
use crate::source::{Span, Spanned};
use crate::suggest::nearest;
use crate::{Code, Diagnostic};

/// Adds near names: a fix when there is one, a help line when there are several.
pub fn did_you_mean(diagnostic: Diagnostic, span: Span, near: &[&str]) -> Diagnostic {
    match near {
        [] => diagnostic,
        [one] => diagnostic.fix(format!("did you mean `{one}`?"), span, *one),
        several => diagnostic.help(format!("did you mean {}?", in_backquotes(several, " or "))),
    }
}

/// A field that its block does not have, and the known fields that are near it. `holder` is the block in a sentence.
pub fn unknown<'f>(
    code: Code,
    holder: &str,
    name: Spanned<&str>,
    fields: &[&'f str],
) -> (Diagnostic, Vec<&'f str>) {
    let diagnostic = Diagnostic::new(
        code,
        format!("{holder} has no field `{}`", name.node),
        name.span,
        "unknown field",
    );
    let near = nearest(name.node, fields.iter().copied());
    let diagnostic = did_you_mean(diagnostic, name.span, &near).note(match fields {
        [] => format!("{holder} has no fields"),
        [one] => format!("its only field is {one}"),
        several => format!("its fields are {}", several.join(", ")),
    });
    (diagnostic, near)
}

/// Fields that a block must have and does not.
pub fn missing(code: Code, holder: &str, fields: &[&str], span: Span) -> Diagnostic {
    let list = in_backquotes(fields, ", ");
    let are = if fields.len() == 1 { "is" } else { "are" };
    Diagnostic::new(
        code,
        format!("{holder} needs {list}"),
        span,
        format!("{list} {are} missing here"),
    )
}

/// A field that its block has already.
pub fn twice(code: Code, name: &str, span: Span, first: Span) -> Diagnostic {
    second(code, format!("`{name}` is given twice"), span, first)
}

/// Something that is given again where it is given once.
pub fn second(code: Code, headline: impl Into<String>, span: Span, first: Span) -> Diagnostic {
    Diagnostic::new(code, headline, span, "given again here")
        .and(first, "first given here")
        .help("delete one of the two")
}

/// A value of another kind than `taker` takes.
pub fn wrong_kind(code: Code, taker: &str, wanted: &str, found: &str, span: Span) -> Diagnostic {
    Diagnostic::new(
        code,
        format!("{taker} takes {wanted}, not {found}"),
        span,
        format!("this is {found}"),
    )
}

/// A value beyond its range.
pub fn out_of_range(code: Code, taker: &str, range: Range, found: &str, span: Span) -> Diagnostic {
    Diagnostic::new(
        code,
        format!("{taker} must be {}, but is {found}", range.words()),
        span,
        format!("this is {found}"),
    )
}

/// A word that `taker` does not take. `quoted` is how a text writes a word.
pub fn unknown_word(
    code: Code,
    taker: &str,
    word: Spanned<&str>,
    known: &[&str],
    quoted: fn(&str) -> String,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        code,
        format!("{taker} cannot be `{}`", quoted(word.node)),
        word.span,
        "not one of its words",
    );
    let near = nearest(word.node, known.iter().copied());
    let near: Vec<String> = near.into_iter().map(quoted).collect();
    let near: Vec<&str> = near.iter().map(String::as_str).collect();
    did_you_mean(diagnostic, word.span, &near).help(format!("{taker} takes one of {}", known.join(", ")))
}

/// The whole number that a value is.
///
/// # Errors
/// The value has a fraction, or is beyond the range of the type.
pub fn whole(code: Code, taker: &str, value: f64, span: Span) -> Result<u32, Box<Diagnostic>> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the comparison finds every value that the type cannot hold"
    )]
    let whole = value as u32;
    if f64::from(whole).total_cmp(&value).is_eq() {
        return Ok(whole);
    }
    let message = format!("{taker} is a whole number, not {}", number(value));
    let diagnostic = Diagnostic::new(code, message, span, "not a whole number");
    Err(Box::new(
        diagnostic.help(format!("write `{whole}`, or another whole number")),
    ))
}

fn in_backquotes(names: &[&str], separator: &str) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(separator)
}
