//! Lines against true offsets, distances by brute force.

use super::*;
use crate::axis::{Detail, axis};
use crate::source::{Segment, Tuning};
use crate::wall::angle;
use core::f64::consts::PI;
use proptest::prelude::*;
use vcutc_region::region::Inside;
use vcutc_region::testkit::{any_region, pocket};

const RADIUS: f64 = 5.0;
const STEP: f64 = 4.0;

fn field(region: &Region, detail: Detail, lift: f64) -> Field {
    let axis = axis(region, detail, STEP / 100.0).unwrap();
    let tuning = Tuning {
        step: STEP,
        lift,
        reference: 12.0,
    };
    Field::new(&axis.segments, &tuning).unwrap()
}

fn drawn(number: usize, detail: Detail, lift: f64) -> (Region, Field, Vec<Line>) {
    let region = pocket(number);
    let field = field(&region, detail, lift);
    let lines = lines(&region, &field, RADIUS).unwrap();
    (region, field, lines)
}

/// Distance to the nearest wall, edge by edge.
fn distance(region: &Region, place: Place) -> f64 {
    let walls = region
        .edges()
        .filter(|edge| edge.side == vcutc_region::region::Side::Wall);
    let distances = walls.map(|edge| {
        let piece = edge.piece;
        let ends = piece.from.distance(place).min(piece.to.distance(place));
        match piece.centre().zip(piece.radius()) {
            Some((centre, radius)) => {
                let out = piece.at(0.5).minus(centre);
                let turned = angle(out, place.minus(centre)).abs();
                if turned <= piece.sweep.abs() / 2.0 {
                    (centre.distance(place) - radius).abs()
                } else {
                    ends
                }
            }
            None => {
                let way = piece.to.minus(piece.from);
                let t = way.dot(place.minus(piece.from)) / way.dot(way);
                if (0.0..=1.0).contains(&t) {
                    piece.from.lerp(piece.to, t).distance(place)
                } else {
                    ends
                }
            }
        }
    });
    distances.fold(f64::INFINITY, f64::min)
}

/// Root mean square, by length, and the largest distance of lines from the true offsets `d = radius + n step`, and the least
/// distance to the walls; of pocket 1 for x below 110.
fn off(number: usize, region: &Region, lines: &[Line]) -> (f64, f64, f64) {
    let (mut sum, mut length, mut most, mut least) = (0.0, 0.0, 0.0_f64, f64::INFINITY);
    for piece in lines.iter().flat_map(|line| &line.pass.pieces) {
        let place = piece.at(0.5);
        if number == 1 && place.x > 110.0 {
            continue;
        }
        let d = distance(region, place);
        let level = libm::round((d - RADIUS) / STEP).max(0.0);
        let off = d - RADIUS - level * STEP;
        sum += off * off * piece.length();
        length += piece.length();
        most = most.max(off.abs());
        least = least.min(d);
    }
    ((sum / length).sqrt(), most, least)
}

fn length(lines: &[Line]) -> f64 {
    lines.iter().map(|line| line.pass.length()).sum()
}

/// Against another implementation: sums over sources every 0.25 mm on a grid of 0.5 mm, driven alike. Of pocket 1 its lines
/// run out 5 mm beyond the open side at 18 ends.
#[test]
fn lines_are_contour_parallel_without_a_lift() {
    for (number, rms, most, least, total) in [
        (1, 0.08, 0.27, 4.77, 2130.0 - 90.0),
        (2, 0.087, 0.46, 4.65, 1853.0),
        (3, 0.069, 0.25, 4.76, 1741.0),
        (4, 0.069, 0.25, 4.75, 1606.0),
        (5, 0.39, 1.58, 3.42, 2186.0),
    ] {
        let (region, _, lines) = drawn(number, Detail::True, 0.2);
        let (found, largest, nearest) = off(number, &region, &lines);
        assert!(found < 0.1 || number == 5, "{number}: {found}");
        assert!((found - rms).abs() < 0.012, "{number}: {found} {rms}");
        assert!((largest - most).abs() < 0.12, "{number}: {largest} {most}");
        assert!((nearest - least).abs() < 0.12, "{number}: {nearest} {least}");
        let length = length(&lines);
        assert!((length / total - 1.0).abs() < 0.04, "{number}: {length} {total}");
        let run = if number == 1 { Run::Through } else { Run::Closed };
        assert!(lines.iter().all(|line| line.run == run), "{number}");
    }
}

