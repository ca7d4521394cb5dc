//! Strokes as flattened lines.

use super::fault::OutlineError;
use super::join::SAME;
use super::shape::{Shape, ShapeError};
use super::{Affine, Stroke};
use crate::curve::{COINCIDENT, Curve, MOST_POINTS};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// A flattened stroke.
pub(super) struct Line {
    pub(super) stroke: usize,
    pub(super) points: Vec<Point2>,
}

impl Line {
    pub(super) fn ends(&self) -> Option<[Point2; 2]> {
        Some([*self.points.first()?, *self.points.last()?])
    }

    pub(super) fn is_closed(&self) -> bool {
        self.points.len() > 2 && self.ends().is_some_and(|[from, to]| from.distance(to) <= SAME)
    }

    /// Whether it is longer than so much.
    pub(super) fn is_longer_than(&self, length: f64) -> bool {
        let mut so_far = 0.0;
        self.points.windows(2).any(|pair| {
            so_far += pair[0].distance(pair[1]);
            so_far > length
        })
    }
}

/// Strokes as lines; those without extent are left out.
pub(super) fn flatten(strokes: &[Stroke], map: Affine, flat: Length) -> Result<Vec<Line>, OutlineError> {
    let mut lines = Vec::new();
    let mut left = MOST_POINTS;
    for (stroke, drawn) in strokes.iter().enumerate() {
        let mut points: Vec<Point2> = Vec::new();
        for shape in &drawn.shapes {
            let curve = curve_of(&shape.clone().mapped(map), stroke)?;
            if points.is_empty() {
                points.push(curve.start());
            }
            curve
                .flatten(flat, &mut points)
                .map_err(|error| OutlineError::Curve { stroke, error })?;
        }
        left = left
            .checked_sub(points.len())
            .ok_or(OutlineError::TooManyPoints)?;
        points.dedup_by(|next, last| last.distance(*next) < COINCIDENT);
        if points.len() > 1 {
            lines.push(Line { stroke, points });
        }
    }
    Ok(lines)
}

/// A shape of a stroke as a curve.
pub(super) fn curve_of(shape: &Shape, stroke: usize) -> Result<Curve, OutlineError> {
    shape.curve().map_err(|error| match error {
        ShapeError::Curve(error) => OutlineError::Curve { stroke, error },
        ShapeError::Nurbs(error) => OutlineError::Nurbs { stroke, error },
    })
}
