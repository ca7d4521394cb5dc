//! The blank, and what the milling tool does to it.

use super::milling::{Way, Written};
use vcutc_diagnostics::source::Span;

/// Coordinates this close, in mm, are the same: programs are printed with two or three decimals.
pub(super) const SAME: f64 = 0.01;

/// A blank in the axes of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blank {
    /// Across the cuts, in mm.
    pub width: f64,
    /// Along them.
    pub depth: f64,
    /// Up.
    pub height: f64,
    /// Its lowest corner, in the axes of the job, seen from the program's origin.
    pub corner: [f64; 3],
}

impl Blank {
    /// A point as seen from the corner.
    pub(super) fn seen_from_corner(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x0, y0, z0] = self.corner;
        [x - x0, y - y0, z - z0]
    }
}

/// A pass of the milling tool, in the axes of the job, from the blank's corner, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Where it runs across the blank; on a grid of a micrometre.
    pub x: f64,
    /// How high; on that grid.
    pub z: f64,
    /// From the least y to the greatest.
    pub y: [f64; 2],
    /// Where it is stated: its first motion and its last.
    pub places: [Span; 2],
    /// The speed that holds for it.
    pub speed: Option<Written>,
    /// Another one that holds for a part of it.
    pub second_speed: Option<Written>,
    /// Whether a motion of all axes is taken for a part of it.
    pub way: Way,
}

/// A motion that ends, or begins, below the top of the blank, in its axes from its corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plunge {
    pub place: Span,
    /// From where it leads.
    pub start: Start,
    /// Its lowest place, in mm.
    pub low: [f64; 3],
    /// How many passes come before it.
    pub before: usize,
}

impl Plunge {
    /// Whether it cuts nothing that another in the same place has not cut just before, as the way back up.
    pub(super) fn follows(&self, last: &Self) -> bool {
        let ([x, y, z], [x0, y0, z0]) = (self.low, last.low);
        (x - x0).abs() <= SAME && (y - y0).abs() <= SAME && z >= z0 - SAME
    }
}

/// From where a plunge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// From above its lowest place, or from there upwards.
    Above,
    /// It is not known.
    Unknown,
}
