//! The list of a program's modules, a small XML file.

use super::piece::{Piece, PieceKind};

/// A statement of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    pub(super) piece: Piece,
    /// The module's file, where it names one.
    pub(super) module: Option<String>,
}

/// The order in which the parts of a list come.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    Start,
    Declared,
    Open,
    Closed,
}

/// What stands in a list. What does not belong there is [`PieceKind::Broken`], and so is the end of one that does not end.
pub(super) fn entries(text: &str) -> Vec<Entry> {
    let mut found = Vec::new();
    let mut stage = Stage::Start;
    let mut at = 0;
    while let Some(start) = next_of(text, at) {
        let rest = text.get(start..).unwrap_or_default();
        let tag_end = rest.find('>').map_or(text.len(), |end| start + end + 1);
        let tag = text.get(start..tag_end).unwrap_or_default();
        let (end, next, module) = match tag.to_ascii_lowercase().as_str() {
            tag if tag.starts_with("<?xml") && stage == Stage::Start => {
                (tag_end, Some(Stage::Declared), None)
            }
            "<program>" if stage < Stage::Open => (tag_end, Some(Stage::Open), None),
            "<module>" if stage == Stage::Open => match module(text, tag_end) {
                Some((name, end)) => (end, Some(Stage::Open), Some(name)),
                None => (tag_end, None, None),
            },
            "</program>" if stage == Stage::Open => (tag_end, Some(Stage::Closed), None),
            tag if tag.starts_with('<') => (tag_end, None, None),
            // Text outside of tags, up to the next one.
            _ => (rest.find('<').map_or(text.len(), |end| start + end), None, None),
        };
        let kind = match next {
            Some(_) => PieceKind::Statement,
            None => PieceKind::Broken,
        };
        stage = next.unwrap_or(stage);
        found.push(Entry {
            piece: piece(kind, start, end),
            module,
        });
        at = end;
    }
    if stage != Stage::Closed
        && let Some(last) = found.last_mut()
    {
        last.piece.kind = PieceKind::Broken;
    }
    found
}

fn piece(kind: PieceKind, start: usize, end: usize) -> Piece {
    let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    Piece {
        kind,
        start: place(start),
        end: place(end),
    }
}

/// The next place that is not blank.
fn next_of(text: &str, at: usize) -> Option<usize> {
    let rest = text.get(at..)?;
    rest.find(|c: char| !c.is_whitespace()).map(|blanks| at + blanks)
}

/// The name after `<Module>`, and the end of its closing tag.
fn module(text: &str, at: usize) -> Option<(String, usize)> {
    const CLOSES: &str = "</module>";
    let rest = text.get(at..)?;
    let length = rest.find('<')?;
    let name = rest.get(..length)?.trim();
    let closing = rest.get(length..length + CLOSES.len())?;
    let is_named = !name.is_empty() && closing.eq_ignore_ascii_case(CLOSES);
    is_named.then(|| (name.to_owned(), at + length + CLOSES.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_list_names_its_modules() {
        let text = "<?xml version=\"1.0\" ?>\n<Program>\n <Module>a.mod</Module>\n<MODULE> b.mod </module></Program>\n";
        let found = entries(text);
        let modules: Vec<_> = found.iter().filter_map(|entry| entry.module.as_deref()).collect();
        assert_eq!(modules, ["a.mod", "b.mod"]);
        assert!(found.iter().all(|entry| entry.piece.kind == PieceKind::Statement));
        assert_eq!(found[2].piece.text(text), "<Module>a.mod</Module>");
    }

    #[test]
    fn a_list_out_of_order_is_broken() {
        for text in [
            "<Program><Module>a</Module>",
            "<Module>a</Module><Program></Program>",
            "<Program></Program><Program></Program>",
            "<Program>a</Program>",
            "<Program><Module></Module></Program>",
            "<Program><?xml ?></Program>",
        ] {
            let broken = entries(text)
                .iter()
                .any(|entry| entry.piece.kind == PieceKind::Broken);
            assert!(broken, "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_text_falls_into_entries(text in "(<|>|/|<Program>|<Module>|</Module>|</Program>|a|ä| )*") {
            let mut last = 0;
            for entry in entries(&text) {
                prop_assert!(entry.piece.start >= last && entry.piece.end > entry.piece.start);
                prop_assert!(!entry.piece.text(&text).is_empty());
                last = entry.piece.end;
            }
        }
    }
}
