//! The tokens of an exchange structure (ISO 10303-21, clause 6), one after the other.

use super::super::words::Word;
use super::super::{DataError, fault};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `CARTESIAN_POINT`; also `ISO-10303-21`.
    Keyword,
    /// A number, of which only the characters are known to be right.
    Number,
    /// `#12`.
    Reference(u64),
    /// `.T.`.
    Enumeration,
    /// `'text'`.
    Text,
    /// `"0F"`.
    Binary,
    /// `$`.
    Omitted,
    /// `*`.
    Derived,
    Open,
    Close,
    Comma,
    Equals,
    Semicolon,
    /// A character that only sections other than HEADER and DATA may have.
    Other,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    pub(super) word: Word<'a>,
}

/// Goes through the bytes of a file once.
pub(super) struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Tokens<'a> {
    /// The tokens from one byte to another.
    pub(super) fn new(bytes: &'a [u8], start: usize, end: usize) -> Self {
        Self {
            bytes: bytes.get(..end).unwrap_or(bytes),
            at: start,
        }
    }

    /// Where the next token is looked for.
    pub(super) const fn at(&self) -> usize {
        self.at
    }

    /// The next token; none at the end.
    pub(super) fn next(&mut self) -> Result<Option<Token<'a>>, DataError> {
        self.skip_blanks()?;
        let start = self.at;
        let rest = self.bytes.get(start..).unwrap_or_default();
        let Some(&first) = rest.first() else {
            return Ok(None);
        };
        let length = |is_part: fn(&u8) -> bool| {
            rest.get(1..).map_or(1, |more| {
                1 + more.iter().position(|b| !is_part(b)).unwrap_or(more.len())
            })
        };
        let second = rest.get(1).copied();
        let (kind, length) = match first {
            b'(' => (Kind::Open, 1),
            b')' => (Kind::Close, 1),
            b',' => (Kind::Comma, 1),
            b'=' => (Kind::Equals, 1),
            b';' => (Kind::Semicolon, 1),
            b'$' => (Kind::Omitted, 1),
            b'*' => (Kind::Derived, 1),
            b'\'' => (Kind::Text, closed(rest, b'\'', start)?),
            b'"' => (Kind::Binary, closed(rest, b'"', start)?),
            b'#' => {
                let length = length(u8::is_ascii_digit);
                let digits = rest.get(1..length).unwrap_or_default();
                (Kind::Reference(id(digits, start)?), length)
            }
            b'.' if second.is_some_and(|b| b.is_ascii_alphabetic() || b == b'_') => {
                let name = length(|b| b.is_ascii_alphanumeric() || *b == b'_');
                match rest.get(name) {
                    Some(b'.') => (Kind::Enumeration, name + 1),
                    _ => return Err(fault(start..start + name, "this word lacks the point at its end")),
                }
            }
            b'0'..=b'9' | b'+' | b'-' | b'.' => (
                Kind::Number,
                length(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E')),
            ),
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!' => (
                Kind::Keyword,
                length(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-')),
            ),
            _ => (Kind::Other, 1),
        };
        self.at = start + length;
        let word = Word {
            bytes: rest.get(..length).unwrap_or_default(),
            start,
        };
        Ok(Some(Token { kind, word }))
    }

    /// The next token, which must be there.
    pub(super) fn expect(&mut self, what: &str) -> Result<Token<'a>, DataError> {
        let end = self.bytes.len();
        self.next()?
            .ok_or_else(|| fault(end..end, format!("the file ends where {what} should follow")))
    }

    /// Passes over blanks, comments, and print directives such as `\N\`.
    pub(super) fn skip_blanks(&mut self) -> Result<(), DataError> {
        loop {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            let blanks = rest
                .iter()
                .take_while(|b| b.is_ascii_whitespace() || **b == 0)
                .count();
            self.at += blanks;
            match rest.get(blanks..).unwrap_or_default() {
                [b'/', b'*', comment @ ..] => {
                    let end = comment.windows(2).position(|pair| pair == b"*/");
                    let end = end.ok_or_else(|| fault(self.at..self.at + 2, "this comment does not end"))?;
                    self.at += end + 4;
                }
                [b'\\', b'N' | b'F', b'\\', ..] => self.at += 3,
                _ => return Ok(()),
            }
        }
    }
}

/// The length of a text up to its closing mark; two marks stand for one within.
fn closed(rest: &[u8], mark: u8, start: usize) -> Result<usize, DataError> {
    let mut at = 1;
    while let Some(end) = rest
        .get(at..)
        .and_then(|more| more.iter().position(|&b| b == mark))
    {
        at += end + 1;
        if rest.get(at) != Some(&mark) {
            return Ok(at);
        }
        at += 1;
    }
    Err(fault(start..start + 1, "this text does not end"))
}

fn id(digits: &[u8], start: usize) -> Result<u64, DataError> {
    let text = core::str::from_utf8(digits).ok();
    text.and_then(|text| text.parse().ok()).ok_or_else(|| {
        fault(
            start..start + 1 + digits.len(),
            "this is not the number of an entity",
        )
    })
}
