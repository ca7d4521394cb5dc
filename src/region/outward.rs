//! Ways moved outwards: the boundary of all that lies within a distance of what they bound.
//!
//! A round tool of a radius whose centre keeps to what a level bounds reaches what lies within its radius of that, and no more: the
//! opening of the region. So the ways of a level moved outwards have no inward corner that is sharper than the distance by which they
//! are moved.

use crate::curve::Curve;
use crate::piece::Piece;

/// Corners that turn by less, in rad, do not count.
const STRAIGHT: f64 = 1e-6;

/// Arcs of a smaller radius are left out, in mm.
const LEAST: f64 = 1e-6;

/// A way, with what it bounds to its left, moved to its right by a distance in mm: inward corners become arcs about them. Arcs about
/// what is to the right of them have a larger radius.
#[must_use]
pub fn outward(way: &[Piece], by: f64) -> Vec<Piece> {
    let curves: Vec<Curve> = way.iter().map(|&piece| Curve::of(piece)).collect();
    let is_closed = way.first().zip(way.last());
    let is_closed = is_closed.is_some_and(|(first, last)| first.from == last.to);
    let mut moved: Vec<Piece> = Vec::with_capacity(2 * way.len());
    for (place, curve) in curves.iter().enumerate() {
        let Some(piece) = curve.moved(-by, LEAST).map(|curve| curve.piece) else {
            continue;
        };
        push(&mut moved, piece);
        let next = match curves.get(place + 1) {
            Some(next) => Some(next),
            None => curves.first().filter(|_| is_closed),
        };
        if let Some((next, begin)) = next.and_then(|next| Some((next, next.moved(-by, LEAST)?))) {
            let turn = libm::atan2(curve.arrival.cross(next.ahead), curve.arrival.dot(next.ahead));
            if turn > STRAIGHT {
                push(&mut moved, Piece::arc(piece.to, begin.piece.from, turn));
            }
        }
    }
    if is_closed && let (Some(end), Some(first)) = (moved.last().map(|last| last.to), moved.first_mut()) {
        first.from = end;
    }
    moved
}

/// Appends a piece, which begins where the last one ends.
fn push(pieces: &mut Vec<Piece>, piece: Piece) {
    let from = pieces.last().map_or(piece.from, |last| last.to);
    let piece = Piece { from, ..piece };
    if piece.from.distance(piece.to) > LEAST {
        pieces.push(piece);
    }
}

/// The arcs of a way moved outwards that stand for its inward corners.
#[must_use]
pub fn corners(way: &[Piece], by: f64) -> Vec<Piece> {
    let curves: Vec<Curve> = way.iter().map(|&piece| Curve::of(piece)).collect();
    let is_closed = way.first().zip(way.last());
    let is_closed = is_closed.is_some_and(|(first, last)| first.from == last.to);
    let next = curves.iter().skip(1).chain(curves.first().filter(|_| is_closed));
    let pairs = curves.iter().zip(next);
    let arcs = pairs.filter_map(|(one, next)| {
        let turn = libm::atan2(one.arrival.cross(next.ahead), one.arrival.dot(next.ahead));
        let (from, to) = (one.moved(-by, LEAST)?, next.moved(-by, LEAST)?);
        (turn > STRAIGHT).then(|| Piece::arc(from.piece.to, to.piece.from, turn))
    });
    arcs.collect()
}

#[cfg(test)]
mod tests;
