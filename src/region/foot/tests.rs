//! What stays at the foot of walls, against places along them.

use super::*;
use crate::slits::{Knife, slits};
use crate::testkit::{any_region, circle, polygon, rectangle, region};
use proptest::prelude::*;

const KNIFE: Knife = Knife {
    half_apex: 0.124,
    half: 0.75,
    keep: 0.01,
    height: 20.0,
    run_out: 2.0,
    grid: 0.0,
};

const BLADE: Sides = Sides {
    thickness: 1.5,
    allowance: 0.01,
};

fn ways(region: &Region) -> Option<Vec<Piece>> {
    let slits = slits(region, KNIFE).ok()?;
    let pieces = slits.iter().flat_map(|slit| &slit.pieces);
    Some(pieces.map(|piece| piece.way).collect())
}

#[test]
fn straight_walls_are_half_a_blade_away() {
    let region = region(&[rectangle(0.0, 0.0, 40.0, 30.0)]);
    let foot = foot(&region, &ways(&region).unwrap(), BLADE).unwrap();
    let far = foot.walls.unwrap().distance;
    assert!((far - 0.76).abs() < 1e-9 && foot.corners.is_none(), "{foot:?}");
}

/// A slit that ends 3 mm before the corner leaves the rest of the wall attached.
#[test]
fn a_slit_that_is_too_short_is_seen() {
    let region = region(&[rectangle(0.0, 0.0, 40.0, 30.0)]);
    let mut ways = ways(&region).unwrap();
    let share = 1.0 - 3.0 / ways[0].length();
    ways[0] = ways[0].part(0.0, share);
    let far = foot(&region, &ways, BLADE).unwrap().walls.unwrap();
    assert!(far.distance > 1.2, "{far:?}");
}

/// In a corner of 45 deg a plate leaves what lies before its outer edge.
#[test]
fn acute_corners_count_apart() {
    let region = region(&[polygon(&[(0.0, 0.0), (60.0, 0.0), (0.0, 60.0)])]);
    let foot = foot(&region, &ways(&region).unwrap(), BLADE).unwrap();
    assert!(foot.walls.unwrap().distance < 0.761, "{foot:?}");
    assert!(foot.corners.unwrap().distance > 1.0, "{foot:?}");
}

#[test]
fn a_region_without_slits_is_endlessly_far() {
    let region = region(&[circle(0.0, 0.0, 10.0)]);
    assert!(
        foot(&region, &[], BLADE)
            .unwrap()
            .walls
            .unwrap()
            .distance
            .is_infinite()
    );
}

/// With a wide allowance the corner of the wall itself is farther away than any place beside a slit, and need not be near one.
#[test]
fn corners_of_an_allowance_are_its_own() {
    let region = region(&[rectangle(0.0, 0.0, 80.0, 60.0)]);
    let wide = Knife { keep: 10.0, ..KNIFE };
    let slits = slits(&region, wide).unwrap();
    let ways: Vec<Piece> = slits
        .iter()
        .flat_map(|slit| &slit.pieces)
        .map(|piece| piece.way)
        .collect();
    let blade = Sides {
        allowance: 10.0,
        ..BLADE
    };
    let far = foot(&region, &ways, blade).unwrap().walls.unwrap().distance;
    assert!((far - 10.75).abs() < 1e-6, "{far}");
}

/// A long circle takes no more looks than a short one.
#[test]
fn long_hollow_walls_are_said_by_a_closed_form() {
    let region = region(&[circle(0.0, 0.0, 5000.0)]);
    let ways = ways(&region).unwrap();
    let far = foot(&region, &ways, BLADE).unwrap().walls.unwrap().distance;
    let expected = 5000.0 - ways[0].radius().unwrap();
    assert!((far - expected).abs() < 1e-6, "{far} {expected}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn no_place_is_farther_than_the_bound(region in any_region()) {
        let Some(ways) = ways(&region) else { return Ok(()) };
        let found = foot(&region, &ways, BLADE).unwrap();
        let most = found.walls.map_or(0.0, |left| left.distance);
        let ways = Walls::of_pieces(ways.into_iter().enumerate());
        let mut seen: f64 = 0.0;
        for ring in region.loops() {
            for (place, edge) in ring.iter().enumerate() {
                let [begin, end] = [place + ring.len() - 1, place].map(|place| Corner::at(ring, place, BLADE).covers);
                let long = edge.piece.length();
                for step in 0..=500 {
                    let share = f64::from(step) / 500.0;
                    if share * long >= begin && (1.0 - share) * long >= end {
                        seen = seen.max(ways.distance(edge.piece.at(share)));
                    }
                }
            }
        }
        prop_assert!(seen <= most + 1e-9);
        // A five-hundredth of a wall moves the distance by no more than its length.
        let longest = region.edges().map(|edge| edge.piece.length()).fold(0.0, f64::max);
        prop_assert!(most <= seen + RESOLUTION + longest / 500.0, "{most} {seen}");
    }
}
