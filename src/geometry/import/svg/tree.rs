//! The XML of an SVG, within bounds, and places in it.

use super::super::DataError;
use super::super::drawing::Place;
use core::ops::Range;
use roxmltree::{Attribute, Document, Error, Node, ParsingOptions, TextPos};

/// Most attributes of a tag. The XML reader compares every attribute of a tag with every other.
const MOST_ATTRIBUTES: usize = 1000;
/// Most declarations of namespaces. The XML reader hands them down from element to element.
const MOST_NAMESPACES: usize = 64;
/// Most nodes (elements, comments and stretches of text).
const MOST_NODES: u32 = 1_000_000;

/// Parses the text of an SVG.
pub(super) fn document(text: &str) -> Result<Document<'_>, DataError> {
    if let Some(at) = text.find("<!ENTITY") {
        return Err(DataError::new(
            at..at + 8,
            "the file declares entities, which are not read: save it as plain SVG",
        ));
    }
    let mut start = 0;
    for tag in text.split('<') {
        // Between the quotes of a value there is neither.
        if tag.matches("=\"").count() + tag.matches("='").count() > MOST_ATTRIBUTES {
            let message = format!("a tag with more than {MOST_ATTRIBUTES} attributes");
            return Err(DataError::new(
                start..start + tag.chars().next().map_or(0, char::len_utf8),
                message,
            ));
        }
        start += tag.len() + 1;
    }
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        let message = format!("the file declares more than {MOST_NAMESPACES} namespaces");
        return Err(DataError::new(0..0, message));
    }
    let options = ParsingOptions {
        nodes_limit: MOST_NODES,
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|error| not_xml(text, &error))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(place(root).error("an SVG begins with the element `svg`; this is something else"));
    }
    Ok(document)
}

fn not_xml(text: &str, error: &Error) -> DataError {
    if matches!(error, Error::NodesLimitReached) {
        let message = format!("the file has more than {MOST_NODES} elements and texts");
        return DataError::new(0..0, message);
    }
    let at = byte_at(text, error.pos());
    let end = text
        .get(at..)
        .and_then(|rest| rest.chars().next())
        .map_or(at, |c| at + c.len_utf8());
    // The reader's words may quote names of any length.
    let words: String = error.to_string().chars().take(200).collect();
    DataError::new(at..end, format!("this is not well-formed XML: {words}"))
}

/// The byte at a line and column, both counted from 1 and in characters.
fn byte_at(text: &str, position: TextPos) -> usize {
    let (row, column) = (position.row as usize, position.col as usize);
    let mut line_start = 0;
    for line in text.split_inclusive('\n').take(row.saturating_sub(1)) {
        line_start += line.len();
    }
    let line = text.get(line_start..).unwrap_or_default();
    let before = line.char_indices().nth(column.saturating_sub(1));
    line_start + before.map_or(line.len(), |(at, _)| at)
}

/// The opening of an element's tag: where an element as a whole is spoken of.
pub(super) fn place(node: Node<'_, '_>) -> Place {
    let start = node.range().start;
    let text = node.document().input_text().get(start..).unwrap_or_default();
    let is_end = |c: char| c.is_whitespace() || matches!(c, '>' | '/');
    Place::of(start..start + text.find(is_end).unwrap_or(text.len()))
}

/// The text of an attribute and where it begins in the file.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    pub(super) text: &'a str,
    range: (usize, usize),
    /// Whether the file has the text letter by letter, without references such as `&#32;`.
    is_plain: bool,
}

impl<'a> Text<'a> {
    fn of(attribute: Attribute<'a, '_>, document: &Document<'_>) -> Self {
        let range = attribute.range_value();
        Self {
            text: attribute.value(),
            is_plain: document.input_text().get(range.clone()) == Some(attribute.value()),
            range: (range.start, range.end),
        }
    }

    /// The place of a stretch of it, or of all of it where the file has it in other letters.
    pub(super) fn place(self, within: Range<usize>) -> Place {
        let (start, end) = self.range;
        Place::of(if self.is_plain {
            start + within.start..start + within.end
        } else {
            start..end
        })
    }
}

/// An attribute without a namespace.
pub(super) fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Option<Text<'a>> {
    let attribute = node.attribute_node(name)?;
    Some(Text::of(attribute, node.document()))
}
