//! Functions with their first and second derivatives, of numbers or of intervals.
//!
//! Where a function has a kink in a box, its derivatives there are unknown. Sums, products and compositions follow the usual
//! rules (Griewank and Walther: Evaluating Derivatives, 2008).

use super::number::{Interval, Number, outward};
use core::ops::{Add, Div, Mul, Sub};

/// What the parts of a jet are: numbers, or enclosures of them.
pub(super) trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Just this.
    fn exactly(value: f64) -> Self;
    fn unknown() -> Self;
    /// This many times a plain number.
    fn times(self, factor: f64) -> Self;
    /// With a plain number added.
    fn plus(self, more: f64) -> Self;
    /// One part in something positive.
    fn inverse(self) -> Self;
    /// The root of something positive.
    fn root(self) -> Self;
    /// The hypotenuse over this leg, which is not negative, and a plain one.
    fn hypotenuse(self, leg: f64) -> Self;
    /// This leg over that hypotenuse.
    fn over_hypotenuse(self, leg: f64) -> Self;
    /// The arc of a tangent.
    fn arc_tangent(self) -> Self;
    /// Whether this is the smaller of two; unsure where they overlap.
    fn compared(self, other: Self) -> Compared;
    /// No value is above this one.
    fn highest(self) -> f64;
    /// No value is below this one.
    fn lowest(self) -> f64;
    /// This, of which it is known that it is no more than that.
    fn known_below(self, most: f64) -> Self;
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
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    fn plus(self, more: f64) -> Self {
        self + more
    }
    fn inverse(self) -> Self {
        1.0 / self
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn hypotenuse(self, leg: f64) -> Self {
        Number::hypotenuse(self, leg)
    }
    fn over_hypotenuse(self, leg: f64) -> Self {
        Number::over_hypotenuse(self, leg)
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
    fn highest(self) -> f64 {
        self
    }
    fn lowest(self) -> f64 {
        self
    }
    fn known_below(self, _: f64) -> Self {
        self
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
    fn times(self, factor: f64) -> Self {
        self.times(factor)
    }
    fn plus(self, more: f64) -> Self {
        self.plus(more)
    }
    fn inverse(self) -> Self {
        self.inverse()
    }
    fn root(self) -> Self {
        outward(self.low.sqrt(), self.high.sqrt())
    }
    fn hypotenuse(self, leg: f64) -> Self {
        self.hypotenuse(leg)
    }
    fn over_hypotenuse(self, leg: f64) -> Self {
        self.over_hypotenuse(leg)
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
    fn highest(self) -> f64 {
        self.high
    }
    fn lowest(self) -> f64 {
        self.low
    }
    fn known_below(self, most: f64) -> Self {
        self.known_below(most)
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

/// A function of so many coordinates (one or two) with its slopes along them and as many curvatures as there are pairs of
/// coordinates: along the first, across, along the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet<S, const COORDINATES: usize, const PAIRED: usize> {
    pub(super) value: S,
    pub(super) by: [S; COORDINATES],
    pub(super) curve: [S; PAIRED],
}

/// A function of one coordinate.
pub(super) type OnLine<S> = Jet<S, 1, 1>;

/// A function of two coordinates.
pub(super) type OnPlane<S> = Jet<S, 2, 3>;

/// Which two coordinates a curvature is along.
const PAIRS: [(usize, usize); 3] = [(0, 0), (0, 1), (1, 1)];

impl<S: Scalar, const D: usize, const P: usize> Jet<S, D, P> {
    /// A coordinate (the first or the second) over its range.
    pub(super) fn coordinate(number: usize, range: S) -> Self {
        let nothing = S::exactly(0.0);
        let mut by = [nothing; D];
        by[number] = S::exactly(1.0);
        Self {
            value: range,
            by,
            curve: [nothing; P],
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
            by: [S::unknown(); D],
            curve: [S::unknown(); P],
        }
    }
}

impl<S: Scalar, const D: usize, const P: usize> Add for Jet<S, D, P> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            by: core::array::from_fn(|i| self.by[i] + other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] + other.curve[k]),
        }
    }
}

impl<S: Scalar, const D: usize, const P: usize> Sub for Jet<S, D, P> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            by: core::array::from_fn(|i| self.by[i] - other.by[i]),
            curve: core::array::from_fn(|k| self.curve[k] - other.curve[k]),
        }
    }
}

impl<S: Scalar, const D: usize, const P: usize> Mul for Jet<S, D, P> {
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

impl<S: Scalar, const D: usize, const P: usize> Div for Jet<S, D, P> {
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

impl<S: Scalar, const D: usize, const P: usize> Number for Jet<S, D, P> {
    fn constant(value: f64) -> Self {
        let nothing = S::exactly(0.0);
        Self {
            value: S::exactly(value),
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
        Self::kinked(S::exactly(1.0).larger(self.value))
    }
}

/// The sum of two products.
fn crossed<S: Scalar>(a: S, b: S, c: S, d: S) -> S {
    a * b + c * d
}
fn total<S: Scalar>(one: S, other: S) -> S {
    one + other
}
