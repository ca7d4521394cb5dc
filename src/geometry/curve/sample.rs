//! Polylines of formulas.
//!
//! Nothing is known of a formula but its values, so no bound can be proven. What is done instead: start from a
//! uniform grid, and accept an interval only when the formula stays within half the tolerance of the chord at five
//! places inside, unevenly spaced so that a periodic formula cannot meet the chord at all of them by chance.

use super::{LARGEST_COORDINATE, Point2};
use vcutc_backend_api::units::Length;

/// Intervals of the first grid.
const FIRST_GRID: usize = 256;

/// Most points of a formula. Fewer than of a curve: each costs five evaluations or more.
pub const MOST_SAMPLES: usize = 500_000;

/// Where an interval is tested in addition to its middle, as shares of its width.
const TESTS: [f64; 4] = [0.113, 0.289, 0.717, 0.891];

/// Intervals narrower than this are not halved any more, in mm; relative to x where that is more.
const NARROWEST: f64 = 1e-8;
const NARROWEST_SHARE: f64 = 1e-14;

/// Why a formula has no polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleError {
    /// The formula has no value here, or one that is not a number or beyond [`LARGEST_COORDINATE`].
    NoValue {
        /// Where, in mm.
        x: f64,
    },
    /// The formula steps: however near two places are, their heights differ by more than the tolerance.
    Jump {
        /// Where, in mm.
        x: f64,
    },
    /// The range is empty or not in the range of coordinates.
    BadRange,
    /// The tolerance asks for more than [`MOST_SAMPLES`].
    TooManyPoints,
}

/// The polyline of `z = f(x)` from one x to a greater one, both in mm, ends included. `f` is asked for a height in mm
/// at an x in mm.
///
/// # Errors
/// See [`SampleError`].
pub fn sample(
    f: &dyn Fn(f64) -> Option<f64>,
    from: f64,
    to: f64,
    tolerance: Length,
) -> Result<Vec<Point2>, SampleError> {
    if !(from < to && Point2::new(from, to).is_in_range()) {
        return Err(SampleError::BadRange);
    }
    let accepted = tolerance.to_mm().max(super::FINEST_TOLERANCE) / 2.0;
    let mut last = evaluate(f, from)?;
    let mut points = vec![last];
    for i in 1..=FIRST_GRID {
        let x = if i == FIRST_GRID {
            to
        } else {
            from + (to - from) * (i as f64 / FIRST_GRID as f64)
        };
        let next = evaluate(f, x)?;
        refine(f, [last, next], accepted, &mut points)?;
        last = next;
    }
    Ok(points)
}

/// Appends the polyline of an interval, without its first point.
fn refine(
    f: &dyn Fn(f64) -> Option<f64>,
    interval: [Point2; 2],
    accepted: f64,
    points: &mut Vec<Point2>,
) -> Result<(), SampleError> {
    // Intervals still to do, the next one last. At most one a halving, of which there are less than a hundred.
    let mut intervals = vec![interval];
    while let Some([a, b]) = intervals.pop() {
        let middle = evaluate(f, a.x + (b.x - a.x) / 2.0)?;
        let mut good = (middle.z - a.lerp(b, 0.5).z).abs() <= accepted;
        for share in TESTS {
            let chord = a.lerp(b, share);
            good &= (evaluate(f, chord.x)?.z - chord.z).abs() <= accepted;
        }
        if good {
            if points.len() >= MOST_SAMPLES {
                return Err(SampleError::TooManyPoints);
            }
            points.push(b);
        } else if b.x - a.x <= NARROWEST.max(a.x.abs() * NARROWEST_SHARE) {
            return Err(SampleError::Jump { x: middle.x });
        } else {
            intervals.push([middle, b]);
            intervals.push([a, middle]);
        }
    }
    Ok(())
}

fn evaluate(f: &dyn Fn(f64) -> Option<f64>, x: f64) -> Result<Point2, SampleError> {
    f(x).filter(|z| z.abs() <= LARGEST_COORDINATE)
        .map(|z| Point2::new(x, z))
        .ok_or(SampleError::NoValue { x })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn worst(f: &dyn Fn(f64) -> Option<f64>, points: &[Point2]) -> f64 {
        points
            .windows(2)
            .flat_map(|p| (0..=16).map(move |i| p[0].lerp(p[1], f64::from(i) / 16.0)))
            .map(|chord| (f(chord.x).unwrap() - chord.z).abs())
            .fold(0.0, f64::max)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        #[test]
        fn waves_of_any_length_are_followed(waves in 0.1..1000.0f64, phase in 0.0..6.0f64) {
            let f = |x: f64| Some(10.0 * libm::sin(x * waves / 100.0 * core::f64::consts::TAU + phase));
            let points = sample(&f, 0.0, 100.0, Length::mm(0.05)).unwrap();
            prop_assert!(worst(&f, &points) <= 0.05);
            prop_assert!(points.windows(2).all(|p| p[0].x < p[1].x));
        }
    }

    #[test]
    fn a_wave_that_is_zero_on_the_whole_grid_is_seen() {
        let f = |x: f64| Some(libm::sin(x * 256.0 * core::f64::consts::PI));
        let points = sample(&f, 0.0, 1.0, Length::mm(0.01)).unwrap();
        assert!(worst(&f, &points) <= 0.01);
    }

    #[test]
    fn a_vertical_tangent_is_not_a_jump() {
        let f = |x: f64| (x <= 50.0).then(|| (2500.0 - x * x).max(0.0).sqrt());
        let points = sample(&f, 0.0, 50.0, Length::mm(0.005)).unwrap();
        assert!(worst(&f, &points) <= 0.005);
    }

    #[test]
    fn a_step_is_found() {
        let f = |x: f64| Some(if x < 20.123 { 1.0 } else { 2.0 });
        match sample(&f, 0.0, 50.0, Length::mm(0.01)) {
            Err(SampleError::Jump { x }) => assert!((x - 20.123).abs() < 1e-6),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_missing_value_is_named() {
        let f = |x: f64| (x < 10.0).then_some(1.0);
        match sample(&f, 0.0, 50.0, Length::mm(0.01)) {
            Err(SampleError::NoValue { x }) => assert!((10.0..10.3).contains(&x)),
            other => panic!("{other:?}"),
        }
        let pole = |x: f64| Some(1.0 / (x - 25.0));
        assert!(sample(&pole, 0.0, 50.0, Length::mm(0.01)).is_err());
    }

    #[test]
    fn noise_ends_in_an_error() {
        let noise = |x: f64| Some(libm::sin(x * 1e12));
        assert!(sample(&noise, 0.0, 1.0, Length::mm(1e-3)).is_err());
        assert_eq!(
            sample(&noise, 1.0, 1.0, Length::mm(1e-3)),
            Err(SampleError::BadRange)
        );
        assert_eq!(
            sample(&noise, f64::NAN, 1.0, Length::mm(1e-3)),
            Err(SampleError::BadRange)
        );
    }
}
