//! Functions with their slopes and curvatures, at a place or enclosed over a box.
//!
//! Sums, products and compositions follow the usual rules (Griewank and Walther: Evaluating Derivatives, 2008). Of a kink of a
//! minimum or maximum within a box, the slopes are those on either side and all in between (Clarke: Optimization and
//! Nonsmooth Analysis, 1983); its curvature is unknown.

use super::interval::Interval;
use super::plain::Number;
use core::ops::{Add, Div, Mul, Sub};

/// What formulas are computed with: plain numbers, enclosures of them, and functions with their derivatives.
pub trait Scalar:
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

/// What the parts of a jet are: numbers, or enclosures of them.
pub trait Part: Scalar {
    /// A derivative about which nothing is known.
    fn unknown() -> Self;
    /// One over something positive.
    fn inverse(self) -> Self;
    /// Whether this is the smaller of two; unsure where they overlap.
    fn compared(self, other: Self) -> Compared;
    /// What encloses both.
    fn hull(self, other: Self) -> Self;
}

/// Which of two is smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compared {
    First,
    Second,
    Unsure,
}

impl Scalar for f64 {
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    #[inline]
    fn plus(self, more: f64) -> Self {
        self + more
    }
    #[inline]
    fn under(self, numerator: f64) -> Self {
        numerator / self
    }
    #[inline]
    fn lesser(self, other: Self) -> Self {
        Number::lesser(self, other)
    }
    #[inline]
    fn greater(self, other: Self) -> Self {
        Number::greater(self, other)
    }
    #[inline]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline]
    fn hypotenuse(self, leg: f64) -> Self {
        (self * self + leg * leg).sqrt()
    }
    #[inline]
    fn over_hypotenuse(self, leg: f64) -> Self {
        self / self.hypotenuse(leg)
    }
    #[inline]
    fn arc_tangent(self) -> Self {
        libm::atan(self)
    }
    #[inline]
    fn highest(self) -> f64 {
        self
    }
    #[inline]
    fn lowest(self) -> f64 {
        self
    }
    #[inline]
    fn known_below(self, _: f64) -> Self {
        self
    }
    #[inline]
    fn or_down_to_one(self) -> Self {
        self
    }
}

impl Part for f64 {
    #[inline]
    fn unknown() -> Self {
        0.0
    }
    #[inline]
    fn inverse(self) -> Self {
        1.0 / self
    }
    #[inline]
    fn compared(self, other: Self) -> Compared {
        if self < other {
            Compared::First
        } else {
            Compared::Second
        }
    }
    /// Not asked for: of two numbers one is the smaller.
    #[inline]
    fn hull(self, _: Self) -> Self {
        Self::unknown()
    }
}

impl Div for Interval {
    type Output = Self;
    /// The divisor is positive throughout.
    #[inline]
    fn div(self, divisor: Self) -> Self {
        self.over(divisor)
    }
}

impl Scalar for Interval {
    #[inline]
    fn constant(value: f64) -> Self {
        Self::exactly(value)
    }
    #[inline]
    fn times(self, factor: f64) -> Self {
        self.scaled(factor)
    }
    #[inline]
    fn plus(self, more: f64) -> Self {
        self + Self::exactly(more)
    }
    #[inline]
    fn under(self, numerator: f64) -> Self {
        self.inverse().scaled(numerator)
    }
    #[inline]
    fn lesser(self, other: Self) -> Self {
        self.lesser(other)
    }
    #[inline]
    fn greater(self, other: Self) -> Self {
        self.greater(other)
    }
    #[inline]
    fn root(self) -> Self {
        self.root()
    }
    // Both grow with this leg.
    #[inline]
    fn hypotenuse(self, leg: f64) -> Self {
        self.raised(|side| Scalar::hypotenuse(side, leg))
    }
    #[inline]
    fn over_hypotenuse(self, leg: f64) -> Self {
        self.raised(|side| Scalar::over_hypotenuse(side, leg))
    }
    #[inline]
    fn arc_tangent(self) -> Self {
        // Within one unit in the last place (musl).
        self.raised(libm::atan)
    }
    #[inline]
    fn highest(self) -> f64 {
        self.high
    }
    #[inline]
    fn lowest(self) -> f64 {
        self.low
    }
    /// What is above altogether comes down to its low end.
    #[inline]
    fn known_below(self, most: f64) -> Self {
        Self {
            low: self.low,
            high: Scalar::greater(Scalar::lesser(self.high, most), self.low),
        }
    }
    #[inline]
    fn or_down_to_one(self) -> Self {
        Self {
            low: 1.0,
            high: self.high,
        }
    }
}

