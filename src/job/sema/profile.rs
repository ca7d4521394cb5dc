//! `profile { ... }`: the part's height over x.
//!
//! The pieces become a [`Part`], which keeps them as they are. To check it they are tessellated into one polyline, the
//! [`Trace`], in which every point knows the piece it came from. The trace is cut to the stock and checked by the rules of a
//! profile ([`shape`]); a breach is shown at the piece that causes it.

mod curves;
pub(crate) mod data;
pub(crate) mod drawing;
mod formula;
mod repairs;
pub(crate) mod shape;

pub(crate) use curves::impossible;

use super::eval::Scope;
use super::fields::{Place, curve_words, head_span};
use super::part::{self, Part};
use super::report::Checked;
use super::session::Session;
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_syntax::ast::{Block, Curve, Entry, Expr, Row};

/// The polyline of a profile as it is drawn, with where its points come from.
#[derive(Debug, Default)]
pub(crate) struct Trace {
    points: Vec<Point2>,
    /// For each point the piece that leads to it, as a place in `pieces`.
    owners: Vec<usize>,
    pieces: Vec<Origin>,
    /// What was drawn, before it was tessellated.
    drawn: Vec<part::Piece>,
}

/// Where a piece comes from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    /// The piece in the job.
    span: Span,
    /// What drew it in a drawing that the job names.
    drawn: Option<Span>,
}

impl Trace {
    /// Starts a new piece.
    fn begin(&mut self, span: Span) {
        self.pieces.push(Origin { span, drawn: None });
    }

    /// Starts a new piece that something in a drawing drew.
    fn begin_drawn(&mut self, span: Span, drawn: Span) {
        self.pieces.push(Origin {
            span,
            drawn: Some(drawn),
        });
    }

    /// Adds points of the piece begun last.
    fn extend(&mut self, points: Vec<Point2>) {
        let owner = self.pieces.len().saturating_sub(1);
        self.owners
            .resize(self.points.len().saturating_add(points.len()), owner);
        self.points.extend(points);
    }

    /// Adds a piece of points.
    fn extend_by(&mut self, points: Vec<Point2>) {
        self.drawn.push(part::Piece::Points(points.clone()));
        self.extend(points);
    }

    /// The piece that leads to a point, or the last of them.
    fn piece_at(&self, point: usize) -> Option<Span> {
        Some(self.origin_at(point)?.span)
    }

    /// What drew the way to a point, if it stands in a drawing.
    fn drawn_at(&self, point: usize) -> Option<Span> {
        self.origin_at(point)?.drawn
    }

    fn origin_at(&self, point: usize) -> Option<Origin> {
        let owner = self.owners.get(point).or_else(|| self.owners.last())?;
        self.pieces.get(*owner).copied()
    }
}

/// A profile's formula.
struct Formula<'a> {
    name: &'a Spanned<String>,
    variable: &'a Spanned<String>,
    value: &'a Spanned<Expr>,
    span: Span,
}

/// A profile's piece.
struct Piece<'a> {
    curve: &'a Curve,
    span: Span,
}

