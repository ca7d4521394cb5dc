//! Strokes for tests.

use super::{Place, Shape, Stroke};
use crate::point::Point2;

pub(super) fn stroke(shapes: Vec<Shape>) -> Stroke {
    Stroke {
        kind: "LINE",
        place: Place { start: 0, end: 0 },
        shapes,
    }
}

pub(super) fn line(points: &[(f64, f64)]) -> Stroke {
    let points = points.iter().map(|&(x, z)| Point2::new(x, z)).collect();
    stroke(vec![Shape::Polyline(points)])
}
