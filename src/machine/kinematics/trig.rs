//! Sine, cosine and arc tangent for kinematics: the same bits on every platform, and the same whether a compiler works on
//! one value or on eight at once.
//!
//! Both functions are free of branches and of tables, made of additions, multiplications, one division and selections only.
//! A plain loop over lanes that calls them is therefore turned into vector instructions, and as nothing is fused
//! (`a * b + c` rounds twice everywhere), the lanes hold exactly what a lone call returns.
//!
//! The way is that of fdlibm (Sun Microsystems, 1993): reduction by Cody and Waite's split of pi/2, then one polynomial. The
//! polynomials are minimax in the relative error of the result (Remez, computed with 90 digits): `sin` to 2^-57.9, `cos` to
//! 2^-63.9, `atan` to 2^-59.4. Against exact values all three stay below 1.6 units in the last place.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_4, PI, TAU};

/// Largest angle, in rad, that [`Turn::of`] takes: beyond it the reduction by pi/2 is not exact.
pub const WIDEST: f64 = 1e6;

/// An angle as its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Sine.
    pub sin: f64,
    /// Cosine.
    pub cos: f64,
}

/// 1.5 * 2^52: added to a number below 2^51, it leaves no room for a fraction, so the sum is rounded to a whole number, half
/// to even, whose last bits are the last bits of the mantissa.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// pi/2 in three parts. The first two have 33 bits, so that their products with whole numbers below 2^20 are exact.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_795_950_6e-21,
];

/// `(sin(r) / r - 1) / r^2` in powers of `r^2`, for `|r| <= pi/4`.
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_3,
    0.008_333_333_333_322_108,
    -0.000_198_412_698_295_802_58,
    2.755_731_361_803_152_3e-6,
    -2.505_074_721_834_335_8e-8,
    1.589_619_755_768_417e-10,
];

/// `(cos(r) - 1 + r^2 / 2) / r^4` in powers of `r^2`, for `|r| <= pi/4`.
const COS: [f64; 6] = [
    0.041_666_666_666_666_595,
    -0.001_388_888_888_887_304,
    2.480_158_728_884_204e-5,
    -2.755_731_417_640_393_7e-7,
    2.087_570_043_551_895e-9,
    -1.135_851_481_919_780_4e-11,
];

/// `(atan(t) / t - 1) / t^2` in powers of `t^2`, for `|t| <= tan(pi/8)`.
const ATAN: [f64; 11] = [
    -0.333_333_333_333_332,
    0.199_999_999_999_531_58,
    -0.142_857_142_801_573_02,
    0.111_111_107_816_760_85,
    -0.090_908_977_110_403_04,
    0.076_920_594_573_055_24,
    -0.066_630_961_693_255_68,
    0.058_478_366_677_776_77,
    -0.050_390_863_505_858_89,
    0.038_059_442_650_145_534,
    -0.017_902_030_865_563_256,
];

/// tan(pi/8), up to which the arc tangent needs no shift by pi/4.
const TAN_PI_8: f64 = 0.414_213_562_373_095_03;

/// pi/4 in two parts. The first has 50 bits, so that its products with 0 to 4 are exact.
const QUARTER_PI: [f64; 2] = [FRAC_PI_4, 3.061_616_997_868_383e-17];

impl Turn {
    /// The angle 0.
    pub const NONE: Self = Self { sin: 0.0, cos: 1.0 };

    /// Sine and cosine of an angle, in rad, up to [`WIDEST`] either way, each to 1.6 units in the last place. The sine of
    /// -0 is 0. For larger angles the numbers have no meaning; they may be NaN.
    #[inline(always)]
    #[must_use]
    pub fn of(angle: f64) -> Self {
        let shifted = angle * FRAC_2_PI + WHOLE;
        let quarters = shifted - WHOLE;
        // The first difference and both products are exact; `low` is what the second difference lost, less the third part.
        let first = angle - quarters * HALF_PI[0];
        let second = quarters * HALF_PI[1];
        let high = first - second;
        let low = (first - high) - second - quarters * HALF_PI[2];

        let square = high * high;
        let sin = high + (square * (high * polynomial(&SIN, square) - 0.5 * low) + low);
        let half = 0.5 * square;
        let most = 1.0 - half;
        let rest = square * square * polynomial(&COS, square) - high * low;
        let cos = most + ((1.0 - most - half) + rest);

        let quadrant = shifted.to_bits();
        let is_odd = Mask::of_bit(quadrant & 1);
        Self {
            sin: negated_if(is_odd.either(cos, sin), quadrant & 2),
            cos: negated_if(is_odd.either(sin, cos), quadrant.wrapping_add(1) & 2),
        }
    }

