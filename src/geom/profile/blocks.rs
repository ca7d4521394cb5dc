//! How low and high a profile reaches, block by block.

use super::Point2;

/// Segments of a block. Walking over blocks and over the segments of one both stay short up to millions of points.
pub(super) const BLOCK: usize = 64;

/// The lowest and the highest height of each block of segments, from left to right.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blocks(Vec<[f64; 2]>);

impl Blocks {
    pub(super) fn of(points: &[Point2]) -> Self {
        let segments = points.len().saturating_sub(1);
        Self(
            (0..segments)
                .step_by(BLOCK)
                // A block of segments has one corner more than segments, shared with the next block.
                .map(|first| &points[first..(first + BLOCK + 1).min(points.len())])
                .map(|corners| {
                    corners
                        .iter()
                        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                            [low.min(p.z), high.max(p.z)]
                        })
                })
                .collect(),
        )
    }

    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// The lowest height of a block; out of reach for one that does not exist.
    pub(super) fn low(&self, block: usize) -> f64 {
        self.0.get(block).map_or(f64::INFINITY, |range| range[0])
    }

    /// How far a height is from the heights of a block; 0 within them.
    pub(super) fn vertical_gap(&self, block: usize, z: f64) -> f64 {
        self.0
            .get(block)
            .map_or(f64::INFINITY, |[low, high]| (low - z).max(z - high).max(0.0))
    }
}
