//! The part's profile: a height for every x.
//!
//! A profile is a polyline with strictly increasing x. Questions about a height are answered by bisection; questions
//! about a region (the nearest point, the nearest place below a height) by way of blocks of segments, of which each
//! knows how low and high it reaches, so that most blocks are passed over unopened.

mod blocks;
mod contour;
mod level;
mod nearest;
mod standing;

pub use contour::{Contour, Nearest};

use super::point::Point2;
use blocks::Blocks;
use core::cmp::Ordering;
use vcutc_backend_api::units::{Area, Length};

/// How far outside its span a profile may be asked to reach, in mm: rounding of what users compute.
const REACH: f64 = 1e-6;

/// A height over x, as a polyline with strictly increasing x. No vertical steps, at least two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    points: Vec<Point2>,
    blocks: Blocks,
}

/// Why points are not a profile. An `index` counts them in the order they were handed over, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProfileError {
    /// Fewer than two points that differ.
    TooFew,
    /// A coordinate is not a number, or beyond [`super::curve::LARGEST_COORDINATE`].
    OutOfRange {
        /// The point.
        index: usize,
    },
    /// The profile turns back or rises straight up: from here on some x has more than one height.
    NotSingleValued {
        /// The first point that does not lie beyond the one before it.
        index: usize,
    },
}

/// Smallest step in x between two points of a profile near `x`, in mm: a picometre, or a few times the resolution of a
/// double where that is coarser. It keeps slopes finite.
pub(super) fn least_step(x: f64) -> f64 {
    (x.abs() * 1e-15).max(1e-9)
}

