//! The figures of a program as data: for other programs to read, and to compare with those of an earlier version.
//!
//! All are rounded to the decimals that they are written with, so that a figure that was read back from a file equals the
//! one that was written: what is compared is what people see in a diff.

pub mod baseline;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};
use vcutc_diagnostics::number::rounded;
use vcutc_job::PlannedJob;
use vcutc_simulation::report::Report;

/// Figures of a program. The names carry their units; `docs/ci.md` explains each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// V-cuts.
    pub cuts: usize,
    /// Layers that cut something.
    pub layers: usize,
    /// Time of the planned program, as far as it is known.
    #[serde(deserialize_with = "not_negative")]
    pub time_s: f64,
    /// Time by the mean-value model [Cui 11].
    #[serde(deserialize_with = "not_negative")]
    pub estimate_s: f64,
    /// Highest material left on the part: the machined contour's largest distance from it.
    #[serde(deserialize_with = "not_negative")]
    pub scallop_mm: f64,
    #[serde(deserialize_with = "not_negative")]
    pub mean_scallop_mm: f64,
    /// Longest edge that a cut uses.
    #[serde(deserialize_with = "not_negative")]
    pub longest_edge_mm: f64,
    /// Area of the cross-section that is cut away.
    #[serde(deserialize_with = "not_negative")]
    pub removed_mm2: f64,
    /// Area that stays on the part.
    #[serde(deserialize_with = "not_negative")]
    pub residual_mm2: f64,
    /// Largest normalised cross-correlation of machined and theoretical contour [Cui 15].
    pub correlation: f64,
}

impl Numbers {
    /// The figures of a program that was proven.
    #[must_use]
    pub fn of(plan: &PlannedJob, report: &Report) -> Self {
        Self {
            cuts: report.cuts(),
            layers: report.layers.len(),
            time_s: thousandths(report.times.all.total().to_s()),
            estimate_s: thousandths(plan.estimate().to_s()),
            scallop_mm: thousandths(report.scallop.height.to_mm()),
            mean_scallop_mm: thousandths(report.mean_scallop.to_mm()),
            longest_edge_mm: thousandths(report.longest_edge.to_mm()),
            removed_mm2: thousandths(report.removed.to_mm2()),
            residual_mm2: thousandths(report.residual.to_mm2()),
            correlation: (report.correlation * 1e6).round() / 1e6,
        }
    }
}

/// A figure as it is read. A value below zero is refused.
fn not_negative<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if value >= 0.0 {
        Ok(value)
    } else {
        Err(D::Error::custom("a figure below zero"))
    }
}

fn thousandths(value: f64) -> f64 {
    rounded(value, 1000.0)
}

/// A figure that a repository can hold its programs to. Less is better for all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Figure {
    /// Time of the program.
    Time,
    /// Highest material left on the part.
    Scallop,
    MeanScallop,
    /// V-cuts.
    Cuts,
    /// Longest edge in use.
    Edge,
}

impl Figure {
    /// All of them, with their names in `vcut.toml`.
    pub const ALL: [(&'static str, Self); 5] = [
        ("time", Self::Time),
        ("scallop", Self::Scallop),
        ("mean_scallop", Self::MeanScallop),
        ("cuts", Self::Cuts),
        ("edge", Self::Edge),
    ];

    #[must_use]
    pub fn of(self, numbers: &Numbers) -> f64 {
        match self {
            Self::Time => numbers.time_s,
            Self::Scallop => numbers.scallop_mm,
            Self::MeanScallop => numbers.mean_scallop_mm,
            Self::Cuts => numbers.cuts as f64,
            Self::Edge => numbers.longest_edge_mm,
        }
    }

    /// In words, with its verb left out: `the program's time`.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Time => "the program's time",
            Self::Scallop => "the highest scallop",
            Self::MeanScallop => "the mean scallop",
            Self::Cuts => "the number of cuts",
            Self::Edge => "the longest edge in use",
        }
    }

    /// A value of it with its unit.
    #[must_use]
    pub fn show(self, value: f64) -> String {
        match self {
            Self::Time => format!("{value:.3} s"),
            Self::Scallop | Self::MeanScallop | Self::Edge => format!("{value:.3} mm"),
            Self::Cuts => format!("{value}"),
        }
    }
}
