//! Angles in closed form, against rims that are sampled, and against a picture of what is cut.

use super::*;
use crate::region::Side;
use crate::testkit::passes::{closed, open, rectangle, ring, rings};
use crate::testkit::pocket;
use core::f64::consts::{FRAC_PI_4, PI};
use proptest::prelude::*;

fn degrees(angle: f64) -> f64 {
    angle.to_degrees()
}

#[test]
fn a_pass_beside_another_and_a_sharp_corner() {
    let region = rectangle(100.0, 80.0);
    let mut passes = rings(100.0, 80.0, 5.0, 4.0);
    passes.reverse();
    let found = engagement(&region, &passes, 5.0).unwrap();
    // The first pass cuts a slot.
    assert!((found.largest - PI).abs() < 1e-9 && (found.bound - PI).abs() < 1e-9);
    let straight = libm::acos(1.0 - 4.0 / 5.0);
    let corner = straight + PI - 2.0 * FRAC_PI_4;
    let last = found.profiles.last().unwrap();
    assert!((last[0].angles[0] - straight).abs() < 1e-9, "{:?}", last[0]);
    assert!((last[0].bound - straight).abs() < 1e-9, "{:?}", last[0]);
    assert!((degrees(straight) - 78.46).abs() < 5e-3 && (degrees(corner) - 168.46).abs() < 5e-3);
    let largest = last.iter().flat_map(|stretch| stretch.angles).fold(0.0, f64::max);
    assert!((largest - corner).abs() < 1e-9, "{}", degrees(largest));
    let bound = last.iter().map(|stretch| stretch.bound).fold(0.0, f64::max);
    assert!(bound >= corner && bound < corner + CLOSE + 1e-9);
    // Stretches follow each other from the beginning to the end.
    let length = passes.last().unwrap().length();
    assert!(last[0].way[0] == 0.0 && (last.last().unwrap().way[1] - length).abs() < 1e-9);
    assert!(
        last.windows(2)
            .all(|pair| (pair[0].way[1] - pair[1].way[0]).abs() < 1e-9)
    );
}

/// Two passes around a corner of half angle `phi`, 4 mm apart: sharp, or as parabolas of vertex radius 5 mm between legs of 60 mm.
fn around_a_corner(phi: f64, rho: Option<f64>) -> f64 {
    let region = wide(false);
    let (sin, cos) = libm::sincos(phi);
    // The corner at the origin opens along x; passes come in above and go out below, so that it lies to their right.
    let pass = |from_corner: f64| {
        let tip = from_corner / sin;
        let leg = |way: f64, side: f64| [tip + way * cos, side * way * sin];
        let mut corners = vec![leg(60.0, 1.0)];
        match rho {
            None => corners.push([tip, 0.0]),
            Some(rho) => {
                let length = rho / (sin * libm::tan(phi));
                corners.extend((0..=400_u32).map(|i| {
                    let t = f64::from(i) / 400.0;
                    let (one, other) = (length * (1.0 - t) * (1.0 - t), length * t * t);
                    let (first, last) = (leg(one, 1.0), leg(other, -1.0));
                    [first[0] + last[0] - tip, first[1] + last[1]]
                }));
            }
        }
        corners.push(leg(60.0, -1.0));
        open(&corners)
    };
    // Beyond what the ends of the inner pass reach, all is in the material: the outer pass begins and ends before.
    let outer = pass(9.0);
    let found = engagement(&region, &[pass(13.0), outer], 5.0).unwrap();
    let stretches = &found.profiles[1];
    let length = stretches.last().unwrap().way[1];
    let inside = stretches
        .iter()
        .filter(|stretch| stretch.way[0] > 20.0 && stretch.way[1] < length - 20.0);
    degrees(inside.flat_map(|stretch| stretch.angles).fold(0.0, f64::max))
}

#[test]
fn corners_sharp_and_round() {
    for (half, rho, expected) in [
        (45.0_f64, None, 168.46),
        (60.0, None, 138.46),
        // Beyond half a turn the rim goes backwards.
        (30.0, None, 180.0),
        (45.0, Some(5.0), 120.9),
        (60.0, Some(5.0), 108.9),
        (30.0, Some(5.0), 147.6),
    ] {
        let found = around_a_corner(half.to_radians(), rho);
        assert!((found - expected).abs() < 0.5, "{half} {rho:?}: {found}");
    }
}

