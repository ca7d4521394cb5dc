//! Where a profile lies at or below a height. For a [`super::super::cone::clearance`] these are the places where a
//! tip may go.

use super::blocks::BLOCK;
use super::{Point2, Profile, height_between};

impl Profile {
    /// The maximal intervals of x, in mm and from left to right, on which the profile is at or below `z`. An interval
    /// may be a single place (start and end equal). At both ends [`Self::height`] is at or below `z`.
    #[must_use]
    pub fn level_set(&self, z: f64) -> Vec<(f64, f64)> {
        let mut intervals: Vec<(f64, f64)> = Vec::new();
        // Whether the last interval reaches the corner that the next segment starts from.
        let mut open = false;
        for [left, right] in self.segments() {
            let Some((start, end)) = low_part(left, right, z) else {
                open = false;
                continue;
            };
            match intervals.last_mut() {
                Some(last) if open => last.1 = end,
                _ => intervals.push((start, end)),
            }
            open = right.z <= z;
        }
        intervals
    }

    /// The place nearest to `x` within the span at which the profile is at or below `z`; the left one of two equally
    /// near. None when the profile is above `z` everywhere. All in mm. At the place [`Self::height`] is at or below
    /// `z`.
    #[must_use]
    pub fn nearest_clear(&self, x: f64, z: f64) -> Option<f64> {
        let (start, end) = self.span();
        let inside = x.clamp(start, end);
        if self.height(inside) <= z {
            return Some(inside);
        }
        match (self.clear_left_of(inside, z), self.clear_right_of(inside, z)) {
            (Some(left), Some(right)) if right - x < x - left => Some(right),
            (Some(left), _) => Some(left),
            (None, right) => right,
        }
    }

    /// The rightmost place at or below `z` left of an x in the span at which the profile is above `z`.
    fn clear_left_of(&self, x: f64, z: f64) -> Option<f64> {
        let home = self.segment_index(x);
        let mut i = home;
        loop {
            let block = i / BLOCK;
            if self.blocks.low(block) <= z {
                for segment in (block * BLOCK..=i).rev() {
                    let [left, right] = self.segment(segment)?;
                    if left.z <= z {
                        return low_part(left, right, z).map(|(_, end)| end);
                    }
                }
            }
            i = (block * BLOCK).checked_sub(1)?;
        }
    }

    /// The leftmost place at or below `z` right of an x in the span at which the profile is above `z`.
    fn clear_right_of(&self, x: f64, z: f64) -> Option<f64> {
        let mut i = self.segment_index(x);
        loop {
            let block = i / BLOCK;
            let next = (block + 1) * BLOCK;
            if self.blocks.low(block) <= z {
                for segment in i..next {
                    let [left, right] = self.segment(segment)?;
                    if right.z <= z {
                        return low_part(left, right, z).map(|(start, _)| start);
                    }
                }
            }
            if block >= self.blocks.count() {
                return None;
            }
            i = next;
        }
    }

    /// A segment by its number from the left.
    fn segment(&self, i: usize) -> Option<[Point2; 2]> {
        match self.points.get(i..i.checked_add(2)?) {
            Some(&[left, right]) => Some([left, right]),
            _ => None,
        }
    }
}

/// The part of a segment that is at or below `z`.
fn low_part(left: Point2, right: Point2, z: f64) -> Option<(f64, f64)> {
    match (left.z <= z, right.z <= z) {
        (true, true) => Some((left.x, right.x)),
        (true, false) => Some((left.x, crossing(left, left, right, z))),
        (false, true) => Some((crossing(right, left, right, z), right.x)),
        (false, false) => None,
    }
}

/// Where a segment with one end at or below `z` and one above it passes through `z`. Rounding may put that place a
/// trifle above `z`; it is then moved towards the low end until it is not.
fn crossing(low_end: Point2, left: Point2, right: Point2, z: f64) -> f64 {
    let share = (z - left.z) / (right.z - left.z);
    let exact = (left.x + (right.x - left.x) * share).clamp(left.x, right.x);
    let nudges = (0..8).map(|attempt| f64::EPSILON * f64::from(1 << (4 * attempt)));
    core::iter::once(0.0)
        .chain(nudges)
        .map(|nudge| exact + (low_end.x - exact) * nudge)
        .find(|&x| height_between(left, right, x) <= z)
        .unwrap_or(low_end.x)
}
