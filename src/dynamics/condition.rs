//! How a blade cuts, as far as its forces depend on it.

use crate::push::Posture;
use serde::{Serialize, Serializer};
use vcutc_backend_api::segments::LinearSegment;
use vcutc_diagnostics::number::rounded;
use vcutc_job::forces::Measured;

/// By which share of itself a feed may differ.
const SAME_FEED: f64 = 0.1;
/// By how much angles may differ, in deg.
const SAME_ANGLE: f64 = 5.0;
/// What that may be off by in the program.
const ROUNDING: f64 = 1e-6;

/// How a blade cuts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Condition {
    /// In mm/s.
    #[serde(serialize_with = "hundredths")]
    pub feed: f64,
    /// In deg.
    #[serde(serialize_with = "hundredths")]
    pub rake: f64,
    /// In deg.
    #[serde(serialize_with = "hundredths")]
    pub swing: f64,
}

pub(crate) fn hundredths<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value, 100.0))
}

impl Condition {
    /// How forces were measured.
    #[must_use]
    pub fn of(measured: &Measured) -> Self {
        Self {
            feed: measured.feed.value.to_mm_per_s(),
            rake: measured.rake.value.to_deg(),
            swing: measured.swing.value.to_deg(),
        }
    }

    pub(crate) fn in_cut(posture: &Posture, line: &LinearSegment) -> Self {
        let [shank, normal] = [-posture.blade_in_work.z_axis, posture.blade_in_work.y_axis];
        Self {
            feed: line.length().to_mm() / line.duration().to_s(),
            rake: libm::acos(shank.dot(posture.way).abs().min(1.0)).to_degrees(),
            swing: libm::asin(normal.z.abs().min(1.0)).to_degrees(),
        }
    }

    /// How far it is from another, where that matters.
    pub(crate) fn off(self, other: Self) -> Option<f64> {
        let feed = (self.feed / other.feed - 1.0).abs() / SAME_FEED;
        let rake = (self.rake - other.rake).abs() / SAME_ANGLE;
        let off = feed.max(rake).max((self.swing - other.swing).abs() / SAME_ANGLE);
        (off > 1.0 + ROUNDING).then_some(off)
    }
}
