//! What can be written at a place of a text that is not finished: found from its tokens, since a text in the making has no
//! whole tree.

use crate::syntax::lexical::{Bracket, Token, TokenKind, tokens};
use core::ops::Range;

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

/// A block around the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct BlockAround {
    /// The words of its head.
    pub(super) head: Vec<String>,
    /// What stands in it already, on both sides of the cursor: the first words of its entries.
    pub(super) entries: Vec<String>,
}

impl BlockAround {
    /// The first word of the head, of inner blocks the last one before the brace.
    pub(super) fn name(&self) -> &str {
        self.head.first().map_or("", String::as_str)
    }
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
    /// A value of a field, or of a `let`.
    Value(String),
    /// A unit behind a number, in the value of a field.
    Unit(String),
    /// The name of a value in a call, with those that are there.
    Label {
        /// The call.
        function: String,
        /// Labels that it has already.
        given: Vec<String>,
    },
    /// A text in quotes, with the words before it on its line.
    Text(Vec<String>),
}

/// What can be written at a byte of a text.
pub(super) fn context(text: &str, offset: usize) -> Context {
    let all: Vec<Token> = tokens(text).collect();
    let reader = Reader { text, all: &all };
    let at = reader.token_at(offset);
    let (word, before) = match at {
        Some((number, token)) => match token.kind {
            TokenKind::Comment | TokenKind::UnclosedComment => return nothing(offset),
            TokenKind::Text | TokenKind::UnclosedText => return reader.in_text(number, token, offset),
            TokenKind::Word => (token.start..offset, number),
            TokenKind::Number if token.end > offset => return nothing(offset),
            TokenKind::Number | TokenKind::Open(_) | TokenKind::Close(_) | TokenKind::Symbol => {
                (offset..offset, number + 1)
            }
        },
        None => (offset..offset, all.partition_point(|token| token.end <= offset)),
    };
    reader.between(word, before)
}

const fn nothing(offset: usize) -> Context {
    Context {
        word: offset..offset,
        blocks: Vec::new(),
        wanted: Wanted::Nothing,
    }
}

/// A bracket that is open at the cursor: the number of its token.
type Open = usize;

struct Reader<'t> {
    text: &'t str,
    all: &'t [Token],
}

