//! Where one course continues into another.

use super::types::Course;

/// Where a course continues into another without a stop.
#[derive(Clone, Copy, Debug)]
pub struct Through<'c> {
    /// The course that ends here.
    pub before: &'c Course,
    /// The course that begins here.
    pub after: &'c Course,
    /// How far the tip may be from both, in mm; above 0.
    pub blend: f64,
}

/// What part of a course so long is in the zone of a joint.
pub(super) fn zone(blend: f64, length: f64) -> f64 {
    if length > blend { blend / length } else { 1.0 }
}
