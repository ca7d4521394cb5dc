//! What a drawing comes to, whatever file it stood in: strokes, each with the place in the file that drew it.
//!
//! The readers of DXF and SVG turn every entity or element into [`Stroke`]s, in the file's own unit and with all its
//! transformations applied; the plane of the drawing is x to the right and z up. What they do not read they list
//! ([`Unread`]). [`outline()`] then scales the strokes to the workpiece, flattens them and joins them to one chain, and
//! [`side()`] takes the upper or the lower side of a closed one. [`loops()`] makes closed loops of lines and arcs of them.

mod affine;
mod arcs;
mod chain;
mod fault;
mod join;
mod lines;
mod loops;
mod open;
mod pairs;
mod repeats;
mod ring;
mod route;
mod shape;
mod sides;
#[cfg(test)]
mod strokes;

pub use affine::Affine;
pub(super) use affine::sincos_degrees;
pub use arcs::Bow;
pub use chain::{Outline, outline};
pub use fault::{Chain, Gap, OutlineError};
pub use loops::{LoopPiece, Loops, LoopsError, ROUND, Ring, loops};
pub use open::{OpenError, SideName, open_sides};
pub use repeats::{Overlap, drawn_over};
pub use shape::Shape;
pub use sides::{Side, SideError, side};

use super::DataError;
use core::ops::Range;
use std::collections::BTreeMap;

/// Most strokes of a drawing, whatever its blocks and references unfold to.
pub const MOST_STROKES: usize = 200_000;

/// Most kinds of things that are listed as not read, each with its reason; all others count as one.
const MOST_KINDS: usize = 40;

/// A drawing, as far as it was asked for and could be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What one unit of the file is.
    pub unit: Unit,
    /// What was drawn on the wanted layer, or on all of them, in the order of the file.
    pub strokes: Vec<Stroke>,
    /// What is not read there.
    pub unread: Vec<Unread>,
    /// All layers by name, with the number of strokes on each.
    pub layers: BTreeMap<String, usize>,
    /// What a reader made up its mind about where the file leaves a choice.
    pub remarks: Vec<Remark>,
}

/// The unit of a file's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unit {
    /// So many mm.
    Known(f64),
    /// The file does not say, or says one that is not a length.
    Unsaid(Place),
}

/// A stretch of bytes of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Place {
    pub(super) fn of(range: Range<usize>) -> Self {
        let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Self {
            start: offset(range.start),
            end: offset(range.end),
        }
    }

    pub(super) fn error(self, message: impl Into<String>) -> DataError {
        DataError {
            start: self.start,
            end: self.end,
            message: message.into(),
        }
    }
}

/// One connected line of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// What drew it, in the file's own word: `LWPOLYLINE`, `path`.
    pub kind: &'static str,
    pub place: Place,
    /// Its pieces, each beginning where the one before ended; at least one.
    pub shapes: Vec<Shape>,
}

/// Something that a reader decided, to be reported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    pub place: Place,
    /// What was decided, in one sentence without a full stop.
    pub message: String,
}

/// Things of one kind that are not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// What they are, in the file's own word.
    pub kind: String,
    /// Why they are left out.
    pub why: Why,
    pub count: usize,
    /// Where the first of them stands.
    pub first: Place,
}

/// Why something is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Why {
    /// Things of this kind are not outlines, or not outlines that are read.
    Kind,
    /// It is tilted out of the plane of the drawing.
    Tilted,
    /// It stands on a sheet of paper, not in the model.
    Paper,
    /// It is not shown.
    Hidden,
    /// It stands on a layer that is off, and no layer is named.
    Off,
    /// It stands on a layer that is frozen, or is inserted there.
    Frozen,
    /// It is a single point.
    NoExtent,
    /// It stands in another file.
    OtherFile,
    /// It hides a part of what is drawn, and that is read whole.
    NotApplied,
}

impl Why {
    /// In a few words, for a list.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Kind => "not read as outlines",
            Self::Tilted => "tilted out of the plane of the drawing",
            Self::Paper => "on a sheet of paper space",
            Self::Hidden => "hidden",
            Self::Off => "on a layer that is off",
            Self::Frozen => "on a layer that is frozen",
            Self::NoExtent => "without extent",
            Self::OtherFile => "in another file",
            Self::NotApplied => "not applied, so what it hides is read",
        }
    }
}

/// The list of what is not read, while it grows.
#[derive(Debug, Default)]
pub(super) struct UnreadList {
    found: BTreeMap<(String, Why), (usize, Place)>,
}

impl UnreadList {
    pub(super) fn add(&mut self, kind: &str, why: Why, place: Place) {
        let is_known = |(known, reason): &(String, Why)| known == kind && *reason == why;
        let name = if self.found.len() < MOST_KINDS || self.found.keys().any(is_known) {
            super::shortened(kind)
        } else {
            "others".to_owned()
        };
        self.found.entry((name, why)).or_insert((0, place)).0 += 1;
    }

    /// In the order of the file.
    pub(super) fn finish(self) -> Vec<Unread> {
        let listed = self
            .found
            .into_iter()
            .map(|((kind, why), (count, first))| Unread {
                kind,
                why,
                count,
                first,
            });
        let mut listed: Vec<Unread> = listed.collect();
        listed.sort_by_key(|unread| unread.first.start);
        listed
    }
}

#[cfg(test)]
mod tests;
