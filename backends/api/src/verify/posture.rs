//! How a blade is held in a cut, and how far its edges lie along y.

use super::SAME;
use crate::geometry::Orientation;
use crate::ir::{Blade, Edges, Flank, OrientationId, ToolId};
use crate::units::Length;

/// How far the edges of a blade lie along y in a posture: a program has a handful of postures for all its ops.
pub(super) struct Overhangs(Vec<((ToolId, OrientationId), [Length; 2])>);

impl Overhangs {
    pub(super) const NONE_YET: Self = Self(Vec::new());

    /// Programs of more postures than a few compute the rest anew, so that looking never takes long.
    const MOST: usize = 32;

    pub(super) fn of(
        &mut self,
        key: (ToolId, OrientationId),
        blade: &Blade,
        held: Orientation,
    ) -> [Length; 2] {
        if let Some((_, known)) = self.0.iter().find(|(known, _)| *known == key) {
            return *known;
        }
        let found = overhangs(blade, held);
        if self.0.len() < Self::MOST {
            self.0.push((key, found));
        }
        found
    }
}

/// How far the edges of a blade lie along y in a posture.
fn overhangs(blade: &Blade, held: Orientation) -> [Length; 2] {
    // The tool axis makes this angle with +y; both edges lie half the apex angle off it, in the blade's plane.
    let axis = libm::acos((-held.matrix()[1][2]).clamp(-1.0, 1.0));
    let half_apex = blade.half_apex.to_rad();
    [axis - half_apex, axis + half_apex].map(|angle| blade.cutting_length * libm::cos(angle))
}

/// Swings this small, in rad, are 0.
pub const UPRIGHT: f64 = 1e-9;

/// Whether a cut along `dy` holds the blade as its flank wants, with an edge in front.
pub(super) fn posture_fits(blade: &Blade, held: Orientation, flank: Flank, dy: f64) -> bool {
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
