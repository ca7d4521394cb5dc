//! Whether the chip of a V comes free, and how the blade gets from one V to the next.

use super::Way;
use super::parameters::VcutParameters;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// Whether both flanks of a V come out within the blade's reach, with nothing in the way beyond, and its chip is low enough for the
/// blade to turn beside it.
pub(super) fn comes_free(parameters: &VcutParameters, surface: &mut Surface, tip: Point2) -> bool {
    let flanks = &parameters.flanks;
    let vee = flanks.lowest(Vee::even(tip, flanks.slope));
    let runs = [Side::Left, Side::Right].map(|side| surface.flank(vee, side));
    if runs
        .iter()
        .any(|run| run.reach > flanks.reach.to_mm() || run.blocked_at.is_some())
    {
        return false;
    }
    let [left, right] = runs;
    let highest = tip.z + parameters.clear_height.to_mm();
    let mut chip = surface.corners_between(left.exit.x, right.exit.x);
    chip.all(|corner| corner.z <= highest)
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