impl Profile {
    /// A profile through points from left to right, or from right to left (it is then turned round). Points closer
    /// to the one before than 1e-9 mm are dropped.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn new(points: Vec<Point2>) -> Result<Self, ProfileError> {
        if let Some(index) = points.iter().position(|point| !point.is_in_range()) {
            return Err(ProfileError::OutOfRange { index });
        }
        let mut kept: Vec<Point2> = Vec::with_capacity(points.len());
        // +1 on the way right, -1 on the way left: the first step decides.
        let mut direction = None;
        for (index, &point) in points.iter().enumerate() {
            if let Some(&last) = kept.last() {
                let least = least_step(point.x);
                if (point.x - last.x).abs() < least && (point.z - last.z).abs() < least {
                    continue;
                }
                let direction = *direction.get_or_insert((point.x - last.x).signum());
                if (point.x - last.x) * direction < least {
                    return Err(ProfileError::NotSingleValued { index });
                }
            }
            kept.push(point);
        }
        if kept.len() < 2 {
            return Err(ProfileError::TooFew);
        }
        if direction.is_some_and(|direction| direction < 0.0) {
            kept.reverse();
        }
        Ok(Self::from_ascending(kept))
    }

    /// A profile from points that the caller made in ascending order, two or more.
    pub(super) fn from_ascending(points: Vec<Point2>) -> Self {
        let blocks = Blocks::of(&points);
        Self { points, blocks }
    }

    /// The corners, with strictly increasing x.
    #[must_use]
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    /// The x at which the profile starts and ends, in mm.
    #[must_use]
    pub fn span(&self) -> (f64, f64) {
        match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => (first.x, last.x),
            _ => (0.0, 0.0),
        }
    }

    /// The height at x, both in mm; beyond the ends the height of the end.
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        let [left, right] = self.segment_at(x);
        height_between(left, right, x)
    }

    /// The leftmost of the lowest corners.
    #[must_use]
    pub fn lowest(&self) -> Point2 {
        self.extreme(|candidate, best| candidate.z < best.z)
    }

    /// The leftmost of the highest corners.
    #[must_use]
    pub fn highest(&self) -> Point2 {
        self.extreme(|candidate, best| candidate.z > best.z)
    }

    /// The profile higher by a length of zero or more, but raised to no more than this height.
    #[must_use]
    pub fn raised(&self, by: Length, most: Length) -> Self {
        let [by, most] = [by, most].map(Length::to_mm);
        let higher = |point: &Point2| Point2::new(point.x, (point.z + by).min(most).max(point.z));
        Self::from_ascending(self.points.iter().map(higher).collect())
    }

    /// The profile with corners above this height put on it.
    #[must_use]
    pub fn not_above(&self, most: Length) -> Self {
        let lower = |point: &Point2| Point2::new(point.x, point.z.min(most.to_mm()));
        Self::from_ascending(self.points.iter().map(lower).collect())
    }

    /// The profile lower by a length.
    #[must_use]
    pub fn lowered(&self, by: Length) -> Self {
        let lower = |point: &Point2| Point2::new(point.x, point.z - by.to_mm());
        Self::from_ascending(self.points.iter().map(lower).collect())
    }

    /// The profile, and this height wherever it is lower.
    #[must_use]
    pub fn not_below(&self, least: Length) -> Self {
        let least = least.to_mm();
        let mut points: Vec<Point2> = Vec::with_capacity(self.points.len());
        for (number, &point) in self.points.iter().enumerate() {
            let before = number.checked_sub(1).and_then(|before| self.points.get(before));
            if let Some(&from) = before
                && (from.z < least) != (point.z < least)
            {
                let x = from.x + (point.x - from.x) * ((least - from.z) / (point.z - from.z));
                if x - from.x >= least_step(x) && point.x - x >= least_step(point.x) {
                    points.push(Point2::new(x, least));
                }
            }
            points.push(Point2::new(point.x, point.z.max(least)));
        }
        Self::from_ascending(points)
    }

    /// The part of the profile from one x to a greater one, with points at exactly these. Ends beyond the profile by
    /// no more than 1e-6 mm get the height of its end.
    ///
    /// None when the profile does not cover the range, or the range is empty.
    #[must_use]
    pub fn clipped(&self, from_x: f64, to_x: f64) -> Option<Self> {
        let (start, end) = self.span();
        let covered = from_x >= start - REACH && to_x <= end + REACH;
        if !(covered && to_x - from_x >= least_step(to_x)) {
            return None;
        }
        let mut points = vec![Point2::new(from_x, self.height(from_x))];
        let first = self.points.partition_point(|p| p.x < from_x + least_step(from_x));
        let end = self.points.partition_point(|p| p.x <= to_x - least_step(to_x));
        points.extend(self.points.get(first..end).unwrap_or_default());
        points.push(Point2::new(to_x, self.height(to_x)));
        Some(Self::from_ascending(points))
    }

    /// The area between the profile and z = 0 over a range of x (in mm; nothing when it is empty). Area below z = 0
    /// counts negative. Beyond its ends the profile continues at their height.
    #[must_use]
    pub fn area_below(&self, from_x: f64, to_x: f64) -> Area {
        if from_x.partial_cmp(&to_x) != Some(Ordering::Less) {
            return Area::ZERO;
        }
        let mut last = Point2::new(from_x, self.height(from_x));
        let end = Point2::new(to_x, self.height(to_x));
        let inner_start = self.points.partition_point(|p| p.x <= from_x);
        let inner_end = self.points.partition_point(|p| p.x < to_x);
        let inner = self.points.get(inner_start..inner_end).unwrap_or_default();
        let mut area = 0.0;
        for &point in inner.iter().chain([&end]) {
            area += (point.x - last.x) * (last.z + point.z) / 2.0;
            last = point;
        }
        Area::mm2(area)
    }

    /// The length along the profile.
    #[must_use]
    pub fn arc_length(&self) -> Length {
        Length::mm(self.segments().map(|[a, b]| a.distance(b)).sum())
    }

    /// The segments from left to right.
    pub(super) fn segments(&self) -> impl DoubleEndedIterator<Item = [Point2; 2]> + '_ {
        self.points.windows(2).map(|pair| [pair[0], pair[1]])
    }

    /// The segment over x, the one to the right at a corner, the outermost one beyond the ends.
    fn segment_at(&self, x: f64) -> [Point2; 2] {
        let i = self.segment_index(x);
        match self.points.get(i..i + 2) {
            Some(&[left, right]) => [left, right],
            // Never taken: there are two points or more.
            _ => [Point2::new(0.0, 0.0); 2],
        }
    }

    /// The number of [`Self::segment_at`], counted from the left.
    fn segment_index(&self, x: f64) -> usize {
        self.points
            .partition_point(|p| p.x <= x)
            .saturating_sub(1)
            .min(self.points.len().saturating_sub(2))
    }

    fn extreme(&self, better: impl Fn(Point2, Point2) -> bool) -> Point2 {
        self.points
            .iter()
            .copied()
            .reduce(
                |best, candidate| {
                    if better(candidate, best) { candidate } else { best }
                },
            )
            .unwrap_or(Point2::new(0.0, 0.0))
    }
}

/// The height at x of the segment between two points, clamped to its ends and never beyond their heights. All in mm.
#[must_use]
pub fn height_between(left: Point2, right: Point2, x: f64) -> f64 {
    if x <= left.x {
        left.z
    } else if x >= right.x {
        right.z
    } else {
        let z = left.z + (right.z - left.z) * ((x - left.x) / (right.x - left.x));
        z.clamp(left.z.min(right.z), left.z.max(right.z))
    }
}

#[cfg(test)]
mod tests;
