//! Curves against sampled ones.

use super::*;
use proptest::prelude::*;

fn place() -> impl Strategy<Value = Place> {
    (-20.0..20.0f64, -20.0..20.0f64).prop_map(|(x, y)| Place::new(x, y))
}

fn piece() -> impl Strategy<Value = Piece> {
    let sweep = prop_oneof![Just(0.0), -6.0..6.0f64, -1e-4..1e-4f64];
    (place(), place(), sweep).prop_map(|(from, to, sweep)| Piece::arc(from, to, sweep))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn places_of_a_piece_are_on_its_curve(piece in piece(), share in 0.0..1.0f64) {
        prop_assume!(piece.from.distance(piece.to) > 0.1);
        let curve = Curve::of(piece);
        let at = piece.at(share);
        let size = piece.radius().unwrap_or(0.0).min(1e3) + 40.0;
        prop_assert!(curve.left_of(at).abs() < 1e-12 * size);
        prop_assert!(curve.is_beside(at, 1e-9 * size));
        prop_assert!(curve.middle.distance(piece.at(0.5)) < 1e-12 * size);
        prop_assert!(curve.ahead.distance(piece.direction(0.0)) < 1e-12);
        prop_assert!(curve.arrival.distance(piece.direction(1.0)) < 1e-12);
        prop_assert!(curve.direction(at).distance(piece.direction(share)) < 1e-10 * size);
        let whole = if piece.is_line() { piece.length() } else { piece.sweep };
        prop_assert!((curve.progress(at) - share * whole).abs() < 1e-9 * size, "{}", curve.progress(at));
        let extent = curve.extent().grown(1e-9);
        prop_assert!(extent.squared_distance(at) == 0.0);
    }

    #[test]
    fn the_nearest_place_is_that_of_many_samples(piece in piece(), place in place()) {
        prop_assume!(piece.from.distance(piece.to) > 0.1);
        let curve = Curve::of(piece);
        let foot = curve.nearest(place);
        let samples = (0..=4000).map(|i| piece.at(f64::from(i) / 4000.0).distance(place));
        let best = samples.fold(f64::INFINITY, f64::min);
        prop_assert!((foot.distance - curve.distance(place)).abs() < 1e-9);
        prop_assert!((foot.at.distance(place) - foot.distance).abs() < 1e-9);
        prop_assert!(foot.distance <= best + 1e-9);
        prop_assert!(foot.distance >= best - piece.length() / 4000.0);
        prop_assert!(curve.distance(foot.at) < 1e-9);
    }

    #[test]
    fn circles_cross_where_they_cross(one in piece(), other in piece()) {
        prop_assume!(one.from.distance(one.to) > 0.1 && other.from.distance(other.to) > 0.1);
        let (one, other) = (Curve::of(one), Curve::of(other));
        for at in crossings(&one, &other).into_iter().flatten() {
            if at.length() < 1e3 {
                prop_assert!(one.left_of(at).abs() < 1e-7, "{}", one.left_of(at));
                prop_assert!(other.left_of(at).abs() < 1e-7);
            }
        }
        // Where the sides of one change along the other, a crossing lies between.
        let sides: Vec<(Place, bool)> = (0..=1000)
            .map(|i| other.piece.at(f64::from(i) / 1000.0))
            .map(|at| (at, one.left_of(at) > 0.0))
            .collect();
        for pair in sides.windows(2) {
            if pair[0].1 != pair[1].1 {
                let gap = pair[0].0.distance(pair[1].0) * 1.1 + 1e-9;
                let found = crossings(&one, &other).into_iter().flatten();
                prop_assert!(found.into_iter().any(|at| at.distance(pair[0].0) <= gap));
            }
        }
    }

    #[test]
    fn the_other_crossing_is_the_one_that_is_not_known(
        from in place(), common in place(), to in place(), a in -3.0..3.0f64, b in -3.0..3.0f64,
    ) {
        prop_assume!(from.distance(common) > 0.5 && common.distance(to) > 0.5);
        let (one, other) = (Curve::of(Piece::arc(from, common, a)), Curve::of(Piece::arc(common, to, b)));
        let at = other_crossing(&one, &other, common, (one.arrival, other.ahead)).unwrap();
        prop_assume!(at.length() < 1e3);
        prop_assert!(one.left_of(at).abs() < 1e-6 && other.left_of(at).abs() < 1e-6);
    }
}
