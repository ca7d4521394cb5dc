//! What each word of a text is, for colours: finer than a grammar of patterns can do.

use super::sites::{Kind, Named, sites};
use super::text::Text;
use lsp_types::{SemanticToken, SemanticTokenModifier, SemanticTokenType};
use std::collections::BTreeMap;
use vcutc_job::sema::kind::Operations;
use vcutc_job::sema::vocabulary;
use vcutc_syntax::ast::Ast;
use vcutc_syntax::lexical::{Token, TokenKind, tokens};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    Comment,
    Text,
    Number,
    Keyword,
    Operator,
    Variable,
    Type,
    Property,
    EnumMember,
    Function,
    Parameter,
    Unit,
}

/// The types of tokens, in the order of their numbers in answers.
pub(super) fn legend() -> Vec<SemanticTokenType> {
    vec![
        SemanticTokenType::COMMENT,
        SemanticTokenType::STRING,
        SemanticTokenType::NUMBER,
        SemanticTokenType::KEYWORD,
        SemanticTokenType::OPERATOR,
        SemanticTokenType::VARIABLE,
        SemanticTokenType::CLASS,
        SemanticTokenType::PROPERTY,
        SemanticTokenType::ENUM_MEMBER,
        SemanticTokenType::FUNCTION,
        SemanticTokenType::PARAMETER,
        SemanticTokenType::new("unit"),
    ]
}

/// The marks of tokens.
pub(super) fn modifiers() -> Vec<SemanticTokenModifier> {
    vec![SemanticTokenModifier::DECLARATION]
}

/// The one mark, as a bit.
const DECLARATION: u32 = 1;

/// A coloured stretch.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    start: usize,
    end: usize,
    class: Class,
    modifiers: u32,
}

/// The tokens of a file, each relative to the one before.
pub(super) fn semantic_tokens(ast: &Ast, operations: Operations, text: &Text) -> Vec<SemanticToken> {
    let known: BTreeMap<usize, Stretch> = sites(ast, operations)
        .iter()
        .filter_map(|site| {
            let (class, modifiers) = class_of(site.kind)?;
            let (start, end) = (site.span.start as usize, site.span.end as usize);
            Some((
                start,
                Stretch {
                    start,
                    end,
                    class,
                    modifiers,
                },
            ))
        })
        .collect();
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut done = 0;
    for token in tokens(text.as_str()) {
        if token.start < done {
            continue;
        }
        if let Some(stretch) = stretch_of(token, &known, (text.as_str(), operations)) {
            done = stretch.end;
            stretches.push(stretch);
        }
    }
    relative(&stretches, text)
}

/// What a site is, as far as words go: the first site of a place wins, and values begin where their first word does.
const fn class_of(kind: Kind<'_>) -> Option<(Class, u32)> {
    Some(match kind {
        Kind::Block | Kind::HeadWord | Kind::Auto => (Class::Keyword, 0),
        Kind::Definition(Named::Value, _) => (Class::Variable, DECLARATION),
        Kind::Definition(Named::Blade | Named::Region | Named::Machine, _) => (Class::Type, DECLARATION),
        Kind::Reference(_) => (Class::Variable, 0),
        Kind::Field(_) => (Class::Property, 0),
        Kind::Word => (Class::EnumMember, 0),
        Kind::Unit(_) => (Class::Unit, 0),
        Kind::Function(_) => (Class::Function, 0),
        Kind::Formula => (Class::Function, DECLARATION),
        Kind::Label(_) | Kind::Variable => (Class::Parameter, 0),
        Kind::JobName | Kind::Path(..) | Kind::Number(_) | Kind::Value(_) => return None,
    })
}

fn stretch_of(
    token: Token,
    known: &BTreeMap<usize, Stretch>,
    (text, operations): (&str, Operations),
) -> Option<Stretch> {
    let of = |class| Stretch {
        start: token.start,
        end: token.end,
        class,
        modifiers: 0,
    };
    match token.kind {
        TokenKind::Comment | TokenKind::UnclosedComment => Some(of(Class::Comment)),
        TokenKind::Text | TokenKind::UnclosedText => Some(of(Class::Text)),
        TokenKind::Number | TokenKind::InchMark => Some(of(Class::Number)),
        TokenKind::Word => match known.get(&token.start) {
            Some(stretch) => Some(*stretch),
            None => {
                let word = text.get(token.start..token.end).unwrap_or_default();
                is_keyword(word, operations).then(|| of(Class::Keyword))
            }
        },
        TokenKind::Symbol => match known.get(&token.start) {
            Some(stretch) => Some(*stretch),
            None => {
                let symbol = text.get(token.start..token.end).unwrap_or_default();
                let operators = ["+", "-", "*", "/", "^", "=", "<=", ">="];
                operators.contains(&symbol).then(|| of(Class::Operator))
            }
        },
        TokenKind::Open(_) | TokenKind::Close(_) => None,
    }
}

/// Words that are keywords where the tree has no site for them.
fn is_keyword(word: &str, operations: Operations) -> bool {
    let joints = vocabulary::JOINTS_OF_CURVES.contains(&word);
    joints
        || vocabulary::items(operations).any(|(known, _)| known == word)
        || vocabulary::begins_a_piece(word)
        || vocabulary::surface_file(word).is_some()
}

/// Places relative to each other, line by line: the protocol knows no token over several lines.
fn relative(stretches: &[Stretch], text: &Text) -> Vec<SemanticToken> {
    let mut tokens = Vec::new();
    let (mut line, mut character) = (0, 0);
    for stretch in stretches {
        let body = text.as_str().get(stretch.start..stretch.end).unwrap_or_default();
        let mut start = stretch.start;
        for piece in body.split_inclusive(['\n', '\r']) {
            let shown = piece.trim_end_matches(['\n', '\r']);
            let length = text.units(shown);
            let at = text.position(start);
            start += piece.len();
            if length == 0 {
                continue;
            }
            let delta_line = at.line.saturating_sub(line);
            let delta_start = if delta_line == 0 {
                at.character.saturating_sub(character)
            } else {
                at.character
            };
            (line, character) = (at.line, at.character);
            tokens.push(SemanticToken {
                delta_line,
                delta_start,
                length: u32::try_from(length).unwrap_or(u32::MAX),
                token_type: stretch.class as u32,
                token_modifiers_bitset: stretch.modifiers,
            });
        }
    }
    tokens
}