    /// The angle, within half a turn: see [`atan2`].
    #[inline(always)]
    #[must_use]
    pub fn angle(self) -> f64 {
        atan2(self.sin, self.cos)
    }

    /// The angle the other way.
    #[inline(always)]
    #[must_use]
    pub fn back(self) -> Self {
        Self {
            sin: -self.sin,
            cos: self.cos,
        }
    }
}

/// One angle after the other.
impl core::ops::Add for Turn {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            sin: self.sin * other.cos + self.cos * other.sin,
            cos: self.cos * other.cos - self.sin * other.sin,
        }
    }
}

/// Sine and cosine of any finite angle: as [`Turn::of`] up to [`WIDEST`], beyond by `libm`. For single angles only, as it
/// branches.
#[must_use]
pub fn turn_of_any(angle: f64) -> Turn {
    if angle.abs() <= WIDEST {
        Turn::of(angle)
    } else {
        let (sin, cos) = libm::sincos(angle);
        Turn { sin, cos }
    }
}

/// The angle, from -pi to pi, of the point `(x, y)` about the origin, to 1.6 units in the last place, for coordinates up to
/// 2^1022. Zeros count with their signs as in C: `atan2(0, 0)` is 0, `atan2(0, -0)` is pi, and a `y` of -0 gives their
/// negatives. Infinite coordinates may give NaN.
#[inline(always)]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (width, height) = (x.abs(), y.abs());
    let is_steep = Mask::of(height > width);
    let (short, long) = (is_steep.either(width, height), is_steep.either(height, width));
    // From tan(pi/8) on, the angle is counted from pi/4: tan(a - pi/4) = (tan a - 1) / (tan a + 1).
    let is_diagonal = Mask::of(short > long * TAN_PI_8);
    let over = is_diagonal.either(short - long, short);
    let under = is_diagonal.either(short + long, long);
    let under = Mask::of(under == 0.0).either(1.0, under);
    let tangent = over / under;
    let square = tangent * tangent;
    let angle = tangent + tangent * square * polynomial(&ATAN, square);

    // The answer is a multiple of pi/4 and more or less that angle.
    let eighths = is_diagonal.either(1.0, 0.0);
    let eighths = is_steep.either(2.0 - eighths, eighths);
    let angle = is_steep.either(-angle, angle);
    let is_behind = Mask::of(x.is_sign_negative());
    let eighths = is_behind.either(4.0 - eighths, eighths);
    let angle = is_behind.either(-angle, angle);
    let whole = eighths * QUARTER_PI[0] + (angle + eighths * QUARTER_PI[1]);
    whole.copysign(y)
}

/// The same angle within half a turn either way, -pi excluded, for angles up to 2^51.
#[inline(always)]
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    let rest = angle - TAU * whole_turns(angle);
    let rest = Mask::of(rest <= -PI).either(rest + TAU, rest);
    Mask::of(rest > PI).either(rest - TAU, rest)
}

/// The same angle within half a turn of another, for angles up to 2^51.
#[inline(always)]
#[must_use]
pub fn nearest(angle: f64, near: f64) -> f64 {
    angle + TAU * whole_turns(near - angle)
}

/// How many turns an angle is, to the nearest whole number.
#[inline(always)]
fn whole_turns(angle: f64) -> f64 {
    (angle * (1.0 / TAU) + WHOLE) - WHOLE
}

/// A polynomial of at least the first degree. Even and odd powers are summed side by side, which halves the chain of
/// operations that wait for one another.
#[inline(always)]
fn polynomial<const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    let square = x * x;
    let (mut waiting, mut last) = (coefficients[N - 1], coefficients[N - 2]);
    for coefficient in coefficients.iter().rev().skip(2) {
        (waiting, last) = (last, waiting * square + coefficient);
    }
    last + x * waiting
}

/// All bits or none: what selects between two numbers. Written as `if`, a selection may become a branch, which leaves a loop
/// over lanes without vector instructions.
#[derive(Clone, Copy)]
struct Mask(u64);

impl Mask {
    #[inline(always)]
    fn of(holds: bool) -> Self {
        Self::of_bit(u64::from(holds))
    }

    /// Of a bit that is 0 or 1.
    #[inline(always)]
    fn of_bit(bit: u64) -> Self {
        Self(bit.wrapping_neg())
    }

    /// The first number where it holds, else the second.
    #[inline(always)]
    fn either(self, yes: f64, no: f64) -> f64 {
        f64::from_bits((yes.to_bits() & self.0) | (no.to_bits() & !self.0))
    }
}

