//! A smooth function on a stretch, from its values at a few places: its first three derivatives elsewhere.
//!
//! The function is interpolated by the polynomial through its values at the Chebyshev points `x_k = -cos(pi k / N)`. Where it
//! is analytic around the stretch, as axis values along a course are away from singular poses, the error falls geometrically
//! with N, and so do those of its derivatives ([Trefethen 2000], chapters 5 and 6). How far it has fallen is read from the last
//! coefficients of the Chebyshev series.
//!
//! The weights of all values for every derivative at every place are the same for all functions; they are worked out once.

use core::f64::consts::PI;

/// Degree of the polynomial (N).
pub(super) const DEGREE: usize = 16;
/// Places where values are taken.
pub(super) const POINTS: usize = DEGREE + 1;
/// Parts into which a stretch is divided; derivatives are taken in the middle of each.
pub(super) const PARTS: usize = 24;

/// Weights, derivatives counted by a parameter that goes from 0 to 1 on the stretch.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// Where values are taken, from 0 to 1.
    pub(super) points: [f64; POINTS],
    /// Where parts begin and end, from 0 to 1.
    pub(super) ends: [f64; PARTS + 1],
    /// For every part and derivative the weights of the values.
    parts: Vec<[[f64; POINTS]; 3]>,
    /// For the last two coefficients of the series.
    last: [[f64; POINTS]; 2],
}

impl Weights {
    /// Works them out.
    pub(super) fn new() -> Self {
        let points: [f64; POINTS] = core::array::from_fn(|k| cosine_place(k, DEGREE));
        let ends: [f64; PARTS + 1] = core::array::from_fn(|k| cosine_place(k, PARTS));
        let middles = ends.iter().zip(ends.iter().skip(1));
        let parts = middles
            .map(|(begin, end)| at(&points, f64::midpoint(*begin, *end)))
            .collect();
        Self {
            points,
            ends,
            parts,
            last: [last(DEGREE - 1), last(DEGREE)],
        }
    }

    /// First, second and third derivative in the middle of every part.
    pub(super) fn derivatives(&self, values: &[f64; POINTS]) -> impl Iterator<Item = [f64; 3]> {
        // A constant has none, and leaving it out leaves out its rounding.
        let base = values[0];
        let apart = values.map(|value| value - base);
        self.parts
            .iter()
            .map(move |weights| weights.each_ref().map(|weights| dot(weights, &apart)))
    }

    /// How large the last two coefficients of the series are together: about the error.
    pub(super) fn rest(&self, values: &[f64; POINTS]) -> f64 {
        let base = values[0];
        let apart = values.map(|value| value - base);
        self.last.iter().map(|weights| dot(weights, &apart).abs()).sum()
    }
}

fn dot(weights: &[f64; POINTS], values: &[f64; POINTS]) -> f64 {
    weights
        .iter()
        .zip(values)
        .map(|(weight, value)| weight * value)
        .sum()
}

/// `k` of `n` as an angle from 0 to half a turn.
fn angle(k: usize, n: usize) -> f64 {
    let number = |value: usize| u32::try_from(value).map_or(0.0, f64::from);
    PI * number(k) / number(n)
}

/// The Chebyshev point, from 0 to 1.
fn cosine_place(k: usize, n: usize) -> f64 {
    let half = libm::sin(angle(k, n) / 2.0);
    half * half
}

/// The weights for the derivatives at a place: those of each Lagrange polynomial, a product of linear factors that is
/// multiplied up with its derivatives (Leibniz).
fn at(points: &[f64; POINTS], place: f64) -> [[f64; POINTS]; 3] {
    let of_point = |own: usize| {
        let [mut value, mut first, mut second, mut third] = [1.0, 0.0, 0.0, 0.0];
        for (other, point) in points.iter().enumerate() {
            if other != own {
                let slope = 1.0 / (points[own] - point);
                let factor = (place - point) * slope;
                third = third * factor + 3.0 * second * slope;
                second = second * factor + 2.0 * first * slope;
                first = first * factor + value * slope;
                value *= factor;
            }
        }
        [first, second, third]
    };
    let all: [[f64; 3]; POINTS] = core::array::from_fn(of_point);
    core::array::from_fn(|order| all.map(|orders| orders[order]))
}

/// The weights for a coefficient of the series: `2 / N sum'' f(x_j) cos(pi j n / N)`, ends by half, and the last one by half.
fn last(order: usize) -> [f64; POINTS] {
    core::array::from_fn(|j| {
        let end = if j == 0 || j == DEGREE { 0.5 } else { 1.0 };
        let whole = if order == DEGREE { 0.5 } else { 1.0 };
        let degree = angle(2, DEGREE) / PI;
        end * whole * degree * libm::cos(angle(j * order, DEGREE))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_function() {
        let weights = Weights::new();
        let values = weights.points.map(|x| libm::sin(2.0 * x) + libm::exp(x));
        let ends = weights
            .ends
            .windows(2)
            .map(|pair| f64::midpoint(pair[0], pair[1]));
        for (x, [first, second, third]) in ends.zip(weights.derivatives(&values)) {
            let (s, c, e) = (libm::sin(2.0 * x), libm::cos(2.0 * x), libm::exp(x));
            assert!((first - (2.0 * c + e)).abs() < 1e-10);
            assert!((second - (-4.0 * s + e)).abs() < 1e-8);
            assert!((third - (-8.0 * c + e)).abs() < 1e-6);
        }
        assert!(weights.rest(&values) < 1e-14);
    }

    #[test]
    fn what_a_polynomial_cannot_follow_shows_in_the_rest() {
        let weights = Weights::new();
        let step = |sharp: f64| weights.rest(&weights.points.map(|x| libm::atan((x - 0.4) * sharp)));
        assert!(step(100.0) > 1e-2 && step(1.0) < 1e-8);
    }
}
