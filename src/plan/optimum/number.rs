//! Numbers that the formulas are computed with: plain ones, and boxes of them with their slopes.
//!
//! A [`Slopes`] encloses a function over a box: all its values, and all its generalised partial derivatives (Clarke:
//! Optimization and Nonsmooth Analysis, 1983), which at a kink of `min` or `max` are the hull of those on both sides. Every
//! bound is rounded outward (Moore: Interval Analysis, 1966), so what follows from it is proven. A [`Jet`] carries second
//! derivatives too, of numbers or of intervals; where a function has a kink in a box its derivatives there are unknown.

use core::ops::{Add, Div, Mul, Sub};

/// What the formulas need of a number.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The smaller of two.
    fn lesser(self, other: Self) -> Self;
    /// The larger of two.
    fn greater(self, other: Self) -> Self;
    /// The root of something positive.
    fn root(self) -> Self;
    /// The arc of a tangent.
    fn arc_tangent(self) -> Self;
    /// Something from 1 to this, of which no more is known; for a plain number, itself.
    fn or_down_to_one(self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
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
    fn arc_tangent(self) -> Self {
        libm::atan(self)
    }
    fn or_down_to_one(self) -> Self {
        self
    }
}

/// All numbers from `low` to `high`.
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
    fn inverse(self) -> Self {
        outward(1.0 / self.high, 1.0 / self.low)
    }
}

/// Bounds moved outward by a unit in the last place or more, which is more than the rounding of an operation; what is nothing
/// stays so. Values are far from the smallest that there are.
#[inline]
fn outward(low: f64, high: f64) -> Interval {
    Interval {
        low: low - low.abs() * f64::EPSILON,
        high: high + high.abs() * f64::EPSILON,
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

/// What the parts of a jet are: numbers, or enclosures of them.
pub(super) trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Just this.
    fn exactly(value: f64) -> Self;
    /// What is not known.
    fn unknown() -> Self;
    /// One part in something positive.
    fn inverse(self) -> Self;
    /// The root of something positive.
    fn root(self) -> Self;
    /// The arc of a tangent.
    fn arc_tangent(self) -> Self;
    /// Whether this is the smaller of two; unsure where they overlap.
    fn compared(self, other: Self) -> Compared;
    /// The smaller of two.
    fn smaller(self, other: Self) -> Self;
    /// The larger of two.
    fn larger(self, other: Self) -> Self;
}

/// Which of two is smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compared {
    First,
    Second,
    Unsure,
}

impl Scalar for f64 {
    fn exactly(value: f64) -> Self {
        value
    }
    fn unknown() -> Self {
        0.0
    }
    fn inverse(self) -> Self {
        1.0 / self
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn arc_tangent(self) -> Self {
        libm::atan(self)
    }
    fn compared(self, other: Self) -> Compared {
        if self < other {
            Compared::First
        } else {
            Compared::Second
        }
    }
    fn smaller(self, other: Self) -> Self {
        self.lesser(other)
    }
    fn larger(self, other: Self) -> Self {
        self.greater(other)
    }
}

impl Scalar for Interval {
    fn exactly(value: f64) -> Self {
        Self::exactly(value)
    }
    fn unknown() -> Self {
        Self::UNKNOWN
    }
    fn inverse(self) -> Self {
        self.inverse()
    }
    fn root(self) -> Self {
        outward(self.low.sqrt(), self.high.sqrt())
    }
    fn arc_tangent(self) -> Self {
        // Within one unit in the last place (musl), so two are enough.
        let value = outward(libm::atan(self.low), libm::atan(self.high));
        outward(value.low, value.high)
    }
    fn compared(self, other: Self) -> Compared {
        if self.high < other.low {
            Compared::First
        } else if other.high < self.low {
            Compared::Second
        } else {
            Compared::Unsure
        }
    }
    fn smaller(self, other: Self) -> Self {
        Self {
            low: self.low.lesser(other.low),
            high: self.high.lesser(other.high),
        }
    }
    fn larger(self, other: Self) -> Self {
        Self {
            low: self.low.greater(other.low),
            high: self.high.greater(other.high),
        }
    }
}

/// A function with its slopes along the two coordinates and its curvatures along the first, across, along the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet<S> {
    pub(super) value: S,
    pub(super) by: [S; 2],
    pub(super) curve: [S; 3],
}

