//! The part of a sheet that describes the controller's planner: how it lets the tip gather speed along its way.
//!
//! ```toml
//! [path]
//! acceleration_mm_s2 = 2000.0
//! jerk_mm_s3 = 40000.0
//! turning_acceleration_deg_s2 = 400.0
//! turning_jerk_deg_s3 = 8000.0
//! source = "machine data MD32300"
//! ```
//!
//! Limits of the axes stand with the axes. A key that is left out is not known, and limits nothing.

use super::facts::Sources;
use vcutc_diagnostics::document::flaw::Flaw;
use vcutc_diagnostics::document::table::{
    SLIDING_ACCELERATION, SLIDING_JERK, TURNING_ACCELERATION, TURNING_JERK, Table,
};

/// The heading of the table.
pub(super) const KEY: &str = "path";

const ACCELERATION: &str = "acceleration_mm_s2";
const JERK: &str = "jerk_mm_s3";
const TURNING_ACCELERATION_KEY: &str = "turning_acceleration_deg_s2";
const TURNING_JERK_KEY: &str = "turning_jerk_deg_s3";

const KEYS: &[&str] = &[
    ACCELERATION,
    JERK,
    TURNING_ACCELERATION_KEY,
    TURNING_JERK_KEY,
    "source",
    "note",
];

/// What a controller keeps along the way of the tip, whatever its axes could do; each number when known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathLimits {
    /// Acceleration of the tip, in mm/s2.
    pub acceleration: Option<f64>,
    /// Jerk of the tip, in mm/s3.
    pub jerk: Option<f64>,
    /// Acceleration of the turning blade, in rad/s2.
    pub turning_acceleration: Option<f64>,
    /// Jerk of the turning blade, in rad/s3.
    pub turning_jerk: Option<f64>,
}

impl PathLimits {
    /// Of a machine of which none is known.
    pub const UNKNOWN: Self = Self {
        acceleration: None,
        jerk: None,
        turning_acceleration: None,
        turning_jerk: None,
    };
}

/// Reads the table, when the sheet has one.
pub(super) fn read(
    root: &Table<'_>,
    sources: &mut Vec<Sources>,
    remarks: &mut Vec<String>,
    flaws: &mut Vec<Flaw>,
) -> PathLimits {
    let Some(table) = root.table(KEY, KEYS, flaws) else {
        return PathLimits::UNKNOWN;
    };
    sources.push(Sources {
        of: "path",
        list: table.texts("source", flaws),
    });
    remarks.extend(table.text("note", flaws).map(str::to_owned));
    PathLimits {
        acceleration: table.number(ACCELERATION, SLIDING_ACCELERATION, flaws),
        jerk: table.number(JERK, SLIDING_JERK, flaws),
        turning_acceleration: table
            .number(TURNING_ACCELERATION_KEY, TURNING_ACCELERATION, flaws)
            .map(f64::to_radians),
        turning_jerk: table
            .number(TURNING_JERK_KEY, TURNING_JERK, flaws)
            .map(f64::to_radians),
    }
}
