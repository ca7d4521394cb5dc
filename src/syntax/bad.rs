//! Statements that cannot be read, and where in them the mistake is.

use super::grammar::Rule;
use super::lexical::{Token, TokenKind, tokens};
use super::place::Place;
use std::ops::Range;
use vcutc_diagnostics::source::Span;

/// A statement that cannot be read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bad<'t> {
    /// Where the whole text is.
    pub(super) place: Place,
    /// The whole text as written.
    pub(super) text: &'t str,
    /// The statement, with brackets balanced.
    pub(super) mended: &'t str,
    /// Where it begins in the text.
    pub(super) start: usize,
    /// Where the statement before it ended in the text.
    pub(super) previous_end: usize,
}

impl Bad<'_> {
    /// A stretch of the statement as a place in the file.
    pub(super) fn span(&self, range: Range<usize>) -> Span {
        self.place
            .span(self.start.saturating_add(range.start)..self.start.saturating_add(range.end))
    }

    /// A stretch of the statement as written.
    pub(super) fn slice(&self, range: Range<usize>) -> &str {
        self.mended.get(range).unwrap_or_default()
    }

    /// A token as written.
    pub(super) fn token(&self, token: Token) -> &str {
        self.slice(token.start..token.end)
    }

    /// The tokens without comments.
    pub(super) fn tokens(&self) -> impl Iterator<Item = Token> {
        tokens(self.mended).filter(|token| token.kind != TokenKind::Comment)
    }
}

/// A mistake within a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fault<'r> {
    /// The last token that is right.
    pub(super) before: Option<Token>,
    /// The first that is not, if the statement does not end too soon.
    pub(super) found: Option<Token>,
    /// The one after it.
    pub(super) next: Option<Token>,
    /// What could be there instead.
    pub(super) expected: &'r [Rule],
}

impl Fault<'_> {
    /// Whether this could be there.
    pub(super) fn expects(&self, rule: Rule) -> bool {
        self.expected.contains(&rule)
    }

    /// Whether a value could be there.
    pub(super) fn expects_value(&self) -> bool {
        [
            Rule::expression,
            Rule::number,
            Rule::negate,
            Rule::argument,
            Rule::group,
        ]
        .into_iter()
        .any(|rule| self.expects(rule))
    }
}

/// A piece of text in a form that fits a message.
pub(super) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut characters = text.chars();
    let mut shown: String = characters
        .by_ref()
        .take(LONGEST)
        .flat_map(|c| match c {
            // Quotes are fine within backticks.
            '"' | '\'' | '\\' => vec![c],
            _ => c.escape_debug().collect(),
        })
        .collect();
    if characters.next().is_some() {
        shown.push_str("...");
    }
    shown
}
