//! Arcs of ellipses, given by two conjugate half-diameters.
//!
//! `P(t) = c + u cos t + v sin t`. Any linear map of an ellipse maps `c`, `u` and `v` alone, so that turned, mirrored and
//! stretched ellipses need no axes. The second derivative is no longer than the longer half-axis `a` (the largest
//! singular value of the matrix of `u` and `v`), so a chord over the parameter `h` is at most `a h^2 / 8` off the curve.

use super::{CurveError, MOST_POINTS, Point2, check_points};
use core::f64::consts::{FRAC_PI_2, TAU};

/// Largest step of the parameter over one chord. The polyline of a coarse tolerance shall still look like an ellipse.
const WIDEST_STEP: f64 = FRAC_PI_2;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EllipticArc {
    center: Point2,
    /// From the centre to `t = 0`.
    first: Point2,
    /// From the centre to `t = 90 deg`.
    second: Point2,
    start: f64,
    /// Positive towards `second`; magnitude at most a whole turn.
    sweep: f64,
}

impl EllipticArc {
    pub(super) fn new(
        center: Point2,
        [first, second]: [Point2; 2],
        start: f64,
        sweep: f64,
    ) -> Result<Self, CurveError> {
        check_points(&[center, first, second, Point2::new(start, sweep)])?;
        let sweep = sweep.clamp(-TAU, TAU);
        Ok(Self {
            center,
            first,
            second,
            start,
            sweep,
        })
    }

    pub(super) fn from(&self) -> Point2 {
        self.at(self.start)
    }

    pub(super) fn flatten(&self, tolerance: f64, out: &mut Vec<Point2>) -> Result<(), CurveError> {
        let step = (8.0 * tolerance / self.longer_half_axis().max(tolerance))
            .sqrt()
            .min(WIDEST_STEP);
        let pieces = libm::ceil(self.sweep.abs() / step);
        if pieces > MOST_POINTS as f64 {
            return Err(CurveError::TooManyPoints);
        }
        let pieces = (pieces as usize).max(1);
        out.extend((1..=pieces).map(|i| self.at(self.start + self.sweep * (i as f64 / pieces as f64))));
        Ok(())
    }

    fn at(&self, t: f64) -> Point2 {
        let (sin, cos) = libm::sincos(t);
        Point2::new(
            self.center.x + self.first.x * cos + self.second.x * sin,
            self.center.z + self.first.z * cos + self.second.z * sin,
        )
    }

    fn longer_half_axis(&self) -> f64 {
        let (u, v) = (self.first.dot(self.first), self.second.dot(self.second));
        let mixed = self.first.dot(self.second);
        (f64::midpoint(u, v) + libm::hypot((u - v) / 2.0, mixed)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Curve;
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::units::{Angle, Length};

    proptest! {
        /// The distance to the ellipse is taken in its own equation, in which it is the unit circle: a point of the
        /// polyline at the share `1 - e` of the way to the curve is at most `e` times the longer half-axis off.
        #[test]
        fn the_polyline_stays_within_the_tolerance(
            u in (-50.0..50.0f64, 1.0..50.0f64), ratio in 0.05..1.0f64, start in -6.0..6.0f64,
            sweep in -6.2..6.2f64, tolerance in 1e-3..0.1f64,
        ) {
            let (center, first) = (Point2::new(3.0, -7.0), Point2::new(u.0, u.1));
            let second = Point2::new(-u.1 * ratio, u.0 * ratio);
            let curve =
                Curve::elliptic_arc(center, [first, second], Angle::rad(start), Angle::rad(sweep)).unwrap();
            let mut points = vec![curve.start()];
            curve.flatten(Length::mm(tolerance), &mut points).unwrap();
            let long = libm::hypot(u.0, u.1);
            for pair in points.windows(2) {
                for share in [0.0, 0.25, 0.5, 0.9] {
                    let p = pair[0].lerp(pair[1], share).minus(center);
                    let unit = libm::hypot(
                        p.dot(first) / (long * long),
                        p.dot(second) / (long * long * ratio * ratio),
                    );
                    prop_assert!((1.0 - unit) * long * ratio <= tolerance + 1e-9);
                    prop_assert!(unit <= 1.0 + 1e-9);
                }
            }
            let end = Point2::new(
                center.x + first.x * libm::cos(start + sweep) + second.x * libm::sin(start + sweep),
                center.z + first.z * libm::cos(start + sweep) + second.z * libm::sin(start + sweep),
            );
            prop_assert!(points[points.len() - 1].distance(end) < 1e-9);
        }
    }
}
