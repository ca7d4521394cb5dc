//! The corners on one side of the place of work, nearest last, and what a flank that goes there meets.
//!
//! Whether material stands above a flank beyond its exit is asked for every flank once a steeper one, or a wall, has been
//! cut. Looking at every corner up to the stock's top would take longer the more cuts lie between here and the wall. So a
//! Fenwick tree [Fenwick 1994] over the stack keeps the highest corner of blocks of them: a block that stays below the
//! flank where the flank gets to it stays below all along, because a flank rises. Looking so takes
//! logarithmic time as long as few corners are above the flank. The tree grows when it is asked and shrinks
//! with the stack, so surfaces without walls never have one.

use super::{FlankWalk, TOUCH, is_same};
use vcutc_geometry::curve::Point2;

/// A flank, as a ray from its tip; to which side it goes is known from the stack.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) tip: Point2,
    /// Rise over x; infinite for a wall.
    pub(super) slope: f64,
}

impl Ray {
    pub(super) const fn is_wall(self) -> bool {
        self.slope.is_infinite()
    }

    /// Height over x of a sloping flank.
    fn leaning(self, x: f64) -> f64 {
        self.tip.z + (x - self.tip.x).abs() * self.slope
    }

    /// Height over x. A wall is everywhere above but at its tip.
    pub(super) fn height(self, x: f64) -> f64 {
        if self.is_wall() && (x - self.tip.x).abs() <= TOUCH {
            return self.tip.z;
        }
        self.leaning(x)
    }
}

/// Corners of which the nearest is on top.
#[derive(Clone, Debug)]
pub(super) struct Stack {
    corners: Vec<Point2>,
    /// Of the first corners: entry `n`, counted from 1, is the highest of the corners `n - b + 1` to `n`, with `b` the
    /// largest power of two that divides `n`. Corners may have been lowered since.
    peaks: Vec<f64>,
}

impl Stack {
    pub(super) fn of(corner: Point2) -> Self {
        Self {
            corners: vec![corner],
            peaks: Vec::new(),
        }
    }

    #[inline]
    pub(super) fn corners(&self) -> &[Point2] {
        &self.corners
    }

    #[inline]
    pub(super) fn last(&self) -> Option<Point2> {
        self.corners.last().copied()
    }

    /// The one below the last.
    #[inline]
    pub(super) fn second(&self) -> Option<Point2> {
        let place = self.corners.len().checked_sub(2)?;
        self.corners.get(place).copied()
    }

    /// The nearest ones, nearest last.
    #[inline]
    pub(super) fn nearest(&self, count: usize) -> &[Point2] {
        let rest = self.corners.len().saturating_sub(count);
        self.corners.get(rest..).unwrap_or_default()
    }

    #[inline]
    pub(super) fn push(&mut self, corner: Point2) {
        self.corners.push(corner);
    }

    /// Pushes a corner unless it is the one already there.
    #[inline]
    pub(super) fn push_corner(&mut self, corner: Point2) {
        if let Some(last) = self.corners.last_mut()
            && is_same(*last, corner)
        {
            last.z = last.z.min(corner.z);
            return;
        }
        self.corners.push(corner);
    }

    /// Drops the last corner where it lies on a level line from the one below it to the next one.
    pub(super) fn drop_level(&mut self, next: Point2) {
        let is_level = |corner: Option<Point2>| corner.is_some_and(|corner| corner.z == next.z);
        if is_level(self.last()) && is_level(self.second()) {
            self.drop_nearest(1);
        }
    }

    /// Takes the nearest one off if it goes.
    pub(super) fn pop_if(&mut self, goes: impl FnOnce(&Point2) -> bool) -> Option<Point2> {
        let corner = self.corners.pop_if(|corner| goes(corner))?;
        self.shorten_peaks();
        Some(corner)
    }

    #[inline]
    pub(super) fn pop(&mut self) -> Option<Point2> {
        let corner = self.corners.pop()?;
        self.shorten_peaks();
        Some(corner)
    }

    /// Moves the nearest corners to the other side of the place of work: those up to the first that does not go.
    #[inline]
    pub(super) fn pass_on(&mut self, other: &mut Self, goes: impl Fn(Point2) -> bool) {
        let last = self.corners.iter().rposition(|&corner| !goes(corner));
        let kept = last.map_or(0, |last| last + 1);
        if let Some(passed @ [_, ..]) = self.corners.get(kept..) {
            other.corners.extend(passed.iter().rev());
            self.corners.truncate(kept);
            self.shorten_peaks();
        }
    }

