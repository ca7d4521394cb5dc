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
//! Limits of the axes are stated with the axes. A key that is left out is unknown, and limits nothing.

use super::facts::Sources;
use super::ranges::{SLIDING_ACCELERATION, SLIDING_JERK, TURNING_ACCELERATION, TURNING_JERK};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, optional};

/// The heading of the table.
pub(super) const KEY: &str = "path";

const FIELDS: &[FieldSpec] = &[
    optional("acceleration_mm_s2").within(SLIDING_ACCELERATION),
    optional("jerk_mm_s3").within(SLIDING_JERK),
    optional("turning_acceleration_deg_s2").within(TURNING_ACCELERATION),
    optional("turning_jerk_deg_s3").within(TURNING_JERK),
    optional("source"),
    optional("note"),
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
    faults: &mut Vec<Diagnostic>,
) -> PathLimits {
    let Some(table) = root.table(KEY, FIELDS, faults) else {
        return PathLimits::UNKNOWN;
    };
    sources.push(Sources::read("path", &table, "source", faults));
    remarks.extend(table.text("note", faults).map(str::to_owned));
    let mut number = |key| table.number(key, faults);
    PathLimits {
        acceleration: number("acceleration_mm_s2"),
        jerk: number("jerk_mm_s3"),
        turning_acceleration: number("turning_acceleration_deg_s2").map(f64::to_radians),
        turning_jerk: number("turning_jerk_deg_s3").map(f64::to_radians),
    }
}
