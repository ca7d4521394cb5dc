//! The syntax tree: what the text says, before anybody asks what it means.
//!
//! Blocks are kept general (words, then entries), so that a new kind of block or field needs no new grammar; only the
//! profile's curves have a form of their own. Every node knows where it is.

use vcutc_diagnostics::source::{Span, Spanned};

/// One source file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ast {
    /// What is in it, in order. Text that could not be read is left out (and has been reported).
    pub items: Vec<Item>,
}

/// What can be at the top of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// `job "name"`.
    Job { name: Spanned<String>, span: Span },
    /// `use "path"`.
    Use { path: Spanned<String>, span: Span },
    /// `let name = value`.
    Let {
        name: Spanned<String>,
        value: Spanned<Expr>,
        span: Span,
    },
    /// `head { entries }`.
    Block(Block),
}

/// `head { entries }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The words before the brace: `stock`, `blade dagger`, `rough vcut`, `machine cell = robot "kuka/kr210"`.
    pub head: Vec<Spanned<HeadPart>>,
    /// What is between the braces.
    pub entries: Vec<Entry>,
    /// From the first word to the closing brace.
    pub span: Span,
}

impl Block {
    /// The words of its head as they are written, with single blanks.
    #[must_use]
    pub fn head_text(&self) -> String {
        let words = self.head.iter().map(|part| match &part.node {
            HeadPart::Word(word) => word.clone(),
            HeadPart::Text(text) => format!("\"{text}\""),
            HeadPart::Equals => "=".to_owned(),
        });
        words.collect::<Vec<_>>().join(" ")
    }
}

/// A piece of a block's head.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HeadPart {
    Word(String),
    /// A text in quotes.
    Text(String),
    /// `=`.
    Equals,
}

/// What can be in a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    /// `name = value`.
    Field {
        name: Spanned<String>,
        value: Spanned<Expr>,
        span: Span,
    },
    /// `name <= value` or `name >= value`.
    Limit {
        name: Spanned<String>,
        /// Which way it binds.
        relation: Spanned<Relation>,
        /// The bound.
        value: Spanned<Expr>,
        span: Span,
    },
    /// `z(x) = value`, `z(x, y) = value`.
    Formula {
        /// The function's name.
        name: Spanned<String>,
        /// One or two.
        variables: Vec<Spanned<String>>,
        value: Spanned<Expr>,
        span: Span,
    },
    /// A piece of a profile.
    Curve {
        /// The piece.
        curve: Box<Curve>,
        span: Span,
    },
    /// `tips (x, z) ...`, `body (height, radius) ...`.
    Row {
        /// The word that it begins with.
        row: Spanned<Row>,
        /// The points, at least one.
        points: Vec<Point>,
        span: Span,
    },
    /// `row (x, y, z) (x, y, z, weight) ...`: control points of a surface.
    ControlRow {
        /// The word that it begins with.
        word: Span,
        /// What is in each pair of brackets, at least one.
        points: Vec<Spanned<Expr>>,
        span: Span,
    },
    /// `mesh "file.stl"`, `grid "file.csv"`, `step "file.stp"`, optionally with `{ fields }`.
    SurfaceFile {
        /// What the file holds.
        kind: Spanned<SurfaceFile>,
        /// The file.
        path: Spanned<String>,
        /// Fields in braces after it.
        options: Vec<Entry>,
        span: Span,
    },
    /// `at y { pieces }`: a profile of a loft.
    Station {
        /// The word that it begins with.
        word: Span,
        /// Where it stands.
        at: Spanned<Expr>,
        /// The pieces of the profile.
        entries: Vec<Entry>,
        span: Span,
    },
    /// A block within the block.
    Block(Block),
}

/// Which way a limit binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `<=`.
    AtMost,
    /// `>=`.
    AtLeast,
}

/// What a row of points states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// `tips (x, z) ...`: where blades are to run.
    Tips,
    /// `body (height, radius) ...`: how thick a blade is above its edge.
    Body,
    /// `row (x, y, z) ...`: control points of a surface. Its entry is [`Entry::ControlRow`].
    Control,
}

