//! How near passes come to walls.
//!
//! Distances of lines and arcs from each other are closed forms, so the least distance is exact up to rounding: no sampling can
//! miss a pass that is a micrometre too near.

use crate::boxes::{Extent, Tree};
use crate::curve::{Curve, crossings};
use crate::distance::Walls;
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Inside, Region};
use crate::rounded::share;

/// What is nearest to a wall, of all passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// How near, in mm.
    pub distance: f64,
    /// The pass, counted from 0 in the order of cutting.
    pub pass: usize,
    /// Its piece, counted from 0.
    pub piece: usize,
    /// The place on that piece.
    pub on_pass: Place,
    /// The place on the wall.
    pub on_wall: Place,
    /// Which of [`Region::edges`] the wall is.
    pub wall: usize,
}

/// How passes keep clear of what stands around a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The least distance of a pass from a wall; none where there are no walls, or no passes.
    pub least: Option<Approach>,
    /// The passes without a place in the region. One that has some, and keeps a distance from all walls, has left the region
    /// through open sides only.
    pub astray: Vec<usize>,
}

/// Finds where passes come nearest to walls, and whether they lie in the region.
#[must_use]
pub fn clearance(region: &Region, passes: &[Pass]) -> Clearance {
    let walls = Walls::of(region);
    let inside = Inside::of(region);
    let edges: Vec<Curve> = region.edges().map(|edge| Curve::of(edge.piece)).collect();
    let extents: Vec<Extent> = edges.iter().map(Curve::extent).collect();
    let tree = Tree::of(&extents);
    let runs_through = |piece: Piece| {
        let curve = Curve::of(piece);
        let mut crossed = vec![0.0, 1.0];
        tree.meeting(curve.extent(), &mut |edge| {
            if let Some(edge) = edges.get(edge as usize) {
                let places = crossings(&curve, edge).into_iter().flatten();
                crossed.extend(places.map(|at| share(&curve, at)));
            }
        });
        has_middle_within(&inside, piece, crossed)
    };
    let mut least: Option<Approach> = None;
    let mut astray = Vec::new();
    for (number, pass) in passes.iter().enumerate() {
        for (place, &piece) in pass.pieces.iter().enumerate() {
            if let Some((on_pass, nearest)) = walls.nearest_to(piece)
                && least.is_none_or(|least| nearest.distance < least.distance)
            {
                least = Some(Approach {
                    distance: nearest.distance,
                    pass: number,
                    piece: place,
                    on_pass,
                    on_wall: nearest.at,
                    wall: nearest.edge,
                });
            }
        }
        let mut pieces = pass.pieces.iter();
        let begins_within = pieces.any(|&piece| inside.contains(piece.from) || inside.contains(piece.to));
        if !begins_within && !pass.pieces.iter().any(|&piece| runs_through(piece)) {
            astray.push(number);
        }
    }
    Clearance { least, astray }
}

/// Whether a piece has a place within a region in the middle between two crossings with its boundary. If it has any, with both
/// ends outside, then one of those.
fn has_middle_within(inside: &Inside, piece: Piece, mut crossed: Vec<f64>) -> bool {
    crossed.retain(|share| (0.0..=1.0).contains(share));
    crossed.sort_unstable_by(f64::total_cmp);
    let mut middles = crossed.windows(2).map(|pair| pair.iter().sum::<f64>() / 2.0);
    middles.any(|share| inside.contains(piece.at(share)))
}

#[cfg(test)]
mod tests;
