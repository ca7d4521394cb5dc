//! Passes of fields: whether they keep from walls, leave nothing, run out and go on smoothly.

use super::*;
use crate::wall::angle;
use proptest::prelude::*;
use vcutc_region::clearance::clearance;
use vcutc_region::curve::Curve;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::Side;
use vcutc_region::testkit::{any_region, bulged, pocket};

mod comparison;
mod figures;

const TOOL: Tool = Tool {
    radius: 5.0,
    standoff: 0.002,
    run_out: 1.0,
};

const fn wanted(step: f64, lift: f64, detail: Detail) -> Wanted {
    Wanted {
        step,
        lift,
        detail,
        uncut: 0.01,
    }
}

/// Steps, lifts and axes: as smooth as half a step makes, with cusps, and along the axis of the paper.
const FIELDS: [Wanted; 5] = [
    wanted(4.0, 2.0, Detail::True),
    wanted(4.0, 0.2, Detail::True),
    wanted(5.0, 2.5, Detail::True),
    wanted(5.0, 0.2, Detail::True),
    wanted(4.0, 0.2, Detail::Simplified),
];

/// The largest distance from all passes of places that the centre may take, on a grid of 1 mm.
fn farthest(region: &Region, passes: &[Pass]) -> f64 {
    let walls = Walls::of(region);
    let ways = Walls::of_pieces(
        passes
            .iter()
            .flat_map(|pass| pass.pieces.iter().copied())
            .enumerate(),
    );
    let places =
        (0..120).flat_map(|x| (0..90).map(move |y| Place::new(f64::from(x) + 0.31, f64::from(y) + 0.47)));
    let places =
        places.filter(|&place| region.contains(place) && walls.distance(place) >= TOOL.wall_distance());
    places.map(|place| ways.distance(place)).fold(0.0, f64::max)
}

/// The largest turn of a joint, in rad, with that where a closed pass begins.
fn largest_bend(pieces: &[Piece]) -> f64 {
    let closing = pieces.last().zip(pieces.first());
    let closing = closing.filter(|(last, first)| last.to == first.from);
    let joints = pieces.iter().zip(pieces.iter().skip(1)).chain(closing);
    let bends = joints.map(|(one, next)| angle(one.direction(1.0), next.direction(0.0)).abs());
    bends.fold(0.0, f64::max)
}

#[test]
fn passes_keep_from_walls_and_leave_nothing() {
    for wanted in FIELDS {
        for number in 1..=5 {
            let region = pocket(number);
            let found = passes(&region, &TOOL, &wanted).unwrap();
            let all = found.all();
            let clear = clearance(&region, &all);
            let least = clear.least.unwrap().distance;
            assert!(
                least >= TOOL.wall_distance() - 1e-9,
                "{number} {wanted:?}: {clear:?}"
            );
            assert!(clear.astray.is_empty(), "{number} {wanted:?}");
            assert!(found.left.uncut <= wanted.uncut, "{number}: {}", found.left.uncut);
            let far = farthest(&region, &all);
            assert!(far <= TOOL.radius, "{number} {wanted:?}: {far}");
            assert!(found.extra.is_empty() || found.cleared > 0.0);
            // Without the extra passes something stays, if there are any: more than what is asked for.
            let lines = found.passes.iter().filter(|pass| pass.level > 0);
            assert!(lines.clone().count() <= found.lines + found.broken, "{number}");
            for pass in lines {
                assert!(pass.pieces.windows(2).all(|pair| pair[0].to == pair[1].from));
                let bend = largest_bend(&pass.pieces);
                assert!(bend < 0.1_f64.to_radians(), "{number} {wanted:?}: {bend}");
            }
        }
    }
}

