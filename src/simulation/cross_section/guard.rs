//! The part that rims and slits must stay out of.

use super::TOUCH;
use crate::rim::{Line, Rim};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// So many segments of the part make a block.
const BLOCK: usize = 16;

/// The part with its allowance, and the highest points of its blocks of segments: most blocks lie below what is asked for.
#[derive(Clone, Debug)]
pub struct Guard<'p> {
    part: &'p Profile,
    peaks: Vec<f64>,
}

impl<'p> Guard<'p> {
    /// For a part with its allowance.
    #[must_use]
    pub fn new(part: &'p Profile) -> Self {
        let points = part.points();
        let starts = (0..points.len()).step_by(BLOCK);
        let peak = |start: usize| {
            let block = points.iter().skip(start).take(BLOCK + 1);
            block.map(|point| point.z).fold(f64::NEG_INFINITY, f64::max)
        };
        Self {
            part,
            peaks: starts.map(peak).collect(),
        }
    }

    /// The deepest point of a rim below the part, and how deep it is, in mm. None where all of it is clear.
    #[must_use]
    pub fn deepest(&self, rim: &Rim) -> Option<(Point2, f64)> {
        self.deeper_than(rim, TOUCH)
    }

    /// The point of a rim that is nearest to the part, and how deep it is below it, in mm: negative where all of it is clear. None
    /// where no part is below it.
    #[must_use]
    pub fn nearest(&self, rim: &Rim) -> Option<(Point2, f64)> {
        self.deeper_than(rim, f64::NEG_INFINITY)
    }

    /// The deepest point of a rim below the part, if it is deeper than that.
    fn deeper_than(&self, rim: &Rim, least: f64) -> Option<(Point2, f64)> {
        let [from, to] = self.within(rim.cover())?;
        let lowest = |block: &[Point2]| match block {
            [first, .., last] => rim.height(rim.lowest().x.max(first.x).min(last.x)),
            _ => f64::INFINITY,
        };
        let mut deepest = (rim.centre(), least);
        for (block, peak) in self.blocks(from, to) {
            if peak - lowest(block) <= deepest.1 {
                continue;
            }
            for (a, b) in block.iter().zip(block.iter().skip(1)) {
                let (left, right) = (a.x.max(from), b.x.min(to));
                if left > right {
                    continue;
                }
                let line = Line::through(*a, *b);
                let x = rim.highest_above(line, left, right);
                let depth = rim.below(line.at(x));
                if depth > deepest.1 {
                    deepest = (Point2::new(x, rim.height(x)), depth);
                }
            }
        }
        (deepest.1 > least).then_some(deepest)
    }

    /// How deep a slit with its bottom there enters the part, in mm, if the sides of the blade are so far to the left and right
    /// of it. None where it is clear.
    #[must_use]
    pub fn below_slit(&self, bottom: Point2, standoff: f64) -> Option<f64> {
        let [from, to] = self.within([bottom.x - standoff, bottom.x + standoff])?;
        let points = self.part.points();
        let first = points.partition_point(|point| point.x <= from);
        let corners = points.iter().skip(first).take_while(|corner| corner.x < to);
        let ends = [from, to].map(|x| self.part.height(x));
        let highest = corners
            .map(|corner| corner.z)
            .chain(ends)
            .fold(f64::NEG_INFINITY, f64::max);
        Some(highest - bottom.z).filter(|&depth| depth > TOUCH)
    }

    /// What of a stretch lies over the part.
    fn within(&self, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let (start, end) = self.part.span();
        let span = [from.max(start), to.min(end)];
        (span[0] <= span[1]).then_some(span)
    }

    /// The blocks over a stretch with their highest points.
    fn blocks(&self, from: f64, to: f64) -> impl Iterator<Item = (&'p [Point2], f64)> + '_ {
        let points = self.part.points();
        let first = points.partition_point(|point| point.x < from).saturating_sub(1) / BLOCK;
        let blocks = self
            .peaks
            .iter()
            .enumerate()
            .skip(first)
            .map(move |(number, &peak)| {
                let start = number * BLOCK;
                let end = points.len().min(start + BLOCK + 1);
                (points.get(start..end).unwrap_or_default(), peak)
            });
        blocks.take_while(move |(block, _)| block.first().is_some_and(|point| point.x <= to))
    }
}
