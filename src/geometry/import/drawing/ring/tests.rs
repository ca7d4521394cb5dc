//! Rings on a grid of integers, against all pairs of segments in whole numbers; and rings that are a little off.

use super::*;
use proptest::prelude::*;

type Corner = (i64, i64);

/// The sign of the area of a triangle, exact.
fn turn(a: Corner, b: Corner, c: Corner) -> i64 {
    ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).signum()
}

fn is_within(a: Corner, b: Corner, p: Corner) -> bool {
    (a.0.min(b.0)..=a.0.max(b.0)).contains(&p.0) && (a.1.min(b.1)..=a.1.max(b.1)).contains(&p.1)
}

/// Whether two segments have a point in common.
fn meet([a, b]: [Corner; 2], [c, d]: [Corner; 2]) -> bool {
    let (s, t, u, v) = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b));
    (s != t && u != v)
        || (s == 0 && is_within(a, b, c))
        || (t == 0 && is_within(a, b, d))
        || (u == 0 && is_within(c, d, a))
        || (v == 0 && is_within(c, d, b))
}

/// Whether they cross between their ends.
fn cross([a, b]: [Corner; 2], [c, d]: [Corner; 2]) -> bool {
    turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0
}

fn segments(ring: &[Corner]) -> Vec<[Corner; 2]> {
    (0..ring.len())
        .map(|i| [ring[i], ring[(i + 1) % ring.len()]])
        .collect()
}

/// All pairs that are not neighbours.
fn strangers(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |j| {
        (0..j)
            .filter(move |&i| i + 1 != j && (j + 1) % count != i)
            .map(move |i| (i, j))
    })
}

fn is_simple(ring: &[Corner]) -> bool {
    let all = segments(ring);
    let count = all.len();
    let folds = (0..count).any(|i| {
        let [a, b] = all[i];
        let [_, c] = all[(i + 1) % count];
        turn(a, b, c) == 0 && (b.0 - a.0) * (c.0 - b.0) + (b.1 - a.1) * (c.1 - b.1) < 0
    });
    !folds && strangers(count).all(|(i, j)| !meet(all[i], all[j]))
}

fn has_crossing(ring: &[Corner]) -> bool {
    let all = segments(ring);
    strangers(all.len()).any(|(i, j)| cross(all[i], all[j]))
}

fn signed_area(ring: &[Corner]) -> i64 {
    segments(ring).iter().map(|[a, b]| a.0 * b.1 - a.1 * b.0).sum()
}

fn points(ring: &[Corner]) -> Vec<Point2> {
    ring.iter()
        .map(|&(x, z)| Point2::new(x as f64, z as f64))
        .collect()
}

/// Small grids, so that corners often lie on segments.
fn ring() -> impl Strategy<Value = Vec<Corner>> {
    let corner = |size: i64| (0..size, 0..size);
    prop_oneof![
        prop::collection::vec(corner(4), 3..6),
        prop::collection::vec(corner(12), 3..9),
        prop::collection::vec(corner(1000), 3..14),
    ]
    .prop_map(|mut ring| {
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    })
    .prop_filter("at least a triangle", |ring| ring.len() > 2)
}