impl Part for Interval {
    #[inline]
    fn unknown() -> Self {
        Self::UNKNOWN
    }
    #[inline]
    fn inverse(self) -> Self {
        self.inverse()
    }
    #[inline]
    fn compared(self, other: Self) -> Compared {
        if self.high < other.low {
            Compared::First
        } else if other.high < self.low {
            Compared::Second
        } else {
            Compared::Unsure
        }
    }
    #[inline]
    fn hull(self, other: Self) -> Self {
        self.hull(other)
    }
}

/// A function of so many coordinates (one or two) with its slopes along them and its curvatures for so many pairs of
/// coordinates (none, or all of them): along the first, across, along the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<S, const COORDINATES: usize, const PAIRED: usize> {
    pub value: S,
    pub by: [S; COORDINATES],
    pub curve: [S; PAIRED],
}

/// A function of one coordinate.
pub type OnLine<S> = Jet<S, 1, 1>;

/// A function of two coordinates.
pub type OnPlane<S> = Jet<S, 2, 3>;

/// A function of two coordinates over a box: its values and its slopes.
pub type Slopes = Jet<Interval, 2, 0>;

/// Which two coordinates a curvature is along.
const PAIRS: [(usize, usize); 3] = [(0, 0), (0, 1), (1, 1)];

impl<S: Part, const D: usize, const P: usize> Jet<S, D, P> {
    /// A coordinate (the first or the second) over its range.
    pub fn coordinate(number: usize, range: S) -> Self {
        let nothing = S::constant(0.0);
        let mut by = [nothing; D];
        by[number] = S::constant(1.0);
        Self {
            value: range,
            by,
            curve: [nothing; P],
        }
    }

    /// The function of a function, by its value and its first and second derivative.
    pub(super) fn of(self, value: S, first: S, second: S) -> Self {
        Self {
            value,
            by: self.by.map(|slope| slope * first),
            curve: core::array::from_fn(|k| {
                let (i, j) = PAIRS[k];
                self.curve[k] * first + self.by[i] * self.by[j] * second
            }),
        }
    }

    /// Where this and another function may both apply, with the value of the one that does.
    fn or(self, other: Self, value: S) -> Self {
        Self {
            value,
            by: core::array::from_fn(|i| self.by[i].hull(other.by[i])),
            curve: [S::unknown(); P],
        }
    }
}

impl<S: Part, const D: usize, const P: usize> Add for Jet<S, D, P> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            by: core::array::from_fn(|i| self.by[i] + other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] + other.curve[k]),
        }
    }
}

impl<S: Part, const D: usize, const P: usize> Sub for Jet<S, D, P> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            by: core::array::from_fn(|i| self.by[i] - other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] - other.curve[k]),
        }
    }
}

impl<S: Part, const D: usize, const P: usize> Mul for Jet<S, D, P> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            by: core::array::from_fn(|i| crossed(self.by[i], other.value, self.value, other.by[i])),
            curve: core::array::from_fn(|k| {
                let (i, j) = PAIRS[k];
                total(
                    crossed(self.curve[k], other.value, self.value, other.curve[k]),
                    crossed(self.by[i], other.by[j], self.by[j], other.by[i]),
                )
            }),
        }
    }
}

