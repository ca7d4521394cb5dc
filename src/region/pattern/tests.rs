//! Lengths, corners and cover of passes.

use super::*;
use crate::curve::Curve;
use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Inside, Side};
use crate::testkit::{any_region, pocket, polygon, region, uncut};
use core::f64::consts::{FRAC_PI_2, PI};
use proptest::prelude::*;

const TOOL: Tool = Tool {
    radius: 5.0,
    standoff: 0.0,
    run_out: 0.0,
};

/// How far from its corner an arc with a radius keeps, for a corner of this half angle, in rad.
fn moved_in(radius: f64, half_angle: f64) -> f64 {
    radius * (1.0 / libm::sin(half_angle) - 1.0)
}

/// The places where a pass has a corner to the left that turns by more than an angle, in rad.
fn inward_corners(pass: &Pass, least: f64) -> Vec<Place> {
    let joints = pass.pieces.iter().zip(pass.pieces.iter().skip(1));
    let closing = pass.pieces.last().zip(pass.pieces.first());
    let joints = joints.chain(closing.filter(|_| pass.is_closed()));
    let turn = |one: &Piece, next: &Piece| {
        let (arrival, ahead) = (one.direction(1.0), next.direction(0.0));
        libm::atan2(arrival.cross(ahead), arrival.dot(ahead))
    };
    joints
        .filter(|(one, next)| turn(one, next) > least)
        .map(|(one, _)| one.to)
        .collect()
}

fn length(passes: &[Pass]) -> f64 {
    passes.iter().map(Pass::length).sum()
}

/// What a pattern leaves uncut of a region: its area, and how far the farthest place is from all passes.
fn left(region: &Region, tool: &Tool, pattern: Pattern, finest: f64) -> (f64, f64) {
    let pieces: Vec<_> = passes(region, tool, pattern)
        .unwrap()
        .into_iter()
        .flat_map(|pass| pass.pieces)
        .collect();
    uncut(region, tool.radius, &pieces, tool.radius, finest)
}

/// Length of all passes of five test pockets, in mm, for a step of 4 mm: offsets, smooth passes and rows by either angle.
///
/// The offsets are those of GEOS, 9396.7 in sum, with the middle of the arm of pocket 2, which is 35 mm long. Smooth passes are
/// longer than parabolas of the same vertex radius (9099.6 in sum), which move in half as far again. Published rows
/// of 11402.5 in sum hold two rows more a pocket, which lie on the pass next to the walls.
const LENGTHS: [[f64; 4]; 5] = [
    [2119.30, 2112.21, 2326.58, 2372.31],
    [1805.86, 1749.07, 1999.96, 2079.17],
    [1729.37, 1654.94, 1960.84, 1975.89],
    [1591.82, 1512.39, 1898.59, 1848.81],
    [2185.45, 2148.87, 2398.51, 2492.84],
];

#[test]
fn lengths_of_five_pockets() {
    for (number, expected) in (1..).zip(LENGTHS) {
        let region = pocket(number);
        let patterns = [
            Pattern::Offset { step: 4.0 },
            Pattern::Smooth {
                step: 4.0,
                corner: 5.0,
            },
            Pattern::Zigzag {
                step: 4.0,
                angle: 0.0,
            },
            Pattern::Zigzag {
                step: 4.0,
                angle: FRAC_PI_2,
            },
        ];
        for (pattern, expected) in patterns.into_iter().zip(expected) {
            let found = length(&passes(&region, &TOOL, pattern).unwrap());
            assert!(
                (found - expected).abs() < 0.01,
                "pocket {number}, {pattern:?}: {found} {expected}"
            );
        }
    }
}

/// The radii that leave nothing in corners, for a tool of 5 mm: half angle in degrees, step, radius.
const COVERS: [(f64, f64, f64); 8] = [
    (15.0, 4.0, 3.0952),
    (21.8, 4.0, 4.5445),
    (30.0, 4.0, 7.0),
    (45.0, 4.0, 15.4853),
    (60.0, 4.0, 39.7846),
    (30.0, 5.0, 5.0),
    (45.0, 5.0, 12.0711),
    (45.0, 6.0, 8.6569),
];

