//! The upper or the lower side of a closed outline.
//!
//! A side leads from the leftmost place of the outline to the rightmost. Where the outline runs straight up there, the
//! upper side begins at the top of that line and the lower side at its foot: what is vertical is not part of
//! a profile.

use super::chain::reverse;
use super::join::SAME;
use super::ring::{RingError, Turn, prove_simple};
use super::{Gap, Outline};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// The two sides of a closed outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// What faces up.
    Upper,
    /// What faces down.
    Lower,
}

/// Why an outline has no such side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SideError {
    Open(Gap),
    /// Both its ends have the same x.
    NoExtent,
    /// Nothing lies between its sides.
    NoArea,
    /// It meets itself.
    Crossed {
        /// Where, in the workpiece.
        at: Point2,
        /// The strokes that meet there; twice the same where one meets itself.
        strokes: [usize; 2],
    },
    /// So much of it lies beside itself that it was not looked through.
    Dense,
}

/// A side of a closed outline, from left to right. `flat` is how far its curves may have moved when it was flattened.
///
/// # Errors
/// See [`SideError`].
pub fn side(outline: &Outline, side: Side, flat: Length) -> Result<Outline, SideError> {
    if let (false, Some(&from), Some(&to)) =
        (outline.is_closed, outline.points.first(), outline.points.last())
    {
        let first = outline.owners.first().copied().unwrap_or(0);
        let last = outline.owners.last().copied().unwrap_or(0);
        return Err(SideError::Open(Gap {
            from,
            to,
            strokes: [first, last],
        }));
    }
    // Without the last point, which is the first.
    let count = outline.points.len().saturating_sub(1);
    let ring = outline.points.get(..count).unwrap_or_default();
    let span = Span::of(outline, ring)?;
    let turn = prove_simple(ring, 2.0 * flat.to_mm()).map_err(|error| match error {
        RingError::NoArea => SideError::NoArea,
        RingError::Dense => SideError::Dense,
        // The owner of the end of a segment is that of the segment.
        RingError::Meets { at, segments } => SideError::Crossed {
            at,
            strokes: segments.map(|place| outline.owners.get(place + 1).copied().unwrap_or(0)),
        },
    })?;
    Ok(half(outline, ring, &span, side, turn))
}

/// From where to where a ring reaches.
struct Span {
    leftmost: f64,
    rightmost: f64,
    /// How well that is known: corners that were joined over a gap are known no better than that.
    margin: f64,
}

impl Span {
    fn of(outline: &Outline, ring: &[Point2]) -> Result<Self, SideError> {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        let (leftmost, rightmost) = ring
            .iter()
            .fold(start, |(low, high), point| (low.min(point.x), high.max(point.x)));
        let margin = outline.widest.map_or(SAME, |gap| gap.size().to_mm().max(SAME));
        if rightmost - leftmost <= 4.0 * margin {
            return Err(SideError::NoExtent);
        }
        Ok(Self {
            leftmost,
            rightmost,
            margin,
        })
    }
}

/// The half of a ring between its leftmost and its rightmost place that is on a side.
fn half(outline: &Outline, ring: &[Point2], span: &Span, side: Side, turn: Turn) -> Outline {
    let count = ring.len();
    let rank = |point: &Point2| match side {
        Side::Upper => point.z,
        Side::Lower => -point.z,
    };
    let best = |is_there: &dyn Fn(&Point2) -> bool| {
        let there = ring.iter().enumerate().filter(|(_, point)| is_there(point));
        let best = there.max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)));
        best.map_or(0, |(place, _)| place)
    };
    let left = best(&|point| point.x <= span.leftmost + span.margin);
    let right = best(&|point| point.x >= span.rightmost - span.margin);
    // Round a ring to the left the lower side leads right and the upper one left.
    let leads_right = match side {
        Side::Lower => turn == Turn::Left,
        Side::Upper => turn == Turn::Right,
    };
    let (from, to) = if leads_right { (left, right) } else { (right, left) };
    let steps = (to + count - from) % count;
    let places: Vec<usize> = (0..=steps).map(|step| (from + step) % count).collect();
    let mut points: Vec<Point2> = places.iter().map(|&place| ring[place]).collect();
    // The owner of the first point of the ring is that of its last, which is the same point.
    let owner = |place: usize| outline.owners[if place == 0 { count } else { place }];
    let mut owners: Vec<usize> = places.iter().map(|&place| owner(place)).collect();
    if let [first, second, ..] = owners.as_mut_slice() {
        *first = *second;
    }
    if !leads_right {
        reverse(&mut points, &mut owners);
    }
    if let Some(first) = points.first_mut() {
        first.x = span.leftmost;
    }
    if let Some(last) = points.last_mut() {
        last.x = span.rightmost;
    }
    Outline {
        points,
        owners,
        is_closed: false,
        widest: outline.widest,
        repeated: outline.repeated.clone(),
    }
}
