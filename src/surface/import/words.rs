//! Words of a text and the numbers that they stand for. Texts are bytes here: names in files of meshes are in any encoding.

use super::{DataError, fault};
use core::ops::Range;
use vcutc_geometry::curve::LARGEST_COORDINATE;
use vcutc_geometry::import::shortened;

/// A word, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) start: usize,
}

impl<'a> Word<'a> {
    pub(super) const fn range(self) -> Range<usize> {
        self.start..self.start + self.bytes.len()
    }

    pub(super) const fn is(self, name: &str) -> bool {
        self.bytes.eq_ignore_ascii_case(name.as_bytes())
    }

    /// Its text for messages.
    pub(super) fn shown(self) -> String {
        // Longer words are cut anyway.
        let start = self.bytes.get(..200).unwrap_or(self.bytes);
        shortened(&String::from_utf8_lossy(start))
    }

    /// The text of a number in decimal form; Rust's own reader also takes words such as `inf`.
    fn decimal(self) -> Option<&'a str> {
        let is_plain = |b: &u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E');
        self.bytes
            .iter()
            .all(is_plain)
            .then(|| core::str::from_utf8(self.bytes).ok())
            .flatten()
    }

    /// The coordinate that it stands for.
    pub(super) fn coordinate(self) -> Result<f64, DataError> {
        let value: Option<f64> = self.decimal().and_then(|text| text.parse().ok());
        self.in_range(value)
    }

    /// The coordinate that it stands for, in single precision.
    pub(super) fn single(self) -> Result<f32, DataError> {
        let value: Option<f32> = self.decimal().and_then(|text| text.parse().ok());
        self.in_range(value.map(f64::from))?;
        Ok(value.unwrap_or_default())
    }

    /// The whole number that it stands for.
    pub(super) fn whole(self) -> Option<i64> {
        self.decimal()?.parse().ok()
    }

    fn in_range(self, value: Option<f64>) -> Result<f64, DataError> {
        match value {
            Some(value) if value.abs() <= LARGEST_COORDINATE => Ok(value),
            // Digits that overflow give an infinity.
            Some(_) => Err(fault(
                self.range(),
                format!("this is larger than the largest coordinate, {LARGEST_COORDINATE:e}"),
            )),
            None => Err(fault(self.range(), format!("`{}` is not a number", self.shown()))),
        }
    }
}

/// The words of a text, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Words<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Words<'a> {
    /// The words from a byte on.
    pub(super) const fn new(text: &'a [u8], at: usize) -> Self {
        Self { text, at }
    }

    /// Passes over the rest of the line.
    pub(super) fn end_line(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        self.at += rest.iter().position(is_end).unwrap_or(rest.len());
    }

    /// The end of the text, as a place.
    pub(super) const fn end(&self) -> Range<usize> {
        self.text.len()..self.text.len()
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = Word<'a>;

    fn next(&mut self) -> Option<Word<'a>> {
        let rest = self.text.get(self.at..)?;
        let blanks = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        let start = self.at + blanks;
        let rest = rest.get(blanks..)?;
        let length = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        self.at = start + length;
        Some(Word {
            bytes: rest.get(..length)?,
            start,
        })
    }
}

/// The lines of a text that are not empty, and where they start. Lines end in LF, CR, or both.
pub(super) fn lines(text: &[u8]) -> impl Iterator<Item = Word<'_>> {
    let mut at = 0;
    text.split(|b| matches!(b, b'\n' | b'\r'))
        .filter_map(move |bytes| {
            let start = at;
            at += bytes.len() + 1;
            (!bytes.trim_ascii().is_empty()).then_some(Word { bytes, start })
        })
}
