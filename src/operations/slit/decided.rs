//! Slits along walls with every choice made.

use crate::asked::SlitWalls;
use crate::plan::Plan;
use vcutc_geometry::profile::Profile;

/// Slitting the walls of a region, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub asked: SlitWalls,
    pub plan: Plan,
    /// The part, into which the slits are cut.
    pub part: Profile,
}
