//! The interpolating cubic spline over chord length, as Bezier cubics.
//!
//! Between points `P_i` and `P_(i+1)` at the distance `h_i` the second derivative runs linearly from `M_i` to
//! `M_(i+1)`. That first derivatives agree at inner points gives the tridiagonal system
//! `h_(i-1) M_(i-1) + 2 (h_(i-1) + h_i) M_i + h_i M_(i+1) = 6 (d_i - d_(i-1))` with the chord directions `d`
//! (de Boor, A Practical Guide to Splines, chapter IV); `M` is zero at both ends. It is diagonally dominant, so that
//! elimination needs no pivoting.

use super::bezier::Bezier;
use super::{COINCIDENT, CurveError, Point2};

/// The cubics from point to point; the caller has checked that there are two points or more, all in range.
pub(super) fn interpolate(points: &[Point2]) -> Result<Vec<Bezier>, CurveError> {
    let lengths: Vec<f64> = points.windows(2).map(|p| p[0].distance(p[1])).collect();
    if let Some(i) = lengths.iter().position(|&h| h < COINCIDENT) {
        return Err(CurveError::PointsCoincide { index: i + 1 });
    }
    let second = second_derivatives(points, &lengths);
    Ok(points
        .windows(2)
        .zip(second.windows(2))
        .zip(&lengths)
        .map(|((p, m), &h)| cubic([p[0], p[1]], [m[0], m[1]], h))
        .collect())
}

/// The cubic between two points from its second derivatives there.
fn cubic(p: [Point2; 2], m: [Point2; 2], h: f64) -> Bezier {
    let inner = |end: Point2, third: f64, near: Point2, far: Point2| {
        let way = p[1].minus(p[0]);
        let bend = h * h / 18.0;
        Point2::new(
            end.x + third * way.x - bend * (2.0 * near.x + far.x),
            end.z + third * way.z - bend * (2.0 * near.z + far.z),
        )
    };
    Bezier::new(vec![
        p[0],
        inner(p[0], 1.0 / 3.0, m[0], m[1]),
        inner(p[1], -1.0 / 3.0, m[1], m[0]),
        p[1],
    ])
}

/// Solves for the second derivatives at all points, by elimination and substitution.
fn second_derivatives(points: &[Point2], lengths: &[f64]) -> Vec<Point2> {
    let zero = Point2::new(0.0, 0.0);
    // Each eliminated row says `M_i = constant_i - factor_i M_(i+1)`; the first says `M_0 = 0`.
    let mut rows = vec![(zero, 0.0)];
    for (p, h) in points.windows(3).zip(lengths.windows(2)) {
        let (constant, factor) = rows.last().copied().unwrap_or((zero, 0.0));
        let (before, after) = (p[1].minus(p[0]), p[2].minus(p[1]));
        let pivot = 2.0 * (h[0] + h[1]) - h[0] * factor;
        let part = |before: f64, after: f64, constant: f64| {
            (6.0 * (after / h[1] - before / h[0]) - h[0] * constant) / pivot
        };
        rows.push((
            Point2::new(
                part(before.x, after.x, constant.x),
                part(before.z, after.z, constant.z),
            ),
            h[1] / pivot,
        ));
    }
    let mut second = vec![zero];
    let mut next = zero;
    for &(constant, factor) in rows.iter().skip(1).rev() {
        next = Point2::new(constant.x - factor * next.x, constant.z - factor * next.z);
        second.push(next);
    }
    second.push(zero);
    second.reverse();
    second
}

#[cfg(test)]
mod tests {
    use super::super::Curve;
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::units::Length;

    fn points(raw: &[(f64, f64)]) -> Vec<Point2> {
        raw.iter().map(|&(x, z)| Point2::new(x, z)).collect()
    }

    fn flat(raw: &[(f64, f64)], tolerance: f64) -> Vec<Point2> {
        let through = points(raw);
        let mut out = vec![through[0]];
        Curve::spline(through)
            .unwrap()
            .flatten(Length::mm(tolerance), &mut out)
            .unwrap();
        out
    }

    #[test]
    fn points_on_a_line_give_the_line() {
        let out = flat(&[(0.0, 0.0), (1.0, 2.0), (5.0, 10.0), (6.0, 12.0)], 1e-6);
        assert!(out.iter().all(|p| (p.z - 2.0 * p.x).abs() < 1e-12));
    }

    /// Worked by hand: with `h = sqrt 2` and `M_1 = (0, -3/2)` the height halfway is `1/2 + h^2/16 * 3/2`.
    #[test]
    fn three_points_give_the_known_cubic() {
        let out = flat(&[(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)], 1e-7);
        for halfway in [-0.5, 0.5] {
            let pair = out
                .windows(2)
                .find(|p| p[0].x <= halfway && halfway <= p[1].x)
                .unwrap();
            let z = pair[0]
                .lerp(pair[1], (halfway - pair[0].x) / (pair[1].x - pair[0].x))
                .z;
            assert!((z - 11.0 / 16.0).abs() < 1e-6);
        }
    }

    #[test]
    fn repeated_points_are_named() {
        let result = Curve::spline(points(&[(0.0, 0.0), (1.0, 1.0), (1.0, 1.0)]));
        assert_eq!(result, Err(CurveError::PointsCoincide { index: 2 }));
    }

    proptest! {
        /// Derivatives on both sides of each point are taken from the control points and must agree.
        #[test]
        fn first_and_second_derivatives_are_continuous(
            raw in prop::collection::vec((1.0..20.0f64, -30.0..30.0f64), 3..20),
        ) {
            let mut x = 0.0;
            let through: Vec<Point2> = raw.iter().map(|&(step, z)| { x += step; Point2::new(x, z) }).collect();
            let lengths: Vec<f64> = through.windows(2).map(|p| p[0].distance(p[1])).collect();
            let second = second_derivatives(&through, &lengths);
            // Slopes at the ends of a natural cubic from its second derivatives (mechanics of beams).
            for i in 1..through.len() - 1 {
                let (h0, h1) = (lengths[i - 1], lengths[i]);
                for part in [|p: Point2| p.x, |p: Point2| p.z] {
                    let arriving = (part(through[i]) - part(through[i - 1])) / h0
                        + h0 / 6.0 * (part(second[i - 1]) + 2.0 * part(second[i]));
                    let leaving = (part(through[i + 1]) - part(through[i])) / h1
                        - h1 / 6.0 * (2.0 * part(second[i]) + part(second[i + 1]));
                    prop_assert!((arriving - leaving).abs() < 1e-9);
                }
            }
            let flattened = flat(&through.iter().map(|p| (p.x, p.z)).collect::<Vec<_>>(), 1e-2);
            for p in &through {
                prop_assert!(flattened.contains(p));
            }
        }
    }
}
