//! Functions of jets over boxes, each where it has a value at the places of the box.
//!
//! All derivatives follow from those of the function by the rules for compositions. Where a derivative has no bound, as that of
//! a root at 0, it is unknown and the value still known. What comes out of anything here is a proper enclosure whose value is
//! within [`HUGE`]; [`Jet::tamed`] makes one of what sums and products give.
//!
//! A box may reach beyond the places where a function has a value: of a root of what is 0 at its border rounding makes
//! something that is partly below 0. What is enclosed then are the values where there are some. A box without any has none.

use super::interval::{HUGE, Interval};
use super::jet::{Jet, Scalar};
use core::f64::consts::{FRAC_PI_2, PI};

/// Divisors nearer to 0 than this count as 0.
const LEAST_DIVISOR: f64 = 1e-30;

/// Whole exponents up to this one are powers by multiplication, whatever the sign of the base.
const LARGEST_WHOLE: f64 = 1000.0;

/// The numbers from -1 to 1: what a sine can be.
const SINES: Interval = Interval { low: -1.0, high: 1.0 };

impl<const D: usize, const P: usize> Jet<Interval, D, P> {
    /// The same if its value is a proper interval within [`HUGE`]; derivatives that are not become unknown.
    pub fn tamed(self) -> Option<Self> {
        self.value.within(-HUGE, HUGE).then(|| Self {
            by: self.by.map(known),
            curve: self.curve.map(known),
            ..self
        })
    }

    pub fn negated(self) -> Self {
        self.times(-1.0)
    }

    /// The quotient by a divisor that is not 0 anywhere.
    pub fn divided(self, divisor: Self) -> Option<Self> {
        let (dividend, divisor) = if divisor.value.high < 0.0 {
            (self.negated(), divisor.negated())
        } else {
            (self, divisor)
        };
        let is_positive = divisor.value.low >= LEAST_DIVISOR;
        is_positive.then(|| dividend / divisor)?.tamed()
    }

    pub fn sine(self) -> Option<Self> {
        let (sine, cosine) = sine_and_cosine(self.value);
        self.of(sine, cosine, -sine).tamed()
    }

    pub fn cosine(self) -> Option<Self> {
        let (sine, cosine) = sine_and_cosine(self.value);
        self.of(cosine, -sine, -cosine).tamed()
    }

    pub fn tangent(self) -> Option<Self> {
        self.sine()?.divided(self.cosine()?)
    }

    pub fn arc_sine(self) -> Option<Self> {
        let sine = common(self.value, SINES)?;
        let below_one = Interval::exactly(1.0) - sine.squared();
        let first = known(below_one.root().inverse());
        let second = known(sine * first * first * first);
        // Within one unit in the last place (musl).
        self.of(sine.raised(libm::asin), first, second).tamed()
    }

    pub fn arc_cosine(self) -> Option<Self> {
        (constant(FRAC_PI_2) - self.arc_sine()?).tamed()
    }

    /// The arc of a tangent.
    pub fn arc(self) -> Option<Self> {
        let first = (self.value.squared() + Interval::exactly(1.0)).inverse();
        let second = (self.value * first * first).times(-2.0);
        self.of(self.value.raised(libm::atan), first, second).tamed()
    }

    /// The direction of the place `(x, y)`, from -pi to pi. Where a box has the line between the two in it, any of them.
    pub fn bearing(y: Self, x: Self) -> Option<Self> {
        if x.value.low >= LEAST_DIVISOR {
            return y.divided(x)?.arc();
        }
        let from = |axis: f64| (constant(axis) - x.divided(y)?.arc()?).tamed();
        if y.value.low >= LEAST_DIVISOR {
            return from(FRAC_PI_2);
        }
        if y.value.high <= -LEAST_DIVISOR {
            return from(-FRAC_PI_2);
        }
        if x.value.high <= -LEAST_DIVISOR && y.value.low >= 0.0 {
            return (constant::<D, P>(PI) + y.divided(x)?.arc()?).tamed();
        }
        let either_way = Interval::around(0.0, PI);
        Some(constant::<D, P>(0.0).with_unknown_derivatives(either_way))
    }

