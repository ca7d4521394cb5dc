//! What prevents strokes from forming an outline.

use crate::curve::{CurveError, NurbsError};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// What prevents strokes from forming an outline.
#[derive(Clone, Debug, PartialEq)]
pub enum OutlineError {
    /// There is none, or none of any extent.
    Nothing,
    /// A stroke has no length, or numbers that a curve cannot have.
    Curve {
        stroke: usize,
        /// Why not.
        error: CurveError,
    },
    /// A stroke that should be a B-spline has knots, weights or points that no B-spline can have.
    Nurbs {
        stroke: usize,
        /// Why not.
        error: NurbsError,
    },
    /// More points than a profile may have.
    TooManyPoints,
    /// More than two ends meet.
    Branch { at: Point2, strokes: Vec<usize> },
    /// The tolerance is larger than what is drawn.
    Crowded {
        /// One place where it is.
        at: Point2,
    },
    /// There are several chains.
    Several {
        /// All of them, in the order in which their first strokes are drawn.
        chains: Vec<Chain>,
        /// The two ends of different chains that are nearest each other.
        nearest: Option<Gap>,
    },
}

/// Two ends that do not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    pub from: Point2,
    pub to: Point2,
    /// The strokes they belong to.
    pub strokes: [usize; 2],
}

impl Gap {
    /// How far they are apart.
    #[must_use]
    pub fn size(&self) -> Length {
        Length::mm(self.from.distance(self.to))
    }
}

/// One of several chains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    pub from: Point2,
    pub to: Point2,
    /// Whether it ends where it begins.
    pub is_closed: bool,
    /// The stroke it begins with.
    pub first: usize,
    /// The stroke it ends with.
    pub last: usize,
    /// How many strokes it has.
    pub strokes: usize,
}
