//! Finishing with every choice made.

use crate::asked::FinishDisc;
use crate::plan::PlannedFinish;
use vcutc_backend_api::units::Length;
use vcutc_geometry::profile::Profile;

/// Finishing with a disc, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub asked: FinishDisc,
    pub plan: PlannedFinish,
    /// The part with its allowance.
    pub bound: Profile,
    /// How deep the stock is along y.
    pub depth: Length,
}
