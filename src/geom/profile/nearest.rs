//! The distance from a point to the profile.

use super::blocks::Block;
use super::{Point2, Profile};

impl Profile {
    /// The distance from a point to the nearest point of the profile, in mm.
    ///
    /// Goes down the blocks of segments, the nearer half first, and leaves out every block whose box is no nearer than
    /// the best so far. Takes logarithmic time in practice, also for points far above a profile of fine segments.
    #[must_use]
    pub fn nearest_distance(&self, point: Point2) -> f64 {
        // All distances here are squared.
        let mut best = f64::INFINITY;
        // Blocks still to look at, the next one last, with the distances of their boxes. At most one a level waits.
        let mut waiting = vec![(self.blocks.whole(), 0.0)];
        while let Some((block, box_distance)) = waiting.pop() {
            if box_distance >= best {
                continue;
            }
            match block.halves() {
                None => best = best.min(self.distance_to_segments(block, point)),
                Some(halves) => {
                    let mut halves = halves.map(|half| (half, self.distance_to_box(half, point)));
                    halves.sort_by(|a, b| b.1.total_cmp(&a.1));
                    waiting.extend(halves);
                }
            }
        }
        best.sqrt()
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

    /// The squared distance to the segments of a block.
    fn distance_to_segments(&self, block: Block, point: Point2) -> f64 {
        let corners = block.corners();
        let end = corners.end.min(self.points.len());
        self.points
            .get(corners.start..end)
            .unwrap_or_default()
            .windows(2)
            .map(|pair| squared_distance(point, pair[0], pair[1]))
            .fold(f64::INFINITY, f64::min)
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
