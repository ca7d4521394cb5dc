//! A module's text in pieces: headers and ends of modules and routines, control flow, and statements up to their `;`.
//!
//! Pieces are found in one pass over the tokens and kept without them, since programs are long; a caller that
//! wants to know what a statement says reads its stretch of text again ([`super::sentence()`]).

use super::lex::{Kind, Lexer, Token};
use std::collections::BTreeSet;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PieceKind {
    /// `%%% VERSION:1 LANGUAGE:ENGLISH %%%`, the head of old files.
    OldHead,
    /// `MODULE name` with its attributes.
    Module,
    /// `ENDMODULE`.
    EndModule,
    /// `PROC name()`, `LOCAL` or not.
    Routine,
    /// The header of a function or trap.
    OtherRoutine,
    /// `ENDPROC`, `ENDFUNC`, `ENDTRAP`.
    EndRoutine,
    /// Conditions, loops, labels and handlers.
    Control,
    /// A declaration or an instruction.
    Statement,
    /// A statement without its end, or a sign that begins nothing.
    Broken,
}

/// A stretch of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    pub(super) kind: PieceKind,
    pub(super) start: u32,
    pub(super) end: u32,
}

impl Piece {
    pub(super) fn text(self, whole: &str) -> &str {
        whole
            .get(self.start as usize..self.end as usize)
            .unwrap_or_default()
    }
}

/// The pieces of a text, and the names that its moves use for tools and work objects, in upper case.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    pub(super) all: Vec<Piece>,
    pub(super) used: BTreeSet<String>,
}

/// The pieces of a text.
pub(super) fn pieces(whole: &str) -> Pieces {
    let mut cutter = Cutter {
        whole,
        lexer: Lexer::new(whole, 0, whole.len()),
        pieces: Pieces::default(),
        last: [None; 3],
    };
    while let Some(first) = cutter.take() {
        cutter.piece(first);
    }
    cutter.pieces
}

/// Words that begin or end a module or routine: no statement continues after them.
const BORDERS: [&str; 8] = [
    "MODULE",
    "ENDMODULE",
    "PROC",
    "ENDPROC",
    "FUNC",
    "ENDFUNC",
    "TRAP",
    "ENDTRAP",
];

struct Cutter<'t> {
    whole: &'t str,
    lexer: Lexer<'t>,
    pieces: Pieces,
    /// The tokens before this one, the nearest first.
    last: [Option<Token>; 3],
}

