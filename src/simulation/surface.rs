//! The machined surface, by its exact corners.
//!
//! # How it is kept
//!
//! The surface is a polyline over the stock's width. A cut changes it only between the points where its two flanks
//! come out, and lattices visit neighbouring places one after the other, so the corners are kept in two stacks with the
//! place of work between them: those left of it, nearest last, and those right of it, nearest last too. A cut pops the
//! corners above its flanks and pushes at most three new ones; a corner is popped once, so cutting costs constant time
//! on average. Going elsewhere moves the corners in between from one stack to the other: a sweep over a layer moves each
//! once. The cost of `n` cuts is `O(n)` plus the corners passed on the way from cut to cut, which for sweeps is again
//! `O(n)`.
//!
//! # When a flank comes out
//!
//! A flank rises from the tip with slope `cot(swing)` and comes out at the first point where the surface is not above
//! it: at a corner it touches, in a segment it crosses, or at the stock's side. The height of that point above the tip is
//! the vertical reach the blade needs: beyond `d cos(swing)` the chip is not freed (`docs/process.md`, "One V-cut").
//!
//! # Walls
//!
//! A flank of swing 0 rises straight up and leaves a wall: two corners at one x. There the surface has two heights, one
//! on either side, and [`Surface::height`] is the higher one. What is beside a tip that lies at a wall is looked up on
//! either side: its left flank meets what stands left of the wall, its right flank what stands right of it. The stock's own
//! sides are walls with nothing beyond them.
//!
//! # Single flanks
//!
//! The surface is a height field, so that every point of the material hangs together with the bottom straight below it.
//! A single flank whose tip lies in the material ends there, and all that is above it still hangs on beside the tip: it
//! frees nothing. If the tip lies on the surface or outside, the flank enters the material somewhere, comes out
//! again, and what is above it in between is free.

use vcutc_backend_api::ir::Stock;
use vcutc_geometry::curve::Point2;

mod lower;
mod stack;
#[cfg(test)]
mod tests;
mod vee;
#[cfg(test)]
pub(crate) mod wall_tests;

pub use vee::{Side, Vee};

use stack::{Ray, Stack};

/// Heights this close are equal: a nanometre, a thousandth of the grid that tips lie on. Without it the flank of a cut
/// that passes exactly through an older tip, as interlaced lattices want it, would miss it by rounding.
const TOUCH: f64 = 1e-6;

/// The machined surface over `0 <= x <= width`, or a part of it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Corners with x at or left of the place of work, nearest last; never empty.
    left: Stack,
    /// Corners right of the place of work, nearest last; never empty unless the place of work is the right side.
    right: Stack,
    /// Its left side: 0 over the whole stock.
    from: f64,
    /// Its right side.
    to: f64,
    top: f64,
    /// Slope of the steepest flank cut so far: flanks at least as steep can never meet material again.
    steepest: f64,
}

/// How a flank runs through the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlankRun {
    /// Where it comes out; the tip where it does not enter.
    pub exit: Point2,
    /// Height of that point above the tip.
    pub reach: f64,
    /// x of the tip of the older V in which it comes out; of the exit itself where that is not in one.
    pub met: f64,
    /// Where, beyond its exit, material stands in the way of the blade's body again.
    pub blocked_at: Option<Point2>,
}

/// What a single flank does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Single {
    /// Its tip lies in the material: it frees nothing.
    Inside,
    /// It stays outside of the material.
    Outside,
    /// It takes a piece off, between where it enters and where it comes out.
    Frees(FlankRun),
}

/// A walk along one flank: how many corners lie above it, and where it comes out.
#[derive(Clone, Copy)]
struct FlankWalk {
    passed: usize,
    exit: Point2,
    met: f64,
}

/// Where a single flank runs into the material.
#[derive(Clone, Copy)]
struct Entry {
    /// Corners that it passes above before.
    passed: usize,
    at: Point2,
    /// The first point of the surface above it.
    above: Point2,
    /// Whether that is straight above the tip, which then lies at a wall.
    is_at_wall: bool,
}

impl Surface {
    /// The top of a stock before the first cut.
    #[must_use]
    pub fn untouched(stock: Stock) -> Self {
        Self::flat(stock.width.to_mm(), stock.height.to_mm())
    }

