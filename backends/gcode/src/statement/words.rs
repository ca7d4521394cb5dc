//! Letters with numbers: the words of a block.

use super::lines::Style;
use super::order::{Order, Parsed, ReadError, Scope, expected};

/// A number as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number {
    pub(crate) value: f64,
    /// Whether it has a point.
    pub(crate) point: Point,
}

/// Whether a number has a point: where it has none some controls count in thousandths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Point {
    Written,
    LeftOut,
}

impl Number {
    /// It as a whole number from 0 on.
    pub(crate) fn whole(self) -> Option<u32> {
        let is_whole = self.value >= 0.0 && self.value <= f64::from(u32::MAX) && self.value.fract() == 0.0;
        is_whole.then_some(self.value as u32)
    }

    /// The number of a G or M code in tenths: 434 for `G43.4`.
    fn code(self) -> Option<u32> {
        let tenths = (self.value * 10.0).round();
        let is_code = (0.0..=99_999.0).contains(&tenths) && (self.value * 10.0 - tenths).abs() < 1e-6;
        is_code.then_some(tenths as u32)
    }
}

/// A place in a statement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'t> {
    text: &'t str,
    at: usize,
    style: Style,
}

impl<'t> Cursor<'t> {
    pub(crate) const fn new(text: &'t str, style: Style) -> Self {
        Self { text, at: 0, style }
    }

    fn byte(&self, at: usize) -> Option<u8> {
        self.text.as_bytes().get(at).copied()
    }

    /// The next byte that is neither blank nor comment.
    pub(crate) fn peek(&mut self) -> Option<u8> {
        loop {
            match (self.byte(self.at)?, self.style) {
                (b' ' | b'\t', _) => self.at += 1,
                (b'(', Style::Brackets | Style::Blocks) => {
                    let rest = self.text.as_bytes().get(self.at..)?;
                    let length = rest.iter().position(|&byte| byte == b')');
                    self.at += length.map_or(rest.len(), |at| at + 1);
                }
                (byte, Style::Brackets | Style::Blocks | Style::Semicolon | Style::Numbered) => {
                    return Some(byte);
                }
            }
        }
    }

    /// Goes over a sign.
    pub(crate) fn skip(&mut self, sign: u8) -> bool {
        let is_there = self.peek() == Some(sign);
        if is_there {
            self.at += 1;
        }
        is_there
    }

    /// Goes over a sign that must be there.
    pub(crate) fn must(&mut self, sign: u8) -> Parsed<()> {
        if self.skip(sign) {
            Ok(())
        } else {
            expected(format!("`{}`", char::from(sign)))
        }
    }

    /// Nothing may follow.
    pub(crate) fn end(&mut self) -> Parsed<()> {
        match self.peek() {
            None => Ok(()),
            Some(_) => expected("the end of the block"),
        }
    }

    /// A letter, as a capital.
    pub(crate) fn letter(&mut self) -> Option<u8> {
        let letter = self.peek().filter(u8::is_ascii_alphabetic)?;
        self.at += 1;
        Some(letter.to_ascii_uppercase())
    }

