//! Words, numbers and signs of one line.

/// A place in the text of a statement. Every function leaves it where it was when what it looks for is not there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'t> {
    text: &'t str,
    at: usize,
}

/// Powers of ten that a double holds exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// By how much a number grows when so many digits follow it.
const WHOLE_TENS: [u64; 9] = [
    1,
    10,
    100,
    1_000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
];

/// Whole numbers up to here are doubles.
const EXACT: u64 = 1 << 53;

/// So many digits fit into a `u64`.
const MOST_DIGITS: usize = 19;

/// What stands where a number should.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Number {
    None,
    Is(f64),
    /// Digits that do not make a number, or make one that is too large.
    Bad,
}

impl<'t> Cursor<'t> {
    pub(crate) const fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    #[inline]
    fn byte(&self, at: usize) -> Option<u8> {
        self.text.as_bytes().get(at).copied()
    }

    /// The next byte that is not a blank.
    #[inline]
    pub(crate) fn peek(&mut self) -> Option<u8> {
        let mut at = self.at;
        loop {
            match self.byte(at) {
                Some(b' ' | b'\t' | b'\r') => at += 1,
                other => {
                    self.at = at;
                    return other;
                }
            }
        }
    }

    /// What is left, without the blanks before it.
    pub(crate) fn rest(&mut self) -> &'t str {
        self.peek();
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The text from here to another place after it, without the blanks around it.
    pub(crate) fn until(&self, other: Self) -> &'t str {
        self.text.get(self.at..other.at).unwrap_or_default().trim_ascii()
    }

    /// Goes over a sign.
    #[inline]
    pub(crate) fn skip(&mut self, sign: u8) -> bool {
        let is_there = self.peek() == Some(sign);
        if is_there {
            self.at += 1;
        }
        is_there
    }

    /// A name: letters, digits, `_` and `$`, not beginning with a digit.
    #[inline]
    pub(crate) fn word(&mut self) -> Option<&'t str> {
        let begins = self
            .peek()
            .is_some_and(|byte| is_of_word(byte) && !byte.is_ascii_digit());
        begins.then(|| self.run(is_of_word))
    }

    /// The bytes from here on that are of a kind, all of them ASCII.
    #[inline]
    fn run(&mut self, is_of: impl Fn(u8) -> bool) -> &'t str {
        let start = self.at;
        let mut at = start;
        while self.byte(at).is_some_and(&is_of) {
            at += 1;
        }
        self.at = at;
        self.text.get(start..at).unwrap_or_default()
    }

    /// Text in this kind of quotes.
    pub(crate) fn quoted(&mut self, quote: u8) -> Option<&'t str> {
        if self.peek() != Some(quote) {
            return None;
        }
        let inner = self.text.get(self.at + 1..)?;
        let length = inner.bytes().position(|byte| byte == quote)?;
        self.at += length + 2;
        inner.get(..length)
    }

    /// What stands in round brackets, with the brackets within, blanks at its ends apart.
    pub(crate) fn bracketed(&mut self) -> Option<&'t str> {
        if self.peek() != Some(b'(') {
            return None;
        }
        let inner = self.text.get(self.at + 1..)?;
        let mut open = 1_u32;
        let length = inner.bytes().position(|byte| {
            match byte {
                b'(' => open += 1,
                b')' => open -= 1,
                _ => {}
            }
            open == 0
        })?;
        self.at += length + 2;
        inner.get(..length).map(str::trim_ascii)
    }

    /// A number without sign and point, as places of arrays have it.
    pub(crate) fn whole(&mut self) -> Option<u32> {
        self.peek()?;
        let before = *self;
        let number = self.run(|byte| byte.is_ascii_digit()).parse().ok();
        if number.is_none() {
            *self = before;
        }
        number
    }

    /// A number, with its sign.
    ///
    /// As a whole number of at most 19 digits divided by a power of ten, which rounds once and so gives the nearest double
    /// (Clinger, How to Read Floating Point Numbers Accurately, 1990); what is longer goes the long way.
    #[inline]
    pub(crate) fn number(&mut self) -> Number {
        let before = *self;
        let negative = match self.peek() {
            Some(sign @ (b'-' | b'+')) => {
                self.at += 1;
                self.peek();
                sign == b'-'
            }
            _ => false,
        };
        let start = self.at;
        let (whole, digits) = self.digits(0);
        let (fraction, digits) = if self.byte(self.at) == Some(b'.') {
            self.at += 1;
            self.digits(digits)
        } else {
            (0, digits)
        };
        if whole + fraction == 0 {
            *self = before;
            return Number::None;
        }
        let is_plain = match self.byte(self.at) {
            None | Some(b',' | b'}' | b' ') => true,
            Some(_) => !self.exponent(),
        };
        if self
            .byte(self.at)
            .is_some_and(|byte| is_of_word(byte) || byte == b'.')
        {
            return Number::Bad;
        }
        let size = match TENS.get(fraction) {
            Some(scale) if is_plain && whole + fraction <= MOST_DIGITS && digits <= EXACT => {
                Some(digits as f64 / scale)
            }
            _ => self.text.get(start..self.at).and_then(|text| text.parse().ok()),
        };
        match size {
            Some(size) if size.is_finite() => Number::Is(if negative { -size } else { size }),
            _ => Number::Bad,
        }
    }

    /// Goes over digits. Gives how many, and the number that they make after those of another; meaningless
    /// when there are more than fit.
    #[inline]
    fn digits(&mut self, before: u64) -> (usize, u64) {
        let start = self.at;
        let (mut at, mut number) = (start, before);
        while let Some(eight) = self.text.as_bytes().get(at..).and_then(<[u8]>::first_chunk) {
            let (count, value) = leading_digits(*eight);
            at += count;
            number = number
                .wrapping_mul(WHOLE_TENS[count % WHOLE_TENS.len()])
                .wrapping_add(value);
            if count < eight.len() {
                self.at = at;
                return (at - start, number);
            }
        }
        while let Some(digit @ b'0'..=b'9') = self.byte(at) {
            number = number.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
            at += 1;
        }
        self.at = at;
        (at - start, number)
    }

    /// Goes over an exponent.
    fn exponent(&mut self) -> bool {
        if !matches!(self.byte(self.at), Some(b'E' | b'e')) {
            return false;
        }
        let before = *self;
        self.at += 1;
        if matches!(self.byte(self.at), Some(b'-' | b'+')) {
            self.at += 1;
        }
        let (digits, _) = self.digits(0);
        let is_one = digits > 0;
        if !is_one {
            *self = before;
        }
        is_one
    }
}

