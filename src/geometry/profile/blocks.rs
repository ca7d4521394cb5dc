//! How low and high a profile reaches, block by block, and block of blocks by block of blocks.

use super::Point2;
use core::ops::Range;

/// Segments of a block of level 0. A block of each further level is two of the level before.
pub(super) const BLOCK: usize = 64;

/// The lowest and the highest height of each block, level by level, in each from left to right. The last level has one
/// block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blocks(Vec<Vec<[f64; 2]>>);

/// A block by its level and its place from the left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    level: usize,
    place: usize,
}

impl Block {
    /// The two blocks of the level before that this one consists of (the right one may not exist); none on level 0.
    pub(super) fn halves(self) -> Option<[Self; 2]> {
        let level = self.level.checked_sub(1)?;
        let place = self.place * 2;
        Some([
            Self { level, place },
            Self {
                level,
                place: place + 1,
            },
        ])
    }

    /// The corners of its segments, were the profile long enough.
    pub(super) const fn corners(self) -> Range<usize> {
        let segments = BLOCK << self.level;
        self.place * segments..(self.place + 1) * segments + 1
    }
}

impl Blocks {
    pub(super) fn of(points: &[Point2]) -> Self {
        let segments = points.len().saturating_sub(1);
        let mut level: Vec<[f64; 2]> = (0..segments)
            .step_by(BLOCK)
            // A block has one corner more than segments, shared with the next block.
            .map(|first| &points[first..(first + BLOCK + 1).min(points.len())])
            .map(|corners| joined(corners.iter().map(|p| [p.z, p.z])))
            .collect();
        let mut levels = Vec::new();
        while level.len() > 1 {
            let next = level.chunks(2).map(|pair| joined(pair.iter().copied())).collect();
            levels.push(core::mem::replace(&mut level, next));
        }
        levels.push(level);
        Self(levels)
    }

    /// The block of everything.
    pub(super) const fn whole(&self) -> Block {
        Block {
            level: self.0.len().saturating_sub(1),
            place: 0,
        }
    }

    /// How many blocks level 0 has.
    pub(super) fn count(&self) -> usize {
        self.0.first().map_or(0, Vec::len)
    }

    /// The lowest height of a block of level 0; out of reach for one that does not exist.
    pub(super) fn low(&self, place: usize) -> f64 {
        self.range(Block { level: 0, place })
            .map_or(f64::INFINITY, |[low, _]| low)
    }

    /// The lowest and the highest height of a block, if it exists.
    pub(super) fn range(&self, block: Block) -> Option<[f64; 2]> {
        self.0.get(block.level)?.get(block.place).copied()
    }
}

fn joined(ranges: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [l, h]| {
        [low.min(l), high.max(h)]
    })
}
