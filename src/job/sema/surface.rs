//! `surface { ... }`: the part's height over x and y.
//!
//! A surface has one source: a file of triangles, of heights (`file`) or of surfaces (`step`), profiles that it is ruled
//! between (`loft`), control points (`nurbs`), or a formula (`formula`, whose values over boxes `enclosure` works out). All become triangles over the plan of the stock, which
//! are then compared with the stock (`judge`).

mod content;
mod enclosure;
pub(crate) mod file;
mod formula;
mod judge;
mod loft;
pub(crate) mod nurbs;
mod seat;
pub(crate) mod step;

use super::eval::Scope;
use super::fields::{Place, curve_words, head_span};
use super::part::Part;
use super::quantity::mm;
use super::report::{Checked, Reported, Reports};
use super::session::Session;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::profile::Profile;
use vcutc_surface::bend::Exact;
use vcutc_surface::mesh::Mesh;
use vcutc_surface::surface::{Accuracy, Placement, Plan, Surface, SurfaceError};
use vcutc_syntax::ast::{Block, Entry, Expr, HeadPart};

/// Gaps between triangles that are closed: far above what files round, far below what a blade gets into.
const WELD: Length = Length::mm(0.01);

/// What a surface is read from.
enum Source<'a> {
    File(content::Named<'a>),
    Loft(&'a Block),
    Nurbs(&'a Block),
    Formula(formula::Written<'a>),
}

impl Source<'_> {
    /// Where it is named.
    fn span(&self) -> Span {
        match self {
            Self::File(file) => file.head(),
            Self::Loft(block) | Self::Nurbs(block) => head_span(block),
            Self::Formula(formula) => formula.span,
        }
    }
}

/// The surface over the stock.
pub(crate) fn check(
    block: &Block,
    place: Place,
    stock: Checked<Spanned<Stock>>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Part> {
    let source = sort(block, place, stock, session)?;
    let stock = stock?;
    let span = source.span();
    let drawn = match source {
        Source::File(named) => return file::part(&named, stock, scope, session),
        Source::Loft(block) => loft::drawn(block, stock, scope, session)?,
        Source::Nurbs(block) => nurbs::drawn(block, stock, scope, session)?,
        Source::Formula(written) => formula::drawn(&written, stock, scope, &mut session.reports)?,
    };
    // What could not be read may belong to the surface.
    match session.damage_at(place.whole) {
        Some(reported) => Err(reported),
        None => judge::part(drawn, span, stock, &|diagnostic| diagnostic, &mut session.reports),
    }
}

/// A surface with what its triangles do not show.
struct Drawn {
    surface: Surface,
    /// The profile that it is at every y, if it is one: finer than the triangles.
    profile: Option<Profile>,
    /// Its curvature, if it has derivatives.
    exact: Option<Exact>,
}

/// The plan of a stock.
const fn plan_of(stock: Stock) -> Plan {
    Plan {
        width: stock.width,
        depth: stock.depth,
    }
}

/// The surface of a mesh that was made for a stock.
fn made(mesh: &Mesh, stock: Stock) -> Result<Surface, SurfaceError> {
    let placement = Placement {
        frame: AT_THE_CORNER,
        unit: Length::mm(1.0),
    };
    let accuracy = Accuracy {
        tolerance: Part::SURFACE_TOLERANCE,
        weld: WELD,
    };
    Surface::new(mesh, &placement, plan_of(stock), accuracy)
}

/// The surface of a mesh of a file, which what it stands for lies so near to.
fn placed(
    mesh: &Mesh,
    placement: &Placement,
    tolerance: Length,
    stock: Stock,
) -> Result<Surface, SurfaceError> {
    let accuracy = Accuracy {
        tolerance,
        weld: WELD,
    };
    Surface::new(mesh, placement, plan_of(stock), accuracy)
}

/// The frame of the workpiece itself.
const AT_THE_CORNER: Frame = Frame {
    origin: Point3::new(0.0, 0.0, 0.0),
    orientation: Orientation::IDENTITY,
};

/// The part is described twice.
pub(crate) fn beside_a_profile(surface: Place, profile: Place) -> Diagnostic {
    let (last, first) = if surface.head.start < profile.head.start {
        (profile, surface)
    } else {
        (surface, profile)
    };
    Diagnostic::new(
        Code::SurfaceAndProfile,
        "the job has a profile and a surface",
        last.head,
        "the part is described again here",
    )
    .and(first.head, "the part is described here")
    .help(
        "keep the profile for a part that is the same at every y, else the surface, and delete the other one",
    )
}

/// The one source among the entries.
fn sort<'a>(
    block: &'a Block,
    place: Place,
    stock: Checked<Spanned<Stock>>,
    session: &mut Session<'_>,
) -> Checked<Source<'a>> {
    let mut found: Option<Source<'a>> = None;
    let mut fault = None;
    for entry in &block.entries {
        let source = match source_of(entry, stock) {
            Ok(source) => source,
            Err(wrong) => {
                fault = Some(session.reports.push(*wrong));
                continue;
            }
        };
        match &found {
            None => found = Some(source),
            Some(first) => {
                let headline = "the surface has two sources";
                let diagnostic = faults::second(Code::FieldTwice, headline, source.span(), first.span());
                fault = Some(session.reports.push(diagnostic));
            }
        }
    }
    match (found, fault) {
        (_, Some(reported)) => Err(reported),
        (Some(source), None) => Ok(source),
        (None, None) => Err(match session.damage_at(place.whole) {
            Some(reported) => reported,
            None => session.reports.push(empty(place)),
        }),
    }
}

fn source_of(entry: &Entry, stock: Checked<Spanned<Stock>>) -> Result<Source<'_>, Box<Diagnostic>> {
    let wrong = match entry {
        Entry::SurfaceFile {
            kind,
            path,
            options,
            span,
        } => {
            return Ok(Source::File(content::Named {
                kind: *kind,
                path,
                options,
                span: *span,
            }));
        }
        Entry::Block(inner) if is_called(inner, "loft") => return Ok(Source::Loft(inner)),
        Entry::Block(inner) if is_called(inner, "nurbs") => return Ok(Source::Nurbs(inner)),
        Entry::Formula {
            name,
            variables,
            value,
            span,
        } => return formula_of(name, variables, value, *span),
        Entry::Block(inner) => Diagnostic::new(
            Code::UnknownBlock,
            "`surface` cannot contain a block like this",
            head_span(inner),
            "not a source of a surface",
        )
        .note(FORMS),
        Entry::Field { name, .. } | Entry::Limit { name, .. } => Diagnostic::new(
            Code::UnknownField,
            format!("`surface` has no field `{}`", name.node),
            name.span,
            "not a source of a surface",
        )
        .note(FORMS),
        Entry::Curve { curve, span } => misplaced(curve_words(curve), *span)
            .help(format!(
                "draw it in `profile {{ ... }}`, or in a profile of a `loft`: `loft {{ at 0 mm {{ ... }} at {} {{ ... }} }}`",
                stock.map_or_else(|_| "1000 mm".to_owned(), |stock| mm(stock.node.depth.to_mm()))
            )),
        Entry::Row { row, span, .. } => misplaced(&format!("`{}`", row.node.word()), *span).note(FORMS),
        Entry::ControlRow { word, .. } => misplaced("`row`", *word)
            .help("move it into a `nurbs { ... }` with the other control points"),
        Entry::Station { word, at, .. } => misplaced("`at`", word.to(at.span))
            .help("move it into a `loft { ... }` with another one"),
    };
    Err(Box::new(wrong))
}