    /// The root of what is not negative in it.
    pub fn square_root(self) -> Option<Self> {
        let radicand = common(self.value, from_zero())?;
        let root = radicand.root();
        let first = known(root.inverse().times(0.5));
        let second = known((first * known(radicand.inverse())).times(-0.5));
        self.of(root, first, second).tamed()
    }

    /// Without its sign.
    pub fn magnitude(self) -> Option<Self> {
        let either = self.greater(self.negated());
        let value = Interval {
            low: either.value.low.max(0.0),
            ..either.value
        };
        Self { value, ..either }.tamed()
    }

    /// This to a power. A negative base has only whole powers.
    pub fn power(self, exponent: Self) -> Option<Self> {
        match exponent.as_constant() {
            Some(whole) if whole.trunc() == whole && whole.abs() <= LARGEST_WHOLE => self.whole_power(whole),
            Some(fixed) => self.fixed_power(fixed),
            None => (exponent * self.logarithm()?).tamed()?.exponential(),
        }
    }

    fn whole_power(self, exponent: f64) -> Option<Self> {
        if exponent < 0.0 {
            return constant(1.0).divided(self.whole_power(-exponent)?);
        }
        let of = |exponent: f64| known(whole_power(self.value, exponent));
        let first = of(exponent - 1.0).times(exponent);
        let second = of(exponent - 2.0).times(exponent * (exponent - 1.0));
        let value = whole_power(self.value, exponent);
        self.of(value, known(first), known(second)).tamed()
    }

    fn fixed_power(self, exponent: f64) -> Option<Self> {
        let base = if exponent > 0.0 {
            common(self.value, from_zero())?
        } else {
            (self.value.low >= LEAST_DIVISOR).then_some(self.value)?
        };
        let of = |exponent: f64| {
            let [a, b] = [base.low, base.high].map(|base| libm::pow(base, exponent));
            let ends = Interval {
                low: a.min(b),
                high: a.max(b),
            };
            // Within one unit in the last place (musl).
            ends.raised(core::convert::identity)
        };
        let first = known(known(of(exponent - 1.0)).times(exponent));
        let second = known(known(of(exponent - 2.0)).times(exponent * (exponent - 1.0)));
        self.of(of(exponent), first, second).tamed()
    }

    /// The natural logarithm of something positive.
    fn logarithm(self) -> Option<Self> {
        if self.value.low < LEAST_DIVISOR {
            return None;
        }
        let first = self.value.inverse();
        let second = (first * first).times(-1.0);
        self.of(self.value.raised(libm::log), first, second).tamed()
    }

    fn exponential(self) -> Option<Self> {
        let value = self.value.raised(libm::exp);
        self.of(value, known(value), known(value)).tamed()
    }

    /// The number that it is everywhere.
    fn as_constant(self) -> Option<f64> {
        let is_zero = |part: &Interval| *part == Interval::ZERO;
        let is_constant = self.value.low == self.value.high && self.by.iter().chain(&self.curve).all(is_zero);
        is_constant.then_some(self.value.low)
    }

    const fn with_unknown_derivatives(self, value: Interval) -> Self {
        Self {
            value,
            by: [Interval::UNKNOWN; D],
            curve: [Interval::UNKNOWN; P],
        }
    }
}

/// A constant with its rounding.
fn constant<const D: usize, const P: usize>(value: f64) -> Jet<Interval, D, P> {
    Jet {
        value: Interval::around(value, value.abs() * f64::EPSILON),
        ..Jet::constant(value)
    }
}

const fn from_zero() -> Interval {
    Interval {
        low: 0.0,
        high: f64::INFINITY,
    }
}

/// What lies in both, if anything does.
fn common(one: Interval, other: Interval) -> Option<Interval> {
    let both = one.and(other);
    (both.low <= both.high).then_some(both)
}

/// An enclosure that sums and products of it stay finite with.
fn known(part: Interval) -> Interval {
    let most = Interval::UNKNOWN;
    if part.within(most.low, most.high) {
        part
    } else {
        most
    }
}