    /// A flat top of that width and height.
    #[must_use]
    pub fn flat(width: f64, top: f64) -> Self {
        Self {
            left: Stack::of(Point2 { x: 0.0, z: top }),
            right: Stack::of(Point2 { x: width, z: top }),
            from: 0.0,
            to: width,
            top,
            steepest: 0.0,
        }
    }

    /// The part of it between two x, with nothing beyond these.
    #[must_use]
    pub fn part(&mut self, from: f64, to: f64) -> Self {
        let (from, to) = (from.max(self.from), to.min(self.to));
        let mut part = Self {
            left: Stack::of(Point2 {
                x: from,
                z: self.height(from),
            }),
            right: Stack::of(Point2 {
                x: to,
                z: self.height(to),
            }),
            from,
            to,
            top: self.top,
            steepest: self.steepest,
        };
        self.corners_between(from, to)
            .filter(|corner| corner.x < to)
            .for_each(|corner| part.left.push(corner));
        part
    }

    /// Its right side: the width of the stock.
    #[must_use]
    pub const fn width(&self) -> f64 {
        self.to
    }

    /// Height of the stock.
    #[must_use]
    pub const fn top(&self) -> f64 {
        self.top
    }

    /// Height at x; at a wall the higher one of both.
    pub fn height(&mut self, x: f64) -> f64 {
        let [left, right] = self.heights(x);
        left.max(right)
    }

    /// The highest of it between two places; that at the nearer side of the stock where both lie beyond it.
    pub fn highest(&mut self, from: f64, to: f64) -> f64 {
        let (from, to) = (from.clamp(self.from, self.to), to.clamp(self.from, self.to));
        let ends = self.height(from).max(self.height(to));
        self.corners_between(from, to)
            .map(|corner| corner.z)
            .fold(ends, f64::max)
    }

    /// Heights at x just left and just right of it: they differ at a wall, and nowhere else. At a side of the stock both
    /// are that of the side within.
    pub fn heights(&mut self, x: f64) -> [f64; 2] {
        self.go_between(x);
        self.heights_here(x)
    }

    /// Whether a V with this tip would cut anything at its tip: whether the surface is above it on either side.
    pub fn covers(&mut self, tip: Point2) -> bool {
        self.height(tip.x) > tip.z + TOUCH
    }

    /// How one flank of a V would run through the present surface. The tip should be covered.
    pub fn flank(&mut self, vee: Vee, side: Side) -> FlankRun {
        self.go_between(vee.tip.x);
        let height = self.height_beside(vee.tip.x, side);
        vee.ray(side).map_or_else(
            || FlankRun {
                exit: vee.tip,
                reach: 0.0,
                met: vee.tip.x,
                blocked_at: None,
            },
            |ray| self.run(ray, side, height),
        )
    }

    /// How a flank of that slope would run from a tip; none where the surface does not cover the tip.
    pub fn flank_from(&mut self, tip: Point2, side: Side, slope: f64) -> Option<FlankRun> {
        self.go_between(tip.x);
        let [left, right] = self.heights_here(tip.x);
        let height = match side {
            Side::Left => left,
            Side::Right => right,
        };
        let is_covered = [left, right].into_iter().any(|height| height > tip.z + TOUCH);
        is_covered.then(|| self.run(Ray { tip, slope }, side, height))
    }

    /// How a flank runs from the place of work, where the surface is that high.
    fn run(&mut self, ray: Ray, side: Side, height: f64) -> FlankRun {
        let walk = self.walk_from_tip(ray, side, height);
        FlankRun {
            exit: walk.exit,
            met: walk.met,
            reach: walk.exit.z - ray.tip.z,
            blocked_at: self.beyond(ray, side, walk.passed),
        }
    }

    /// Where material stands above a V whose tip is not covered. Only where steeper flanks have been cut before can there be
    /// any: the tip then lies in an older, narrower cut, and the V would cut its walls from below.
    pub fn obstacle(&mut self, vee: Vee) -> Option<Point2> {
        self.go_between(vee.tip.x);
        [Side::Left, Side::Right]
            .into_iter()
            .find_map(|side| self.beyond(vee.ray(side)?, side, 0))
    }

