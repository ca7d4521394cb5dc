//! Tokens, as far as brackets and messages need them.
//!
//! The grammar reads characters; this reader of tokens beside it serves two things the grammar cannot do: to balance
//! brackets before parsing ([`super::brackets`]), and to name the token before and at a mistake ([`super::mistakes`]).
//! It agrees with the grammar on what a comment and a text are.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A name or keyword.
    Word,
    /// A number without its unit.
    Number,
    /// A text with both quotes.
    Text,
    /// A text that its line ends before its second quote.
    UnclosedText,
    /// A `"` after a number, which means inches and begins no text.
    InchMark,
    /// `(` or `{`.
    Open(Bracket),
    /// `)` or `}`.
    Close(Bracket),
    /// A comment of either form.
    Comment,
    /// `/*` and the rest of the file.
    UnclosedComment,
    /// Any other character; `<=`, `>=` and `==` are one symbol.
    Symbol,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bracket {
    /// `( )`
    Round,
    /// `{ }`
    Curly,
}

impl Bracket {
    /// The opening bracket.
    pub(crate) const fn opening(self) -> char {
        match self {
            Self::Round => '(',
            Self::Curly => '{',
        }
    }

    /// The closing bracket.
    pub(crate) const fn closing(self) -> char {
        match self {
            Self::Round => ')',
            Self::Curly => '}',
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub kind: TokenKind,
    /// Its first byte.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
    /// How far the first token of its line is indented, in characters.
    pub(crate) indent: usize,
    /// Number of its line, from 0.
    pub line: usize,
    /// Whether it is the first of its line.
    pub leads: bool,
}

/// The tokens of a text, comments included.
#[derive(Clone, Debug)]
pub struct Tokens<'t> {
    text: &'t str,
    at: usize,
    line: usize,
    /// Characters before the first token of this line; `None` once that is passed.
    blanks: Option<usize>,
    indent: usize,
    /// Where the token before ends, if that is a number.
    number: Option<usize>,
}

/// The tokens of `text`.
pub const fn tokens(text: &str) -> Tokens<'_> {
    Tokens {
        text,
        at: 0,
        line: 0,
        blanks: Some(0),
        indent: 0,
        number: None,
    }
}

/// Whether a name can go on with this character.
pub(crate) fn continues_name(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

impl<'t> Tokens<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Whether a quote comes next that belongs to the number before it: directly, or after blanks when nothing follows that could
    /// be a text.
    fn is_inch_mark(&self) -> bool {
        let between = self.number.and_then(|end| self.text.get(end..self.at));
        let (Some(between), Some(after)) = (between, self.rest().strip_prefix('"')) else {
            return false;
        };
        let begins_text =
            after.starts_with(|c: char| continues_name(c) || matches!(c, '.' | '/' | '\\' | '"'));
        between.is_empty() || (!between.contains(['\n', '\r']) && !begins_text)
    }

    fn skip_white_space(&mut self) {
        for c in self.rest().chars() {
            match c {
                '\n' | '\r' => {
                    self.line += usize::from(c == '\n');
                    self.blanks = Some(0);
                }
                ' ' | '\t' => self.blanks = self.blanks.map(|blanks| blanks + 1),
                _ => return,
            }
            self.at += c.len_utf8();
        }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        self.skip_white_space();
        let (kind, length) = if self.is_inch_mark() {
            (TokenKind::InchMark, 1)
        } else {
            recognise(self.rest())?
        };
        let leads = self.blanks.is_some();
        self.indent = self.blanks.take().unwrap_or(self.indent);
        let start = self.at;
        self.at += length;
        self.number = (kind == TokenKind::Number).then_some(self.at);
        let token = Token {
            kind,
            start,
            end: self.at,
            indent: self.indent,
            line: self.line,
            leads,
        };
        // Only comments can hold line ends.
        if matches!(kind, TokenKind::Comment) {
            let body = self.text.get(start..self.at).unwrap_or_default();
            self.line += body.matches('\n').count();
        }
        Some(token)
    }
}

/// The token at the start of `rest` and its length in bytes.
fn recognise(rest: &str) -> Option<(TokenKind, usize)> {
    let first = rest.chars().next()?;
    let run = |part: fn(char) -> bool| rest.find(|c| !part(c)).unwrap_or(rest.len());
    Some(match first {
        '(' => (TokenKind::Open(Bracket::Round), 1),
        ')' => (TokenKind::Close(Bracket::Round), 1),
        '{' => (TokenKind::Open(Bracket::Curly), 1),
        '}' => (TokenKind::Close(Bracket::Curly), 1),
        '"' => text_in_quotes(rest),
        '/' if rest.starts_with("//") => (TokenKind::Comment, run(|c| c != '\n' && c != '\r')),
        '/' if rest.starts_with("/*") => match rest.get(2..).and_then(|body| body.find("*/")) {
            Some(length) => (TokenKind::Comment, length + 4),
            None => (TokenKind::UnclosedComment, rest.len()),
        },
        '0'..='9' => (TokenKind::Number, number(rest)),
        c if continues_name(c) => (TokenKind::Word, run(continues_name)),
        '<' | '>' | '=' if rest.as_bytes().get(1) == Some(&b'=') => (TokenKind::Symbol, 2),
        c => (TokenKind::Symbol, c.len_utf8()),
    })
}

/// A text up to its second quote. If there is none it ends with the line, but brackets and commas at the end of the
/// line are more likely the job's than the text's.
fn text_in_quotes(rest: &str) -> (TokenKind, usize) {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            '\n' | '\r' => return (TokenKind::UnclosedText, unclosed_text(rest.get(..at))),
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return (TokenKind::Text, at + 1),
            _ => {}
        }
    }
    (TokenKind::UnclosedText, unclosed_text(Some(rest)))
}

/// Length of a text without its second quote.
fn unclosed_text(line: Option<&str>) -> usize {
    let line = line.unwrap_or_default();
    line.trim_end_matches([' ', '\t', ',', ')', '}']).len().max(1)
}

/// Length of a decimal number.
fn number(rest: &str) -> usize {
    let digits = |from: usize| {
        let tail = rest.get(from..).unwrap_or_default();
        from + tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len())
    };
    let whole = digits(0);
    let fraction = match rest.as_bytes().get(whole) {
        Some(b'.') => digits(whole + 1),
        _ => whole,
    };
    // A point without digits after it is not part of the number.
    let mantissa = if fraction > whole + 1 { fraction } else { whole };
    let sign = match rest.as_bytes().get(mantissa..).unwrap_or_default() {
        [b'e' | b'E', b'+' | b'-', ..] => 2,
        [b'e' | b'E', ..] => 1,
        _ => return mantissa,
    };
    let exponent = digits(mantissa + sign);
    if exponent > mantissa + sign {
        exponent
    } else {
        mantissa
    }
}
