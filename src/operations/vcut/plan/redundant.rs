//! Redundant Vs: without one of them every other chip still comes free, and no more material stays than the limit allows
//! (`docs/process.md`, "Redundant Vs").
//!
//! A lattice is as fine everywhere as the part needs it somewhere. Its Vs are looked at one after the other, from the last layer
//! up and each layer from the right, and each is skipped that the others do without. What it would have taken then stays between
//! the points where its flanks would have come out, and nowhere else: where nothing is steeper than the flanks, one that runs
//! out beyond that stretch meets the same point of the surface as before. So only the surface over the stretch is kept, and only Vs
//! that can reach into it are looked at again.

mod ridge;
#[cfg(test)]
mod tests;

use super::chip::in_layers;
use super::parameters::VcutParameters;
use super::{PlannedCut, PlannedVcut};
use ridge::Ridge;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Area, Length};
use vcutc_geometry::profile::Profile;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::report::area_under;
use vcutc_simulation::surface::{Surface, Vee};

/// What else may stay.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowed {
    /// Nowhere on the part more than this.
    pub(crate) height: Length,
    /// So much more than all Vs leave, in all.
    pub(crate) area: Area,
}

/// An operation of regular Vs without its redundant ones; none where it needs them all, or where all of what it finds may stay.
/// `before` is the surface that it finds, nowhere steeper than its flanks.
pub(crate) fn without_redundant(
    vcut: &PlannedVcut,
    allowed: Allowed,
    part: &Profile,
    before: &Surface,
    stock: Stock,
) -> Option<PlannedVcut> {
    let thinning = Thinning {
        parameters: &vcut.parameters,
        part,
        limit: allowed.height,
    };
    let needed = thinning.needed(&vcut.cuts, before, allowed.area.to_mm2());
    let count: usize = needed.iter().map(Vec::len).sum();
    let skipped = vcut.cuts.len() - count;
    (skipped > 0 && count > 0).then(|| {
        let thinned = PlannedVcut {
            cuts: in_layers(&vcut.parameters, needed, &mut before.clone()),
            skipped,
            ..vcut.clone()
        };
        thinned.along(vcut.order, vcut.sequence, before, stock)
    })
}

struct Thinning<'p> {
    parameters: &'p VcutParameters,
    part: &'p Profile,
    limit: Length,
}

impl Thinning<'_> {
    /// The Vs that are needed, layer by layer, while so much more may stay, in mm2.
    fn needed(&self, cuts: &[PlannedCut], before: &Surface, mut room: f64) -> Vec<Vec<PlannedCut>> {
        let mut surface = before.clone();
        let mut above: Vec<(Surface, &[PlannedCut])> = Vec::new();
        for layer in cuts.chunk_by(|one, next| one.layer == next.layer) {
            above.push((surface.clone(), layer));
            self.release(&mut surface, layer);
        }
        // The nearest last.
        let mut below: Vec<Vec<PlannedCut>> = Vec::new();
        while let Some((mut surface, layer)) = above.pop() {
            let mut layer = layer.to_vec();
            for place in (0..layer.len()).rev() {
                let skipped = layer.remove(place);
                let ridge = Ridge::new(self.parameters, skipped.tip, &mut surface);
                match self.left_standing(ridge, layer.split_at(place), &below) {
                    Some(left) if left <= room => room -= left,
                    Some(_) | None => layer.insert(place, skipped),
                }
            }
            if !layer.is_empty() {
                below.push(layer);
            }
        }
        below.reverse();
        below
    }

    /// How much of a ridge stays in the end, with these others in its layer before and after it, and those below, in mm2; none where a
    /// chip does not come free beside it, or too much stays.
    fn left_standing(
        &self,
        mut ridge: Ridge<'_>,
        (before, after): (&[PlannedCut], &[PlannedCut]),
        below: &[Vec<PlannedCut>],
    ) -> Option<f64> {
        // The neighbours first: they hardly ever leave anything to the others.
        let (left, neighbour_left) = before.split_at(before.len().saturating_sub(1));
        let (neighbour_right, right) = after.split_at(after.len().min(1));
        for others in [neighbour_left, neighbour_right, left, right] {
            let reaching = ridge.reached_by(others);
            match ridge.after(reaching) {
                Some(standing) => ridge = standing,
                None => return Some(0.0),
            }
        }
        for layer in below.iter().rev() {
            let reaching = ridge.reached_by(layer);
            if !ridge.lets_free(reaching.clone()) {
                return None;
            }
            match ridge.after(reaching) {
                Some(standing) => ridge = standing,
                None => return Some(0.0),
            }
        }
        let [standing, cut] = ridge.contours();
        let is_low = farthest(&standing, self.part).height <= self.limit;
        is_low.then(|| (area_under(&standing) - area_under(&cut)).max(0.0))
    }

    fn release(&self, surface: &mut Surface, cuts: &[PlannedCut]) {
        for cut in cuts {
            surface.release(self.vee(cut));
        }
    }

    const fn vee(&self, cut: &PlannedCut) -> Vee {
        Vee::even(cut.tip, self.parameters.flanks.slope)
    }
}
