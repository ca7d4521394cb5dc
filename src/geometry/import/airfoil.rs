//! Airfoil coordinates in the layouts of the UIUC collection.
//!
//! **Selig**: a title, then the points from the trailing edge over one side to the leading edge and back along the
//! other. **Lednicer**: a title, the number of points of each side (`61. 61.`), then each side from the leading edge
//! to the trailing edge. Which one it is follows from the points: sides that start again jump back across the
//! chord.
//!
//! Real files are less regular than that, and what other programs read is read here too: [`sheet`] finds the points among
//! comments, grids of ISES and MSES and headings, [`sides`] separates the two sides, and [`repair`] sees to
//! it that both reach from the leading to the trailing edge of a chord of 1 and do not cross. A side is read
//! as a function of x: where it has several heights the outer one counts. Whatever is not as the file has it
//! is listed as a [`Repair`], with its place and its size.

mod repair;
mod sheet;
mod sides;

pub use repair::{Altered, Repair};

use super::{DataError, western};
use crate::point::Point2;
use core::ops::Range;

/// Shares of the chord below this are noise of the digits written: a micrometre on a metre.
const NOISE: f64 = 1e-6;

/// The coordinates of an airfoil, for a chord from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Airfoil {
    /// The first line of text; empty when there is none.
    pub title: String,
    /// The upper side, with strictly increasing x.
    pub upper: Vec<Point2>,
    /// The lower side, with strictly increasing x.
    pub lower: Vec<Point2>,
    /// Where this is not what the file says, in the order of the file.
    pub repairs: Vec<Repair>,
}

/// One of the two sides of an airfoil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Upper,
    Lower,
}

/// A point with the number of its row in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex {
    at: Point2,
    row: usize,
}

/// Reads airfoil coordinates in Selig or Lednicer layout.
///
/// # Errors
/// Lines that are not two numbers, and points that do not form an upper and a lower side.
pub fn airfoil(text: &str) -> Result<Airfoil, DataError> {
    let mut sheet = sheet::read(text)?;
    let whole = sheet.range.clone();
    let refused = |message| DataError::new(whole.clone(), message);
    repair::join_doubled(&mut sheet);
    let mut pair = sides::sides(&sheet.points).map_err(refused)?;
    sheet.note_inside(&pair);
    repair::fit_the_chord(&mut pair, &mut sheet);
    repair::reach_both_edges(&mut pair, &mut sheet);
    repair::uncross(&mut pair, &mut sheet);
    let plain = |side: Vec<Vertex>| side.into_iter().map(|vertex| vertex.at).collect();
    let mut repairs = sheet.repairs;
    repairs.sort_by_key(|repair| (repair.start, repair.end));
    Ok(Airfoil {
        title: sheet.title,
        upper: plain(pair.upper.points),
        lower: plain(pair.lower.points),
        repairs,
    })
}

/// The text of an airfoil file. Numbers are ASCII in all code pages in use, so what is not UTF-8 is read in that of Windows in
/// the west.
///
/// # Errors
/// The bytes, where one of them is zero: they are not text.
pub fn airfoil_text(bytes: Vec<u8>) -> Result<String, Vec<u8>> {
    match String::from_utf8(bytes) {
        Ok(text) => Ok(text),
        Err(error) if error.as_bytes().contains(&0) => Err(error.into_bytes()),
        Err(error) => Ok(error.into_bytes().into_iter().map(western).collect()),
    }
}

#[cfg(test)]
mod tests;
