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
use core::ops::{Add, Mul, Neg, Sub};

/// Below this, a divisor or a radicand counts as zero: in mm^2 or without unit.
const NEXT_TO_NOTHING: f64 = 1e-12;

/// A quantity on a span; derivatives are by the span's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Along {
    /// `f(0)`.
    here: Interval,
    /// `f'(0)`.
    slope: Interval,
    /// `f` on the span.
    value: Interval,
    /// `f'` on the span.
    rate: Interval,
    /// `f''` on the span.
    bend: Interval,
}

impl Along {
    #[inline(always)]
    pub(super) const fn constant(number: f64) -> Self {
        Self {
            here: Interval::exactly(number),
            slope: Interval::ZERO,
            value: Interval::exactly(number),
            rate: Interval::ZERO,
            bend: Interval::ZERO,
        }
    }

    /// `middle + slope t`.
    #[inline(always)]
    pub(super) fn line(middle: f64, slope: f64) -> Self {
        Self {
            here: Interval::exactly(middle),
            slope: Interval::exactly(slope),
            value: Interval::around(middle, slope.abs()),
            rate: Interval::exactly(slope),
            bend: Interval::ZERO,
        }
    }

    /// On the whole span.
    #[inline(always)]
    pub(super) const fn value(self) -> Interval {
        self.value
    }

    /// The derivative on the whole span.
    #[inline(always)]
    pub(super) const fn rate(self) -> Interval {
        self.rate
    }

    /// The second derivative on the whole span.
    #[inline(always)]
    pub(super) const fn bend(self) -> Interval {
        self.bend
    }

    /// At the beginning of the span.
    #[inline(always)]
    pub(super) fn begin(self) -> Interval {
        (self.here - self.slope + self.bend * 0.5).and(self.value)
    }

    /// At the end of the span.
    #[inline(always)]
    pub(super) fn end(self) -> Interval {
        (self.here + self.slope + self.bend * 0.5).and(self.value)
    }

    #[inline(always)]
    pub(super) fn squared(self) -> Self {
        Self {
            here: self.here.squared(),
            slope: self.here * self.slope * 2.0,
            value: self.value.squared(),
            rate: self.value * self.rate * 2.0,
            bend: (self.value * self.bend + self.rate.squared()) * 2.0,
        }
        .narrowed()
    }

    /// Where the quantity stays positive.
    #[inline(always)]
    pub(super) fn root(self) -> Option<Self> {
        if self.value.low < NEXT_TO_NOTHING {
            return None;
        }
        let (here, value) = (self.here.and(self.value).root(), self.value.root());
        let rate = self.rate.over(value) * 0.5;
        Self {
            here,
            slope: self.slope.over(here) * 0.5,
            value,
            rate,
            // Of (f^2)'' = 2 f f'' + 2 f'^2.
            bend: (self.bend * 0.5 - rate.squared()).over(value),
        }
        .narrowed()
        .bounded()
    }

    /// Sine and cosine.
    #[inline(always)]
    pub(super) fn sin_cos(self) -> (Self, Self) {
        let (sin_here, cos_here) = self.here.sin_cos();
        // Neither changes faster than the angle.
        let change = (self.value - self.here).magnitude();
        let near = |here: Interval| Interval::around(0.0, change) + here;
        let (sin, cos) = (
            near(sin_here).and(Interval::UNIT),
            near(cos_here).and(Interval::UNIT),
        );
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
    pub(super) fn arc(y: Self, x: Self) -> Option<Self> {
        let distance_squared = x.value.squared() + y.value.squared();
        if distance_squared.low < NEXT_TO_NOTHING {
            return None;
        }
        let here = Interval::direction(y.here, x.here, distance_squared.root().low);
        let here_squared = (x.here.squared() + y.here.squared()).and(distance_squared);
        let slope = (x.here * y.slope - y.here * x.slope).over(here_squared);
        let rate = (x.value * y.rate - y.value * x.rate).over(distance_squared);
        // Of (r^2 f')' = (x y' - y x')', where r^2 has the derivative 2 (x x' + y y').
        let outward = x.value * x.rate + y.value * y.rate;
        let bend = (x.value * y.bend - y.value * x.bend - rate * outward * 2.0).over(distance_squared);
        Self {
            here,
            slope,
            value: here + rate.either_way(),
            rate,
            bend,
        }
        .narrowed()
        .bounded()
    }

    /// Shifted by a constant.
    #[inline(always)]
    pub(super) fn plus(self, constant: f64) -> Self {
        let by = Interval::exactly(constant);
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

    /// Only divisions make numbers large.
    #[inline(always)]
    fn bounded(self) -> Option<Self> {
        (self.bend.magnitude() < HUGE && self.rate.magnitude() < HUGE).then_some(self)
    }
}

impl Neg for Along {
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

impl Add for Along {
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

impl Sub for Along {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Along {
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

impl Mul<f64> for Along {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self {
            here: self.here * factor,
            slope: self.slope * factor,
            value: self.value * factor,
            rate: self.rate * factor,
            bend: self.bend * factor,
        }
    }
}
