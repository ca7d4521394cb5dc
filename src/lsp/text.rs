//! The text of a document, and positions in it as the protocol counts them.
//!
//! Positions are lines and units within a line, both from 0; a line ends with `\n`, `\r\n` or a lone `\r`. What a unit is, client
//! and server agree upon: UTF-16 code units by default. The compiler counts bytes. A position after the end
//! of its line means that end, one within a character its beginning, and a line after the last one the end of
//! the text: clients that lag by a step are served, too.

use lsp_types::{Position, Range, TextDocumentContentChangeEvent};
use std::sync::Arc;

/// What positions within a line are counted in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Bytes.
    Utf8,
    /// Code units of UTF-16, which every client can count.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    /// The first that the server knows of those that a client offers, which are in the order of its preference.
    pub(super) fn agreed<'n>(offered: impl Iterator<Item = &'n str>) -> Self {
        let known = |name: &str| {
            [Self::Utf8, Self::Utf16, Self::Utf32]
                .into_iter()
                .find(|known| known.name() == name)
        };
        offered.filter_map(known).next().unwrap_or_default()
    }

    /// As the protocol calls it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "utf-8",
            Self::Utf16 => "utf-16",
            Self::Utf32 => "utf-32",
        }
    }

    /// How many units a character has.
    const fn units(self, c: char) -> usize {
        match self {
            Self::Utf8 => c.len_utf8(),
            Self::Utf16 => c.len_utf16(),
            Self::Utf32 => 1,
        }
    }
}

/// A text with the beginnings of its lines.
#[derive(Clone, Debug)]
pub(super) struct Text {
    encoding: Encoding,
    text: Arc<str>,
    /// The first byte of every line; the first is 0.
    lines: Arc<[usize]>,
}

impl Text {
    /// A text as it is, with the units of its positions.
    pub(super) fn new(text: &str, encoding: Encoding) -> Self {
        Self {
            encoding,
            text: Arc::from(text),
            lines: line_starts(text).into(),
        }
    }

    pub(super) fn as_str(&self) -> &str {
        &self.text
    }

    /// The byte that a position means.
    pub(super) fn offset(&self, position: Position) -> usize {
        let line = position.line as usize;
        let Some(&start) = self.lines.get(line) else {
            return self.text.len();
        };
        let end = self.lines.get(line + 1).copied().unwrap_or(self.text.len());
        let line = self.text.get(start..end).unwrap_or_default();
        let line = line.trim_end_matches(['\r', '\n']);
        let mut units = position.character as usize;
        for (at, c) in line.char_indices() {
            let width = self.encoding.units(c);
            if units < width {
                return start + at;
            }
            units -= width;
        }
        start + line.len()
    }

    /// How many units a piece of the text has.
    pub(super) fn units(&self, piece: &str) -> usize {
        piece.chars().map(|c| self.encoding.units(c)).sum()
    }

    /// The position of a byte. A byte within a character means that character.
    pub(super) fn position(&self, offset: usize) -> Position {
        let offset = self.text.floor_char_boundary(offset);
        let line = self
            .lines
            .partition_point(|&start| start <= offset)
            .saturating_sub(1);
        let start = self.lines.get(line).copied().unwrap_or(0);
        let units = self.units(self.text.get(start..offset).unwrap_or_default());
        Position {
            line: u32::try_from(line).unwrap_or(u32::MAX),
            character: u32::try_from(units).unwrap_or(u32::MAX),
        }
    }

    /// The range of some bytes.
    pub(super) fn range(&self, bytes: core::ops::Range<usize>) -> Range {
        Range {
            start: self.position(bytes.start),
            end: self.position(bytes.end),
        }
    }

    /// The text after some changes, which are made one after the other.
    pub(super) fn changed(&self, changes: &[TextDocumentContentChangeEvent]) -> Self {
        changes.iter().fold(self.clone(), |text, change| {
            let Some(range) = change.range else {
                return Self::new(&change.text, self.encoding);
            };
            let (a, b) = (text.offset(range.start), text.offset(range.end));
            let mut next = text.as_str().to_owned();
            next.replace_range(a.min(b)..a.max(b), &change.text);
            Self::new(&next, self.encoding)
        })
    }
}

impl AsRef<str> for Text {
    fn as_ref(&self) -> &str {
        self.as_str()
    }
}

