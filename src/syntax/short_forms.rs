//! Sources of surfaces in the short form that a profile of one file has: `surface = mesh("fairing.stl", unit = mm)`,
//! `at 0 mm = airfoil("naca2412.dat", chord = 300 mm)`. They are written as blocks.

use super::bad::{Bad, shown};
use super::lexical::{Bracket, Token, TokenKind};
use vcutc_diagnostics::{Code, Diagnostic};

/// A surface after `=`.
pub(super) fn surface(bad: &Bad<'_>) -> Option<Diagnostic> {
    let tokens: Vec<Token> = bad.tokens().collect();
    let (&[first, equals], value) = tokens.split_first_chunk()?;
    let here = bad.span(first.start..first.end);
    let diagnostic = Diagnostic::new(
        Code::UnexpectedText,
        "a surface stands in a block, not after `=`",
        here,
        "a block is expected",
    );
    Some(match block(bad, value, &["mesh", "grid"]) {
        Some(Written { text, end }) => diagnostic.fix(
            "write a block, `surface { ... }`",
            bad.span(equals.start..end),
            format!("{{ {text} }}"),
        ),
        None => diagnostic.help(
            "write `surface { mesh \"FILE\" { unit = mm } }`, or a `grid`, a `loft` or a formula `z(x, y) = ...` in the block",
        ),
    })
}

/// A profile of a loft after `=`.
pub(super) fn station(bad: &Bad<'_>) -> Option<Diagnostic> {
    let tokens: Vec<Token> = bad.tokens().collect();
    let place = tokens.iter().position(|&token| bad.token(token) == "=")?;
    let (before, after) = tokens.split_at_checked(place)?;
    let (&equals, value) = after.split_first()?;
    // What opens a block before is a mistake of another kind.
    if before
        .iter()
        .any(|token| token.kind == TokenKind::Open(Bracket::Curly))
    {
        return None;
    }
    let head = bad.slice(0..before.last()?.end);
    let diagnostic = Diagnostic::new(
        Code::UnexpectedText,
        "a profile of a loft stands in a block, not after `=`",
        bad.span(equals.start..equals.end),
        "`at` takes a block",
    );
    Some(match block(bad, value, &["points", "airfoil", "dxf", "svg"]) {
        Some(Written { text, end }) => diagnostic.fix(
            format!("write a block, `{} {{ ... }}`", shown(head)),
            bad.span(equals.start..end),
            format!("{{ {text} }}"),
        ),
        None => diagnostic.help(format!(
            "write `{} {{ airfoil \"FILE\" {{ ... }} }}`, or other pieces of a profile in the block",
            shown(head)
        )),
    })
}

/// A source as it is written in a block.
struct Written {
    text: String,
    /// Where it ends in the statement.
    end: usize,
}

/// The block form of `word("file", name = value)`, for some words.
fn block(bad: &Bad<'_>, value: &[Token], words: &[&str]) -> Option<Written> {
    let (&[word, open, file], rest) = value.split_first_chunk()?;
    let is_call = words.contains(&bad.token(word))
        && open.kind == TokenKind::Open(Bracket::Round)
        && file.kind == TokenKind::Text;
    if !is_call {
        return None;
    }
    let mut depth = 1_usize;
    let close = rest.iter().find(|token| {
        match token.kind {
            TokenKind::Open(Bracket::Round) => depth += 1,
            TokenKind::Close(Bracket::Round) => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    let options = bad
        .slice(file.end..close.start)
        .trim_matches([' ', '\t', '\r', '\n', ',']);
    let named = format!("{} {}", bad.token(word), bad.token(file));
    Some(Written {
        text: match options {
            "" => named,
            options => format!("{named} {{ {options} }}"),
        },
        end: close.end,
    })
}