/// What a profile is made of.
enum Content<'a> {
    Formula(Formula<'a>),
    Pieces(Vec<Piece<'a>>),
}

/// The profile across the stock. A profile without a stock is still checked in itself.
pub(crate) fn check(
    block: &Block,
    place: Place,
    stock: Checked<Spanned<Stock>>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Part> {
    let trace = trace(&block.entries, place, stock, scope, session)?;
    // A piece that could not be read is not a gap in the profile.
    match session.damage_at(place.whole) {
        Some(reported) => Err(reported),
        None => {
            let stock = stock?;
            shape::check(&trace, stock, &mut session.reports)?;
            Ok(Part::new(trace.drawn, stock.node.width.to_mm()))
        }
    }
}

/// One of the profiles that a surface is ruled between: all that is drawn, also beyond the sides of the stock.
pub(crate) fn whole(
    entries: &[Entry],
    place: Place,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Profile> {
    let trace = trace(entries, place, Ok(stock), scope, session)?;
    shape::whole(&trace, place, &mut session.reports)
}

fn trace(
    entries: &[Entry],
    place: Place,
    stock: Checked<Spanned<Stock>>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Trace> {
    match sort(entries, place, session)? {
        Content::Formula(formula) => {
            formula::check_name(&formula, &mut session.reports)?;
            formula::trace(&formula, stock?, scope, &mut session.reports)
        }
        Content::Pieces(pieces) => curves::trace(&pieces, scope, session),
    }
}

/// Sorts the entries: either one formula or a chain of pieces.
fn sort<'a>(entries: &'a [Entry], place: Place, session: &mut Session<'_>) -> Checked<Content<'a>> {
    let mut formula: Option<Formula<'a>> = None;
    let mut pieces = Vec::new();
    let mut fault = None;
    for entry in entries {
        let found = match entry {
            Entry::Curve { curve, span } => {
                pieces.push(Piece { curve, span: *span });
                continue;
            }
            Entry::Formula {
                name,
                variables,
                value,
                span,
            } => match (&formula, variables.as_slice()) {
                (None, [variable]) => {
                    formula = Some(Formula {
                        name,
                        variable,
                        value,
                        span: *span,
                    });
                    continue;
                }
                (Some(first), [_]) => {
                    let headline = "the profile has two formulas";
                    faults::second(Code::FieldTwice, headline, *span, first.span)
                }

                (_, several) => of_several(several, *span),
            },
            Entry::SurfaceFile { kind, span, .. } => no_surface(kind.node.word(), *span),
            Entry::Station { word, at, .. } => no_surface("at", word.to(at.span)),
            Entry::Field { name, .. } => no_field(name),
            Entry::Limit { name, .. } => no_field(name),
            Entry::Row { row, span, .. } => no_row(row.node, *span),
            Entry::ControlRow { word, .. } => no_row(Row::Control, *word),
            Entry::Block(inner) => no_block(inner),
        };
        fault = Some(session.reports.push(found));
    }
    match (formula, pieces.as_slice(), fault) {
        (Some(formula), [piece, ..], _) => Err(session.reports.push(mixed(piece, &formula))),
        (_, _, Some(reported)) => Err(reported),
        (Some(formula), [], None) => Ok(Content::Formula(formula)),
        (None, [], None) => Err(match session.damage_at(place.whole) {
            Some(reported) => reported,
            None => session.reports.push(empty(place)),
        }),
        (None, [_, ..], None) => Ok(Content::Pieces(pieces)),
    }
}

fn no_row(row: Row, span: Span) -> Diagnostic {
    let (label, block) = match row {
        Row::Tips => (
            "says where the blade runs, not what the part looks like",
            "`rough vcut { ... }`",
        ),
        Row::Body => (
            "says how thick a blade is, not what the part looks like",
            "`blade`",
        ),
        Row::Control => ("holds control points of a surface", "`nurbs { ... }`"),
    };
    Diagnostic::new(
        Code::Misplaced,
        format!("`{}` does not belong in `profile`", row.word()),
        span,
        label,
    )
    .help(format!(
        "move it into the {block} block; a profile through points is a `polyline`"
    ))
}

/// A formula of x and y.
fn of_several(variables: &[Spanned<String>], span: Span) -> Diagnostic {
    let place = match variables {
        [first, .., last] => first.span.to(last.span),
        _ => span,
    };
    Diagnostic::new(
        Code::Misplaced,
        "the height of a profile depends on x alone",
        place,
        "one variable is expected here",
    )
    .help("for a part that changes along y, write `surface { z(x, y) = ... }` instead of `profile`")
}

fn no_surface(word: &str, span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        format!("`{word}` does not belong in `profile`"),
        span,
        "describes a part that changes along y",
    )
    .help("write `surface { ... }` instead of `profile`")
}

const FORMS: &str = "a profile contains start, line, arc, bezier, spline, polyline, points, airfoil, dxf, svg, or a \
                     formula z(x) = ...";

fn no_field(name: &Spanned<String>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownField,
        format!("`profile` has no field `{}`", name.node),
        name.span,
        "not a piece of a profile",
    );
    let diagnostic = if name.node == "z" {
        diagnostic.fix("make it a formula", name.span, "z(x)")
    } else {
        diagnostic
    };
    diagnostic.note(FORMS)
}

fn no_block(inner: &Block) -> Diagnostic {
    Diagnostic::new(
        Code::UnknownBlock,
        "`profile` cannot contain a block like this",
        head_span(inner),
        "not a piece of a profile",
    )
    .note(FORMS)
}

fn mixed(piece: &Piece<'_>, formula: &Formula<'_>) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        "a formula is the whole profile",
        piece.span,
        format!("{} cannot be joined to it", curve_words(piece.curve)),
    )
    .and(formula.span, "the formula")
    .help("keep either the formula or the curves")
}

fn empty(place: Place) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        "the profile is empty",
        place.head,
        "no height is given",
    )
    .note(FORMS)
    .help("start with a point and a line, like `start (0 mm, 18 mm) line to (85 mm, 14 mm)`")
}
