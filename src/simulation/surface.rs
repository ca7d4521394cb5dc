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

use vcutc_backend_api::ir::Stock;
use vcutc_geometry::curve::Point2;

/// Heights this close are equal: a nanometre, a thousandth of the grid that tips lie on. Without it the flank of a cut
/// that passes exactly through an older tip, as interlaced lattices want it, would miss it by rounding.
const TOUCH: f64 = 1e-6;

/// The machined surface over `0 <= x <= width`.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Corners with x at or left of the place of work, nearest last; never empty.
    left: Vec<Point2>,
    /// Corners right of the place of work, nearest last; never empty unless the place of work is the right side.
    right: Vec<Point2>,
    width: f64,
    top: f64,
    /// Slope of the steepest flank cut so far: flanks at least as steep can never meet material again.
    steepest: f64,
}

/// The V that a cut makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vee {
    /// Where the flanks meet.
    pub tip: Point2,
    /// Rise of the flanks over x: `cot(swing)`; positive.
    pub slope: f64,
}

/// A side of a V.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Towards -x.
    Left,
    /// Towards +x.
    Right,
}

/// How a flank runs through the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlankRun {
    /// Where it comes out.
    pub exit: Point2,
    /// Height of that point above the tip.
    pub reach: f64,
    /// x of the tip of the older V in which it comes out; of the exit itself where that is not in one.
    pub met: f64,
    /// Where, beyond its exit, material stands in the way of the blade's body again.
    pub blocked_at: Option<Point2>,
}