#[test]
fn lines_of_a_lifted_field_are_shorter() {
    let lengths = [2100.0 - 90.0, 1629.0, 1628.0, 1466.0, 1874.0];
    for (number, total) in (1..).zip(lengths) {
        let (region, _, lines) = drawn(number, Detail::True, 2.0);
        let length = length(&lines);
        assert!((length / total - 1.0).abs() < 0.01, "{number}: {length} {total}");
        // The soft minimum of the distances: never nearer to walls than by diffraction.
        let (_, _, nearest) = off(number, &region, &lines);
        assert!(
            nearest > if number == 5 { 3.3 } else { 4.6 },
            "{number}: {nearest}"
        );
    }
}

/// Where the simplified axis has corners and the true one has none, fronts do not meet.
#[test]
fn lines_of_the_simplified_axis_break() {
    let (region, _, lines) = drawn(5, Detail::Simplified, 0.2);
    let (rms, ..) = off(5, &region, &lines);
    assert!(rms > 0.6, "{rms}");
    let broken = |line: &&Line| line.run == Run::Broken;
    let count = lines.iter().filter(broken).count();
    assert!((6..=14).contains(&count), "{count} of {}", lines.len());
    for line in lines.iter().filter(broken) {
        assert!(!line.pass.is_closed());
        // They end where they come too near to a wall.
        for end in [
            line.pass.pieces.first().unwrap().from,
            line.pass.pieces.last().unwrap().to,
        ] {
            let d = distance(&region, end);
            assert!(d < RADIUS - STEP / 2.0 + 1.9, "{end:?}: {d}");
        }
    }
    // Straight branches break nothing: in pocket 1 the simplified axis is the true one.
    let (_, _, lines) = drawn(1, Detail::Simplified, 0.2);
    assert!(lines.iter().all(|line| line.run == Run::Through));
}

/// Pieces follow each other without gaps or bends, and the field is zero along them.
#[test]
fn arcs_follow_the_zeros() {
    for number in [1, 3, 5] {
        let (_, field, lines) = drawn(number, Detail::True, 2.0);
        let turn = field.turned_to(RADIUS);
        for line in &lines {
            let pieces = &line.pass.pieces;
            for (one, next) in pieces.iter().zip(pieces.iter().skip(1)) {
                assert_eq!(one.to, next.from);
                let bend = angle(one.direction(1.0), next.direction(0.0));
                assert!(bend.abs() < 1e-3, "{number}: {one:?} {next:?}");
            }
            for (index, piece) in pieces.iter().enumerate() {
                for t in [0.0, 0.3, 0.7] {
                    let (value, [x, y]) = field.with_gradient(piece.at(t));
                    let slope = Place::new((x * turn).re, (y * turn).re).length();
                    let off = (value * turn).re / slope;
                    assert!(off.abs() < 0.01, "{number}: {piece:?} at {t}: {off}");
                    // By quadrature: the closed form moves lines by a micrometre.
                    if index % 10 == 0 && t == 0.3 {
                        let moved = ((field.integral(piece.at(t)) - value) * turn).re / slope;
                        assert!(moved.abs() < 0.002, "{number}: {piece:?}: {moved}");
                    }
                }
            }
        }
    }
}

#[test]
fn levels_count_from_the_walls() {
    let (_, _, lines) = drawn(3, Detail::True, 0.2);
    let mut levels: Vec<u32> = lines.iter().map(|line| line.pass.level).collect();
    levels.sort_unstable();
    assert_eq!(levels, (0..9).collect::<Vec<u32>>());
}

