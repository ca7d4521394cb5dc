//! What a statement says, word by word: a declaration, an assignment, or an instruction with its arguments.

use super::lex::{Kind, Lexer, Token};

/// Aggregates within aggregates are read so deep; those of RAPID's own data end before.
const DEEPEST: u32 = 8;

/// A value as written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    /// A name, in upper case.
    Name(String),
    /// A text, with its quotes.
    Text(String),
    /// An aggregate.
    List(Vec<Value>),
    /// An expression of any other kind.
    Other,
}

/// An optional argument, `\Name` or `\Name:=value`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Optional {
    /// Its name, in upper case.
    pub(crate) name: String,
    pub(crate) value: Option<Value>,
}

/// A statement. Names are in upper case.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sentence {
    /// Data come into being.
    Declaration {
        /// Whether other modules do not see them.
        local: bool,
        kind: String,
        name: String,
        value: Option<Value>,
    },
    /// Data get another value.
    Assignment { name: String },
    /// An instruction, or the call of a routine.
    Instruction {
        name: String,
        required: Vec<Value>,
        optional: Vec<Optional>,
    },
}

/// Reads a statement, up to and with its `;`.
///
/// # Errors
/// What was expected where it is not a statement.
pub(super) fn sentence(text: &str) -> Result<Sentence, String> {
    let mut reader = Reader {
        text,
        lexer: Lexer::new(text, 0, text.len()),
    };
    let sentence = reader.sentence()?;
    reader.sign(b';', "`;`")?;
    match reader.lexer.next() {
        None => Ok(sentence),
        Some(_) => Err("the end of the statement".to_owned()),
    }
}

struct Reader<'t> {
    text: &'t str,
    lexer: Lexer<'t>,
}

impl Reader<'_> {
    fn sentence(&mut self) -> Result<Sentence, String> {
        let mut first = self.word("an instruction or a declaration")?;
        let local = first == "LOCAL";
        let task = first == "TASK";
        if local || task {
            first = self.word("CONST, VAR or PERS")?;
        }
        match first.as_str() {
            "CONST" | "VAR" | "PERS" => self.declaration(local),
            _ if local || task => Err("CONST, VAR or PERS".to_owned()),
            _ => self.doing(first),
        }
    }

    fn declaration(&mut self, local: bool) -> Result<Sentence, String> {
        let kind = self.word("a data type")?;
        let name = self.word("a name")?;
        if self.is_sign(b'{') {
            // An array: known to be there, and nothing that a move of ours refers to.
            self.rest();
            return Ok(Sentence::Declaration {
                local,
                kind,
                name,
                value: Some(Value::Other),
            });
        }
        let value = self.becomes()?;
        Ok(Sentence::Declaration {
            local,
            kind,
            name,
            value,
        })
    }

    /// `:=` with a value, where it follows.
    fn becomes(&mut self) -> Result<Option<Value>, String> {
        let next = self.lexer.peek().map(|token| token.kind);
        if next != Some(Kind::Becomes) {
            return Ok(None);
        }
        let _ = self.lexer.next();
        self.value(0).map(Some)
    }

    fn doing(&mut self, name: String) -> Result<Sentence, String> {
        let next = self.lexer.peek().map(|token| token.kind);
        if matches!(next, Some(Kind::Sign(b'.' | b'{') | Kind::Becomes)) {
            self.rest();
            return Ok(Sentence::Assignment { name });
        }
        let (mut required, mut optional) = (Vec::new(), Vec::new());
        let mut comma = Comma::Needless;
        while !self.is_sign(b';') {
            if self.is_sign(b'\\') {
                optional.push(self.optional()?);
                comma = Comma::Needed;
                continue;
            }
            match comma {
                Comma::Needless => {}
                Comma::Needed => {
                    self.sign(b',', "`,`, `\\` or `;`")?;
                    if self.is_sign(b'\\') {
                        continue;
                    }
                }
            }
            required.push(self.value(0)?);
            comma = Comma::Needed;
        }
        Ok(Sentence::Instruction {
            name,
            required,
            optional,
        })
    }

    fn optional(&mut self) -> Result<Optional, String> {
        self.sign(b'\\', "`\\`")?;
        let name = self.word("the name of an argument")?;
        let value = self.becomes()?;
        Ok(Optional { name, value })
    }

    fn value(&mut self, depth: u32) -> Result<Value, String> {
        let before = self.lexer;
        let value = self.plain_value(depth)?;
        let goes_on = !self.lexer.peek().is_none_or(|token| ends_value(token.kind));
        if goes_on || value == Value::Other {
            self.lexer = before;
            return self.expression();
        }
        Ok(value)
    }

    fn plain_value(&mut self, depth: u32) -> Result<Value, String> {
        let Some(token) = self.lexer.peek() else {
            return Err("a value".to_owned());
        };
        match token.kind {
            Kind::Number => {
                let _ = self.lexer.next();
                self.number(token, 1.0)
            }
            Kind::Sign(sign @ (b'-' | b'+')) => {
                let _ = self.lexer.next();
                match self.lexer.peek() {
                    Some(number) if number.kind == Kind::Number => {
                        let _ = self.lexer.next();
                        self.number(number, if sign == b'-' { -1.0 } else { 1.0 })
                    }
                    Some(_) | None => Ok(Value::Other),
                }
            }
            Kind::Word => {
                let _ = self.lexer.next();
                Ok(Value::Name(token.text(self.text).to_ascii_uppercase()))
            }
            Kind::Text => {
                let _ = self.lexer.next();
                Ok(Value::Text(token.text(self.text).to_owned()))
            }
            Kind::Sign(b'[') if depth < DEEPEST => self.list(depth),
            Kind::Sign(b'[') => Err("no aggregate so deep".to_owned()),
            Kind::Becomes | Kind::Sign(_) => Ok(Value::Other),
        }
    }

    fn number(&self, token: Token, sign: f64) -> Result<Value, String> {
        let number: Option<f64> = token.text(self.text).parse().ok();
        match number.filter(|number| number.is_finite()) {
            Some(number) => Ok(Value::Number(sign * number)),
            None => Err("a number".to_owned()),
        }
    }

    fn list(&mut self, depth: u32) -> Result<Value, String> {
        self.sign(b'[', "`[`")?;
        let mut values = vec![self.value(depth + 1)?];
        while self.is_sign(b',') {
            let _ = self.lexer.next();
            values.push(self.value(depth + 1)?);
        }
        self.sign(b']', "`,` or `]`")?;
        Ok(Value::List(values))
    }

    /// Passes over an expression: everything up to what ends a value outside of brackets.
    fn expression(&mut self) -> Result<Value, String> {
        let mut open = 0_u32;
        let mut taken = 0_u32;
        while let Some(token) = self.lexer.peek() {
            match token.kind {
                Kind::Sign(b'[' | b'(' | b'{') => open += 1,
                Kind::Sign(b']' | b')' | b'}') if open > 0 => open -= 1,
                kind if open == 0 && ends_value(kind) => break,
                Kind::Sign(b';') => break,
                Kind::Word | Kind::Number | Kind::Text | Kind::Becomes | Kind::Sign(_) => {}
            }
            taken += 1;
            let _ = self.lexer.next();
        }
        if taken == 0 {
            return Err("a value".to_owned());
        }
        Ok(Value::Other)
    }

    /// Passes over everything up to the end of the statement.
    fn rest(&mut self) {
        while self
            .lexer
            .peek()
            .is_some_and(|token| token.kind != Kind::Sign(b';'))
        {
            let _ = self.lexer.next();
        }
    }

    fn is_sign(&self, sign: u8) -> bool {
        self.lexer
            .peek()
            .is_some_and(|token| token.kind == Kind::Sign(sign))
    }

    fn sign(&mut self, sign: u8, expected: &str) -> Result<(), String> {
        match self.lexer.next() {
            Some(token) if token.kind == Kind::Sign(sign) => Ok(()),
            Some(_) | None => Err(expected.to_owned()),
        }
    }

    fn word(&mut self, expected: &str) -> Result<String, String> {
        match self.lexer.next() {
            Some(token) if token.kind == Kind::Word => Ok(token.text(self.text).to_ascii_uppercase()),
            Some(_) | None => Err(expected.to_owned()),
        }
    }
}

