//! Distances against sampled ones.

use super::*;
use crate::region::Edge;
use proptest::prelude::*;

fn nearest_between(one: Piece, other: Piece) -> (f64, Place, Place) {
    between(&Curve::of(one), &Curve::of(other))
}

fn place() -> impl Strategy<Value = Place> {
    (-20.0..20.0f64, -20.0..20.0f64).prop_map(|(x, y)| Place::new(x, y))
}

fn piece() -> impl Strategy<Value = Piece> {
    let sweep = prop_oneof![Just(0.0), -6.0..6.0f64, -1e-3..1e-3f64];
    let pieces = (place(), place(), sweep).prop_map(|(from, to, sweep)| Piece::arc(from, to, sweep));
    pieces.prop_filter("too short", |piece| piece.from.distance(piece.to) > 0.1)
}

/// Shortest way from samples of a piece to another piece, each way by golden section in between.
fn sampled(one: &Piece, other: &Curve) -> f64 {
    let distance = |share: f64| other.distance(one.at(share.clamp(0.0, 1.0)));
    let coarse = (0..=400).map(f64::from).map(|i| i / 400.0);
    let best = coarse
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap();
    let (mut low, mut high) = (best - 1.0 / 400.0, best + 1.0 / 400.0);
    for _ in 0..80 {
        let (a, b) = (low + (high - low) * 0.382, low + (high - low) * 0.618);
        if distance(a) < distance(b) {
            high = b;
        } else {
            low = a;
        }
    }
    distance(low).min(distance(best))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn pieces_are_as_near_as_their_samples(one in piece(), other in piece()) {
        let (distance, from, to) = nearest_between(one, other);
        let best = sampled(&one, &Curve::of(other));
        prop_assert!(distance <= best + 1e-9, "{distance} {best}");
        // Samples see no crossing exactly.
        let finest = if distance == 0.0 { one.length() / 400.0 } else { 1e-6 };
        prop_assert!(distance >= best - finest, "{distance} {best}");
        prop_assert!((from.distance(to) - distance).abs() < 1e-9);
        prop_assert!(Curve::of(one).distance(from) < 1e-8 && Curve::of(other).distance(to) < 1e-8);
        let (back, ..) = nearest_between(other, one);
        prop_assert!((back - distance).abs() < 1e-9);
    }

    #[test]
    fn the_tree_finds_the_nearest_wall(pieces in prop::collection::vec(piece(), 1..40), place in place(), probe in piece()) {
        let walls = Walls::of_pieces(pieces.iter().copied().enumerate());
        let nearest = walls.nearest(place).unwrap();
        let all = pieces.iter().map(|&piece| Curve::of(piece).distance(place));
        let best = all.fold(f64::INFINITY, f64::min);
        prop_assert!((nearest.distance - best).abs() < 1e-9);
        prop_assert!((walls.distance(place) - best).abs() < 1e-9);
        prop_assert!((Curve::of(pieces[nearest.edge]).distance(place) - best).abs() < 1e-9);
        prop_assert!(walls.nearer_than(place, best * (1.0 - 1e-9)).is_none());
        prop_assert!(best == 0.0 || walls.nearer_than(place, best * (1.0 + 1e-9)).is_some());
        prop_assert!(walls.nearest_within(place, best * 0.99).is_none());
        let (_, to) = walls.nearest_to(probe).unwrap();
        let all = pieces.iter().map(|&piece| nearest_between(probe, piece).0);
        prop_assert!((to.distance - all.fold(f64::INFINITY, f64::min)).abs() < 1e-9);
    }
}

#[test]
fn open_sides_are_not_walls() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(x, y)| Place::new(x, y));
    let edges = (0..4).map(|i| Edge {
        piece: Piece::line(corners[i], corners[(i + 1) % 4]),
        side: if i == 1 { Side::Open } else { Side::Wall },
    });
    let region = Region::new(vec![edges.collect()]).unwrap();
    let walls = Walls::of(&region);
    let nearest = walls.nearest(Place::new(9.0, 4.0)).unwrap();
    assert_eq!((nearest.edge, nearest.distance), (0, 4.0));
    assert_eq!(nearest.at, Place::new(9.0, 0.0));
}

#[test]
fn arcs_about_one_centre_and_parallel_lines() {
    let half = core::f64::consts::PI;
    let inner = Piece::arc(Place::new(2.0, 0.0), Place::new(-2.0, 0.0), half);
    let outer = Piece::arc(Place::new(5.0, 0.0), Place::new(-5.0, 0.0), half);
    assert!((nearest_between(inner, outer).0 - 3.0).abs() < 1e-12);
    let low = Piece::line(Place::new(0.0, 0.0), Place::new(9.0, 0.0));
    let high = Piece::line(Place::new(12.0, 4.0), Place::new(3.0, 4.0 + 1e-9));
    assert!((nearest_between(low, high).0 - 4.0).abs() < 1e-8);
    // An arc of 1e5 mm over a line: its sagitta of 1.25e-2 mm less.
    let flat = Piece::arc(Place::new(0.0, 4.0), Place::new(100.0, 4.0), 1e-3);
    let sagitta = 50.0 * 2.5e-4;
    let line = Piece::line(Place::new(-10.0, 0.0), Place::new(110.0, 0.0));
    assert!((nearest_between(flat, line).0 - 4.0 + sagitta).abs() < 1e-8);
}
