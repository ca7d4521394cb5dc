//! What discs free of regions, against areas computed by hand.

use super::*;
use crate::testkit::{polygon, region};

/// A bay of 60 mm by 100 mm, open at x = 60.
fn bay() -> Region {
    let mut edges = polygon(&[(0.0, 0.0), (60.0, 0.0), (60.0, 100.0), (0.0, 100.0)]);
    edges[1].side = Side::Open;
    region(&[edges])
}

fn line(from: (f64, f64), to: (f64, f64)) -> Vec<Piece> {
    vec![Piece::line(Place::new(from.0, from.1), Place::new(to.0, to.1))]
}

const WHEEL: Wheel = Wheel {
    radius: 12.5,
    shank: 5.0,
};

/// Slits beside all walls, and one that parts a strip along the open side.
fn slits() -> Vec<Vec<Piece>> {
    vec![
        line((61.0, 0.8), (0.0, 0.8)),
        line((0.8, 0.0), (0.8, 100.0)),
        line((0.0, 99.2), (61.0, 99.2)),
        line((54.0, 0.0), (54.0, 100.0)),
    ]
}

fn free(ways: &[Vec<Piece>], passes: &[Vec<Piece>]) -> Freed {
    let slits = Slits {
        ways,
        half: 0.75,
        beside_walls: 0.8,
    };
    let pass = |pieces: &Vec<Piece>| Pass {
        level: 0,
        pieces: pieces.clone(),
    };
    let passes: Vec<Pass> = passes.iter().map(pass).collect();
    freed(&bay(), slits, &passes, WHEEL).unwrap()
}

/// The disc runs outside of the stock along a strip, beyond both ends.
fn first() -> Vec<Piece> {
    line((65.3, -5.0), (65.3, 105.0))
}

/// Back along the next strip, with the shank over the first one.
fn second() -> Vec<Piece> {
    line((59.3, 12.5), (59.3, 87.5))
}

#[test]
fn the_shank_goes_where_a_strip_was_freed() {
    let freed = free(&slits(), &[first(), second()]);
    assert_eq!(freed.met, None, "{freed:?}");
    // What is left is the ground beyond the slit.
    // Beyond half of the slit, between the slits along the walls.
    let left = (54.0 - 1.55 - 0.75) * (100.0 - 2.0 * 1.55);
    assert!((freed.stands - left).abs() < 0.02 * left, "{freed:?}");
}

#[test]
fn without_the_strip_before_it_meets_the_ground() {
    let freed = free(&slits(), &[second()]);
    assert!(freed.met.is_some_and(|met| met.by > 4.0), "{freed:?}");
}

/// A strip that is not parted from the rest does not come free, nor one that hangs at a wall.
#[test]
fn both_slits_are_needed() {
    for missing in [0, 2, 3] {
        let mut fewer = slits();
        fewer.remove(missing);
        let freed = free(&fewer, &[first(), second()]);
        assert!(freed.met.is_some(), "without slit {missing}: {freed:?}");
    }
    // A slit that ends a millimetre before the wall holds the strip as well.
    let mut short = slits();
    short[3] = line((54.0, 0.0), (54.0, 97.0));
    assert!(free(&short, &[first(), second()]).met.is_some());
    // The rim has to reach the slit.
    let far = line((67.8, -5.0), (67.8, 105.0));
    assert!(free(&slits(), &[far, second()]).met.is_some());
}

#[test]
fn blades_without_thickness_prove_nothing() {
    let slits = Slits {
        ways: &[],
        half: 0.0,
        beside_walls: 0.8,
    };
    assert_eq!(freed(&bay(), slits, &[], WHEEL), Err(FreedFault::Tool));
    let thin = Slits { half: 1e-3, ..slits };
    assert_eq!(freed(&bay(), thin, &[], WHEEL), Err(FreedFault::Fine));
}

/// Two slits along walls that turn by 15 deg, each of which ends at the corner: no way leads between them, however the squares lie. Where
/// one of them ends a millimetre before, one does.
#[test]
fn slits_that_meet_at_an_angle_part_the_ground() {
    let (sin, cos) = libm::sincos(15.0_f64.to_radians());
    for shift in 0..12 {
        let shift = f64::from(shift) * 0.03;
        let corner = (30.0 + shift, 0.8 + shift);
        let before = |by: f64| line((-1.0, corner.1), (corner.0 - by, corner.1));
        let after = line(corner, (corner.0 + 40.0 * cos, corner.1 + 40.0 * sin));
        let is_met = |by: f64| {
            let ways = [before(by), after.clone()];
            let slits = Slits {
                ways: &ways,
                half: 0.75,
                beside_walls: 0.0,
            };
            let side = FINENESS * slits.half;
            let grid = Grid::over(bay().bounds().grown(2.0 * side), side).unwrap();
            let mut ground = Ground {
                half: side * FRAC_1_SQRT_2,
                grid,
            };
            ground.draw(&bay(), slits);
            let [low, high] = [(10.0, -0.2), (10.0, 20.0)].map(|(x, y)| Place::new(x, y));
            let mut seeds = Vec::new();
            ground.grid.all(|flags, at| {
                let is_between = at.y > -0.3 && at.x > -0.3 && at.x < 50.0;
                if !is_between {
                    *flags |= Flags::SLIT;
                }
            });
            let mut number = 0;
            ground.grid.all(|flags, at| {
                if at.distance(low) < 0.4 && !flags.has(Flags::SLIT) {
                    seeds.push(number);
                }
                number += 1;
            });
            ground.grid.keep(Flags::STANDS, |_| false);
            ground
                .grid
                .flood(seeds, Flags::STANDS, |flags| !flags.has(Flags::SLIT));
            let mut is_met = false;
            ground
                .grid
                .all(|flags, at| is_met |= at.distance(high) < 0.4 && flags.has(Flags::STANDS));
            is_met
        };
        assert!(!is_met(0.0), "{shift}");
        assert!(is_met(1.2), "{shift}");
    }
}
