//! Lines and columns of byte offsets, as people and editors count them.

/// A place in a text: both numbers count from 1, the column in characters (Unicode scalar values).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The line; lines end at `\n`.
    pub line: usize,
    /// The character in its line. A byte order mark at the start of the file is not counted.
    pub column: usize,
}

/// The place of a byte offset. Offsets within a character mean that character, offsets after the text its end.
#[must_use]
pub fn position(text: &str, offset: u32) -> Position {
    let before = text.get(..floor(text, offset)).unwrap_or_default();
    let before = before.strip_prefix('\u{feff}').unwrap_or(before);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    Position {
        line: 1 + before.bytes().filter(|&byte| byte == b'\n').count(),
        column: 1 + before.get(line_start..).unwrap_or_default().chars().count(),
    }
}

/// The nearest character boundary at or before an offset, no further than the end of the text.
pub(super) fn floor(text: &str, offset: u32) -> usize {
    text.floor_char_boundary(offset as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_counted_and_not_bytes() {
        let text = "\u{feff}aé\r\nµm x";
        let at = |offset| {
            let place = position(text, offset);
            (place.line, place.column)
        };
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(3), (1, 1));
        assert_eq!(at(4), (1, 2));
        assert_eq!(at(5), (1, 2), "within the é");
        assert_eq!(at(8), (2, 1));
        assert_eq!(at(10), (2, 2));
        assert_eq!(at(9999), (2, 5));
    }
}
