//! What the replay of straight cuts does not show of an operation: how it is judged from a finished program, and how it looks from
//! above.

use crate::PlannedJob;
use vcutc_backend_api::ir::{OperationId, Program};
use vcutc_region::coverage::Square;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// An operation of a finished program, as its own proof sees it.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'j> {
    /// What the program was planned for. A proof takes the part from it, the spine that cuts follow, and what its operation is held to.
    pub plan: &'j PlannedJob,
    pub program: &'j Program,
    pub operation: OperationId,
}

/// The cuts of an operation from above, as its program states them.
#[derive(Clone, Debug, Default)]
pub struct FromAbove {
    pub walls: Vec<Piece>,
    /// Sides without a wall.
    pub open: Vec<Piece>,
    /// Slits along walls, each as the way of its tip.
    pub slits: Vec<Vec<Piece>>,
    /// Stretches of passes of the first layer, each with the angle of the rim in the material, in rad.
    pub stretches: Vec<(Piece, f64)>,
    /// Where passes begin.
    pub entries: Vec<Place>,
    /// What stays uncut.
    pub uncut: Vec<Square>,
}
