//! Whether the chip of a V comes free, and how the blade gets from one V to the next.

use super::parameters::VcutParameters;
use super::{PlannedCut, Way};
use core::ops::RangeInclusive;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// The chip of a V, and what it takes to free it.
pub(super) struct Chip {
    /// As low as it may lie.
    vee: Vee,
    /// How far above its tip the blade reaches.
    reach: f64,
    /// How high the chip may stand for the blade to turn beside it.
    highest: f64,
}

impl Chip {
    pub(super) fn of(parameters: &VcutParameters, tip: Point2) -> Self {
        let flanks = &parameters.flanks;
        Self {
            vee: flanks.lowest(Vee::even(tip, flanks.slope)),
            reach: flanks.reach.to_mm(),
            highest: tip.z + parameters.clear_height.to_mm(),
        }
    }

    /// What of it lies over a stretch: where its tip lies beside that, it begins at the side.
    pub(super) fn over(self, stretch: &RangeInclusive<f64>) -> Self {
        let vee = entering(self.vee, stretch);
        Self {
            vee,
            reach: self.reach - (vee.tip.z - self.vee.tip.z),
            ..self
        }
    }

    /// Whether both flanks come out within the blade's reach, with nothing in the way beyond, and the chip is low enough.
    pub(super) fn comes_free(&self, surface: &mut Surface) -> bool {
        let runs = [Side::Left, Side::Right].map(|side| surface.flank(self.vee, side));
        if runs
            .iter()
            .any(|run| run.reach > self.reach || run.blocked_at.is_some())
        {
            return false;
        }
        let [left, right] = runs;
        let mut chip = surface.corners_between(left.exit.x, right.exit.x);
        chip.all(|corner| corner.z <= self.highest)
    }
}

/// A V as far as it lies over a stretch: one whose tip lies beside that begins at its side.
pub(super) fn entering(vee: Vee, stretch: &RangeInclusive<f64>) -> Vee {
    let x = vee.tip.x.clamp(*stretch.start(), *stretch.end());
    let tip = Point2 { x, z: vee.height(x) };
    Vee { tip, ..vee }
}

/// The Vs of some layers with the ways between them, and with numbers for the layers that have any; the surface is what they leave then.
pub(super) fn in_layers(
    parameters: &VcutParameters,
    layers: Vec<Vec<PlannedCut>>,
    surface: &mut Surface,
) -> Vec<PlannedCut> {
    let mut cuts = Vec::new();
    let layers = layers.into_iter().filter(|layer| !layer.is_empty());
    for (number, layer) in (1..).zip(layers) {
        let mut before: Option<Point2> = None;
        for cut in &layer {
            let way = before.map_or(Way::Over, |before| way(parameters, surface, before, cut.tip));
            cuts.push(PlannedCut {
                layer: number,
                way,
                ..*cut
            });
            before = Some(cut.tip);
        }
        for cut in &layer {
            surface.release(Vee::even(cut.tip, parameters.flanks.slope));
        }
    }
    cuts
}

/// How the blade gets from one cut of a layer to the next, judged before any chip of the layer is out.
pub(super) fn way(parameters: &VcutParameters, surface: &mut Surface, from: Point2, to: Point2) -> Way {
    let highest = from.z.min(to.z) + parameters.clear_height.to_mm();
    let mut between = surface.corners_between(from.x, to.x);
    if between.all(|corner| corner.z <= highest) {
        Way::Beside
    } else {
        Way::Over
    }
}
