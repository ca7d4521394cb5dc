//! Why there is no plan, with the numbers to say it by.

use super::blades::WidthBound;
use vcutc_backend_api::units::{Angle, Duration, Length};

/// Why rectangular roughing is not planned.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Nothing of the stock is to be cut.
    Nothing,
    /// The edge of the straight blade does not lead into the material: half its apex angle is no less than its rake.
    NoEdge { rake: Angle, half_apex: Angle },
    /// More strips than may be planned.
    TooMany {
        /// How many there would be, more or less.
        strips: f64,
    },
    /// Strips are wider than the disc frees.
    TooWide {
        /// The widest strip.
        widest: Length,
        /// The widest that the disc frees; at most zero where its body leaves no room at all.
        limit: Length,
        bound: WidthBound,
    },
    /// Slits through so many layers are deeper than the edge of the straight blade.
    TooDeepForSlits {
        layer: Length,
        through: u32,
        /// The edge that the deepest slit needs.
        needed: Length,
        /// The edge that it may use.
        edge: Length,
        /// The thickest layer that both blades take.
        most: Length,
    },
    /// A slit runs down beside a wall that is higher than the edge of the straight blade covers.
    TooHighForSlit {
        x: Length,
        bottom: Length,
        /// The higher one of the surfaces beside it.
        top: Length,
        /// The edge that it needs.
        needed: Length,
        /// The edge that it may use.
        edge: Length,
    },
    /// Chips are thicker than the disc takes.
    TooThick {
        layer: Length,
        /// The thickest chip, with what the lead adds.
        chip: Length,
        /// The thickest that the disc takes.
        depth: Length,
    },
    /// A slit would enter the part.
    SlitInPart {
        x: Length,
        bottom: Length,
        /// How far the part reaches above its bottom.
        entry: Length,
    },
    /// Strips that no disc gets at: material stands on both sides of them.
    Closed(Closed),
    /// Slits through several layers need columns that stay where they are, which this strategy does not have.
    NoColumns { through: u32 },
    /// More stays on the part than may.
    Scallop {
        left: Length,
        limit: Length,
        /// How many strips are left out because the body of the straight blade has no room beside them.
        left_out: usize,
        /// A limit that a plan keeps, tried.
        works: Option<Length>,
    },
    /// There is a plan, but one that breaks a limit on the whole.
    Over(Over),
    /// No layer or step within the bounds: the least that the job allows is more than blades or bounds do.
    Bounds {
        field: SizeField,
        least: Length,
        most: Length,
    },
}

impl Refusal {
    /// Of two plans that break the same limit, what is said of the one that breaks it less; else of the first.
    pub(crate) fn or_less(self, other: Self) -> Self {
        let is_less = match (&self, &other) {
            (Self::Scallop { left, .. }, Self::Scallop { left: less, .. }) => less < left,
            (Self::Over(over), Self::Over(other)) => other.is_less_than(over),
            _ => false,
        };
        if is_less { other } else { self }
    }

    /// Whether there is a plan, but one that is too long: other ones may be shorter.
    pub(crate) const fn is_about_the_whole(&self) -> bool {
        match self {
            Self::Over(_) => true,
            Self::Nothing
            | Self::NoEdge { .. }
            | Self::TooMany { .. }
            | Self::TooWide { .. }
            | Self::TooDeepForSlits { .. }
            | Self::TooHighForSlit { .. }
            | Self::TooThick { .. }
            | Self::SlitInPart { .. }
            | Self::Closed(_)
            | Self::NoColumns { .. }
            | Self::Scallop { .. }
            | Self::Bounds { .. } => false,
        }
    }
}

/// A limit on the whole that a plan breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Over {
    /// On changes of blade.
    Changes(Exceeded<u32>),
    /// On slits and strips together.
    Cuts(Exceeded<usize>),
    /// On the time by the model.
    Time(Exceeded<Duration>),
}

/// A limit, and what is above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exceeded<T> {
    pub found: T,
    pub limit: T,
    /// A limit with which there is a plan, tried.
    pub works: Option<T>,
}

impl<T: Copy + PartialOrd> Exceeded<T> {
    /// Where something is above its limit.
    pub(crate) fn of(found: T, limit: Option<T>) -> Option<Self> {
        limit.filter(|limit| found > *limit).map(|limit| Self {
            found,
            limit,
            works: None,
        })
    }
}

impl Over {
    fn is_less_than(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Changes(one), Self::Changes(other)) => one.found < other.found,
            (Self::Cuts(one), Self::Cuts(other)) => one.found < other.found,
            (Self::Time(one), Self::Time(other)) => one.found < other.found,
            (Self::Changes(_) | Self::Cuts(_) | Self::Time(_), _) => false,
        }
    }
}

/// A size that is left to the compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeField {
    Layer,
    Step,
}

/// The highest strips that are stuck.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    /// Their layer, counted from 1 at the top.
    pub layer: u32,
    /// Where the first one of them begins.
    pub left: Length,
    /// Where the last one beside it ends.
    pub right: Length,
    /// How many strips are stuck in all layers.
    pub strips: usize,
    /// A height down to which all strips come out, tried; none where no such height is worth a strip.
    pub down_to: Option<Length>,
}