/// Negates where the bit with the value 2 is set.
#[inline(always)]
fn negated_if(value: f64, bit: u64) -> f64 {
    f64::from_bits(value.to_bits() ^ (bit << 62))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, FRAC_PI_3};

    /// SplitMix64 (Steele, Lea, Flood 2014): numbers from -1 to 1.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// By how many units in the last place of the second number the first is off.
    fn off(is: f64, should: f64) -> f64 {
        let unit = f64::from_bits(should.abs().to_bits() + 1) - should.abs();
        ((is - should) / unit).abs()
    }

    fn assert_turn(angle: f64) {
        let turn = Turn::of(angle);
        let (sin, cos) = libm::sincos(angle);
        assert!(
            off(turn.sin, sin) <= 2.0,
            "sin {angle:e}: {:e}, {sin:e}",
            turn.sin
        );
        assert!(
            off(turn.cos, cos) <= 2.0,
            "cos {angle:e}: {:e}, {cos:e}",
            turn.cos
        );
    }

    fn assert_angle(y: f64, x: f64) {
        let (is, should) = (atan2(y, x), libm::atan2(y, x));
        assert!(off(is, should) <= 2.0, "atan2 {y:e} {x:e}: {is:e}, {should:e}");
        assert_eq!(is.is_sign_negative(), should.is_sign_negative());
    }

    #[test]
    fn sines_and_cosines_are_those_of_libm() {
        let mut random = Random(1);
        for _ in 0..500_000 {
            let number = random.next();
            assert_turn(7.0 * number);
            assert_turn(WIDEST * number);
            assert_turn(number * libm::exp2(-500.0 * (1.0 + random.next())));
        }
        for quarters in -640_000..640_000 {
            // The nearest numbers to multiples of a quarter turn are where reduction loses most.
            let angle = f64::from(quarters) * FRAC_PI_2;
            if quarters % 7 == 0 && quarters != 0 && angle.abs() <= WIDEST {
                assert_turn(angle);
                assert_turn(f64::from_bits(angle.to_bits() + 1));
            }
        }
        for angle in [1e-300, f64::MIN_POSITIVE, WIDEST, -WIDEST, PI, TAU, FRAC_PI_4] {
            assert_turn(angle);
        }
        assert_eq!(Turn::of(0.0), Turn::NONE);
        assert_eq!(Turn::of(-0.0), Turn::NONE);
    }

    #[test]
    fn arc_tangents_are_those_of_libm() {
        let mut random = Random(2);
        for _ in 0..1_000_000 {
            let (y, x) = (random.next(), random.next());
            assert_angle(y, x);
            assert_angle(y * libm::exp2(200.0 * random.next()), x);
        }
        let edges = [
            0.0,
            5e-324,
            1e-310,
            1e-300,
            1e-20,
            0.5,
            TAN_PI_8,
            1.0,
            1.0 / TAN_PI_8,
            1e20,
            1e300,
            4e307,
        ];
        for y in edges.into_iter().flat_map(|y| [y, -y]) {
            for x in edges.into_iter().flat_map(|x| [x, -x]) {
                assert_angle(y, x);
            }
        }
    }

    #[test]
    fn angles_of_any_size_have_a_sine() {
        for angle in [1e7, -1e15, 1e300, f64::MAX] {
            let turn = turn_of_any(angle);
            assert_eq!((turn.sin, turn.cos), libm::sincos(angle));
        }
        assert_eq!(turn_of_any(1.0), Turn::of(1.0));
    }

    #[test]
    fn wrapping_leaves_whole_turns_out() {
        for turns in -5..=5 {
            for angle in [-3.0, -FRAC_PI_3, 0.0, 1.0, 3.1] {
                let turned = angle + TAU * f64::from(turns);
                assert!((wrapped(turned) - angle).abs() < 1e-14);
                assert!((nearest(angle, turned + 3.0) - turned).abs() < 1e-14);
                assert!((nearest(angle, turned - 3.0) - turned).abs() < 1e-14);
            }
        }
        assert_eq!((wrapped(PI), wrapped(-PI)), (PI, PI));
        let beyond = wrapped(f64::from_bits(PI.to_bits() + 1));
        assert!(-PI < beyond && beyond < -3.0);
    }

    #[test]
    fn turns_add_up() {
        let sum = Turn::of(0.3) + Turn::of(1.1);
        assert!((sum.angle() - 1.4).abs() < 1e-15);
        assert!((Turn::of(0.3).back().angle() + 0.3).abs() < 1e-16);
    }
}
