//! Places of the plan.

/// A place in the x-y plane of the workpiece frame, in mm; also the vector between two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Across the stock.
    pub x: f64,
    /// Along the stock.
    pub y: f64,
}

impl Place {
    /// The place (x, y), in mm.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The vector from `origin` to here.
    #[must_use]
    pub fn minus(self, origin: Self) -> Self {
        Self::new(self.x - origin.x, self.y - origin.y)
    }

    /// The place this vector away.
    #[must_use]
    pub fn plus(self, vector: Self) -> Self {
        Self::new(self.x + vector.x, self.y + vector.y)
    }

    /// The vector, so many times as long.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }

    /// Scalar product of two vectors.
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Positive where `other` points to the left of this vector.
    #[must_use]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// The vector turned by a right angle to the left.
    #[must_use]
    pub fn left(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// The length of the vector.
    #[must_use]
    pub fn length(self) -> f64 {
        libm::hypot(self.x, self.y)
    }

    /// The square of the length of the vector.
    #[must_use]
    pub fn square(self) -> f64 {
        self.dot(self)
    }

    /// Straight distance to another place.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        other.minus(self).length()
    }

    /// The place a share `t` of the way towards `other`.
    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self.plus(other.minus(self).times(t))
    }
}