fn line_starts(text: &str) -> Vec<usize> {
    let bytes = text.as_bytes();
    let mut starts = vec![0];
    for (at, byte) in bytes.iter().enumerate() {
        let is_end = match byte {
            b'\n' => true,
            b'\r' => bytes.get(at + 1) != Some(&b'\n'),
            _ => false,
        };
        if is_end {
            starts.push(at + 1);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn units_of_utf16_are_counted() {
        // An umlaut is one unit of two bytes, the letters of the second line are two units of four bytes.
        let text = Text::new("äb\r\n𝒳🔪z\rend", Encoding::Utf16);
        assert_eq!(text.offset(at(0, 1)), 2);
        assert_eq!(
            text.offset(at(0, 9)),
            3,
            "behind the line is its end, not the line end's"
        );
        assert_eq!(text.offset(at(1, 2)), 5 + 4);
        assert_eq!(
            text.offset(at(1, 3)),
            5 + 4,
            "within a character is its beginning"
        );
        assert_eq!(text.offset(at(1, 4)), 5 + 8);
        assert_eq!(text.offset(at(2, 0)), 5 + 8 + 2);
        assert_eq!(text.offset(at(7, 7)), text.as_str().len());
        assert_eq!(text.position(5 + 8), at(1, 4));
        assert_eq!(text.position(5 + 8 + 2), at(2, 0));
        assert_eq!(text.position(999), at(2, 3));
    }

    #[test]
    fn the_first_encoding_that_both_know_is_taken() {
        let agreed = |names: &[&str]| Encoding::agreed(names.iter().copied());
        assert_eq!(agreed(&[]), Encoding::Utf16);
        assert_eq!(agreed(&["utf-7", "utf-32", "utf-8"]), Encoding::Utf32);
        assert_eq!(agreed(&["utf-8", "utf-16"]), Encoding::Utf8);
        assert_eq!(agreed(&["utf-7"]), Encoding::Utf16);
    }

    #[test]
    fn changes_are_made_one_after_the_other() {
        let change = |range: Option<(u32, u32, u32, u32)>, text: &str| TextDocumentContentChangeEvent {
            range: range.map(|(a, b, c, d)| Range::new(at(a, b), at(c, d))),
            range_length: None,
            text: text.to_owned(),
        };
        let text = Text::new("one\ntwo\n", Encoding::Utf16);
        let changed = text.changed(&[
            change(Some((0, 3, 1, 0)), " 🔪 "),
            change(Some((0, 6, 0, 9)), "2"),
            change(Some((9, 9, 9, 9)), "end"),
            change(Some((0, 1, 0, 0)), "O"),
        ]);
        assert_eq!(changed.as_str(), "One 🔪2o\nend");
        assert_eq!(changed.changed(&[change(None, "new")]).as_str(), "new");
    }

    /// A position by its definition: all characters are gone through.
    fn by_definition(text: &str, offset: usize, encoding: Encoding) -> Position {
        let (mut line, mut units) = (0, 0);
        for (at, c) in text.char_indices().take_while(|(at, _)| *at < offset) {
            let is_end = c == '\n' || c == '\r' && !text[at + 1..].starts_with('\n');
            let width = match encoding {
                Encoding::Utf8 => c.to_string().len(),
                Encoding::Utf16 => c.to_string().encode_utf16().count(),
                Encoding::Utf32 => 1,
            };
            let width = u32::try_from(width).unwrap();
            (line, units) = if is_end {
                (line + 1, 0)
            } else {
                (line, units + width)
            };
        }
        self::at(line, units)
    }

    proptest! {
        #[test]
        fn positions_are_those_of_the_definition_and_lead_back(
            pieces in proptest::collection::vec(
                proptest::sample::select(vec!["a", "ä", "🔪", "𝒳", "\n", "\r\n", "\r", " ", "mm"]), 0..40),
            encoding in proptest::sample::select(vec![Encoding::Utf8, Encoding::Utf16, Encoding::Utf32]),
        ) {
            let whole: String = pieces.concat();
            let text = Text::new(&whole, encoding);
            for (offset, _) in whole.char_indices() {
                // Between the two characters of a line end there is no place that a client can name.
                if whole[..offset].ends_with('\r') && whole[offset..].starts_with('\n') {
                    continue;
                }
                let position = text.position(offset);
                prop_assert_eq!(position, by_definition(&whole, offset, encoding));
                prop_assert_eq!(text.offset(position), offset);
            }
        }
    }
}
