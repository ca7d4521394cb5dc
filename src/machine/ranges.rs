//! The ranges of the numbers of a sheet.

use core::ops::Bound;
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::schema::range::Range;

/// Lengths and coordinates.
pub(crate) const LENGTH: Range = Range::closed(Dimension::LENGTH, -100_000.0, 100_000.0);
/// Upper arm and forearm, without which an arm has no elbow.
pub(crate) const ARM_LENGTH: Range = Range::closed(Dimension::LENGTH, 1.0, 100_000.0);
/// Angles of axes and offsets.
pub(crate) const ANGLE: Range = Range::closed(Dimension::ANGLE, -720.0, 720.0);
/// Rates of rotary axes.
pub(crate) const TURNING_RATE: Range = turning(1, 100_000.0);
/// Accelerations of rotary axes.
pub(crate) const TURNING_ACCELERATION: Range = turning(2, 1e7);
/// Jerks of rotary axes.
pub(crate) const TURNING_JERK: Range = turning(3, 1e9);
/// Rates of linear axes.
pub(crate) const SLIDING_RATE: Range = sliding(1, 1e6);
/// Accelerations of linear axes.
pub(crate) const SLIDING_ACCELERATION: Range = sliding(2, 1e8);
/// Jerks of linear axes.
pub(crate) const SLIDING_JERK: Range = sliding(3, 1e10);
pub(crate) const MASS: Range = Range::closed(Dimension::MASS, 0.0, 1e6);
/// What an arm may carry.
pub(crate) const RATED_PAYLOAD: Range = Range::closed(Dimension::MASS, 0.001, 1e6);
/// Entries of inertias, in kg m2.
pub(crate) const INERTIA: Range = Range::closed(Dimension::PURE, -1e6, 1e6);
/// What an axis of a wrist may turn, in kg m2.
pub(crate) const INERTIA_LIMIT: Range = Range::closed(Dimension::PURE, 1e-6, 1e6);
/// Torques, in Nm.
pub(crate) const TORQUE: Range = Range::closed(Dimension::PURE, 0.001, 1e7);
/// Stiffnesses of joints, in Nm/rad.
pub(crate) const STIFFNESS: Range = Range::closed(Dimension::PURE, 100.0, 1e9);
/// By which share of itself a number may be off.
pub(crate) const SPREAD: Range = Range::new(Dimension::PURE, Bound::Included(0.0), Bound::Excluded(1.0));
/// Parts of a unit quaternion.
pub(crate) const QUATERNION_PART: Range = Range::closed(Dimension::PURE, -1.0, 1.0);
/// Tolerances, in the unit of their key.
pub(crate) const TOLERANCE: Range = Range::closed(Dimension::PURE, 0.0, 1000.0);

const fn turning(per_time: i8, most: f64) -> Range {
    Range::closed(Dimension::new(0, 1, -per_time, 0), 0.001, most)
}

const fn sliding(per_time: i8, most: f64) -> Range {
    Range::closed(Dimension::new(1, 0, -per_time, 0), 0.001, most)
}
