//! What a disc frees of a region, pass by pass: the proof that its shank never meets ground that still stands.
//!
//! Slits part the ground all the way down, a disc undercuts it. Ground stands while something of it that is not undercut hangs together
//! with it without a slit between both; otherwise it is free, and taken out. A wall always stands.
//!
//! Squares of a grid decide, each to the safe side:
//!
//! - A square is undercut where all of it is within the radius of one piece of a pass.
//! - It belongs to a slit where all of it lies within the width of the blade, and before its ends. Where slits end, it belongs to them where
//!   they cover all of it together.
//! - Squares that are not undercut stand, and so does what hangs together with them by sides of squares, other than those of slits. A way
//!   through the ground that crosses no slit passes from square to square by their sides, so nothing that stands is missed.
//! - Where the shank comes nearer to a square that stands than it may, it meets it. Ground under which a piece of a pass goes counts as
//!   freed after the piece only.

use crate::boxes::Extent;
use crate::curve::Curve;
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Inside, Region, Side};
use core::f64::consts::FRAC_1_SQRT_2;
use grid::{Flags, Grid};
use joined::Cover;

mod grid;
mod joined;

/// A disc, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// The radius of its edge.
    pub radius: f64,
    /// The radius of its shank, with the air that it has to keep.
    pub shank: f64,
}

/// Slits of a straight blade.
#[derive(Clone, Copy, Debug)]
pub struct Slits<'s> {
    /// The ways of its tip.
    pub ways: &'s [Vec<Piece>],
    /// Half its thickness, in mm; positive.
    pub half: f64,
    /// How far from walls ground belongs to the slits along them, in mm: it does not count as standing.
    pub beside_walls: f64,
}

/// Where the shank of a disc meets ground that stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    pub pass: usize,
    pub piece: usize,
    /// The ground.
    pub at: Place,
    /// By how much it is nearer than it may be, in mm.
    pub by: f64,
}

/// What passes free.
#[derive(Clone, Debug, PartialEq)]
pub struct Freed {
    /// Where the shank meets ground first.
    pub met: Option<Met>,
    /// How much ground stands in the end, in mm2: an upper bound.
    pub stands: f64,
    /// A place of it.
    pub at: Option<Place>,
    /// In how many pieces.
    pub pieces: usize,
}

/// Why nothing is proven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreedFault {
    /// The blade or the disc has no size.
    Tool,
    /// The blade is so thin for the region that more squares are needed than are looked at.
    Fine,
}

/// Of half the thickness of the blade, how large squares are: a slit is some squares wide, where two pieces of it meet as well.
const FINENESS: f64 = 0.45;

/// Smaller pieces of standing ground are no pillars, in squares: rounding of a rim.
const LEAST: usize = 4;

/// What passes free of a region, in their order.
///
/// # Errors
/// See [`FreedFault`].
pub fn freed(region: &Region, slits: Slits<'_>, passes: &[Pass], wheel: Wheel) -> Result<Freed, FreedFault> {
    let is_length = |length: f64| length > 0.0 && length.is_finite();
    if !is_length(slits.half) || !is_length(wheel.radius) || !is_length(wheel.shank) {
        return Err(FreedFault::Tool);
    }
    let side = FINENESS * slits.half;
    let grid = Grid::over(region.bounds().grown(2.0 * side), side).ok_or(FreedFault::Fine)?;
    let mut ground = Ground {
        half: side * FRAC_1_SQRT_2,
        grid,
    };
    ground.draw(region, slits);
    ground.spread();
    let mut met = None;
    for (number, pass) in passes.iter().enumerate() {
        for (place, piece) in pass.pieces.iter().enumerate() {
            if met.is_none() && ground.nearest_standing(*piece, wheel.shank).is_some() {
                ground.spread();
                met = ground.nearest_standing(*piece, wheel.shank).map(|(at, by)| Met {
                    pass: number,
                    piece: place,
                    at,
                    by,
                });
            }
            ground.undercut(*piece, wheel.radius);
        }
    }
    ground.spread();
    let (stands, at, pieces) = ground.what_stands();
    Ok(Freed {
        met,
        stands,
        at,
        pieces,
    })
}

/// Slits that end so near to each other in one line, in mm, continue into each other: points of programs are rounded.
const GAP: f64 = 3e-3;

/// How much two slits may turn from each other that do, as a cosine.
const IN_LINE: f64 = 0.98;

/// Where a slit ends just where another one begins or ends, in line with it: the place between both, and how far each is beside it.
fn joints(ways: &[Vec<Piece>]) -> Vec<(Place, f64)> {
    // Each end with the direction out of the slit.
    let ends: Vec<(Place, Place)> = ways
        .iter()
        .filter_map(|way| way.first().zip(way.last()))
        .flat_map(|(first, last)| {
            let back = first.direction(0.0).times(-1.0);
            [(first.from, back), (last.to, last.direction(1.0))]
        })
        .collect();
    let mut joints = Vec::new();
    for (number, (at, out)) in ends.iter().enumerate() {
        for (other, on) in ends.iter().skip(number + 1) {
            let way = other.minus(*at);
            if out.dot(*on) < -IN_LINE && way.dot(*out) <= GAP && way.length() <= LONGEST_GAP {
                joints.push((at.lerp(*other, 0.5), way.length() / 2.0));
            }
        }
    }
    joints
}

