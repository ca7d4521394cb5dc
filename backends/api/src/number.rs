//! Numbers as controllers read them: fixed decimals, a point, no exponent, never `-0.000`.
//!
//! [`FixedDecimal`] prints exactly what `format!("{:.n$}")` prints, which rounds the exact decimal value of the
//! `f64` (ties to even), except that a result without any non-zero digit loses its sign. It is fast because nearly
//! every value can be scaled to an integer with a rounding error that is provably too small to matter; the few that
//! cannot (near a tie, or huge) take the slow way through the standard library.

use core::fmt::Write as _;

/// A value that is not a number was to be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

/// Prints numbers with a fixed count of decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedDecimal {
    decimals: u8,
    scale: u32,
}

/// All two-digit numbers, so that one division yields two digits.
const PAIRS: &[u8; 200] = b"0001020304050607080910111213141516171819\
2021222324252627282930313233343536373839\
4041424344454647484950515253545556575859\
6061626364656667686970717273747576777879\
8081828384858687888990919293949596979899";

/// Scaled values below this are integers of at most 10 digits, and their rounding error is below [`NEAR_TIE`].
const FAST_LIMIT: f64 = 4_294_967_296.0;

/// The product `value * scale` is off by at most half a unit in the last place: below 2^32 that is 2^-22, or 2.4e-7.
/// Nearer to a tie than this the exact value decides, so it is asked.
const NEAR_TIE: f64 = 1e-6;

/// Between 2^52 and 2^53 doubles are whole numbers, so adding this rounds (ties to even) and taking it away again leaves
/// the rounded value. That is `round_ties_even` for everything below 2^51, and [`FAST_LIMIT`] is far below; but where the
/// processor is not known to have the instruction, `round_ties_even` is a call, ten times as long.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// What rounding down overlooks, in units of the last decimal: the rounding of the arithmetic. It is far below what proofs of rates
/// leave.
const NOISE: f64 = 1e-4;

impl FixedDecimal {
    /// With so many decimals, at most 6 (a nanometre, where controllers have long stopped reading).
    #[must_use]
    pub const fn new(decimals: u8) -> Self {
        let decimals = if decimals > 6 { 6 } else { decimals };
        Self {
            decimals,
            scale: 10_u32.pow(decimals as u32),
        }
    }

    /// The value rounded down to these decimals, for what must not be more than was computed: speeds. What is above a decimal by no
    /// more than the rounding of arithmetic stays on it.
    #[must_use]
    pub fn floored(self, value: f64) -> f64 {
        let scale = f64::from(self.scale);
        (value * scale + NOISE).floor() / scale
    }

    /// The value as it is printed, but for ties.
    #[must_use]
    pub fn rounded(self, value: f64) -> f64 {
        let scale = f64::from(self.scale);
        (value * scale).round() / scale
    }

    /// How many decimals.
    #[must_use]
    pub const fn decimals(self) -> u8 {
        self.decimals
    }

    /// One unit of the last decimal.
    #[must_use]
    pub fn unit(self) -> f64 {
        1.0 / f64::from(self.scale)
    }

    /// Half of it: by how much a printed number may be off.
    #[must_use]
    pub fn half_unit(self) -> f64 {
        0.5 / f64::from(self.scale)
    }

    /// Whether a number that was read is the one that was printed.
    #[must_use]
    pub fn is_near(self, is: f64, printed: f64) -> bool {
        is_within(is, printed, self.half_unit())
    }

    /// Appends the value.
    ///
    /// # Errors
    /// When it is not finite.
    pub fn push(self, out: &mut Vec<u8>, value: f64) -> Result<(), NotFinite> {
        if !value.is_finite() {
            return Err(NotFinite);
        }
        let scaled = value * f64::from(self.scale);
        let rounded = (scaled + ROUNDER) - ROUNDER;
        let tie_distance = ((scaled - rounded).abs() - 0.5).abs();
        if scaled.abs() < FAST_LIMIT && tie_distance > NEAR_TIE {
            self.push_scaled(out, rounded);
        } else {
            self.push_exact(out, value);
        }
        Ok(())
    }

    /// Appends `rounded / scale`, where `rounded` is a whole number below [`FAST_LIMIT`].
    fn push_scaled(self, out: &mut Vec<u8>, rounded: f64) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole and below 2^32"
        )]
        let mut rest = rounded.abs() as u64;
        let mut text = FromTheRight::default();
        let mut decimals = self.decimals;
        if decimals & 1 == 1 {
            text.put(b'0' + (rest % 10) as u8);
            rest /= 10;
            decimals -= 1;
        }
        while decimals > 0 {
            text.put_pair(rest % 100);
            rest /= 100;
            decimals -= 2;
        }
        if self.decimals > 0 {
            text.put(b'.');
        }
        while rest >= 100 {
            text.put_pair(rest % 100);
            rest /= 100;
        }
        if rest >= 10 {
            text.put_pair(rest);
        } else {
            text.put(b'0' + rest as u8);
        }
        if rounded < 0.0 {
            text.put(b'-');
        }
        text.append_to(out);
    }

    /// Appends the value by way of the standard library.
    fn push_exact(self, out: &mut Vec<u8>, value: f64) {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = write!(text, "{value:.*}", usize::from(self.decimals));
        let digits = text.strip_prefix('-').unwrap_or(&text);
        let is_zero = digits.bytes().all(|byte| matches!(byte, b'0' | b'.'));
        out.extend_from_slice(if is_zero { digits } else { &text }.as_bytes());
    }
}