    /// What the only flank of a cut does; not for a V of two flanks.
    pub fn single(&mut self, vee: Vee) -> Single {
        let Some((vee, side, ray)) = self.single_ray(vee) else {
            return Single::Outside;
        };
        if self.is_within(vee.tip) {
            return Single::Inside;
        }
        let Some(entry) = self.entry(ray, side) else {
            return Single::Outside;
        };
        let walk = self.stack(side).walk(ray, entry.passed, entry.above);
        Single::Frees(FlankRun {
            exit: walk.exit,
            met: walk.met,
            reach: walk.exit.z - vee.tip.z,
            blocked_at: self.beyond(ray, side, walk.passed),
        })
    }

    /// Whether flanks of that slope can never meet material again once they are out: none that was cut before is steeper.
    #[must_use]
    #[inline]
    pub fn is_final_for(&self, slope: f64) -> bool {
        slope >= self.steepest - 1e-12
    }

    /// The chip that a cut would take out: its outline from where the left flank comes out along the surface to where the
    /// right one does, and last the tip; that of a single flank along the surface from one end of the flank to the other. None
    /// for a cut that takes nothing out.
    pub fn chip(&mut self, vee: Vee) -> Option<Vec<Point2>> {
        let mut outline = Vec::new();
        if vee.is_single() {
            let (_, side, ray) = self.single_ray(vee)?;
            let (entry, walk) = self.piece(ray, side)?;
            if entry.is_at_wall {
                return self.chip(Vee { tip: ray.tip, ..vee }.walled());
            }
            let corners = self.stack(side).corners();
            let over = corners.iter().rev().take(walk.passed).skip(entry.passed);
            outline.push(entry.at);
            outline.extend(over);
            outline.push(walk.exit);
            if side == Side::Left {
                outline.reverse();
            }
            return Some(outline);
        }
        let [left, right] = self.walks(vee)?;
        outline.push(left.exit);
        outline.extend(self.left.nearest(left.passed));
        outline.extend(self.right.nearest(right.passed).iter().rev());
        outline.extend([right.exit, vee.tip]);
        Some(outline)
    }

    /// Takes out what a cut frees. A V whose tip is not covered changes nothing, and neither does a single flank whose tip is
    /// in the material.
    pub fn release(&mut self, vee: Vee) {
        if vee.is_single() {
            self.release_single(vee);
            return;
        }
        let Some([left, right]) = self.walks(vee) else {
            return;
        };
        self.left.drop_nearest(left.passed);
        self.right.drop_nearest(right.passed);
        self.left.push_corner(left.exit);
        self.left.push_corner(vee.tip);
        // A right flank that comes out where it starts leaves what stands right of the tip as it is.
        let ends_at_tip = right.exit.x - vee.tip.x <= TOUCH && right.exit.z - vee.tip.z <= TOUCH;
        if !ends_at_tip {
            self.right.push_corner(right.exit);
        } else if self.right.last().is_some_and(|corner| is_same(corner, vee.tip)) {
            self.right.drop_nearest(1);
        }
        self.note_slopes(vee);
    }

    fn release_single(&mut self, vee: Vee) {
        let Some((_, side, ray)) = self.single_ray(vee) else {
            return;
        };
        let Some((entry, walk)) = self.piece(ray, side) else {
            return;
        };
        if entry.is_at_wall {
            // As a V, of whose other flank nothing is in the material.
            self.release(Vee { tip: ray.tip, ..vee }.walled());
            return;
        }
        let stack = self.stack_mut(side);
        let before: Vec<Point2> = stack.nearest(entry.passed).to_vec();
        stack.drop_nearest(walk.passed);
        stack.push_corner(walk.exit);
        stack.push_corner(entry.at);
        for corner in before {
            stack.push_corner(corner);
        }
        self.note_slopes(vee);
    }

    fn note_slopes(&mut self, vee: Vee) {
        for slope in [vee.left, vee.right].into_iter().flatten() {
            if slope > self.steepest {
                self.steepest = slope;
            }
        }
    }

