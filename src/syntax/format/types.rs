//! A text as statements, before and after its words have roles.

use crate::lexical::TokenKind;

/// What a word is in its statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A name, a number, a text.
    Plain,
    /// A word that leads a piece of a profile or a part of it: `arc`, `to`, `radius`.
    Lead,
    /// The first word of a unit: `mm`, `%`.
    Unit,
    /// What goes on a unit: `/` and `s` of `mm/s`.
    UnitRest,
    /// `+`, `-`, `*`, `/` between two values.
    Operator,
    /// `^`.
    Power,
    /// `-` before a value.
    Sign,
    /// `=`, `<=`, `>=`.
    Relation,
    /// `,` in a list.
    Comma,
    /// `(` right after the name of a function.
    CallOpen,
    /// Any other `(`.
    Open,
    /// `)`.
    Close,
    /// A character that names may have but the reader of tokens does not know as one.
    Odd,
}

/// What is between a thing and the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gap {
    /// They are on one line.
    Beside,
    /// A line ends between them.
    Below,
    /// There are empty lines between them.
    Apart,
}

/// A comment, with line ends of one kind and without blanks after it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Comment {
    /// All of it, from `//` or `/*` on.
    pub(super) text: String,
    /// What is before it.
    pub(super) gap: Gap,
}

impl Comment {
    /// Whether the line must end after it.
    pub(super) fn ends_its_line(&self) -> bool {
        self.text.starts_with("//")
    }

    /// Whether it begins a line.
    pub(super) fn is_below(&self) -> bool {
        self.gap != Gap::Beside
    }
}

/// A word of a statement: a name, a number, a text or a mark.
#[derive(Clone, Debug)]
pub(super) struct Word<'t> {
    pub(super) text: &'t str,
    pub(super) kind: TokenKind,
    pub(super) role: Role,
    /// Whether it begins where the word before ends, without a comment in between.
    pub(super) touches: bool,
    /// Between the word before and this one.
    pub(super) comments: Vec<Comment>,
    pub(super) gap: Gap,
}

/// What a statement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `job "name"`, `use "file"`.
    Plain,
    /// `let name = value`.
    Let,
    /// `name = value`, `name <= value`, `name(x) = value`.
    Value,
    /// A piece of a profile.
    Curve,
    /// `head { ... }`.
    Block,
}

/// A statement, or an entry of a block.
#[derive(Clone, Debug)]
pub(super) struct Statement<'t> {
    pub(super) kind: Kind,
    /// Comments before it.
    pub(super) leading: Vec<Comment>,
    pub(super) gap: Gap,
    pub(super) words: Vec<Word<'t>>,
    pub(super) body: Option<Body<'t>>,
    /// Comments after it.
    pub(super) trailing: Vec<Comment>,
}

/// What is between braces.
#[derive(Clone, Debug)]
pub(super) struct Body<'t> {
    /// Comments before the opening brace.
    pub(super) before: Vec<Comment>,
    /// Comments on the line of the opening brace, if that line ends after them.
    pub(super) opening: Vec<Comment>,
    pub(super) statements: Vec<Statement<'t>>,
    /// Comments after the last statement that do not belong to it.
    pub(super) closing: Vec<Comment>,
    pub(super) extent: Extent,
}

/// How a block was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Both braces on one line.
    OneLine,
    /// A line or more between them.
    ManyLines,
}

#[derive(Clone, Debug)]
pub(super) struct Source<'t> {
    pub(super) statements: Vec<Statement<'t>>,
    /// Comments after the last statement.
    pub(super) closing: Vec<Comment>,
}