    /// A name: letters, digits and `_`, beginning with a letter.
    pub(crate) fn name(&mut self) -> Option<&'t str> {
        self.peek().filter(u8::is_ascii_alphabetic)?;
        let start = self.at;
        while self.byte(self.at).is_some_and(is_of_name) {
            self.at += 1;
        }
        self.text.get(start..self.at)
    }

    /// Everything up to the next blank.
    pub(crate) fn token(&mut self) -> Option<&'t str> {
        self.peek()?;
        let rest = self.text.get(self.at..)?;
        let token = rest.split([' ', '\t']).next().unwrap_or(rest);
        self.at += token.len();
        Some(token)
    }

    /// Everything that is left, as it stands.
    pub(crate) fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// How many letters and `_` follow.
    pub(crate) fn letters_ahead(&mut self) -> usize {
        self.peek();
        let rest = self.text.as_bytes().get(self.at..).unwrap_or_default();
        rest.iter()
            .take_while(|byte| byte.is_ascii_alphabetic() || **byte == b'_')
            .count()
    }

    /// Goes over this word, small and capital letters alike.
    pub(crate) fn word(&mut self, word: &str) -> bool {
        let mut ahead = *self;
        let is_there = ahead.name().is_some_and(|name| name.eq_ignore_ascii_case(word));
        if is_there {
            *self = ahead;
        }
        is_there
    }

    /// A number with its sign, without exponent. None where there is none.
    pub(crate) fn number(&mut self) -> Option<Number> {
        let sign = self.peek()?;
        let before = *self;
        if matches!(sign, b'+' | b'-') {
            self.at += 1;
        }
        let start = self.at;
        let whole = self.digits();
        let point = if self.byte(self.at) == Some(b'.') {
            self.at += 1;
            Point::Written
        } else {
            Point::LeftOut
        };
        let fraction = match point {
            Point::Written => self.digits(),
            Point::LeftOut => 0,
        };
        let size = self.text.get(start..self.at).filter(|_| whole + fraction > 0);
        match size.and_then(|text| text.parse::<f64>().ok()) {
            Some(size) if size.is_finite() => Some(Number {
                value: if sign == b'-' { -size } else { size },
                point,
            }),
            _ => {
                *self = before;
                None
            }
        }
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while self.byte(self.at).is_some_and(|byte| byte.is_ascii_digit()) {
            self.at += 1;
        }
        self.at - start
    }
}

const fn is_of_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// Most G codes, and most M codes, of a block.
const MOST_CODES: usize = 12;

/// G codes or M codes of a block, in tenths.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Codes {
    codes: [u32; MOST_CODES],
    count: usize,
}

impl Codes {
    fn push(&mut self, code: u32) -> Parsed<()> {
        let place = self.codes.get_mut(self.count);
        *place.ok_or_else(|| ReadError::Expected("fewer codes in a block".to_owned()))? = code;
        self.count += 1;
        Ok(())
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = u32> + use<> {
        self.codes.into_iter().take(self.count)
    }

    /// How many there are.
    pub(crate) const fn count(&self) -> usize {
        self.count
    }
}

/// The words of a block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block {
    pub(crate) g: Codes,
    pub(crate) m: Codes,
    values: [Option<Number>; 26],
}

impl Block {
    /// Adds a word.
    pub(crate) fn add(&mut self, letter: u8, number: Number) -> Parsed<()> {
        let name = char::from(letter);
        let code = || number.code().ok_or(ReadError::Unknown);
        match letter {
            b'G' => self.g.push(code()?),
            b'M' => self.m.push(code()?),
            _ => {
                let place = letter.checked_sub(b'A').map(usize::from);
                let place = place.and_then(|place| self.values.get_mut(place));
                match place.ok_or(ReadError::Unknown)?.replace(number) {
                    Some(_) => expected(format!("`{name}` once in a block")),
                    None => Ok(()),
                }
            }
        }
    }

    /// Takes the word of a letter out.
    pub(crate) fn take(&mut self, letter: u8) -> Option<Number> {
        let place = letter.checked_sub(b'A').map(usize::from)?;
        self.values.get_mut(place)?.take()
    }

    /// Takes the word of a letter out, which must be there.
    pub(crate) fn must(&mut self, letter: u8) -> Parsed<Number> {
        let found = self.take(letter);
        found.ok_or_else(|| ReadError::Expected(format!("the word `{}`", char::from(letter))))
    }

    /// Takes a whole number out, which must be there.
    pub(crate) fn whole(&mut self, letter: u8) -> Parsed<u32> {
        let whole = self.must(letter)?.whole();
        whole.ok_or_else(|| ReadError::Expected(format!("a whole number after `{}`", char::from(letter))))
    }