#[test]
fn nothing_works_beyond_an_open_side() {
    // The first pocket is open at x = 120.
    let region = pocket(1);
    let passes = [
        open(&[[60.0, 40.0], [135.0, 40.0]]),
        open(&[[135.0, 44.0], [60.0, 44.0]]),
    ];
    let found = engagement(&region, &passes, 5.0).unwrap();
    let at = |pass: usize, way: f64| {
        let stretches = &found.profiles[pass];
        *stretches.iter().find(|stretch| stretch.way[1] >= way).unwrap()
    };
    assert!((at(0, 30.0).bound - PI).abs() < 1e-9);
    // A rim that stands half way out works with what is still within: 2 asin(d / r) is missing, d the way out.
    let out = found.profiles[0]
        .iter()
        .find(|stretch| stretch.way[0] > 57.0 && stretch.way[0] < 58.0)
        .unwrap();
    let left = PI - 2.0 * libm::acos((60.0 - out.way[0]) / 5.0);
    assert!((out.angles[0] - left).abs() < 1e-9, "{out:?} {left}");
    for way in [65.1, 70.0, 75.0] {
        assert_eq!(at(0, way).bound, 0.0);
    }
    // The second pass comes in from the air.
    assert_eq!(at(1, 5.0).bound, 0.0);
    let beside = libm::acos(1.0 - 4.0 / 5.0);
    assert!((at(1, 50.0).angles[1] - beside).abs() < 1e-9);
}

#[test]
fn invalid_tools_and_ways_without_end_are_refused() {
    let region = rectangle(100.0, 80.0);
    let pass = [open(&[[10.0, 10.0], [90.0, 10.0]])];
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(engagement(&region, &pass, radius), Err(EngagementFault::Tool));
    }
    let fault = EngagementFault::Long { most: MOST_LOOKS };
    assert_eq!(engagement(&region, &pass, 1e-6), Err(fault));
    assert_eq!(engagement(&region, &[], 5.0).unwrap().mean, 0.0);
}

/// A region whose walls are far away, and that may be open at x = 80.
fn wide(is_open: bool) -> Region {
    let end = if is_open { 80.0 } else { 500.0 };
    let mut edges = ring(&[
        [-500.0, -500.0, 0.0],
        [end, -500.0, 0.0],
        [end, 500.0, 0.0],
        [-500.0, 500.0, 0.0],
    ]);
    edges[1].side = if is_open { Side::Open } else { Side::Wall };
    Region::new(vec![edges]).unwrap()
}

/// The share of the front half of a rim that no sampled place of earlier pieces has within the radius, as an angle.
fn sampled(region: &Region, earlier: &[Place], at: Place, ahead: Place, radius: f64) -> f64 {
    const COUNT: u32 = 240;
    let free = (0..COUNT).filter(|&i| {
        let angle = (f64::from(i) + 0.5) / f64::from(COUNT) * PI - FRAC_PI_2;
        let (sin, cos) = libm::sincos(angle);
        let out = ahead.times(cos).plus(ahead.left().times(sin));
        let place = at.plus(out.times(radius));
        region.contains(place)
            && earlier
                .iter()
                .all(|dot| dot.minus(place).square() > radius * radius)
    });
    f64::from(free.count() as u32) * PI / f64::from(COUNT)
}

/// A place every 0.1 mm or less.
fn dots(piece: Piece) -> impl Iterator<Item = Place> {
    let count = libm::ceil(piece.length() / 0.1).max(1.0);
    (0..=count as usize).map(move |i| piece.at(i as f64 / count))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Random lines and arcs, across each other. Arcs turn wider than the tool, or else their own older parts count too.
    #[test]
    fn angles_are_those_of_sampled_rims(
        corners in prop::collection::vec((10.0..115.0f64, 10.0..70.0f64, -0.6..0.6f64), 2..7),
        is_open: bool, seed in 0.0..1.0f64,
    ) {
        let corners: Vec<[f64; 3]> = corners.into_iter().map(|(x, y, bulge)| [x, y, bulge]).collect();
        let pieces: Vec<Piece> = ring(&corners).iter().map(|edge| edge.piece).collect();
        prop_assume!(pieces.iter().all(|piece| piece.is_sound() && piece.radius().is_none_or(|r| r > 5.5)));
        let region = wide(is_open);
        let passes: Vec<Pass> = pieces.iter().map(|&piece| Pass { level: 0, pieces: vec![piece] }).collect();
        let found = engagement(&region, &passes, 5.0).unwrap();
        let mut earlier = Vec::new();
        for (piece, stretches) in pieces.iter().zip(&found.profiles) {
            let length = piece.length();
            for stretch in stretches.iter().step_by(1 + stretches.len() / 8) {
                let [from, to] = stretch.way;
                let middle = piece.at(f64::midpoint(from, to) / length);
                let ahead = piece.direction(f64::midpoint(from, to) / length);
                let oracle = sampled(&region, &earlier, middle, ahead, 5.0);
                // Dots fall short of the piece: outlines that the rim touches are seen 3 deg off.
                prop_assert!((stretch.angles[1] - oracle).abs() < 0.06, "{stretch:?} {oracle}");
                let share = (from + seed * (to - from)) / length;
                let oracle = sampled(&region, &earlier, piece.at(share), piece.direction(share), 5.0);
                prop_assert!(oracle < stretch.bound + 0.06, "{stretch:?} {oracle}");
            }
            earlier.extend(dots(*piece));
        }
    }
}

