//! Passes for tests: through given corners, and around the inside of a rectangle.

use crate::offset::Offsets;
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Loop, Region};
use crate::testkit::{bulged, region};

/// A closed loop of walls, from corners and bulges.
pub fn ring(corners: &[[f64; 3]]) -> Loop {
    let corners: Vec<_> = corners.iter().map(|&[x, y, bulge]| (x, y, bulge)).collect();
    bulged(&corners)
}

/// A rectangle of walls.
pub fn rectangle(width: f64, height: f64) -> Region {
    region(&[super::rectangle(0.0, 0.0, width, height)])
}

/// A closed pass through corners.
pub fn closed(level: u32, corners: &[[f64; 3]]) -> Pass {
    let pieces = ring(corners).iter().map(|edge| edge.piece).collect();
    Pass { level, pieces }
}

/// An open pass of lines.
pub fn open(corners: &[[f64; 2]]) -> Pass {
    let place = |[x, y]: [f64; 2]| Place::new(x, y);
    let pieces = corners
        .windows(2)
        .map(|pair| Piece::line(place(pair[0]), place(pair[1])))
        .collect();
    Pass { level: 0, pieces }
}

/// Passes around the inside of a rectangle, from the wall to the middle: the last one back and forth where it
/// has no width.
pub fn rings(width: f64, height: f64, first: f64, step: f64) -> Vec<Pass> {
    let mut passes = Vec::new();
    for level in 0.. {
        let d = first + f64::from(level) * step;
        if 2.0 * d >= width.min(height) {
            return passes;
        }
        let (w, h) = (width - d, height - d);
        passes.push(closed(
            level,
            &[[d, d, 0.0], [w, d, 0.0], [w, h, 0.0], [d, h, 0.0]],
        ));
    }
    passes
}

/// All levels of a region from the first one on, the outermost first.
pub fn levels(region: &Region, first: f64, step: f64) -> Vec<Pass> {
    let mut offsets = Offsets::of(region, 3.0 * first);
    let mut passes = Vec::new();
    for level in 0..200 {
        let ways = offsets.level(first + f64::from(level) * step).unwrap();
        if ways.is_empty() {
            break;
        }
        passes.extend(ways.into_iter().map(|way| Pass {
            level,
            pieces: way.pieces,
        }));
    }
    passes
}
