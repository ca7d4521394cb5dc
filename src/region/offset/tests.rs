//! Levels of known pockets.

use super::*;
use crate::region::Side;
use crate::testkit::{
    any_cells, any_region, bulged, circle, flat, is_within, pocket, polygon, rectangle, region,
};
use core::f64::consts::PI;
use proptest::prelude::*;

/// Loops and length of all levels `5 + 4 n`, in mm, of five test pockets, by clipping polygons (GEOS). The last level of
/// pocket 3 is a chord of a circle and its arc: there 34.76 came of the chords; `2 (sqrt(38^2 - 37^2) + 38 asin(..))` is 34.79.
const EXPECTED: [&[(usize, f64)]; 5] = [
    &[
        (1, 288.70),
        (1, 275.42),
        (1, 262.14),
        (1, 248.87),
        (1, 235.59),
        (1, 222.31),
        (1, 209.03),
        (1, 195.75),
        (1, 181.49),
    ],
    &[
        (1, 377.85),
        (1, 344.14),
        (1, 310.42),
        (1, 276.70),
        (1, 242.99),
        (1, 139.27),
        (1, 79.48),
    ],
    &[
        (1, 313.14),
        (1, 284.36),
        (1, 255.55),
        (1, 226.72),
        (1, 197.85),
        (1, 168.95),
        (1, 140.00),
        (1, 107.97),
        (1, 34.79),
    ],
    &[
        (1, 356.41),
        (1, 314.87),
        (1, 275.33),
        (1, 237.27),
        (1, 200.38),
        (1, 164.41),
        (2, 43.16),
    ],
    &[(2, 485.65), (2, 485.65), (2, 485.65), (2, 482.23), (2, 246.24)],
];

fn levels(region: &Region, reach: f64) -> Vec<Vec<Way>> {
    let mut offsets = Offsets::of(region, reach);
    let levels = (0..100).map(|n| offsets.level(5.0 + 4.0 * f64::from(n)).unwrap());
    levels.take_while(|ways| !ways.is_empty()).collect()
}

#[test]
fn the_levels_of_five_pockets() {
    for (number, expected) in (1..).zip(EXPECTED) {
        let levels = levels(&pocket(number), 5.0);
        assert_eq!(levels.len(), expected.len(), "pocket {number}");
        for (level, (ways, &(count, length))) in levels.iter().zip(expected).enumerate() {
            let ways = ways.iter().filter(|way| way.kind != Kind::Tie);
            let lengths: Vec<f64> = ways.map(Way::length).collect();
            let sum: f64 = lengths.iter().sum();
            assert!(
                (sum - length).abs() < 0.03 && lengths.len() == count,
                "pocket {number}, level {level}: {lengths:?} {length}"
            );
        }
    }
}

#[test]
fn levels_of_an_l_in_closed_form() {
    let levels = levels(&pocket(2), 0.0);
    for (ways, distance) in levels.iter().zip([5.0, 9.0, 13.0, 17.0, 21.0]) {
        let expected = 420.0 - (10.0 - PI / 2.0) * distance;
        assert!((ways[0].length() - expected).abs() < 1e-9);
        let [way] = &ways[..] else { panic!("{ways:?}") };
        assert_eq!(way.pieces.len(), 7);
    }
    // The arm is 50 mm wide: its middle is a way of its own.
    let tie = levels[5].iter().find(|way| way.kind == Kind::Tie).unwrap();
    assert!(
        (tie.length() - 35.0).abs() < 1e-9 && tie.pieces.len() == 1,
        "{tie:?}"
    );
    assert!((levels[5][0].length() - (420.0 - (10.0 - PI / 2.0) * 25.0 - 70.0)).abs() < 1e-9);
}

#[test]
fn levels_round_an_island_in_closed_form() {
    let levels = levels(&pocket(5), 0.0);
    for ways in levels.iter().take(3) {
        let sum: f64 = ways.iter().map(Way::length).sum();
        assert!((sum - (360.0 + 40.0 * PI)).abs() < 1e-9, "{sum} {ways:#?}");
    }
}

#[test]
fn ways_run_out_of_open_sides() {
    let ways = level(&pocket(1), 7.0, 5.0).unwrap();
    let [way] = &ways[..] else { panic!("{ways:?}") };
    assert_eq!(way.kind, Kind::Run);
    let (first, last) = (way.pieces.first().unwrap(), way.pieces.last().unwrap());
    assert!(first.from.distance(Place::new(127.0, 75.0)) < 1e-9, "{first:?}");
    assert!(last.to.distance(Place::new(127.0, 5.0)) < 1e-9, "{last:?}");
}

