//! Envelopes against all segments asked one by one.

use super::*;
use proptest::prelude::*;

/// The greatest height of all segments over an x, upright ones included.
fn brute(segments: &[[Point2; 2]], x: f64) -> Option<f64> {
    segments
        .iter()
        .filter(|[a, b]| a.x.min(b.x) <= x && x <= a.x.max(b.x))
        .map(|[a, b]| {
            if a.x == b.x {
                a.z.max(b.z)
            } else {
                a.z + (b.z - a.z) * (x - a.x) / (b.x - a.x)
            }
        })
        .reduce(f64::max)
}

fn point() -> impl Strategy<Value = Point2> {
    // Whole numbers make ends meet and segments stand upright.
    prop_oneof![
        ((0..20i32), (0..10i32)).prop_map(|(x, z)| Point2::new(x.into(), z.into())),
        (0.0..20.0, 0.0..10.0).prop_map(|(x, z)| Point2::new(x, z)),
    ]
}

proptest! {
    #[test]
    fn it_is_the_greatest_of_all(
        segments in prop::collection::vec(prop::array::uniform2(point()), 1..40), x in 0.0..20.0,
    ) {
        let envelope = Envelope::of(segments.iter().copied());
        let ends = segments.iter().flatten().map(|p| p.x);
        for x in ends.chain((0..20).map(f64::from)).chain([x]) {
            match (envelope.highest(x, x), brute(&segments, x)) {
                (Some(ours), Some(theirs)) => prop_assert!((ours - theirs).abs() < 1e-9, "{x}: {ours} {theirs}"),
                (ours, theirs) => prop_assert_eq!(ours, theirs),
            }
        }
        let halves = segments.split_at(segments.len() / 2);
        let joined = Envelope::of(halves.0.iter().copied()).with(&Envelope::of(halves.1.iter().copied()));
        match (joined.highest(x, x), brute(&segments, x)) {
            (Some(ours), Some(theirs)) => prop_assert!((ours - theirs).abs() < 1e-9),
            (ours, theirs) => prop_assert_eq!(ours, theirs),
        }
    }

    #[test]
    fn its_profile_is_nowhere_below_and_right_beside_steps(
        mut segments in prop::collection::vec(prop::array::uniform2(point()), 1..40), xs in prop::collection::vec(0.0..20.0, 20),
    ) {
        segments.push([Point2::new(0.0, 0.0), Point2::new(20.0, 0.0)]);
        let envelope = Envelope::of(segments.iter().copied());
        prop_assert!(envelope.holes(0.0, 20.0, 0.0).is_empty());
        let profile = envelope.profile(0.0, 20.0).unwrap();
        prop_assert_eq!(profile.span(), (0.0, 20.0));
        for &x in xs.iter().chain(segments.iter().flatten().map(|p| &p.x)) {
            let height = brute(&segments, x).unwrap();
            prop_assert!(profile.height(x) >= height - 1e-6, "{x}: {} {height}", profile.height(x));
        }
        for &x in &xs {
            // Random places are far from steps.
            prop_assume!(segments.iter().flatten().all(|p| (p.x - x).abs() > 1e-7));
            prop_assert!((profile.height(x) - brute(&segments, x).unwrap()).abs() < 1e-6);
        }
    }
}

#[test]
fn holes_are_what_nothing_lies_over() {
    let level = |from: f64, to: f64| [Point2::new(from, 1.0), Point2::new(to, 1.0)];
    let envelope = Envelope::of([level(1.0, 2.0), level(2.001, 3.0), level(2.5, 5.0)].into_iter());
    assert_eq!(envelope.holes(0.0, 6.0, 0.01), [[0.0, 1.0], [5.0, 6.0]]);
    assert_eq!(envelope.holes(1.0, 5.0, 1e-4), [[2.0, 2.001]]);
    let profile = envelope.profile(0.0, 6.0).unwrap();
    assert_eq!([0.0, 2.0005, 6.0].map(|x| profile.height(x)), [1.0; 3]);
}

#[test]
fn steps_lean_outwards() {
    let segments = [
        [Point2::new(0.0, 1.0), Point2::new(4.0, 1.0)],
        [Point2::new(4.0, 3.0), Point2::new(6.0, 3.0)],
        [Point2::new(6.0, 2.0), Point2::new(9.0, 2.0)],
        [Point2::new(8.0, 0.0), Point2::new(8.0, 5.0)],
    ];
    let profile = Envelope::of(segments.into_iter()).profile(0.0, 9.0).unwrap();
    let heights = [3.999_999, 4.0, 6.0, 6.000_001, 8.0, 8.000_001].map(|x| profile.height(x));
    assert_eq!(heights, [1.0, 3.0, 3.0, 2.0, 5.0, 2.0]);
}
