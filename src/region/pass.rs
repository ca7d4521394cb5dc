//! Passes: the ways of a tool's centre over a region.

use crate::piece::Piece;

/// One way of the centre of a tool, without a stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// How many passes lie between it and the walls: 0 for the one next to them.
    pub level: u32,
    /// Its lines and arcs, at least one, each beginning where the one before it ends.
    pub pieces: Vec<Piece>,
}

impl Pass {
    /// Whether it ends where it begins.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let ends = self.pieces.first().zip(self.pieces.last());
        ends.is_some_and(|(first, last)| first.from == last.to)
    }

    /// Its length, in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length()).sum()
    }
}