#[test]
fn how_round_corners_may_be() {
    for (half, step, expected) in COVERS {
        let found = cover(5.0, step, half.to_radians());
        assert!((found - expected).abs() < 2e-4, "{half} {step} {found}");
    }
    for (half, expected) in [(30.0_f64, 5.0), (45.0, 2.0711), (60.0, 0.7735)] {
        assert!((moved_in(5.0, half.to_radians()) - expected).abs() < 1e-4);
    }
}

/// Between which passes.
#[derive(Clone, Copy, PartialEq)]
enum Gap {
    /// The pass next to the walls and the next one.
    First,
    /// Two later ones.
    Later,
}

/// The largest distance from both of two passes of places between them, in a corner of 400 mm legs: the pass next to the walls and
/// the next, or both of them rounded.
fn farthest_in_corner(half: f64, step: f64, share: f64, gap: Gap) -> f64 {
    let (sin, cos) = libm::sincos(half.to_radians());
    let corner = polygon(&[
        (0.0, 0.0),
        (400.0 * cos, -400.0 * sin),
        (400.0 * cos, 400.0 * sin),
    ]);
    let region = region(&[corner]);
    let mut offsets = Offsets::of(&region, 0.0);
    // A rule that lets through so much more than the right one.
    let wanted = cover(5.0, step, half.to_radians()) * share;
    let rule = smooth::Rule {
        radius: 5.0,
        step: 5.0 * (1.0 + sin) - wanted * (1.0 - sin),
        most: f64::INFINITY,
    };
    let mut pass = |level: f64| {
        let distance = 5.0 + level * step;
        let way = offsets.level(distance).unwrap().remove(0);
        // As if the pass before had the same corners.
        let before = smooth::Before::of([], [&way]);
        let pieces = if level > 0.0 {
            smooth::smoothed(&way, distance, rule, &before, offsets.walls())
        } else {
            way.pieces
        };
        Walls::of_pieces(pieces.into_iter().enumerate())
    };
    let passes = if gap == Gap::First {
        [pass(0.0), pass(1.0)]
    } else {
        [pass(1.0), pass(2.0)]
    };
    // Near the corner, along the middle: from the vertex of one pass to that of the other.
    let distance = |x: f64| {
        let place = Place::new(x, 0.0);
        passes
            .iter()
            .map(|pass| pass.distance(place))
            .fold(f64::INFINITY, f64::min)
    };
    let moved = wanted * (1.0 / sin - 1.0);
    let (begin, end) = if gap == Gap::First {
        (5.0 / sin, (5.0 + step) / sin + moved)
    } else {
        ((5.0 + step) / sin + moved, (5.0 + 2.0 * step) / sin + moved)
    };
    (0..=20_000)
        .map(|i| distance(begin + (end - begin) * f64::from(i) / 20_000.0))
        .fold(0.0, f64::max)
}

#[test]
fn corners_are_as_round_as_they_may_be() {
    for (half, step, _) in COVERS {
        let first = farthest_in_corner(half, step, 1.0, Gap::First);
        assert!((first - 5.0).abs() < 2e-3, "{half} {step} {first}");
        let later = farthest_in_corner(half, step, 1.0, Gap::Later);
        assert!(later < 5.002, "{half} {step} {later}");
        assert!(
            farthest_in_corner(half, step, 1.02, Gap::First) > 5.0,
            "{half} {step}"
        );
    }
    assert!((farthest_in_corner(45.0, 4.0, 1.1, Gap::First) - 5.264).abs() < 2e-3);
    assert!((farthest_in_corner(30.0, 5.0, 1.1, Gap::First) - 5.165).abs() < 2e-3);
}

#[test]
fn what_offsets_leave() {
    for (number, step, expected) in [
        (2, 4.0, 0.0),
        (4, 5.0, 0.0),
        (4, 6.0, 13.0),
        (5, 6.0, 30.1),
        (2, 8.0, 7.3),
        (3, 8.0, 49.9),
        (4, 8.0, 148.7),
        (5, 8.0, 34.0),
    ] {
        let (area, _) = left(&pocket(number), &TOOL, Pattern::Offset { step }, 0.01);
        // The area is counted in boxes of 0.01 mm along its rim.
        assert!(
            (area - expected).abs() < 0.15,
            "pocket {number}, {step}: {area} {expected}"
        );
    }
}