    /// The corners from left to right.
    pub fn corners(&self) -> impl Iterator<Item = Point2> + '_ {
        let (left, right) = (self.left.corners(), self.right.corners());
        left.iter().chain(right.iter().rev()).copied()
    }

    /// The corners between two x, from left to right; those of a wall at the first x are left out.
    pub fn corners_between(&mut self, from: f64, to: f64) -> impl Iterator<Item = Point2> + '_ {
        self.go_to(from);
        self.right
            .corners()
            .iter()
            .rev()
            .copied()
            .take_while(move |corner| corner.x <= to)
    }

    /// The surface between two x: its corners there, and its points at both, as far as they are over the stock. Of a wall at
    /// either x it has the height within the stretch.
    pub fn stretch(&mut self, from: f64, to: f64) -> impl Iterator<Item = Point2> + '_ {
        let (from, to) = (from.max(self.from), to.min(self.to));
        self.go_to(from);
        let first = Point2 {
            x: from,
            z: self.height_here(from),
        };
        let mut before = Some(first);
        let rest = self.right.corners().iter().rev().map_while(move |&corner| {
            let last = before?;
            if corner.x < to {
                before = Some(corner);
                return Some(corner);
            }
            before = None;
            let share = (to - last.x) / (corner.x - last.x);
            Some(Point2 {
                x: to,
                z: last.z + (corner.z - last.z) * share,
            })
        });
        core::iter::once(first).chain(rest).filter(move |_| from <= to)
    }

    /// Moves the place of work to x, which is nearly always a neighbour's. Both corners of a wall at x are left of it then.
    fn go_to(&mut self, x: f64) {
        self.left.pass_on(&mut self.right, |corner| corner.x > x);
        self.right.pass_on(&mut self.left, |corner| corner.x <= x);
    }

    /// Moves the place of work to x, and at a wall between its two corners.
    #[inline]
    fn go_between(&mut self, x: f64) {
        if !self.is_between(x) {
            self.move_between(x);
        }
    }

    /// Whether the place of work is at x, and no wall is there. Both flanks of a V and its chip are asked for at one x.
    #[inline]
    fn is_between(&self, x: f64) -> bool {
        let (Some(left), Some(right)) = (self.left.last(), self.right.last()) else {
            return false;
        };
        let is_apart = |corner: Point2| corner.x < x - TOUCH;
        left.x <= x && right.x > x + TOUCH && (is_apart(left) || self.left.second().is_none_or(is_apart))
    }

    fn move_between(&mut self, x: f64) {
        self.go_to(x);
        let stands_at = |corner: Option<Point2>| corner.is_some_and(|corner| (corner.x - x).abs() <= TOUCH);
        if stands_at(self.left.last()) {
            while stands_at(self.left.second())
                && let Some(corner) = self.left.pop()
            {
                self.right.push(corner);
            }
        } else if stands_at(self.right.last())
            && stands_at(self.right.second())
            && let Some(corner) = self.right.pop()
        {
            self.left.push(corner);
        }
    }

    /// How both flanks of a V run from its tip, to where they come out. None for one that takes nothing out.
    fn walks(&mut self, vee: Vee) -> Option<[FlankWalk; 2]> {
        self.go_between(vee.tip.x);
        let heights = self.heights_here(vee.tip.x);
        if heights.iter().all(|&height| height <= vee.tip.z + TOUCH) {
            return None;
        }
        let (left, right) = (vee.ray(Side::Left)?, vee.ray(Side::Right)?);
        let walks = [
            self.walk_from_tip(left, Side::Left, heights[0]),
            self.walk_from_tip(right, Side::Right, heights[1]),
        ];
        // Between two walls that rise from one tip is nothing.
        (walks[0].exit.x < walks[1].exit.x).then_some(walks)
    }

    /// Follows a flank from the place of work (which is the tip's x), where the surface is that high, to where it comes out.
    fn walk_from_tip(&self, ray: Ray, side: Side, height: f64) -> FlankWalk {
        let stack = self.stack(side);
        let tip = ray.tip;
        if self.is_at_side(tip.x, side) {
            return stack.all(ray);
        }
        if height <= tip.z + TOUCH {
            return FlankWalk {
                passed: 0,
                exit: tip,
                met: tip.x,
            };
        }
        let start = Point2 { x: tip.x, z: height };
        if ray.is_wall() {
            return FlankWalk {
                passed: 0,
                exit: start,
                met: tip.x,
            };
        }
        stack.walk(ray, 0, start)
    }

    /// The only flank of a cut, with the place of work at its tip. A tip beside the stock is moved along the flank to the
    /// stock's side.
    fn single_ray(&mut self, vee: Vee) -> Option<(Vee, Side, Ray)> {
        let side = match (vee.left, vee.right) {
            (Some(_), None) => Side::Left,
            (None, Some(_)) => Side::Right,
            (Some(_), Some(_)) | (None, None) => return None,
        };
        let mut ray = vee.ray(side)?;
        let x = ray.tip.x.clamp(self.from, self.to);
        let inwards = match side {
            Side::Left => x < ray.tip.x,
            Side::Right => x > ray.tip.x,
        };
        if x != ray.tip.x {
            if !inwards || ray.is_wall() {
                return None;
            }
            ray.tip = Point2 { x, z: ray.height(x) };
        }
        self.go_between(x);
        Some((vee, side, ray))
    }

    /// What a single flank takes out: where it enters, and how it runs from the place of work to where it comes out.
    fn piece(&self, ray: Ray, side: Side) -> Option<(Entry, FlankWalk)> {
        if self.is_within(ray.tip) {
            return None;
        }
        let entry = self.entry(ray, side)?;
        Some((entry, self.stack(side).walk(ray, entry.passed, entry.above)))
    }

    /// Where a single flank runs into the material, if it does. A wall never does: it would have to come from below.
    fn entry(&self, ray: Ray, side: Side) -> Option<Entry> {
        let tip = ray.tip;
        if ray.is_wall() || self.is_at_side(tip.x, side) {
            return None;
        }
        let height = self.height_beside(tip.x, side);
        let start = Point2 { x: tip.x, z: height };
        if height > tip.z + TOUCH {
            return Some(Entry {
                passed: 0,
                at: tip,
                above: start,
                is_at_wall: true,
            });
        }
        self.stack(side).entry(ray, start, self.top)
    }

    /// Whether a tip lies in the material: with material above it on both sides.
    fn is_within(&self, tip: Point2) -> bool {
        [Side::Left, Side::Right]
            .into_iter()
            .all(|side| !self.is_at_side(tip.x, side) && self.height_beside(tip.x, side) > tip.z + TOUCH)
    }

    /// The first corner beyond a flank's exit that stands above it.
    #[inline]
    fn beyond(&mut self, ray: Ray, side: Side, passed: usize) -> Option<Point2> {
        if self.is_final_for(ray.slope) {
            return None;
        }
        let top = self.top;
        self.stack_mut(side).beyond(ray, passed, top)
    }

    const fn stack(&self, side: Side) -> &Stack {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    const fn stack_mut(&mut self, side: Side) -> &mut Stack {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }

    /// Whether the stock ends at x on that side.
    fn is_at_side(&self, x: f64, side: Side) -> bool {
        match side {
            Side::Left => x <= self.from + TOUCH,
            Side::Right => x >= self.to - TOUCH,
        }
    }

    /// Heights just left and just right of the place of work, which is between the corners of a wall there.
    fn heights_here(&self, x: f64) -> [f64; 2] {
        let at = |corner: Option<Point2>| corner.filter(|corner| (corner.x - x).abs() <= TOUCH);
        match (at(self.left.last()), at(self.right.last())) {
            (Some(left), Some(right)) => [left.z, right.z],
            (Some(both), None) | (None, Some(both)) => [both.z; 2],
            (None, None) => [self.height_here(x); 2],
        }
    }

    /// The one of them on that side.
    fn height_beside(&self, x: f64, side: Side) -> f64 {
        let [left, right] = self.heights_here(x);
        match side {
            Side::Left => left,
            Side::Right => right,
        }
    }

    /// Height at the place of work, which is not at a wall.
    fn height_here(&self, x: f64) -> f64 {
        match (self.left.last(), self.right.last()) {
            (Some(a), Some(b)) if b.x - a.x > TOUCH => a.z + (b.z - a.z) * ((x - a.x) / (b.x - a.x)),
            (Some(a), Some(_)) => a.z,
            (Some(a), None) | (None, Some(a)) => a.z,
            (None, None) => self.top,
        }
    }
}

/// Whether two corners are one, but for rounding.
fn is_same(a: Point2, b: Point2) -> bool {
    (a.x - b.x).abs() < TOUCH && (a.z - b.z).abs() < TOUCH
}
