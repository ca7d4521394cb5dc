//! The grid that the quadtrees stand on, and the boxes of it that single passes cut.

use super::Square;
use super::clip::{corners, middle};
use crate::boxes::Extent;
use crate::curve::Curve;
use crate::place::Place;
use core::ops::Range;

/// So many boxes to a radius: what lies between two passes a radius apart then holds a whole row of them.
const BOXES_PER_RADIUS: f64 = 2.0;

/// Passes are looked at in chunks of so many radii, so that few boxes lie around one that it does not meet.
const CHUNK: f64 = 4.0;

/// Boxes over an extent.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    low: Place,
    side: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Grid {
    /// Boxes of a size that suits a radius.
    pub(super) fn over(extent: Extent, radius: f64) -> Self {
        let side = radius / BOXES_PER_RADIUS;
        // The cast saturates.
        let count = |from: f64, to: f64| (libm::floor((to - from) / side) + 1.0).max(1.0) as usize;
        Self {
            low: extent.low,
            side,
            columns: count(extent.low.x, extent.high.x),
            rows: count(extent.low.y, extent.high.y),
        }
    }

    /// Marks the boxes that a single pass cuts; none where passes are longer than so many chunks.
    pub(super) fn mark(&self, passes: &[Curve], radius: f64, cut: &mut [bool], most: usize) -> Option<()> {
        let mut left = most;
        for pass in passes {
            let length = pass.piece.length();
            let chunks = libm::ceil(length / (CHUNK * radius)).max(1.0);
            left = left.checked_sub(chunks as usize)?;
            let chunk = length / chunks;
            let bulge = (chunk * chunk * pass.bend.abs() / 8.0).min(chunk / 2.0);
            let mut from = pass.piece.from;
            for number in 1..=chunks as u32 {
                let to = pass.piece.at(f64::from(number) / chunks);
                self.mark_around(pass, Extent::of(from, to).grown(bulge + radius), radius, cut);
                from = to;
            }
        }
        Some(())
    }

    /// Marks the boxes within an extent that a pass cuts.
    fn mark_around(&self, pass: &Curve, extent: Extent, radius: f64, cut: &mut [bool]) {
        let (columns, rows) = self.boxes_in(extent);
        for row in rows {
            let marks = cut.get_mut(row * self.columns..(row + 1) * self.columns);
            let marks = marks
                .and_then(|marks| marks.get_mut(columns.clone()))
                .unwrap_or_default();
            let boxes = columns.clone().zip(marks);
            for (column, mark) in boxes.filter(|(_, mark)| !**mark) {
                *mark = cuts(pass, self.square(column, row), radius);
            }
        }
    }

    /// The boxes that may lie within an extent.
    fn boxes_in(&self, extent: Extent) -> (Range<usize>, Range<usize>) {
        let range = |low: f64, high: f64, origin: f64, count: usize| {
            // The casts saturate, at 0 for what lies before the grid.
            let first = libm::floor((low - origin) / self.side) as usize;
            let last = libm::ceil((high - origin) / self.side) as usize;
            first.min(count)..last.min(count)
        };
        let (low, high) = (extent.low, extent.high);
        let columns = range(low.x, high.x, self.low.x, self.columns);
        (columns, range(low.y, high.y, self.low.y, self.rows))
    }

    pub(super) fn square(&self, column: usize, row: usize) -> Square {
        let aside = Place::new(column as f64 * self.side, row as f64 * self.side);
        Square {
            low: self.low.plus(aside),
            side: self.side,
        }
    }
}

/// Whether all of a square lies within a distance of a piece.
///
/// What is within it of a line is convex, and so is what is within it of a place: then the corners decide.
pub(super) fn cuts(pass: &Curve, square: Square, radius: f64) -> bool {
    let corners = corners(square);
    if pass.piece.is_line() {
        return corners.iter().all(|&corner| pass.distance(corner) <= radius);
    }
    let foot = pass.nearest(middle(square)).at;
    let limit = radius * radius;
    corners.iter().all(|&corner| corner.minus(foot).square() <= limit)
}