impl Cutter<'_> {
    fn take(&mut self) -> Option<Token> {
        let token = self.lexer.next()?;
        self.note(token);
        self.last = [Some(token), self.last[0], self.last[1]];
        Some(token)
    }

    /// In `tool\WObj:=frame` both names are used by a move.
    fn note(&mut self, token: Token) {
        if let [Some(option), Some(slash), Some(tool)] = self.last
            && token.kind == Kind::Becomes
            && option.is_word(self.whole, "WOBJ")
            && slash.kind == Kind::Sign(b'\\')
        {
            let frame = self.lexer.peek();
            for name in [Some(tool), frame].into_iter().flatten() {
                if name.kind == Kind::Word {
                    self.pieces
                        .used
                        .insert(name.text(self.whole).to_ascii_uppercase());
                }
            }
        }
    }

    fn is_border(&self, token: Token) -> bool {
        BORDERS.iter().any(|word| token.is_word(self.whole, word))
    }

    fn push(&mut self, kind: PieceKind, first: Token) {
        let end = self.last[0].map_or(first.end, |last| last.end);
        let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        self.pieces.all.push(Piece {
            kind,
            start: place(first.start),
            end: place(end),
        });
    }

    /// Takes tokens until one fits; whether one did before the routine, or the text, ended.
    fn until(&mut self, fits: impl Fn(Token) -> bool) -> bool {
        while let Some(next) = self.lexer.peek() {
            if self.is_border(next) {
                return false;
            }
            let _ = self.take();
            if fits(next) {
                return true;
            }
        }
        false
    }

    fn finish(&mut self, kind: PieceKind, first: Token, is_whole: bool) {
        self.push(if is_whole { kind } else { PieceKind::Broken }, first);
    }

    fn piece(&mut self, first: Token) {
        let whole = self.whole;
        let word = match first.kind {
            Kind::Word => first.text(whole).to_ascii_uppercase(),
            Kind::Sign(b'%') => return self.old_head(first),
            Kind::Number | Kind::Text | Kind::Becomes | Kind::Sign(_) => String::new(),
        };
        let is = |wanted: &'static str| move |token: Token| token.is_word(whole, wanted);
        match word.as_str() {
            "MODULE" => self.module(first),
            "ENDMODULE" => self.push(PieceKind::EndModule, first),
            "PROC" => self.header(PieceKind::Routine, first),
            "FUNC" | "TRAP" => self.header(PieceKind::OtherRoutine, first),
            "ENDPROC" | "ENDFUNC" | "ENDTRAP" => self.push(PieceKind::EndRoutine, first),
            "LOCAL" => match self.lexer.peek() {
                Some(next) if next.is_word(whole, "PROC") => {
                    let _ = self.take();
                    self.header(PieceKind::Routine, first);
                }
                Some(next) if next.is_word(whole, "FUNC") || next.is_word(whole, "TRAP") => {
                    let _ = self.take();
                    self.header(PieceKind::OtherRoutine, first);
                }
                Some(_) | None => self.statement(first),
            },
            "ELSE" | "ENDIF" | "ENDFOR" | "ENDWHILE" | "ENDTEST" | "ERROR" | "UNDO" | "BACKWARD"
            | "ENDRECORD" => {
                self.push(PieceKind::Control, first);
            }
            "IF" | "ELSEIF" => {
                let found = self.until(|token| is("THEN")(token) || token.kind == Kind::Sign(b';'));
                self.finish(PieceKind::Control, first, found);
            }
            "FOR" | "WHILE" => {
                let found = self.until(is("DO"));
                self.finish(PieceKind::Control, first, found);
            }
            "CASE" | "DEFAULT" => {
                let found = self.until(|token| token.kind == Kind::Sign(b':'));
                self.finish(PieceKind::Control, first, found);
            }
            "RECORD" => {
                let _ = self.take();
                self.push(PieceKind::Control, first);
            }
            _ => match self.lexer.peek() {
                Some(next) if next.kind == Kind::Sign(b':') => {
                    let _ = self.take();
                    self.push(PieceKind::Control, first);
                }
                Some(_) | None => self.statement(first),
            },
        }
    }

    fn statement(&mut self, first: Token) {
        let found = first.kind == Kind::Sign(b';') || self.until(|token| token.kind == Kind::Sign(b';'));
        self.finish(PieceKind::Statement, first, found);
    }

    /// `MODULE name`, and attributes in brackets.
    fn module(&mut self, first: Token) {
        let named = self
            .lexer
            .peek()
            .filter(|next| next.kind == Kind::Word && !self.is_border(*next));
        if named.is_some() {
            let _ = self.take();
        }
        let opens = self
            .lexer
            .peek()
            .is_some_and(|next| next.kind == Kind::Sign(b'('));
        let closes = !opens || self.until(|token| token.kind == Kind::Sign(b')'));
        self.finish(PieceKind::Module, first, named.is_some() && closes);
    }

    /// A routine's header, up to the bracket that ends its parameters; a trap has none.
    fn header(&mut self, kind: PieceKind, first: Token) {
        let whole = self.whole;
        let is_trap = self.last[0].is_some_and(|word| word.is_word(whole, "TRAP"));
        let found = if is_trap {
            self.until(|token| token.kind == Kind::Word)
        } else {
            self.until(|token| token.kind == Kind::Sign(b')'))
        };
        self.finish(kind, first, found);
    }

    /// Six percent signs with the version and language in between.
    fn old_head(&mut self, first: Token) {
        let mut left = 5_u32;
        while left > 0 {
            match self.lexer.peek() {
                Some(next) if !self.is_border(next) => {
                    let _ = self.take();
                    left -= u32::from(next.kind == Kind::Sign(b'%'));
                }
                Some(_) | None => break,
            }
        }
        self.finish(PieceKind::OldHead, first, left == 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_module_falls_into_pieces() {
        let text = "%%%\nVERSION:1\nLANGUAGE:ENGLISH\n%%%\nMODULE a(NOSTEPIN)\nCONST num n:=1;\nLOCAL PROC p(num x)\nIF n=1 THEN\n\
                    Stop; ENDIF\nMoveL p1,\n v1,fine,t\\WObj:=w; ! comment ;\nx: Stop\nENDPROC\nENDMODULE";
        let found = pieces(text);
        let kinds: Vec<PieceKind> = found.all.iter().map(|piece| piece.kind).collect();
        assert_eq!(
            kinds,
            [
                PieceKind::OldHead,
                PieceKind::Module,
                PieceKind::Statement,
                PieceKind::Routine,
                PieceKind::Control,
                PieceKind::Statement,
                PieceKind::Control,
                PieceKind::Statement,
                PieceKind::Control,
                PieceKind::Broken,
                PieceKind::EndRoutine,
                PieceKind::EndModule,
            ]
        );
        assert_eq!(found.all[7].text(text), "MoveL p1,\n v1,fine,t\\WObj:=w;");
        assert_eq!(found.used, ["T", "W"].map(str::to_owned).into());
    }

    proptest! {
        #[test]
        fn any_text_falls_into_pieces_in_order(
            text in "(MODULE|PROC|ENDPROC|LOCAL|IF|THEN|FOR|TRAP|x|1|[!:;()%\\\\=,\"\n]|[ä ])*"
        ) {
            let mut last = 0;
            for piece in pieces(&text).all {
                prop_assert!(piece.start >= last && piece.end > piece.start);
                prop_assert!(!piece.text(&text).is_empty());
                last = piece.end;
            }
        }
    }
}
