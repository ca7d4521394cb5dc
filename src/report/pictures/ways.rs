//! Lines and arcs of the plan as points of a picture.

use vcutc_region::piece::Piece;

/// How far points of arcs lie apart, in mm.
const APART: f64 = 0.5;

/// Points of a piece, close enough for a picture.
#[must_use]
pub(super) fn points(piece: Piece) -> Vec<[f64; 2]> {
    let count = match piece.radius() {
        None => 1,
        // A picture has no more points than it has places.
        Some(_) => (piece.length() / APART).ceil().clamp(2.0, 500.0) as u32,
    };
    let places = (0..=count).map(|k| piece.at(f64::from(k) / f64::from(count)));
    places.map(|at| [at.x, at.y]).collect()
}