/// Whether the next argument needs a comma before it.
#[derive(Clone, Copy)]
enum Comma {
    Needless,
    Needed,
}

/// Whether a token ends a value that stands before it.
const fn ends_value(kind: Kind) -> bool {
    matches!(kind, Kind::Sign(b',' | b';' | b'\\' | b']'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn instruction(text: &str) -> (String, Vec<Value>, Vec<Optional>) {
        match sentence(text) {
            Ok(Sentence::Instruction {
                name,
                required,
                optional,
            }) => (name, required, optional),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn arguments_are_distinguished() {
        let (name, required, optional) =
            instruction("moveL [[1,-2.5,.5],p2] , v10\\V:=3, fine \\ Inpos ,tool1\\WObj:=w1;");
        assert_eq!(name, "MOVEL");
        let number = Value::Number;
        let point = Value::List(vec![number(1.0), number(-2.5), number(0.5)]);
        let words = |word: &str| Value::Name(word.to_owned());
        assert_eq!(
            required,
            [
                Value::List(vec![point, words("P2")]),
                words("V10"),
                words("FINE"),
                words("TOOL1")
            ]
        );
        let names: Vec<&str> = optional.iter().map(|argument| argument.name.as_str()).collect();
        assert_eq!(names, ["V", "INPOS", "WOBJ"]);
    }

    #[test]
    fn expressions_are_passed_over() {
        let (_, required, _) = instruction("MoveL Offs(p1,0,0,10+x),v10,z10 + 1,t;");
        assert_eq!(required[0], Value::Other);
        assert_eq!(required[2], Value::Other);
        assert_eq!(required.len(), 4);
    }

    #[test]
    fn what_is_not_a_statement_says_what_is_missing() {
        for (text, expected) in [
            ("MoveL p1,,v10;", "a value"),
            ("MoveL p1", "`,`, `\\` or `;`"),
            ("MoveL [1,2;", "`,` or `]`"),
            ("CONST num;", "a name"),
            ("LOCAL MoveL p1;", "CONST, VAR or PERS"),
            ("MoveL \\;", "the name of an argument"),
            ("12;", "an instruction or a declaration"),
        ] {
            assert_eq!(sentence(text), Err(expected.to_owned()), "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "([a-zA-Z]|[0-9.]|[\\[\\](){},;:=+\\\\\" -])*;?") {
            let _ = sentence(&text);
        }
    }
}
