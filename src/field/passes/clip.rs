//! Lines run out beyond open sides, and cut where they come too near to walls.

use vcutc_region::distance::Walls;
use vcutc_region::piece::Piece;

/// Ends of lines lie on open sides within this, in mm: they are where chords of lines cross them, moved onto the lines.
const ON_SIDE: f64 = 0.05;

/// Lines that leave an open side more slantwise than this cosine run out as if they did not.
const SLANT: f64 = 0.25;

/// Parts of a line this short, in mm, or this share of their piece, are given up as a whole where they come too near to a wall.
const FINEST: f64 = 0.02;
const FINEST_SHARE: f64 = 1.0 / 4096.0;

/// Pieces of a line, led straight on beyond open sides where it ends there, until its ends are so far from them, in mm.
pub(super) fn run_out(pieces: &[Piece], open: &Walls, reach: f64) -> Vec<Piece> {
    let last = pieces.last().and_then(|piece| beyond(*piece, open, reach));
    let first = pieces
        .first()
        .and_then(|piece| beyond(piece.reversed(), open, reach))
        .map(Piece::reversed);
    let is_closed = pieces
        .first()
        .zip(pieces.last())
        .is_some_and(|(first, last)| first.from == last.to);
    if is_closed {
        return pieces.to_vec();
    }
    first
        .into_iter()
        .chain(pieces.iter().copied())
        .chain(last)
        .collect()
}

/// The line on from the end of a piece that lies on an open side.
fn beyond(piece: Piece, open: &Walls, reach: f64) -> Option<Piece> {
    let nearest = open.nearest_within(piece.to, ON_SIDE)?;
    let (_, side) = open.curves().find(|(edge, _)| *edge == nearest.edge)?;
    let ahead = piece.direction(1.0);
    // The region lies to the left of its edges.
    let out = side.direction(nearest.at).left().times(-1.0);
    let length = (reach + nearest.distance) / ahead.dot(out).max(SLANT);
    Some(Piece::line(piece.to, piece.to.plus(ahead.times(length))))
}

/// The parts of a chain of pieces that keep a distance from all walls, in mm.
pub(super) fn kept(pieces: &[Piece], walls: &Walls, distance: f64) -> Vec<Vec<Piece>> {
    let mut chains: Vec<Vec<Piece>> = Vec::new();
    for &piece in pieces {
        let finest = FINEST.max(FINEST_SHARE * piece.length());
        let mut open = vec![piece];
        while let Some(piece) = open.pop() {
            let nearest = walls
                .nearest_to(piece)
                .map_or(f64::INFINITY, |(_, nearest)| nearest.distance);
            if nearest >= distance {
                match chains.last_mut() {
                    Some(chain) if chain.last().is_some_and(|last| last.to == piece.from) => {
                        chain.push(piece);
                    }
                    _ => chains.push(vec![piece]),
                }
            } else if !is_all_nearer(piece, walls, distance, finest) {
                let middle = piece.at(0.5);
                let half = piece.sweep / 2.0;
                let halves = [
                    Piece::arc(piece.from, middle, half),
                    Piece::arc(middle, piece.to, half),
                ];
                open.extend(halves.into_iter().rev());
            }
        }
    }
    // Around the beginning of a closed line that was cut elsewhere.
    let ends = |chains: &[Vec<Piece>]| {
        let first = chains.first()?.first()?;
        Some(first.from == chains.last()?.last()?.to)
    };
    if chains.len() > 1 && ends(&chains) == Some(true) {
        let mut last = chains.pop().unwrap_or_default();
        if let Some(first) = chains.first_mut() {
            last.append(first);
            *first = last;
        }
    }
    chains
}

/// Whether no place of a piece keeps a distance from the walls, or it is too short to be looked at in parts.
fn is_all_nearer(piece: Piece, walls: &Walls, distance: f64, finest: f64) -> bool {
    let length = piece.length();
    // Not a number is too short as well.
    let is_long = length > finest;
    !is_long || walls.distance(piece.at(0.5)) + length / 2.0 < distance
}
