//! The places of texts, and of what was read of them, in their file.

use super::grammar::Rule;
use pest::iterators::Pair;
use std::ops::Range;
use vcutc_diagnostics::source::{FileId, Span, Spanned};

/// Where the text at hand is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) file: FileId,
    /// Bytes of the file before the text.
    pub(super) offset: usize,
    /// Bytes of the text. Brackets that were put after it to balance it count as being at its end.
    pub(super) length: usize,
}

impl Place {
    pub(super) fn span(self, range: Range<usize>) -> Span {
        let offset = |at: usize| at.min(self.length).saturating_add(self.offset);
        Span::of_bytes(self.file, offset(range.start)..offset(range.end))
    }

    pub(super) fn span_of(self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        self.span(span.start()..span.end())
    }

    /// A pair's characters.
    pub(super) fn spanned(self, pair: &Pair<'_, Rule>) -> Spanned<String> {
        Spanned::new(pair.as_str().to_owned(), self.span_of(pair))
    }

    /// What a text in quotes says.
    pub(super) fn text(self, pair: &Pair<'_, Rule>) -> Spanned<String> {
        Spanned::new(unquoted(pair.as_str()), self.span_of(pair))
    }
}

/// What a text in quotes says: without its quotes, and without the backslash of an escape.
pub(super) fn unquoted(text: &str) -> String {
    let inner = text.strip_prefix('"').unwrap_or(text);
    let inner = inner.strip_suffix('"').unwrap_or(inner);
    let mut said = String::with_capacity(inner.len());
    let mut characters = inner.chars();
    while let Some(c) = characters.next() {
        if c == '\\' {
            said.extend(characters.next());
        } else {
            said.push(c);
        }
    }
    said
}