/// A text of at most 16 characters, made from its last to its first. Sign, point and ten digits are 12.
#[derive(Default)]
struct FromTheRight {
    /// The first character in the lowest byte, so that in memory the text begins at the beginning.
    characters: u128,
    count: usize,
}

impl FromTheRight {
    fn put(&mut self, character: u8) {
        self.characters = self.characters << 8 | u128::from(character);
        self.count += 1;
    }

    /// The two digits of a number below 100.
    fn put_pair(&mut self, number: u64) {
        let place = 2 * (number % 100) as usize;
        let pair = u16::from_le_bytes([PAIRS[place], PAIRS[place + 1]]);
        self.characters = self.characters << 16 | u128::from(pair);
        self.count += 2;
    }

    fn append_to(&self, out: &mut Vec<u8>) {
        let end = out.len() + self.count;
        // All 16 at once and the rest off again: copying a number of bytes known beforehand takes no call.
        out.extend_from_slice(&self.characters.to_le_bytes());
        out.truncate(end);
    }
}

/// Whether two numbers differ by no more than what is printed, and the rounding of the arithmetic.
pub(crate) fn is_within(is: f64, should: f64, resolution: f64) -> bool {
    let rounding = 1e-9 * should.abs().max(1.0);
    (is - should).abs() <= resolution * (1.0 + 1e-6) + rounding
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fixed(value: f64, decimals: u8) -> String {
        let mut out = Vec::new();
        FixedDecimal::new(decimals).push(&mut out, value).unwrap();
        String::from_utf8(out).unwrap()
    }

    /// The exact decimal of the float by the standard library, less the sign of a zero.
    fn reference(value: f64, decimals: u8) -> String {
        let text = format!("{value:.*}", usize::from(decimals));
        match text.strip_prefix('-') {
            Some(digits) if digits.bytes().all(|b| b == b'0' || b == b'.') => digits.to_owned(),
            _ => text,
        }
    }

    #[test]
    fn speeds_are_rounded_down() {
        let floored = |value, decimals| FixedDecimal::new(decimals).floored(value);
        assert_eq!(floored(61.052_199, 3), 61.052);
        assert_eq!(floored(61.052_999, 3), 61.052);
        assert_eq!(floored(61.053, 3), 61.053);
        // What arithmetic took from a speed that people wrote.
        assert_eq!(floored(0.1 * 3.0 * 200.0 - 1e-13, 3), 60.0);
    }

    #[test]
    fn prints_what_people_expect() {
        assert_eq!(fixed(0.0, 3), "0.000");
        assert_eq!(fixed(-0.0, 3), "0.000");
        assert_eq!(fixed(-0.0004, 3), "0.000");
        assert_eq!(fixed(-0.0006, 3), "-0.001");
        assert_eq!(fixed(1234.5678, 3), "1234.568");
        assert_eq!(fixed(99.9996, 3), "100.000");
        assert_eq!(fixed(-7.0, 0), "-7");
        assert_eq!(fixed(1e12, 3), "1000000000000.000");
        assert_eq!(fixed(4_294_967.295, 3), "4294967.295");
        assert_eq!(fixed(0.5, 0), "0");
        assert_eq!(fixed(1.5, 0), "2");
    }

    #[test]
    fn refuses_what_is_not_a_number() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut out = Vec::new();
            assert_eq!(FixedDecimal::new(3).push(&mut out, value), Err(NotFinite));
            assert!(out.is_empty());
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        #[test]
        fn equals_the_exact_decimal(value in -1e7..1e7_f64, decimals in 0..=6_u8) {
            prop_assert_eq!(fixed(value, decimals), reference(value, decimals));
        }

        #[test]
        fn equals_the_exact_decimal_near_ties(whole in -1_000_000..1_000_000_i32, ulps in -3..=3_i64, decimals in 0..=6_u8) {
            let tie = (f64::from(whole) + 0.5) / 10_f64.powi(i32::from(decimals));
            let value = f64::from_bits(tie.to_bits().wrapping_add_signed(ulps));
            prop_assert_eq!(fixed(value, decimals), reference(value, decimals));
        }

        #[test]
        fn equals_the_exact_decimal_for_any_float(bits in any::<u64>(), decimals in 0..=6_u8) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            prop_assert_eq!(fixed(value, decimals), reference(value, decimals));
        }
    }
}
