//! Circular arcs.
//!
//! An arc is held as its ends and the angle it turns through. Its points then follow from the chord: after turning
//! through the angle `a` the way gone from the start is the chord turned by `(a - sweep)/2` and scaled by
//! `sin(a/2) / sin(sweep/2)` (a chord makes half the angle of its arc with the tangent). The centre never enters, so
//! nearly straight arcs, whose centre is far away, keep their precision.

use super::{COINCIDENT, CurveError, MOST_POINTS, Point2, check_points};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use vcutc_backend_api::units::Length;

/// How unequal the distances of a centre from both ends may be, in mm. It also identifies a half circle.
const CENTER_TOLERANCE: f64 = 1e-3;

/// Three points whose triangle is lower than this lie on one line, in mm.
const COLLINEAR: f64 = 1e-6;

/// Share of the radius by which it may fall short of half the chord: rounding in what the user computed.
const RADIUS_ROUNDING: f64 = 1e-9;

/// Largest angle over one chord. The polyline of a coarse tolerance shall still look like an arc.
const WIDEST_CHORD: f64 = FRAC_PI_2;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    from: Point2,
    to: Point2,
    /// Angle turned through from start to end, in rad, positive to the left; never 0, magnitude below 2 pi.
    sweep: f64,
}

impl Arc {
    pub(super) fn by_radius(from: Point2, to: Point2, radius: f64) -> Result<Self, CurveError> {
        check_points(&[from, to, Point2::new(radius, 0.0)])?;
        let half_chord = from.distance(to) / 2.0;
        if half_chord < COINCIDENT {
            return Err(CurveError::PointsCoincide { index: 1 });
        }
        if radius.abs() < half_chord * (1.0 - RADIUS_ROUNDING) {
            return Err(CurveError::RadiusTooSmall {
                smallest: Length::mm(half_chord),
            });
        }
        let size = 2.0 * libm::asin((half_chord / radius.abs()).min(1.0));
        Ok(Self {
            from,
            to,
            sweep: size * radius.signum() * over_the_chord(from, to),
        })
    }

    pub(super) fn by_center(from: Point2, to: Point2, center: Point2) -> Result<Self, CurveError> {
        check_points(&[from, to, center])?;
        let (chord, to_start, to_end) = (from.distance(to), center.distance(from), center.distance(to));
        if chord < COINCIDENT {
            return Err(CurveError::PointsCoincide { index: 1 });
        }
        if (to_start - to_end).abs() > CENTER_TOLERANCE {
            return Err(CurveError::CenterNotEquidistant {
                to_start: Length::mm(to_start),
                to_end: Length::mm(to_end),
            });
        }
        // Height of the centre over the chord, positive to the left, about which the shorter arc turns left.
        let height = to.minus(from).cross(center.minus(from)) / chord;
        let sweep = if height.abs() <= CENTER_TOLERANCE {
            PI * over_the_chord(from, to)
        } else {
            2.0 * libm::atan2(chord / 2.0, height.abs()) * height.signum()
        };
        Ok(Self { from, to, sweep })
    }

    pub(super) fn through(from: Point2, through: Point2, to: Point2) -> Result<Self, CurveError> {
        check_points(&[from, through, to])?;
        if from.distance(through) < COINCIDENT {
            return Err(CurveError::PointsCoincide { index: 1 });
        }
        if from.distance(to).min(through.distance(to)) < COINCIDENT {
            return Err(CurveError::PointsCoincide { index: 2 });
        }
        let (first, second) = (through.minus(from), to.minus(through));
        let turn = first.cross(second);
        let longest = from
            .distance(to)
            .max(from.distance(through))
            .max(through.distance(to));
        if turn.abs() <= COLLINEAR * longest {
            return Err(CurveError::Collinear);
        }
        // The angle between both chords is half the angle of the whole arc (inscribed angle theorem).
        Ok(Self {
            from,
            to,
            sweep: 2.0 * libm::atan2(turn, first.dot(second)),
        })
    }

