//! What can be wrong with the drawing of a region.

use crate::sema::fields::{Place as BlockPlace, curve_words, head_span};
use crate::sema::quantity::mm;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_region::place::Place;
use vcutc_syntax::ast::{Curve, Entry};

const FORMS: &str = "a region contains start, line, arc, polyline, open, circle, and blocks `island { ... }`; or one \
                     drawing, dxf or svg";

/// Where an entry is written.
pub(super) fn place_of(entry: &Entry) -> Span {
    match entry {
        Entry::Field { name, .. } | Entry::Limit { name, .. } => name.span,
        Entry::Block(inner) => head_span(inner),
        Entry::ControlRow { word, .. } => *word,
        Entry::Formula { span, .. }
        | Entry::Curve { span, .. }
        | Entry::Row { span, .. }
        | Entry::SurfaceFile { span, .. }
        | Entry::Station { span, .. } => *span,
    }
}

/// An entry that is not a piece of a region.
pub(super) fn misplaced(entry: &Entry) -> Diagnostic {
    let (what, span) = match entry {
        Entry::Field { name, .. } | Entry::Limit { name, .. } => {
            return Diagnostic::new(
                Code::UnknownField,
                format!("`region` has no field `{}`", name.node),
                name.span,
                "not a piece of a region",
            )
            .note(FORMS);
        }
        Entry::Block(inner) => {
            return Diagnostic::new(
                Code::UnknownBlock,
                format!("`region` has no block `{}`", inner.head_text()),
                head_span(inner),
                "not a piece of a region",
            )
            .note(FORMS);
        }
        Entry::Formula { span, .. } => ("a formula", *span),
        Entry::Curve { curve, span } => (curve_words(curve), *span),
        Entry::Row { row, span, .. } => (row.node.word(), *span),
        Entry::ControlRow { word, .. } => ("`row`", *word),
        Entry::SurfaceFile { kind, span, .. } => (kind.node.word(), *span),
        Entry::Station { span, .. } => ("`at`", *span),
    };
    Diagnostic::new(
        Code::Misplaced,
        format!("{what} does not belong in `region`"),
        span,
        "describes the part's height, not an area of the plan",
    )
    .note(FORMS)
}

/// A curve that a profile has and a region has not.
pub(super) fn of_a_profile(curve: &Curve, span: Span) -> Diagnostic {
    let words = curve_words(curve);
    Diagnostic::new(
        Code::Misplaced,
        format!("{words} does not belong in `region`"),
        span,
        "not a line or an arc",
    )
    .note(FORMS)
    .help("draw this side with `arc` and `line`")
}

/// Something stands beside a drawing.
pub(super) fn beside_a_drawing(drawing: Span, other: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        "a drawing is the whole region",
        other,
        "cannot be joined to it",
    )
    .and(drawing, "the drawing")
    .help("draw this on the layer of the drawing, or as a region of its own")
}

/// A drawing within an island.
pub(super) fn in_an_island(curve: &Curve, span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        format!("{} does not belong in `island`", curve_words(curve)),
        span,
        "brings the islands of its region with it",
    )
    .help("let the drawing be the whole region, with its islands on the same layer")
}

pub(super) fn empty(place: BlockPlace) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        "the loop is empty",
        place.head,
        "no side is drawn",
    )
    .note(FORMS)
    .help("start with a point and a line, like `start (10 mm, 10 mm) line to (60 mm, 10 mm) line to (60 mm, 40 mm)`")
}

pub(super) fn second_start(span: Span, first: Span) -> Diagnostic {
    Diagnostic::new(
        Code::FieldTwice,
        "the loop starts twice",
        span,
        "starts again here",
    )
    .and(first, "starts here")
    .help("draw a second loop in a block `island { ... }`, or as a region of its own")
}

pub(super) fn beside_a_circle(span: Span, first: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Misplaced,
        "a circle is a whole loop",
        span,
        "cannot be joined to another piece",
    )
    .and(first, "the loop begins here")
    .help("keep either the circle or the other pieces")
}

pub(super) fn without_start(curve: &Curve, span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        format!("{} has no point to begin at", curve_words(curve)),
        span,
        "nothing is drawn before this",
    )
    .help("begin the loop with a point, like `start (10 mm, 10 mm)`")
}

pub(super) fn no_radius(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        "the radius of a circle must be positive",
        span,
        "not positive",
    )
    .help("use a radius such as `10 mm`")
}

pub(super) fn of_no_length(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::ImpossibleCurve,
        "the piece ends where it begins",
        span,
        "the same point as the one before",
    )
    .help("delete it")
}

/// Two sides meet where they must not.
pub(super) fn meeting([one, other]: [Span; 2], at: Place, how: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::RegionTangled,
        format!("two sides of the region {how} at ({}, {})", mm(at.x), mm(at.y)),
        other,
        "meets another side",
    );
    let diagnostic = if one == other {
        diagnostic
    } else {
        diagnostic.and(one, "meets it")
    };
    diagnostic.help("draw the loops so that they touch in points at most; an island lies within its outline")
}

/// A loop that encloses nothing.
pub(super) fn flat(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::RegionTangled,
        "the loop encloses no area",
        span,
        "nothing to clear within it",
    )
    .help("a loop needs three corners, or an arc")
}

/// An arc or a point beyond all bounds.
pub(super) fn unsound(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        "the region goes beyond 1 km",
        span,
        "beyond what is looked at",
    )
    .help("check the units of its coordinates")
}

pub(super) fn too_many(span: Span, edges: usize, most: usize) -> Diagnostic {
    Diagnostic::new(
        Code::RegionTangled,
        format!("the region has {edges} sides; at most {most} are looked at"),
        span,
        "too many sides",
    )
    .help("draw curves as arcs, or as fewer lines")
}

pub(super) fn dense(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::RegionTangled,
        "sides of the region lie too close beside each other to be compared one by one",
        span,
        "too many sides in one place",
    )
    .help("delete sides that are drawn several times")
}

/// An invalid island.
pub(super) fn island_elsewhere(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::RegionTangled,
        "an island does not lie within the outline, or lies in another island",
        span,
        "nothing of the region is around it alone",
    )
    .help("move it into the outline, or draw what it encloses as a region of its own")
}
