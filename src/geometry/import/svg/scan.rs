//! Numbers and marks in the values of attributes, as path data, lists of points and transformations are made of.

use super::super::drawing::Place;
use super::super::{DataError, coordinate_of, shortened};
use super::tree::Text;

/// A place in a value that is being read.
pub(super) struct Scan<'a> {
    text: Text<'a>,
    at: usize,
}

impl<'a> Scan<'a> {
    pub(super) const fn new(text: Text<'a>) -> Self {
        Self { text, at: 0 }
    }

    fn rest(&self) -> &'a str {
        self.text.text.get(self.at..).unwrap_or_default()
    }

    /// The next character after blanks, if there is one.
    pub(super) fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    /// Takes a character after blanks if it is the one.
    pub(super) fn take(&mut self, wanted: char) -> bool {
        let is_there = self.peek() == Some(wanted);
        if is_there {
            self.at += wanted.len_utf8();
        }
        is_there
    }

    /// Takes a letter after blanks, if there is one.
    pub(super) fn letter(&mut self) -> Option<char> {
        let letter = self.peek().filter(char::is_ascii_alphabetic)?;
        self.at += 1;
        Some(letter)
    }

    /// Takes a word of letters after blanks.
    pub(super) fn word(&mut self) -> &'a str {
        self.peek();
        let rest = self.rest();
        let end = rest
            .find(|c: char| !c.is_ascii_alphabetic() && c != '%')
            .unwrap_or(rest.len());
        self.at += end;
        rest.get(..end).unwrap_or_default()
    }

    /// Whether a number comes next.
    pub(super) fn is_number_next(&mut self) -> bool {
        matches!(self.peek(), Some('0'..='9' | '.' | '+' | '-'))
    }

    /// A number; a comma before it is passed over. Numbers may follow each other without a gap where it is clear how:
    /// `1-2`, `.5.5`.
    pub(super) fn number(&mut self) -> Result<f64, DataError> {
        self.take(',');
        self.peek();
        let rest = self.rest();
        let length = number_length(rest);
        if length == 0 {
            return Err(self.wrong("a number"));
        }
        let range = self.at..self.at + length;
        self.at = range.end;
        let text = rest.get(..length).unwrap_or_default();
        coordinate_of(text, text).map_err(|message| self.text.place(range).error(message))
    }

    /// A flag of an arc: `0` or `1`, perhaps without a gap to what follows.
    pub(super) fn flag(&mut self) -> Result<bool, DataError> {
        self.take(',');
        match self.peek() {
            Some('0') => {
                self.at += 1;
                Ok(false)
            }
            Some('1') => {
                self.at += 1;
                Ok(true)
            }
            _ => Err(self.wrong("a flag, 0 or 1,")),
        }
    }

    /// What is wrong when something else should follow.
    pub(super) fn wrong(&mut self, wanted: &str) -> DataError {
        let found: String = self.rest().chars().take_while(|c| !c.is_whitespace()).collect();
        let message = if self.peek().is_none() {
            format!("the value ends where {wanted} is expected")
        } else {
            format!("{wanted} is expected here, not `{}`", shortened(&found))
        };
        self.here().error(message)
    }

    /// The next character, or the last when there is none.
    fn here(&mut self) -> Place {
        let next = self.peek().map_or(0, char::len_utf8);
        let start = if next == 0 {
            let before = self.text.text.get(..self.at).unwrap_or_default();
            self.at - before.chars().next_back().map_or(0, char::len_utf8)
        } else {
            self.at
        };
        self.text.place(start..self.at + next)
    }
}

/// The bytes of the number that a text begins with; 0 when it begins with none.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let run = bytes.get(from..).unwrap_or_default();
        run.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    let is_sign = |at: usize| matches!(bytes.get(at), Some(b'+' | b'-'));
    let mut at = usize::from(is_sign(0));
    let whole = digits(at);
    at += whole;
    let mut parts = 0;
    if bytes.get(at) == Some(&b'.') {
        parts = digits(at + 1);
        // A point without digits after it belongs to the number only after digits.
        if whole + parts > 0 {
            at += 1 + parts;
        }
    }
    if whole + parts == 0 {
        return 0;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let sign = usize::from(is_sign(at + 1));
        let power = digits(at + 1 + sign);
        if power > 0 {
            at += 1 + sign + power;
        }
    }
    at
}
