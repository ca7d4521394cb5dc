//! placeholder

use super::profile::Profile;
use vcutc_backend_api::units::Length;

/// The part itself until the offset lands.
#[must_use]
pub fn offset_up(profile: &Profile, _distance: Length) -> Profile {
    profile.clone()
}
