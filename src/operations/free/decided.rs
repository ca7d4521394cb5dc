//! A pocket to be freed with every choice made.

use crate::asked::FreePocket;
use crate::plan::Plan;
use vcutc_geometry::profile::Profile;

/// Freeing a pocket, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub asked: FreePocket,
    pub plan: Plan,
    /// The part, into which the pocket is cut.
    pub part: Profile,
}