fn is_called(block: &Block, name: &str) -> bool {
    matches!(block.head.as_slice(), [Spanned { node: HeadPart::Word(word), .. }] if word == name)
}

fn formula_of<'a>(
    name: &'a Spanned<String>,
    variables: &'a [Spanned<String>],
    value: &'a Spanned<Expr>,
    span: Span,
) -> Result<Source<'a>, Box<Diagnostic>> {
    if name.node != "z" {
        let diagnostic = Diagnostic::new(
            Code::UnknownField,
            format!("a surface gives the height `z`, not `{}`", name.node),
            name.span,
            "not what a surface gives",
        );
        return Err(Box::new(diagnostic.fix("call it `z`", name.span, "z")));
    }
    match variables {
        [x, y] if x.node == y.node => Err(Box::new(
            Diagnostic::new(
                Code::DefinedTwice,
                format!("both variables of the formula are called `{}`", y.node),
                y.span,
                "called so again here",
            )
            .and(x.span, "first called so here")
            .help("call the place across the cuts `x` and the place along them `y`"),
        )),
        [x, y] => Ok(Source::Formula(formula::Written {
            variables: [x, y],
            value,
            span,
        })),
        [x, ..] => Err(Box::new(
            Diagnostic::new(
                Code::Misplaced,
                "the height of a surface depends on x and y",
                x.span,
                "a second variable is expected after this",
            )
            .help("for a part that is the same at every y, write `profile { ... }` instead of `surface`")
            .fix("add the variable", x.span.after(), ", y"),
        )),
        [] => Err(Box::new(misplaced("a formula without variables", span))),
    }
}

const FORMS: &str = "a surface is one of mesh \"FILE\", grid \"FILE\", step \"FILE\", loft { at ... }, nurbs { row ... }, or a formula z(x, y) = ...";

fn misplaced(what: &str, span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        format!("{what} does not belong in `surface`"),
        span,
        "not a source of a surface",
    )
}

fn empty(place: Place) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        "the surface is empty",
        place.head,
        "no height is given",
    )
    .note(FORMS)
    .help("name a file, like `mesh \"fairing.stl\" { unit = mm }`")
}

/// What a surface could not be made from triangles for.
fn not_made(error: SurfaceError, span: Span) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::ImpossibleSurface,
        "the surface cannot be made over this stock",
        span,
        error.to_string(),
    );
    diagnostic.help("check the units of its numbers")
}

/// A surface that is too fine or too tangled to work with.
fn impossible(
    headline: impl Into<String>,
    span: Span,
    label: impl Into<String>,
    reports: &mut Reports,
) -> Reported {
    reports.push(
        Diagnostic::new(Code::ImpossibleSurface, headline, span, label)
            .help("check the units of its numbers, or describe the part by a mesh"),
    )
}