/// Every sampled place is farther from the walls than a distance where, and only where, the loops of the level enclose it, and
/// places of the loops are just as far.
fn assert_level(region: &Region, distance: f64) {
    let walls = Walls::of(region);
    let ways = level(region, 0.0, distance).unwrap_or_else(|fault| panic!("{fault:?} {distance} {region:?}"));
    for way in &ways {
        assert_eq!(way.pieces.len(), way.origins.len());
        for (piece, next) in way.pieces.iter().zip(way.pieces.iter().skip(1)) {
            assert_eq!(piece.to, next.from);
        }
        for (piece, origin) in way.pieces.iter().zip(&way.origins) {
            for i in 0..=8 {
                let place = piece.at(f64::from(i) / 8.0);
                let away = walls.distance(place);
                assert!(
                    (away - distance).abs() < 4e-7,
                    "{away} for {distance} at {place:?} {region:?}"
                );
                let edge = |number: usize| Curve::of(region.edges().nth(number).unwrap().piece);
                let own = match *origin {
                    Origin::Edge(edge_number) => edge(edge_number).distance(place),
                    Origin::Gate => panic!("{region:?} is closed"),
                    Origin::Corner(edge_number) => edge(edge_number).piece.from.distance(place),
                };
                assert!((own - distance).abs() < 4e-7, "{own} {origin:?} {distance}");
            }
        }
    }
    let loops = ways.iter().filter(|way| way.kind == Kind::Loop);
    let loops: Vec<_> = loops.map(|way| flat(way.pieces.iter().copied(), 1e-4)).collect();
    let bounds = region.bounds();
    let inside = Inside::of(region);
    for i in 0..40 {
        for j in 0..40 {
            let share = |k: i32| (f64::from(k) + 0.5) / 40.0;
            let place = Place::new(
                bounds.low.x + (bounds.high.x - bounds.low.x) * share(i),
                bounds.low.y + (bounds.high.y - bounds.low.y) * share(j),
            );
            let away = walls.distance(place);
            if (away - distance).abs() > 2e-4 {
                let is_deep = away > distance && inside.contains(place);
                assert_eq!(
                    is_within(&loops, place),
                    is_deep,
                    "{place:?} at {away} for {distance} {region:?}"
                );
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn loops_enclose_what_is_deep(region in any_region(), distance in prop_oneof![0.1..25.0f64, Just(5.0), Just(1.0)]) {
        assert_level(&region, distance);
    }

    /// The middle of every corridor one cell wide is there, on a loop or as a tie.
    #[test]
    fn no_corridor_is_lost(region in any_cells(6.0)) {
        let (walls, inside) = (Walls::of(&region), Inside::of(&region));
        let ways = level(&region, 0.0, 3.0).unwrap();
        let pieces = ways.iter().flat_map(|way| &way.pieces);
        let found = Walls::of_pieces(pieces.copied().enumerate());
        let is_tied = |place: Place| inside.contains(place) && (walls.distance(place) - 3.0).abs() < 1e-9;
        for x in 0..6 {
            for y in 0..6 {
                let middle = Place::new(f64::from(x) * 6.0 + 3.0, f64::from(y) * 6.0 + 3.0);
                for side in [Place::new(6.0, 0.0), Place::new(0.0, 6.0)] {
                    let between = middle.plus(side.times(0.5));
                    if [middle, between, middle.plus(side)].iter().all(|&place| is_tied(place)) {
                        let away = found.distance(between);
                        prop_assert!(away < 1e-6, "{away} at {between:?} {region:?}");
                    }
                }
            }
        }
        let ties = ways.iter().filter(|way| way.kind == Kind::Tie).flat_map(|way| &way.pieces);
        let ties: Vec<Piece> = ties.copied().collect();
        for (number, one) in ties.iter().enumerate() {
            for other in &ties[..number] {
                // Kept once.
                prop_assert!(Curve::of(*other).distance(one.at(0.5)) > 1e-6);
            }
        }
    }

    /// Ties, touches and coincidences all over.
    #[test]
    fn cells_have_levels(region in any_cells(6.0), distance in prop_oneof![Just(1.0), Just(2.0), Just(3.0), Just(4.0), Just(6.0), 1.0..6.0f64]) {
        assert_level(&region, distance);
    }
}

/// Loops, runs and ties of a level.
fn kinds(ways: &[Way]) -> [usize; 3] {
    [Kind::Loop, Kind::Run, Kind::Tie].map(|kind| ways.iter().filter(|way| way.kind == kind).count())
}

/// Two squares of 40 mm joined by a corridor 20 mm long.
fn dumbbell(width: f64) -> Region {
    let (low, high) = (20.0 - width / 2.0, 20.0 + width / 2.0);
    region(&[polygon(&[
        (0.0, 0.0),
        (40.0, 0.0),
        (40.0, low),
        (60.0, low),
        (60.0, 0.0),
        (100.0, 0.0),
        (100.0, 40.0),
        (60.0, 40.0),
        (60.0, high),
        (40.0, high),
        (40.0, 40.0),
        (0.0, 40.0),
    ])])
}

#[test]
fn a_corridor_as_wide_as_the_tool_is_kept_once() {
    let ways = level(&dumbbell(10.0), 0.0, 5.0).unwrap();
    assert_eq!(kinds(&ways), [2, 0, 1], "{ways:?}");
    let tie = ways.iter().find(|way| way.kind == Kind::Tie).unwrap();
    assert!((tie.length() - 20.0).abs() < 1e-9);
    assert_eq!(kinds(&level(&dumbbell(10.001), 0.0, 5.0).unwrap()), [1, 0, 0]);
    assert_eq!(kinds(&level(&dumbbell(9.999), 0.0, 5.0).unwrap()), [2, 0, 0]);
    // Walls that are parallel but for a little.
    for off in [1e-9, -1e-9, 3e-9] {
        let ways = level(&dumbbell(10.0 + off), 0.0, 5.0).unwrap();
        assert_eq!(kinds(&ways), [2, 0, 1], "{off} {ways:?}");
    }
}

#[test]
fn walls_that_are_parallel_but_for_a_little() {
    for tilt in [0.0, 1e-9, -1e-9, 1e-8, -1e-8, 1e-7, 1e-6] {
        let wedge = polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 10.0 + tilt), (0.0, 10.0 - tilt)]);
        let wedge = region(&[wedge]);
        assert_level(&wedge, 4.0);
        let ways = level(&wedge, 0.0, 5.0).unwrap();
        let length: f64 = ways.iter().map(Way::length).sum();
        // The middle line once, or half of it, or that there and back.
        assert!(length > 44.9 && length < 90.1, "{tilt} {length} {ways:?}");
    }
}

