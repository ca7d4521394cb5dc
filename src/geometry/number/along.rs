//! Quantities along a span of a course, with their first and second derivative: what carries the proof.
//!
//! A span of the course is described by a parameter `t` from -1 to 1. A quantity `f(t)` is held by five intervals: what
//! `f` and `f'` are at `t = 0` (as narrow as rounding allows), and what `f`, `f'` and `f''` range over on the whole span.
//! Each operation computes all five by the chain rule, then narrows two of them by Taylor's theorem,
//!
//! `f(t) = f(0) + t f'(0) + t^2/2 f''(some place)`, `f'(t) = f'(0) + t f''(some place)`,
//!
//! so that the range exceeds the true one by a term of the second order in the span's length only (the mean value form;
//! Moore, Kearfott, Cloud: Introduction to Interval Analysis, 2009, chapter 6). Roots and arcs have an answer only where the
//! quantity stays in their domain on the whole span.

use super::interval::{HUGE, Interval};
use super::plain::Number;
use core::ops::{Add, Mul, Neg, Sub};

/// Below this, a divisor or a radicand counts as zero: in mm^2 or without unit.
const NEXT_TO_NOTHING: f64 = 1e-12;

/// A quantity on a span; derivatives are by the span's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<N = f64> {
    /// `f(0)`.
    here: Interval<N>,
    /// `f'(0)`.
    slope: Interval<N>,
    /// `f` on the span.
    value: Interval<N>,
    /// `f'` on the span.
    rate: Interval<N>,
    /// `f''` on the span.
    bend: Interval<N>,
}

impl<N: Number> Along<N> {
    #[inline(always)]
    pub fn constant(number: N) -> Self {
        let zero = Interval::exactly(number.of(0.0));
        Self {
            here: Interval::exactly(number),
            slope: zero,
            value: Interval::exactly(number),
            rate: zero,
            bend: zero,
        }
    }

    /// `middle + slope t`.
    #[inline(always)]
    pub fn line(middle: N, slope: N) -> Self {
        Self {
            here: Interval::exactly(middle),
            slope: Interval::exactly(slope),
            value: Interval::around(middle, slope.magnitude()),
            rate: Interval::exactly(slope),
            bend: Interval::exactly(middle.of(0.0)),
        }
    }

    /// At the middle of the span.
    #[inline(always)]
    pub const fn middle(self) -> Interval<N> {
        self.here
    }

    /// On the whole span.
    #[inline(always)]
    pub const fn value(self) -> Interval<N> {
        self.value
    }

    /// The derivative on the whole span.
    #[inline(always)]
    pub const fn rate(self) -> Interval<N> {
        self.rate
    }

    /// The second derivative on the whole span.
    #[inline(always)]
    pub const fn bend(self) -> Interval<N> {
        self.bend
    }

    /// At the beginning of the span.
    #[inline(always)]
    pub fn begin(self) -> Interval<N> {
        (self.here - self.slope + self.bend * 0.5).and(self.value)
    }

    /// At the end of the span.
    #[inline(always)]
    pub fn end(self) -> Interval<N> {
        (self.here + self.slope + self.bend * 0.5).and(self.value)
    }

    #[inline(always)]
    pub fn squared(self) -> Self {
        Self {
            here: self.here.squared(),
            slope: self.here * self.slope * 2.0,
            value: self.value.squared(),
            rate: self.value * self.rate * 2.0,
            bend: (self.value * self.bend + self.rate.squared()) * 2.0,
        }
        .narrowed()
    }

    /// The root, where the quantity stays positive.
    #[inline(always)]
    pub fn root(self) -> Held<N> {
        let is_positive = at_least(self.value.low, NEXT_TO_NOTHING);
        let (here, value) = (self.here.and(self.value).root(), self.value.root());
        let rate = self.rate.over(value) * 0.5;
        let root = Self {
            here,
            slope: self.slope.over(here) * 0.5,
            value,
            rate,
            // Of (f^2)'' = 2 f f'' + 2 f'^2.
            bend: (self.bend * 0.5 - rate.squared()).over(value),
        };
        root.narrowed().held(is_positive)
    }

