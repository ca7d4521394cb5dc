//! How a straight blade is held in a cut.

use super::SAME;
use crate::geometry::Orientation;
use crate::ir::{Edges, Flank, Straight};

/// Swings this small, in rad, are 0.
pub const UPRIGHT: f64 = 1e-9;

/// Whether a cut along `dy` holds the blade as its flank wants, with an edge in front.
pub(super) fn posture_fits(blade: Straight, held: Orientation, flank: Flank, dy: f64) -> bool {
    let m = held.matrix();
    // Tip to shank is -z_t.
    let (lean_x, lean_y, lean_z) = (-m[0][2], -m[1][2], -m[2][2]);
    // A flank of swing 0, a wall, leans to neither side but for rounding.
    let to_its_side = match flank {
        Flank::Left => lean_x <= UPRIGHT,
        Flank::Right => lean_x >= -UPRIGHT,
    };
    let edge_leads = match blade.edges {
        Edges::Double => true,
        Edges::Single => m[1][0] * dy > 0.0,
    };
    // The blade plane holds the feed direction: its normal y_t is square to y.
    let in_plane = m[1][1].abs() < 1e-9;
    to_its_side && lean_y * dy >= -SAME && lean_z > 0.0 && edge_leads && in_plane
}
