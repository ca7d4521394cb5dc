//! From text to tree.
//!
//! [`parse`] never fails and never panics: what it cannot read it reports and leaves out, and continues after it. It
//! works in three steps:
//!
//! 1. `brackets` looks at brackets, quotes and comments, reports what is lost there and balances the text;
//! 2. `grammar` reads the balanced text by `grammar/vcut.pest`, whose rules for bad statements let it always succeed;
//! 3. `build` turns what was read into the tree, `expression` gives values their shape, and `mistakes` puts bad
//!    statements into words, with `slips` knowing the usual ones.
//!
//! Time and memory are linear in the length of the text, and recursion is bounded by the depth that `brackets` allows.

pub mod ast;
mod bad;
mod brackets;
mod builder;
mod expression;
pub mod fingerprint;
pub mod format;
mod grammar;
pub mod lexical;
mod mistakes;
mod place;
mod reports;
mod short_forms;
mod slips;
#[cfg(test)]
mod tests;

use ast::{Ast, Expr};
use builder::Builder;
use grammar::{Mismatch, Rule, read};
use vcutc_diagnostics::source::{FileId, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

/// Reads a file's text. What is wrong is added to `diagnostics`, in the order of the text.
pub fn parse(file: FileId, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Ast {
    let balanced = brackets::balance(file, text);
    let mut builder = Builder::new(file, 0, text, balanced.doubtful, balanced.reports);
    let ast = match read(Rule::file, &balanced.text) {
        Ok(pairs) => builder.file(pairs),
        Err(mismatch) => {
            builder.unreadable(&mismatch);
            Ast::default()
        }
    };
    diagnostics.extend(builder.finish());
    ast
}

/// The report on a file that is not UTF-8. `span` is where the file is asked for, or its own beginning, `name` is what
/// people call it, and `right` is the number of bytes before the first wrong one
/// ([`text_from_bytes`](vcutc_diagnostics::source::text_from_bytes)).
#[must_use]
pub fn not_utf8(span: Span, name: &str, right: usize) -> Diagnostic {
    Diagnostic::new(
        Code::NotUtf8,
        format!("`{name}` is not UTF-8 text"),
        span,
        format!("the first {right} bytes of the file are text, the next one is not"),
    )
    .help("save the file again with the encoding UTF-8")
}

/// Reads a single value, such as that of `--set width=90mm`. `text` is the value alone, and `offset` says where it
/// starts in the text of `file`, in bytes. `None` means that it is wrong, which has then been added to `diagnostics`.
pub fn parse_expression(
    file: FileId,
    text: &str,
    offset: u32,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Spanned<Expr>> {
    let balanced = brackets::balance(file, text);
    let mut builder = Builder::new(file, offset, text, balanced.doubtful, balanced.reports);
    let value = match read(Rule::only_expression, &balanced.text) {
        Ok(pairs) => builder.only_expression(pairs),
        Err(Mismatch::At { position, expected }) => {
            builder.bad_expression(position, &expected);
            None
        }
        Err(mismatch @ Mismatch::TooMuchWork) => {
            builder.unreadable(&mismatch);
            None
        }
    };
    let reports = builder.finish();
    let is_right = reports.is_empty();
    diagnostics.extend(reports);
    value.filter(|_| is_right)
}