/// A walk along one flank: how many corners lie above it, and where it comes out.
struct FlankWalk {
    passed: usize,
    exit: Point2,
    met: f64,
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
            left: vec![Point2 { x: 0.0, z: top }],
            right: vec![Point2 { x: width, z: top }],
            width,
            top,
            steepest: 0.0,
        }
    }

    /// Width of the stock.
    #[must_use]
    pub const fn width(&self) -> f64 {
        self.width
    }

    /// Height of the stock.
    #[must_use]
    pub const fn top(&self) -> f64 {
        self.top
    }

    pub fn height(&mut self, x: f64) -> f64 {
        self.go_to(x);
        self.height_here(x)
    }

    /// Whether a V with this tip would cut anything at its tip.
    pub fn covers(&mut self, tip: Point2) -> bool {
        self.height(tip.x) > tip.z + TOUCH
    }

    /// How one flank of a V would run through the present surface. The tip should be covered.
    pub fn flank(&mut self, vee: Vee, side: Side) -> FlankRun {
        self.go_to(vee.tip.x);
        let walk = self.walk(vee, side);
        let blocked_at = if self.is_final_for(vee.slope) {
            None
        } else {
            self.beyond(vee, side, walk.passed)
        };
        FlankRun {
            exit: walk.exit,
            met: walk.met,
            reach: walk.exit.z - vee.tip.z,
            blocked_at,
        }
    }

    /// Where material stands above a V whose tip is not covered. Only where steeper flanks have been cut before can there be
    /// any: the tip then lies in an older, narrower cut, and the V would cut its walls from below.
    pub fn obstacle(&mut self, vee: Vee) -> Option<Point2> {
        self.go_to(vee.tip.x);
        if self.is_final_for(vee.slope) {
            return None;
        }
        self.beyond(vee, Side::Left, 0)
            .or_else(|| self.beyond(vee, Side::Right, 0))
    }

    /// Whether flanks of that slope can never meet material again once they are out: none that was cut before is steeper.
    #[must_use]
    pub fn is_final_for(&self, slope: f64) -> bool {
        slope >= self.steepest - 1e-12
    }

    /// The chip that a V would take out: its outline from where the left flank comes out along the surface to where the right
    /// one does, and last the tip. None for a V whose tip is not covered.
    pub fn chip(&mut self, vee: Vee) -> Option<Vec<Point2>> {
        if !self.covers(vee.tip) {
            return None;
        }
        let left = self.walk(vee, Side::Left);
        let right = self.walk(vee, Side::Right);
        let mut outline = vec![left.exit];
        outline.extend(self.left.iter().skip(self.left.len() - left.passed));
        outline.extend(self.right.iter().rev().take(right.passed));
        outline.extend([right.exit, vee.tip]);
        Some(outline)
    }

    /// Takes the chip of a V out. A V whose tip is not covered changes nothing.
    pub fn release(&mut self, vee: Vee) {
        if !self.covers(vee.tip) {
            return;
        }
        let left = self.walk(vee, Side::Left);
        let right = self.walk(vee, Side::Right);
        self.left.truncate(self.left.len() - left.passed);
        self.right.truncate(self.right.len() - right.passed);
        push_corner(&mut self.left, left.exit);
        push_corner(&mut self.left, vee.tip);
        if right.exit.x - vee.tip.x > TOUCH {
            push_corner(&mut self.right, right.exit);
        }
        self.steepest = self.steepest.max(vee.slope);
    }

    /// The corners from left to right.
    pub fn corners(&self) -> impl Iterator<Item = Point2> + '_ {
        self.left.iter().chain(self.right.iter().rev()).copied()
    }

    /// The corners between two x, from left to right.
    pub fn corners_between(&mut self, from: f64, to: f64) -> impl Iterator<Item = Point2> + '_ {
        self.go_to(from);
        self.right
            .iter()
            .rev()
            .copied()
            .take_while(move |corner| corner.x <= to)
    }

    /// The surface between two x: its corners there, and its points at both, as far as they are over the stock.
    pub fn stretch(&mut self, from: f64, to: f64) -> impl Iterator<Item = Point2> + '_ {
        let (from, to) = (from.max(0.0), to.min(self.width));
        self.go_to(from);
        let first = Point2 {
            x: from,
            z: self.height_here(from),
        };
        let mut before = Some(first);
        let rest = self.right.iter().rev().map_while(move |&corner| {
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

    /// Moves the place of work to x: corner by corner, because it is nearly always a neighbour's.
    fn go_to(&mut self, x: f64) {
        while let Some(corner) = self.left.pop_if(|corner| corner.x > x) {
            self.right.push(corner);
        }
        while let Some(corner) = self.right.pop_if(|corner| corner.x <= x) {
            self.left.push(corner);
        }
    }

    /// Follows a flank from the place of work (which is the tip's x) to where it comes out.
    fn walk(&self, vee: Vee, side: Side) -> FlankWalk {
        let stack = self.stack(side);
        let mut before = Point2 {
            x: vee.tip.x,
            z: self.height_here(vee.tip.x),
        };
        for (passed, &corner) in stack.iter().rev().enumerate() {
            let above = corner.z - vee.height(corner.x);
            if above > TOUCH {
                before = corner;
                continue;
            }
            let above_before = before.z - vee.height(before.x);
            // The surface comes down from `before` to `corner` through the flank, or touches it in `corner`.
            let share = if above >= -TOUCH {
                1.0
            } else {
                above_before / (above_before - above)
            };
            let x = before.x + (corner.x - before.x) * share;
            let exit = Point2 { x, z: vee.height(x) };
            // The surface falls from the exit to the older tip, unless it is the stock's flat top.
            let met = if corner.z < exit.z - TOUCH { corner.x } else { x };
            return FlankWalk { passed, exit, met };
        }
        // Out at the side of the stock.
        let x = before.x;
        FlankWalk {
            passed: stack.len(),
            exit: Point2 { x, z: vee.height(x) },
            met: x,
        }
    }

    /// The first corner beyond a flank's exit that stands above it.
    fn beyond(&self, vee: Vee, side: Side, passed: usize) -> Option<Point2> {
        let corners = self.stack(side).iter().rev().skip(passed);
        corners
            .take_while(|corner| vee.height(corner.x) < self.top)
            .find(|corner| corner.z > vee.height(corner.x) + TOUCH)
            .copied()
    }

    fn stack(&self, side: Side) -> &[Point2] {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// Height at the place of work.
    fn height_here(&self, x: f64) -> f64 {
        match (self.left.last(), self.right.last()) {
            (Some(&a), Some(&b)) if b.x - a.x > TOUCH => a.z + (b.z - a.z) * ((x - a.x) / (b.x - a.x)),
            (Some(&a), Some(_)) => a.z,
            (Some(&a), None) | (None, Some(&a)) => a.z,
            (None, None) => self.top,
        }
    }
}

impl Vee {
    /// Height of the V over x.
    #[must_use]
    pub fn height(self, x: f64) -> f64 {
        self.tip.z + (x - self.tip.x).abs() * self.slope
    }
}

/// Pushes a corner unless it is the one already there.
fn push_corner(stack: &mut Vec<Point2>, corner: Point2) {
    if let Some(last) = stack.last_mut()
        && (last.x - corner.x).abs() < TOUCH
    {
        last.z = last.z.min(corner.z);
        return;
    }
    stack.push(corner);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The envelope by its definition.
    fn lowest(top: f64, vees: &[Vee], x: f64) -> f64 {
        vees.iter().map(|vee| vee.height(x)).fold(top, f64::min)
    }

    /// Where a flank comes out, by looking every hundredth of a millimetre, and at the older tips, whose Vs may be
    /// narrower than that where the flank passes just above them.
    fn exit_by_sampling(width: f64, top: f64, vees: &[Vee], vee: Vee, side: Side) -> f64 {
        let (sense, room) = match side {
            Side::Left => (-1.0, vee.tip.x),
            Side::Right => (1.0, width - vee.tip.x),
        };
        let steps = (0..10_001).map(|step| f64::from(step) * 0.01);
        let tips = vees.iter().map(|older| (older.tip.x - vee.tip.x) * sense);
        let mut distances: Vec<f64> = steps
            .chain(tips)
            .filter(|far| (0.0..=room).contains(far))
            .collect();
        distances.sort_by(f64::total_cmp);
        let x_at = |far: f64| vee.tip.x + sense * far;
        let comes_out = |&far: &f64| lowest(top, vees, x_at(far)) <= vee.height(x_at(far));
        let exit = distances.into_iter().find(comes_out).unwrap_or(room);
        vee.height(x_at(exit)) - vee.tip.z
    }

    fn a_vee() -> impl Strategy<Value = Vee> {
        (
            0.0..100.0_f64,
            1.0..40.0_f64,
            prop::sample::select(vec![0.7, 1.0, 1.5]),
        )
            .prop_map(|(x, z, slope)| Vee {
                tip: Point2 { x, z },
                slope,
            })
    }

    /// Releases the Vs that a program may release: tip in the material, blade's body clear. Gives those back.
    fn release_possible(surface: &mut Surface, vees: &[Vee]) -> Vec<Vee> {
        let possible = |surface: &mut Surface, vee: Vee| {
            surface.covers(vee.tip)
                && [Side::Left, Side::Right]
                    .into_iter()
                    .all(|side| surface.flank(vee, side).blocked_at.is_none())
        };
        let mut released = Vec::new();
        for &vee in vees {
            if possible(surface, vee) {
                surface.release(vee);
                released.push(vee);
            }
        }
        released
    }

    proptest! {
        #[test]
        fn is_the_lower_envelope(vees in prop::collection::vec(a_vee(), 0..60), xs in prop::collection::vec(0.0..=100.0_f64, 20)) {
            let mut surface = Surface::flat(100.0, 40.0);
            let vees = release_possible(&mut surface, &vees);
            for x in xs {
                prop_assert!((surface.height(x) - lowest(40.0, &vees, x)).abs() < 1e-5);
            }
            let corners: Vec<_> = surface.corners().collect();
            prop_assert!(corners.windows(2).all(|pair| pair[0].x < pair[1].x));
            prop_assert!(corners[0].x.abs() < 1e-9 && (corners[corners.len() - 1].x - 100.0).abs() < 1e-9);
        }

        #[test]
        fn flanks_come_out_where_the_surface_is_below(vees in prop::collection::vec(a_vee(), 0..30), vee in a_vee()) {
            let mut surface = Surface::flat(100.0, 40.0);
            let vees = release_possible(&mut surface, &vees);
            prop_assume!(surface.covers(vee.tip));
            for side in [Side::Left, Side::Right] {
                let sampled = exit_by_sampling(100.0, 40.0, &vees, vee, side);
                let run = surface.flank(vee, side);
                // Looking from hundredth to hundredth passes over narrower gaps: it may find the exit later, not earlier.
                prop_assert!(run.reach < sampled + 0.04, "{:?} {}", run, sampled);
                let at_side = !(1e-9..=100.0 - 1e-9).contains(&run.exit.x);
                let below = lowest(40.0, &vees, run.exit.x) - run.exit.z;
                prop_assert!(at_side || below < 1e-5, "{:?} is {} below", run, below);
            }
        }
    }

    #[test]
    fn cuts_at_the_sides_of_the_stock() {
        let mut surface = Surface::flat(10.0, 10.0);
        for x in [0.0, 10.0] {
            let vee = Vee {
                tip: Point2 { x, z: 5.0 },
                slope: 1.0,
            };
            assert_eq!(
                surface
                    .flank(vee, if x > 0.0 { Side::Right } else { Side::Left })
                    .reach,
                0.0
            );
            surface.release(vee);
        }
        assert_eq!(surface.height(0.0), 5.0);
        assert_eq!(surface.height(10.0), 5.0);
        assert_eq!(surface.height(5.0), 10.0);
        assert_eq!(surface.height(2.0), 7.0);
    }

    #[test]
    fn a_wide_cut_next_to_a_steep_wall_is_blocked_above_its_exit() {
        let mut surface = Surface::flat(100.0, 40.0);
        // A narrow slot leaves a steep wall; a wide V beside it comes out in the slot, but its blade runs on into the wall.
        surface.release(Vee {
            tip: Point2 { x: 50.0, z: 10.0 },
            slope: 10.0,
        });
        let wide = Vee {
            tip: Point2 { x: 45.0, z: 12.0 },
            slope: 1.0,
        };
        let run = surface.flank(wide, Side::Right);
        assert!(run.exit.x < 50.0);
        assert_eq!(run.blocked_at, Some(Point2 { x: 53.0, z: 40.0 }));
        assert_eq!(surface.flank(wide, Side::Left).blocked_at, None);
    }

    /// Cuts every lattice point of the 85 x 50 mm block above z = 13.1: cuts, layers, removed area, longest edge needed by
    /// a blade with rake - half apex = 52.87 degrees.
    fn block(layer: f64, step: f64, swing: f64, first: f64, shift: f64) -> (usize, u32, f64, f64) {
        let swing = vcutc_backend_api::units::Angle::deg(swing);
        let lead = vcutc_backend_api::units::Angle::deg(52.87);
        let mut surface = Surface::flat(85.0, 50.0);
        let (mut cuts, mut reach, mut j) = (0, 0.0_f64, 0);
        while 50.0 - f64::from(j + 1) * layer >= 13.1 {
            j += 1;
            let mut x = if j % 2 == 0 { first + shift } else { first };
            while x <= 85.0 {
                let vee = Vee {
                    tip: Point2 {
                        x,
                        z: 50.0 - f64::from(j) * layer,
                    },
                    slope: 1.0 / swing.tan(),
                };
                reach = reach
                    .max(surface.flank(vee, Side::Left).reach)
                    .max(surface.flank(vee, Side::Right).reach);
                surface.release(vee);
                cuts += 1;
                x += step;
            }
        }
        let corners: Vec<_> = surface.corners().collect();
        let removed = corners
            .windows(2)
            .map(|p| (p[1].x - p[0].x) * (50.0 - (p[0].z + p[1].z) / 2.0))
            .sum();
        (cuts, j, removed, reach / (swing.cos() * lead.sin()))
    }

    /// The table of `docs/process.md`, "Lattices and reach", which a simulation of polygons confirmed.
    #[test]
    fn agrees_with_the_polygon_simulation() {
        let (cuts, layers, removed, edge) = block(4.40, 5.97, 34.16, 5.97 / 2.0, 0.0);
        assert_eq!((cuts, layers), (112, 8));
        assert!((removed - 2799.0).abs() < 2.0 && edge < 10.01, "{removed} {edge}");
        let (cuts, layers, removed, edge) = block(6.470, 4.658, 35.75, 4.658 / 2.0, 0.0);
        assert_eq!((cuts, layers), (90, 5));
        assert!((removed - 2609.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
        // Interlaced: the step of 11.909 is rounded down from 2 h tan(50 deg) = 11.9105, a hair over works.
        let (cuts, layers, removed, edge) = block(4.997, 11.911, 50.0, 0.0, 11.911 / 2.0);
        assert_eq!((cuts, layers), (53, 7));
        assert!((removed - 2764.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
        let (cuts, layers, removed, edge) = block(6.0, 10.07, 40.0, 0.0, 10.07 / 2.0);
        assert_eq!((cuts, layers), (51, 6));
        assert!((removed - 2780.0).abs() < 1.0 && edge <= 10.0, "{removed} {edge}");
        // One per cent of overlap makes interlaced cuts pass under their neighbours and need about 2h.
        let (_, _, _, edge) = block(6.0, 9.97, 40.0, 0.0, 9.97 / 2.0);
        assert!((edge - 2.0 * 9.82).abs() < 0.5, "{edge}");
    }
}
