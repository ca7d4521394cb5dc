//! The room that ways at depth have.

use vcutc_region::distance::Walls;
use vcutc_region::piece::Piece;

/// What ways at depth must keep from, in mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room<'r> {
    pub(super) walls: &'r Walls,
    /// The stock along x and y.
    pub(super) stock: [f64; 2],
    /// Air between the tool and the stock beside open sides.
    pub(super) run_out: f64,
    /// How far the centre of the tool keeps from walls on ways between passes: less than on these, so that they may be chords, but with
    /// room for the rounding of their ends.
    pub(super) keep: f64,
    /// The distance of passes.
    pub(super) step: f64,
    /// The radius of the tool.
    pub(super) radius: f64,
    /// The steepest way down, in rad.
    pub(super) ramp: f64,
}

impl Room<'_> {
    /// Whether a way keeps off all walls.
    pub(super) fn is_free(&self, line: Piece) -> bool {
        let nearest = self.walls.nearest_to(line);
        nearest.is_none_or(|(_, near)| near.distance >= self.keep)
    }
}