#[test]
fn a_ring_as_wide_as_the_tool_is_a_closed_tie() {
    let ring = region(&[circle(0.0, 0.0, 30.0), circle(0.0, 0.0, 20.0)]);
    let ways = level(&ring, 0.0, 5.0).unwrap();
    assert_eq!(kinds(&ways), [0, 0, 1], "{ways:?}");
    assert!(ways[0].is_closed() && (ways[0].length() - 50.0 * PI).abs() < 1e-6);
    assert_eq!(kinds(&level(&ring, 0.0, 4.0).unwrap()), [2, 0, 0]);
    assert_eq!(kinds(&level(&ring, 0.0, 6.0).unwrap()), [0, 0, 0]);
}

#[test]
fn a_circle_has_circles() {
    let round = region(&[circle(3.0, 4.0, 20.0)]);
    for distance in [1.0, 5.0, 19.0, 19.9999] {
        let ways = level(&round, 0.0, distance).unwrap();
        let [way] = &ways[..] else { panic!("{ways:?}") };
        assert!((way.length() - 2.0 * PI * (20.0 - distance)).abs() < 1e-9);
        assert_eq!(way.pieces.len(), 2);
    }
    assert!(level(&round, 0.0, 20.0).unwrap().is_empty());
    assert!(level(&round, 0.0, 21.0).unwrap().is_empty());
}

#[test]
fn islands_that_touch_each_other_or_the_outline() {
    let outline = rectangle(0.0, 0.0, 100.0, 80.0);
    let several = [
        vec![circle(30.0, 40.0, 10.0), circle(50.0, 40.0, 10.0)],
        vec![circle(90.0, 40.0, 10.0)],
        vec![
            rectangle(20.0, 20.0, 20.0, 20.0),
            rectangle(40.0, 40.0, 20.0, 20.0),
        ],
        vec![polygon(&[(50.0, 0.0), (60.0, 10.0), (40.0, 10.0)])],
        // In each other, as large as the tool, and smaller.
        vec![
            circle(50.0, 40.0, 30.0),
            circle(50.0, 40.0, 20.0),
            circle(50.0, 40.0, 5.0),
        ],
        vec![circle(50.0, 40.0, 1e-3), circle(20.0, 30.0, 0.1)],
        vec![circle(30.0, 40.0, 10.0), circle(60.0 + 1e-6, 40.0, 10.0)],
        vec![circle(30.0, 40.0, 10.0), circle(60.0, 40.0, 10.0)],
        vec![circle(30.0, 40.0, 10.0), circle(60.0 - 1e-6, 40.0, 10.0)],
    ];
    for islands in several {
        let mut loops = vec![outline.clone()];
        loops.extend(islands);
        let region = region(&loops);
        for distance in [1.0, 2.5, 5.0, 10.0, 15.0] {
            assert_level(&region, distance);
        }
    }
}

