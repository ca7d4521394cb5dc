//! The axis against distances by brute force and known circles.

use super::*;
use crate::wall::angle;
use proptest::prelude::*;
use vcutc_region::piece::Piece;
use vcutc_region::region::{Edge, Side};
use vcutc_region::testkit::{bulged, pocket};

/// Distance to the nearest place of a piece, from many places on it.
fn sampled_distance(piece: Piece, place: Place) -> f64 {
    let count = 2000;
    let at = |index: u32| piece.at(f64::from(index) / f64::from(count)).distance(place);
    (0..=count).map(at).fold(f64::INFINITY, f64::min)
}

/// The nearest place on the walls, from closed forms for lines and the samples for arcs.
fn foot(region: &Region, place: Place) -> (f64, Place) {
    let walls = region.edges().filter(|edge| edge.side == Side::Wall);
    let feet = walls.map(|edge| {
        let piece = edge.piece;
        let count = if piece.is_line() { 1 } else { 100 };
        let nearest = (0..count).map(|index| {
            let share = |index: u32| f64::from(index) / f64::from(count);
            let (from, to) = (piece.at(share(index)), piece.at(share(index + 1)));
            let way = to.minus(from);
            let t = (way.dot(place.minus(from)) / way.dot(way)).clamp(0.0, 1.0);
            (from.lerp(to, t).distance(place), from.lerp(to, t))
        });
        nearest.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap()
    });
    feet.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap()
}

fn distance_to(segment: &Segment, place: Place) -> f64 {
    let way = segment.to.minus(segment.from);
    let t = (way.dot(place.minus(segment.from)) / way.dot(way)).clamp(0.0, 1.0);
    segment.from.lerp(segment.to, t).distance(place)
}

#[test]
fn largest_circles() {
    for (number, radius) in [
        (2, 110.0 - 6000.0_f64.sqrt()),
        (3, 37.5),
        (4, 290.0 - 67620.0_f64.sqrt()),
        (5, 95.0 - 4950.0_f64.sqrt()),
    ] {
        let axis = axis(&pocket(number), Detail::True, 0.04).unwrap();
        let (_, found) = axis.largest_circle.unwrap();
        assert!((found - radius).abs() < 1e-6, "{number}: {found}");
    }
}

#[test]
fn pieces_are_as_far_from_the_walls_as_they_say() {
    for number in 1..=5 {
        let region = pocket(number);
        let axis = axis(&region, Detail::True, 0.04).unwrap();
        for segment in &axis.segments {
            for step in 0..=4 {
                let t = f64::from(step) / 4.0;
                let radius = segment.from_radius + (segment.to_radius - segment.from_radius) * t;
                let off = (foot(&region, segment.from.lerp(segment.to, t)).0 - radius).abs();
                // Chords of arcs are up to 3e-3 mm off them.
                let limit = if step % 4 == 0 { 4e-3 } else { 0.08 };
                assert!(off < limit, "{number}: {segment:?} at {t}: {off}");
            }
        }
    }
}

/// Wherever the nearest wall places of two neighbours are far apart, the axis passes between them.
#[test]
fn nothing_of_the_axis_is_missing() {
    for number in 1..=5 {
        let region = pocket(number);
        let axis = axis(&region, Detail::True, 0.04).unwrap();
        let mut count = 0;
        for column in 0..120 {
            for row in (0..90).step_by(2) {
                let place = Place::new(f64::from(column) + 0.51, f64::from(row) + 0.53);
                let next = place.plus(Place::new(1.0, 0.0));
                if !region.contains(place) || !region.contains(next) {
                    continue;
                }
                let (one, other) = (foot(&region, place), foot(&region, next));
                // Beside the centre of an arc feet run faster than places.
                let mut centres = region.edges().filter_map(|edge| edge.piece.centre());
                let is_by_centre = centres.any(|centre| centre.distance(place) < 4.0);
                if one.1.distance(other.1) < 6.0 || is_by_centre {
                    continue;
                }
                count += 1;
                let between = place.lerp(next, 0.5);
                let nearest = axis.segments.iter().map(|segment| distance_to(segment, between));
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                assert!(nearest < 0.75, "{number}: {between:?}: {nearest}");
            }
        }
        assert!(count > 25, "{number}: {count}");
    }
}

#[test]
fn the_simplified_axis_has_one_piece_or_two_between_nodes() {
    // Branches of pocket 1: 7 straight ones. Of 2: 7 with a curved one. Of 3: a curved one over the middle, where the circle
    // touches no third wall, and two to curved corners. Of 4: three curved ones. Of 5: a ring of four curved ones, and four ends.
    for (number, count) in [(1, 7), (2, 8), (3, 8), (4, 8), (5, 12)] {
        let axis = axis(&pocket(number), Detail::Simplified, 0.04).unwrap();
        assert_eq!(axis.segments.len(), count, "{number}");
    }
}

