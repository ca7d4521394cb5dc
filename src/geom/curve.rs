//! Curves of a profile, and their polylines.

/// A point in the x-z plane of the workpiece frame, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point2 {
    /// Across the cuts.
    pub x: f64,
    /// Up.
    pub z: f64,
}