#[test]
fn a_loop_that_touches_itself() {
    let corners = [
        (0.0, 0.0),
        (40.0, 20.0),
        (80.0, 0.0),
        (80.0, 40.0),
        (40.0, 20.0),
        (0.0, 40.0),
    ];
    for distance in [1.0, 3.0, 5.0, 8.0] {
        assert_level(&region(&[polygon(&corners)]), distance);
    }
}

#[test]
fn arcs_of_all_sizes() {
    // Corners of 1e-3 mm and sides of 1e5 mm, hollow and bulging; corners of the tool's size.
    for radius in [1e-3, 1.0, 5.0 - 1e-9, 5.0, 5.0 + 1e-9, 5.0001, 8.0] {
        for side in [0.0, 100.0 / 4e5, -100.0 / 4e5] {
            let bulge = libm::tan(PI / 8.0);
            let (a, b) = (100.0 - radius, 60.0 - radius);
            let corners = [
                (radius, 0.0, side),
                (a, 0.0, bulge),
                (100.0, radius, 0.0),
                (100.0, b, bulge),
                (a, 60.0, side),
                (radius, 60.0, bulge),
                (0.0, b, 0.0),
                (0.0, radius, bulge),
            ];
            let region = region(&[bulged(&corners), rectangle(40.0, 20.0, 20.0, 20.0)]);
            for distance in [0.5, 5.0, 9.0, 10.0, 12.0] {
                assert_level(&region, distance);
            }
        }
    }
}

#[test]
fn corners_in_line_and_many_segments() {
    let corners: Vec<_> = (0..=20).map(|i| (f64::from(i) * 5.0, 0.0)).collect();
    let back: Vec<_> = (0..=20).map(|i| (100.0 - f64::from(i) * 5.0, 50.0)).collect();
    let line = region(&[polygon(&[corners, back].concat())]);
    for distance in [1.0, 5.0, 20.0, 24.0] {
        assert_level(&line, distance);
    }
    let many: Vec<_> = (0..5000)
        .map(|i| libm::sincos(f64::from(i) / 5000.0 * 2.0 * PI))
        .map(|(sin, cos)| (60.0 * cos, 40.0 * sin))
        .collect();
    let many = region(&[polygon(&many)]);
    for distance in [1.0, 10.0, 30.0, 39.0] {
        assert_level(&many, distance);
    }
}

/// Levels of a circle in 1e5 chords, which are less than 1e-7 mm off it.
#[test]
fn a_level_of_an_outline_of_a_hundred_thousand_segments() {
    let corners: Vec<_> = (0..100_000)
        .map(|i| libm::sincos(f64::from(i) * 2.0 * PI / 1e5))
        .map(|(sin, cos)| (100.0 * cos, 100.0 * sin))
        .collect();
    let round = region(&[polygon(&corners)]);
    for distance in [5.0, 60.0] {
        let ways = level(&round, 0.0, distance).unwrap();
        assert_eq!(kinds(&ways), [1, 0, 0]);
        let off = ways[0].length() - 2.0 * PI * (100.0 - distance);
        assert!(off.abs() < 1e-3, "{off}");
    }
}

#[test]
fn a_window_between_two_walls_in_line() {
    let mut edges = polygon(&[
        (0.0, 0.0),
        (30.0, 0.0),
        (70.0, 0.0),
        (100.0, 0.0),
        (100.0, 60.0),
        (0.0, 60.0),
    ]);
    edges[1].side = crate::region::Side::Open;
    let window = region(&[edges]);
    let ways = level(&window, 6.0, 5.0).unwrap();
    let [way] = &ways[..] else { panic!("{ways:?}") };
    assert_eq!(way.kind, Kind::Run);
    // It turns about both ends of the walls, and leaves square to the side.
    let (first, last) = (way.pieces.first().unwrap(), way.pieces.last().unwrap());
    assert!(first.from.distance(Place::new(65.0, -6.0)) < 1e-9, "{first:?}");
    assert!(last.to.distance(Place::new(35.0, -6.0)) < 1e-9, "{last:?}");
    let quarters = way
        .origins
        .iter()
        .filter(|origin| matches!(origin, Origin::Corner(_)));
    assert_eq!(quarters.count(), 2);
    // Too narrow to leave.
    assert_eq!(kinds(&level(&window, 6.0, 25.0).unwrap()), [1, 0, 0]);
}

