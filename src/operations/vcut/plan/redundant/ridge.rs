//! What stands where a V is skipped, and how the Vs after it take it away.

use crate::plan::PlannedCut;
use crate::plan::chip::{Chip, entering};
use crate::plan::parameters::VcutParameters;
use core::ops::RangeInclusive;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// The material that a skipped V would have taken, as far as it still stands: between the points where its flanks would come out.
pub(super) struct Ridge<'p> {
    parameters: &'p VcutParameters,
    skipped: Vee,
    stretch: RangeInclusive<f64>,
    /// The surface over the stretch.
    surface: Surface,
    /// As high as it is anywhere, in mm.
    highest: f64,
}

impl<'p> Ridge<'p> {
    /// That of a V which finds this surface.
    pub(super) fn new(parameters: &'p VcutParameters, skipped: Point2, found: &mut Surface) -> Self {
        let skipped = Vee::even(skipped, parameters.flanks.slope);
        let [from, to] = [Side::Left, Side::Right].map(|side| found.flank(skipped, side).exit.x);
        let surface = found.part(from, to);
        Self {
            parameters,
            skipped,
            stretch: from..=to,
            highest: surface.corners().map(|corner| corner.z).fold(0.0, f64::max),
            surface,
        }
    }

    /// The Vs of a layer whose chips it may be part of.
    pub(super) fn reached_by<'c>(
        &self,
        layer: &'c [PlannedCut],
    ) -> impl Iterator<Item = &'c PlannedCut> + Clone + use<'c> {
        let flanks = self.parameters.flanks;
        let (from, to, highest) = (*self.stretch.start(), *self.stretch.end(), self.highest);
        let within = flanks.reach.to_mm() / flanks.slope;
        let first = layer.partition_point(|cut| cut.tip.x + within < from);
        let near = layer.get(first..).unwrap_or_default().iter();
        near.take_while(move |cut| cut.tip.x - within <= to)
            .filter(move |cut| {
                let lowest = flanks.lowest(Vee::even(cut.tip, flanks.slope));
                lowest.height(cut.tip.x.clamp(from, to)) < highest
            })
    }

    /// Whether the chips of all these Vs come free beside it, as far as they lie over its stretch: elsewhere they are what they were.
    pub(super) fn lets_free<'c>(&mut self, mut cuts: impl Iterator<Item = &'c PlannedCut>) -> bool {
        cuts.all(|cut| {
            let chip = Chip::of(self.parameters, cut.tip).over(&self.stretch);
            chip.comes_free(&mut self.surface)
        })
    }

    /// What still stands once Vs have been cut; none where nothing does.
    pub(super) fn after<'c>(mut self, cuts: impl Iterator<Item = &'c PlannedCut>) -> Option<Self> {
        let mut is_cut = false;
        for cut in cuts {
            let vee = Vee::even(cut.tip, self.parameters.flanks.slope);
            self.surface.release(entering(vee, &self.stretch));
            is_cut = true;
        }
        if !is_cut {
            return Some(self);
        }
        let tip = self.skipped.tip;
        let stands = self.surface.covers(tip);
        stands.then(|| Self::new(self.parameters, tip, &mut self.surface))
    }

    /// The surface over its stretch, and what that would be had the V been cut. Flanks of one slope take the same away in any
    /// order.
    pub(super) fn contours(mut self) -> [Vec<Point2>; 2] {
        let standing = self.surface.corners().collect();
        self.surface.release(self.skipped);
        [standing, self.surface.corners().collect()]
    }
}
