//! A pocket with every choice made.

use crate::asked::ClearPocket;
use crate::plan::Plan;
use crate::plan::path::{self, Layer, LayerPlace};
use vcutc_geometry::profile::Profile;
use vcutc_process::pen::Path;

/// Clearing a pocket, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub asked: ClearPocket,
    pub plan: Plan,
    /// The part, into which the pocket is cut.
    pub part: Profile,
}

impl Planned {
    /// The paths of each layer, from the top.
    pub(crate) fn paths(&self) -> Vec<Vec<Path>> {
        let plan = &self.plan;
        let ramp = self.asked.crusher.ramp.value;
        let mut above = plan.top;
        let mut place = LayerPlace::First;
        let paths = plan.floors.iter().map(|&floor| {
            let paths = path::paths(plan, Layer { above, floor, place }, plan.air, ramp);
            (above, place) = (floor, LayerPlace::Below);
            paths
        });
        paths.collect()
    }
}