/// How many digits eight bytes begin with, and the number that these make.
///
/// All eight at once in one register, because how many digits a number has is what a processor guesses wrong most often
/// when it is asked byte by byte (Lemire, Number Parsing at a Gigabyte per Second, 2021, section 4).
#[inline]
const fn leading_digits(bytes: [u8; 8]) -> (usize, u64) {
    const ONES: u64 = 0x0101_0101_0101_0101;
    // Digits become 0 to 9, other bytes something larger.
    let values = u64::from_le_bytes(bytes) ^ (ONES * b'0' as u64);
    // The highest bit of every byte that is larger.
    let others = (((values & (ONES * 0x7f)) + ONES * (0x80 - 10)) | values) & (ONES * 0x80);
    let count = others.trailing_zeros() / 8;
    if count == 0 {
        return (0, 0);
    }
    // The digits move to the end, with zeros before them.
    let eight = values << (64 - 8 * count);
    let twos = eight.wrapping_mul(10).wrapping_add(eight >> 8);
    const EVERY_FOURTH: u64 = 0x0000_00ff_0000_00ff;
    let high = (twos & EVERY_FOURTH).wrapping_mul(100 + (1_000_000 << 32));
    let low = ((twos >> 16) & EVERY_FOURTH).wrapping_mul(1 + (10_000 << 32));
    (count as usize, high.wrapping_add(low) >> 32)
}

#[inline]
const fn is_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$')
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(text: &str) -> Number {
        Cursor::new(text).number()
    }

    #[test]
    fn numbers_may_have_sign_point_and_exponent() {
        for (text, value) in [
            ("0", 0.0),
            ("1.5", 1.5),
            (".5", 0.5),
            ("5.", 5.0),
            ("- 2.25", -2.25),
            ("+3,", 3.0),
            ("1E-3}", 1e-3),
            ("12345678901234567890.5", 12_345_678_901_234_567_890.5),
        ] {
            assert_eq!(number(text), Number::Is(value), "{text}");
        }
    }

    #[test]
    fn what_is_not_a_number_is_none_or_bad() {
        for text in ["", "-", ".", "X", "{"] {
            assert_eq!(number(text), Number::None, "{text}");
        }
        for text in ["1x", "1.2.3", "1E", "1E400", "0X1F"] {
            assert_eq!(number(text), Number::Bad, "{text}");
        }
    }

    proptest! {
        #[test]
        fn eight_bytes_are_what_they_are_one_by_one(bytes in proptest::collection::vec(prop_oneof![b'0'..=b'9', any::<u8>()], 8)) {
            let digits: Vec<u8> = bytes.iter().copied().take_while(u8::is_ascii_digit).collect();
            let value = digits.iter().fold(0, |value, digit| 10 * value + u64::from(digit - b'0'));
            let eight: [u8; 8] = bytes.try_into().unwrap();
            prop_assert_eq!(leading_digits(eight), (digits.len(), value));
        }

        #[test]
        fn what_follows_a_number_does_not_change_it(text in "[0-9]{1,12}(\\.[0-9]{0,14})?", rest in "[,} ][ -~]{0,9}") {
            prop_assert_eq!(number(&(text.clone() + &rest)), Number::Is(text.parse().unwrap()));
        }

        #[test]
        fn numbers_are_those_of_the_standard_library(text in "-?[0-9]{1,12}(\\.[0-9]{0,14})?") {
            prop_assert_eq!(number(&text), Number::Is(text.parse().unwrap()));
        }
    }
}
