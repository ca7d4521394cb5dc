//! The text of a document, and positions in it as the protocol counts them.
//!
//! Positions are lines and UTF-16 code units, both from 0; a line ends with `\n`, `\r\n` or a lone `\r`. The compiler counts
//! bytes. A position behind the end of its line means that end, one within a character its beginning, and a line behind the
//! last one the end of the text: clients that are a step behind are not thrown out.

use lsp_types::{Position, Range, TextDocumentContentChangeEvent};
use std::sync::Arc;

/// A text with the beginnings of its lines.
#[derive(Clone, Debug)]
pub(super) struct Text {
    text: Arc<str>,
    /// The first byte of every line; the first is 0.
    lines: Arc<[usize]>,
}

impl Text {
    /// A text as it is.
    pub(super) fn new(text: &str) -> Self {
        Self {
            text: Arc::from(text),
            lines: line_starts(text).into(),
        }
    }

    /// The text.
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
            if units < c.len_utf16() {
                return start + at;
            }
            units -= c.len_utf16();
        }
        start + line.len()
    }

    /// The position of a byte. A byte within a character means that character.
    pub(super) fn position(&self, offset: usize) -> Position {
        let offset = self.text.floor_char_boundary(offset);
        let line = self
            .lines
            .partition_point(|&start| start <= offset)
            .saturating_sub(1);
        let start = self.lines.get(line).copied().unwrap_or(0);
        let units: usize = self
            .text
            .get(start..offset)
            .unwrap_or_default()
            .chars()
            .map(char::len_utf16)
            .sum();
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
                return Self::new(&change.text);
            };
            let (a, b) = (text.offset(range.start), text.offset(range.end));
            let mut next = text.as_str().to_owned();
            next.replace_range(a.min(b)..a.max(b), &change.text);
            Self::new(&next)
        })
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
        let text = Text::new("äb\r\n𝒳🔪z\rend");
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
    fn changes_are_made_one_after_the_other() {
        let change = |range: Option<(u32, u32, u32, u32)>, text: &str| TextDocumentContentChangeEvent {
            range: range.map(|(a, b, c, d)| Range::new(at(a, b), at(c, d))),
            range_length: None,
            text: text.to_owned(),
        };
        let text = Text::new("one\ntwo\n");
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
    fn by_definition(text: &str, offset: usize) -> Position {
        let (mut line, mut units) = (0, 0);
        for (at, c) in text.char_indices().take_while(|(at, _)| *at < offset) {
            let is_end = c == '\n' || c == '\r' && !text[at + 1..].starts_with('\n');
            let width = u32::try_from(c.len_utf16()).unwrap();
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
                proptest::sample::select(vec!["a", "ä", "🔪", "𝒳", "\n", "\r\n", "\r", " ", "mm"]), 0..40)
        ) {
            let whole: String = pieces.concat();
            let text = Text::new(&whole);
            for (offset, _) in whole.char_indices() {
                // Between the two characters of a line end is no place that a client can name.
                if whole[..offset].ends_with('\r') && whole[offset..].starts_with('\n') {
                    continue;
                }
                let position = text.position(offset);
                prop_assert_eq!(position, by_definition(&whole, offset));
                prop_assert_eq!(text.offset(position), offset);
            }
        }
    }
}
