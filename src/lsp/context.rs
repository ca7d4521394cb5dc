//! What can be written at a place of a text that is not finished: found from its tokens, since a text in the making has no
//! whole tree.

use super::slots::Slot;
use super::surroundings::{BlockAround, Surroundings};
use core::ops::Range;
use vcutc_job::sema::vocabulary;
use vcutc_syntax::ast::Row;
use vcutc_syntax::lexical::{Bracket, Token, TokenKind, tokens};

/// What is being written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Context {
    /// The word that the cursor is at the end of; empty where a new one begins.
    pub(super) word: Range<usize>,
    /// The blocks around it, from the outermost.
    pub(super) blocks: Vec<BlockAround>,
    /// What belongs there.
    pub(super) wanted: Wanted,
}

/// What belongs at the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Nothing: a comment, or a place that nothing fits.
    Nothing,
    /// An item of the file, or an entry of the innermost block.
    Entry,
    /// The next word of a head, with those before it.
    Head(Vec<String>),
    /// What a piece of a profile lacks: its first word, and the words that follow it already.
    Joint {
        /// The first word.
        piece: String,
        given: Vec<String>,
    },
    /// A point of a piece, or the path of its file.
    Point,
    /// A point in space.
    ControlPoint,
    /// The path of a file, with quotes.
    File,
    Value(Slot),
    /// A unit after a number.
    Unit(Slot),
    /// The name of a value in a call, or a value without one.
    Label {
        /// Where in which call.
        slot: Slot,
        /// Labels that the call has already.
        given: Vec<String>,
    },
    /// A text in quotes, with the words before it on its line.
    Text(Vec<String>),
}

/// What can be written at a byte of a text.
pub(super) fn context(text: &str, offset: usize) -> Context {
    let all: Vec<Token> = tokens(text)
        .filter(|token| {
            // Comments mean nothing, but nothing is written in them either.
            token.kind != TokenKind::Comment || token.start < offset && offset <= token.end
        })
        .collect();
    let around = Surroundings { text, all: &all };
    let at = around.token_at(offset);
    let (word, before) = match at {
        Some((number, token)) => match token.kind {
            TokenKind::Comment | TokenKind::UnclosedComment => return nothing(offset),
            TokenKind::Text | TokenKind::UnclosedText => return in_text(&around, number, token, offset),
            TokenKind::Word => (token.start..offset, number),
            TokenKind::Number if token.end > offset => return nothing(offset),
            TokenKind::InchMark => return nothing(offset),
            TokenKind::Number | TokenKind::Open(_) | TokenKind::Close(_) | TokenKind::Symbol => {
                (offset..offset, number + 1)
            }
        },
        None => (offset..offset, all.partition_point(|token| token.end <= offset)),
    };
    between(&around, word, before)
}

const fn nothing(offset: usize) -> Context {
    Context {
        word: offset..offset,
        blocks: Vec::new(),
        wanted: Wanted::Nothing,
    }
}

fn in_text(around: &Surroundings<'_>, number: usize, token: Token, offset: usize) -> Context {
    let end = if token.kind == TokenKind::Text {
        token.end.saturating_sub(1)
    } else {
        offset
    };
    Context {
        word: token.start + 1..end.max(token.start + 1),
        blocks: around.blocks(number),
        wanted: Wanted::Text(around.words_before(number)),
    }
}

/// What belongs between two tokens: before a number of a token, at the beginning of a word.
fn between(around: &Surroundings<'_>, word: Range<usize>, before: usize) -> Context {
    let innermost = around.open_at(before).last().copied();
    let blocks = around.blocks(before);
    let wanted = match innermost {
        Some(bracket) if around.is_short_form(bracket) => in_short_form(around, bracket, word.start, before),
        Some(bracket) if around.opens(bracket, Bracket::Round) => in_round(around, bracket, before),
        Some(_) | None => in_entry(around, word.start, before, blocks.len()),
    };
    Context { word, blocks, wanted }
}

/// In the brackets of a profile in its short form: first the file, then fields.
fn in_short_form(around: &Surroundings<'_>, bracket: usize, at: usize, before: usize) -> Wanted {
    if before == bracket + 1 {
        return Wanted::File;
    }
    in_entry(around, at, before, 2)
}

/// In round brackets: of a call, of a point, or of a calculation.
fn in_round(around: &Surroundings<'_>, bracket: usize, before: usize) -> Wanted {
    let last = before.saturating_sub(1);
    if around.is_number(last) {
        return Wanted::Unit(Slot::after(around, before));
    }
    if around.is_word(last) || around.closes(last) {
        // Between two values belongs an operator.
        return Wanted::Nothing;
    }
    let slot = Slot::at(around, before);
    let begins = last == bracket || around.is_symbol(last, &[","]);
    if begins && slot.call().is_some() {
        return Wanted::Label {
            slot,
            given: around.labels(bracket),
        };
    }
    Wanted::Value(slot)
}

/// In a block or at the top of the file.
fn in_entry(around: &Surroundings<'_>, at: usize, before: usize, depth: usize) -> Wanted {
    let Some(last) = before.checked_sub(1) else {
        return Wanted::Entry;
    };
    let is_next_line = around.is_next_line(last, at);
    if around.is_symbol(last, &["=", "<=", ">="]) {
        let words = around.words_before(before);
        return match words.first().map(String::as_str) {
            Some("machine" | "blade" | "profile") if depth == 0 => Wanted::Head(words),
            _ => Wanted::Value(Slot::at(around, before)),
        };
    }
    if around.is_symbol(last, &["+", "-", "*", "/", "^"]) {
        return Wanted::Value(Slot::at(around, before));
    }
    if around.is_number(last) && !is_next_line {
        return Wanted::Unit(Slot::after(around, before));
    }
    if around.is_word(last) && !is_next_line && depth == 0 {
        return Wanted::Head(around.words_before(before));
    }
    in_piece(around, before, depth).unwrap_or(Wanted::Entry)
}

/// After the beginning of a piece that lacks something, or of a row of points.
fn in_piece(around: &Surroundings<'_>, before: usize, depth: usize) -> Option<Wanted> {
    if depth == 0 {
        return None;
    }
    let (piece, given) = around.piece_before(before)?;
    let last = around.word(before.checked_sub(1)?).unwrap_or_default();
    let is_file = vocabulary::any_file(&piece).is_some();
    match last {
        "radius" => return Some(Wanted::Value(Slot::at(around, before))),
        "to" | "center" | "through" | "start" | "circle" => return Some(Wanted::Point),
        word if Row::named(word) == Some(Row::Control) => return Some(Wanted::ControlPoint),
        word if Row::named(word).is_some() => return Some(Wanted::Point),
        word if is_file && word == piece => return Some(Wanted::File),
        _ => {}
    }
    let lacks = match piece.as_str() {
        "line" | "bezier" | "spline" | "polyline" | "open" | "circle" => given.is_empty(),
        "arc" => given.len() < 2,
        _ => false,
    };
    lacks.then_some(Wanted::Joint { piece, given })
}
