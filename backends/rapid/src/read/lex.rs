//! Words, numbers and signs of RAPID, with their places.

/// What a piece of text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or a reserved word.
    Word,
    /// A number without sign.
    Number,
    /// Text in double quotes, which may lack its end.
    Text,
    /// `:=`.
    Becomes,
    /// Any other sign, a byte each.
    Sign(u8),
}

/// A piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    /// First byte.
    pub(super) start: usize,
    /// One past the last byte.
    pub(super) end: usize,
}

impl Token {
    pub(super) fn text(self, whole: &str) -> &str {
        whole.get(self.start..self.end).unwrap_or_default()
    }

    /// Whether it is a word, whatever its case.
    pub(super) fn is_word(self, whole: &str, word: &str) -> bool {
        self.kind == Kind::Word && self.text(whole).eq_ignore_ascii_case(word)
    }
}

/// Reads token after token. Comments, from `!` to the end of a line, are passed over.
#[derive(Clone, Copy)]
pub(super) struct Lexer<'t> {
    whole: &'t str,
    at: usize,
    end: usize,
}

impl<'t> Lexer<'t> {
    /// Of a part of a text.
    pub(super) fn new(whole: &'t str, start: usize, end: usize) -> Self {
        let end = end.min(whole.len());
        Self {
            whole,
            at: start,
            end,
        }
    }

    /// The next token, without taking it.
    pub(super) fn peek(&self) -> Option<Token> {
        let mut ahead = *self;
        ahead.next()
    }

    fn byte(&self, place: usize) -> Option<u8> {
        let within = place < self.end;
        within
            .then(|| self.whole.as_bytes().get(place).copied())
            .flatten()
    }

    /// The first place from here on whose byte is not such.
    fn past(&self, mut place: usize, is: impl Fn(u8) -> bool) -> usize {
        while self.byte(place).is_some_and(&is) {
            place += 1;
        }
        place
    }

    /// The end of a number: digits, a point and more digits, an exponent.
    fn past_number(&self, start: usize) -> usize {
        let digit = |byte: u8| byte.is_ascii_digit();
        let mut end = self.past(start, digit);
        if self.byte(end) == Some(b'.') {
            end = self.past(end + 1, digit);
        }
        if self.byte(end).is_some_and(|byte| matches!(byte, b'e' | b'E')) {
            let signed =
                end + 1 + usize::from(self.byte(end + 1).is_some_and(|sign| matches!(sign, b'+' | b'-')));
            let exponent = self.past(signed, digit);
            if exponent > signed {
                end = exponent;
            }
        }
        end
    }

    /// The end of a text in quotes; a quote within it is doubled. No text goes over the end of a line.
    fn past_text(&self, start: usize) -> usize {
        let mut place = start + 1;
        loop {
            place = self.past(place, |byte| !matches!(byte, b'"' | b'\r' | b'\n'));
            match (self.byte(place), self.byte(place + 1)) {
                (Some(b'"'), Some(b'"')) => place += 2,
                (Some(b'"'), _) => return place + 1,
                (_, _) => return place,
            }
        }
    }
}

impl Iterator for Lexer<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        loop {
            self.at = self.past(self.at, |byte| byte.is_ascii_whitespace());
            if self.byte(self.at) != Some(b'!') {
                break;
            }
            self.at = self.past(self.at, |byte| byte != b'\n');
        }
        let start = self.at;
        let first = self.byte(start)?;
        let (kind, end) = match first {
            b'a'..=b'z' | b'A'..=b'Z' => {
                let end = self.past(start, |byte| byte.is_ascii_alphanumeric() || byte == b'_');
                (Kind::Word, end)
            }
            b'0'..=b'9' => (Kind::Number, self.past_number(start)),
            b'.' if self.byte(start + 1).is_some_and(|byte| byte.is_ascii_digit()) => {
                (Kind::Number, self.past_number(start))
            }
            b'"' => (Kind::Text, self.past_text(start)),
            b':' if self.byte(start + 1) == Some(b'=') => (Kind::Becomes, start + 2),
            // The bytes of a character that is not ASCII stay together, so that places lie between characters.
            other if !other.is_ascii() => (Kind::Sign(other), self.past(start + 1, |byte| !byte.is_ascii())),
            other => (Kind::Sign(other), start + 1),
        };
        self.at = end;
        Some(Token { kind, start, end })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn texts(whole: &str) -> Vec<&str> {
        Lexer::new(whole, 0, whole.len())
            .map(|token| token.text(whole))
            .collect()
    }

    #[test]
    fn signs_words_and_numbers() {
        assert_eq!(
            texts("MoveL [1.5,-.25,9E9],v10\\V:=2e+1;! end\nx:\"a\"\"b\""),
            [
                "MoveL",
                "[",
                "1.5",
                ",",
                "-",
                ".25",
                ",",
                "9E9",
                "]",
                ",",
                "v10",
                "\\",
                "V",
                ":=",
                "2e+1",
                ";",
                "x",
                ":",
                "\"a\"\"b\""
            ]
        );
    }

    proptest! {
        /// Nothing is lost but blanks and comments, and places never cut a character.
        #[test]
        fn tokens_cover_any_text(whole in any::<String>()) {
            let mut last = 0;
            for token in Lexer::new(&whole, 0, whole.len()) {
                prop_assert!(token.start >= last && token.end > token.start);
                prop_assert!(whole.get(token.start..token.end).is_some());
                let between = whole.get(last..token.start).unwrap();
                prop_assert!(between.trim_ascii().is_empty() || between.contains('!'));
                last = token.end;
            }
        }
    }
}