/// Sine and cosine of any interval.
fn sine_and_cosine(angle: Interval) -> (Interval, Interval) {
    // Beyond a turn and more the middle says nothing.
    if angle.width() > 7.0 {
        return (SINES, SINES);
    }
    let (sine, cosine) = angle.sin_cos();
    (sine.and(SINES), cosine.and(SINES))
}

/// The powers of any interval for a whole exponent; below 0 that of a derivative that is 0 altogether.
fn whole_power(base: Interval, exponent: f64) -> Interval {
    let power = |base: f64| libm::pow(base, exponent);
    if exponent < 0.0 {
        Interval::ZERO
    } else if exponent == 0.0 {
        Interval::exactly(1.0)
    } else if exponent == 1.0 {
        base
    } else if exponent == 2.0 {
        base.squared()
    } else if exponent % 2.0 == 0.0 {
        let most = base.magnitude();
        let least = if base.low <= 0.0 && base.high >= 0.0 {
            0.0
        } else {
            base.low.abs().min(base.high.abs())
        };
        Interval {
            low: least,
            high: most,
        }
        .raised(power)
    } else {
        base.raised(power)
    }
}

#[cfg(test)]
mod tests {
    use super::super::OnPlane;
    use super::*;
    use proptest::prelude::*;

    type Plane = OnPlane<Interval>;

    /// A function over a box, and of numbers, with dual numbers of its own by differences.
    type Case = (fn(Plane, Plane) -> Option<Plane>, fn(f64, f64) -> f64);

    const CASES: &[Case] = &[
        (|x, y| (x * y).sine(), |x, y| libm::sin(x * y)),
        (|x, y| (x + y).cosine(), |x, y| libm::cos(x + y)),
        (|x, y| (x * y).times(0.1).tangent(), |x, y| libm::tan(x * y * 0.1)),
        (
            |x, y| (x - y).times(0.2).arc_sine(),
            |x, y| libm::asin((x - y) * 0.2),
        ),
        (
            |x, y| (x * y).times(0.05).arc_cosine(),
            |x, y| libm::acos(x * y * 0.05),
        ),
        (|x, y| (x * y).arc(), |x, y| libm::atan(x * y)),
        (|x, y| Plane::bearing(y, x), |x, y| libm::atan2(y, x)),
        (
            |x, y| (x * x + y * y).square_root(),
            |x, y| libm::sqrt(x * x + y * y),
        ),
        (|x, _| x.magnitude(), |x, _| x.abs()),
        (|x, y| x.divided(y), |x, y| x / y),
        (
            |x, y| (x + y).power(Plane::constant(3.0)),
            |x, y| libm::pow(x + y, 3.0),
        ),
        (
            |x, y| (x - y).power(Plane::constant(4.0)),
            |x, y| libm::pow(x - y, 4.0),
        ),
        (|x, _| x.power(Plane::constant(-2.0)), |x, _| libm::pow(x, -2.0)),
        (
            |x, y| (x * x + y * y).power(Plane::constant(0.7)),
            |x, y| libm::pow(x * x + y * y, 0.7),
        ),
        (
            |x, y| Plane::constant(1.5).power(x * y),
            |x, y| libm::pow(1.5, x * y),
        ),
        (|x, y| x.magnitude()?.power(y), |x, y| libm::pow(x.abs(), y)),
    ];

    fn within(interval: Interval, number: f64, slack: f64) -> bool {
        interval.low <= number + slack && number - slack <= interval.high
    }

