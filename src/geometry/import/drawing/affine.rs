//! Affine maps of the plane, as blocks, groups and units make them.

use crate::point::Point2;

/// How unequal a map may stretch, and how far from square it may leave a right angle, to count as a similarity.
const SIMILAR: f64 = 1e-9;

/// The map `(x, z) -> (a x + c z + e, b x + d z + f)`, in the letters of SVG's `matrix`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// `[a, b, c, d, e, f]`.
    matrix: [f64; 6],
}

impl Affine {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self::new([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    /// By its matrix `[a, b, c, d, e, f]`.
    #[must_use]
    pub const fn new(matrix: [f64; 6]) -> Self {
        Self { matrix }
    }

    /// Moves.
    #[must_use]
    pub const fn shift(x: f64, z: f64) -> Self {
        Self::new([1.0, 0.0, 0.0, 1.0, x, z])
    }

    /// Stretches along both axes.
    #[must_use]
    pub const fn stretch(x: f64, z: f64) -> Self {
        Self::new([x, 0.0, 0.0, z, 0.0, 0.0])
    }

    /// Turns about the origin, from x towards z; an angle in degrees, so that right angles are exact.
    #[must_use]
    pub fn turn(degrees: f64) -> Self {
        let (sin, cos) = sincos_degrees(degrees);
        Self::new([cos, sin, -sin, cos, 0.0, 0.0])
    }

    /// First `inner`, then this map.
    #[must_use]
    pub fn after(self, inner: Self) -> Self {
        let [a, b, c, d, _, _] = self.matrix;
        let [p, q, r, s, t, u] = inner.matrix;
        let origin = self.point(Point2::new(t, u));
        Self::new([
            a * p + c * q,
            b * p + d * q,
            a * r + c * s,
            b * r + d * s,
            origin.x,
            origin.z,
        ])
    }

    #[must_use]
    pub fn point(self, point: Point2) -> Point2 {
        let [_, _, _, _, e, f] = self.matrix;
        let moved = self.vector(point);
        Point2::new(moved.x + e, moved.z + f)
    }

    /// What becomes of a vector.
    #[must_use]
    pub fn vector(self, vector: Point2) -> Point2 {
        let [a, b, c, d, _, _] = self.matrix;
        Point2::new(a * vector.x + c * vector.z, b * vector.x + d * vector.z)
    }

    /// Whether left stays left.
    pub(super) fn keeps_sense(self) -> bool {
        self.determinant() > 0.0
    }

    /// Whether circles stay circles.
    pub(super) fn is_similarity(self) -> bool {
        let [a, b, c, d, _, _] = self.matrix;
        let (first, second) = (Point2::new(a, b), Point2::new(c, d));
        let size = first.dot(first).max(second.dot(second));
        (first.dot(first) - second.dot(second)).abs() <= SIMILAR * size
            && first.dot(second).abs() <= SIMILAR * size
    }

    /// Whether it is made of numbers and maps areas to areas.
    #[must_use]
    pub fn is_proper(self) -> bool {
        self.matrix.iter().all(|part| part.is_finite()) && self.determinant().abs() > f64::MIN_POSITIVE
    }

    fn determinant(self) -> f64 {
        let [a, b, c, d, _, _] = self.matrix;
        a * d - b * c
    }
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90.
#[must_use]
pub(in super::super) fn sincos_degrees(degrees: f64) -> (f64, f64) {
    let turned = degrees.rem_euclid(360.0);
    for (right, exact) in [
        (0.0, (0.0, 1.0)),
        (90.0, (1.0, 0.0)),
        (180.0, (0.0, -1.0)),
        (270.0, (-1.0, 0.0)),
    ] {
        if turned.total_cmp(&right).is_eq() {
            return exact;
        }
    }
    libm::sincos(turned.to_radians())
}
