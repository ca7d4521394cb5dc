//! What an editor can fold: blocks, and comments that take several lines.

use super::text::Text;
use lsp_types::{FoldingRange, FoldingRangeKind};
use vcutc_diagnostics::source::Span;
use vcutc_syntax::ast::{Ast, Block, Entry, Item};
use vcutc_syntax::lexical::{TokenKind, tokens};

/// The foldable ranges of a file, from the first to the last line of each.
pub(super) fn folds(ast: &Ast, text: &Text) -> Vec<FoldingRange> {
    let mut found = Vec::new();
    for item in &ast.items {
        match item {
            Item::Block(block) => of_block(block, text, &mut found),
            Item::Job { .. } | Item::Use { .. } | Item::Let { .. } => {}
        }
    }
    let comments = tokens(text.as_str()).filter(|token| token.kind == TokenKind::Comment);
    let comments = comments.filter_map(|token| {
        let lines = text.range(token.start..token.end);
        fold(lines.start.line, lines.end.line, Some(FoldingRangeKind::Comment))
    });
    found.extend(comments);
    found.sort_by_key(|fold| (fold.start_line, fold.end_line));
    found
}

/// Of a block and of those in it. Blocks are nested no deeper than the grammar lets them.
fn of_block(block: &Block, text: &Text, found: &mut Vec<FoldingRange>) {
    found.extend(of_span(block.span, text));
    of_entries(&block.entries, text, found);
}

fn of_entries(entries: &[Entry], text: &Text, found: &mut Vec<FoldingRange>) {
    for entry in entries {
        match entry {
            Entry::Block(inner) => of_block(inner, text, found),
            Entry::Row { span, .. } | Entry::ControlRow { span, .. } | Entry::SurfaceFile { span, .. } => {
                found.extend(of_span(*span, text))
            }
            Entry::Station { entries, span, .. } => {
                found.extend(of_span(*span, text));
                of_entries(entries, text, found);
            }
            Entry::Field { .. } | Entry::Limit { .. } | Entry::Formula { .. } | Entry::Curve { .. } => {}
        }
    }
}

/// The last line, that of the closing bracket, stays in sight.
fn of_span(span: Span, text: &Text) -> Option<FoldingRange> {
    let lines = text.range(span.bytes());
    fold(lines.start.line, lines.end.line.saturating_sub(1), None)
}

fn fold(start_line: u32, end_line: u32, kind: Option<FoldingRangeKind>) -> Option<FoldingRange> {
    (end_line > start_line).then(|| FoldingRange {
        start_line,
        end_line,
        kind,
        ..FoldingRange::default()
    })
}