    /// Sine and cosine.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin_here, cos_here) = self.here.sin_cos();
        // Neither changes faster than the angle.
        let change = (self.value - self.here).magnitude();
        let around = Interval::around(change.of(0.0), change);
        let unit = Interval::exactly(change.of(1.0)).either_way();
        let (sin, cos) = ((around + sin_here).and(unit), (around + cos_here).and(unit));
        let rate_squared = self.rate.squared();
        let sine = Self {
            here: sin_here,
            slope: cos_here * self.slope,
            value: sin,
            rate: cos * self.rate,
            bend: cos * self.bend - sin * rate_squared,
        };
        let cosine = Self {
            here: cos_here,
            slope: -(sin_here * self.slope),
            value: cos,
            rate: -(sin * self.rate),
            bend: -(sin * self.bend) - cos * rate_squared,
        };
        (sine.narrowed(), cosine.narrowed())
    }

    /// The angle of a point `(x, y)` that stays away from the origin. It is continuous on the span, and at the middle of
    /// the span within half a turn either way.
    #[inline(always)]
    pub fn arc(y: Self, x: Self) -> Held<N> {
        let distance_squared = x.value.squared() + y.value.squared();
        let is_away = at_least(distance_squared.low, NEXT_TO_NOTHING);
        let here = Interval::direction(y.here, x.here, distance_squared.root().low);
        let here_squared = (x.here.squared() + y.here.squared()).and(distance_squared);
        let slope = (x.here * y.slope - y.here * x.slope).over(here_squared);
        let rate = (x.value * y.rate - y.value * x.rate).over(distance_squared);
        // Of (r^2 f')' = (x y' - y x')', where r^2 has the derivative 2 (x x' + y y').
        let outward = x.value * x.rate + y.value * y.rate;
        let bend = (x.value * y.bend - y.value * x.bend - rate * outward * 2.0).over(distance_squared);
        let arc = Self {
            here,
            slope,
            value: here + rate.either_way(),
            rate,
            bend,
        };
        arc.narrowed().held(is_away)
    }

    /// Shifted by a constant.
    #[inline(always)]
    pub fn plus(self, constant: f64) -> Self {
        let by = Interval::exactly(self.here.low.of(constant));
        Self {
            here: self.here + by,
            value: self.value + by,
            ..self
        }
    }

    #[inline(always)]
    fn narrowed(self) -> Self {
        let rate = self.rate.and(self.slope + self.bend.either_way());
        let by_rate = self.here + rate.either_way();
        let by_bend = self.here + self.slope.either_way() + self.bend.up_to_half();
        Self {
            rate,
            value: self.value.and(by_rate).and(by_bend),
            ..self
        }
    }

    /// Multiplied by a number.
    #[inline(always)]
    pub fn scaled(self, factor: N) -> Self {
        Self {
            here: self.here.scaled(factor),
            slope: self.slope.scaled(factor),
            value: self.value.scaled(factor),
            rate: self.rate.scaled(factor),
            bend: self.bend.scaled(factor),
        }
    }

    /// With whether it exists. Only divisions make numbers large.
    #[inline(always)]
    fn held(self, exists: N) -> Held<N> {
        let exists = exists
            .lesser(is_bounded(self.bend.magnitude()))
            .lesser(is_bounded(self.rate.magnitude()));
        Held { along: self, exists }
    }
}

/// A quantity that may not exist on the whole span: what stands there then means nothing.
#[derive(Clone, Copy, Debug)]
pub struct Held<N> {
    pub along: Along<N>,
    /// 1 where it exists, 0 where it does not.
    pub exists: N,
}

/// 1 where a number is below [`HUGE`], else 0.
#[inline(always)]
fn is_bounded<N: Number>(number: N) -> N {
    number.below(number.of(HUGE), number.of(1.0), number.of(0.0))
}

/// 1 where a number is at least as large as a bound, else 0.
#[inline(always)]
fn at_least<N: Number>(number: N, bound: f64) -> N {
    number.below(number.of(bound), number.of(0.0), number.of(1.0))
}

impl<N: Number> Neg for Along<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            here: -self.here,
            slope: -self.slope,
            value: -self.value,
            rate: -self.rate,
            bend: -self.bend,
        }
    }
}

impl<N: Number> Add for Along<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            here: self.here + other.here,
            slope: self.slope + other.slope,
            value: self.value + other.value,
            rate: self.rate + other.rate,
            bend: self.bend + other.bend,
        }
        .narrowed()
    }
}

impl<N: Number> Sub for Along<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<N: Number> Mul for Along<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            here: self.here * other.here,
            slope: self.here * other.slope + self.slope * other.here,
            value: self.value * other.value,
            rate: self.value * other.rate + self.rate * other.value,
            bend: self.value * other.bend + self.bend * other.value + self.rate * other.rate * 2.0,
        }
        .narrowed()
    }
}

impl<N: Number> Mul<f64> for Along<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.scaled(self.here.low.of(factor))
    }
}