#[test]
fn what_no_tool_reaches() {
    // Five corners of 90 degrees: r^2 (1 - pi / 4) each.
    let corners = |radius: f64| 5.0 * radius * radius * (1.0 - PI / 4.0);
    for (radius, expected) in [(5.0, 26.825), (12.5, 167.66)] {
        assert!((corners(radius) - expected).abs() < 5e-3);
        let tool = Tool { radius, ..TOOL };
        let pieces: Vec<_> = passes(&pocket(2), &tool, Pattern::Offset { step: radius }).unwrap();
        let pieces: Vec<_> = pieces.into_iter().flat_map(|pass| pass.pieces).collect();
        let (area, _) = uncut(&pocket(2), 0.0, &pieces, radius, 0.01);
        assert!((area - expected).abs() < 0.1, "{radius}: {area} {expected}");
    }
}

#[test]
fn smooth_passes_and_rows_leave_next_to_nothing() {
    for number in 1..=5 {
        for step in [4.0, 5.0] {
            let (area, farthest) = left(
                &pocket(number),
                &TOOL,
                Pattern::Smooth { step, corner: 5.0 },
                0.02,
            );
            assert!(area == 0.0, "pocket {number}, {step}: {area} {farthest}");
        }
        for angle in [0.0, 0.4, FRAC_PI_2, 2.0] {
            for step in [4.0, 9.9] {
                let (area, farthest) = left(&pocket(number), &TOOL, Pattern::Zigzag { step, angle }, 0.01);
                assert!(area < 1e-2, "pocket {number}, {angle}: {area} {farthest}");
            }
        }
    }
}

#[test]
fn inward_corners_are_sharp_next_to_the_walls_only() {
    let passes = passes(
        &pocket(2),
        &TOOL,
        Pattern::Smooth {
            step: 4.0,
            corner: 5.0,
        },
    )
    .unwrap();
    let corners = |level: u32| {
        let passes = passes.iter().filter(move |pass| pass.level == level);
        passes.flat_map(|pass| inward_corners(pass, 1e-3)).count()
    };
    assert_eq!(corners(0), 5);
    assert!((1..=4).all(|level| corners(level) == 0));
    for pass in &passes {
        for pair in pass.pieces.windows(2) {
            assert_eq!(pair[0].to, pair[1].from);
        }
    }
}

#[test]
fn invalid_parameters() {
    let region = pocket(2);
    for pattern in [
        Pattern::Offset { step: 0.0 },
        Pattern::Offset { step: f64::NAN },
        Pattern::Smooth {
            step: 4.0,
            corner: -1.0,
        },
        Pattern::Zigzag {
            step: 4.0,
            angle: f64::INFINITY,
        },
    ] {
        assert_eq!(passes(&region, &TOOL, pattern), Err(PatternFault::Parameter));
    }
    let wide = Tool { radius: 40.0, ..TOOL };
    for pattern in [
        Pattern::Offset { step: 4.0 },
        Pattern::Zigzag {
            step: 4.0,
            angle: 0.0,
        },
    ] {
        assert_eq!(passes(&region, &wide, pattern), Err(PatternFault::TooWide));
        // A step larger than the pocket.
    }
    assert_eq!(
        passes(&region, &TOOL, Pattern::Offset { step: 1e3 })
            .unwrap()
            .len(),
        1
    );
    assert_eq!(
        passes(
            &region,
            &TOOL,
            Pattern::Zigzag {
                step: 1e3,
                angle: 0.0
            }
        )
        .unwrap()
        .len(),
        1
    );
    assert_eq!(
        passes(
            &region,
            &TOOL,
            Pattern::Zigzag {
                step: 1e-6,
                angle: 0.0
            }
        ),
        Err(PatternFault::TooMany)
    );
    assert_eq!(
        passes(&region, &TOOL, Pattern::Offset { step: 1e-6 }),
        Err(PatternFault::TooMany)
    );
}