impl Reader<'_> {
    /// The token in which, or at the end of which, a byte is.
    fn token_at(&self, offset: usize) -> Option<(usize, Token)> {
        let number = self.all.partition_point(|token| token.end < offset);
        let token = *self.all.get(number)?;
        let is_in = token.start < offset && offset <= token.end;
        // An own end closes a text or a bracketed comment: behind it, one is out.
        let is_behind = offset == token.end
            && (token.kind == TokenKind::Text
                || token.kind == TokenKind::Comment && self.slice(token).ends_with("*/"));
        (is_in && !is_behind).then_some((number, token))
    }

    fn slice(&self, token: Token) -> &str {
        self.text.get(token.start..token.end).unwrap_or_default()
    }

    fn is_symbol(&self, number: usize, symbols: &[&str]) -> bool {
        let token = self.all.get(number).copied();
        token.is_some_and(|token| token.kind == TokenKind::Symbol && symbols.contains(&self.slice(token)))
    }

    fn word(&self, number: usize) -> Option<&str> {
        let token = *self.all.get(number)?;
        (token.kind == TokenKind::Word).then(|| self.slice(token))
    }

    /// Words, equals signs and texts of a line up to a token, from the front.
    fn words_before(&self, number: usize) -> Vec<String> {
        let Some(line) = self.all.get(number.saturating_sub(1)).map(|token| token.line) else {
            return Vec::new();
        };
        let tokens = self.all.get(..number).unwrap_or_default();
        let mut words: Vec<String> = tokens
            .iter()
            .rev()
            .take_while(|token| {
                token.line == line && !matches!(token.kind, TokenKind::Open(_) | TokenKind::Close(_))
            })
            .map(|token| self.slice(*token).to_owned())
            .collect();
        words.reverse();
        words
    }

    fn in_text(&self, number: usize, token: Token, offset: usize) -> Context {
        let end = if token.kind == TokenKind::Text {
            token.end.saturating_sub(1)
        } else {
            offset
        };
        Context {
            word: token.start + 1..end.max(token.start + 1),
            blocks: self.blocks(&self.open_at(number)),
            wanted: Wanted::Text(self.words_before(number)),
        }
    }

    /// The brackets that are open before a token.
    fn open_at(&self, before: usize) -> Vec<Open> {
        let mut open: Vec<Open> = Vec::new();
        for (number, token) in self.all.iter().enumerate().take(before) {
            match token.kind {
                TokenKind::Open(_) => open.push(number),
                TokenKind::Close(bracket) => {
                    let partner = open.iter().rposition(|&number| self.opens(number, bracket));
                    if let Some(partner) = partner {
                        open.truncate(partner);
                    }
                }
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {}
            }
        }
        open
    }

    fn opens(&self, number: usize, bracket: Bracket) -> bool {
        self.all
            .get(number)
            .is_some_and(|token| token.kind == TokenKind::Open(bracket))
    }

    fn blocks(&self, open: &[Open]) -> Vec<BlockAround> {
        let curly = open
            .iter()
            .copied()
            .filter(|&number| self.opens(number, Bracket::Curly));
        curly
            .enumerate()
            .map(|(depth, number)| BlockAround {
                head: self.head(number, depth),
                entries: self.entries(number),
            })
            .collect()
    }

    /// The words of the head before a brace. Of an inner block only the last one: what stands before may be a field.
    fn head(&self, brace: usize, depth: usize) -> Vec<String> {
        if depth > 0 {
            let mut number = brace.saturating_sub(1);
            // `points "file" { ... }`
            if self
                .all
                .get(number)
                .is_some_and(|token| token.kind == TokenKind::Text)
            {
                number = number.saturating_sub(1);
            }
            return self.word(number).map(str::to_owned).into_iter().collect();
        }
        let tokens = self.all.get(..brace).unwrap_or_default();
        let start = tokens
            .iter()
            .rposition(|token| matches!(token.kind, TokenKind::Close(_) | TokenKind::Number) || token.leads)
            .unwrap_or(0);
        let is_before = tokens
            .get(start)
            .is_some_and(|token| matches!(token.kind, TokenKind::Close(_) | TokenKind::Number));
        let from = start + usize::from(is_before);
        let words = tokens.get(from..).unwrap_or_default();
        words
            .iter()
            .filter(|token| token.kind != TokenKind::Comment)
            .map(|token| self.slice(*token).to_owned())
            .collect()
    }

    /// The first words of the entries between a brace and its partner.
    fn entries(&self, brace: usize) -> Vec<String> {
        let is_entry = |number: usize| {
            self.is_symbol(number + 1, &["=", "<=", ">="]) || self.opens(number + 1, Bracket::Curly)
        };
        self.words_in(brace, is_entry)
    }

    /// The words directly between a bracket and its partner of which something holds.
    fn words_in(&self, bracket: usize, is_wanted: impl Fn(usize) -> bool) -> Vec<String> {
        let mut depth = 0_usize;
        let mut words = Vec::new();
        for (number, token) in self.all.iter().enumerate().skip(bracket + 1) {
            match token.kind {
                TokenKind::Open(_) => depth += 1,
                TokenKind::Close(_) if depth == 0 => break,
                TokenKind::Close(_) => depth -= 1,
                TokenKind::Word if depth == 0 && is_wanted(number) => {
                    words.push(self.slice(*token).to_owned());
                }
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {}
            }
        }
        words
    }

    /// What belongs between two tokens.
    fn between(&self, word: Range<usize>, before: usize) -> Context {
        let open = self.open_at(before);
        let blocks = self.blocks(&open);
        let wanted = match open.last() {
            Some(&number) if self.opens(number, Bracket::Round) => self.in_round(number, before),
            _ => self.in_entry(word.start, before, blocks.len()),
        };
        Context { word, blocks, wanted }
    }

    /// In round brackets: of a call, or of a calculation.
    fn in_round(&self, bracket: usize, before: usize) -> Wanted {
        let field = self.field_before(bracket);
        let last = before.saturating_sub(1);
        if self.is_number(last) {
            return Wanted::Unit(field);
        }
        let function = bracket
            .checked_sub(1)
            .and_then(|number| self.word(number))
            .unwrap_or_default();
        let begins = last == bracket || self.is_symbol(last, &[","]);
        if begins && !function.is_empty() {
            return Wanted::Label {
                function: function.to_owned(),
                given: self.labels(bracket),
            };
        }
        Wanted::Value(field)
    }

    fn is_number(&self, number: usize) -> bool {
        self.all
            .get(number)
            .is_some_and(|token| token.kind == TokenKind::Number)
    }

    /// The labels of a call.
    fn labels(&self, bracket: usize) -> Vec<String> {
        self.words_in(bracket, |number| self.is_symbol(number + 1, &["="]))
    }

    /// The field whose value a token is part of: the word before the nearest sign that gives a value.
    fn field_before(&self, before: usize) -> String {
        let mut depth = 0_usize;
        for number in (0..before).rev() {
            let Some(token) = self.all.get(number) else { break };
            match token.kind {
                TokenKind::Close(_) => depth += 1,
                TokenKind::Open(Bracket::Curly) if depth == 0 => break,
                TokenKind::Open(_) => depth = depth.saturating_sub(1),
                TokenKind::Symbol if depth == 0 && self.is_symbol(number, &["=", "<=", ">="]) => {
                    let word = number.checked_sub(1).and_then(|number| self.word(number));
                    return word.unwrap_or_default().to_owned();
                }
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {}
            }
        }
        String::new()
    }

    /// In a block or at the top of the file.
    fn in_entry(&self, at: usize, before: usize, depth: usize) -> Wanted {
        let Some(last) = before.checked_sub(1) else {
            return Wanted::Entry;
        };
        let Some(token) = self.all.get(last) else {
            return Wanted::Entry;
        };
        let between = self.text.get(token.end..at).unwrap_or_default();
        let is_next_line = between.contains(['\n', '\r']);
        if self.is_symbol(last, &["=", "<=", ">="]) {
            let words = self.words_before(before);
            return match words.first().map(String::as_str) {
                Some("machine") if depth == 0 => Wanted::Head(words),
                _ => Wanted::Value(self.field_before(before)),
            };
        }
        if self.is_symbol(last, &["+", "-", "*", "/", "^"]) {
            return Wanted::Value(self.field_before(before));
        }
        if token.kind == TokenKind::Number && !is_next_line {
            Wanted::Unit(self.field_before(before))
        } else if token.kind == TokenKind::Word && !is_next_line && depth == 0 {
            Wanted::Head(self.words_before(before))
        } else {
            Wanted::Entry
        }
    }
}
