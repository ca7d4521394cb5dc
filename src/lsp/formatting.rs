//! The one layout of job files, as the edit that leads to it.

use super::text::Text;
use lsp_types::TextEdit;
use vcutc_diagnostics::source::SourceMap;
use vcutc_syntax::format::format;

/// The edit that gives a text its layout: no more than what differs, so that cursors stay where they are. None for a text with
/// mistakes, which has no layout, and no edit for one that has it already.
pub(super) fn formatting(text: &Text) -> Option<Vec<TextEdit>> {
    let old = text.as_str();
    let file = SourceMap::default().add("", "");
    let new = format(file, old).ok()?;
    if new == old {
        return Some(Vec::new());
    }
    // Between `\r` and `\n` there is no place that a client can name.
    if old.contains('\r') {
        return Some(vec![TextEdit {
            range: text.range(0..old.len()),
            new_text: new,
        }]);
    }
    let ahead = common(old.chars(), new.chars());
    let (old_rest, new_rest) = (old.get(ahead..)?, new.get(ahead..)?);
    let after = common(old_rest.chars().rev(), new_rest.chars().rev());
    let new_text = new_rest.get(..new_rest.len() - after)?.to_owned();
    Some(vec![TextEdit {
        range: text.range(ahead..old.len() - after),
        new_text,
    }])
}

/// How many bytes two texts share, whole characters only.
fn common(a: impl Iterator<Item = char>, b: impl Iterator<Item = char>) -> usize {
    let same = a.zip(b).take_while(|(a, b)| a == b);
    same.map(|(c, _)| c.len_utf8()).sum()
}

#[cfg(test)]
mod tests {
    use super::super::text::Encoding;
    use super::*;

    fn formatted(text: &str) -> Option<String> {
        let text = Text::new(text, Encoding::Utf16);
        let edits = formatting(&text)?;
        let mut new = text.as_str().to_owned();
        for edit in edits {
            let (start, end) = (text.offset(edit.range.start), text.offset(edit.range.end));
            new.replace_range(start..end, &edit.new_text);
        }
        Some(new)
    }

    #[test]
    fn the_edit_leads_to_the_layout() {
        let file = SourceMap::default().add("", "");
        for text in [
            "let a=3mm",
            "let   a = 3 mm // ääää\n\n\n\nlet b=a\n",
            "// 🔪🔪\nlet a    = 3 mm\n",
            "let a    = 3 mm\r\nlet b = a\r\n",
            "",
            "let a = 3 mm\n",
        ] {
            assert_eq!(formatted(text), format(file, text).ok(), "{text:?}");
        }
        assert_eq!(formatted("let a = "), None);
    }
}
