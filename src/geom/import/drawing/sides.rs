//! The upper or the lower side of a closed outline.
//!
//! A side leads from the leftmost place of the outline to the rightmost. Where the outline runs straight up there, the
//! upper side begins at the top of that line and the lower side at its foot: what is vertical is no part of a profile.

use super::chain::reverse;
use super::join::SAME;
use super::{Gap, Outline};
use crate::geom::point::Point2;
use crate::geom::profile::Profile;

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
    /// It is open.
    Open(Gap),
    /// Both its ends have the same x.
    NoExtent,
    /// Its sides change places, at this x.
    Crossed {
        /// Where, in mm.
        x: f64,
    },
}

/// A side of a closed outline, from left to right.
///
/// # Errors
/// See [`SideError`].
pub fn side(outline: &Outline, side: Side) -> Result<Outline, SideError> {
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
    let wanted = half(outline, side)?;
    let other = half(
        outline,
        match side {
            Side::Upper => Side::Lower,
            Side::Lower => Side::Upper,
        },
    )?;
    let (upper, lower) = match side {
        Side::Upper => (&wanted, &other),
        Side::Lower => (&other, &wanted),
    };
    match crossing(upper, lower) {
        Some(x) => Err(SideError::Crossed { x }),
        None => Ok(wanted),
    }
}

/// The half of a ring between its leftmost and its rightmost place that is on a side.
fn half(outline: &Outline, side: Side) -> Result<Outline, SideError> {
    // Without the last point, which is the first.
    let count = outline.points.len().saturating_sub(1);
    let ring = outline.points.get(..count).unwrap_or_default();
    let (leftmost, rightmost) = ring
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point.x), high.max(point.x))
        });
    // Corners that were joined over a gap are known no better than that.
    let margin = outline.widest.map_or(SAME, |gap| gap.size().to_mm().max(SAME));
    if rightmost - leftmost <= 4.0 * margin {
        return Err(SideError::NoExtent);
    }
    let rank = |point: &Point2| match side {
        Side::Upper => point.z,
        Side::Lower => -point.z,
    };
    let best = |is_there: &dyn Fn(&Point2) -> bool| {
        let there = ring.iter().enumerate().filter(|(_, point)| is_there(point));
        let best = there.max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)));
        best.map_or(0, |(place, _)| place)
    };
    let left = best(&|point| point.x <= leftmost + margin);
    let right = best(&|point| point.x >= rightmost - margin);
    // Round a ring to the left (area above 0) the lower side leads right and the upper one left.
    let leads_right = match side {
        Side::Lower => area(ring) > 0.0,
        Side::Upper => area(ring) < 0.0,
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
        first.x = leftmost;
    }
    if let Some(last) = points.last_mut() {
        last.x = rightmost;
    }
    Ok(Outline {
        points,
        owners,
        is_closed: false,
        widest: outline.widest,
        repeated: outline.repeated.clone(),
    })
}

/// Twice the area inside of a ring, above 0 when it turns left.
fn area(ring: &[Point2]) -> f64 {
    let Some(&origin) = ring.first() else {
        return 0.0;
    };
    ring.windows(2)
        .map(|pair| pair[0].minus(origin).cross(pair[1].minus(origin)))
        .sum()
}

/// The leftmost corner at which the upper side lies below the lower one. Sides that turn back are found elsewhere.
fn crossing(upper: &Outline, lower: &Outline) -> Option<f64> {
    let top = Profile::new(upper.points.clone()).ok()?;
    let bottom = Profile::new(lower.points.clone()).ok()?;
    let corners = upper.points.iter().chain(&lower.points);
    corners
        .map(|point| point.x)
        .filter(|&x| top.height(x) < bottom.height(x) - SAME)
        .min_by(f64::total_cmp)
}