/// Lines in a corner of half angle phi, of a source of 400 mm along its axis: summed, their vertices have these radii.
#[test]
fn lifted_corners_are_rounded() {
    for (degrees, summed) in [(30.0, 1.122), (45.0, 1.881), (60.0, 3.166)] {
        let sin = libm::sin(degrees * PI / 180.0);
        let segment = Segment {
            from: Place::new(0.0, 0.0),
            to: Place::new(400.0, 0.0),
            from_radius: 0.0,
            to_radius: 400.0 * sin,
        };
        let tuning = Tuning {
            step: STEP,
            lift: 2.0,
            reference: 12.0,
        };
        let field = Field::new(&[segment], &tuning).unwrap();
        let zeros = Zeros {
            field: &field,
            turn: field.turned_to(RADIUS),
        };
        let mut sum = 0.0;
        // Vertices of lines 20 and more steps from the apex, where its own waves have faded.
        let vertices =
            (20..30).map(|n| (RADIUS + f64::from(n) * STEP) / sin + 2.0 / libm::tan(degrees * PI / 180.0));
        for x in vertices {
            let middle = zeros.near(Place::new(x, 0.0), 2.0).unwrap().place;
            let beside = zeros.near(Place::new(middle.x, 0.1), 2.0).unwrap().place;
            let (along, across) = (middle.x - beside.x, beside.y);
            sum += (along * along + across * across) / (2.0 * along.abs()) / 10.0;
        }
        assert!((sum / summed - 1.0).abs() < 0.02, "{degrees}: {sum} {summed}");
    }
}

#[test]
fn lines_do_not_depend_on_the_number_of_threads() {
    let region = pocket(4);
    let field = field(&region, Detail::True, 0.2);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| lines(&region, &field, RADIUS).unwrap())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn bad_numbers_are_refused() {
    let region = pocket(1);
    let segments = axis(&region, Detail::Simplified, 0.04).unwrap().segments;
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (step, lift, reference) in [(bad, 0.2, 12.0), (4.0, bad, 12.0), (4.0, 0.2, bad)] {
            assert!(
                Field::new(
                    &segments,
                    &Tuning {
                        step,
                        lift,
                        reference
                    }
                )
                .is_err()
            );
        }
        let field = field(&region, Detail::Simplified, 0.2);
        assert_eq!(lines(&region, &field, bad), Err(LinesError::Radius));
    }
    let tiny = Tuning {
        step: 1e-4,
        lift: 0.2,
        reference: 12.0,
    };
    let field = Field::new(&segments, &tiny).unwrap();
    assert!(matches!(lines(&region, &field, RADIUS), Err(LinesError::Grid(_))));
    // More points times sources than are looked at: a million points of 700 sources.
    let many: Vec<Segment> = segments.iter().cycle().take(700).copied().collect();
    let heavy = Field::new(&many, &Tuning { step: 0.3, ..tiny }).unwrap();
    assert!(matches!(
        lines(&region, &heavy, RADIUS),
        Err(LinesError::TooMuchWork { .. })
    ));
    // Without sources there is nothing to draw.
    let silent = Field::new(&[], &Tuning { step: 4.0, ..tiny }).unwrap();
    assert_eq!(lines(&region, &silent, RADIUS), Ok(Vec::new()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// Cusps and all: no piece leads far from where the line is, and out of the region only beside its edge.
    #[test]
    fn lines_of_random_regions_stay_where_they_are(region in any_region(), lift in 0.05..1.0f64) {
        let field = field(&region, Detail::True, lift);
        let inside = Inside::of(&region);
        for line in lines(&region, &field, RADIUS).unwrap() {
            for piece in &line.pass.pieces {
                // At most the pieces that replace the most points, each a cell on.
                prop_assert!(piece.length() < 16.0 * 1.5 * STEP / POINTS_OVER_STEP, "{piece:?}");
                let middle = piece.at(0.5);
                prop_assert!(inside.contains(middle) || distance(&region, middle) < 0.1, "{piece:?}");
            }
        }
    }
}
