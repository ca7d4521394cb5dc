//! Applying fixes to a text.

use super::Edit;
use crate::source::FileId;

/// The text of `file` with the edits of that file made. `None` if they overlap or do not fit the text.
///
/// Edits at the same place are made in the order given.
#[must_use]
pub fn apply(text: &str, file: FileId, edits: &[Edit]) -> Option<String> {
    let mut edits: Vec<&Edit> = edits.iter().filter(|edit| edit.span.file == file).collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut fixed = String::with_capacity(text.len());
    let mut done = 0;
    for edit in edits {
        let range = edit.span.bytes();
        fixed.push_str(text.get(done..range.start)?);
        text.get(range.clone())?;
        fixed.push_str(&edit.replacement);
        done = range.end;
    }
    fixed.push_str(text.get(done..)?);
    Some(fixed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{SourceMap, Span};

    fn edit(file: FileId, start: u32, end: u32, replacement: &str) -> Edit {
        Edit {
            span: Span { file, start, end },
            replacement: replacement.to_owned(),
        }
    }

    #[test]
    fn edits_are_made_in_the_order_of_the_text() {
        let mut sources = SourceMap::default();
        let (file, other) = (sources.add("a", ""), sources.add("b", ""));
        let edits = [
            edit(file, 7, 8, "8"),
            edit(other, 0, 1, "!"),
            edit(file, 3, 3, " mm"),
        ];
        assert_eq!(apply("a=4, b=5", file, &edits).as_deref(), Some("a=4 mm, b=8"));
    }

    #[test]
    fn edits_that_do_not_fit_are_refused() {
        let file = SourceMap::default().add("a", "");
        assert_eq!(apply("abc", file, &[edit(file, 2, 9, "")]), None);
        assert_eq!(apply("aé", file, &[edit(file, 2, 3, "")]), None);
        assert_eq!(
            apply("abc", file, &[edit(file, 0, 2, ""), edit(file, 1, 3, "")]),
            None
        );
    }
}
