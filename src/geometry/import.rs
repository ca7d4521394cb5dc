//! Files of points and drawings: CSV, airfoil coordinates, DXF and SVG.
//!
//! All readers take the text of a file and never guess silently: what cannot be read is a [`DataError`] that says
//! where and, in the user's words, why. Readers of points take time in proportion to the text; what drawings unfold to is
//! bounded ([`drawing`]).

mod airfoil;
mod csv;
pub mod drawing;
mod dxf;
mod svg;
mod western;

pub use airfoil::{Airfoil, Altered, Repair, Side, airfoil, airfoil_text};
pub use csv::csv;
pub use dxf::{NoText, dxf, dxf_text};
pub use svg::svg;

use super::point::LARGEST_COORDINATE;
use core::ops::Range;
use western::western;

/// What is wrong with a file of points, and where: a range of bytes of its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataError {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
}

impl DataError {
    fn new(range: Range<usize>, message: impl Into<String>) -> Self {
        let offset = |place: usize| u32::try_from(place).unwrap_or(u32::MAX);
        Self {
            start: offset(range.start),
            end: offset(range.end),
            message: message.into(),
        }
    }
}

/// A piece of the text without blanks around it, and where it stands.
#[derive(Clone, Copy, Debug)]
struct Piece<'a> {
    text: &'a str,
    start: usize,
}

impl<'a> Piece<'a> {
    /// The piece within `whole` (which starts at the byte `start` of the file), without blanks around it.
    fn trimmed(whole: &'a str, start: usize) -> Self {
        let text = whole.trim_start();
        Self {
            text: text.trim_end(),
            start: start + (whole.len() - text.len()),
        }
    }

    fn range(self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    /// The pieces between separators. Empty ones are kept.
    fn split(self, is_separator: impl Fn(char) -> bool) -> impl Iterator<Item = Self> {
        self.text.split(is_separator).scan(self.start, |next, part| {
            let start = *next;
            // A separator is one byte: all that are used are ASCII.
            *next += part.len() + 1;
            Some(Self::trimmed(part, start))
        })
    }
}

/// The lines of a text without blanks around them. Line ends of all systems are understood, and a byte order mark.
fn lines(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let whole = Piece {
        text: body,
        start: text.len() - body.len(),
    };
    // Lines that end in CR LF lose the CR with the blanks.
    let end = if body.contains('\n') { '\n' } else { '\r' };
    whole.split(move |c| c == end)
}

/// A finite number in decimal form, with or without digits on either side of the point, with or without an exponent.
fn number(text: &str) -> Option<f64> {
    // Rust's own reader also takes words such as `inf` and `nan`.
    let plain = text
        .bytes()
        .all(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E'));
    let value: f64 = if plain { text.parse().ok()? } else { return None };
    value.is_finite().then_some(value)
}

/// A coordinate: a number within the range of coordinates.
fn coordinate(piece: Piece<'_>, text: &str) -> Result<f64, DataError> {
    if text.is_empty() {
        return Err(DataError::new(piece.range(), "a number is missing here"));
    }
    coordinate_of(text, piece.text).map_err(|message| DataError::new(piece.range(), message))
}

/// A number within the range of coordinates, or why it is not; `shown` is how the file has it.
fn coordinate_of(text: &str, shown: &str) -> Result<f64, String> {
    let value = number(text).ok_or_else(|| format!("`{}` is not a number", shortened(shown)))?;
    if value.abs() > LARGEST_COORDINATE {
        return Err(format!(
            "this is larger than the largest coordinate, {LARGEST_COORDINATE:e}"
        ));
    }
    Ok(value)
}

/// The start of a text, short enough for a message.
#[must_use]
pub fn shortened(text: &str) -> String {
    const MOST: usize = 24;
    if text.chars().count() <= MOST {
        return text.to_owned();
    }
    text.chars().take(MOST).chain(['.', '.', '.']).collect()
}