    /// The arc that turns through an angle below a whole turn.
    pub(super) fn by_sweep(from: Point2, to: Point2, sweep: f64) -> Result<Self, CurveError> {
        check_points(&[from, to])?;
        if from.distance(to) < COINCIDENT {
            return Err(CurveError::PointsCoincide { index: 1 });
        }
        let turn = sweep.abs();
        if turn > 0.0 && turn < TAU {
            Ok(Self { from, to, sweep })
        } else {
            Err(CurveError::OutOfRange { index: 2 })
        }
    }

    pub(super) const fn sweep(&self) -> f64 {
        self.sweep
    }

    pub(super) const fn from(&self) -> Point2 {
        self.from
    }

    pub(super) fn flatten(&self, tolerance: f64, out: &mut Vec<Point2>) -> Result<(), CurveError> {
        let pieces = libm::ceil(self.sweep.abs() / self.widest_chord(tolerance));
        // The cast saturates; the comparison still comes first.
        if pieces > MOST_POINTS as f64 {
            return Err(CurveError::TooManyPoints);
        }
        let pieces = (pieces as usize).max(1);
        out.extend((1..pieces).map(|i| self.at(self.sweep * (i as f64 / pieces as f64))));
        out.push(self.to);
        Ok(())
    }

    /// Largest angle whose chord keeps the tolerance: sagitta `2 r sin^2(angle/4)`.
    fn widest_chord(&self, tolerance: f64) -> f64 {
        let radius = self.from.distance(self.to) / (2.0 * libm::sin(self.sweep.abs() / 2.0));
        let share = (tolerance / (2.0 * radius)).min(1.0);
        (4.0 * libm::asin(share.sqrt())).min(WIDEST_CHORD)
    }

    /// The point after turning through `angle`.
    fn at(&self, angle: f64) -> Point2 {
        let scale = libm::sin(angle / 2.0) / libm::sin(self.sweep / 2.0);
        let (sin, cos) = libm::sincos((angle - self.sweep) / 2.0);
        let chord = self.to.minus(self.from);
        Point2::new(
            self.from.x + scale * (chord.x * cos - chord.z * sin),
            self.from.z + scale * (chord.x * sin + chord.z * cos),
        )
    }
}