/// Ends farther from each other are not looked at, in mm.
const LONGEST_GAP: f64 = 0.3;

struct Ground {
    grid: Grid,
    /// Half the diagonal of a square.
    half: f64,
}

impl Ground {
    fn draw(&mut self, region: &Region, slits: Slits<'_>) {
        let inside = Inside::of(region);
        let half = self.half;
        self.grid.all(|flags, at| {
            if inside.contains(at) {
                *flags |= Flags::GROUND;
            }
        });
        for edge in region.edges() {
            let curve = Curve::of(edge.piece);
            let beside = match edge.side {
                Side::Wall => slits.beside_walls + half,
                Side::Open => half,
            };
            self.grid.around(curve.extent(), beside, |flags, at| {
                let distance = curve.distance(at);
                if distance <= half {
                    *flags |= Flags::GROUND;
                }
                if edge.side == Side::Wall && distance <= half {
                    *flags |= Flags::WALL;
                }
                if edge.side == Side::Wall && distance <= beside {
                    *flags |= Flags::BESIDE_WALL;
                }
            });
        }
        let wide = slits.half - half;
        for way in slits.ways {
            for (place, piece) in way.iter().enumerate() {
                let curve = Curve::of(*piece);
                let goes_on = place + 1 < way.len();
                self.grid.around(curve.extent(), slits.half, |flags, at| {
                    let is_beside = curve.is_beside(at, -half) && curve.left_of(at).abs() <= wide;
                    if is_beside || goes_on && at.distance(piece.to) <= wide {
                        *flags |= Flags::SLIT;
                    }
                });
            }
        }
        self.draw_ends(slits);
        for (at, aside) in joints(slits.ways) {
            self.grid.around(Extent::of(at, at), wide, |flags, middle| {
                if middle.distance(at) <= wide - aside {
                    *flags |= Flags::SLIT;
                }
            });
        }
        self.grid.all(|flags, _| {
            if flags.has(Flags::GROUND) {
                *flags |= Flags::STANDS;
            }
        });
    }

    /// Squares at the ends of slits that several of these cover together.
    fn draw_ends(&mut self, slits: Slits<'_>) {
        let (cover, side) = (Cover::of(slits), self.grid.side());
        let ends = slits.ways.iter().filter_map(|way| way.first().zip(way.last()));
        for at in ends.flat_map(|(first, last)| [first.from, last.to]) {
            self.grid.around(Extent::of(at, at), slits.half, |flags, middle| {
                if !flags.has(Flags::SLIT) && cover.covers(middle, side) {
                    *flags |= Flags::SLIT;
                }
            });
        }
    }

    /// Lets only that stand which hangs together with what is not undercut.
    fn spread(&mut self) {
        let seeds = self.grid.keep(Flags::STANDS, |flags| {
            let is_held = flags.has(Flags::WALL) || !flags.has(Flags::UNDERCUT);
            flags.has(Flags::STANDS) && !flags.has(Flags::SLIT) && is_held
        });
        self.grid.flood(seeds, Flags::STANDS, |flags| {
            flags.has(Flags::STOOD) && !flags.has(Flags::SLIT)
        });
    }

    fn undercut(&mut self, piece: Piece, radius: f64) {
        let (curve, half) = (Curve::of(piece), self.half);
        self.grid.around(curve.extent(), radius, |flags, at| {
            if curve.distance(at) + half <= radius {
                *flags |= Flags::UNDERCUT;
            }
        });
    }

    /// The ground that stands and is nearest to a piece, if it is nearer than it may be, and by how much.
    fn nearest_standing(&mut self, piece: Piece, shank: f64) -> Option<(Place, f64)> {
        let (curve, half) = (Curve::of(piece), self.half);
        let mut nearest: Option<(Place, f64)> = None;
        self.grid.around(curve.extent(), shank + half, |flags, at| {
            if flags.has(Flags::STANDS) {
                let by = shank + half - curve.distance(at);
                if by > 0.0 && nearest.is_none_or(|(_, known)| by > known) {
                    nearest = Some((at, by));
                }
            }
        });
        nearest
    }

    /// The area of what stands and is not beside a wall, a place of the largest piece of it, and how many pieces there are.
    fn what_stands(&self) -> (f64, Option<Place>, usize) {
        let pieces = self
            .grid
            .pieces(|flags| flags.has(Flags::STANDS) && !flags.has(Flags::BESIDE_WALL));
        let count: usize = pieces.iter().map(|(squares, _)| squares).sum();
        let largest = pieces.iter().max_by_key(|(squares, _)| *squares);
        let large = pieces.iter().filter(|(squares, _)| *squares >= LEAST);
        (
            count as f64 * self.grid.side() * self.grid.side(),
            largest.map(|(_, at)| *at),
            large.count(),
        )
    }
}

#[cfg(test)]
mod tests;