    /// Hands over coordinates, centres of arcs and F; nothing may be left.
    pub(crate) fn finish(mut self, scope: Scope<'_>, order: &mut Order<'_>) -> Parsed<()> {
        for word in scope.words {
            let value = self.take(word.letter).map(|number| number.value);
            if let (Some(place), Some(value)) = (order.axes.get_mut(word.place), value) {
                *place = Some(value);
            }
        }
        for (place, letter) in order.centre.iter_mut().zip(*b"IJK") {
            *place = self.take(letter).map(|number| number.value);
        }
        order.feed = self.take(b'F').map(|number| number.value);
        match self.values.iter().any(Option::is_some) {
            true => Err(ReadError::Unknown),
            false => Ok(()),
        }
    }

    /// Whether a coordinate is written without a point.
    pub(crate) fn lacks_a_point(&self, letter: u8) -> bool {
        let place = letter.checked_sub(b'A').map(usize::from);
        let number = place.and_then(|place| self.values.get(place).copied().flatten());
        number.is_some_and(|number| number.point == Point::LeftOut)
    }
}

/// The words of a statement that has nothing else.
pub(crate) fn block(code: &str, style: Style) -> Parsed<Block> {
    let mut block = Block::default();
    let mut cursor = Cursor::new(code, style);
    while let Some(byte) = cursor.peek() {
        let Some(letter) = cursor.letter() else {
            return match byte {
                // Variables, expressions, blocks that may be left out.
                b'#' | b'[' | b'/' | b'$' | b'=' => Err(ReadError::Unknown),
                _ => expected("a letter with a number"),
            };
        };
        let number = match cursor.number() {
            Some(number) => number,
            None if matches!(cursor.peek(), Some(b'#' | b'[' | b'=')) => return Err(ReadError::Unknown),
            None => return expected(format!("a number after `{}`", char::from(letter))),
        };
        block.add(letter, number)?;
    }
    Ok(block)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn values(code: &str) -> Parsed<Vec<(char, f64)>> {
        let mut block = block(code, Style::Brackets)?;
        let letters =
            (b'A'..=b'Z').filter_map(|letter| Some((char::from(letter), block.take(letter)?.value)));
        let mut all: Vec<(char, f64)> = letters.collect();
        all.extend(block.g.iter().map(|code| ('G', f64::from(code) / 10.0)));
        Ok(all)
    }

    #[test]
    fn blanks_zeros_signs_and_capitals_do_not_matter() {
        let plain = values("G43.4 X10.5 Y-2. Z.25 H1");
        assert!(plain.is_ok());
        for other in [
            "g43.4x10.5y-2z0.25h1",
            "G043.40 X +10.500 (here) Y -2.0 Z0.25 H01",
            "H1 Z.25 Y-2 X10.5 G43.4",
        ] {
            assert_eq!(values(other), plain, "{other}");
        }
    }

    #[test]
    fn what_is_not_a_word_is_reported() {
        for (code, what) in [
            ("G1 X", "a number after `X`"),
            ("G1 X-", "a number after `X`"),
            ("G1 X1 X2", "`X` once in a block"),
            ("G1 1", "a letter with a number"),
            ("G1 X1.5.2", "a letter with a number"),
        ] {
            assert_eq!(values(code), expected(what), "{code}");
        }
        for code in ["G1 X#1", "X[1+2]", "G-1", "/G1", "G1.23", "A3=0.5"] {
            assert_eq!(values(code), Err(ReadError::Unknown), "{code}");
        }
    }

    proptest! {
        #[test]
        fn numbers_are_those_of_the_standard_library(text in "[-+]?[0-9]{1,12}(\\.[0-9]{0,14})?") {
            let number = Cursor::new(&text, Style::Brackets).number();
            prop_assert_eq!(number.map(|number| number.value), text.parse().ok());
        }

        #[test]
        fn any_text_is_a_block_or_none(text in any::<String>()) {
            let _ = block(&text, Style::Brackets);
            let _ = block(&text, Style::Semicolon);
        }
    }
}