/// Sense of turning of an arc over its chord: to the right on the way right, to the left on the way left. Over a
/// vertical chord the arc to the left of the way counts as over it, so that it turns right.
fn over_the_chord(from: Point2, to: Point2) -> f64 {
    if to.x < from.x { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn flat(arc: Arc, tolerance: f64) -> Vec<Point2> {
        let mut points = vec![arc.from];
        arc.flatten(tolerance, &mut points).unwrap();
        points
    }

    #[test]
    fn positive_radius_is_a_hill_both_ways() {
        let (a, b) = (Point2::new(0.0, 0.0), Point2::new(10.0, 0.0));
        for (from, to) in [(a, b), (b, a)] {
            let hill = flat(Arc::by_radius(from, to, 6.0).unwrap(), 1e-3);
            assert!(hill.iter().all(|p| p.z >= -1e-12));
            let top = hill.iter().map(|p| p.z).fold(0.0, f64::max);
            assert!((top - (6.0 - 11.0_f64.sqrt())).abs() < 1e-3);
            let hollow = flat(Arc::by_radius(from, to, -6.0).unwrap(), 1e-3);
            assert!(hollow.iter().all(|p| p.z <= 1e-12));
        }
    }

    #[test]
    fn too_small_a_radius_names_the_smallest() {
        let result = Arc::by_radius(Point2::new(0.0, 0.0), Point2::new(6.0, 8.0), 4.9);
        assert_eq!(
            result,
            Err(CurveError::RadiusTooSmall {
                smallest: Length::mm(5.0)
            })
        );
        assert!(Arc::by_radius(Point2::new(0.0, 0.0), Point2::new(6.0, 8.0), 5.0 - 1e-12).is_ok());
    }

    #[test]
    fn half_circle_about_a_centre_is_the_upper_one() {
        let (a, b) = (Point2::new(0.0, 0.0), Point2::new(10.0, 0.0));
        for (from, to) in [(a, b), (b, a)] {
            for dip in [0.0, 1e-9, -1e-9] {
                let arc = Arc::by_center(from, to, Point2::new(5.0, dip)).unwrap();
                assert!(flat(arc, 1e-3).iter().all(|p| p.z >= -1e-12));
            }
        }
    }

    #[test]
    fn centre_must_be_equidistant() {
        let result = Arc::by_center(
            Point2::new(0.0, 0.0),
            Point2::new(10.0, 0.0),
            Point2::new(4.0, 0.0),
        );
        assert_eq!(
            result,
            Err(CurveError::CenterNotEquidistant {
                to_start: Length::mm(4.0),
                to_end: Length::mm(6.0)
            })
        );
    }

    #[test]
    fn points_on_a_line_make_no_arc() {
        let at = |t: f64| Point2::new(3.0 * t, 7.0 * t);
        assert_eq!(
            Arc::through(at(0.0), at(0.3), at(1.0)),
            Err(CurveError::Collinear)
        );
        assert_eq!(
            Arc::through(at(0.0), at(2.0), at(1.0)),
            Err(CurveError::Collinear)
        );
        assert_eq!(
            Arc::through(at(0.0), at(1.0), at(0.0)),
            Err(CurveError::PointsCoincide { index: 2 })
        );
    }

    #[test]
    fn a_nearly_straight_arc_keeps_its_precision() {
        let arc = Arc::by_radius(Point2::new(0.0, 0.0), Point2::new(100.0, 0.0), 1e9).unwrap();
        // Sagitta c^2 / 8r.
        assert!((arc.at(arc.sweep / 2.0).z - 1.25e-6).abs() < 1e-13);
    }

    proptest! {
        /// The circle is rebuilt from a centre, a radius and angles, the way the arc is not computed.
        #[test]
        fn every_way_of_giving_an_arc_follows_the_circle(
            radius in 0.1..1e4f64, start in -PI..PI, sweep in 0.05..3.0f64, left: bool, tolerance in 1e-6..1.0f64,
        ) {
            let center = Point2::new(12.0, -7.0);
            let on = |angle: f64| Point2::new(center.x + radius * libm::cos(angle), center.z + radius * libm::sin(angle));
            let sweep = if left { sweep } else { -sweep };
            let (from, middle, to) = (on(start), on(start + sweep / 2.0), on(start + sweep));
            let half_chord = from.distance(to) / 2.0;
            let up = if (to.x < from.x) == left { radius } else { -radius };
            for arc in [
                Arc::by_center(from, to, center).unwrap(),
                Arc::through(from, middle, to).unwrap(),
                Arc::by_radius(from, to, up.signum() * radius.max(half_chord)).unwrap(),
            ] {
                let points = flat(arc, tolerance);
                prop_assert_eq!(*points.last().unwrap(), to);
                let slack = radius * 1e-7;
                for pair in points.windows(2) {
                    prop_assert!((pair[0].distance(center) - radius).abs() < slack);
                    let chord_middle = pair[0].lerp(pair[1], 0.5);
                    let sagitta = radius - chord_middle.distance(center);
                    prop_assert!(sagitta > -slack && sagitta < tolerance + slack, "{sagitta}");
                }
                let nearest = points.windows(2)
                    .map(|p| middle.distance(p[0].lerp(p[1], ((middle.minus(p[0])).dot(p[1].minus(p[0]))
                        / p[1].minus(p[0]).dot(p[1].minus(p[0]))).clamp(0.0, 1.0))))
                    .fold(f64::INFINITY, f64::min);
                prop_assert!(nearest < tolerance + slack);
            }
        }

        #[test]
        fn more_than_half_a_circle_goes_through_the_third_point(sweep in 3.2..6.2f64) {
            let on = |angle: f64| Point2::new(5.0 * libm::cos(angle), 5.0 * libm::sin(angle));
            let arc = Arc::through(on(0.0), on(sweep / 2.0), on(sweep)).unwrap();
            prop_assert!((arc.sweep - sweep).abs() < 1e-9);
            prop_assert!(arc.at(arc.sweep / 2.0).distance(on(sweep / 2.0)) < 1e-9);
        }
    }
}
