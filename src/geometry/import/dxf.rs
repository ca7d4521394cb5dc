//! Drawings in DXF, from R12 to today's, as text.
//!
//! A DXF file is a row of groups, each a code on one line and a value on the next ([`groups`]). Groups form entities,
//! entities stand in blocks or in the model (`read` walks over the sections), and an `INSERT` draws a block once more
//! ([`insert`]). The group codes are those of the DXF Reference of AutoCAD 2018.
//!
//! What is read: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE and POLYLINE with bulges, SPLINE, INSERT. Everything else that
//! stands on the wanted layer is listed. The plane of the drawing is x and y of the world; what is tilted out of it is
//! listed too, what is only lifted off it is read.

mod encoding;
mod entity;
mod facing;
mod fields;
mod groups;
mod insert;
mod polyline;
mod sections;
mod spline;
mod types;

pub use encoding::{NoText, dxf_text};

use super::DataError;
use super::drawing::{Drawing, Place, Unit};
use groups::Groups;

/// Reads a drawing: what stands on a layer, or on all of them. Capitals make no difference to names of layers.
///
/// # Errors
/// A text that is not DXF, ends too early, or has entities that cannot be understood; blocks within
/// themselves or without end.
pub fn dxf(text: &str, layer: Option<&str>) -> Result<Drawing, DataError> {
    let mut groups = Groups::new(text);
    let file = sections::read(&mut groups)?;
    insert::unfold(file, layer)
}

/// What one unit of the file is, by the number of `$INSUNITS` (DXF Reference, HEADER section).
fn unit(number: i64, place: Place) -> Unit {
    let mm = match number {
        1 => 25.4,
        2 => 304.8,
        4 => 1.0,
        5 => 10.0,
        6 => 1000.0,
        8 => 25.4e-6,
        9 => 25.4e-3,
        10 => 914.4,
        11 => 1e-7,
        12 => 1e-6,
        13 => 1e-3,
        14 => 100.0,
        // 0 says nothing; the others are miles, kilometres and the measures of the sky.
        _ => return Unit::Unsaid(place),
    };
    Unit::Known(mm)
}

#[cfg(test)]
mod tests;
