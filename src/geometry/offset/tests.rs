//! The offset against brute force: no point of it is nearer to the part than asked.

use super::*;
use proptest::prelude::*;

fn profile(raw: &[(f64, f64)]) -> Profile {
    Profile::new(raw.iter().map(|&(x, z)| Point2::new(x, z)).collect()).unwrap()
}

fn distance_to_segment(point: Point2, pair: &[Point2]) -> f64 {
    let way = pair[1].minus(pair[0]);
    let share = point.minus(pair[0]).dot(way) / way.dot(way);
    point.distance(pair[0].lerp(pair[1], share.clamp(0.0, 1.0)))
}

/// A point on the true offset is exactly the distance away from the profile, one above it is farther: so the
/// distance from places on the result gives both bounds, without any notion of caps.
fn assert_offset(profile: &Profile, distance: f64, shares: &[f64]) {
    let raised = offset_up(profile, Length::mm(distance));
    let (start, end) = profile.span();
    assert_eq!(raised.span(), (start, end));
    assert!(raised.points().windows(2).all(|p| p[0].x < p[1].x));
    let sampled = shares.iter().map(|share| {
        let x = start + (end - start) * share;
        Point2::new(x, raised.height(x))
    });
    for place in raised.points().iter().copied().chain(sampled) {
        assert!(place.z > profile.height(place.x), "{place:?}");
        let away = profile
            .points()
            .windows(2)
            .map(|pair| distance_to_segment(place, pair))
            .fold(f64::INFINITY, f64::min);
        let above = away - distance;
        assert!((-1e-8..=1e-3).contains(&above), "{place:?} is {above:e} above");
    }
}

#[test]
fn a_plain_is_raised() {
    let raised = offset_up(&profile(&[(0.0, 1.0), (10.0, 1.0)]), Length::mm(0.5));
    assert_eq!(raised, profile(&[(0.0, 1.5), (10.0, 1.5)]));
}

#[test]
fn a_slope_is_shifted_along_its_normal() {
    // Slope 3/4, so a rise of 5/4 of the distance; the left end is rounded off by nothing, as it continues down.
    let raised = offset_up(&profile(&[(0.0, 0.0), (40.0, 30.0)]), Length::mm(2.0));
    assert!((raised.height(20.0) - (15.0 + 2.5)).abs() < 1e-12);
}

#[test]
fn a_groove_narrower_than_the_disc_is_bridged() {
    let groove = profile(&[(0.0, 10.0), (9.0, 10.0), (10.0, 0.0), (11.0, 10.0), (20.0, 10.0)]);
    let raised = offset_up(&groove, Length::mm(5.0));
    let over_the_middle = 10.0 + 24.0_f64.sqrt();
    assert!((raised.height(10.0) - over_the_middle).abs() < 1e-3);
    assert!((raised.height(2.0) - 15.0).abs() < 1e-12);
}

#[test]
fn nothing_or_less_gives_the_profile() {
    let tent = profile(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
    for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(offset_up(&tent, Length::mm(distance)), tent);
    }
}

#[test]
fn a_wall_is_kept_at_its_distance() {
    let wall = profile(&[(0.0, 50.0), (10.0, 50.0), (10.0 + 1e-6, 0.0), (30.0, 0.0)]);
    assert_offset(&wall, 2.0, &[0.1, 0.39, 0.41, 0.9]);
    let climb = profile(&[(0.0, 0.0), (10.0, 0.0), (10.0 + 1e-6, 50.0), (30.0, 50.0)]);
    assert_offset(&climb, 2.0, &[0.1, 0.26, 0.27, 0.9]);
}

#[test]
fn a_fine_arc_is_raised_to_the_larger_arc() {
    let arc: Vec<Point2> = (0..=20_000)
        .map(|i| f64::from(i) / 20_000.0 * 2.0 - 1.0)
        .map(|angle| Point2::new(50.0 * libm::sin(angle), 50.0 * libm::cos(angle)))
        .collect();
    let raised = offset_up(&Profile::new(arc).unwrap(), Length::mm(7.0));
    for p in raised.points().iter().filter(|p| p.x.abs() < 40.0) {
        let above = libm::hypot(p.x, p.z) - 57.0;
        assert!((-1e-6..1e-3).contains(&above));
    }
    assert!(raised.points().len() < 45_000);
}

#[test]
fn huge_numbers_do_no_harm() {
    let far = profile(&[(-1e9, -1e9), (0.0, 1e9), (1.0, -1e9), (1e9, 1e9)]);
    for distance in [1e-300, 1e-9, 1.0, 1e9, 1e300] {
        let raised = offset_up(&far, Length::mm(distance));
        assert!(raised.points().windows(2).all(|p| p[0].x < p[1].x));
        assert!(raised.points().iter().all(|p| p.z.is_finite()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn the_offset_is_where_the_distance_is(
        steps in prop::collection::vec((0.05..6.0f64, -8.0..8.0f64), 2..40),
        distance in 0.01..12.0f64, shares in prop::collection::vec(0.0..1.0f64, 40),
    ) {
        let mut x = 0.0;
        let raw: Vec<(f64, f64)> = steps.iter().map(|&(step, z)| { x += step; (x, z) }).collect();
        assert_offset(&profile(&raw), distance, &shares);
    }

    /// Many segments much shorter than the radius.
    #[test]
    fn the_offset_of_a_rough_surface_is_where_the_distance_is(
        heights in prop::collection::vec(-0.3..0.3f64, 100..300),
        distance in 0.5..20.0f64, shares in prop::collection::vec(0.0..1.0f64, 40),
    ) {
        let raw: Vec<(f64, f64)> = heights.iter().enumerate()
            .map(|(i, &z)| (i as f64 * 0.05, z + libm::sin(i as f64 * 0.05)))
            .collect();
        assert_offset(&profile(&raw), distance, &shares);
    }

    /// The definition itself, sampled: no sample may be above the result.
    #[test]
    fn no_disc_on_the_profile_sticks_out(
        steps in prop::collection::vec((0.05..6.0f64, -8.0..8.0f64), 2..20),
        distance in 0.01..12.0f64, share in 0.0..1.0f64,
    ) {
        let mut x = 0.0;
        let raw: Vec<(f64, f64)> = steps.iter().map(|&(step, z)| { x += step; (x, z) }).collect();
        let profile = profile(&raw);
        let raised = offset_up(&profile, Length::mm(distance));
        let (start, end) = profile.span();
        let at = start + (end - start) * share;
        for i in -500..=500 {
            let t = distance * f64::from(i) / 500.0;
            if (start..=end).contains(&(at + t)) {
                let reached = profile.height(at + t) + (distance * distance - t * t).max(0.0).sqrt();
                prop_assert!(raised.height(at) >= reached - 1e-6);
            }
        }
    }
}