impl<S: Part, const D: usize, const P: usize> Div for Jet<S, D, P> {
    type Output = Self;
    /// The divisor is positive.
    fn div(self, other: Self) -> Self {
        let inverse = other.value.inverse();
        let times = |a: S, b: S| a * b;
        let value = times(self.value, inverse);
        let by: [S; D] = core::array::from_fn(|i| times(self.by[i] - times(value, other.by[i]), inverse));
        let curve = core::array::from_fn(|k| {
            let (i, j) = PAIRS[k];
            let left = self.curve[k] - times(by[i], other.by[j]) - times(by[j], other.by[i]);
            times(left - times(value, other.curve[k]), inverse)
        });
        Self { value, by, curve }
    }
}

impl<S: Part, const D: usize, const P: usize> Scalar for Jet<S, D, P> {
    fn constant(value: f64) -> Self {
        let nothing = S::constant(0.0);
        Self {
            value: S::constant(value),
            by: [nothing; D],
            curve: [nothing; P],
        }
    }
    fn times(self, factor: f64) -> Self {
        Self {
            value: self.value.times(factor),
            by: self.by.map(|slope| slope.times(factor)),
            curve: self.curve.map(|curve| curve.times(factor)),
        }
    }
    fn plus(self, more: f64) -> Self {
        Self {
            value: self.value.plus(more),
            ..self
        }
    }
    fn under(self, numerator: f64) -> Self {
        let inverse = self.value.inverse();
        let value = inverse.times(numerator);
        let first = (value * inverse).times(-1.0);
        let second = (first * inverse).times(-2.0);
        self.of(value, first, second)
    }
    fn lesser(self, other: Self) -> Self {
        match self.value.compared(other.value) {
            Compared::First => self,
            Compared::Second => other,
            Compared::Unsure => self.or(other, self.value.lesser(other.value)),
        }
    }
    fn greater(self, other: Self) -> Self {
        match self.value.compared(other.value) {
            Compared::First => other,
            Compared::Second => self,
            Compared::Unsure => self.or(other, self.value.greater(other.value)),
        }
    }
    fn root(self) -> Self {
        let value = self.value.root();
        let first = value.inverse().times(0.5);
        let second = (first * self.value.inverse()).times(-0.5);
        self.of(value, first, second)
    }
    fn hypotenuse(self, leg: f64) -> Self {
        let inverse = self.value.hypotenuse(leg).inverse();
        let second = (inverse * inverse * inverse).times(leg * leg);
        self.of(
            self.value.hypotenuse(leg),
            self.value.over_hypotenuse(leg),
            second,
        )
    }
    fn over_hypotenuse(self, leg: f64) -> Self {
        let inverse = self.value.hypotenuse(leg).inverse();
        let first = (inverse * inverse * inverse).times(leg * leg);
        let share = self.value.over_hypotenuse(leg);
        self.of(share, first, (share * inverse * first).times(-3.0))
    }
    fn arc_tangent(self) -> Self {
        let first = (self.value * self.value).plus(1.0).inverse();
        let second = (self.value * first * first).times(-2.0);
        self.of(self.value.arc_tangent(), first, second)
    }
    fn highest(self) -> f64 {
        self.value.highest()
    }
    fn lowest(self) -> f64 {
        self.value.lowest()
    }
    fn known_below(self, most: f64) -> Self {
        Self {
            value: self.value.known_below(most),
            ..self
        }
    }
    fn or_down_to_one(self) -> Self {
        Self {
            value: self.value.or_down_to_one(),
            by: [S::unknown(); D],
            curve: [S::unknown(); P],
        }
    }
}

/// The sum of two products.
fn crossed<S: Part>(a: S, b: S, c: S, d: S) -> S {
    a * b + c * d
}
fn total<S: Part>(one: S, other: S) -> S {
    one + other
}
