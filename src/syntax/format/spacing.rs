//! What the words of a statement are to one another, and what is between two of them.

use super::types::{Kind, Role, Word};
use crate::lexical::{Bracket, TokenKind};

/// What is between two words on one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spacing {
    None,
    Blank,
    /// A blank, or a line end where the line would be too long.
    Breakable,
}

/// Finds out what each word of a statement is.
pub(super) fn roles(kind: Kind, words: &mut [Word<'_>]) {
    let mut depth: usize = 0;
    for at in 0..words.len() {
        let (before, rest) = words.split_at_mut(at);
        let [word, next @ ..] = rest else {
            return;
        };
        // `at (2 * span) { ... }` is not a call either.
        let is_station = kind == Kind::Block && before.is_empty() && word.text == "at";
        let is_outer_curve = kind == Kind::Curve && depth == 0 || is_station;
        word.role = match word.kind {
            TokenKind::Open(Bracket::Round) => {
                depth += 1;
                match before.last() {
                    Some(name) if name.kind == TokenKind::Word && name.role == Role::Plain => Role::CallOpen,
                    _ => Role::Open,
                }
            }
            TokenKind::Close(Bracket::Round) => {
                depth = depth.saturating_sub(1);
                Role::Close
            }
            TokenKind::Symbol => symbol(before, word, next),
            TokenKind::Word => name(before, word, is_outer_curve),
            TokenKind::Number
            | TokenKind::Text
            | TokenKind::UnclosedText
            | TokenKind::InchMark
            | TokenKind::UnclosedComment
            | TokenKind::Comment
            | TokenKind::Open(Bracket::Curly)
            | TokenKind::Close(Bracket::Curly) => Role::Plain,
        };
    }
}

fn symbol(before: &[Word<'_>], word: &Word<'_>, next: &[Word<'_>]) -> Role {
    let previous = before.last();
    match word.text {
        "=" | "<=" | ">=" => Role::Relation,
        "," => Role::Comma,
        "^" => Role::Power,
        "%" => Role::Unit,
        "/" if goes_on_a_unit(previous, word, next) => Role::UnitRest,
        "-" if !ends_a_value(previous) => Role::Sign,
        "+" | "-" | "*" | "/" => Role::Operator,
        _ => Role::Odd,
    }
}

/// `mm/s` is a unit, `12 m / s` a division: a unit has no blanks in it.
fn goes_on_a_unit(previous: Option<&Word<'_>>, slash: &Word<'_>, next: &[Word<'_>]) -> bool {
    let is_unit = |word: &Word<'_>| word.role == Role::Unit && word.kind == TokenKind::Word;
    let is_word = |word: &Word<'_>| word.kind == TokenKind::Word && word.touches;
    slash.touches && previous.is_some_and(is_unit) && next.first().is_some_and(is_word)
}

fn ends_a_value(previous: Option<&Word<'_>>) -> bool {
    previous.is_some_and(|word| match word.role {
        Role::Plain | Role::Unit | Role::UnitRest | Role::Close | Role::Odd => true,
        Role::Lead
        | Role::Operator
        | Role::Power
        | Role::Sign
        | Role::Relation
        | Role::Comma
        | Role::CallOpen
        | Role::Open => false,
    })
}

fn name(before: &[Word<'_>], word: &Word<'_>, is_outer_curve: bool) -> Role {
    match before {
        [] if is_outer_curve => Role::Lead,
        [.., number] if number.kind == TokenKind::Number => Role::Unit,
        [.., slash] if slash.role == Role::UnitRest && slash.text == "/" => Role::UnitRest,
        // `to` right after `line`; after a point only such a word can follow, and no name can.
        [_] if is_outer_curve && word.text == "to" => Role::Lead,
        [.., point] if is_outer_curve && point.role == Role::Close => Role::Lead,
        _ => Role::Plain,
    }
}

/// What is between a word and the one before.
pub(super) fn between(previous: &Word<'_>, word: &Word<'_>) -> Spacing {
    match (previous.role, word.role) {
        (Role::Odd, _) | (_, Role::Odd) if word.touches => Spacing::None,
        (Role::Sign | Role::Power | Role::Open | Role::CallOpen, _)
        | (_, Role::Power | Role::Comma | Role::CallOpen | Role::Close | Role::UnitRest) => Spacing::None,
        (_, Role::Operator) | (Role::Close, Role::Lead | Role::Open) => Spacing::Breakable,
        (
            Role::Plain
            | Role::Lead
            | Role::Unit
            | Role::UnitRest
            | Role::Operator
            | Role::Relation
            | Role::Comma
            | Role::Close
            | Role::Odd,
            Role::Plain | Role::Lead | Role::Unit | Role::Sign | Role::Relation | Role::Open | Role::Odd,
        ) => Spacing::Blank,
    }
}
