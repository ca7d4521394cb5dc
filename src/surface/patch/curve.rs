//! B-spline curves in space as polylines within a tolerance, and the border of a surface as one of them.
//!
//! A curve is cut into its Bezier pieces as a surface is. A piece divided into `m` equal parts of its parameter is off by
//! `M/(8 m^2)` at most, with a bound `M` of its second derivative. The border of a surface is made of the outer rows of
//! its outer patches, so it does not matter whether knots are clamped.

use super::blossom::{self, bezier_points};
use super::bound::divisions;
use super::{
    Nurbs, PatchError, Piece, Weighted, check, check_control, check_degree, check_knots, check_weights,
};
use super::{lerp, positive, weighted};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;

/// The most points of a polyline.
pub const MOST_POINTS: usize = 200_000;

/// A B-spline curve in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its degree; 3 is cubic.
    pub degree: usize,
    /// Knots that do not decrease, as many as control points and one more than the degree.
    pub knots: Vec<f64>,
    /// Control points, in the unit of the file or in mm.
    pub control: Vec<Point3>,
    /// A weight above 0 for each control point, or none at all.
    pub weights: Vec<f64>,
}

/// Points on a curve, from its start to its end. The curve lies within the tolerance of the polyline through them, each
/// place of it within that of the place of the polyline with the same parameter.
///
/// # Errors
/// See [`PatchError`]; [`PatchError::Tolerance`] also for more than [`MOST_POINTS`].
pub fn polyline(curve: &Curve, tolerance: Length) -> Result<Vec<Point3>, PatchError> {
    let tolerance = positive(tolerance)?;
    let Curve {
        degree,
        knots,
        control,
        weights,
    } = curve;
    check_degree(*degree)?;
    check_control(control, 0)?;
    if check_knots(*degree, knots)? != control.len() {
        return Err(PatchError::ControlCount);
    }
    check_weights(weights, control.len())?;
    let weighted = weighted(control, weights);
    let pieces = blossom::spans(knots, *degree, control.len())
        .into_iter()
        .map(|span| bezier_points(knots, *degree, span, &weighted[span - degree..=span]));
    through(pieces, tolerance)
}

/// Points on the border of a surface, once around from the start of u and v along v first; the last one is the first
/// one again. As close to the border as [`polyline`] is to a curve.
///
/// # Errors
/// See [`PatchError`]; [`PatchError::Tolerance`] also for more than [`MOST_POINTS`].
pub fn border(surface: &Nurbs, tolerance: Length) -> Result<Vec<Point3>, PatchError> {
    let tolerance = positive(tolerance)?;
    let counts = check(surface)?;
    let control = weighted(&surface.control, &surface.weights);
    let (pieces, across) = blossom::pieces(surface, counts, &control);
    let along = pieces.len() / across.max(1);
    let [p, q] = surface.degrees;
    let row = |piece: &Piece, row: usize| -> Vec<Weighted> {
        piece.control.chunks(q + 1).nth(row).unwrap_or_default().to_vec()
    };
    let column = |piece: &Piece, column: usize| -> Vec<Weighted> {
        let rows = piece.control.chunks(q + 1);
        rows.filter_map(|row| row.get(column).copied()).collect()
    };
    let reversed = |mut points: Vec<Weighted>| {
        points.reverse();
        points
    };
    let first = pieces.iter().take(across).map(|piece| row(piece, 0));
    let right = pieces
        .iter()
        .skip(across.saturating_sub(1))
        .step_by(across.max(1));
    let right = right.map(|piece| column(piece, q));
    let last = pieces.iter().skip((along.max(1) - 1) * across).rev();
    let last = last.map(|piece| reversed(row(piece, p)));
    let left = pieces.iter().step_by(across.max(1)).rev();
    let left = left.map(|piece| reversed(column(piece, 0)));
    through(first.chain(right).chain(last).chain(left), tolerance)
}

/// Points on Bezier curves that continue each other, and the end of the last one.
fn through(pieces: impl Iterator<Item = Vec<Weighted>>, tolerance: f64) -> Result<Vec<Point3>, PatchError> {
    let mut points = Vec::new();
    let mut end = None;
    for control in pieces {
        // What is still to do, the next part last.
        let mut open = vec![(control, 0)];
        while let Some((control, halvings)) = open.pop() {
            let piece = Piece {
                degrees: [control.len().saturating_sub(1), 0],
                control,
            };
            let [parts, _] = divisions(&piece, tolerance);
            if parts <= FEW_PARTS {
                points.extend((0..parts as u32).map(|part| piece.at(f64::from(part) / parts, 0.0)));
                end = Some(piece.at(1.0, 0.0));
            } else if halvings < MOST_HALVINGS {
                let [first, second] = halves(piece.control);
                open.extend([(second, halvings + 1), (first, halvings + 1)]);
            } else {
                return Err(PatchError::Tolerance);
            }
            if points.len() + open.len() > MOST_POINTS {
                return Err(PatchError::Tolerance);
            }
        }
    }
    points.extend(end);
    if points.len() < 2 {
        return Err(PatchError::NoExtent);
    }
    Ok(points)
}

