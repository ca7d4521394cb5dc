//! Intervals of numbers, rounded outward: what is computed of two intervals contains what can be computed of any two
//! numbers in them (Moore: Interval Analysis, 1966).
//!
//! Every bound is moved outward by at least a unit in its last place after it was computed, which is more than the rounding
//! of the operation. Nothing here panics; a caller who keeps magnitudes within [`HUGE`] meets no infinity and no NaN.

use super::number::Number;
use core::ops::{Add, Mul, Neg, Sub};

/// Numbers that an analysis does not go beyond.
pub(super) const HUGE: f64 = 1e30;
/// What sines, cosines and arcs may be off: four units in the last place of pi.
const FUNCTION_ERROR: f64 = 4.0 * 4.5e-16;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval<N = f64> {
    pub(super) low: N,
    /// The greatest of them.
    pub(super) high: N,
}

impl Interval {
    /// Only 0.
    pub(super) const ZERO: Self = Self::exactly(0.0);

    /// Whether it lies within, and is a proper interval.
    #[inline(always)]
    pub(super) fn within(self, low: f64, high: f64) -> bool {
        low <= self.low && self.low <= self.high && self.high <= high
    }
}

impl<N: Copy> Interval<N> {
    #[inline(always)]
    pub(super) const fn exactly(number: N) -> Self {
        Self {
            low: number,
            high: number,
        }
    }
}

impl<N: Number> Interval<N> {
    /// All numbers no further from `centre` than `radius`.
    #[inline(always)]
    pub(super) fn around(centre: N, radius: N) -> Self {
        outward(centre - radius, centre + radius)
    }

    #[inline(always)]
    pub(super) fn middle(self) -> N {
        self.low.of(0.5) * (self.low + self.high)
    }

    #[inline(always)]
    pub(super) fn width(self) -> N {
        self.high - self.low
    }

    /// The largest absolute value.
    #[inline(always)]
    pub(super) fn magnitude(self) -> N {
        self.low.magnitude().greater(self.high.magnitude())
    }

    /// Its product with the interval from -1 to 1, exactly.
    #[inline(always)]
    pub(super) fn either_way(self) -> Self {
        let magnitude = self.magnitude();
        Self {
            low: -magnitude,
            high: magnitude,
        }
    }

    /// Its product with the interval from 0 to 1/2, exactly.
    #[inline(always)]
    pub(super) fn up_to_half(self) -> Self {
        let (half, zero) = (self.low.of(0.5), self.low.of(0.0));
        Self {
            low: (half * self.low).lesser(zero),
            high: (half * self.high).greater(zero),
        }
    }

    /// What lies in both. Two enclosures of one number always have that number in common.
    #[inline(always)]
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            low: self.low.greater(other.low),
            high: self.high.lesser(other.high),
        }
    }

    /// The least interval around both.
    #[inline(always)]
    pub(super) fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.lesser(other.low),
            high: self.high.greater(other.high),
        }
    }

    #[inline(always)]
    pub(super) fn squared(self) -> Self {
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

    /// The quotient by a divisor that is positive throughout.
    #[inline(always)]
    pub(super) fn over(self, divisor: Self) -> Self {
        let one = self.low.of(1.0);
        let inverse = outward(one / divisor.high, one / divisor.low);
        self * inverse
    }

    /// Roots of what is not negative in it.
    #[inline(always)]
    pub(super) fn root(self) -> Self {
        let zero = self.low.of(0.0);
        let roots = outward(self.low.greater(zero).root(), self.high.greater(zero).root());
        Self {
            low: roots.low.greater(zero),
            ..roots
        }
    }

    /// Sine and cosine of a narrow interval.
    #[inline(always)]
    pub(super) fn sin_cos(self) -> (Self, Self) {
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
    pub(super) fn direction(y: Self, x: Self, distance: N) -> Self {
        let centre = N::direction(y.middle(), x.middle());
        // A disc of radius r at a distance d is seen under asin(r / d) <= pi/2 r/d to either side.
        let radius = distance.of(2.0) * (y.width() + x.width()) / distance + distance.of(FUNCTION_ERROR);
        Self::around(centre, radius)
    }

    /// Multiplied by a number.
    #[inline(always)]
    pub(super) fn scaled(self, factor: N) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        outward(a.lesser(b), a.greater(b))
    }
}

#[inline(always)]
fn outward<N: Number>(low: N, high: N) -> Interval<N> {
    let (share, least) = (low.of(f64::EPSILON), low.of(f64::MIN_POSITIVE));
    Interval {
        low: low - (low.magnitude() * share + least),
        high: high + (high.magnitude() * share + least),
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn interval() -> impl Strategy<Value = (Interval, f64)> {
        (-1e3..1e3_f64, 0.0..10.0_f64, 0.0..=1.0_f64).prop_map(|(low, width, part)| {
            let high = low + width;
            let inside = (low + part * (high - low)).clamp(low, high);
            (Interval { low, high }, inside)
        })
    }

    fn holds(interval: Interval, number: f64) -> bool {
        interval.low <= number && number <= interval.high
    }

    proptest! {
        #[test]
        fn numbers_in_intervals_give_numbers_in_results((a, x) in interval(), (b, y) in interval()) {
            prop_assert!(holds(a + b, x + y));
            prop_assert!(holds(a - b, x - y));
            prop_assert!(holds(a * b, x * y));
            prop_assert!(holds(a * y, x * y));
            prop_assert!(holds(-a, -x));
            prop_assert!(holds(a.squared(), x * x));
            prop_assert!(holds(a.squared().root(), x.abs()));
            let positive = b.squared() + Interval::exactly(0.5);
            prop_assert!(holds(a.over(positive), x / (y * y + 0.5)));
            prop_assert!(holds(a.sin_cos().0, libm::sin(x)));
            prop_assert!(holds(a.sin_cos().1, libm::cos(x)));
        }

        #[test]
        fn a_box_is_seen_under_its_direction((a, x) in interval(), turn in -3.0..3.0_f64) {
            // A box of the interval's size around a point at a distance of twice its diagonal.
            let half = 0.5 * a.width() + 1e-9;
            let distance = 4.0 * half;
            let (sin, cos) = libm::sincos(turn);
            let (cx, cy) = ((distance + 2.0 * half) * cos, (distance + 2.0 * half) * sin);
            let offset = x - a.middle();
            let seen = Interval::direction(Interval::around(cy, half), Interval::around(cx, half), distance);
            prop_assert!(holds(seen, libm::atan2(cy + offset, cx - offset)) || turn.abs() > 2.6);
        }
    }
}
