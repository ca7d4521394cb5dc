//! Regions: what is one, and what lies in it.

use super::*;
use core::f64::consts::{FRAC_PI_2, PI};
use proptest::prelude::*;

fn polygon(corners: &[(f64, f64)]) -> Loop {
    let places: Vec<Place> = corners.iter().map(|&(x, y)| Place::new(x, y)).collect();
    let next = places.iter().cycle().skip(1);
    places
        .iter()
        .zip(next)
        .map(|(&from, &to)| Edge {
            piece: Piece::line(from, to),
            side: Side::Wall,
        })
        .collect()
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Loop {
    polygon(&[(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
}

fn circle(x: f64, y: f64, radius: f64) -> Loop {
    let (right, left) = (Place::new(x + radius, y), Place::new(x - radius, y));
    [Piece::arc(right, left, PI), Piece::arc(left, right, PI)]
        .map(|piece| Edge {
            piece,
            side: Side::Wall,
        })
        .to_vec()
}

fn backwards(mut edges: Loop) -> Loop {
    edges.reverse();
    for edge in &mut edges {
        edge.piece = edge.piece.reversed();
    }
    edges
}

#[test]
fn loops_nest_by_even_odd_whatever_their_orientation() {
    for turned in 0..8 {
        let loops = [
            rectangle(0.0, 0.0, 100.0, 80.0),
            circle(50.0, 40.0, 30.0),
            circle(50.0, 40.0, 10.0),
        ];
        let loops = loops.into_iter().enumerate();
        let loops = loops.map(|(i, edges)| {
            if turned >> i & 1 == 1 {
                backwards(edges)
            } else {
                edges
            }
        });
        let region = Region::new(loops.collect()).unwrap();
        let expected = 8000.0 - PI * 900.0 + PI * 100.0;
        assert!((region.area() - expected).abs() < 1e-9);
        assert!(region.contains(Place::new(5.0, 5.0)) && region.contains(Place::new(50.0, 41.0)));
        assert!(!region.contains(Place::new(50.0, 55.0)) && !region.contains(Place::new(-1.0, 40.0)));
        let bounds = region.bounds();
        assert_eq!(
            (bounds.low, bounds.high),
            (Place::new(0.0, 0.0), Place::new(100.0, 80.0))
        );
    }
}

/// Halves of a circle whose chord is level meet there; one of them holds the places on it.
#[test]
fn places_at_the_height_of_a_centre_lie_in_their_circle() {
    for edges in [circle(20.0, 20.0, 5.0), backwards(circle(20.0, 20.0, 5.0))] {
        let region = Region::new(vec![edges]).unwrap();
        let inside = Inside::of(&region);
        for (x, is_within) in [
            (10.0, false),
            (16.0, true),
            (20.0, true),
            (24.0, true),
            (26.0, false),
        ] {
            let place = Place::new(x, 20.0);
            assert_eq!(region.contains(place), is_within, "{x}");
            assert_eq!(inside.contains(place), is_within, "{x}");
        }
    }
    // The middle of a side of the triangle is that high.
    let triangle = polygon(&[(18.0, 18.0), (22.0, 18.0), (20.0, 22.0)]);
    let region = Region::new(vec![circle(20.0, 20.0, 5.0), triangle]).unwrap();
    assert!((region.area() - (25.0 * PI - 8.0)).abs() < 1e-9);
}

#[test]
fn doubled_loops_count_once() {
    let mut rotated = backwards(rectangle(0.0, 0.0, 10.0, 10.0));
    rotated.rotate_left(3);
    let region = Region::new(vec![rectangle(0.0, 0.0, 10.0, 10.0), rotated]).unwrap();
    assert_eq!(region.loops().len(), 1);
    assert_eq!(region.area(), 100.0);
}

#[test]
fn ends_are_joined_within_a_little_only() {
    let mut edges = rectangle(0.0, 0.0, 10.0, 10.0);
    edges[0].piece.to.x += 5e-7;
    let region = Region::new(vec![edges.clone()]).unwrap();
    let pieces: Vec<_> = region.edges().map(|edge| edge.piece).collect();
    assert!(pieces.windows(2).all(|pair| pair[0].to == pair[1].from));
    edges[0].piece.to.x += 0.36;
    let fault = Region::new(vec![edges]).unwrap_err();
    let edge = EdgeName { ring: 0, edge: 0 };
    assert!(matches!(fault, RegionFault::Open { edge: found, .. } if found == edge));
    // Edges without length go.
    let mut edges = rectangle(0.0, 0.0, 10.0, 10.0);
    let corner = edges[1].piece.from;
    edges.insert(
        1,
        Edge {
            piece: Piece::line(corner, corner),
            side: Side::Wall,
        },
    );
    assert_eq!(Region::new(vec![edges]).unwrap().edges().count(), 4);
}

#[test]
fn crossings_and_overlaps_are_named() {
    let outline = rectangle(0.0, 0.0, 100.0, 80.0);
    let fault = Region::new(vec![outline.clone(), circle(95.0, 40.0, 10.0)]).unwrap_err();
    let RegionFault::Crosses { one, other, at } = fault else {
        panic!("{fault:?}")
    };
    assert_eq!((one, other.ring), (EdgeName { ring: 0, edge: 1 }, 1));
    assert!((at.x - 100.0).abs() < 1e-9 && ((at.y - 40.0).abs() - 75.0_f64.sqrt()).abs() < 1e-9);
    let fault = Region::new(vec![polygon(&[
        (0.0, 0.0),
        (10.0, 10.0),
        (10.0, 0.0),
        (0.0, 10.0),
    ])])
    .unwrap_err();
    assert!(matches!(fault, RegionFault::Crosses { at, .. } if at.distance(Place::new(5.0, 5.0)) < 1e-9));
    let beside = rectangle(100.0, 20.0, 50.0, 20.0);
    let fault = Region::new(vec![outline.clone(), beside]).unwrap_err();
    assert!(matches!(fault, RegionFault::Overlaps { .. }), "{fault:?}");
    // Through a corner.
    let through = polygon(&[(-10.0, -10.0), (20.0, 10.0), (10.0, 20.0)]);
    let fault = Region::new(vec![outline.clone(), through]).unwrap_err();
    assert!(matches!(fault, RegionFault::Crosses { .. }), "{fault:?}");
    // Two islands that lap, and one in another.
    let (one, other) = (circle(30.0, 40.0, 10.0), circle(45.0, 40.0, 10.0));
    assert!(Region::new(vec![outline.clone(), one.clone(), other]).is_err());
    let region = Region::new(vec![outline, one, circle(30.0, 40.0, 5.0)]).unwrap();
    assert!((region.area() - 8000.0 + 75.0 * PI).abs() < 1e-9);
    // A joint of two arcs that cross again.
    let arcs = vec![
        Edge {
            piece: Piece::arc(Place::new(0.0, 0.0), Place::new(10.0, 0.0), PI),
            side: Side::Wall,
        },
        Edge {
            piece: Piece::arc(Place::new(10.0, 0.0), Place::new(4.0, -4.0), -3.0),
            side: Side::Wall,
        },
        Edge {
            piece: Piece::line(Place::new(4.0, -4.0), Place::new(0.0, 0.0)),
            side: Side::Wall,
        },
    ];
    assert!(matches!(
        Region::new(vec![arcs]),
        Err(RegionFault::Crosses { .. })
    ));
}

/// Circles cross or do not, however their radii compare: by the distance of their centres.
#[test]
fn circles_cross_where_their_centres_are_near() {
    for radius in [5.0, 10.0, 20.0] {
        for apart in [1.0, 6.0, 10.0, 14.9, 15.1, 19.0, 29.9, 30.1, 40.0] {
            let loops = vec![circle(0.0, 0.0, 10.0), circle(apart, 0.0, radius)];
            let crosses = (radius - 10.0_f64).abs() < apart && apart < radius + 10.0;
            let found = matches!(Region::new(loops), Err(RegionFault::Crosses { .. }));
            assert_eq!(found, crosses, "radius {radius}, {apart} apart");
        }
    }
}

#[test]
fn touching_in_a_place_is_not_a_crossing() {
    let outline = rectangle(0.0, 0.0, 100.0, 80.0);
    // Corner on a side, circle on a side, two circles, corner on corner.
    let corner = polygon(&[(50.0, 0.0), (60.0, 10.0), (40.0, 10.0)]);
    let touching = [
        vec![outline.clone(), corner],
        vec![outline.clone(), circle(90.0, 40.0, 10.0)],
        vec![
            outline.clone(),
            circle(30.0, 40.0, 10.0),
            circle(50.0, 40.0, 10.0),
        ],
        vec![
            outline.clone(),
            circle(30.0, 40.0, 10.0),
            circle(30.0, 60.0, 10.0),
        ],
        vec![
            outline.clone(),
            polygon(&[(0.0, 0.0), (20.0, 10.0), (10.0, 20.0)]),
        ],
        vec![rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 10.0, 10.0)],
        // A loop that touches itself.
        vec![polygon(&[
            (0.0, 0.0),
            (10.0, 5.0),
            (20.0, 0.0),
            (20.0, 10.0),
            (10.0, 5.0),
            (0.0, 10.0),
        ])],
    ];
    for loops in touching {
        let areas: f64 = loops
            .iter()
            .flatten()
            .map(|edge| edge.piece.twice_area() / 2.0)
            .sum();
        let region = Region::new(loops.clone());
        assert!(region.is_ok(), "{region:?} {loops:?} {areas}");
    }
}

#[test]
fn what_is_not_a_loop_is_refused() {
    assert_eq!(Region::new(vec![]), Err(RegionFault::Empty));
    let there_and_back = polygon(&[(0.0, 0.0), (10.0, 0.0)]);
    assert!(Region::new(vec![there_and_back]).is_err());
    let mut edges = rectangle(0.0, 0.0, 10.0, 10.0);
    edges[2].piece.to.x = f64::NAN;
    assert!(Region::new(vec![edges]).is_err());
    let mut edges = rectangle(0.0, 0.0, 10.0, 10.0);
    edges[2].piece.sweep = 6.3;
    let name = EdgeName { ring: 0, edge: 2 };
    assert_eq!(Region::new(vec![edges]), Err(RegionFault::Unsound(name)));
    let many = vec![rectangle(0.0, 0.0, 10.0, 10.0); 50_001];
    let (edges, most) = (200_004, 200_000);
    assert_eq!(Region::new(many), Err(RegionFault::TooMany { edges, most }));
    let star: Vec<_> = (0..20_000)
        .map(|i| (f64::from(i % 2) * 100.0, f64::from(i) * 1e-9))
        .collect();
    assert!(Region::new(vec![polygon(&star)]).is_err());
}

#[test]
fn an_outline_of_many_segments() {
    let corners: Vec<_> = (0..100_000)
        .map(|i| libm::sincos(f64::from(i) * core::f64::consts::TAU / 1e5))
        .map(|(sin, cos)| (100.0 * cos, 100.0 * sin))
        .collect();
    let region = Region::new(vec![polygon(&corners)]).unwrap();
    assert!((region.area() - PI * 1e4).abs() < 1e-3);
    assert!(Inside::of(&region).contains(Place::new(99.9, 0.0)));
}

#[test]
fn very_small_and_very_large_arcs() {
    // A rectangle with corners of 1e-3 mm and a side of 1e5 mm.
    let radius = 1e-3;
    let line = |a: (f64, f64), b: (f64, f64)| Piece::line(Place::new(a.0, a.1), Place::new(b.0, b.1));
    let arc =
        |a: (f64, f64), b: (f64, f64), sweep| Piece::arc(Place::new(a.0, a.1), Place::new(b.0, b.1), sweep);
    let edges = [
        line((radius, 0.0), (50.0, 0.0)),
        line((50.0, 0.0), (50.0, 40.0)),
        arc((50.0, 40.0), (radius, 40.0), 50.0 / 1e5),
        arc((radius, 40.0), (0.0, 40.0 - radius), FRAC_PI_2),
        line((0.0, 40.0 - radius), (0.0, radius)),
        arc((0.0, radius), (radius, 0.0), FRAC_PI_2),
    ];
    let edges = edges.map(|piece| Edge {
        piece,
        side: Side::Wall,
    });
    let region = Region::new(vec![edges.to_vec()]).unwrap();
    assert!(region.area() > 2000.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// The turning of the boundary about a place, sampled.
    #[test]
    fn what_lies_inside(
        radii in prop::collection::vec(5.0..40.0f64, 3..12),
        sweeps in prop::collection::vec(-0.6..0.6f64, 12),
        (x, y) in (-40.0..40.0f64, -40.0..40.0f64),
    ) {
        let count = radii.len() as f64;
        let corner = |i: usize| {
            let (sin, cos) = libm::sincos(i as f64 / count * core::f64::consts::TAU);
            let radius = radii[i % radii.len()];
            Place::new(radius * cos, radius * sin)
        };
        let edges: Loop = (0..radii.len()).map(|i| Edge {
            piece: Piece::arc(corner(i), corner((i + 1) % radii.len()), sweeps[i]),
            side: Side::Wall,
        }).collect();
        let Ok(region) = Region::new(vec![edges]) else { return Ok(()) };
        let place = Place::new(x, y);
        let distance = region.edges().map(|edge| Curve::of(edge.piece).distance(place));
        prop_assume!(distance.fold(f64::INFINITY, f64::min) > 0.05);
        let mut turned = 0.0;
        for edge in region.edges() {
            for i in 0..200 {
                let a = edge.piece.at(f64::from(i) / 200.0).minus(place);
                let b = edge.piece.at(f64::from(i + 1) / 200.0).minus(place);
                turned += libm::atan2(a.cross(b), a.dot(b));
            }
        }
        prop_assert_eq!(region.contains(place), turned > PI);
        prop_assert_eq!(Inside::of(&region).contains(place), turned > PI);
    }
}