/// Pieces that ask for more parts are halved first: the bounds of halves are closer, above all where weights differ.
const FEW_PARTS: f64 = 8.0;

/// Halves of halves, at most.
const MOST_HALVINGS: u32 = 40;

/// The control points of both halves of a Bezier curve, by de Casteljau's construction.
fn halves(mut points: Vec<Weighted>) -> [Vec<Weighted>; 2] {
    let mut first = Vec::with_capacity(points.len());
    for end in (0..points.len()).rev() {
        first.extend(points.first());
        for i in 0..end {
            points[i] = lerp(points[i], points[i + 1], 0.5);
        }
    }
    // What is left is the last of each row.
    [first, points]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testkit::segment_distance;
    use proptest::prelude::*;

    /// Cox and de Boor's sum, the textbook way.
    fn value(curve: &Curve, t: f64) -> Point3 {
        fn basis(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
            if degree == 0 {
                return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
            }
            let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
            part(t - knots[i], knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, t)
                + part(knots[i + degree + 1] - t, knots[i + degree + 1] - knots[i + 1])
                    * basis(knots, i + 1, degree - 1, t)
        }
        let mut sum = [0.0; 4];
        for (i, p) in curve.control.iter().enumerate() {
            let w = curve.weights.get(i).copied().unwrap_or(1.0) * basis(&curve.knots, i, curve.degree, t);
            sum = [sum[0] + w * p.x, sum[1] + w * p.y, sum[2] + w * p.z, sum[3] + w];
        }
        Point3::new(sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn curves_lie_within_the_tolerance(
            parts in prop::collection::vec(-50.0..50.0f64, 18),
            weights in prop::collection::vec(0.2..5.0f64, 6),
            steps in prop::collection::vec(0.1..2.0f64, 9),
            tolerance in 0.001..0.5f64,
        ) {
            // Uneven knots that are not clamped.
            let knots = steps.iter().chain([&1.0]).scan(0.0, |sum, step| { *sum += step; Some(*sum) }).collect();
            let control = parts.chunks(3).map(|p| Point3::new(p[0], p[1], p[2])).collect();
            let curve = Curve { degree: 3, knots, control, weights };
            let points = polyline(&curve, Length::mm(tolerance)).unwrap();
            let (start, end) = (curve.knots[3], curve.knots[6]);
            for k in 0..200 {
                let point = value(&curve, start + (end - start) * f64::from(k) / 200.0);
                let off = points.windows(2).map(|pair| segment_distance(point, [pair[0], pair[1]])).fold(f64::INFINITY, f64::min);
                prop_assert!(off <= tolerance, "{off}");
            }
        }
    }

    #[test]
    fn the_border_goes_once_around() {
        // Heights over squares of 10 mm, cubic in u with two spans, linear in v with three.
        let heights = |i: usize, j: usize| ((7 * i + 3 * j) % 5) as f64;
        let surface = Nurbs {
            degrees: [3, 1],
            knots: [
                vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0],
                vec![0.0, 0.0, 1.0, 2.0, 3.0, 3.0],
            ],
            control: (0..20)
                .map(|k| {
                    Point3::new(
                        10.0 * (k / 4) as f64,
                        10.0 * (k % 4) as f64,
                        heights(k / 4, k % 4),
                    )
                })
                .collect(),
            weights: Vec::new(),
        };
        let points = border(&surface, Length::mm(0.01)).unwrap();
        assert_eq!(points.first(), points.last());
        // In plan it is the outline of a rectangle, whose area and length are known.
        let area: f64 = points
            .windows(2)
            .map(|p| (p[0].x * p[1].y - p[1].x * p[0].y) / 2.0)
            .sum();
        let length: f64 = points
            .windows(2)
            .map(|p| libm::hypot(p[1].x - p[0].x, p[1].y - p[0].y))
            .sum();
        assert!((area.abs() - 1200.0).abs() < 1e-9 && (length - 140.0).abs() < 1e-9);
        for (corner, height) in [
            ([0.0, 0.0], heights(0, 0)),
            ([0.0, 30.0], heights(0, 3)),
            ([40.0, 30.0], heights(4, 3)),
            ([40.0, 0.0], heights(4, 0)),
        ] {
            assert!(points.contains(&Point3::new(corner[0], corner[1], height)));
        }
    }
}
