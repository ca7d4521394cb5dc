//! Bezier curves of any degree, flattened by halving.
//!
//! A piece is accepted as a chord when its second differences prove it flat (see [`super`]); otherwise it is cut in
//! half by de Casteljau's construction. Halving divides second differences by four or more, so that the number of
//! halvings is bounded by the logarithm of their size over the tolerance: within the range of coordinates
//! `log4(63*62/8 * 4e9 / 1e-9)`, which is below 36.

use super::halving::flatten;
use super::{CurveError, Point2};

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bezier {
    /// Control points, ends included; two or more.
    control: Vec<Point2>,
}

impl Bezier {
    /// The caller has checked the points.
    pub(super) const fn new(control: Vec<Point2>) -> Self {
        Self { control }
    }

    pub(super) fn into_control(self) -> Vec<Point2> {
        self.control
    }

    pub(super) fn from(&self) -> Point2 {
        self.control.first().copied().unwrap_or(Point2::new(0.0, 0.0))
    }

    /// As [`flatten`].
    pub(super) fn flatten(
        &self,
        tolerance: f64,
        most: usize,
        out: &mut Vec<Point2>,
    ) -> Result<(), CurveError> {
        flatten(&self.control, deviation_bound, tolerance, most, out)
    }
}

/// Most that a Bezier curve can be off its chord: `n (n-1)/8 max |second difference|`.
fn deviation_bound(control: &[Point2]) -> f64 {
    let degree = control.len().saturating_sub(1) as f64;
    let bend = control
        .windows(3)
        .map(|p| libm::hypot(p[0].x - 2.0 * p[1].x + p[2].x, p[0].z - 2.0 * p[1].z + p[2].z))
        .fold(0.0, f64::max);
    degree * (degree - 1.0) / 8.0 * bend
}

#[cfg(test)]
mod tests {
    use super::super::Curve;
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::units::Length;

    /// The curve by its definition: the sum of Bernstein polynomials.
    pub(super) fn by_definition(control: &[Point2], t: f64) -> Point2 {
        let n = control.len() - 1;
        let mut binomial = 1.0;
        let mut sum = Point2::new(0.0, 0.0);
        for (i, p) in control.iter().enumerate() {
            let weight = binomial * libm::pow(t, i as f64) * libm::pow(1.0 - t, (n - i) as f64);
            sum = Point2::new(sum.x + weight * p.x, sum.z + weight * p.z);
            binomial = binomial * (n - i) as f64 / (i + 1) as f64;
        }
        sum
    }

    fn distance_to_polyline(point: Point2, polyline: &[Point2]) -> f64 {
        polyline
            .windows(2)
            .map(|p| {
                let way = p[1].minus(p[0]);
                let t = (point.minus(p[0]).dot(way) / way.dot(way).max(1e-300)).clamp(0.0, 1.0);
                point.distance(p[0].lerp(p[1], t))
            })
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn the_curve_stays_within_the_tolerance(
            control in prop::collection::vec((-100.0..100.0f64, -100.0..100.0f64), 2..12),
            tolerance in 1e-3..5.0f64,
        ) {
            let control: Vec<Point2> = control.into_iter().map(|(x, z)| Point2::new(x, z)).collect();
            let mut points = vec![control[0]];
            Curve::bezier(control.clone()).unwrap().flatten(Length::mm(tolerance), &mut points).unwrap();
            prop_assert_eq!(points.last(), control.last());
            for i in 0..=200 {
                let on_curve = by_definition(&control, f64::from(i) / 200.0);
                let off = distance_to_polyline(on_curve, &points);
                prop_assert!(off <= tolerance + 1e-9, "{off}");
            }
        }
    }

    #[test]
    fn a_straight_curve_is_one_chord() {
        let mut points = Vec::new();
        let control = (0..5).map(|i| Point2::new(f64::from(i), 2.0 * f64::from(i)));
        Bezier::new(control.collect())
            .flatten(1e-6, 100, &mut points)
            .unwrap();
        assert_eq!(points, [Point2::new(4.0, 8.0)]);
    }

    #[test]
    fn hostile_sizes_end_in_an_error() {
        let zigzag: Vec<Point2> = (0..64)
            .map(|i| Point2::new(1e9 * f64::from(i % 2), 1e9 * f64::from((i + 1) % 2)))
            .collect();
        let mut points = Vec::new();
        assert_eq!(
            Curve::bezier(zigzag).unwrap().flatten(Length::ZERO, &mut points),
            Err(CurveError::TooManyPoints)
        );
    }

    #[test]
    fn control_points_are_limited() {
        let many: Vec<Point2> = (0..65).map(|i| Point2::new(f64::from(i), 0.0)).collect();
        assert_eq!(Curve::bezier(many), Err(CurveError::TooManyControlPoints));
    }
}
