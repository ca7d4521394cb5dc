//! Slits across strips, so that these come out in pieces.

use super::strips::Strips;
use core::f64::consts::FRAC_PI_2;
use vcutc_region::piece::Piece;
use vcutc_region::slits::{Begin, Slit, SlitPiece};

/// Slits along lines across rows.
pub(super) fn over(lines: &[Piece]) -> Vec<Slit> {
    let slits = lines
        .iter()
        .map(|&line| super::strips::upright(vec![line], Begin::Within));
    slits.collect()
}

/// Slits across the strips along walls, each from the slit farther in to the one farther out, with the leading edge upright: nothing of the
/// blade is beyond its tip there, and a wall may be.
pub(super) fn along(strips: &Strips<'_>) -> Vec<Slit> {
    let measures = strips.measures;
    let leading = FRAC_PI_2 + measures.half_apex;
    let mut slits = Vec::new();
    for number in 0..strips.rings {
        // From the outer slit, or that along the walls, which lies a little farther out.
        let wide = measures.step + if number == 0 { measures.farther_out() } else { 0.0 };
        for way in strips.slit(number + 1) {
            for (piece, share) in places(&way, measures.chip) {
                let from = piece.at(share);
                let to = from.plus(piece.direction(share).left().times(-wide));
                slits.push(Slit {
                    pieces: vec![SlitPiece {
                        way: Piece::line(from, to),
                        rakes: [leading; 2],
                    }],
                    begins: Begin::Within,
                });
            }
        }
    }
    slits
}

/// Places of a way that are no farther apart than this, in mm, and not in its corners: pieces, and shares of them.
fn places(way: &[Piece], apart: f64) -> Vec<(Piece, f64)> {
    let long: f64 = way.iter().map(|piece| piece.length()).sum();
    // The cast saturates, and ways are a few metres long.
    let parts = libm::ceil(long / apart).clamp(1.0, 10_000.0) as u32;
    let mut places = Vec::new();
    for part in 1..parts {
        let mut left = long * f64::from(part) / f64::from(parts);
        for piece in way {
            let own = piece.length();
            if left <= own {
                // Corners turn to the left; their beginning is the end of the straight wall before.
                let share = if piece.sweep > 0.0 { 0.0 } else { left / own };
                places.push((*piece, share));
                break;
            }
            left -= own;
        }
    }
    places
}
