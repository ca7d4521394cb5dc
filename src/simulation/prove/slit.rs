//! What slits along the walls of a region do, as a proof finds it.

use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;

/// What the slits of an operation do. Found from the program where the region is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slit {
    pub operation: OperationId,
    /// How many slits there are.
    pub slits: usize,
    /// How long they are, together.
    pub way: Length,
    /// The least distance between a side of the blade and a wall.
    pub to_wall: Length,
    /// How much stays at the foot of walls at most, beyond what must: an upper bound.
    pub stays: Length,
    /// The same in corners below a right angle, which a blade with a thickness does not fill.
    pub in_corners: Length,
    /// The longest edge that is used.
    pub edge: Length,
}

/// What can be wrong with slits along walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SlitFault {
    /// The blade enters a wall, or leaves the region other than by an open side.
    Wall {
        /// How far.
        by: Length,
    },
    /// The blade goes below the floor.
    Floor {
        /// How far.
        by: Length,
    },
    /// The plane of the blade is not upright, or it goes neither level nor straight down.
    Strays,
    /// The blade has not enough edge.
    Edge { needed: Length, available: Length },
    /// The body of the blade meets the top of the stock.
    Body {
        /// How far above its tip.
        above: Length,
        /// How deep.
        by: Length,
    },
    /// More stays at the foot of a wall than may.
    Stays { by: Length, limit: Length },
    /// The walls are too many to say what stays.
    Undecided,
}
