//! The tokens around a cursor: which brackets are open, whose they are, and what they already contain.

use vcutc_job::sema::vocabulary;
use vcutc_syntax::ast::{Row, SurfaceFile};
use vcutc_syntax::lexical::{Bracket, Token, TokenKind};

/// A block around the cursor. The brackets of a profile in its short form count as two: `profile`, and in that the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct BlockAround {
    /// The words of its head.
    pub(super) head: Vec<String>,
    /// What it already contains, on both sides of the cursor: the first words of its entries.
    pub(super) entries: Vec<String>,
}

impl BlockAround {
    /// The first word of the head, of inner blocks the last one before the brace.
    pub(super) fn name(&self) -> &str {
        self.head.first().map_or("", String::as_str)
    }

    /// All words of the head.
    pub(super) fn words(&self) -> Vec<&str> {
        self.head.iter().map(String::as_str).collect()
    }

    /// The second word of the head.
    pub(super) fn second(&self) -> Option<&str> {
        self.head.get(1).map(String::as_str)
    }
}

/// A text as its tokens, comments left out. Tokens are known by their numbers.
pub(super) struct Surroundings<'t> {
    pub(super) text: &'t str,
    pub(super) all: &'t [Token],
}

impl Surroundings<'_> {
    /// The token in which, or at the end of which, a byte is.
    pub(super) fn token_at(&self, offset: usize) -> Option<(usize, Token)> {
        let number = self.all.partition_point(|token| token.end < offset);
        let token = *self.all.get(number)?;
        let is_in = token.start < offset && offset <= token.end;
        // An own end closes a text or a bracketed comment: after it, one is out.
        let is_after = offset == token.end
            && (token.kind == TokenKind::Text
                || token.kind == TokenKind::Comment && self.slice(token).ends_with("*/"));
        (is_in && !is_after).then_some((number, token))
    }

    fn slice(&self, token: Token) -> &str {
        self.text.get(token.start..token.end).unwrap_or_default()
    }

    fn kind(&self, number: usize) -> Option<TokenKind> {
        self.all.get(number).map(|token| token.kind)
    }

    pub(super) fn is_symbol(&self, number: usize, symbols: &[&str]) -> bool {
        let token = self.all.get(number).copied();
        token.is_some_and(|token| token.kind == TokenKind::Symbol && symbols.contains(&self.slice(token)))
    }

    pub(super) fn is_number(&self, number: usize) -> bool {
        self.kind(number) == Some(TokenKind::Number)
    }

    pub(super) fn is_word(&self, number: usize) -> bool {
        self.kind(number) == Some(TokenKind::Word)
    }

    pub(super) fn word(&self, number: usize) -> Option<&str> {
        let token = *self.all.get(number)?;
        (token.kind == TokenKind::Word).then(|| self.slice(token))
    }

    pub(super) fn opens(&self, number: usize, bracket: Bracket) -> bool {
        self.kind(number) == Some(TokenKind::Open(bracket))
    }

    pub(super) fn closes(&self, number: usize) -> bool {
        matches!(self.kind(number), Some(TokenKind::Close(_)))
    }

    /// Whether a byte is on a later line than a token.
    pub(super) fn is_next_line(&self, number: usize, at: usize) -> bool {
        let end = self.all.get(number).map_or(at, |token| token.end);
        let between = self.text.get(end..at).unwrap_or_default();
        between.contains(['\n', '\r'])
    }

    /// Words, equals signs and texts of a line up to a token, from the front.
    pub(super) fn words_before(&self, number: usize) -> Vec<String> {
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

    /// The brackets that are open before a token, the innermost last.
    pub(super) fn open_at(&self, before: usize) -> Vec<usize> {
        let mut open: Vec<usize> = Vec::new();
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
                | TokenKind::InchMark
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {}
            }
        }
        open
    }

    /// Whether a bracket is that of a profile in its short form: `profile = dxf(`.
    pub(super) fn is_short_form(&self, bracket: usize) -> bool {
        let word = |back: usize| bracket.checked_sub(back).and_then(|number| self.word(number));
        self.opens(bracket, Bracket::Round)
            && word(1).is_some_and(|file| vocabulary::data_file(file).is_some())
            && bracket >= 2
            && self.is_symbol(bracket - 2, &["="])
            && word(3) == Some("profile")
    }

    /// Whether entries follow a bracket.
    fn holds_entries(&self, bracket: usize) -> bool {
        self.opens(bracket, Bracket::Curly) || self.is_short_form(bracket)
    }

    /// The blocks around a place before a token, from the outermost.
    pub(super) fn blocks(&self, before: usize) -> Vec<BlockAround> {
        let mut blocks: Vec<BlockAround> = Vec::new();
        for bracket in self.open_at(before) {
            if self.is_short_form(bracket) {
                let file = self.word(bracket.saturating_sub(1)).unwrap_or_default();
                blocks.push(BlockAround {
                    head: vec!["profile".to_owned()],
                    entries: vec![file.to_owned()],
                });
                blocks.push(BlockAround {
                    head: vec![file.to_owned()],
                    entries: self.entries(bracket),
                });
            } else if self.opens(bracket, Bracket::Curly) {
                blocks.push(BlockAround {
                    head: self.head(bracket, blocks.len()),
                    entries: self.entries(bracket),
                });
            }
        }
        blocks
    }

    /// The words of the head before a brace. Of an inner block only the last one: what is before may be a field.
    fn head(&self, brace: usize, depth: usize) -> Vec<String> {
        if depth > 0 {
            let last = brace.saturating_sub(1);
            // `points "file" { ... }`
            let is_text = self.kind(last) == Some(TokenKind::Text);
            let number = last.saturating_sub(usize::from(is_text));
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
        let words = tokens.get(start + usize::from(is_before)..).unwrap_or_default();
        words.iter().map(|token| self.slice(*token).to_owned()).collect()
    }

    /// The first words of the entries between a bracket and its partner.
    fn entries(&self, bracket: usize) -> Vec<String> {
        let is_entry = |number: usize| {
            self.is_symbol(number + 1, &["=", "<=", ">="])
                || self.opens(number + 1, Bracket::Curly)
                || self.word(number).and_then(Row::named).is_some() && self.opens(number + 1, Bracket::Round)
        };
        self.words_in(bracket, is_entry)
    }

    /// The labels of a call.
    pub(super) fn labels(&self, bracket: usize) -> Vec<String> {
        self.words_in(bracket, |number| self.is_symbol(number + 1, &["="]))
    }

    /// The words directly between a bracket and its partner of which something holds.
    fn words_in(&self, bracket: usize, is_wanted: impl Fn(usize) -> bool) -> Vec<String> {
        let (within, _) = self.within(bracket);
        within
            .into_iter()
            .filter(|&number| is_wanted(number))
            .filter_map(|number| self.word(number).map(str::to_owned))
            .collect()
    }

    /// The partner of an open bracket; none if it is not closed.
    pub(super) fn partner(&self, bracket: usize) -> Option<usize> {
        self.within(bracket).1
    }

    /// The tokens directly in a bracket, and its partner if it is closed.
    fn within(&self, bracket: usize) -> (Vec<usize>, Option<usize>) {
        let mut depth = 0_usize;
        let mut within = Vec::new();
        for (number, token) in self.all.iter().enumerate().skip(bracket + 1) {
            match token.kind {
                TokenKind::Open(_) => depth += 1,
                TokenKind::Close(_) if depth == 0 => return (within, Some(number)),
                TokenKind::Close(_) => depth -= 1,
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::InchMark
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {
                    if depth == 0 {
                        within.push(number);
                    }
                }
            }
        }
        (within, None)
    }

    /// The tokens before a place, backwards, up to the bracket around it; what is in brackets of its own is passed over.
    pub(super) fn back_from(&self, before: usize) -> impl Iterator<Item = usize> {
        let mut depth = 0_usize;
        let numbers = (0..before)
            .rev()
            .take_while(move |&number| match self.kind(number) {
                Some(TokenKind::Close(_)) => {
                    depth += 1;
                    true
                }
                Some(TokenKind::Open(_)) => {
                    let is_own = depth > 0;
                    depth = depth.saturating_sub(1);
                    is_own
                }
                Some(_) | None => true,
            });
        let mut inside = 0_usize;
        numbers.filter(move |&number| {
            match self.kind(number) {
                Some(TokenKind::Close(_)) => inside += 1,
                Some(TokenKind::Open(_)) => {
                    inside = inside.saturating_sub(1);
                    return false;
                }
                Some(_) | None => {}
            }
            inside == 0
        })
    }

    /// The piece of a profile, or the row of points, that a place before a token belongs to: its first word, and the words that
    /// join its parts.
    pub(super) fn piece_before(&self, before: usize) -> Option<(String, Vec<String>)> {
        let mut given = Vec::new();
        for number in self.back_from(before) {
            if self.is_symbol(number, &["=", "<=", ">=", ","]) {
                return None;
            }
            let Some(word) = self.word(number) else { continue };
            let is_file = SurfaceFile::named(word).is_some();
            if vocabulary::begins_a_piece(word) || Row::named(word).is_some() || is_file {
                given.reverse();
                return Some((word.to_owned(), given));
            }
            if vocabulary::JOINTS_OF_CURVES.contains(&word) {
                given.push(word.to_owned());
            }
        }
        None
    }

    /// Whether a bracket and what belongs before it hold entries or a value.
    pub(super) fn value_brackets(&self, before: usize) -> Vec<usize> {
        let open = self.open_at(before);
        let start = open
            .iter()
            .rposition(|&bracket| self.holds_entries(bracket))
            .map_or(0, |last| last + 1);
        open.get(start..).unwrap_or_default().to_vec()
    }
}
