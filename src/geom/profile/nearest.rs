//! The distance from a point to the profile.

use super::blocks::BLOCK;
use super::{Point2, Profile};

impl Profile {
    /// The distance from a point to the nearest point of the profile, in mm.
    ///
    /// Starts with the block of segments under the point and goes outwards both ways, as long as a block is nearer in
    /// x than the best so far. The vertical gap is the first such bound, so only what lies within it in x counts.
    #[must_use]
    pub fn nearest_distance(&self, point: Point2) -> f64 {
        let home = self.segment_index(point.x) / BLOCK;
        let mut best = f64::INFINITY;
        for block in home..self.blocks.count() {
            if self.block_starts(block) - point.x >= best {
                break;
            }
            best = best.min(self.distance_to_block(block, point, best));
        }
        for block in (0..home).rev() {
            if point.x - self.block_starts(block + 1) >= best {
                break;
            }
            best = best.min(self.distance_to_block(block, point, best));
        }
        best
    }

    /// The x of the first corner of a block.
    fn block_starts(&self, block: usize) -> f64 {
        self.points
            .get(block * BLOCK)
            .map_or(f64::INFINITY, |corner| corner.x)
    }

    /// The distance to a block's segments; it may be overstated when it is `best` or more.
    fn distance_to_block(&self, block: usize, point: Point2, best: f64) -> f64 {
        if self.blocks.vertical_gap(block, point.z) >= best {
            return best;
        }
        let first = block * BLOCK;
        let end = (first + BLOCK + 1).min(self.points.len());
        self.points
            .get(first..end)
            .unwrap_or_default()
            .windows(2)
            .map(|pair| squared_distance(point, pair[0], pair[1]))
            .fold(f64::INFINITY, f64::min)
            .sqrt()
    }
}

/// Squared distance from a point to a segment between points that differ in x.
fn squared_distance(point: Point2, from: Point2, to: Point2) -> f64 {
    let (way, offset) = (to.minus(from), point.minus(from));
    let share = (offset.dot(way) / way.dot(way)).clamp(0.0, 1.0);
    let gap = Point2::new(offset.x - share * way.x, offset.z - share * way.z);
    gap.dot(gap)
}
