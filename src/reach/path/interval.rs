//! Intervals of numbers, rounded outward: what is computed of two intervals contains what can be computed of any two
//! numbers in them (Moore: Interval Analysis, 1966).
//!
//! Every bound is moved outward by at least a unit in its last place after it was computed, which is more than the rounding
//! of the operation. Nothing here panics; a caller who keeps magnitudes within [`HUGE`] meets no infinity and no NaN.

use core::ops::{Add, Mul, Neg, Sub};

/// Numbers that an analysis does not go beyond.
pub(super) const HUGE: f64 = 1e30;
/// What sines, cosines and arcs may be off: four units in the last place of pi.
const FUNCTION_ERROR: f64 = 4.0 * 4.5e-16;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    /// The least of them.
    pub(super) low: f64,
    /// The greatest of them.
    pub(super) high: f64,
}

impl Interval {
    /// Only 0.
    pub(super) const ZERO: Self = Self::exactly(0.0);
    /// From -1 to 1: the parameter of a span.
    pub(super) const UNIT: Self = Self { low: -1.0, high: 1.0 };

    /// One number.
    #[inline(always)]
    pub(super) const fn exactly(number: f64) -> Self {
        Self {
            low: number,
            high: number,
        }
    }

    /// All numbers no further from `centre` than `radius`.
    #[inline(always)]
    pub(super) fn around(centre: f64, radius: f64) -> Self {
        outward(centre - radius, centre + radius)
    }

    #[inline(always)]
    pub(super) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    #[inline(always)]
    pub(super) fn width(self) -> f64 {
        self.high - self.low
    }

    /// The largest absolute value.
    #[inline(always)]
    pub(super) const fn magnitude(self) -> f64 {
        greater(self.low.abs(), self.high.abs())
    }

    /// Its product with the interval from -1 to 1, exactly.
    #[inline(always)]
    pub(super) const fn either_way(self) -> Self {
        let magnitude = self.magnitude();
        Self {
            low: -magnitude,
            high: magnitude,
        }
    }

    /// Its product with the interval from 0 to 1/2, exactly.
    #[inline(always)]
    pub(super) const fn up_to_half(self) -> Self {
        Self {
            low: lesser(0.5 * self.low, 0.0),
            high: greater(0.5 * self.high, 0.0),
        }
    }

    /// What lies in both. Two enclosures of one number always have that number in common.
    #[inline(always)]
    pub(super) const fn and(self, other: Self) -> Self {
        Self {
            low: greater(self.low, other.low),
            high: lesser(self.high, other.high),
        }
    }

    /// The least interval around both.
    #[inline(always)]
    pub(super) const fn hull(self, other: Self) -> Self {
        Self {
            low: lesser(self.low, other.low),
            high: greater(self.high, other.high),
        }
    }

    /// Whether it lies within, and is a proper interval.
    #[inline(always)]
    pub(super) fn within(self, low: f64, high: f64) -> bool {
        low <= self.low && self.low <= self.high && self.high <= high
    }

    #[inline(always)]
    pub(super) fn squared(self) -> Self {
        let (low, high) = (self.low * self.low, self.high * self.high);
        let least = if self.low <= 0.0 && self.high >= 0.0 {
            0.0
        } else {
            low.min(high)
        };
        let squares = outward(least, low.max(high));
        Self {
            low: squares.low.max(0.0),
            ..squares
        }
    }

    /// The quotient by a divisor that is positive throughout.
    #[inline(always)]
    pub(super) fn over(self, divisor: Self) -> Self {
        let inverse = outward(1.0 / divisor.high, 1.0 / divisor.low);
        self * inverse
    }

    /// Roots of what is not negative in it.
    #[inline(always)]
    pub(super) fn root(self) -> Self {
        let roots = outward(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt());
        Self {
            low: roots.low.max(0.0),
            ..roots
        }
    }

    /// Sine and cosine of a narrow interval.
    #[inline(always)]
    pub(super) fn sin_cos(self) -> (Self, Self) {
        let centre = self.middle();
        let (sin, cos) = libm::sincos(centre);
        // Neither changes faster than the angle; the middle is rounded.
        let radius = 0.5 * self.width() + centre.abs() * f64::EPSILON + FUNCTION_ERROR;
        (Self::around(sin, radius), Self::around(cos, radius))
    }

    /// The direction of a narrow box `(x, y)` that keeps the given distance from the origin.
    #[inline(always)]
    pub(super) fn direction(y: Self, x: Self, distance: f64) -> Self {
        let centre = libm::atan2(y.middle(), x.middle());
        // A disc of radius r at a distance d is seen under asin(r / d) <= pi/2 r/d to either side.
        let radius = 2.0 * (y.width() + x.width()) / distance + FUNCTION_ERROR;
        Self::around(centre, radius)
    }
}

/// The lesser of two numbers. One instruction, where `f64::min` takes several to treat a NaN that cannot be.
#[inline(always)]
const fn lesser(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The greater of two numbers.
#[inline(always)]
const fn greater(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

#[inline(always)]
fn outward(low: f64, high: f64) -> Interval {
    Interval {
        low: low - (low.abs() * f64::EPSILON + f64::MIN_POSITIVE),
        high: high + (high.abs() * f64::EPSILON + f64::MIN_POSITIVE),
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        outward(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        outward(
            lesser(lesser(a, b), lesser(c, d)),
            greater(greater(a, b), greater(c, d)),
        )
    }
}

impl Mul<f64> for Interval {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        outward(lesser(a, b), greater(a, b))
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
