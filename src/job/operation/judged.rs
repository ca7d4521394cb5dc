//! What the replay of straight cuts does not show of an operation: how it is judged from a finished program, and how it looks from
//! above.

use crate::PlannedJob;
use vcutc_backend_api::ir::{OperationId, Program};
use vcutc_backend_api::units::Angle;
use vcutc_region::coverage::{Spot, Square};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_surface::map::Band;

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
    /// What of the ground stays, place by place.
    pub stays: Vec<Stays>,
}

/// A place of the ground that stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Stays {
    pub spot: Spot,
    pub why: WhyItStays,
}

/// Why a place stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhyItStays {
    /// No pass cuts it.
    Uncut,
    /// No tool of its radius gets there.
    BeyondReach,
}

/// How far the axis of a disc leans from the normal of the part while it finishes it: the tilt, from above.
#[derive(Clone, Debug, PartialEq)]
pub struct Tilts {
    /// What each track finishes, with the tilt along it.
    pub bands: Vec<Band>,
    /// The tilt where the lead is as great as the job allows; none where the job gives the lead.
    pub limit: Option<TiltLimit>,
}

/// The greatest tilt that a limit on the lead allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltLimit {
    /// The limit on the lead.
    pub lead: Angle,
    /// The tilt with it, which a side tilt makes larger.
    pub tilt: Angle,
}