/// Rings that rarely cross: round about a middle, at any distance from it.
fn star() -> impl Strategy<Value = Vec<Corner>> {
    prop::collection::vec(1..300i64, 3..40).prop_map(|distances| {
        let step = core::f64::consts::TAU / distances.len() as f64;
        let corner = |(i, &distance): (usize, &i64)| {
            let (sin, cos) = libm::sincos(i as f64 * step);
            let along = |part: f64| (1000.0 * distance as f64 * part) as i64;
            (along(cos), along(sin))
        };
        distances.iter().enumerate().map(corner).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// What is simple is proven so, and turns as its area says; what crosses itself is refused, at a place where it does.
    #[test]
    fn rings_are_simple_if_no_two_segments_meet(ring in prop_oneof![ring(), star()]) {
        let found = prove_simple(&points(&ring), 0.0);
        if is_simple(&ring) {
            let expected = if signed_area(&ring) > 0 { Turn::Left } else { Turn::Right };
            prop_assert_eq!(found, Ok(expected));
        }
        if has_crossing(&ring) {
            prop_assert!(found.is_err(), "{:?}", found);
        }
        if let Err(RingError::Meets { at, segments: [one, other] }) = found {
            let all = segments(&ring);
            prop_assert!(!is_simple(&ring));
            prop_assert!(meet(all[one], all[other]));
            for [from, to] in [all[one], all[other]] {
                let ends = points(&[from, to]);
                let off = (ends[0].distance(at) + ends[1].distance(at) - ends[0].distance(ends[1])).abs();
                prop_assert!(off < 1e-6, "{:?} is {} off", at, off);
            }
        }
    }

    /// The search over all pairs alone, also of rings that the other way decides.
    #[test]
    fn the_search_finds_whether_segments_meet(ring in prop_oneof![ring(), star()]) {
        let found = meeting(&points(&ring), &|_| true).unwrap();
        prop_assert_eq!(found.is_none(), is_simple(&ring));
    }
}

fn proven(ring: &[(f64, f64)], accuracy: f64) -> Result<Turn, RingError> {
    let ring: Vec<Point2> = ring.iter().map(|&(x, z)| Point2::new(x, z)).collect();
    prove_simple(&ring, accuracy)
}

#[test]
fn bow_ties_are_refused_where_they_cross() {
    // With upright ends; without area; lying; with a foot that folds back.
    for ring in [
        &[(0.0, 5.0), (80.0, 30.0), (80.0, 5.0), (0.0, 20.0)][..],
        &[(0.0, 0.0), (80.0, 20.0), (80.0, 0.0), (0.0, 20.0)],
        &[(0.0, 0.0), (80.0, 0.0), (0.0, 20.0), (80.0, 20.0)],
        &[
            (0.0, 0.0),
            (80.0, 0.0),
            (70.0, -5.0),
            (90.0, -5.0),
            (80.0, 20.0),
            (10.0, -10.0),
        ],
    ] {
        let found = proven(ring, 2e-3);
        assert!(
            matches!(found, Err(RingError::Meets { .. })),
            "{ring:?}: {found:?}"
        );
    }
    let crossed = proven(&[(0.0, 0.0), (80.0, 20.0), (80.0, 0.0), (0.0, 20.0)], 2e-3);
    let Err(RingError::Meets { at, .. }) = crossed else {
        panic!("{crossed:?}");
    };
    assert!(at.distance(Point2::new(40.0, 10.0)) < 1e-9);
}

#[test]
fn antennas_and_rings_without_area_are_refused() {
    let antenna = [
        (0.0, 0.0),
        (50.0, 0.0),
        (50.0, 9.0),
        (50.0, 0.0),
        (100.0, 0.0),
        (100.0, 20.0),
        (0.0, 20.0),
    ];
    assert!(matches!(proven(&antenna, 2e-3), Err(RingError::Meets { .. })));
    assert_eq!(
        proven(&[(0.0, 0.0), (50.0, 1.0), (100.0, 0.0), (50.0, 1.0)], 2e-3),
        Err(RingError::NoArea)
    );
}

/// The sides of a cusp cross when they are flattened, by less than the accuracy of that.
#[test]
fn sides_may_overlap_by_what_flattening_does() {
    let cusp = |depth: f64| {
        [
            (0.0, 0.0),
            (99.0, -depth),
            (100.0, 0.0),
            (99.0, -2.0 * depth),
            (0.0, 20.0),
        ]
    };
    assert_eq!(proven(&cusp(1e-3), 2e-3), Ok(Turn::Left));
    assert!(matches!(proven(&cusp(3e-3), 2e-3), Err(RingError::Meets { .. })));
}

#[test]
fn upright_ends_may_lean_by_rounding() {
    for lean in [-1e-9, 1e-9] {
        let ring = [(0.0, 0.0), (80.0, 0.0), (80.0 + lean, 30.0), (lean, 30.0)];
        assert_eq!(proven(&ring, 2e-3), Ok(Turn::Left));
    }
}

/// A comb of teeth that lean, a hundred thousand corners that do not meet, and one that does.
#[test]
fn long_outlines_are_looked_through() {
    let teeth = 25_000;
    let mut comb: Vec<Point2> = (0..teeth)
        .flat_map(|tooth| {
            let x = f64::from(tooth);
            [
                Point2::new(x, 0.0),
                Point2::new(x - 0.5, 9.0),
                Point2::new(x - 0.25, 9.0),
                Point2::new(x + 0.5, 0.0),
            ]
        })
        .collect();
    comb.push(Point2::new(f64::from(teeth), -5.0));
    comb.push(Point2::new(-1.0, -5.0));
    assert_eq!(prove_simple(&comb, 2e-3), Ok(Turn::Right));
    comb[4_002].x += 1.0;
    assert!(matches!(prove_simple(&comb, 2e-3), Err(RingError::Meets { .. })));
}

/// Long teeth that lean lie in each other's boxes: not all of them are looked at.
#[test]
fn outlines_that_lie_beside_themselves_everywhere_end_the_search() {
    let teeth = 20_000;
    let mut comb: Vec<Point2> = (0..teeth)
        .flat_map(|tooth| {
            let x = f64::from(tooth) * 1e-2;
            [Point2::new(x, -x), Point2::new(x + 1e4, 1e4 - x)]
        })
        .collect();
    comb.push(Point2::new(1e5, -1e5));
    comb.push(Point2::new(-1.0, -1e5));
    assert_eq!(prove_simple(&comb, 2e-3), Err(RingError::Dense));
}
