//! Cuts of rims that have freed nothing yet.

use super::TOUCH;
use super::sorted::Placed;
use super::sweep::{End, Piece};
use crate::rim::Rim;

/// A stretch that a rim has cut below material that still stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Undercut {
    pub(super) rim: Rim,
    pub(super) span: [f64; 2],
    pub(super) ends: [End; 2],
}

impl Undercut {
    pub(super) const fn of(rim: Rim, piece: &Piece) -> Self {
        Self {
            rim,
            span: piece.span,
            ends: piece.ends,
        }
    }

    /// Whether more of it may be free once what is above a stretch has changed.
    pub(super) fn is_changed_by(&self, from: f64, to: f64) -> bool {
        let ([left, right], [first, last]) = (self.span, self.ends);
        let is_within = left < to - TOUCH && right > from + TOUCH;
        let is_crossed = from == to && left < to && right > from;
        let touches = |end: End, x: f64| end == End::Attached && from - TOUCH <= x && x <= to + TOUCH;
        is_within || is_crossed || touches(first, left) || touches(last, right)
    }

    /// Whether two level ones lie in one plane and meet.
    pub(super) fn meets(&self, other: &Self) -> bool {
        let ([left, right], [from, to]) = (self.span, other.span);
        let is_level = self.rim.is_level() && other.rim.is_level();
        let is_one_plane = (self.rim.centre().z - other.rim.centre().z).abs() <= TOUCH;
        is_level && is_one_plane && left <= to + TOUCH && right >= from - TOUCH
    }

    /// Both as one.
    pub(super) fn joined(&self, other: &Self) -> Self {
        let first = if other.span[0] < self.span[0] { other } else { self };
        let last = if other.span[1] > self.span[1] { other } else { self };
        Self {
            rim: self.rim,
            span: [first.span[0], last.span[1]],
            ends: [first.ends[0], last.ends[1]],
        }
    }

    pub(super) fn width(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

impl Placed for Undercut {
    fn x(&self) -> f64 {
        self.span[0]
    }
}
