//! The distance from a point to the profile.

use super::blocks::{BLOCK, Block};
use super::{Point2, Profile};
use core::ops::Range;

/// Blocks that wait at most, one a level: profiles have far fewer segments than two to this power.
const MOST_WAITING: usize = 32;

/// By what share of one and of itself a squared distance may be wrong by rounding, and more.
const ROUNDING: f64 = 1e-6;

impl Profile {
    /// The distance from a point to the nearest point of the profile, in mm.
    ///
    /// Goes down the blocks of segments, the nearer half first, and leaves out every block whose box is no nearer than
    /// the best so far. Takes logarithmic time in practice, also for points far above a profile of fine segments.
    #[must_use]
    pub fn nearest_distance(&self, point: Point2) -> f64 {
        self.nearest_segment(point).1
    }

    /// The number of the segment nearest to a point, counted from the left, and its distance in mm. Found as for
    /// [`Self::nearest_distance`].
    #[must_use]
    pub fn nearest_segment(&self, point: Point2) -> (usize, f64) {
        let within = self.near(point);
        if within.start / BLOCK == within.end.saturating_sub(2) / BLOCK {
            let (segment, squared) = self.nearest_of(within, point);
            return (segment, squared.sqrt());
        }
        // All distances here are squared.
        let mut best = (0, f64::INFINITY);
        // Blocks still to look at, the next one last, with the distances of their boxes. At most one a level waits.
        let mut waiting = [(self.blocks.whole(), 0.0); MOST_WAITING];
        let mut count = 1_usize;
        while let Some(&(block, box_distance)) = count.checked_sub(1).and_then(|last| waiting.get(last)) {
            count -= 1;
            if box_distance >= best.1 {
                continue;
            }
            match block.halves() {
                None => {
                    let nearest = self.nearest_of_segments(block, &within, point);
                    if nearest.1 < best.1 {
                        best = nearest;
                    }
                }
                Some(halves) => {
                    let [left, right] = halves.map(|half| (half, self.distance_to_box(half, point)));
                    let nearer_last = if right.1 > left.1 {
                        [right, left]
                    } else {
                        [left, right]
                    };
                    for (place, half) in waiting.iter_mut().skip(count).zip(nearer_last) {
                        *place = half;
                        count += 1;
                    }
                }
            }
        }
        (best.0, best.1.sqrt())
    }

    /// The corners of the segments among which the nearest one to a point is: those that come as near along x as the segment
    /// below or above the point is.
    fn near(&self, point: Point2) -> Range<usize> {
        let [from, to] = self.segment_at(point.x);
        let most = squared_distance(point, from, to);
        let most = (most + ROUNDING * (1.0 + most)).sqrt();
        let first = self.points.partition_point(|corner| corner.x < point.x - most);
        let beyond = self.points.partition_point(|corner| corner.x <= point.x + most);
        first.saturating_sub(1)..beyond.saturating_add(1).min(self.points.len())
    }

    /// The squared distance to the box around a block; infinite for a block that does not exist.
    fn distance_to_box(&self, block: Block, point: Point2) -> f64 {
        let corners = block.corners();
        let last = (corners.end - 1).min(self.points.len().saturating_sub(1));
        match (
            self.blocks.range(block),
            self.points.get(corners.start),
            self.points.get(last),
        ) {
            (Some([low, high]), Some(start), Some(end)) => {
                squared(outside(point.x, start.x, end.x)) + squared(outside(point.z, low, high))
            }
            _ => f64::INFINITY,
        }
    }

    /// The segment of a block and within a range of corners that is nearest to a point, and its squared distance.
    fn nearest_of_segments(&self, block: Block, within: &Range<usize>, point: Point2) -> (usize, f64) {
        let corners = block.corners();
        let start = corners.start.max(within.start);
        let end = corners.end.min(within.end);
        self.nearest_of(start..end, point)
    }

    /// The same of the segments between corners.
    fn nearest_of(&self, corners: Range<usize>, point: Point2) -> (usize, f64) {
        let first = corners.start;
        let pairs = self.points.get(corners).unwrap_or_default().windows(2);
        let distances = pairs.map(|pair| squared_distance(point, pair[0], pair[1]));
        (first..).zip(distances).fold(
            (0, f64::INFINITY),
            |best, next| if next.1 < best.1 { next } else { best },
        )
    }
}

/// How far a value is outside a range; 0 within.
const fn outside(value: f64, low: f64, high: f64) -> f64 {
    (low - value).max(value - high).max(0.0)
}

const fn squared(value: f64) -> f64 {
    value * value
}

/// Squared distance from a point to a segment between points that differ in x.
fn squared_distance(point: Point2, from: Point2, to: Point2) -> f64 {
    let (way, offset) = (to.minus(from), point.minus(from));
    let share = (offset.dot(way) / way.dot(way)).clamp(0.0, 1.0);
    let gap = Point2::new(offset.x - share * way.x, offset.z - share * way.z);
    gap.dot(gap)
}
