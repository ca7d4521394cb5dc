//! A text as statements: each with its words, and with the comments before, in and after it.
//!
//! The tree says where statements begin and end; words and comments are the text's tokens. Commas between entries are left out,
//! since line ends do as well; what is between two statements is given to one of them. A comment on the line where a
//! statement ends belongs to that statement, every other one to what follows.

use super::spacing::roles;
use super::types::{Body, Comment, Extent, Gap, Kind, Role, Source, Statement, Word};
use crate::ast::{Ast, Curve, Entry, Item};
use crate::lexical::{Bracket, Token, TokenKind, tokens};

impl<'t> Source<'t> {
    /// The statements of a text that has this tree.
    pub(super) fn of(ast: &Ast, text: &'t str) -> Self {
        let mut reader = Reader::new(text);
        let start = reader.between();
        let (statements, closing) = reader.statements(start.all(), &ast.items, Reader::item);
        Self { statements, closing }
    }

    /// Whether both have the same statements of the same words, and the same comments in the same order.
    pub(super) fn says_the_same_as(&self, other: &Self) -> bool {
        self.said() == other.said()
    }

    fn said(&self) -> Said<'_> {
        let mut said = Said::default();
        said.statements(&self.statements);
        said.comments(&self.closing);
        said
    }
}

/// What a text says, whatever its layout.
#[derive(Debug, Default, PartialEq)]
struct Said<'s> {
    marks: Vec<Mark<'s>>,
    comments: Vec<&'s str>,
}

#[derive(Debug, PartialEq)]
enum Mark<'s> {
    Begin(Kind),
    Word(&'s str, Role),
    Open,
    Close,
}

impl<'s> Said<'s> {
    fn statements(&mut self, statements: &'s [Statement<'_>]) {
        for statement in statements {
            self.comments(&statement.leading);
            self.marks.push(Mark::Begin(statement.kind));
            self.words(&statement.words);
            if let Some(body) = &statement.body {
                self.comments(&body.before);
                self.marks.push(Mark::Open);
                self.comments(&body.opening);
                self.statements(&body.statements);
                self.comments(&body.closing);
                self.marks.push(Mark::Close);
            }
            self.comments(&statement.trailing);
        }
    }

    fn words(&mut self, words: &'s [Word<'_>]) {
        for (at, word) in words.iter().enumerate() {
            self.comments(&word.comments);
            // A comma after the last value of a list says nothing.
            let is_last = words.get(at + 1).is_some_and(|next| next.role == Role::Close);
            if !(word.role == Role::Comma && is_last) {
                self.marks.push(Mark::Word(word.text, word.role));
            }
        }
    }

    fn comments(&mut self, comments: &'s [Comment]) {
        self.comments
            .extend(comments.iter().map(|comment| comment.text.as_str()));
    }
}

/// Comments between two statements, before they are given to either.
struct Between {
    /// Each with whether a comma precedes it.
    comments: Vec<(Comment, bool)>,
    /// What is before the next word.
    gap: Gap,
}

impl Between {
    /// All of them, for what follows.
    fn all(self) -> Following {
        Following {
            comments: self.comments.into_iter().map(|(comment, _)| comment).collect(),
            gap: self.gap,
        }
    }

    /// Those that belong to what is before them, and those of what follows. Without a line end in between, those after a comma
    /// (and after a brace all) belong to what follows.
    fn split(mut self, is_ours: impl Fn(bool) -> bool) -> (Vec<Comment>, Following) {
        let on_the_line = |(comment, _): &(Comment, bool)| comment.gap == Gap::Beside;
        let count = self
            .comments
            .iter()
            .take_while(|found| on_the_line(found))
            .count();
        let line_ends = count < self.comments.len() || self.gap != Gap::Beside;
        let ours = if line_ends {
            count
        } else {
            self.comments
                .iter()
                .take_while(|(_, after_comma)| is_ours(*after_comma))
                .count()
        };
        let theirs = self.comments.split_off(ours);
        let before = self.comments.into_iter().map(|(comment, _)| comment).collect();
        let rest = Self {
            comments: theirs,
            gap: self.gap,
        };
        (before, rest.all())
    }
}

/// Comments before a statement or a closing brace, and what is between the last of them and it.
struct Following {
    comments: Vec<Comment>,
    gap: Gap,
}

