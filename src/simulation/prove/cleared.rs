//! What the passes of a round tool over a region do, as a proof finds it.

use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Angle, Area, Length};

/// What the passes of an operation clear of a region. Found from the program where the region is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cleared {
    pub operation: OperationId,
    /// In how many layers.
    pub layers: usize,
    /// How many lines and arcs the passes are, in all layers.
    pub pieces: usize,
    /// How long they are, in all layers.
    pub way: Length,
    /// The least distance between the edge of the tool and a wall.
    pub to_wall: Length,
    /// How much ground stays uncut in a layer at most, of what a tool of its radius reaches.
    pub uncut: Area,
    /// The widest place of it.
    pub widest: Length,
    /// How much ground no tool of its radius reaches.
    pub beyond_reach: Area,
    /// The mean angle of the tool's rim in the material.
    pub mean_engagement: Angle,
    /// The largest one of passes that are not the first in uncut ground.
    pub engagement: Angle,
    /// What stands of ground that a disc frees; none of what a crusher shreds.
    pub standing: Option<Standing>,
}

/// What stands of a layer that a disc freed: mostly corners of walls that are sharper than its rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// An upper bound, without what slits leave at the foot of walls.
    pub area: Area,
    /// In how many places.
    pub pillars: usize,
}

/// What can be wrong with passes over a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClearingFault {
    /// The tool enters a wall, or leaves the region other than by an open side.
    Wall {
        /// How far.
        by: Length,
    },
    /// The tool goes below the floor.
    Floor {
        /// How far.
        by: Length,
    },
    /// The tool does not stand upright.
    Leans,
    /// The program goes straight down into a hole that the job does not name.
    Unopened,
    /// A layer is thicker than the tool can cut.
    Thick {
        /// How thick it is.
        layer: Length,
        /// How much the tool can cut.
        limit: Length,
    },
    /// The body of the tool meets a wall.
    Body {
        /// How far above its tip.
        above: Length,
        /// How deep.
        by: Length,
    },
    /// More ground stays uncut than may.
    Uncut {
        area: Area,
        /// In how many places.
        places: usize,
        /// The widest of them.
        widest: Length,
        limit: Area,
    },
    /// The shank of a disc, with the air that it keeps, meets ground that was not freed before.
    Shank {
        /// How far.
        by: Length,
    },
    /// More ground than corners of walls stands where a disc freed all that it frees: slits do not part it, or no pass undercuts it.
    Attached { area: Area, limit: Area },
    /// More stands in corners of walls than may: the rim of a disc does not reach it.
    Pillars { area: Area, limit: Area },
    /// More of the tool's rim is in the material than may be.
    Engaged { angle: Angle, limit: Angle },
    /// Its passes are too many, or too entangled, to say what they clear.
    Undecided,
}