impl Row {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Tips, Self::Body, Self::Control];

    /// The word that it begins with.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Tips => "tips",
            Self::Body => "body",
            Self::Control => "row",
        }
    }

    /// The row that begins with a word.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|row| row.word() == word)
    }
}

/// A file that a surface is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceFile {
    /// `mesh`: triangles.
    Mesh,
    /// `grid`: heights over places.
    Grid,
    /// `step`: B-spline surfaces.
    Step,
}

impl SurfaceFile {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mesh, Self::Grid, Self::Step];

    /// The word that it begins with.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::Grid => "grid",
            Self::Step => "step",
        }
    }

    /// The kind of file that follows a word.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.word() == word)
    }
}

/// A point as written: `(x, z)` of a profile, `(x, y)` of a region, `(height, radius)` of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What stands first.
    pub first: Spanned<Expr>,
    /// What stands second.
    pub second: Spanned<Expr>,
    /// All of it, brackets too.
    pub span: Span,
}

/// A piece of a profile or of a region. All but [`Curve::Start`] and [`Curve::Circle`] begin where the piece before ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// `start (x, z)`.
    Start(Point),
    /// `line to (x, z)`.
    Line { to: Point },
    /// `arc to (x, z) radius r`, `... center (x, z)` or `... through (x, z)`.
    Arc {
        to: Point,
        /// What else is known of it.
        by: ArcBy,
    },
    /// `bezier (x, z) ... to (x, z)`: inner control points, then the end.
    Bezier {
        /// Inner control points, any number.
        control: Vec<Point>,
        to: Point,
    },
    /// `spline (x, z) ... to (x, z)`: points it passes through, then the end.
    Spline {
        /// Points on the way.
        through: Vec<Point>,
        to: Point,
    },
    /// `polyline (x, z) ... to (x, z)`.
    Polyline {
        /// Corners on the way.
        through: Vec<Point>,
        to: Point,
    },
    /// `open to (x, y)`: a straight side of a region that has no wall.
    Open { to: Point },
    /// `circle (x, y) radius r`: a whole loop of a region.
    Circle { center: Point, radius: Spanned<Expr> },
    /// `points "file.csv"`, optionally with `{ fields }`.
    Points {
        /// The file.
        path: Spanned<String>,
        /// Fields in braces after it.
        options: Vec<Entry>,
    },
    /// `airfoil "file.dat"`, optionally with `{ fields }`.
    Airfoil {
        /// The file.
        path: Spanned<String>,
        /// Fields in braces after it.
        options: Vec<Entry>,
    },
    /// `dxf "file.dxf"`, optionally with `{ fields }`.
    Dxf {
        /// The file.
        path: Spanned<String>,
        /// Fields in braces after it.
        options: Vec<Entry>,
    },
    /// `svg "file.svg"`, optionally with `{ fields }`.
    Svg {
        /// The file.
        path: Spanned<String>,
        /// Fields in braces after it.
        options: Vec<Entry>,
    },
}

/// What determines an arc in addition to its ends.
#[derive(Clone, Debug, PartialEq)]
pub enum ArcBy {
    /// `radius r`: positive curves up over the chord (a hill), negative down (a hollow); the shorter arc.
    Radius(Spanned<Expr>),
    /// `center (x, z)`.
    Center(Point),
    /// `through (x, z)`.
    Through(Point),
}

/// A value as written.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// `4.4 mm`, `3`, `30 %`.
    Number {
        value: f64,
        /// Its unit as written, such as `mm/s`.
        unit: Option<Spanned<String>>,
    },
    /// `"text"`.
    Text(String),
    /// `width`, `orthogonal`, `auto`, `pi`.
    Name(String),
    /// `max(a, b)`, `frame(x = 0 mm, ...)`.
    Call {
        function: Spanned<String>,
        arguments: Vec<Argument>,
    },
    /// `-a`.
    Negate(Box<Spanned<Self>>),
    /// `a + b`.
    Binary {
        operator: Spanned<Operator>,
        left: Box<Spanned<Self>>,
        right: Box<Spanned<Self>>,
    },
    /// `(a, b, c)`: two or more values.
    Tuple(Vec<Spanned<Self>>),
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// `name =` before it.
    pub name: Option<Spanned<String>>,
    pub value: Spanned<Expr>,
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}
