//! What slits leave on walls at their foot: how far the walls lie from them.

use crate::boxes::Dense;
use crate::curve::Curve;
use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Loop, Region, Side};
use core::f64::consts::{FRAC_PI_2, PI};

/// A place of a wall, and how far a slit is from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Left {
    /// An upper bound, too large by [`RESOLUTION`] at most, in mm.
    pub distance: f64,
    pub at: Place,
    /// Which of [`Region::edges`].
    pub edge: usize,
}

/// What slits leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Along walls; none without walls.
    pub walls: Option<Left>,
    /// Where walls meet at less than a right angle, which a blade with a thickness cannot fill: from the corner of what the blade
    /// has to keep to. None without such corners.
    pub corners: Option<Left>,
}

/// A blade, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    /// Its thickness.
    pub thickness: f64,
    /// How far its side has to keep from walls.
    pub allowance: f64,
}

/// How exact distances are where no closed form says them, in mm.
pub const RESOLUTION: f64 = 0.001;

/// How many places of walls are looked at, at most.
const MOST: usize = 4_000_000;

/// Centres this close belong to arcs of which one is an offset of the other, in mm: rounding of points moves the centre of a shallow arc
/// by many times itself.
const CONCENTRIC: f64 = 0.05;

/// How far a distance may be off by rounding, in mm.
const ROUNDING: f64 = 1e-9;

/// Finds the places of the walls of a region that are farthest from the ways of a blade. Distances count from the way, the middle of the
/// blade.
///
/// The distance of a place to the ways changes no faster than the place moves. So half the length of a stretch, and the distance of its
/// middle, bound all distances of it. Where the way nearest to the middle is a line beside a line, the distance to it is convex, and both
/// ends bound it; where it is an arc beside an arc, it changes by the distance of both centres for each radian at most. Stretches are
/// halved until one of these says enough.
///
/// # Errors
/// Too many places would have to be looked at.
pub fn foot(region: &Region, ways: &[Piece], blade: Sides) -> Result<Foot, Dense> {
    let mut search = Search {
        ways: Walls::of_pieces(ways.iter().copied().enumerate()),
        pieces: ways,
        looked_at: 0,
        walls: None,
    };
    let mut corners: Option<Left> = None;
    let mut first = 0;
    for ring in region.loops() {
        for (place, edge) in ring.iter().enumerate() {
            if edge.side == Side::Wall {
                let [begin, end] =
                    [place + ring.len() - 1, place].map(|place| Corner::at(ring, place, blade));
                search.wall(edge.piece, first + place, [begin.covers, end.covers])?;
                if let Some(at) = begin.inner {
                    let distance = search.ways.distance(at);
                    if corners.is_none_or(|known| distance > known.distance) {
                        let edge = first + place;
                        corners = Some(Left { distance, at, edge });
                    }
                }
            }
        }
        first += ring.len();
    }
    Ok(Foot {
        walls: search.walls,
        corners,
    })
}

/// Where two walls meet.
struct Corner {
    /// How much of both walls the blade cannot come beside, or need not: what it has to keep to has a corner of its own.
    covers: f64,
    /// The corner of what it has to keep to, of less than a right angle.
    inner: Option<Place>,
}

impl Corner {
    /// After an edge of a loop.
    fn at(ring: &Loop, place: usize, blade: Sides) -> Self {
        let none = Self {
            covers: 0.0,
            inner: None,
        };
        let edge = |place: usize| ring.get(place % ring.len().max(1));
        let (Some(one), Some(next)) = (edge(place), edge(place + 1)) else {
            return none;
        };
        let (out, on) = (one.piece.direction(1.0), next.piece.direction(0.0));
        let turn = libm::atan2(out.cross(on), out.dot(on));
        if one.side != Side::Wall || next.side != Side::Wall || turn <= 1e-6 {
            return none;
        }
        let inner = PI - turn;
        let kept = blade.allowance / libm::tan(inner / 2.0);
        if inner >= FRAC_PI_2 - 1e-6 {
            return Self {
                covers: kept,
                inner: None,
            };
        }
        // Where the side of the blade that is turned away from one wall meets the other.
        let covers = kept + 2.0 * blade.thickness / libm::tan(inner);
        let aside = out.left().times(blade.allowance);
        let inner = one.piece.to.plus(aside).plus(out.times(-kept));
        Self {
            covers,
            inner: Some(inner),
        }
    }
}

struct Search<'w> {
    ways: Walls,
    pieces: &'w [Piece],
    looked_at: usize,
    walls: Option<Left>,
}

impl Search<'_> {
    fn wall(&mut self, wall: Piece, edge: usize, [begin, end]: [f64; 2]) -> Result<(), Dense> {
        let long = wall.length();
        let (from, to) = ((begin / long).min(1.0), (1.0 - end / long).max(0.0));
        let mut open = vec![[from, to]];
        while let Some([from, to]) = open.pop() {
            if to <= from {
                continue;
            }
            self.looked_at += 1;
            if self.looked_at > MOST {
                return Err(Dense);
            }
            let middle = f64::midpoint(from, to);
            let at = wall.at(middle);
            let half = (to - from) / 2.0 * long;
            let here = self.ways.nearest(at);
            let near = here.map_or(f64::INFINITY, |here| here.distance);
            let beside = here.and_then(|here| {
                let way = self.pieces.get(here.edge)?;
                bound_beside(wall.part(from, to), *way)
            });
            let distance = (near + half).min(beside.unwrap_or(f64::INFINITY));
            if self.walls.is_some_and(|known| distance <= known.distance) {
                continue;
            }
            let is_exact = beside.is_some_and(|beside| beside - near <= RESOLUTION);
            if is_exact || half <= RESOLUTION || near.is_infinite() {
                self.walls = Some(Left { distance, at, edge });
                continue;
            }
            open.push([middle, to]);
            open.push([from, middle]);
        }
        Ok(())
    }
}

/// A bound on the distances of all places of a piece of a wall from one way; none where no closed form says one.
fn bound_beside(wall: Piece, way: Piece) -> Option<f64> {
    let curve = Curve::of(way);
    let ends = [wall.from, wall.to].map(|end| curve.distance(end));
    let (Some(own), Some(centre), Some(radius)) = (wall.centre(), way.centre(), way.radius()) else {
        // The distance to a segment is convex along a line.
        let are_lines = wall.is_line() && way.is_line();
        return are_lines.then(|| ends[0].max(ends[1]));
    };
    let apart = own.distance(centre);
    // Beside the arc, and not beyond its ends, the distance is that to its circle.
    let is_beside = [wall.from, wall.to].iter().zip(ends).all(|(end, distance)| {
        let to_circle = (end.distance(centre) - radius).abs();
        distance - to_circle <= ROUNDING * radius.max(1.0)
    });
    let middle = (wall.at(0.5).distance(centre) - radius).abs();
    let is_short = wall.sweep.abs() < FRAC_PI_2;
    (apart <= CONCENTRIC && is_beside && is_short).then(|| middle + apart * wall.sweep.abs() / 2.0)
}

#[cfg(test)]
mod tests;
