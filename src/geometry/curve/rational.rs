//! Rational Bezier curves, flattened by halving.
//!
//! With positive weights a curve lies within the convex hull of its control points. When all of them are within the
//! tolerance of the chord, so is the hull, and with it the curve. Halving by de Casteljau's construction in homogeneous
//! coordinates `(w x, w z, w)` keeps weights positive.

use super::halving::{Control, flatten};
use super::{CurveError, Point2};

/// A control point in homogeneous coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Weighted {
    /// Coordinates times weight.
    pub(super) scaled: Point2,
    pub(super) weight: f64,
}

impl Control for Weighted {
    fn point(self) -> Point2 {
        Point2::new(self.scaled.x / self.weight, self.scaled.z / self.weight)
    }

    fn lerp(self, other: Self, t: f64) -> Self {
        Self {
            scaled: self.scaled.lerp(other.scaled, t),
            weight: self.weight + (other.weight - self.weight) * t,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rational {
    /// Control points, ends included; two or more, with positive weights.
    control: Vec<Weighted>,
}

impl Rational {
    /// The caller has checked points and weights.
    pub(super) const fn new(control: Vec<Weighted>) -> Self {
        Self { control }
    }

    pub(super) fn from(&self) -> Point2 {
        self.control
            .first()
            .map_or(Point2::new(0.0, 0.0), |point| point.point())
    }

    /// As [`flatten`].
    pub(super) fn flatten(
        &self,
        tolerance: f64,
        most: usize,
        out: &mut Vec<Point2>,
    ) -> Result<(), CurveError> {
        flatten(&self.control, farthest_from_chord, tolerance, most, out)
    }
}

/// The largest distance of a control point from the straight line between the ends.
fn farthest_from_chord(control: &[Weighted]) -> f64 {
    let (Some(first), Some(last)) = (control.first(), control.last()) else {
        return 0.0;
    };
    let (from, to) = (first.point(), last.point());
    let way = to.minus(from);
    let length = way.dot(way);
    control
        .iter()
        .map(|weighted| {
            let point = weighted.point();
            let share = if length > 0.0 {
                (point.minus(from).dot(way) / length).clamp(0.0, 1.0)
            } else {
                0.0
            };
            point.distance(from.lerp(to, share))
        })
        .fold(0.0, f64::max)
}