#[test]
fn a_region_with_open_sides_only_is_faced() {
    let mut edges = polygon(&[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]);
    for edge in &mut edges {
        edge.side = Side::Open;
    }
    let region = region(&[edges]);
    let offset = passes(&region, &TOOL, Pattern::Offset { step: 4.0 });
    assert_eq!(offset, Err(PatternFault::Offset(OffsetFault::NoWalls)));
    let rows = passes(
        &region,
        &TOOL,
        Pattern::Zigzag {
            step: 4.0,
            angle: 0.3,
        },
    )
    .unwrap();
    assert!(rows.len() == 1 && rows[0].level == 1);
    let (area, _) = left(
        &region,
        &TOOL,
        Pattern::Zigzag {
            step: 4.0,
            angle: 0.3,
        },
        0.02,
    );
    assert_eq!(area, 0.0);
}

/// Random polygons, some of their sides open.
fn any_polygon() -> impl Strategy<Value = Region> {
    let corners = prop::collection::vec((20.0..60.0f64, any::<bool>()), 3..9);
    (corners, any::<bool>()).prop_filter_map("no region", |(corners, has_open)| {
        let count = corners.len() as f64;
        let places: Vec<_> = (0..corners.len())
            .map(|i| (libm::sincos(i as f64 / count * 2.0 * PI), corners[i].0))
            .map(|((sin, cos), radius)| (radius * cos, radius * sin))
            .collect();
        let mut edges = polygon(&places);
        if has_open {
            for (edge, corner) in edges.iter_mut().zip(&corners).skip(1) {
                edge.side = if corner.1 { Side::Open } else { Side::Wall };
            }
        }
        Region::new(vec![edges]).ok()
    })
}

/// What the tool reaches lies within its radius of a pass, unless the tool is too wide for the region.
fn leaves_nothing(region: &Region, tool: &Tool, pattern: Pattern) -> Result<(), TestCaseError> {
    match passes(region, tool, pattern) {
        Ok(_) => {
            let (area, farthest) = left(region, tool, pattern, 0.04);
            prop_assert!(farthest < tool.radius + 1e-5, "{area} {farthest} {pattern:?}");
        }
        fault => prop_assert_eq!(fault, Err(PatternFault::TooWide)),
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn steps_up_to_the_radius_leave_nothing(region in any_region(), share in 0.5..0.95f64, angle in 0.0..3.0f64) {
        for pattern in [Pattern::Offset { step: 3.0 * share }, Pattern::Smooth { step: 3.0 * share, corner: 2.0 * angle }, Pattern::Zigzag { step: 6.0 * share, angle }] {
            let tool = Tool { radius: 3.0, ..TOOL };
            leaves_nothing(&region, &tool, pattern)?;
        }
    }

    #[test]
    fn polygons_with_open_sides_are_cleared(region in any_polygon(), share in 0.3..0.95f64) {
        let tool = Tool { radius: 3.0, ..TOOL };
        for pattern in [Pattern::Offset { step: 3.0 * share }, Pattern::Smooth { step: 3.0 * share, corner: 4.0 }] {
            leaves_nothing(&region, &tool, pattern)?;
        }
    }

    #[test]
    fn no_pass_comes_nearer_to_walls_than_the_tool(region in any_region(), share in 0.3..1.9f64, corner in 0.0..9.0f64) {
        let tool = Tool { radius: 3.0, standoff: 0.25, ..TOOL };
        let walls = Walls::of(&region);
        let inside = Inside::of(&region);
        for pattern in [Pattern::Smooth { step: 3.0 * share, corner }, Pattern::Zigzag { step: 3.0 * share, angle: corner }] {
            for pass in passes(&region, &tool, pattern).unwrap_or_default() {
                for &piece in &pass.pieces {
                    let (_, nearest) = walls.nearest_to(piece).unwrap();
                    prop_assert!(nearest.distance > 3.25 - 1e-6, "{nearest:?} {piece:?} {pattern:?}");
                    prop_assert!(inside.contains(Curve::of(piece).middle));
                }
            }
        }
    }
}
