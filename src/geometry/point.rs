//! Points of the plane and the few products of vectors that everything here is made of.

/// Largest coordinate that curves, profiles and files may have, in mm: a thousand kilometres. Beyond that a double
/// no longer resolves a tenth of a micrometre, and squares and products stay far from overflow below it.
pub const LARGEST_COORDINATE: f64 = 1e9;

/// A point in the x-z plane of the workpiece frame, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point2 {
    /// Across the cuts.
    pub x: f64,
    /// Up.
    pub z: f64,
}

impl Point2 {
    /// The point (x, z), in mm.
    #[must_use]
    pub const fn new(x: f64, z: f64) -> Self {
        Self { x, z }
    }

    /// Straight distance to another point, in mm.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        libm::hypot(other.x - self.x, other.z - self.z)
    }

    /// The point a share `t` of the way towards `other`.
    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        Self::new(self.x + (other.x - self.x) * t, self.z + (other.z - self.z) * t)
    }

    /// Whether both coordinates are numbers within [`LARGEST_COORDINATE`].
    #[must_use]
    pub const fn is_in_range(self) -> bool {
        // Comparisons with NaN are false, so this refuses what is not a number too.
        self.x.abs() <= LARGEST_COORDINATE && self.z.abs() <= LARGEST_COORDINATE
    }

    /// The vector from `origin` to this point.
    pub(super) fn minus(self, origin: Self) -> Self {
        Self::new(self.x - origin.x, self.z - origin.z)
    }

    /// Scalar product of two vectors.
    pub(super) fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.z * other.z
    }

    /// Positive when `other` points to the left of this vector (x to the right, z up).
    pub(super) fn cross(self, other: Self) -> f64 {
        self.x * other.z - self.z * other.x
    }
}
