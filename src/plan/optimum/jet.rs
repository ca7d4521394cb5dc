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

/// The sum of two products.
fn crossed<S: Scalar>(a: S, b: S, c: S, d: S) -> S {
    a * b + c * d
}
fn total<S: Scalar>(one: S, other: S) -> S {
    one + other
}
