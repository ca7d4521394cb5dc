//! The slits of a group of layers: only where a strip does not end at what lies as low already.
//!
//! Two strips side by side share their slit, and it goes down to the lower one's floor: whichever comes out first, the other one
//! stands beside it until then. Where a neighbour lies at or below the floor, at the sides of the stock and beside walls, none is
//! cut, nor where an operation before has left less of the strip itself. So `n` strips in a row need `n - 1` slits, `n` with a wall at one end and `n + 1` with two *(derived here)*.

use super::Slit;
use super::blades::{Knife, TOUCH};
use super::ground::{Ground, highest};
use super::layout::Piece;
use super::terrain::Terrain;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::surface::Side;

/// Whether slits go through one layer or more at once. Those need columns that stay where they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Through {
    One,
    Several,
}

/// The slits of a group of layers from left to right. The terrain is what stands before, and then what its strips leave.
pub(crate) fn of_group(ground: &Ground<'_>, group: &[Piece], terrain: &mut Terrain) -> Vec<Slit> {
    let before = terrain.clone();
    let mut feet: Vec<(f64, f64)> = Vec::new();
    for layer in group.chunk_by(|one, next| one.layer == next.layer) {
        for Piece { extent, .. } in layer {
            let stands = ground.stands(extent.floor);
            for (x, side) in [(extent.left, Side::Left), (extent.right, Side::Right)] {
                let stands_at = |side| {
                    terrain
                        .beside(x, side)
                        .is_some_and(|height| height > stands + TOUCH)
                };
                if stands_at(side) && stands_at(side.opposite()) {
                    feet.push((x, ground.slit_bottom(extent.floor)));
                }
            }
        }
        for Piece { extent, .. } in layer {
            terrain.lower(extent.left, extent.right, ground.stands(extent.floor));
        }
    }
    feet.sort_by(|(x, z), (other, low)| x.total_cmp(other).then(z.total_cmp(low)));
    // Of several at one place the deepest, which comes first.
    feet.dedup_by(|(x, z), (first, lowest)| {
        let same = *x - *first <= TOUCH;
        if same {
            *lowest = lowest.min(*z);
        }
        same
    });
    let slits = feet.into_iter().map(|(x, bottom)| {
        let sides = [Side::Left, Side::Right].map(|side| before.beside(x, side));
        let top = sides.into_iter().flatten().fold(bottom, f64::max);
        let uncut = sides.into_iter().flatten().fold(top, f64::min);
        Slit {
            x,
            bottom,
            uncut,
            top,
        }
    });
    slits.collect()
}

/// How far the part reaches above the bottom of a slit, over the thickness of the blade in it; none where it stays clear.
#[must_use]
pub fn entry(slit: Slit, bound: &Profile, knife: &Knife) -> Option<f64> {
    let standoff = knife.standoff.to_mm();
    let entry = highest(bound, slit.x - standoff, slit.x + standoff) - slit.bottom;
    (entry > TOUCH).then_some(entry)
}
