//! The outline of a file: its items, and the fields of its blocks.

use super::text::Text;
use lsp_types::{DocumentSymbol, SymbolKind};
use vcutc_diagnostics::source::Span;
use vcutc_syntax::ast::{Ast, Block, Entry, HeadPart, Item};

/// What a file defines for others or is called by: jobs, values, blades and machines, without what is inside of them.
pub(super) fn defined(ast: &Ast, text: &Text) -> Vec<DocumentSymbol> {
    let is_named = |item: &&Item| match item {
        Item::Job { .. } | Item::Let { .. } => true,
        Item::Use { .. } => false,
        Item::Block(block) => matches!(
            block.head.first().map(|part| &part.node),
            Some(HeadPart::Word(word)) if word == "blade" || word == "machine"
        ),
    };
    ast.items
        .iter()
        .filter(is_named)
        .map(|item| of_item(item, text))
        .collect()
}

/// The outline.
pub(super) fn symbols(ast: &Ast, text: &Text) -> Vec<DocumentSymbol> {
    ast.items.iter().map(|item| of_item(item, text)).collect()
}

fn of_item(item: &Item, text: &Text) -> DocumentSymbol {
    match item {
        Item::Job { name, span } => symbol(&name.node, "job", SymbolKind::MODULE, *span, name.span, text),
        Item::Use { path, span } => symbol(&path.node, "use", SymbolKind::FILE, *span, path.span, text),
        Item::Let { name, value, span } => {
            let value = text.as_str().get(value.span.bytes()).unwrap_or_default();
            symbol(&name.node, value, SymbolKind::CONSTANT, *span, name.span, text)
        }
        Item::Block(block) => of_block(block, text),
    }
}

fn of_block(block: &Block, text: &Text) -> DocumentSymbol {
    let word = |number: usize| match block.head.get(number).map(|part| &part.node) {
        Some(HeadPart::Word(word)) => word.as_str(),
        Some(HeadPart::Text(_) | HeadPart::Equals) | None => "",
    };
    let (kind, name) = match word(0) {
        "blade" => (SymbolKind::CLASS, word(1).to_owned()),
        "machine" => (SymbolKind::OBJECT, word(1).to_owned()),
        _ if !word(1).is_empty() => (SymbolKind::FUNCTION, block.head_text()),
        _ => (SymbolKind::STRUCT, block.head_text()),
    };
    let detail = block.head_text();
    let head = block.head.iter().map(|part| part.span);
    let head = head.reduce(Span::to).unwrap_or(block.span);
    let name = if name.is_empty() { detail.clone() } else { name };
    let mut whole = symbol(&name, &detail, kind, block.span, head, text);
    let children: Vec<DocumentSymbol> = block
        .entries
        .iter()
        .filter_map(|entry| of_entry(entry, text))
        .collect();
    whole.children = Some(children);
    whole
}

fn of_entry(entry: &Entry, text: &Text) -> Option<DocumentSymbol> {
    match entry {
        Entry::Field { name, value, span }
        | Entry::Limit {
            name, value, span, ..
        } => {
            let value = text.as_str().get(value.span.bytes()).unwrap_or_default();
            let kind = SymbolKind::FIELD;
            Some(symbol(&name.node, value, kind, *span, name.span, text))
        }
        Entry::Block(inner) => Some(of_block(inner, text)),
        Entry::Formula {
            name, value, span, ..
        } => {
            let value = text.as_str().get(value.span.bytes()).unwrap_or_default();
            let kind = SymbolKind::FUNCTION;
            Some(symbol(&name.node, value, kind, *span, name.span, text))
        }
        Entry::Station {
            word,
            at,
            entries,
            span,
        } => {
            let name = text.as_str().get(word.to(at.span).bytes()).unwrap_or_default();
            let mut station = symbol(name, "", SymbolKind::OBJECT, *span, *word, text);
            let children = entries.iter().filter_map(|entry| of_entry(entry, text));
            station.children = Some(children.collect());
            Some(station)
        }
        Entry::Curve { .. } | Entry::Row { .. } | Entry::ControlRow { .. } | Entry::SurfaceFile { .. } => {
            None
        }
    }
}

#[expect(deprecated, reason = "the protocol's type has a field that is deprecated")]
fn symbol(
    name: &str,
    detail: &str,
    kind: SymbolKind,
    whole: Span,
    selection: Span,
    text: &Text,
) -> DocumentSymbol {
    // The protocol knows no symbol without a name.
    let name = if name.trim().is_empty() {
        "(without a name)"
    } else {
        name
    };
    DocumentSymbol {
        name: name.to_owned(),
        detail: Some(first_line(detail)),
        kind,
        tags: None,
        deprecated: None,
        range: text.range(whole.bytes()),
        selection_range: text.range(selection.bytes()),
        children: None,
    }
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().chars().take(80).collect()
}
