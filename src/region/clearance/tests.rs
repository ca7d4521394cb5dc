//! Distances of passes, against places sampled along them.

use super::*;
use crate::testkit::passes::{closed, open, rectangle, ring, rings};
use crate::testkit::pocket;
use proptest::prelude::*;

#[test]
fn rings_keep_what_they_are_laid_at() {
    let region = rectangle(80.0, 60.0);
    let found = clearance(&region, &rings(80.0, 60.0, 5.0, 4.0));
    let least = found.least.unwrap();
    assert!((least.distance - 5.0).abs() < 1e-12, "{least:?}");
    assert_eq!((least.pass, found.astray), (0, vec![]));
    assert_eq!(clearance(&region, &[]).least, None);
}

/// The pass bends by 2 um towards the wall, in the middle of one of its arcs: no end of any piece is too near.
#[test]
fn an_arc_too_deep_by_two_micrometres_is_found() {
    let region = rectangle(80.0, 60.0);
    let sagitta = 0.002;
    // tan(sweep / 4) of an arc that bulges by so much over a chord of 40 mm.
    let bulge = sagitta / 20.0;
    let pass = closed(
        0,
        &[
            [20.0, 5.0, bulge],
            [60.0, 5.0, 0.0],
            [60.0, 55.0, 0.0],
            [20.0, 55.0, 0.0],
        ],
    );
    let least = clearance(&region, &[pass]).least.unwrap();
    assert!((least.distance - 4.998).abs() < 1e-9, "{least:?}");
    assert_eq!((least.piece, least.wall), (0, 0));
    assert!(least.on_pass.distance(Place::new(40.0, 4.998)) < 1e-6);
    assert!(least.on_wall.distance(Place::new(40.0, 0.0)) < 1e-6);
}

#[test]
fn passes_leave_through_open_sides_only() {
    // The first pocket is open at x = 120.
    let region = pocket(1);
    let out = open(&[[30.0, 40.0], [130.0, 40.0]]);
    let back = open(&[[130.0, 40.0], [120.1, 10.0], [130.0, 5.0]]);
    let through = open(&[[125.0, 40.0], [110.0, 40.0], [125.0, 42.0]]);
    let found = clearance(&region, &[out, back, through]);
    assert_eq!(found.astray, [1]);
    let crossing = clearance(&region, &[open(&[[30.0, 40.0], [30.0, -40.0]])]);
    assert_eq!(crossing.least.unwrap().distance, 0.0);
    // One that crosses the whole region, with both ends outside, is not astray: it meets walls.
    let across = clearance(&region, &[open(&[[30.0, 90.0], [30.0, -40.0]])]);
    assert_eq!((across.astray.len(), across.least.unwrap().distance), (0, 0.0));
    let outside = clearance(&region, &[open(&[[30.0, -20.0], [60.0, -20.0]])]);
    assert_eq!(outside.astray, [0]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_sampled_place_is_nearer(
        corners in prop::collection::vec((1.0..119.0f64, 1.0..89.0f64, -1.5..1.5f64), 2..6),
        number in 2..6usize,
    ) {
        let corners: Vec<[f64; 3]> = corners.into_iter().map(|(x, y, bulge)| [x, y, bulge]).collect();
        prop_assume!(corners.windows(2).all(|pair| pair[0] != pair[1]));
        let region = pocket(number);
        let pieces: Vec<Piece> = ring(&corners).iter().map(|edge| edge.piece).collect();
        let found = clearance(&region, &[Pass { level: 0, pieces: pieces.clone() }]).least.unwrap();
        let dots = |piece: Piece| {
            let count = libm::ceil(piece.length() / 0.2).max(1.0);
            (0..=count as usize).map(move |i| piece.at(i as f64 / count))
        };
        let walls: Vec<Place> = region.edges().flat_map(|edge| dots(edge.piece)).collect();
        let mut sampled = f64::INFINITY;
        for place in pieces.iter().flat_map(|&piece| dots(piece)) {
            for wall in &walls {
                sampled = sampled.min(place.minus(*wall).square());
            }
        }
        let sampled = sampled.sqrt();
        prop_assert!(found.distance <= sampled + 1e-9);
        // Places lie 0.2 mm apart at most on both.
        prop_assert!(sampled <= found.distance + 0.21, "{} {sampled}", found.distance);
        let piece = Curve::of(pieces[found.piece]);
        prop_assert!((found.on_pass.distance(found.on_wall) - found.distance).abs() < 1e-9);
        prop_assert!(piece.distance(found.on_pass) < 1e-7);
        let wall = region.edges().nth(found.wall).unwrap();
        prop_assert!(Curve::of(wall.piece).distance(found.on_wall) < 1e-7);
    }
}
