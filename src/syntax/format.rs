//! The one layout of job files: what `vcutc fmt` writes.
//!
//! `docs/fmt.md` says what the layout is. It is made in three steps: [`mod@read`] cuts the text into statements, each with its words
//! and the comments around them; [`lines`] decides which statements share a column and which blocks stay on one line; and
//! [`value`] puts the words of one statement into a [`doc`], which wraps where lines would be too long. [`spacing`] says what
//! is between two words.
//!
//! A formatter that changes what a job says would be worse than none. So the result is read once more before anybody gets it:
//! unless it has the same statements of the same words and the same comments in the same order, it is refused.

mod doc;
mod lines;
mod read;
mod spacing;
mod types;
mod value;

#[cfg(test)]
mod tests;

use crate as syntax;
use types::Source;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_diagnostics::{Code, Diagnostic, has_errors};

/// Longest line of code that is kept, in characters; trailing comments do not count.
const WIDTH: usize = 110;

/// The text of a job file in the layout that all job files have.
///
/// The result is UTF-8 without byte order mark, its lines end in LF. Formatting it again changes nothing.
///
/// # Errors
///
/// What is wrong with a text that cannot be read, in the order of the text.
pub fn format(file: FileId, text: &str) -> Result<String, Vec<Diagnostic>> {
    let source = read(file, text)?;
    let formatted = lines::file(&source);
    let is_the_same = read(file, &formatted).is_ok_and(|again| again.says_the_same_as(&source));
    if is_the_same {
        Ok(formatted)
    } else {
        Err(vec![not_the_same(file)])
    }
}

/// The statements of a text without mistakes.
fn read(file: FileId, text: &str) -> Result<Source<'_>, Vec<Diagnostic>> {
    let mut diagnostics = Vec::new();
    let ast = syntax::parse(file, text, &mut diagnostics);
    if has_errors(&diagnostics) {
        return Err(diagnostics);
    }
    Ok(Source::of(&ast, text))
}

/// A fault of this module, which must not reach a file.
fn not_the_same(file: FileId) -> Diagnostic {
    Diagnostic::new(
        Code::Internal,
        "formatting would change the meaning of the file",
        Span::of_bytes(file, 0..0),
        "the file is left unchanged",
    )
    .help("this is a fault of the compiler; please report it together with the file")
}
