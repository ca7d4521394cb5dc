//! Which way entities face, and strokes in a system of their own.

use super::super::DataError;
use super::super::drawing::{Affine, Shape, Why};
use super::fields::Fields;
use super::types::Content;

/// Heights over the plane of the drawing that differ by less are the same, in the file's unit; and so are directions.
const LEVEL: f64 = 1e-6;

/// Which way the plane of an entity faces.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Facing {
    Up,
    Down,
    Tilted,
}

impl Facing {
    /// By its extrusion direction.
    pub(super) fn of(fields: &Fields<'_>) -> Result<Self, DataError> {
        let x = fields.number_or(210, 0.0)?;
        let y = fields.number_or(220, 0.0)?;
        let z = fields.number_or(230, 1.0)?;
        let is_straight = libm::hypot(x, y) <= LEVEL * z.abs();
        Ok(match is_straight {
            true if z > 0.0 => Self::Up,
            true if z < 0.0 => Self::Down,
            true | false => Self::Tilted,
        })
    }

    /// From the system of an entity to the world; none when it is tilted.
    pub(super) const fn map(self) -> Option<Affine> {
        match self {
            Self::Up => Some(Affine::IDENTITY),
            Self::Down => Some(Affine::stretch(-1.0, 1.0)),
            Self::Tilted => None,
        }
    }
}

/// Whether heights are all the same.
pub(super) fn is_level(heights: impl IntoIterator<Item = f64>) -> bool {
    let (low, high) = heights
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
    high - low <= LEVEL || high < low
}

/// A stroke in the system of an entity.
pub(super) fn placed<'t>(
    fields: &Fields<'_>,
    kind: &'static str,
    shapes: Vec<Shape>,
) -> Result<Content<'t>, DataError> {
    Ok(match Facing::of(fields)?.map() {
        Some(map) => Content::Stroke(kind, shapes.into_iter().map(|shape| shape.mapped(map)).collect()),
        None => Content::Unread(Why::Tilted),
    })
}
