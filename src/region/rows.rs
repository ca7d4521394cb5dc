//! Straight rows over what closed ways bound, seen from a straight side.

use crate::curve::{Curve, crossings};
use crate::piece::Piece;
use crate::place::Place;

/// Rows do not go so near to the end of a piece, in mm: crossings there would count twice, or not at all.
const NEAR: f64 = 1e-6;

/// By how much a row is moved that does, and how often.
const NUDGE: f64 = 3.7e-6;
const TRIALS: u32 = 64;

/// A straight side, with the ground in front of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Front {
    origin: Place,
    along: Place,
    into: Place,
}

impl Front {
    /// The side along a line of a boundary, which has its ground to the left.
    #[must_use]
    pub fn of(side: Piece) -> Self {
        let along = side.direction(0.0);
        Self {
            origin: side.from,
            along,
            into: along.left(),
        }
    }

    /// Turned by a right angle to the left: what was depth is the way along it, and the way along it is the depth, negated.
    #[must_use]
    pub fn turned(&self) -> Self {
        Self {
            origin: self.origin,
            along: self.into,
            into: self.along.times(-1.0),
        }
    }

    /// How far into the ground a place lies, in mm.
    #[must_use]
    pub fn depth(&self, at: Place) -> f64 {
        at.minus(self.origin).dot(self.into)
    }

    /// How far along the side a place lies, in mm.
    #[must_use]
    pub fn way(&self, at: Place) -> f64 {
        at.minus(self.origin).dot(self.along)
    }

    /// The place so far along the side, and so far into the ground, in mm.
    #[must_use]
    pub fn place(&self, way: f64, depth: f64) -> Place {
        self.origin
            .plus(self.along.times(way))
            .plus(self.into.times(depth))
    }

    /// How much a direction leads into the ground: 1 straight into it, -1 straight out.
    #[must_use]
    pub fn inward(&self, direction: Place) -> f64 {
        direction.dot(self.into)
    }

    /// How far into the ground some pieces go at most, in mm.
    #[must_use]
    pub fn deepest(&self, pieces: &[Piece]) -> f64 {
        let ends = pieces.iter().flat_map(|piece| [piece.from, piece.to]);
        let bows = pieces.iter().flat_map(|piece| {
            let curve = Curve::of(*piece);
            [self.along, self.along.times(-1.0)].map(|along| curve.where_it_goes(along))
        });
        let places = ends.chain(bows.flatten());
        places
            .map(|place| self.depth(place))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The stretches of a row at a depth within closed ways, as far along the side as they begin and end, in mm.
    #[must_use]
    pub fn row(&self, bounds: &[Piece], depth: f64) -> Vec<[f64; 2]> {
        let is_beside_an_end = |depth: f64| {
            let ends = bounds.iter().map(|piece| self.depth(piece.from));
            ends.into_iter().any(|end| (end - depth).abs() < NEAR)
        };
        let trials = (0..TRIALS).map(|trial| depth - f64::from(trial) * NUDGE);
        let depth = trials.into_iter().find(|&depth| !is_beside_an_end(depth));
        let Some(depth) = depth else {
            return Vec::new();
        };
        let row = Curve::of(Piece::line(self.place(0.0, depth), self.place(1.0, depth)));
        let mut met: Vec<f64> = bounds
            .iter()
            .flat_map(|piece| {
                let curve = Curve::of(*piece);
                let met = crossings(&row, &curve).into_iter().flatten();
                let met = met.filter(move |at| curve.is_beside(*at, 0.0));
                met.map(|at| self.way(at)).collect::<Vec<f64>>()
            })
            .collect();
        met.sort_unstable_by(f64::total_cmp);
        met.chunks_exact(2).map(|ends| [ends[0], ends[1]]).collect()
    }

    /// Whether a straight way lies within closed ways: it crosses none of them, and begins within.
    #[must_use]
    pub fn holds(bounds: &[Piece], way: Piece) -> bool {
        let curve = Curve::of(way);
        let crosses = |piece: &Piece| {
            let other = Curve::of(*piece);
            let mut met = crossings(&curve, &other).into_iter().flatten();
            met.any(|at| curve.is_beside(at, 0.0) && other.is_beside(at, 0.0))
        };
        let within = bounds
            .iter()
            .filter(|piece| crate::region::toggles(piece, way.at(0.5)));
        within.count() % 2 == 1 && !bounds.iter().any(crosses)
    }
}

#[cfg(test)]
mod tests;