#[test]
fn runs_are_closed_beyond_open_sides() {
    let mut offsets = Offsets::of(&pocket(1), 7.0);
    let (open, closed) = (offsets.level(5.0).unwrap(), offsets.closed_level(5.0).unwrap());
    assert_eq!(kinds(&closed), [1, 0, 0]);
    assert!(
        (closed[0].length() - open[0].length() - 70.0).abs() < 1e-9,
        "{closed:?}"
    );
    // All sides open: what is bounded is the region with a margin.
    let mut edges = rectangle(0.0, 0.0, 50.0, 30.0);
    for edge in &mut edges {
        edge.side = crate::region::Side::Open;
    }
    let ways = Offsets::of(&region(&[edges]), 6.0).closed_level(5.0).unwrap();
    assert_eq!(kinds(&ways), [1, 0, 0]);
    assert!((ways[0].length() - 160.0 - 12.0 * PI).abs() < 1e-9);
}

#[test]
fn what_has_no_level() {
    let mut edges = rectangle(0.0, 0.0, 10.0, 10.0);
    for edge in &mut edges {
        edge.side = crate::region::Side::Open;
    }
    assert_eq!(level(&region(&[edges]), 1.0, 1.0), Err(OffsetFault::NoWalls));
    for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(level(&pocket(2), 0.0, distance), Err(OffsetFault::Distance));
    }
    assert!(level(&pocket(2), 0.0, 1e9).unwrap().is_empty());
}

#[test]
fn turned_and_mirrored_regions_have_turned_and_mirrored_levels() {
    for number in 2..=5 {
        let original = pocket(number);
        let turned = |place: Place| Place::new(7.0 - place.y, place.x + 3.0);
        let mirrored = |place: Place| Place::new(-place.x, place.y);
        let map = |map: &dyn Fn(Place) -> Place, sign: f64| {
            let edge = |edge: &crate::region::Edge| crate::region::Edge {
                piece: Piece::arc(map(edge.piece.from), map(edge.piece.to), sign * edge.piece.sweep),
                side: edge.side,
            };
            let loops = original
                .loops()
                .iter()
                .map(|edges| edges.iter().map(edge).collect());
            Region::new(loops.collect()).unwrap()
        };
        for distance in [5.0, 13.0, 21.0] {
            let length = |region: &Region| {
                let ways = level(region, 0.0, distance).unwrap();
                (kinds(&ways), ways.iter().map(Way::length).sum::<f64>())
            };
            let (kinds, expected) = length(&original);
            for other in [map(&turned, 1.0), map(&mirrored, -1.0)] {
                let (found, sum) = length(&other);
                assert!(found == kinds && (sum - expected).abs() < 1e-6);
            }
        }
    }
}

/// The walls at both ends of an open side are led on for less than the gate is wide where a level is nearer to them than that.
#[test]
fn a_closed_level_nearer_to_walls_than_it_reaches_is_closed() {
    let mut edges = rectangle(10.0, 10.0, 110.0, 50.0);
    edges[1].side = Side::Open;
    let region = region(&[edges]);
    for (reach, distance) in [(5.0, 3.007), (7.0, 3.0), (7.0, 4.5), (8.0, 1.0)] {
        let ways = Offsets::of(&region, reach).closed_level(distance).unwrap();
        assert_eq!(ways.len(), 1, "{reach} {distance}");
        assert!(ways[0].is_closed());
        // As wide as the region is between its walls, as far as the reach beyond its open side, which ends round or square.
        let extent = ways[0].pieces.iter().map(|piece| Curve::of(*piece).extent());
        let extent = extent.reduce(Extent::with).unwrap();
        assert!(
            (extent.low.y - 10.0 - distance).abs() < 1e-6 && (60.0 - extent.high.y - distance).abs() < 1e-6
        );
        assert!((extent.high.x - 120.0 - reach).abs() < 1e-6, "{extent:?}");
    }
}

/// An island that stands in a corner of the outline, or on a place of a side.
#[test]
fn islands_in_corners() {
    let outline = || rectangle(10.0, 10.0, 120.0, 90.0);
    for island in [
        polygon(&[(10.0, 10.0), (40.0, 20.0), (20.0, 40.0)]),
        polygon(&[(130.0, 100.0), (100.0, 90.0), (110.0, 70.0)]),
        polygon(&[(10.0, 10.0), (40.0, 11.0), (11.0, 40.0)]),
    ] {
        for distance in [1.0, 5.0, 5.007, 10.007] {
            assert_level(&region(&[outline(), island.clone()]), distance);
        }
    }
}
