//! Numbers that the formulas are computed with: plain ones, and boxes of them with their slopes.
//!
//! A [`Slopes`] encloses a function over a box: all its values, and all its generalised partial derivatives (Clarke:
//! Optimization and Nonsmooth Analysis, 1983), which at a kink of `min` or `max` are the hull of those on both sides. Every
//! bound is rounded outward (Moore: Interval Analysis, 1966), so what follows from it is proven.
use super::jet::Scalar;
use core::ops::{Add, Div, Mul, Sub};

/// What the formulas need of a number.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn constant(value: f64) -> Self;
    /// This many times a plain number: as with a constant, in a fraction of the work.
    fn times(self, factor: f64) -> Self;
    /// With a plain number added.
    fn plus(self, more: f64) -> Self;
    /// A plain number over this, which is positive.
    fn under(self, numerator: f64) -> Self;
    /// The smaller of two.
    fn lesser(self, other: Self) -> Self;
    /// The larger of two.
    fn greater(self, other: Self) -> Self;
    /// The root of something positive.
    fn root(self) -> Self;
    /// The hypotenuse over this leg, which is not negative, and a plain one, which is positive.
    fn hypotenuse(self, leg: f64) -> Self;
    /// This leg, which is not negative, over that hypotenuse.
    fn over_hypotenuse(self, leg: f64) -> Self;
    /// The arc of a tangent.
    fn arc_tangent(self) -> Self;
    /// No value is above this one.
    fn highest(self) -> f64;
    /// No value is below this one.
    fn lowest(self) -> f64;
    /// This, of which it is known that it is no more than that.
    fn known_below(self, most: f64) -> Self;
    /// Something from 1 to this, of which no more is known; for a plain number, itself.
    fn or_down_to_one(self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    fn plus(self, more: f64) -> Self {
        self + more
    }
    fn under(self, numerator: f64) -> Self {
        numerator / self
    }
    fn lesser(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    fn greater(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn hypotenuse(self, leg: f64) -> Self {
        hypotenuse(self, leg)
    }
    fn over_hypotenuse(self, leg: f64) -> Self {
        self / hypotenuse(self, leg)
    }
    fn arc_tangent(self) -> Self {
        libm::atan(self)
    }
    fn highest(self) -> f64 {
        self
    }
    fn lowest(self) -> f64 {
        self
    }
    fn known_below(self, _: f64) -> Self {
        self
    }
    fn or_down_to_one(self) -> Self {
        self
    }
}

fn hypotenuse(one: f64, other: f64) -> f64 {
    (one * one + other * other).sqrt()
}

/// All numbers from `low` to `high`. Those of `reach::path` are widened where nothing is, too, against underflow; here nothing
/// has to stay nothing, as the search asks whether a slope is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Interval {
    pub(super) const ZERO: Self = Self::exactly(0.0);
    /// A slope that nothing is known about, small enough that sums and products of it stay finite.
    pub(super) const UNKNOWN: Self = Self {
        low: -1e60,
        high: 1e60,
    };

    pub(super) const fn exactly(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    pub(super) fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.lesser(other.low),
            high: self.high.greater(other.high),
        }
    }

    pub(super) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Where to divide it: a wide range of positive numbers in equal shares, else in the middle.
    pub(super) fn between(self) -> f64 {
        if self.low > 0.0 && self.high > 4.0 * self.low {
            (self.low * self.high).sqrt()
        } else {
            self.middle()
        }
    }

    /// The middle of one of so many equal parts of it.
    pub(super) fn part(self, number: u32, of: u32) -> f64 {
        self.low + self.width() * (f64::from(number) + 0.5) / f64::from(of)
    }

    pub(super) fn width(self) -> f64 {
        self.high - self.low
    }

    /// Its square, which is never negative.
    pub(super) fn square(self) -> Self {
        let (one, two) = (self.low * self.low, self.high * self.high);
        let low = if self.low <= 0.0 && self.high >= 0.0 {
            0.0
        } else {
            one.lesser(two)
        };
        outward(low, one.greater(two))
    }

    pub(super) fn magnitude(self) -> f64 {
        self.low.abs().greater(self.high.abs())
    }

    /// One part in something positive.
    pub(super) fn inverse(self) -> Self {
        outward(1.0 / self.high, 1.0 / self.low)
    }

    /// This many times a plain number.
    pub(super) fn times(self, factor: f64) -> Self {
        let (one, other) = (self.low * factor, self.high * factor);
        if factor < 0.0 {
            outward(other, one)
        } else {
            outward(one, other)
        }
    }

    /// The hypotenuse over this leg and a plain one: it grows with the leg.
    pub(super) fn hypotenuse(self, leg: f64) -> Self {
        far_outward(hypotenuse(self.low, leg), hypotenuse(self.high, leg))
    }

    /// This leg over that hypotenuse: it grows with the leg too.
    pub(super) fn over_hypotenuse(self, leg: f64) -> Self {
        let share = |side: f64| side / hypotenuse(side, leg);
        far_outward(share(self.low), share(self.high))
    }

    /// As far as it is no more than that; what is above altogether comes down to its low end.
    pub(super) fn known_below(self, most: f64) -> Self {
        Self {
            low: self.low,
            high: self.high.lesser(most).greater(self.low),
        }
    }

    /// With a plain number added.
    pub(super) fn plus(self, more: f64) -> Self {
        outward(self.low + more, self.high + more)
    }
}

