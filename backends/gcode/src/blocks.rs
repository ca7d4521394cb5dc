//! Lines of a file: blocks with their numbers, comments, coordinates.

use crate::controller::{Facts, Letters, Signs};
use crate::names::cased;
use crate::options::Settings;
use crate::statement::Style;
use vcutc_backend_api::number::{FixedDecimal, NotFinite};
use vcutc_backend_api::profile::LineNumbers;
use vcutc_backend_api::script::{Text, Written};

/// Largest N word: five digits are what every control reads [F-30]. After it numbers begin again.
const LARGEST_NUMBER: u32 = 99_999;

/// Writes the lines of a program's files.
pub(crate) struct Blocks<'a, 's> {
    text: &'a mut Text<'s>,
    facts: &'static Facts,
    numbers: Numbers,
}

/// What stands before a line.
#[derive(Clone, Copy)]
enum Numbers {
    None,
    /// An N word before every block: the next number.
    Words {
        next: u32,
        of: LineNumbers,
    },
    /// A number before every line: the next.
    Lines(u32),
}

impl Numbers {
    fn start(settings: &Settings<'_>) -> Self {
        match (settings.facts().style, settings.common.profile.line_numbers) {
            (Style::Numbered, _) => Self::Lines(0),
            (Style::Brackets | Style::Blocks | Style::Semicolon, Some(of)) => {
                Self::Words { next: of.start, of }
            }
            (Style::Brackets | Style::Blocks | Style::Semicolon, None) => Self::None,
        }
    }
}

impl<'a, 's> Blocks<'a, 's> {
    /// Nothing written yet.
    pub(crate) fn new(text: &'a mut Text<'s>, settings: &Settings<'_>) -> Self {
        Self {
            text,
            facts: settings.facts(),
            numbers: Numbers::start(settings),
        }
    }

    pub(crate) fn file(&mut self, name: &str, settings: &Settings<'_>) -> Written {
        self.numbers = Numbers::start(settings);
        Ok(self.text.file(name)?)
    }

    /// Hands over what is gathered.
    pub(crate) fn flush(&mut self) -> Written {
        Ok(self.text.flush()?)
    }

    /// A line that is not a block: it has a number only where every line has one.
    pub(crate) fn line(&mut self, line: &str) -> Written {
        self.line_number();
        Ok(self.text.line(line)?)
    }

    /// A line that continues the block before: it has no number.
    pub(crate) fn continuation(&mut self, line: &str) -> Written {
        Ok(self.text.line(line)?)
    }

    pub(crate) fn block(&mut self, block: &str) -> Written {
        self.begin();
        self.put(block);
        self.end()
    }

    /// Blocks in their order.
    pub(crate) fn all(&mut self, blocks: &[String]) -> Written {
        blocks.iter().try_for_each(|block| self.block(block))
    }

    /// A comment with words of ours and words that people wrote after them.
    pub(crate) fn comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.line_number();
        let (letters, [open, close]) = (self.facts.comment_letters, self.facts.style.comment_signs());
        self.text.put(open.as_bytes());
        match letters {
            Letters::Any => {
                self.text.words(ours);
                self.text.words(theirs);
            }
            Letters::Capital | Letters::Small => {
                self.text.words(&cased(ours, letters));
                self.text.words(&cased(theirs, letters));
            }
        }
        self.text.put(close.as_bytes());
        self.end()
    }

    /// Begins a block.
    pub(crate) fn begin(&mut self) {
        match self.numbers {
            Numbers::None => {}
            Numbers::Words { next, of } => {
                self.text.put(b"N");
                self.text.whole(next);
                self.text.put(b" ");
                let next = next.saturating_add(of.step);
                let next = if next > LARGEST_NUMBER { of.start } else { next };
                self.numbers = Numbers::Words { next, of };
            }
            Numbers::Lines(_) => self.line_number(),
        }
    }

    fn line_number(&mut self) {
        if let Numbers::Lines(next) = self.numbers {
            self.text.whole(next);
            self.text.put(b" ");
            self.numbers = Numbers::Lines(next.saturating_add(1));
        }
    }

    /// Text of a block.
    pub(crate) fn put(&mut self, words: &str) {
        self.text.put(words.as_bytes());
    }

    /// Bytes of a block.
    pub(crate) fn put_bytes(&mut self, words: &[u8]) {
        self.text.put(words);
    }

    /// Ends a block.
    pub(crate) fn end(&mut self) -> Written {
        Ok(self.text.end_line()?)
    }
}

/// Appends a coordinate: a blank, its letter and its value.
pub(crate) fn push_word(
    out: &mut Vec<u8>,
    letter: u8,
    value: f64,
    format: FixedDecimal,
    signs: Signs,
) -> Result<(), NotFinite> {
    out.extend_from_slice(&[b' ', letter]);
    let at = out.len();
    format.push(out, value)?;
    match signs {
        Signs::Always if out.get(at) != Some(&b'-') => out.insert(at, b'+'),
        Signs::Always | Signs::Negative => {}
    }
    Ok(())
}

/// A speed, an inverse time or a wait: no more zeros at its end than one.
pub(crate) fn fine(value: f64, format: FixedDecimal) -> Result<Vec<u8>, NotFinite> {
    let mut out = Vec::with_capacity(12);
    format.push(&mut out, value)?;
    while out.ends_with(b"0") && !out.ends_with(b".0") {
        out.pop();
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(value: f64, signs: Signs) -> String {
        let mut out = Vec::new();
        push_word(&mut out, b'X', value, FixedDecimal::new(3), signs).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn coordinates_have_a_point_and_no_negative_zero() {
        assert_eq!(word(10.0, Signs::Negative), " X10.000");
        assert_eq!(word(-0.0004, Signs::Negative), " X0.000");
        assert_eq!(word(-0.0004, Signs::Always), " X+0.000");
        assert_eq!(word(-1.5, Signs::Always), " X-1.500");
        assert_eq!(word(99_999.0, Signs::Always), " X+99999.000");
    }

    #[test]
    fn speeds_are_as_short_as_may_be() {
        for (value, decimals, text) in [
            (12_000.0, 3, "12000.0"),
            (0.25, 6, "0.25"),
            (33.333_333_33, 3, "33.333"),
        ] {
            let text_is = String::from_utf8(fine(value, FixedDecimal::new(decimals)).unwrap()).unwrap();
            assert_eq!(text_is, text);
        }
    }
}
