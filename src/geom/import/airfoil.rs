//! Airfoil coordinates in the layouts of the UIUC collection.
//!
//! **Selig**: a title, then the points from the trailing edge over one side to the leading edge and back along the
//! other. **Lednicer**: a title, the number of points of each side (`61. 61.`), then each side from the leading edge
//! to the trailing edge. Which one it is follows from the points: sides that start anew jump back across the chord.
//!
//! Real files are less regular than that. Lines that begin with `#` are comments, and a line of four or five numbers before the
//! points is the grid of an ISES or MSES file, both as in XFOIL (its manual, "Airfoil file formats"). The title may be missing, the lower side may come first, the leading edge
//! may be repeated or x may run back a little around the nose. A side is read as a function of x all the same: where
//! it has several heights the outer one counts.

mod sides;

use super::{DataError, Piece, coordinate, lines, number};
use crate::geom::point::Point2;
use core::ops::Range;

/// The coordinates of an airfoil, as they stand in the file (usually for a chord of 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Airfoil {
    /// The first line of text; empty when there is none.
    pub title: String,
    /// The upper side, with strictly increasing x.
    pub upper: Vec<Point2>,
    /// The lower side, with strictly increasing x.
    pub lower: Vec<Point2>,
}

/// Reads airfoil coordinates in Selig or Lednicer layout.
///
/// # Errors
/// Lines that are not two numbers, and points that do not form an upper and a lower side.
pub fn airfoil(text: &str) -> Result<Airfoil, DataError> {
    let sheet = read(text)?;
    let (upper, lower) =
        sides::sides(&sheet.points).map_err(|message| DataError::new(sheet.range.clone(), message))?;
    Ok(Airfoil {
        title: sheet.title,
        upper,
        lower,
    })
}

/// What stands in a file.
struct Sheet {
    title: String,
    /// The points in the order written, without the line of counts.
    points: Vec<Point2>,
    /// Where the points stand.
    range: Range<usize>,
}

fn read(text: &str) -> Result<Sheet, DataError> {
    let mut title = None;
    let mut points = Vec::new();
    let mut range: Option<Range<usize>> = None;
    // The number of points when the first empty line after one came.
    let mut first_gap = None;
    // A line of words after the points: no matter when nothing more comes.
    let mut words_behind = None;
    for line in lines(text) {
        if line.text.trim_start().starts_with('#') {
            // A comment, as XFOIL has them.
            continue;
        }
        if points.is_empty() && is_of_a_grid(line) {
            continue;
        }
        if line.text.is_empty() {
            if !points.is_empty() {
                first_gap.get_or_insert(points.len());
            }
        } else if let Some(point) = pair(line)? {
            if let Some(words) = words_behind {
                return Err(not_a_pair(words));
            }
            points.push(point);
            range = Some(range.map_or(line.start, |r| r.start)..line.range().end);
        } else if points.is_empty() && title.is_none() {
            title = Some(line.text.to_owned());
        } else if starts_with_number(line) {
            return Err(not_a_pair(line));
        } else if !points.is_empty() {
            words_behind.get_or_insert(line);
        }
    }
    if starts_with_counts(&points, first_gap) {
        points.remove(0);
    }
    Ok(Sheet {
        title: title.unwrap_or_default(),
        points,
        range: range.unwrap_or(0..text.len()),
    })
}

/// The parts of a line between blanks, tabs and commas.
fn parts(line: Piece<'_>) -> impl Iterator<Item = Piece<'_>> {
    line.split(|c| matches!(c, ' ' | '\t' | ','))
        .filter(|part| !part.text.is_empty())
}

/// The point on a line that consists of two numbers; none on other lines.
fn pair(line: Piece<'_>) -> Result<Option<Point2>, DataError> {
    let mut parts = parts(line);
    match (parts.next(), parts.next(), parts.next()) {
        (Some(x), Some(z), None) if number(x.text).is_some() && number(z.text).is_some() => {
            Ok(Some(Point2::new(coordinate(x, x.text)?, coordinate(z, z.text)?)))
        }
        _ => Ok(None),
    }
}

/// Whether a line has four or five numbers: before the points ISES and MSES, and with them XFOIL, have the ends of a grid there.
fn is_of_a_grid(line: Piece<'_>) -> bool {
    let count = parts(line).count();
    (4..=5).contains(&count) && parts(line).all(|part| number(part.text).is_some())
}

fn starts_with_number(line: Piece<'_>) -> bool {
    parts(line).next().is_some_and(|part| number(part.text).is_some())
}

fn not_a_pair(line: Piece<'_>) -> DataError {
    DataError::new(
        line.range(),
        "a line of airfoil coordinates is two numbers, x and z",
    )
}

/// Whether the first pair is not a point but says how many points each side has: two whole numbers that add up to the
/// number of points, or stand apart from them by an empty line.
fn starts_with_counts(points: &[Point2], first_gap: Option<usize>) -> bool {
    let Some(first) = points.first() else {
        return false;
    };
    let is_count = |value: f64| value >= 2.0 && (value - value.round()).abs() < 1e-9;
    let adds_up = (first.x + first.z - (points.len() - 1) as f64).abs() < 0.5;
    is_count(first.x) && is_count(first.z) && (adds_up || first_gap == Some(1))
}

#[cfg(test)]
mod tests;
