//! B-splines with any knots and weights, as Bezier curves.
//!
//! Over each interval of knots `[a, b]` a B-spline of degree `p` is one polynomial, whose Bezier points are the values of
//! its blossom: `b_j = f(a, ..., a, b, ..., b)` with `j` times `b` (Ramshaw, Blossoming: a connect-the-dots approach to
//! splines, 1987). The blossom is de Boor's triangle with one argument a row. As all arguments lie in the interval every
//! step is a convex combination, so that nothing is lost to rounding. Rational curves go the same way in homogeneous
//! coordinates.

use super::bezier::Bezier;
use super::halving::Control;
use super::rational::{Rational, Weighted};
use super::{CurveError, MOST_CONTROL_POINTS, Point2, check_points};

/// Largest ratio of two weights. Beyond it a curve bends at single points only.
const WIDEST_WEIGHTS: f64 = 1e6;

/// A B-spline as files give it.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    /// Degree; 3 is usual.
    pub degree: usize,
    /// Knots that do not decrease, as many as control points and one more than the degree.
    pub knots: Vec<f64>,
    pub control: Vec<Point2>,
    /// A weight above 0 for each control point, or none at all.
    pub weights: Vec<f64>,
}

/// Why a B-spline does not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NurbsError {
    /// The degree is 0, or higher than that of a Bezier curve may be.
    Degree {
        /// The highest there may be.
        most: usize,
    },
    /// Fewer control points than the degree asks for.
    TooFewPoints {
        /// How many it takes at least.
        least: usize,
    },
    /// Another number of knots than control points and degree ask for.
    KnotCount {
        /// How many it takes.
        wanted: usize,
    },
    /// A knot is smaller than the one before.
    KnotsDecrease {
        /// The smaller one, counted from 0.
        index: usize,
    },
    /// A knot inside repeats so often that the curve falls apart.
    KnotRepeats {
        /// The last of them, counted from 0.
        index: usize,
    },
    /// All knots that count are equal.
    NoExtent,
    /// Another number of weights than control points.
    WeightCount,
    /// A weight that is not above 0, or a million times another one.
    BadWeight {
        /// The weight, counted from 0.
        index: usize,
    },
    /// The control points are not points of a curve.
    Curve(CurveError),
}

/// The Bezier curves of a B-spline, end to end.
pub(super) enum Pieces {
    Plain(Vec<Bezier>),
    Rational(Vec<Rational>),
}

impl Nurbs {
    /// What is wrong with it, if anything.
    fn check(&self) -> Result<(), NurbsError> {
        let (degree, count) = (self.degree, self.control.len());
        if degree == 0 || degree >= MOST_CONTROL_POINTS {
            return Err(NurbsError::Degree {
                most: MOST_CONTROL_POINTS - 1,
            });
        }
        if count <= degree {
            return Err(NurbsError::TooFewPoints { least: degree + 1 });
        }
        check_points(&self.control).map_err(NurbsError::Curve)?;
        let wanted = count + degree + 1;
        if self.knots.len() != wanted {
            return Err(NurbsError::KnotCount { wanted });
        }
        // Also refuses what is not a number.
        let falls = |pair: &[f64]| {
            pair[0]
                .partial_cmp(&pair[1])
                .is_none_or(core::cmp::Ordering::is_gt)
        };
        if let Some(index) = self.knots.windows(2).position(falls) {
            return Err(NurbsError::KnotsDecrease { index: index + 1 });
        }
        let inner = self.knots.get(1..wanted - 1).unwrap_or_default();
        let is_same = |window: &[f64]| match window {
            [first, .., last] => first.total_cmp(last).is_eq(),
            _ => false,
        };
        if let Some(index) = inner.windows(degree + 1).position(is_same) {
            return Err(NurbsError::KnotRepeats {
                index: index + degree + 1,
            });
        }
        self.check_weights()
    }

    fn check_weights(&self) -> Result<(), NurbsError> {
        if !self.weights.is_empty() && self.weights.len() != self.control.len() {
            return Err(NurbsError::WeightCount);
        }
        let largest = self.weights.iter().copied().fold(0.0, f64::max);
        let is_good = |weight: f64| weight > 0.0 && weight.is_finite() && largest / weight <= WIDEST_WEIGHTS;
        match self.weights.iter().position(|&weight| !is_good(weight)) {
            Some(index) => Err(NurbsError::BadWeight { index }),
            None => Ok(()),
        }
    }

    /// Its Bezier curves.
    pub(super) fn pieces(&self) -> Result<Pieces, NurbsError> {
        self.check()?;
        let control: Vec<Weighted> = self
            .control
            .iter()
            .enumerate()
            .map(|(i, point)| {
                let weight = self.weights.get(i).copied().unwrap_or(1.0);
                Weighted {
                    scaled: Point2::new(point.x * weight, point.z * weight),
                    weight,
                }
            })
            .collect();
        let pieces: Vec<Vec<Weighted>> = (self.degree..self.control.len())
            .filter(|&span| self.knots[span] < self.knots[span + 1])
            .map(|span| self.bezier_points(&control, span))
            .collect();
        if pieces.is_empty() {
            return Err(NurbsError::NoExtent);
        }
        let first = self.weights.first().copied().unwrap_or(1.0);
        let is_plain = self.weights.iter().all(|weight| weight.total_cmp(&first).is_eq());
        Ok(if is_plain {
            let plain = pieces
                .into_iter()
                .map(|piece| piece.into_iter().map(Weighted::point).collect());
            Pieces::Plain(plain.map(Bezier::new).collect())
        } else {
            Pieces::Rational(pieces.into_iter().map(Rational::new).collect())
        })
    }

    /// The Bezier points of the polynomial over `knots[span]..knots[span + 1]`.
    fn bezier_points(&self, control: &[Weighted], span: usize) -> Vec<Weighted> {
        let degree = self.degree;
        let (start, end) = (self.knots[span], self.knots[span + 1]);
        (0..=degree)
            .map(|ends| {
                let mut row = control[span - degree..=span].to_vec();
                for level in 1..=degree {
                    // The last `ends` of the arguments are the end of the interval.
                    let argument = if level + ends > degree { end } else { start };
                    for i in 0..=degree - level {
                        let low = self.knots[span - degree + level + i];
                        let high = self.knots[span + 1 + i];
                        row[i] = row[i].lerp(row[i + 1], (argument - low) / (high - low));
                    }
                }
                row[0]
            })
            .collect()
    }
}

#[cfg(test)]
mod tests;