/// The wall pass is the true offset; of the lines of a field on the simplified axis some end within the pocket.
#[test]
fn what_is_reported_of_lines() {
    let found = passes(&pocket(5), &TOOL, &FIELDS[4]).unwrap();
    assert_eq!((found.lines, found.broken), (16, 8));
    let walls: Vec<&Pass> = found.passes.iter().filter(|pass| pass.level == 0).collect();
    assert_eq!(walls.len(), 2);
    let length: f64 = walls.iter().map(|pass| pass.length()).sum();
    // `360 + 40 pi` at 5 mm, whatever the distance.
    assert!(
        (length - 360.0 - 40.0 * core::f64::consts::PI).abs() < 1e-6,
        "{length}"
    );
    // A lifted field has no line along the middle of this pocket: by the table of another program 10 mm2 stay.
    let found = passes(&pocket(5), &TOOL, &FIELDS[0]).unwrap();
    assert_eq!((found.lines, found.broken), (12, 0));
    assert!((found.cleared - 9.9).abs() < 1.0, "{}", found.cleared);
    assert!((1..=4).contains(&found.extra.len()), "{}", found.extra.len());
    let longest = found.extra.iter().map(Pass::length).fold(0.0, f64::max);
    assert!(longest < 40.0, "{longest}");
    // Asked for no more than that, nothing is added.
    let rough = Wanted {
        uncut: 20.0,
        ..FIELDS[0]
    };
    let found = passes(&pocket(5), &TOOL, &rough).unwrap();
    assert!(found.extra.is_empty() && found.cleared == 0.0);
    assert!((found.left.uncut - 10.58).abs() < 0.1, "{}", found.left.uncut);
}

/// Programs have whole micrometres. Of smooth passes almost no joint turns by more than half a degree when
/// its pieces are rounded; without longer arcs every third does.
#[test]
fn rounded_passes_stay_smooth() {
    let round = |place: Place| {
        let grid = |along: f64| libm::round(along * 1e3) / 1e3;
        Place::new(grid(place.x), grid(place.y))
    };
    let (mut stops, mut joints) = (0, 0);
    for number in 1..=5 {
        let found = passes(&pocket(number), &TOOL, &FIELDS[0]).unwrap();
        for pass in found.passes.iter().filter(|pass| pass.level > 0) {
            let rounded = pass.pieces.iter().map(|&piece| {
                let (from, via, to) = (round(piece.from), round(piece.at(0.5)), round(piece.to));
                let (first, second) = (via.minus(from), to.minus(via));
                let bow = piece.at(0.5).distance(piece.from.lerp(piece.to, 0.5));
                // A chord makes half the angle of its arc; what hardly bows is a line.
                let sweep = if bow > 2e-3 {
                    2.0 * angle(first, second)
                } else {
                    0.0
                };
                Piece::arc(from, to, sweep)
            });
            let rounded: Vec<Piece> = rounded.collect();
            let pairs = rounded.iter().zip(rounded.iter().skip(1));
            joints += rounded.len() - 1;
            stops += pairs
                .filter(|(one, next)| {
                    angle(one.direction(1.0), next.direction(0.0)).abs() > 0.5_f64.to_radians()
                })
                .count();
        }
    }
    assert!(joints > 1000 && stops * 200 < joints, "{stops} of {joints}");
}

/// Fewer arcs are off the many by no more than they may, and as smooth.
#[test]
fn fewer_arcs_follow_the_many() {
    for wanted in [FIELDS[0], FIELDS[1]] {
        let region = pocket(3);
        for line in drawn(&region, &TOOL, &wanted).unwrap() {
            let many = &line.pass.pieces;
            let few = fewer::fewer(many);
            assert!(few.len() < many.len());
            assert_eq!(few.first().unwrap().from, many.first().unwrap().from);
            assert_eq!(few.last().unwrap().to, many.last().unwrap().to);
            assert!(largest_bend(&few) < 1e-4, "{}", largest_bend(&few));
            let curves: Vec<Curve> = few.iter().map(|&piece| Curve::of(piece)).collect();
            for place in many
                .iter()
                .flat_map(|piece| [0.1, 0.25, 0.6, 0.8].map(|t| piece.at(t)))
            {
                let off = curves
                    .iter()
                    .map(|curve| curve.distance(place))
                    .fold(f64::INFINITY, f64::min);
                // Places between those that are looked at too.
                assert!(off < 1.5 * fewer::OFF, "{off}");
            }
        }
    }
}

