//! The groups of a DXF file: a code on one line, a value on the next.

use super::super::drawing::Place;
use super::super::{DataError, Piece, lines, shortened};
use core::ops::Range;

/// A group: its code, and where its value stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    pub(super) code: i32,
    pub(super) place: Place,
}

/// The groups of a file, one by one, with a look at the next.
pub(super) struct Groups<'t> {
    text: &'t str,
    lines: Box<dyn Iterator<Item = Piece<'t>> + 't>,
    next: Option<Group>,
}

impl<'t> Groups<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            lines: Box::new(lines(text)),
            next: None,
        }
    }

    /// The value of a group, without blanks around it.
    pub(super) fn value(&self, group: Group) -> &'t str {
        self.text
            .get(group.place.start as usize..group.place.end as usize)
            .unwrap_or_default()
    }

    /// The next group, which stays the next; none at the end of the file.
    pub(super) fn peek(&mut self) -> Result<Option<Group>, DataError> {
        if self.next.is_none() {
            self.next = self.read()?;
        }
        Ok(self.next)
    }

    /// The next group.
    ///
    /// # Errors
    /// Also at the end of the file, which is not where a DXF ends.
    pub(super) fn take(&mut self) -> Result<Group, DataError> {
        let group = self.peek()?;
        self.next = None;
        group.ok_or_else(|| self.truncated())
    }

    /// The file ends before its `EOF`.
    pub(super) fn truncated(&self) -> DataError {
        let end = self.text.trim_end().len();
        let line = self.text.get(..end).unwrap_or_default();
        let start = line.rfind(['\n', '\r']).map_or(0, |at| at + 1);
        let message = "the file ends here, before its `EOF`: it was cut off";
        DataError::new(start..end, message)
    }

    fn read(&mut self) -> Result<Option<Group>, DataError> {
        loop {
            let Some(code) = self.lines.next() else {
                return Ok(None);
            };
            let Some(value) = self.lines.next() else {
                return if code.text.is_empty() {
                    Ok(None)
                } else {
                    Err(self.truncated())
                };
            };
            let number = self.code(code)?;
            // 999 is a remark.
            if number != 999 {
                return Ok(Some(Group {
                    code: number,
                    place: Place::of(value.range()),
                }));
            }
        }
    }

    fn code(&self, line: Piece<'_>) -> Result<i32, DataError> {
        let code = line.text.parse().ok();
        code.filter(|code| (-5..=1071).contains(code)).ok_or_else(|| {
            let range = visible(line, self.text);
            let message = if line.text.is_empty() {
                "a group code is missing here: this line is empty".to_owned()
            } else {
                format!("`{}` is not a group code of a DXF", shortened(line.text))
            };
            DataError::new(range, message)
        })
    }
}

/// The place of a line, stretched by a byte where it is empty.
fn visible(line: Piece<'_>, text: &str) -> Range<usize> {
    let range = line.range();
    let end = if range.is_empty() {
        (range.end + 1).min(text.len())
    } else {
        range.end
    };
    if text.is_char_boundary(end) {
        range.start..end
    } else {
        range
    }
}
