//! Rational Bezier curves, flattened by halving.
//!
//! With positive weights a curve lies within the convex hull of its control points. When all of them are within the
//! tolerance of the chord, so is the hull, and with it the curve. Halving by de Casteljau's construction in homogeneous
//! coordinates `(w x, w z, w)` keeps weights positive.

use super::{CurveError, Point2};

/// More halvings than any curve takes whose points a tolerance can tell apart.
const MOST_HALVINGS: usize = 60;

/// A control point in homogeneous coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Weighted {
    /// Coordinates times weight.
    pub(super) scaled: Point2,
    pub(super) weight: f64,
}

impl Weighted {
    /// The point in the plane.
    pub(super) fn point(self) -> Point2 {
        Point2::new(self.scaled.x / self.weight, self.scaled.z / self.weight)
    }

    pub(super) fn lerp(self, other: Self, t: f64) -> Self {
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

    /// As [`super::bezier::Bezier::flatten`].
    pub(super) fn flatten(
        &self,
        tolerance: f64,
        most: usize,
        out: &mut Vec<Point2>,
    ) -> Result<(), CurveError> {
        let degree = self.control.len().saturating_sub(1).max(1);
        let full = out.len().saturating_add(most / degree);
        // Pieces still to do, the next one last, each with how often it may still be halved.
        let mut pieces = vec![(self.control.clone(), MOST_HALVINGS)];
        while let Some((piece, halvings)) = pieces.pop() {
            let Some(end) = piece.last().copied() else {
                continue;
            };
            if farthest_from_chord(&piece) <= tolerance {
                if out.len() >= full {
                    return Err(CurveError::TooManyPoints);
                }
                out.push(end.point());
            } else if halvings == 0 {
                return Err(CurveError::TooManyPoints);
            } else {
                let (first, second) = halve(piece);
                pieces.push((second, halvings - 1));
                pieces.push((first, halvings - 1));
            }
        }
        Ok(())
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

/// De Casteljau at one half: the control points of both halves.
fn halve(mut control: Vec<Weighted>) -> (Vec<Weighted>, Vec<Weighted>) {
    let mut first = Vec::with_capacity(control.len());
    let mut second = Vec::with_capacity(control.len());
    while let (Some(&start), Some(&end)) = (control.first(), control.last()) {
        first.push(start);
        second.push(end);
        for i in 1..control.len() {
            control[i - 1] = control[i - 1].lerp(control[i], 0.5);
        }
        control.pop();
    }
    second.reverse();
    (first, second)
}