/// The axis of a circle is a point, so it has no pieces; the axis of a ring is closed.
#[test]
fn circles_and_rings() {
    let disc = bulged(&[(10.0, 0.0, 1.0), (-10.0, 0.0, 1.0)]);
    let hole = bulged(&[(4.0, 0.0, -1.0), (-4.0, 0.0, -1.0)]);
    let alone = Region::new(vec![disc.clone()]).unwrap();
    assert_eq!(axis(&alone, Detail::True, 0.04).unwrap().segments, []);
    let ring = Region::new(vec![disc, hole]).unwrap();
    for detail in [Detail::True, Detail::Simplified] {
        let axis = axis(&ring, detail, 0.01).unwrap();
        assert!(axis.segments.len() >= 4);
        for segment in &axis.segments {
            assert!((segment.from_radius - 3.0).abs() < 1e-9);
            assert!((segment.from.length() - 7.0).abs() < 1e-9);
        }
        let length: f64 = axis.segments.iter().map(Segment::length).sum();
        let circle = 14.0 * core::f64::consts::PI;
        assert!(
            detail == Detail::Simplified || (length / circle - 1.0).abs() < 2e-3,
            "{length}"
        );
    }
}

#[test]
fn bad_numbers_are_refused() {
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            axis(&pocket(1), Detail::True, tolerance),
            Err(AxisError::Tolerance)
        );
    }
    let most = AxisError::TooManyPieces { most: MOST_CIRCLES };
    let fine = axis(&pocket(4), Detail::True, 1e-14);
    assert!(fine.is_ok() || fine == Err(most) || fine == Err(AxisError::TooManyPieces { most: MOST_PIECES }));
}

/// A star about the origin, with corners at these distances.
fn star(distances: &[f64]) -> Region {
    let turn = core::f64::consts::TAU / distances.len() as f64;
    let corner = |(index, distance): (usize, &f64)| {
        let (sin, cos) = libm::sincos(turn * index as f64);
        Place::new(distance * cos, distance * sin)
    };
    let corners: Vec<Place> = distances.iter().enumerate().map(corner).collect();
    let next = corners.iter().cycle().skip(1);
    let edge = |(from, to): (&Place, &Place)| Edge {
        piece: Piece::line(*from, *to),
        side: Side::Wall,
    };
    Region::new(vec![corners.iter().zip(next).map(edge).collect()]).unwrap()
}

/// Numbers of connected parts, and of nodes less pieces, of a graph of segments.
fn shape(segments: &[Segment]) -> (usize, i64) {
    let mut nodes: Vec<Place> = Vec::new();
    let mut parts: Vec<usize> = Vec::new();
    let mut count = 0;
    for segment in segments {
        let ends = [segment.from, segment.to].map(|end| {
            let found = nodes.iter().position(|node| node.distance(end) < 1e-4);
            found.unwrap_or_else(|| {
                nodes.push(end);
                parts.push(parts.len());
                nodes.len() - 1
            })
        });
        // Walls that are nearly tangent have no branch between them that counts.
        count += i64::from(ends[0] != ends[1]);
        let (one, other) = (parts[ends[0]], parts[ends[1]]);
        parts
            .iter_mut()
            .filter(|part| **part == one)
            .for_each(|part| *part = other);
    }
    let difference = nodes.len() as i64 - count;
    parts.sort_unstable();
    parts.dedup();
    (parts.len(), difference)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The axis of a region without islands is a tree whose leaves are the corners, and its ends are as far from the walls as
    /// they say.
    #[test]
    fn axes_of_stars_are_trees(distances in prop::collection::vec(5.0..60.0f64, 3..9)) {
        let region = star(&distances);
        let axis = axis(&region, Detail::True, 0.1).unwrap();
        for segment in &axis.segments {
            let exact = region.edges().map(|edge| sampled_distance(edge.piece, segment.from));
            let exact = exact.fold(f64::INFINITY, f64::min);
            prop_assert!((exact - segment.from_radius).abs() < 0.05, "{segment:?} {exact}");
            let (exact, _) = foot(&region, segment.from);
            prop_assert!((exact - segment.from_radius).abs() < 1e-8, "{segment:?} {exact}");
        }
        let (parts, difference) = shape(&axis.segments);
        prop_assert_eq!(parts, 1);
        prop_assert_eq!(difference, 1);
    }

    /// With an island its axis has one ring more than a tree.
    #[test]
    fn axes_about_an_island_are_rings(
        distances in prop::collection::vec(8.0..60.0f64, 5..9),
        radius in 0.5..2.0f64,
        bulge in -1.0..-0.3f64,
    ) {
        let outline = star(&distances).loops().to_vec();
        let island = bulged(&[(radius, 0.0, bulge), (0.0, -radius, 0.0), (-radius, 0.0, bulge)]);
        // Walls that are nearly tangent roll on each other: the axis has no branch, or a part of one, between them.
        let [first, .., last] = island.as_slice() else { unreachable!() };
        let turned = angle(last.piece.direction(1.0), first.piece.direction(0.0));
        prop_assume!(turned.abs() > 1e-3);
        let region = Region::new(outline.into_iter().chain([island]).collect()).unwrap();
        let axis = axis(&region, Detail::True, 0.1).unwrap();
        for segment in &axis.segments {
            let (exact, _) = foot(&region, segment.from);
            prop_assert!((exact - segment.from_radius).abs() < 1e-3, "{segment:?} {exact}");
        }
        let (parts, difference) = shape(&axis.segments);
        prop_assert_eq!(parts, 1);
        prop_assert_eq!(difference, 0);
    }
}
