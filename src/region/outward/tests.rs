//! Levels moved outwards, against distances of points.

use super::*;
use crate::distance::Walls;
use crate::offset::{Kind, level};
use crate::testkit::{any_region, pocket};
use proptest::prelude::*;

/// Slits at `e + n f` and passes of the disc at `R + n f` over two of the test pockets, in mm, as an
/// independent program computed them; ways run on beyond open sides by the first distance.
#[test]
fn lengths_of_slits_and_passes() {
    let (radius, standoff, step) = (12.5, 0.75, 6.75);
    let length = |number: usize, first: f64| -> f64 {
        let region = pocket(number);
        let mut sum = 0.0;
        for count in 0..100 {
            let ways = level(&region, first, first + f64::from(count) * step).unwrap();
            if ways.is_empty() {
                break;
            }
            sum += ways.iter().map(|way| way.length()).sum::<f64>();
        }
        sum
    };
    for (number, slits, passes) in [(1, 1429.6, 1167.8), (2, 1406.1, 686.9)] {
        assert!(
            (length(number, standoff) - slits).abs() < 0.05,
            "{}",
            length(number, standoff)
        );
        assert!(
            (length(number, radius) - passes).abs() < 0.05,
            "{}",
            length(number, radius)
        );
    }
}

proptest! {
    /// All of a way that is moved outwards lies as far from the way as it is moved, and no nearer to a wall than what is left.
    #[test]
    fn keeps_its_distance(region in any_region(), share in 0.1..0.95_f64) {
        let distance = 12.0;
        let by = share * distance;
        let Ok(ways) = level(&region, 20.0, distance) else { return Ok(()) };
        let walls = Walls::of(&region);
        for way in ways.iter().filter(|way| way.kind == Kind::Loop) {
            let own = Walls::of_pieces(way.pieces.iter().copied().enumerate());
            let moved = outward(&way.pieces, by);
            prop_assert!(moved.first().unwrap().from == moved.last().unwrap().to);
            for piece in &moved {
                for step in 0..=8 {
                    let at = piece.at(f64::from(step) / 8.0);
                    prop_assert!(own.distance(at) <= by + 1e-6, "{} {by}", own.distance(at));
                    prop_assert!(walls.distance(at) >= distance - by - 1e-6);
                }
                prop_assert!(piece.is_line() || piece.sweep < 0.0 || piece.radius().unwrap() >= by - 1e-6);
            }
        }
    }
}
