//! Numbers that bounds of intervals are: one alone, or one of each of several side by side.
//!
//! The formulas of enclosures are written once, for any [`Number`]. Nothing in them branches on a value, so that numbers side
//! by side go through the same steps; what a branch would decide is computed as a number, too ([`Number::below`]).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or one for each lane.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A constant of the same kind as this number.
    fn of(self, constant: f64) -> Self;
    /// Without its sign.
    fn magnitude(self) -> Self;
    fn root(self) -> Self;
    /// The lesser of two numbers.
    fn lesser(self, other: Self) -> Self;
    /// The greater of two numbers.
    fn greater(self, other: Self) -> Self;
    /// One number where this one is below a bound, another one where it is not.
    fn below(self, bound: Self, then: Self, otherwise: Self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// The direction of a point `(x, y)`.
    fn direction(y: Self, x: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn of(self, constant: f64) -> Self {
        constant
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    // One instruction, where `f64::min` takes several to treat a NaN that cannot be.
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn below(self, bound: Self, then: Self, otherwise: Self) -> Self {
        if self < bound { then } else { otherwise }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }

    #[inline(always)]
    fn direction(y: Self, x: Self) -> Self {
        libm::atan2(y, x)
    }
}
