//! Profiles against brute force over their corners.

use super::*;
use proptest::prelude::*;

fn points(raw: &[(f64, f64)]) -> Vec<Point2> {
    raw.iter().map(|&(x, z)| Point2::new(x, z)).collect()
}

/// Profiles of up to some hundred points, so that several blocks come up.
fn profiles() -> impl Strategy<Value = Profile> {
    prop::collection::vec((0.01..5.0f64, -20.0..20.0f64), 2..300).prop_map(|steps| {
        let mut x = -50.0;
        let through = steps.into_iter().map(|(step, z)| {
            x += step;
            Point2::new(x, z)
        });
        Profile::new(through.collect()).unwrap()
    })
}

#[test]
fn the_first_point_that_does_not_go_on_is_named() {
    let steep = points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 5.0), (2.0, 5.0)]);
    assert_eq!(
        Profile::new(steep),
        Err(ProfileError::NotSingleValued { index: 2 })
    );
    let back = points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.5, 5.0), (-2.0, 5.0)]);
    assert_eq!(
        Profile::new(back),
        Err(ProfileError::NotSingleValued { index: 3 })
    );
    let straight_up = points(&[(0.0, 0.0), (0.0, 1.0)]);
    assert_eq!(
        Profile::new(straight_up),
        Err(ProfileError::NotSingleValued { index: 1 })
    );
}

#[test]
fn too_little_and_too_far_are_refused() {
    assert_eq!(Profile::new(vec![]), Err(ProfileError::TooFew));
    assert_eq!(
        Profile::new(points(&[(1.0, 1.0), (1.0, 1.0)])),
        Err(ProfileError::TooFew)
    );
    for wrong in [f64::NAN, f64::INFINITY, 2e9] {
        assert_eq!(
            Profile::new(points(&[(0.0, 0.0), (1.0, wrong)])),
            Err(ProfileError::OutOfRange { index: 1 })
        );
    }
}

#[test]
fn a_profile_from_right_to_left_is_turned_round() {
    let raw = [(0.0, 1.0), (2.0, 3.0), (5.0, 0.0)];
    let mut reversed = raw;
    reversed.reverse();
    assert_eq!(Profile::new(points(&reversed)), Profile::new(points(&raw)));
}

#[test]
fn beyond_the_ends_the_height_stays() {
    let profile = Profile::new(points(&[(0.0, 1.0), (2.0, 3.0)])).unwrap();
    for (x, z) in [(-5.0, 1.0), (0.5, 1.5), (2.0, 3.0), (9.0, 3.0)] {
        assert!((profile.height(x) - z).abs() < 1e-15);
    }
}

#[test]
fn ends_of_a_clip_may_be_off_by_rounding_only() {
    let profile = Profile::new(points(&[(0.0, 1.0), (2.0, 3.0)])).unwrap();
    let clip = profile.clipped(-1e-7, 2.0 + 1e-7).unwrap();
    assert_eq!(clip.span(), (-1e-7, 2.0 + 1e-7));
    assert_eq!(profile.clipped(-1e-5, 2.0), None);
    assert_eq!(profile.clipped(1.0, 1.0), None);
    assert_eq!(profile.clipped(f64::NAN, 1.0), None);
}

#[test]
fn area_and_length_of_a_triangle() {
    let tent = Profile::new(points(&[(0.0, 0.0), (3.0, 4.0), (6.0, 0.0)])).unwrap();
    assert!((tent.area_below(0.0, 6.0).to_mm2() - 12.0).abs() < 1e-12);
    assert!((tent.area_below(1.5, 3.0).to_mm2() - 4.5).abs() < 1e-12);
    assert!((tent.area_below(-1.0, 8.0).to_mm2() - 12.0).abs() < 1e-12);
    assert!((tent.arc_length().to_mm() - 10.0).abs() < 1e-12);
    assert_eq!(tent.highest(), Point2::new(3.0, 4.0));
    assert_eq!(tent.lowest(), Point2::new(0.0, 0.0));
}

proptest! {
    #[test]
    fn height_is_linear_interpolation(profile in profiles(), share in 0.0..1.0f64, t in 0.0..1.0f64) {
        let i = ((profile.points().len() - 1) as f64 * share) as usize;
        let on = profile.points()[i].lerp(profile.points()[i + 1], t);
        prop_assert!((profile.height(on.x) - on.z).abs() < 1e-9);
    }

    #[test]
    fn a_clip_is_the_same_function(profile in profiles(), a in 0.0..1.0f64, b in 0.0..1.0f64, t in 0.0..1.0f64) {
        let (start, end) = profile.span();
        let at = |share: f64| start + (end - start) * share;
        let (from, to) = (at(a.min(b)), at(a.max(b)));
        prop_assume!(to - from > 1e-6);
        let clip = profile.clipped(from, to).unwrap();
        prop_assert_eq!(clip.span(), (from, to));
        let x = from + (to - from) * t;
        prop_assert!((clip.height(x) - profile.height(x)).abs() < 1e-9);
        let whole = profile.area_below(start, from) + profile.area_below(from, to) + profile.area_below(to, end);
        prop_assert!((whole - profile.area_below(start, end)).abs().to_mm2() < 1e-6);
    }

    /// Against all segments, each by the distance to many places on it and to its ends.
    #[test]
    fn the_nearest_distance_is_that_of_the_nearest_segment(
        profile in profiles(), share in -0.2..1.2f64, z in -40.0..80.0f64,
    ) {
        let (start, end) = profile.span();
        let point = Point2::new(start + (end - start) * share, z);
        let truth = profile.points().windows(2).map(|p| {
            // Golden section: the distance along a segment is convex.
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..80 {
                let (a, b) = (high - 0.618 * (high - low), low + 0.618 * (high - low));
                if point.distance(p[0].lerp(p[1], a)) < point.distance(p[0].lerp(p[1], b)) { high = b } else { low = a }
            }
            point.distance(p[0].lerp(p[1], (low + high) / 2.0))
        }).fold(f64::INFINITY, f64::min);
        prop_assert!((profile.nearest_distance(point) - truth).abs() < 1e-6);
    }
}