/// Bounds moved outward by a unit in the last place or more, which is more than the rounding of an operation; what is nothing
/// stays so. Values are far from the smallest that there are.
#[inline]
pub(super) fn outward(low: f64, high: f64) -> Interval {
    Interval {
        low: low - low.abs() * f64::EPSILON,
        high: high + high.abs() * f64::EPSILON,
    }
}

/// Bounds of something that took a few roundings, moved outward by more than these.
fn far_outward(low: f64, high: f64) -> Interval {
    Interval {
        low: low - low.abs() * (4.0 * f64::EPSILON),
        high: high + high.abs() * (4.0 * f64::EPSILON),
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        outward(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.low >= 0.0 && other.low >= 0.0 {
            return outward(self.low * other.low, self.high * other.high);
        }
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        outward(
            a.lesser(b).lesser(c.lesser(d)),
            a.greater(b).greater(c.greater(d)),
        )
    }
}

/// A function over a box: its values, and its slopes along the two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slopes {
    pub(super) value: Interval,
    pub(super) by: [Interval; 2],
}

impl Slopes {
    /// The first coordinate over its range.
    pub(super) const fn first(range: Interval) -> Self {
        Self {
            value: range,
            by: [Interval::exactly(1.0), Interval::ZERO],
        }
    }

    /// The second coordinate over its range.
    pub(super) const fn second(range: Interval) -> Self {
        Self {
            value: range,
            by: [Interval::ZERO, Interval::exactly(1.0)],
        }
    }

    fn hull(self, other: Self, value: Interval) -> Self {
        Self {
            value,
            by: [self.by[0].hull(other.by[0]), self.by[1].hull(other.by[1])],
        }
    }

    /// The function of a function: its values, and its derivative over them.
    fn of(self, value: Interval, derivative: Interval) -> Self {
        Self {
            value,
            by: self.by.map(|slope| slope * derivative),
        }
    }
}

impl Add for Slopes {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            by: [self.by[0] + other.by[0], self.by[1] + other.by[1]],
        }
    }
}

impl Sub for Slopes {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            by: [self.by[0] - other.by[0], self.by[1] - other.by[1]],
        }
    }
}

impl Mul for Slopes {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            by: [0, 1].map(|i| sum(self.by[i] * other.value, self.value * other.by[i])),
        }
    }
}

impl Div for Slopes {
    type Output = Self;
    /// The divisor is positive all over the box.
    fn div(self, other: Self) -> Self {
        let inverse = other.value.inverse();
        let value = product(self.value, inverse);
        Self {
            value,
            by: [0, 1].map(|i| product(difference(self.by[i], product(value, other.by[i])), inverse)),
        }
    }
}

// The rules of differentiation mix operations, which an operator's own body had better not show.
fn sum(one: Interval, other: Interval) -> Interval {
    one + other
}
fn difference(one: Interval, other: Interval) -> Interval {
    one - other
}
fn product(one: Interval, other: Interval) -> Interval {
    one * other
}

impl Number for Slopes {
    fn constant(value: f64) -> Self {
        Self {
            value: Interval::exactly(value),
            by: [Interval::ZERO; 2],
        }
    }

    fn times(self, factor: f64) -> Self {
        Self {
            value: self.value.times(factor),
            by: self.by.map(|slope| slope.times(factor)),
        }
    }

    fn plus(self, more: f64) -> Self {
        Self {
            value: self.value.plus(more),
            by: self.by,
        }
    }

    fn under(self, numerator: f64) -> Self {
        let inverse = self.value.inverse();
        let value = inverse.times(numerator);
        let falls = product(value, inverse).times(-1.0);
        self.of(value, falls)
    }

    fn lesser(self, other: Self) -> Self {
        if self.value.high < other.value.low {
            return self;
        }
        if other.value.high < self.value.low {
            return other;
        }
        let value = Interval {
            low: self.value.low.lesser(other.value.low),
            high: self.value.high.lesser(other.value.high),
        };
        self.hull(other, value)
    }

    fn greater(self, other: Self) -> Self {
        if self.value.low > other.value.high {
            return self;
        }
        if other.value.low > self.value.high {
            return other;
        }
        let value = Interval {
            low: self.value.low.greater(other.value.low),
            high: self.value.high.greater(other.value.high),
        };
        self.hull(other, value)
    }

    fn root(self) -> Self {
        let value = self.value.root();
        self.of(value, value.inverse().times(0.5))
    }

    fn hypotenuse(self, leg: f64) -> Self {
        self.of(self.value.hypotenuse(leg), self.value.over_hypotenuse(leg))
    }

    fn over_hypotenuse(self, leg: f64) -> Self {
        let inverse = self.value.hypotenuse(leg).inverse();
        let cube = product(inverse.square(), inverse);
        self.of(self.value.over_hypotenuse(leg), cube.times(leg * leg))
    }

    fn arc_tangent(self) -> Self {
        let value = self.value.arc_tangent();
        let derivative = self.value.square().plus(1.0).inverse();
        self.of(value, derivative)
    }

    fn highest(self) -> f64 {
        self.value.high
    }

    fn lowest(self) -> f64 {
        self.value.low
    }

    fn known_below(self, most: f64) -> Self {
        Self {
            value: self.value.known_below(most),
            by: self.by,
        }
    }

    fn or_down_to_one(self) -> Self {
        Self {
            value: Interval {
                low: 1.0,
                high: self.value.high,
            },
            by: [Interval::UNKNOWN; 2],
        }
    }
}
