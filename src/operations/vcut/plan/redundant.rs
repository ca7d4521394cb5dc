//! Redundant Vs: without one of them every other chip still comes free, and no more material stays than the limit allows
//! (`docs/process.md`, "Redundant Vs").
//!
//! A lattice is as fine everywhere as the part needs it somewhere. Its Vs are looked at one after the other, from the last layer
//! up and each layer from the right, and each is skipped that the others do without. What it would have taken then stays between
//! the points where its flanks would have come out, and nowhere else: where nothing is steeper than the flanks, one that runs
//! out beyond that stretch meets the same point of the surface as before. So only Vs that can reach into the stretch are
//! looked at again, and the contour there.

use super::chip::{comes_free, way};
use super::parameters::VcutParameters;
use super::{PlannedCut, PlannedVcut, Way};
use core::ops::RangeInclusive;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Area, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::report::area_under;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// What may stay besides.
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
            cuts: thinning.numbered(needed, before.clone()),
            skipped,
            ..vcut.clone()
        };
        thinned.along(vcut.order, vcut.sequence, before, stock)
    })
}

/// How many half widths of a V others may be away from a stretch and still affect the flanks that reach into it: such a flank runs
/// out within two, and a V beyond that opens the surface within one more. What a V leaves that is not looked at stays in its own
/// opening, so it does not come nearer from layer to layer.
const AFFECTING: f64 = 3.0;

/// Points of surfaces this close are the same, in mm.
const ALIKE: f64 = 1e-9;

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
        while let Some((surface, layer)) = above.pop() {
            let mut layer = layer.to_vec();
            for place in (0..layer.len()).rev() {
                let skipped = layer.remove(place);
                match self.left_without(&skipped, surface.clone(), &layer, &below) {
                    Some(left) if left <= room => room -= left,
                    Some(_) | None => layer.insert(place, skipped),
                }
            }
            below.push(layer);
        }
        below.reverse();
        below
    }

    /// How much more stays in all without a V that finds this surface, with these others in its layer, and those below, in mm2; none
    /// where it is needed.
    fn left_without(
        &self,
        skipped: &PlannedCut,
        mut surface: Surface,
        others: &[PlannedCut],
        below: &[Vec<PlannedCut>],
    ) -> Option<f64> {
        let stretch = self.opening(skipped, &mut surface);
        self.release(&mut surface, self.near(others, &stretch, AFFECTING));
        let mut cut = surface.clone();
        cut.release(self.vee(skipped));
        for layer in below.iter().rev() {
            let reaching = self.near(layer, &stretch, 1.0);
            let mut chips = reaching.iter().map(|cut| cut.tip);
            if !chips.all(|tip| comes_free(self.parameters, &mut surface, tip)) {
                return None;
            }
            for surface in [&mut surface, &mut cut] {
                self.release(surface, self.near(layer, &stretch, AFFECTING));
            }
            if is_alike(&mut surface, &mut cut, &stretch) {
                return Some(0.0);
            }
        }
        let [left, before] = [&mut surface, &mut cut].map(|surface| {
            surface
                .stretch(*stretch.start(), *stretch.end())
                .collect::<Vec<Point2>>()
        });
        let is_low = farthest(&left, self.part).height <= self.limit;
        is_low.then(|| (area_under(&left) - area_under(&before)).max(0.0))
    }

    /// From where to where a V opens the surface.
    fn opening(&self, cut: &PlannedCut, surface: &mut Surface) -> RangeInclusive<f64> {
        let vee = self.vee(cut);
        let [left, right] = [Side::Left, Side::Right].map(|side| surface.flank(vee, side).exit.x);
        left..=right
    }

    /// The Vs of a layer whose tips are no farther from a stretch than so many half widths of the widest V.
    fn near<'c>(
        &self,
        layer: &'c [PlannedCut],
        stretch: &RangeInclusive<f64>,
        half_widths: f64,
    ) -> &'c [PlannedCut] {
        let flanks = &self.parameters.flanks;
        let within = half_widths * flanks.reach.to_mm() / flanks.slope;
        let from = layer.partition_point(|cut| cut.tip.x + within < *stretch.start());
        let to = layer.partition_point(|cut| cut.tip.x - within <= *stretch.end());
        layer.get(from..to).unwrap_or_default()
    }

    fn release(&self, surface: &mut Surface, cuts: &[PlannedCut]) {
        for cut in cuts {
            surface.release(self.vee(cut));
        }
    }

    const fn vee(&self, cut: &PlannedCut) -> Vee {
        Vee::even(cut.tip, self.parameters.flanks.slope)
    }

    /// The Vs of some layers with the ways between them, and with numbers for the layers that have any.
    fn numbered(&self, layers: Vec<Vec<PlannedCut>>, mut surface: Surface) -> Vec<PlannedCut> {
        let mut cuts = Vec::new();
        let layers = layers.into_iter().filter(|layer| !layer.is_empty());
        for (number, layer) in (1..).zip(layers) {
            let mut before: Option<Point2> = None;
            for cut in &layer {
                let way = before.map_or(Way::Over, |before| {
                    way(self.parameters, &mut surface, before, cut.tip)
                });
                cuts.push(PlannedCut {
                    layer: number,
                    way,
                    ..*cut
                });
                before = Some(cut.tip);
            }
            self.release(&mut surface, &layer);
        }
        cuts
    }
}

/// Whether two surfaces are the same over a stretch.
fn is_alike(one: &mut Surface, other: &mut Surface, stretch: &RangeInclusive<f64>) -> bool {
    let (from, to) = (*stretch.start(), *stretch.end());
    let is_near = |(a, b): (Point2, Point2)| (a.x - b.x).abs() <= ALIKE && (a.z - b.z).abs() <= ALIKE;
    let (mut one, mut other) = (one.stretch(from, to), other.stretch(from, to));
    loop {
        match (one.next(), other.next()) {
            (Some(a), Some(b)) if is_near((a, b)) => {}
            (None, None) => return true,
            (Some(_) | None, _) => return false,
        }
    }
}

#[cfg(test)]
mod tests;
