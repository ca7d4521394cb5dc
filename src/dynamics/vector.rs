//! Vectors of any kind of number.

use core::ops::{Add, Mul, Neg, Sub};
use vcutc_geometry::number::{Along, Interval};

/// What torques are computed with: plain numbers, or enclosures of them in a place or along a way.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Neg<Output = Self>
{
    /// A plain number.
    fn plain(number: f64) -> Self;

    fn zero() -> Self {
        Self::plain(0.0)
    }

    /// With a plain number added.
    #[must_use]
    fn plus(self, constant: f64) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn plain(number: f64) -> Self {
        number
    }

    #[inline(always)]
    fn plus(self, constant: f64) -> Self {
        self + constant
    }
}

impl Number for Interval {
    #[inline(always)]
    fn plain(number: f64) -> Self {
        Self::exactly(number)
    }

    #[inline(always)]
    fn plus(self, constant: f64) -> Self {
        self + Self::exactly(constant)
    }
}

impl Number for Along {
    #[inline(always)]
    fn plain(number: f64) -> Self {
        Self::constant(number)
    }

    #[inline(always)]
    fn plus(self, constant: f64) -> Self {
        Self::plus(self, constant)
    }
}

pub(crate) type Vector<N> = [N; 3];

#[inline(always)]
pub(crate) fn sum<N: Number>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn cross<N: Number>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The cross product with a plain vector.
#[inline(always)]
pub(crate) fn cross_plain<N: Number>(a: Vector<N>, b: Vector<f64>) -> Vector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// So many times a vector.
#[inline(always)]
pub(crate) fn scaled<N: Number>(a: Vector<N>, factor: N) -> Vector<N> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// So many times a plain vector.
#[inline(always)]
pub(crate) fn along<N: Number>(direction: Vector<f64>, amount: N) -> Vector<N> {
    [
        amount * direction[0],
        amount * direction[1],
        amount * direction[2],
    ]
}

/// The part of a vector along a plain one.
#[inline(always)]
pub(crate) fn dot_plain<N: Number>(a: Vector<N>, b: Vector<f64>) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A plain symmetric matrix of the entries xx, yy, zz, xy, xz and yz times a vector.
#[inline(always)]
pub(crate) fn symmetric<N: Number>([xx, yy, zz, xy, xz, yz]: [f64; 6], a: Vector<N>) -> Vector<N> {
    [
        a[0] * xx + a[1] * xy + a[2] * xz,
        a[0] * xy + a[1] * yy + a[2] * yz,
        a[0] * xz + a[1] * yz + a[2] * zz,
    ]
}