    proptest! {
        /// Values, slopes and curvatures at places of a box lie in what is enclosed over it; slopes and curvatures by
        /// central differences, which are off by a little.
        #[test]
        fn what_is_enclosed_holds_at_places_of_the_box(
            corner in [-3.0..3.0_f64, -3.0..3.0_f64],
            size in [1e-3..1.0_f64, 1e-3..1.0_f64],
            share in [0.01..0.99_f64, 0.01..0.99_f64],
        ) {
            let range = |axis: usize| Interval { low: corner[axis], high: corner[axis] + size[axis] };
            let [x, y] = [0, 1].map(|axis| corner[axis] + share[axis] * size[axis]);
            for (number, (enclose, plain)) in CASES.iter().enumerate() {
                let coordinate = |axis| Plane::coordinate(axis, range(axis));
                let Some(enclosed) = enclose(coordinate(0), coordinate(1)) else { continue };
                let here = plain(x, y);
                prop_assert!(!here.is_finite() || within(enclosed.value, here, 0.0), "value {number}: {enclosed:?} {here}");
                let h = 1e-5;
                let slopes = [
                    (plain(x + h, y) - plain(x - h, y)) / (2.0 * h),
                    (plain(x, y + h) - plain(x, y - h)) / (2.0 * h),
                ];
                let h = 1e-4;
                let curves = [
                    (plain(x + h, y) - 2.0 * here + plain(x - h, y)) / (h * h),
                    (plain(x + h, y + h) - plain(x + h, y - h) - plain(x - h, y + h) + plain(x - h, y - h)) / (4.0 * h * h),
                    (plain(x, y + h) - 2.0 * here + plain(x, y - h)) / (h * h),
                ];
                for (bound, slope) in enclosed.by.iter().zip(slopes) {
                    // Steps of the function itself, and places without a value, have no differences.
                    let slack = 1e-4 * (1.0 + bound.magnitude());
                    prop_assert!(slope.is_nan() || slope.abs() > 1e4 || within(*bound, slope, slack), "slope {number}: {enclosed:?} {slope}");
                }
                for (bound, curve) in enclosed.curve.iter().zip(curves) {
                    let slack = 1e-2 * (1.0 + bound.magnitude());
                    prop_assert!(curve.is_nan() || curve.abs() > 1e4 || within(*bound, curve, slack), "curve {number}: {enclosed:?} {curve}");
                }
            }
        }
    }

    fn over(low: f64, high: f64) -> Plane {
        Plane::coordinate(0, Interval { low, high })
    }

    #[test]
    fn boxes_without_a_value_have_none() {
        assert_eq!(over(-2.0, -1.0).square_root(), None);
        assert_eq!(over(1.5, 2.0).arc_sine(), None);
        assert_eq!(
            over(-0.5, 0.5).tangent().map(|jet| jet.value.high > 0.5),
            Some(true)
        );
        assert_eq!(over(1.0, 2.0).tangent(), None, "a pole lies in it");
        assert_eq!(over(-1.0, 1.0).power(Plane::constant(-1.0)), None);
        assert_eq!(over(-1.0, -0.5).power(Plane::constant(0.5)), None);
        assert_eq!(over(1.0, 2.0).divided(over(-1.0, 1.0)), None);
        assert_eq!(over(1e29, 1e30).power(Plane::constant(2.0)), None, "too large");
    }

    #[test]
    fn a_root_at_zero_has_a_value_and_no_known_slope() {
        let root = over(-1e-12, 4.0).square_root().unwrap();
        assert!(within(root.value, 2.0, 0.0) && root.value.low == 0.0 && root.value.high < 2.0 + 1e-12);
        assert!(root.by[0].magnitude() >= 1e60);
        // What is multiplied by it stays an enclosure.
        let product = (root * Plane::constant(0.0)).tamed().unwrap();
        assert!(within(product.value, 0.0, 0.0));
    }

    #[test]
    fn a_bearing_that_may_be_either_is_any() {
        let jet = Plane::bearing(
            Plane::coordinate(1, Interval { low: -0.1, high: 0.1 }),
            over(-1.0, -0.5),
        )
        .unwrap();
        assert!(jet.value.low <= -PI && jet.value.high >= PI);
        let jet = Plane::bearing(
            Plane::coordinate(1, Interval { low: 0.0, high: 0.1 }),
            over(-1.0, -0.5),
        )
        .unwrap();
        assert!(jet.value.low > 2.9 && jet.value.high >= PI, "{jet:?}");
    }
}
