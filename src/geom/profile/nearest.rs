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
        self.nearest_segment(point).1
    }

    /// The number of the segment nearest to a point, counted from the left, and its distance in mm. Found as for
    /// [`Self::nearest_distance`].
    #[must_use]
    pub fn nearest_segment(&self, point: Point2) -> (usize, f64) {
        // All distances here are squared.
        let mut best = (0, f64::INFINITY);
        // Blocks still to look at, the next one last, with the distances of their boxes. At most one a level waits.
        let mut waiting = vec![(self.blocks.whole(), 0.0)];
        while let Some((block, box_distance)) = waiting.pop() {
            if box_distance >= best.1 {
                continue;
            }
            match block.halves() {
                None => {
                    let nearest = self.nearest_of_segments(block, point);
                    if nearest.1 < best.1 {
                        best = nearest;
                    }
                }
                Some(halves) => {
                    let mut halves = halves.map(|half| (half, self.distance_to_box(half, point)));
                    halves.sort_by(|a, b| b.1.total_cmp(&a.1));
                    waiting.extend(halves);
                }
            }
        }
        (best.0, best.1.sqrt())
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

    /// The segment of a block that is nearest to a point, and its squared distance.
    fn nearest_of_segments(&self, block: Block, point: Point2) -> (usize, f64) {
        let corners = block.corners();
        let end = corners.end.min(self.points.len());
        let pairs = self.points.get(corners.start..end).unwrap_or_default().windows(2);
        let distances = pairs.map(|pair| squared_distance(point, pair[0], pair[1]));
        (corners.start..).zip(distances).fold(
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