    #[inline]
    pub(super) fn drop_nearest(&mut self, count: usize) {
        self.corners.truncate(self.corners.len().saturating_sub(count));
        self.shorten_peaks();
    }

    #[inline]
    fn shorten_peaks(&mut self) {
        if self.peaks.len() > self.corners.len() {
            self.peaks.truncate(self.corners.len());
        }
    }

    /// Past all corners, out at the side of the stock.
    pub(super) fn all(&self, ray: Ray) -> FlankWalk {
        let x = self.corners.first().map_or(ray.tip.x, |corner| corner.x);
        // At the side itself a wall has its tip on it.
        let z = if ray.is_wall() { ray.tip.z } else { ray.height(x) };
        FlankWalk {
            passed: self.corners.len(),
            exit: Point2 { x, z },
            met: x,
        }
    }

    /// Follows a flank from a point of the surface above it, past so many corners, to where it comes out.
    #[inline]
    pub(super) fn walk(&self, ray: Ray, skipped: usize, start: Point2) -> FlankWalk {
        let mut before = start;
        for (passed, &corner) in self.corners.iter().rev().enumerate().skip(skipped) {
            let above = corner.z - ray.leaning(corner.x);
            if above > TOUCH {
                before = corner;
                continue;
            }
            let above_before = before.z - ray.leaning(before.x);
            // The surface comes down from `before` to `corner` through the flank, or touches it in `corner`.
            let share = if above >= -TOUCH {
                1.0
            } else {
                above_before / (above_before - above)
            };
            let x = before.x + (corner.x - before.x) * share;
            let exit = Point2 { x, z: ray.leaning(x) };
            // The surface falls from the exit to the older tip, unless it is the stock's flat top.
            let met = if corner.z < exit.z - TOUCH { corner.x } else { x };
            return FlankWalk { passed, exit, met };
        }
        // Out at the side of the stock.
        let x = before.x;
        FlankWalk {
            passed: self.corners.len(),
            exit: Point2 { x, z: ray.leaning(x) },
            met: x,
        }
    }

    /// Where a flank that starts above a point of the surface, or on it, runs into the material below the stock's top.
    pub(super) fn entry(&self, ray: Ray, start: Point2, top: f64) -> Option<super::Entry> {
        let mut before = start;
        for (passed, &corner) in self.corners.iter().rev().enumerate() {
            let height = ray.height(corner.x);
            if height >= top {
                return None;
            }
            let above = corner.z - height;
            if above <= TOUCH {
                before = corner;
                continue;
            }
            let below = ray.height(before.x) - before.z;
            let share = if below <= TOUCH {
                0.0
            } else {
                below / (below + above)
            };
            let x = before.x + (corner.x - before.x) * share;
            return Some(super::Entry {
                passed,
                at: Point2 { x, z: ray.height(x) },
                above: corner,
                is_at_wall: false,
            });
        }
        None
    }

    /// The first corner after the nearest ones that stands above a flank.
    pub(super) fn beyond(&mut self, ray: Ray, passed: usize, top: f64) -> Option<Point2> {
        let mut number = self.corners.len().saturating_sub(passed);
        self.raise_peaks(number);
        while let Some(&corner) = number.checked_sub(1).and_then(|place| self.corners.get(place)) {
            let height = ray.height(corner.x);
            if height >= top {
                return None;
            }
            if corner.z > height + TOUCH {
                return Some(corner);
            }
            let peak = self.peaks.get(number - 1).copied().unwrap_or(f64::INFINITY);
            number -= if peak <= height + TOUCH { block(number) } else { 1 };
        }
        None
    }

    /// Extends the tree to so many corners.
    fn raise_peaks(&mut self, count: usize) {
        for number in self.peaks.len() + 1..=count {
            let mut peak = self
                .corners
                .get(number - 1)
                .map_or(f64::INFINITY, |corner| corner.z);
            let mut below = number - 1;
            while below > number - block(number) {
                peak = peak.max(self.peaks.get(below - 1).copied().unwrap_or(f64::INFINITY));
                below -= block(below);
            }
            self.peaks.push(peak);
        }
    }
}

/// The largest power of two that divides a number above 0.
const fn block(number: usize) -> usize {
    1 << number.trailing_zeros()
}
