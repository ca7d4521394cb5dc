//! What a drawing shows of a part: its strokes, and which side of them the part is.

use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::import::drawing::{Affine, Side, Stroke, outline, side};

/// A section of a part in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Section {
    pub(crate) strokes: Vec<Stroke>,
    /// From the drawing to the workpiece.
    pub(crate) map: Affine,
    /// Ends of strokes no farther apart than this are joined.
    pub(crate) joined: Length,
    /// The side of a closed outline that is the part.
    pub(crate) side: Option<Side>,
}

impl Section {
    /// Its polyline; none where its strokes do not form an outline at this tolerance.
    pub(crate) fn points(&self, tolerance: Length) -> Option<Vec<Point2>> {
        let whole = outline(&self.strokes, self.map, tolerance, self.joined).ok()?;
        match self.side {
            None => Some(whole.points),
            Some(wanted) => Some(side(&whole, wanted, tolerance).ok()?.points),
        }
    }
}
