//! Distances: from places to walls, and between pieces, in closed form.

use crate::boxes::{Extent, Tree};
use crate::curve::{Curve, crossings};
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Region, Side};

/// The walls of a region, ready to be asked how near they are. Open sides are not walls.
#[derive(Clone, Debug)]
pub struct Walls {
    curves: Vec<Curve>,
    edges: Vec<usize>,
    tree: Tree,
}

/// The place of the walls that is nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// How far away it is, in mm.
    pub distance: f64,
    /// The place.
    pub at: Place,
    /// Which of [`Region::edges`] it lies on.
    pub edge: usize,
}

impl Walls {
    /// The walls of a region.
    #[must_use]
    pub fn of(region: &Region) -> Self {
        let walls = region.edges().enumerate();
        let walls = walls.filter(|(_, edge)| edge.side == Side::Wall);
        Self::of_pieces(walls.map(|(number, edge)| (number, edge.piece)))
    }

    /// Pieces as walls, each with the number that answers name.
    #[must_use]
    pub fn of_pieces(pieces: impl IntoIterator<Item = (usize, Piece)>) -> Self {
        let (edges, curves): (Vec<usize>, Vec<Curve>) = pieces
            .into_iter()
            .map(|(number, piece)| (number, Curve::of(piece)))
            .unzip();
        let extents: Vec<Extent> = curves.iter().map(Curve::extent).collect();
        let tree = Tree::of(&extents);
        Self { curves, edges, tree }
    }

    /// The pieces, prepared, with the numbers of their edges.
    pub fn curves(&self) -> impl Iterator<Item = (usize, &Curve)> {
        self.edges.iter().copied().zip(&self.curves)
    }

    /// One of [`Walls::curves`].
    #[must_use]
    pub fn curve(&self, number: usize) -> Option<&Curve> {
        self.curves.get(number)
    }

    /// The nearest place of the walls; none where there are no walls.
    #[must_use]
    pub fn nearest(&self, place: Place) -> Option<Nearest> {
        self.nearest_within(place, f64::INFINITY)
    }

    /// The nearest place of the walls, if it is not farther than some mm.
    #[must_use]
    pub fn nearest_within(&self, place: Place, limit: f64) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        self.tree.around(place, limit, &mut |wall| {
            let within = best.map_or(limit, |best| best.distance);
            let Some((curve, &edge)) = self.wall(wall) else {
                return within;
            };
            let foot = curve.nearest(place);
            if foot.distance > within || best.is_some() && foot.distance == within {
                return within;
            }
            best = Some(Nearest {
                distance: foot.distance,
                at: foot.at,
                edge,
            });
            foot.distance
        });
        best
    }

    /// The distance to the nearest wall, in mm; endless without walls.
    #[must_use]
    pub fn distance(&self, place: Place) -> f64 {
        let mut best = f64::INFINITY;
        self.tree.around(place, best, &mut |wall| {
            if let Some((curve, _)) = self.wall(wall) {
                best = best.min(curve.distance(place));
            }
            best
        });
        best
    }

    /// Some wall that is nearer to a place than a limit, in mm: its place in [`Walls::curves`].
    #[must_use]
    pub fn nearer_than(&self, place: Place, limit: f64) -> Option<usize> {
        let mut found = None;
        self.tree.around(place, limit, &mut |wall| match self.wall(wall) {
            Some((curve, _)) if curve.distance(place) < limit => {
                found = Some(wall as usize);
                -1.0
            }
            _ => limit,
        });
        found
    }

    /// Shows all walls that may lie within some mm of a place, by their places in [`Walls::curves`].
    pub fn around(&self, place: Place, limit: f64, visit: &mut dyn FnMut(usize)) {
        self.tree.around(place, limit, &mut |wall| {
            visit(wall as usize);
            limit
        });
    }

    /// The shortest way from a piece to the walls: its length in mm, where it leaves the piece, and what of the walls it reaches.
    /// None without walls.
    #[must_use]
    pub fn nearest_to(&self, piece: Piece) -> Option<(Place, Nearest)> {
        let curve = Curve::of(piece);
        let middle = curve.middle;
        // No place of the piece is farther from its middle.
        let reach = curve.extent().grown(0.0);
        let reach = [reach.low, reach.high, Place::new(reach.low.x, reach.high.y)];
        let reach = reach
            .iter()
            .map(|corner| corner.distance(middle))
            .fold(0.0, f64::max);
        let reach = reach.max(Place::new(curve.extent().high.x, curve.extent().low.y).distance(middle));
        let mut best: Option<(Place, Nearest)> = None;
        self.tree.around(middle, f64::INFINITY, &mut |wall| {
            if let Some((candidate, &edge)) = self.wall(wall) {
                let (distance, from, at) = between(&curve, candidate);
                if best.is_none_or(|(_, best)| distance < best.distance) {
                    best = Some((from, Nearest { distance, at, edge }));
                }
            }
            best.map_or(f64::INFINITY, |(_, best)| best.distance + reach)
        });
        best
    }

    fn wall(&self, wall: u32) -> Option<(&Curve, &usize)> {
        self.curves.get(wall as usize).zip(self.edges.get(wall as usize))
    }
}

/// The shortest way from one piece to another: its length in mm, where it begins and where it ends.
///
/// Pieces that do not meet are nearest at an end of one of them, or along a common normal: where arcs go along the line, or square
/// to the line between both centres.
#[must_use]
pub fn between(one: &Curve, other: &Curve) -> (f64, Place, Place) {
    let common = crossings(one, other);
    let mut common = common.into_iter().flatten();
    if let Some(at) = common.find(|&at| one.is_beside(at, 0.0) && other.is_beside(at, 0.0)) {
        return (0.0, at, at);
    }
    let mut best = (f64::INFINITY, one.piece.from, other.piece.from);
    let mut offer = |distance: f64, from: Place, to: Place| {
        if distance < best.0 {
            best = (distance, from, to);
        }
    };
    for from in [one.piece.from, one.piece.to] {
        let foot = other.nearest(from);
        offer(foot.distance, from, foot.at);
    }
    for to in [other.piece.from, other.piece.to] {
        let foot = one.nearest(to);
        offer(foot.distance, foot.at, to);
    }
    if let Some(along) = common_tangent(one, other) {
        for along in [along, along.times(-1.0)] {
            if let Some(from) = one.where_it_goes(along) {
                let foot = other.nearest(from);
                offer(foot.distance, from, foot.at);
            }
            if let Some(to) = other.where_it_goes(along) {
                let foot = one.nearest(to);
                offer(foot.distance, foot.at, to);
            }
        }
    }
    best
}

/// The direction that two pieces have where a common normal meets them. None of two lines, and of arcs about one centre.
fn common_tangent(one: &Curve, other: &Curve) -> Option<Place> {
    let centre = |curve: &Curve| curve.middle.plus(curve.normal.times(1.0 / curve.bend));
    match (one.piece.is_line(), other.piece.is_line()) {
        (true, true) => None,
        (true, false) => Some(one.ahead),
        (false, true) => Some(other.ahead),
        (false, false) => {
            let across = centre(other).minus(centre(one));
            (across.dot(across) > 0.0).then(|| across.left())
        }
    }
}

#[cfg(test)]
mod tests;