/// What is cut, in pixels of 0.05 mm.
struct Picture {
    is_cut: Vec<bool>,
}

impl Picture {
    const SIDE: f64 = 0.05;
    const COUNT: usize = 720;

    fn index(place: Place) -> Option<usize> {
        let [column, row] = [place.x, place.y].map(|along| libm::floor(along / Self::SIDE));
        let count = Self::COUNT as f64;
        let is_within = column >= 0.0 && row >= 0.0 && column < count && row < count;
        is_within.then_some(row as usize * Self::COUNT + column as usize)
    }

    /// Cuts the pixels whose middles are within the radius.
    fn cut(&mut self, at: Place, radius: f64) {
        let range = |along: f64| {
            let first = libm::floor((along - radius) / Self::SIDE).max(0.0) as usize;
            first..Self::COUNT.min(libm::ceil((along + radius) / Self::SIDE) as usize)
        };
        for row in range(at.y) {
            for column in range(at.x) {
                let middle = Place::new(column as f64 + 0.5, row as f64 + 0.5).times(Self::SIDE);
                self.is_cut[row * Self::COUNT + column] |= middle.minus(at).square() <= radius * radius;
            }
        }
    }
}

/// A whole pocket, cut in pixels along the passes: nowhere does more of the rim stand before pixels than the bound says.
#[test]
fn no_rim_stands_before_more_pixels_than_its_bound() {
    let (size, radius) = (36.0, 5.0);
    let region = rectangle(size, size);
    let mut passes = rings(size, size, radius, 4.0);
    // The second pass goes around its corners.
    passes[1] = closed(
        1,
        &[
            [12.0, 9.0, 0.0],
            [24.0, 9.0, 0.25],
            [27.0, 12.0, 0.0],
            [27.0, 24.0, 0.25],
            [24.0, 27.0, 0.0],
            [12.0, 27.0, 0.25],
            [9.0, 24.0, 0.0],
            [9.0, 12.0, 0.25],
        ],
    );
    passes.reverse();
    let found = engagement(&region, &passes, radius).unwrap();
    let mut picture = Picture {
        is_cut: vec![false; Picture::COUNT * Picture::COUNT],
    };
    let mut worst = 0.0_f64;
    for (pass, stretches) in passes.iter().zip(&found.profiles) {
        let mut way = 0.0;
        for piece in &pass.pieces {
            let length = piece.length();
            let count = libm::ceil(length / 0.2) as u32;
            for step in 0..=count {
                let share = f64::from(step) / f64::from(count);
                let (at, ahead) = (piece.at(share), piece.direction(share));
                picture.cut(at, radius);
                // Just before the rim.
                let before = (0..720_u32).filter(|&i| {
                    let angle = (f64::from(i) + 0.5) / 720.0 * PI - FRAC_PI_2;
                    let (sin, cos) = libm::sincos(angle);
                    let out = ahead.times(cos).plus(ahead.left().times(sin));
                    Picture::index(at.plus(out.times(radius + 0.08))).is_some_and(|i| !picture.is_cut[i])
                });
                let seen = f64::from(before.count() as u32) * PI / 720.0;
                let here = way + share * length;
                let mut around = stretches
                    .iter()
                    .filter(|stretch| stretch.way[0] <= here + 1e-9 && here <= stretch.way[1] + 1e-9);
                let bound = around.by_ref().map(|stretch| stretch.bound).fold(0.0, f64::max);
                worst = worst.max(seen - bound);
            }
            way += length;
        }
    }
    // A pixel on the rim is 0.6 deg, and what touches it on one side or both seems to be before it.
    assert!(worst < 2.0 * libm::acos(1.0 - 0.08 / 5.0), "{worst}");
    assert!(worst > -0.5, "{worst}");
}