/// Beyond a slanted open side, and beside one that is short.
#[test]
fn passes_run_out_of_open_sides() {
    let corners = [
        (0.0, 0.0, 0.0),
        (110.0, 0.0, 0.0),
        (80.0, 60.0, 0.0),
        (0.0, 60.0, 0.0),
    ];
    let mut outline = bulged(&corners);
    outline[1].side = Side::Open;
    let slanted = Region::new(vec![outline]).unwrap();
    for region in [pocket(1), slanted] {
        let open = open_sides(&region);
        for wanted in [FIELDS[0], FIELDS[3]] {
            let found = passes(&region, &TOOL, &wanted).unwrap();
            let clear = clearance(&region, &found.all());
            assert!(clear.least.unwrap().distance >= TOOL.wall_distance() - 1e-9);
            assert!(found.left.uncut <= wanted.uncut, "{}", found.left.uncut);
            let mut count = 0;
            for pass in &found.passes {
                let ends = [pass.pieces.first().unwrap().from, pass.pieces.last().unwrap().to];
                for end in ends.into_iter().filter(|&end| !region.contains(end)) {
                    count += 1;
                    let beyond = open.distance(end);
                    // Where the side ends, beyond its corner, they may be cut by the wall that is led on.
                    assert!(beyond > TOOL.reach() - 1e-3, "{end:?}: {beyond}");
                }
            }
            assert!(count >= 10, "{count}");
        }
    }
}

#[test]
fn bad_numbers_are_refused() {
    let region = pocket(4);
    let fault = |tool: Tool, wanted: Wanted| passes(&region, &tool, &wanted).err();
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        for tool in [
            Tool { radius: bad, ..TOOL },
            Tool {
                standoff: bad,
                ..TOOL
            },
            Tool { run_out: bad, ..TOOL },
        ] {
            assert_eq!(fault(tool, FIELDS[0]), Some(PassesError::Parameter));
        }
        for wanted in [
            Wanted {
                step: bad,
                ..FIELDS[0]
            },
            Wanted {
                lift: bad,
                ..FIELDS[0]
            },
            Wanted {
                uncut: bad,
                ..FIELDS[0]
            },
        ] {
            assert_eq!(fault(TOOL, wanted), Some(PassesError::Parameter));
        }
    }
    let wide = Tool { radius: 31.0, ..TOOL };
    assert_eq!(fault(wide, FIELDS[0]), Some(PassesError::TooWide));
    let fine = Wanted {
        step: 1e-3,
        ..FIELDS[0]
    };
    assert!(matches!(
        fault(TOOL, fine),
        Some(PassesError::Axis(_) | PassesError::Lines(_))
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// In any region, passes keep their distance to walls, and at most the allowed area stays.
    #[test]
    fn random_regions_are_cleared(region in any_region(), share in 0.6..1.0f64, lift in 0.1..2.0f64) {
        let tool = Tool { radius: 4.0, ..TOOL };
        let wanted = wanted(4.0 * share, lift, Detail::True);
        match passes(&region, &tool, &wanted) {
            Ok(found) => {
                let clear = clearance(&region, &found.all());
                prop_assert!(clear.least.unwrap().distance >= tool.wall_distance() - 1e-9);
                prop_assert!(clear.astray.is_empty());
                prop_assert!(found.left.uncut <= wanted.uncut, "{} {}", found.left.uncut, found.extra.len());
            }
            Err(fault) => prop_assert_eq!(fault, PassesError::TooWide),
        }
    }
}
