//! How a blade cuts, as far as its forces depend on it.

use crate::push::Posture;
use serde::{Serialize, Serializer};
use vcutc_backend_api::units::{AngularSpeed, Length, Speed};
use vcutc_diagnostics::number::{rounded, show};
use vcutc_job::forces::{BladeForces, MeasuredEdge, MeasuredRim, MeasuredTeeth};

/// By which share of itself a feed, a spin or a chip may differ.
const SAME_SHARE: f64 = 0.1;
/// By how much angles may differ, in deg.
const SAME_ANGLE: f64 = 5.0;
/// What that may be off by in the program.
const ROUNDING: f64 = 1e-6;

/// How a blade cuts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Condition {
    /// A straight blade.
    Edge {
        /// In mm/s.
        #[serde(serialize_with = "hundredths")]
        feed: f64,
        /// In deg.
        #[serde(serialize_with = "hundredths")]
        rake: f64,
        /// In deg.
        #[serde(serialize_with = "hundredths")]
        swing: f64,
    },
    /// A disc.
    Rim {
        /// In mm/s.
        #[serde(serialize_with = "hundredths")]
        feed: f64,
        /// In rev/min.
        #[serde(serialize_with = "hundredths")]
        spin: f64,
    },
    /// A crusher.
    Teeth {
        /// The thickest chip of a tooth, in mm.
        #[serde(serialize_with = "thousandths")]
        chip: f64,
        /// In rev/min.
        #[serde(serialize_with = "hundredths")]
        spin: f64,
    },
}

pub(crate) fn hundredths<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value, 100.0))
}

pub(crate) fn thousandths<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value, 1000.0))
}

/// In rev/min.
fn turns_a_minute(spin: AngularSpeed) -> f64 {
    spin.to_rad_per_s() / core::f64::consts::TAU * 60.0
}

impl From<&MeasuredEdge> for Condition {
    fn from(measured: &MeasuredEdge) -> Self {
        Self::Edge {
            feed: measured.feed.value.to_mm_per_s(),
            rake: measured.rake.value.to_deg(),
            swing: measured.swing.value.to_deg(),
        }
    }
}

impl From<&MeasuredRim> for Condition {
    fn from(measured: &MeasuredRim) -> Self {
        Self::of_rim(measured.feed.value, measured.spin.value)
    }
}

impl From<&MeasuredTeeth> for Condition {
    fn from(measured: &MeasuredTeeth) -> Self {
        Self::of_teeth(measured.chip.value, measured.spin.value)
    }
}

impl From<BladeForces<'_>> for Condition {
    /// How forces were measured.
    fn from(forces: BladeForces<'_>) -> Self {
        match forces {
            BladeForces::Edge(forces) => Self::from(&forces.measured),
            BladeForces::Rim(forces) => Self::from(&forces.measured),
            BladeForces::Teeth(forces) => Self::from(&forces.measured),
        }
    }
}

impl Condition {
    pub(crate) fn of_edge(posture: &Posture, feed: Speed) -> Self {
        let [shank, normal] = [-posture.blade_in_work.z_axis, posture.blade_in_work.y_axis];
        Self::Edge {
            feed: feed.to_mm_per_s(),
            rake: libm::acos(shank.dot(posture.way).abs().min(1.0)).to_degrees(),
            swing: libm::asin(normal.z.abs().min(1.0)).to_degrees(),
        }
    }

    pub(crate) fn of_rim(feed: Speed, spin: AngularSpeed) -> Self {
        Self::Rim {
            feed: feed.to_mm_per_s(),
            spin: turns_a_minute(spin),
        }
    }

    pub(crate) fn of_teeth(chip: Length, spin: AngularSpeed) -> Self {
        Self::Teeth {
            chip: chip.to_mm(),
            spin: turns_a_minute(spin),
        }
    }

    /// How far it is from how forces were measured, where that matters.
    pub(crate) fn off(self, measured: Self) -> Option<f64> {
        let share = |own: f64, other: f64| (own / other - 1.0).abs() / SAME_SHARE;
        let angle = |own: f64, other: f64| (own - other).abs() / SAME_ANGLE;
        let off = match (self, measured) {
            (
                Self::Edge { feed, rake, swing },
                Self::Edge {
                    feed: f,
                    rake: r,
                    swing: s,
                },
            ) => share(feed, f).max(angle(rake, r)).max(angle(swing, s)),
            (Self::Rim { feed, spin }, Self::Rim { feed: f, spin: s }) => share(feed, f).max(share(spin, s)),
            // The forces of thinner chips follow from those of thicker ones.
            (Self::Teeth { chip, spin }, Self::Teeth { chip: c, spin: s }) => {
                share(chip.max(c), c).max(share(spin, s))
            }
            // A blade has the forces of its kind.
            (Self::Edge { .. } | Self::Rim { .. } | Self::Teeth { .. }, _) => return None,
        };
        (off > 1.0 + ROUNDING).then_some(off)
    }

    /// `at 200 mm/s, rake 60 deg and swing 35 deg`.
    #[must_use]
    pub fn words(self) -> String {
        let tenths = |value: f64| show((value * 10.0).round() / 10.0);
        match self {
            Self::Edge { feed, rake, swing } => format!(
                "at {} mm/s, rake {} deg and swing {} deg",
                tenths(feed),
                tenths(rake),
                tenths(swing)
            ),
            Self::Rim { feed, spin } => {
                format!("at {} mm/s and {} rev/min", tenths(feed), show(spin.round()))
            }
            Self::Teeth { chip, spin } => format!(
                "with chips of {} mm at {} rev/min",
                show((chip * 1000.0).round() / 1000.0),
                show(spin.round())
            ),
        }
    }
}
