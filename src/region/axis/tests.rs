//! Circles and necks of known regions, and of random ones by boxes.

use super::*;
use crate::region::Inside;
use crate::testkit::{any_region, circle, pocket, polygon, rectangle, region};
use proptest::prelude::*;

#[test]
fn the_largest_circles_of_four_pockets() {
    let expected = [
        110.0 - 6000.0_f64.sqrt(),
        37.5,
        290.0 - 67620.0_f64.sqrt(),
        95.0 - 4950.0_f64.sqrt(),
    ];
    for (number, expected) in (2..).zip(expected) {
        let found = largest_circle(&pocket(number), 0.0).unwrap();
        assert!(
            (found.radius - expected).abs() < 1e-6,
            "pocket {number}: {found:?} {expected}"
        );
    }
    let corner = largest_circle(&pocket(2), 0.0).unwrap();
    assert!(corner.centre.distance(Place::new(corner.radius, corner.radius)) < 1e-6);
}

#[test]
fn circles_without_three_walls() {
    let round = largest_circle(&region(&[circle(3.0, 4.0, 20.0)]), 0.0).unwrap();
    assert!((round.radius - 20.0).abs() < 1e-6 && round.centre.distance(Place::new(3.0, 4.0)) < 1e-5);
    let long = largest_circle(&region(&[rectangle(0.0, 0.0, 100.0, 40.0)]), 0.0).unwrap();
    assert!((long.radius - 20.0).abs() < 1e-6 && (long.centre.y - 20.0).abs() < 1e-6);
    let ring = region(&[circle(0.0, 0.0, 30.0), circle(0.0, 0.0, 10.0)]);
    assert!((largest_circle(&ring, 0.0).unwrap().radius - 10.0).abs() < 1e-6);
}

/// Two squares of 40 and 60 mm joined by a corridor with a waist between two points.
fn waist(width: f64) -> Region {
    region(&[polygon(&[
        (0.0, 0.0),
        (60.0, 0.0),
        (60.0, 20.0),
        (70.0, 30.0 - width / 2.0),
        (80.0, 20.0),
        (80.0, 10.0),
        (120.0, 10.0),
        (120.0, 50.0),
        (80.0, 50.0),
        (80.0, 40.0),
        (70.0, 30.0 + width / 2.0),
        (60.0, 40.0),
        (60.0, 60.0),
        (0.0, 60.0),
    ])])
}

#[test]
fn the_neck_between_two_basins() {
    let waist = waist(9.6);
    let necks = necks(&waist, 0.0, 6.0, 1.0).unwrap();
    let [neck] = necks[..] else { panic!("{necks:?}") };
    assert!(
        (neck.width - 9.6).abs() < 1e-5 && neck.at.distance(Place::new(70.0, 30.0)) < 1e-2,
        "{neck:?}"
    );
}

#[test]
fn necks_wider_than_the_tool_are_none() {
    assert!(necks(&waist(9.6), 0.0, 4.7, 1.0).unwrap().is_empty());
    assert!(necks(&pocket(3), 0.0, 30.0, 3.0).unwrap().is_empty());
    assert_eq!(necks(&pocket(3), 0.0, 30.0, 0.0), Err(AxisFault::Step));
    // Pocket 4 comes apart into two horns.
    let horns = necks(&pocket(4), 0.0, 29.0, 4.0).unwrap();
    let [neck] = horns[..] else { panic!("{horns:?}") };
    assert!(
        (neck.width - 56.0).abs() < 1e-5 && (neck.at.x - 60.0).abs() < 1e-2,
        "{neck:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn no_circle_is_larger(region in any_region()) {
        let found = largest_circle(&region, 0.0).unwrap();
        let (walls, inside) = (Walls::of(&region), Inside::of(&region));
        prop_assert!((walls.distance(found.centre) - found.radius).abs() < 1e-9);
        prop_assert!(inside.contains(found.centre));
        // Boxes: the distance grows no faster than the way.
        let bounds = region.bounds();
        let size = bounds.low.distance(bounds.high) / 2.0;
        let mut open = vec![(bounds.middle(), size)];
        while let Some((middle, half)) = open.pop() {
            let away = walls.distance(middle);
            let depth = if inside.contains(middle) { away } else { -away };
            prop_assert!(depth < found.radius + 1e-6, "{middle:?} {depth} {found:?}");
            if depth + half * 1.415 > found.radius + 0.02 {
                let quarter = half / 2.0;
                for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                    open.push((middle.plus(Place::new(x, y).times(quarter)), quarter));
                }
            }
        }
    }
}
