//! Heights on a grid as three columns of text: x, y and z.
//!
//! Columns stand between semicolons, tabs, commas or blanks, as in files of profiles; between semicolons and tabs the decimal
//! point may be a comma. One heading, empty lines, and comments from `#` to the end of the line are passed over.

use super::words::{Word, lines};
use super::{DataError, fault};
use crate::grid::{GridError, grid};
use crate::mesh::Mesh;
use core::ops::Range;
use vcutc_backend_api::geometry::Point3;

/// Reads heights on a full grid, its points in any order, as a mesh. The numbers are taken as they stand; their unit is for
/// the caller to say.
///
/// # Errors
/// Lines of more or fewer than three columns, what is not a number, two heights at one place, and a grid that is not full.
pub fn heights(bytes: &[u8]) -> Result<Mesh, DataError> {
    let bytes_from = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    let mut points: Vec<Point3> = Vec::new();
    let mut places: Vec<Range<u32>> = Vec::new();
    let mut heading_may_come = true;
    for line in lines(bytes.get(bytes_from..).unwrap_or_default()) {
        let content = line.bytes.split(|&b| b == b'#').next().unwrap_or_default();
        let line = trimmed(content, line.start + bytes_from);
        if line.bytes.is_empty() {
            continue;
        }
        let columns = columns(line);
        let is_heading = columns
            .iter()
            .all(|column| !column.bytes.is_empty() && column.plain().coordinate().is_err());
        if core::mem::take(&mut heading_may_come) && is_heading {
            continue;
        }
        let &[x, y, z] = columns.as_slice() else {
            let message = format!(
                "this line has {} columns where x, y and z are expected",
                columns.len()
            );
            return Err(fault(line.range(), message));
        };
        points.push(Point3::new(x.coordinate()?, y.coordinate()?, z.coordinate()?));
        let place = |offset: usize| u32::try_from(offset).unwrap_or(u32::MAX);
        places.push(place(line.start)..place(line.range().end));
    }
    grid(&points).map_err(|error| {
        let range = match error {
            GridError::OutOfRange { index } | GridError::Doubled { index } => places.get(index).cloned(),
            GridError::TooFew | GridError::TooMany | GridError::Missing { .. } => None,
        };
        let range = range.map_or(0..bytes.len(), |range| range.start as usize..range.end as usize);
        match error {
            GridError::Doubled { .. } => fault(range, "an earlier line has a height at this place too"),
            GridError::OutOfRange { .. }
            | GridError::TooFew
            | GridError::TooMany
            | GridError::Missing { .. } => fault(range, error.to_string()),
        }
    })
}

/// A column of a line, and whether a comma in it may be the decimal point.
#[derive(Clone, Copy, Debug)]
struct Column<'a> {
    bytes: &'a [u8],
    start: usize,
    comma: Comma,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comma {
    Separates,
    IsDecimal,
}

impl<'a> Column<'a> {
    const fn plain(self) -> Word<'a> {
        Word {
            bytes: self.bytes,
            start: self.start,
        }
    }

    fn coordinate(self) -> Result<f64, DataError> {
        if self.bytes.is_empty() {
            return Err(fault(self.start..self.start, "a number is missing here"));
        }
        let comma = self.bytes.iter().position(|&b| b == b',');
        match (self.comma, comma) {
            (Comma::IsDecimal, Some(comma)) if !self.bytes.contains(&b'.') => {
                let mut bytes = self.bytes.to_vec();
                if let Some(point) = bytes.get_mut(comma) {
                    *point = b'.';
                }
                let word = Word {
                    bytes: &bytes,
                    start: self.start,
                };
                word.coordinate()
            }
            _ => self.plain().coordinate(),
        }
    }
}

/// The columns of a line. Repeated tabs and blanks are one separator: they align columns.
fn columns(line: Word<'_>) -> Vec<Column<'_>> {
    let has = |byte: u8| line.bytes.contains(&byte);
    let (separator, comma) = if has(b';') {
        (b';', Comma::IsDecimal)
    } else if has(b'\t') {
        (b'\t', Comma::IsDecimal)
    } else if has(b',') {
        (b',', Comma::Separates)
    } else {
        (b' ', Comma::Separates)
    };
    let aligns = matches!(separator, b'\t' | b' ');
    let mut at = line.start;
    let pieces = line.bytes.split(|&b| b == separator).map(|piece| {
        let start = at;
        at += piece.len() + 1;
        trimmed(piece, start)
    });
    pieces
        .filter(|piece| !(aligns && piece.bytes.is_empty()))
        .map(|Word { bytes, start }| Column { bytes, start, comma })
        .collect()
}

fn trimmed(bytes: &[u8], start: usize) -> Word<'_> {
    let inner = bytes.trim_ascii_start();
    Word {
        bytes: inner.trim_ascii_end(),
        start: start + (bytes.len() - inner.len()),
    }
}
