//! Intervals of numbers, rounded outward: what is computed from two intervals contains what can be computed from any two
//! numbers in them (Moore: Interval Analysis, 1966).
//!
//! Every bound is moved outward by at least a unit in its last place after it was computed. That is twice the rounding of the
//! operation; the other half covers products so small that they lose digits (below 1e-307), once a number above that is added
//! to them. So enclosures hold up to 1e-307, and what is exactly zero stays so. Nothing here panics; a caller that keeps
//! magnitudes within [`HUGE`] meets no infinity and no NaN.

use super::plain::Number;
use core::ops::{Add, Mul, Neg, Sub};

/// Numbers that an analysis does not go beyond.
pub const HUGE: f64 = 1e30;
/// What sines, cosines and arcs may be off: four units in the last place of pi.
const FUNCTION_ERROR: f64 = 4.0 * 4.5e-16;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<N = f64> {
    pub low: N,
    /// The greatest of them.
    pub high: N,
}

impl Interval {
    /// Only 0.
    pub const ZERO: Self = Self::exactly(0.0);

    /// A number about which nothing is known, so small that sums and products of it stay finite.
    pub const UNKNOWN: Self = Self {
        low: -1e60,
        high: 1e60,
    };

    /// Where to divide it: a wide range of positive numbers in equal shares, else in the middle.
    pub fn between(self) -> f64 {
        if self.low > 0.0 && self.high > 4.0 * self.low {
            (self.low * self.high).sqrt()
        } else {
            self.middle()
        }
    }

    /// Its bounds mapped by a function that rises and takes a few roundings.
    pub(super) fn raised(self, rising: impl Fn(f64) -> f64) -> Self {
        outward_by(rising(self.low), rising(self.high), 4.0)
    }

    /// Whether it lies within, and is a proper interval.
    #[inline(always)]
    pub fn within(self, low: f64, high: f64) -> bool {
        low <= self.low && self.low <= self.high && self.high <= high
    }
}

impl<N: Copy> Interval<N> {
    #[inline(always)]
    pub const fn exactly(number: N) -> Self {
        Self {
            low: number,
            high: number,
        }
    }
}

impl<N: Number> Interval<N> {
    /// All numbers no further from `centre` than `radius`.
    #[inline(always)]
    pub fn around(centre: N, radius: N) -> Self {
        outward(centre - radius, centre + radius)
    }

    #[inline(always)]
    pub fn middle(self) -> N {
        self.low.of(0.5) * (self.low + self.high)
    }

    #[inline(always)]
    pub fn width(self) -> N {
        self.high - self.low
    }

    /// The largest absolute value.
    #[inline(always)]
    pub fn magnitude(self) -> N {
        self.low.magnitude().greater(self.high.magnitude())
    }

    /// Its product with the interval from -1 to 1, exactly.
    #[inline(always)]
    pub fn either_way(self) -> Self {
        let magnitude = self.magnitude();
        Self {
            low: -magnitude,
            high: magnitude,
        }
    }

    /// Its product with the interval from 0 to 1/2, exactly.
    #[inline(always)]
    pub fn up_to_half(self) -> Self {
        let (half, zero) = (self.low.of(0.5), self.low.of(0.0));
        Self {
            low: (half * self.low).lesser(zero),
            high: (half * self.high).greater(zero),
        }
    }

    /// What lies in both. Two enclosures of one number always have that number in common.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self {
            low: self.low.greater(other.low),
            high: self.high.lesser(other.high),
        }
    }

    /// The least interval around both.
    #[inline(always)]
    pub fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.lesser(other.low),
            high: self.high.greater(other.high),
        }
    }

    #[inline(always)]
    pub fn squared(self) -> Self {
        let zero = self.low.of(0.0);
        let (low, high) = (self.low * self.low, self.high * self.high);
        // 0 is in it unless one of its ends is beyond 0 on the wrong side.
        let least = low.lesser(high);
        let least = zero.below(self.low, least, self.high.below(zero, least, zero));
        let squares = outward(least, low.greater(high));
        Self {
            low: squares.low.greater(zero),
            ..squares
        }
    }

    /// The inverse, where it is positive throughout.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let one = self.low.of(1.0);
        outward(one / self.high, one / self.low)
    }

    /// The quotient by a divisor that is positive throughout.
    #[inline(always)]
    pub fn over(self, divisor: Self) -> Self {
        self * divisor.inverse()
    }

    /// Roots of what is not negative in it.
    #[inline(always)]
    pub fn root(self) -> Self {
        let zero = self.low.of(0.0);
        let roots = outward(self.low.greater(zero).root(), self.high.greater(zero).root());
        Self {
            low: roots.low.greater(zero),
            ..roots
        }
    }

    /// Sine and cosine of a narrow interval.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let centre = self.middle();
        let (sin, cos) = centre.sin_cos();
        // Neither changes faster than the angle; the middle is rounded.
        let radius = centre.of(0.5) * self.width()
            + centre.magnitude() * centre.of(f64::EPSILON)
            + centre.of(FUNCTION_ERROR);
        (Self::around(sin, radius), Self::around(cos, radius))
    }

    /// The direction of a narrow box `(x, y)` that keeps the given distance from the origin.
    #[inline(always)]
    pub fn direction(y: Self, x: Self, distance: N) -> Self {
        let centre = N::direction(y.middle(), x.middle());
        // A disc of radius r at a distance d is seen under asin(r / d) <= pi/2 r/d to either side.
        let radius = distance.of(2.0) * (y.width() + x.width()) / distance + distance.of(FUNCTION_ERROR);
        Self::around(centre, radius)
    }

    /// The smaller of any number in it and any in the other.
    #[inline(always)]
    pub fn lesser(self, other: Self) -> Self {
        Self {
            low: self.low.lesser(other.low),
            high: self.high.lesser(other.high),
        }
    }

    /// The greater of any number in it and any in the other.
    #[inline(always)]
    pub fn greater(self, other: Self) -> Self {
        Self {
            low: self.low.greater(other.low),
            high: self.high.greater(other.high),
        }
    }

    /// Multiplied by a number.
    #[inline(always)]
    pub fn scaled(self, factor: N) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        outward(a.lesser(b), a.greater(b))
    }
}

/// Bounds moved outward by more than the rounding of one operation.
#[inline(always)]
fn outward<N: Number>(low: N, high: N) -> Interval<N> {
    outward_by(low, high, 1.0)
}

/// Bounds moved outward by more than the rounding of so many operations.
#[inline(always)]
fn outward_by<N: Number>(low: N, high: N, roundings: f64) -> Interval<N> {
    let share = low.of(roundings * f64::EPSILON);
    Interval {
        low: low - low.magnitude() * share,
        high: high + high.magnitude() * share,
    }
}

impl<N: Number> Neg for Interval<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl<N: Number> Add for Interval<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        outward(self.low + other.low, self.high + other.high)
    }
}

impl<N: Number> Sub for Interval<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        outward(self.low - other.high, self.high - other.low)
    }
}

impl<N: Number> Mul for Interval<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        outward(
            a.lesser(b).lesser(c.lesser(d)),
            a.greater(b).greater(c.greater(d)),
        )
    }
}

impl<N: Number> Mul<f64> for Interval<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.scaled(self.low.of(factor))
    }
}