/// Goes through the tokens once, led by the tree.
struct Reader<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    at: usize,
    /// Where the last token ended.
    end: usize,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str) -> Self {
        // A byte order mark is not a character of the text, but the reader of tokens takes it for one.
        let is_mark = |token: &Token| token.start == 0 && text.starts_with('\u{feff}');
        Self {
            text,
            tokens: tokens(text).skip_while(is_mark).collect(),
            at: 0,
            end: 0,
        }
    }

    fn slice(&self, start: usize, end: usize) -> &'t str {
        self.text.get(start..end).unwrap_or_default()
    }

    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    /// Takes a token. Returns it with what is before it.
    fn take(&mut self, token: Token) -> Gap {
        let gap = gap(self.slice(self.end, token.start));
        self.at += 1;
        self.end = token.end;
        gap
    }

    fn comment(&mut self, token: Token) -> Comment {
        let gap = self.take(token);
        let text = self.slice(token.start, token.end).trim_end();
        Comment {
            text: text.replace("\r\n", "\n").replace('\r', "\n"),
            gap,
        }
    }

    /// Comments and commas up to the next word.
    fn between(&mut self) -> Between {
        let mut comments = Vec::new();
        let mut after_comma = false;
        // Where the last thing that is not a comma ended.
        let mut end = self.end;
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Comment => {
                    let mut comment = self.comment(token);
                    comment.gap = gap(self.slice(end, token.start));
                    comments.push((comment, after_comma));
                    end = token.end;
                }
                TokenKind::Symbol if self.slice(token.start, token.end) == "," => {
                    self.take(token);
                    after_comma = true;
                }
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::InchMark
                | TokenKind::Open(_)
                | TokenKind::Close(_)
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => break,
            }
        }
        let gap = match self.peek() {
            Some(next) => gap(self.slice(end, next.start)),
            None => Gap::Below,
        };
        Between { comments, gap }
    }

    /// Statements one after the other, and the comments after the last one.
    fn statements<N>(
        &mut self,
        start: Following,
        nodes: &[N],
        read: fn(&mut Self, &N) -> Statement<'t>,
    ) -> (Vec<Statement<'t>>, Vec<Comment>) {
        let mut statements = Vec::with_capacity(nodes.len());
        let mut before = start;
        for node in nodes {
            let statement = read(self, node);
            let (trailing, rest) = self.between().split(|after_comma| !after_comma);
            statements.push(Statement {
                leading: before.comments,
                gap: before.gap,
                trailing,
                ..statement
            });
            before = rest;
        }
        (statements, before.comments)
    }

    fn item(&mut self, item: &Item) -> Statement<'t> {
        match item {
            Item::Job { span, .. } | Item::Use { span, .. } => self.statement(Kind::Plain, span.bytes().end),
            Item::Let { span, .. } => self.statement(Kind::Let, span.bytes().end),
            Item::Block(block) => self.block(Kind::Block, &block.entries, block.span.bytes().end),
        }
    }

    fn entry(&mut self, entry: &Entry) -> Statement<'t> {
        match entry {
            Entry::Field { span, .. } | Entry::Limit { span, .. } | Entry::Formula { span, .. } => {
                self.statement(Kind::Value, span.bytes().end)
            }
            Entry::Curve { curve, span } => match &**curve {
                Curve::Points { options, .. }
                | Curve::Airfoil { options, .. }
                | Curve::Dxf { options, .. }
                | Curve::Svg { options, .. } => self.block(Kind::Curve, options, span.bytes().end),
                Curve::Start(_)
                | Curve::Line { .. }
                | Curve::Arc { .. }
                | Curve::Bezier { .. }
                | Curve::Spline { .. }
                | Curve::Polyline { .. }
                | Curve::Open { .. }
                | Curve::Circle { .. } => self.statement(Kind::Curve, span.bytes().end),
            },
            Entry::Row { span, .. } | Entry::ControlRow { span, .. } => {
                self.statement(Kind::Curve, span.bytes().end)
            }
            Entry::SurfaceFile { options, span, .. } => self.block(Kind::Curve, options, span.bytes().end),
            Entry::Station { entries, span, .. } => self.block(Kind::Block, entries, span.bytes().end),
            Entry::Block(block) => self.block(Kind::Block, &block.entries, block.span.bytes().end),
        }
    }

    fn statement(&mut self, kind: Kind, end: usize) -> Statement<'t> {
        self.block(kind, &[], end)
    }

    /// A statement that may have a body.
    fn block(&mut self, kind: Kind, entries: &[Entry], end: usize) -> Statement<'t> {
        let mut words: Vec<Word<'t>> = Vec::new();
        let mut comments = Vec::new();
        let mut body = None;
        while let Some(token) = self.peek().filter(|token| token.start < end) {
            match token.kind {
                TokenKind::Comment => comments.push(self.comment(token)),
                TokenKind::Open(Bracket::Curly) => {
                    body = Some(self.body(std::mem::take(&mut comments), entries, token));
                }
                TokenKind::Word
                | TokenKind::Number
                | TokenKind::Text
                | TokenKind::UnclosedText
                | TokenKind::InchMark
                | TokenKind::Open(Bracket::Round)
                | TokenKind::Close(_)
                | TokenKind::UnclosedComment
                | TokenKind::Symbol => {
                    let touches = token.start == self.end && self.at > 0 && comments.is_empty();
                    let gap = self.take(token);
                    words.push(Word {
                        text: self.slice(token.start, token.end),
                        kind: token.kind,
                        role: Role::Plain,
                        touches,
                        comments: std::mem::take(&mut comments),
                        gap,
                    });
                }
            }
        }
        roles(kind, &mut words);
        Statement {
            kind,
            leading: Vec::new(),
            gap: Gap::Beside,
            words,
            body,
            trailing: Vec::new(),
        }
    }

    /// From one brace to the other.
    fn body(&mut self, before: Vec<Comment>, entries: &[Entry], brace: Token) -> Body<'t> {
        self.take(brace);
        let (opening, start) = self.between().split(|_| false);
        let (statements, closing) = self.statements(start, entries, Self::entry);
        let mut last = brace.end;
        if let Some(token) = self.peek() {
            self.take(token);
            last = token.start;
        }
        let extent = match gap_lines(self.slice(brace.end, last)) {
            0 => Extent::OneLine,
            _ => Extent::ManyLines,
        };
        Body {
            before,
            opening,
            statements,
            closing,
            extent,
        }
    }
}

fn gap(between: &str) -> Gap {
    match gap_lines(between) {
        0 => Gap::Beside,
        1 => Gap::Below,
        _ => Gap::Apart,
    }
}

/// Line ends in a text; CR LF is one.
fn gap_lines(text: &str) -> usize {
    let ends = |mark| text.matches(mark).count();
    ends("\n") + ends("\r") - ends("\r\n")
}