/// Which two coordinates a curvature is along.
const PAIRS: [(usize, usize); 3] = [(0, 0), (0, 1), (1, 1)];

impl<S: Scalar> Jet<S> {
    /// A coordinate (the first or the second) over its range.
    pub(super) fn coordinate(number: usize, range: S) -> Self {
        let nothing = S::exactly(0.0);
        let mut by = [nothing; 2];
        by[number] = S::exactly(1.0);
        Self {
            value: range,
            by,
            curve: [nothing; 3],
        }
    }

    /// The function of a function, by its value and its first and second derivative.
    fn of(self, value: S, first: S, second: S) -> Self {
        Self {
            value,
            by: self.by.map(|slope| slope * first),
            curve: core::array::from_fn(|k| {
                let (i, j) = PAIRS[k];
                self.curve[k] * first + self.by[i] * self.by[j] * second
            }),
        }
    }

    /// With this value, its derivatives unknown.
    fn kinked(value: S) -> Self {
        Self {
            value,
            by: [S::unknown(); 2],
            curve: [S::unknown(); 3],
        }
    }
}

impl<S: Scalar> Add for Jet<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            by: core::array::from_fn(|i| self.by[i] + other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] + other.curve[k]),
        }
    }
}

impl<S: Scalar> Sub for Jet<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            by: core::array::from_fn(|i| self.by[i] - other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] - other.curve[k]),
        }
    }
}

impl<S: Scalar> Mul for Jet<S> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let sums = |a: S, b: S, c: S, d: S| a * b + c * d;
        Self {
            value: self.value * other.value,
            by: core::array::from_fn(|i| sums(self.by[i], other.value, self.value, other.by[i])),
            curve: core::array::from_fn(|k| {
                let (i, j) = PAIRS[k];
                let outer = sums(self.curve[k], other.value, self.value, other.curve[k]);
                outer + sums(self.by[i], other.by[j], self.by[j], other.by[i])
            }),
        }
    }
}

impl<S: Scalar> Div for Jet<S> {
    type Output = Self;
    /// The divisor is positive.
    fn div(self, other: Self) -> Self {
        let inverse = other.value.inverse();
        let times = |a: S, b: S| a * b;
        let value = times(self.value, inverse);
        let by: [S; 2] = core::array::from_fn(|i| times(self.by[i] - times(value, other.by[i]), inverse));
        let curve = core::array::from_fn(|k| {
            let (i, j) = PAIRS[k];
            let left = self.curve[k] - times(by[i], other.by[j]) - times(by[j], other.by[i]);
            times(left - times(value, other.curve[k]), inverse)
        });
        Self { value, by, curve }
    }
}

impl<S: Scalar> Number for Jet<S> {
    fn constant(value: f64) -> Self {
        let nothing = S::exactly(0.0);
        Self {
            value: S::exactly(value),
            by: [nothing; 2],
            curve: [nothing; 3],
        }
    }
    fn lesser(self, other: Self) -> Self {
        match self.value.compared(other.value) {
            Compared::First => self,
            Compared::Second => other,
            Compared::Unsure => Self::kinked(self.value.smaller(other.value)),
        }
    }
    fn greater(self, other: Self) -> Self {
        match self.value.compared(other.value) {
            Compared::First => other,
            Compared::Second => self,
            Compared::Unsure => Self::kinked(self.value.larger(other.value)),
        }
    }
    fn root(self) -> Self {
        let value = self.value.root();
        let first = S::exactly(0.5) * value.inverse();
        let second = S::exactly(-0.5) * first * self.value.inverse();
        self.of(value, first, second)
    }
    fn arc_tangent(self) -> Self {
        let first = (S::exactly(1.0) + self.value * self.value).inverse();
        let second = S::exactly(-2.0) * self.value * first * first;
        self.of(self.value.arc_tangent(), first, second)
    }
    fn or_down_to_one(self) -> Self {
        Self::kinked(S::exactly(1.0).larger(self.value))
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
        self.of(value, Interval::exactly(0.5) * value.inverse())
    }

    fn arc_tangent(self) -> Self {
        let value = self.value.arc_tangent();
        let derivative = (Interval::exactly(1.0) + self.value * self.value).inverse();
        self.of(value, derivative)
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
