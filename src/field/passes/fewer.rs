//! Fewer and longer arcs along a line.
//!
//! The arcs of lines follow them to a few micrometres and are short. A program has its places in whole micrometres, and a short
//! arc through rounded places leaves its direction: a machine would stop there. Passes need not follow the field as closely.

use crate::biarc::{Biarc, Knot};
use crate::wall::angle;
use vcutc_region::curve::Curve;
use vcutc_region::piece::Piece;

/// How far arcs may be off the pieces that they replace, in mm.
pub(crate) const OFF: f64 = 0.01;

/// Arcs do not turn further, in rad.
const FARTHEST: f64 = 1.2;

/// Pieces that two arcs replace at most.
const MOST_REPLACED: usize = 256;

/// Pieces that meet at more than this, in rad, are not replaced together.
const KINK: f64 = 1e-3;

/// Tangent arcs along a chain of pieces.
pub(super) fn fewer(pieces: &[Piece]) -> Vec<Piece> {
    let mut found = Vec::new();
    let smooth = |one: &Piece, next: &Piece| angle(one.direction(1.0), next.direction(0.0)).abs() <= KINK;
    for run in pieces.chunk_by(smooth) {
        let mut rest = run;
        while !rest.is_empty() {
            let (count, arcs) = longest(rest);
            match arcs {
                Some(arcs) => found.extend(arcs),
                None => found.extend(rest.first()),
            }
            rest = rest.get(count..).unwrap_or_default();
        }
    }
    found
}

/// How many of the first pieces two arcs replace, and these arcs; one piece stays where none do.
fn longest(pieces: &[Piece]) -> (usize, Option<[Piece; 2]>) {
    let most = pieces.len().min(MOST_REPLACED);
    let (mut count, mut best) = (1, None);
    let mut step = 2;
    let mut is_growing = true;
    // Twice as many as long as they follow, then by halves.
    while step > 0 {
        let next = count + step;
        let arcs = (next <= most).then(|| replaced(pieces, next)).flatten();
        match arcs {
            Some(arcs) => {
                (count, best) = (next, Some(arcs));
                if is_growing {
                    step *= 2;
                }
            }
            None => {
                is_growing = false;
                step /= 2;
            }
        }
    }
    (count, best)
}

/// Two arcs for the first pieces, so many of them, if they follow them.
fn replaced(pieces: &[Piece], count: usize) -> Option<[Piece; 2]> {
    let span = pieces.get(..count)?;
    let (first, last) = span.first().zip(span.last())?;
    let from = Knot {
        place: first.from,
        along: first.direction(0.0),
    };
    let to = Knot {
        place: last.to,
        along: last.direction(1.0),
    };
    let pair = Biarc::new(from, to);
    let arcs = pair.sound().filter(|_| !pair.turns_further(FARTHEST))?;
    let curves = arcs.map(Curve::of);
    let is_by = |place| curves.iter().any(|curve| curve.distance(place) <= OFF);
    let follows = span.iter().all(|piece| is_by(piece.at(0.5)) && is_by(piece.to));
    follows.then_some(arcs)
}
