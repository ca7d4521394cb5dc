//! Which spine suits a surface, and the surface with a spine taken off.
//!
//! Cuts along a spine `s(y)` stay above the greatest height `f(x)` of `p - s` over each x, so they leave `f + s - p`. The sum of a
//! function of x and one of y that comes nearest to `p` is found by levelling rows and columns in turn (Diliberto and Straus: On the
//! approximation of a function of several variables by the sum of functions of fewer variables, 1951), here on a grid of heights.
//! What comes out is smoothed, because a blade that follows a sharp bend lies off its tips. Any spine is right: what is cut is
//! kept out of the surface itself, not of the grid.

use crate::knots::{Place, Rule, knots};
use crate::surface::{Surface, SurfaceError, clipped};
use vcutc_geometry::grid;
use vcutc_geometry::spine::{Knot, Spine};

/// How cuts may rise and fall along the work, all of them alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rising {
    /// At one slope.
    Evenly,
    /// As they like.
    Freely,
}

/// A spine that suits a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The spine.
    pub spine: Spine,
    /// How high material stays above the surface at most, in mm, where cuts are infinitely close: as a grid of heights shows it, with
    /// what a blade that reaches [`OVERHANG`] ahead lies off its tips.
    pub leaves: f64,
}

/// How far a blade is taken to lie ahead of its tip where spines are chosen, in mm.
pub(crate) const OVERHANG: f64 = 25.0;

/// Heights across and along the work that are looked at.
const COLUMNS: u32 = 48;
pub(crate) const ROWS: usize = 161;

/// How often rows and columns are levelled. Every time the rest falls, first fast, then hardly.
const LEVELLINGS: usize = 40;

/// Spines are smoothed so often at most: each time over twice as many neighbours.
pub(crate) const MOST_SMOOTHINGS: u32 = 12;

impl Surface {
    /// The surface with a spine taken off its heights. Triangles are divided at the knots, so that it is exact up to rounding.
    ///
    /// # Errors
    /// See [`SurfaceError`].
    pub fn levelled(&self, spine: &Spine) -> Result<Self, SurfaceError> {
        let [width, _] = self.size();
        let knots = spine.knots();
        let (mut corners, mut triangles) = (Vec::new(), Vec::new());
        for &named in self.mesh().triangles() {
            let face = self.mesh().face(named);
            let (low, high) = face
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), corner| {
                    (low.min(corner.y), high.max(corner.y))
                });
            let first = knots.partition_point(|knot| knot.y <= low);
            let first = first.clamp(1, knots.len() - 1) - 1;
            let pieces = knots.windows(2).skip(first);
            for piece in pieces.take_while(|piece| piece[0].y < high || piece[0].y <= low) {
                let mut polygon = clipped(&face, [0.0, piece[0].y], [width, piece[1].y]);
                polygon.dedup();
                if polygon.len() < 3 {
                    continue;
                }
                for corner in &mut polygon {
                    corner.z -= spine.rise(corner.y);
                }
                let start = corners.len() as u32;
                let fan = 1..polygon.len() as u32 - 1;
                triangles.extend(fan.map(|i| [start, start + i, start + i + 1]));
                corners.extend(polygon);
            }
        }
        Self::of(corners, triangles, self.plan(), self.accuracy())
    }

    /// How high material stays above the surface at most where straight cuts are infinitely close, in mm, as a grid of heights
    /// shows it.
    #[must_use]
    pub fn left_by_straight_cuts(&self) -> f64 {
        Heights::of(self).left(&[0.0; ROWS])
    }

    /// The spine that leaves the least, as far as a grid of heights shows; none where that is level.
    #[must_use]
    pub fn spine(&self, rising: Rising) -> Option<Fitted> {
        let heights = Heights::of(self);
        match rising {
            Rising::Evenly => heights.even_spine(),
            Rising::Freely => heights.free_spine(),
        }
    }
}

/// Heights on a grid, row by row from y = 0 on.
struct Heights {
    rows: Vec<Vec<f64>>,
    depth: f64,
}

impl Heights {
    fn of(surface: &Surface) -> Self {
        let [width, depth] = surface.size();
        let row = |number: usize| {
            let y = depth * number as f64 / (ROWS - 1) as f64;
            let x = |column: u32| width * f64::from(column) / f64::from(COLUMNS - 1);
            let heights = (0..COLUMNS).map(|column| surface.height(x(column), y));
            // Where there is a gap the bottom of the stock counts.
            heights.map(|height| height.unwrap_or(0.0)).collect()
        };
        Self {
            rows: (0..ROWS).map(row).collect(),
            depth,
        }
    }

    /// The least and the greatest of `p - s` over each x.
    fn columns(&self, rises: &[f64]) -> Vec<[f64; 2]> {
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; COLUMNS as usize];
        for (row, rise) in self.rows.iter().zip(rises) {
            for ([least, most], height) in ranges.iter_mut().zip(row) {
                *least = least.min(height - rise);
                *most = most.max(height - rise);
            }
        }
        ranges
    }

    /// What cuts leave that rise so.
    fn left(&self, rises: &[f64]) -> f64 {
        let ranges = self.columns(rises);
        ranges
            .iter()
            .map(|[least, most]| most - least)
            .fold(0.0, f64::max)
    }

    /// The rises that level rows and columns in turn comes to.
    fn levelled(&self) -> Vec<f64> {
        let mut rises = vec![0.0; ROWS];
        for _ in 0..LEVELLINGS {
            let ranges = self.columns(&rises);
            for (row, rise) in self.rows.iter().zip(&mut rises) {
                let rest = row
                    .iter()
                    .zip(&ranges)
                    .map(|(height, [least, most])| height - f64::midpoint(*least, *most));
                let (least, most) = rest.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), rest| {
                    (least.min(rest), most.max(rest))
                });
                *rise = f64::midpoint(least, most);
            }
        }
        rises
    }

    fn free_spine(&self) -> Option<Fitted> {
        let mut rises = self.levelled();
        let mut best: Option<Fitted> = None;
        for smoothing in 0..=MOST_SMOOTHINGS {
            let fitted = through(&rises, self.depth).and_then(|spine| self.fitted(spine));
            if let Some(fitted) = fitted
                && best.as_ref().is_none_or(|best| fitted.leaves < best.leaves)
            {
                best = Some(fitted);
            }
            for _ in 0..1_u32 << smoothing {
                smooth(&mut rises);
            }
        }
        best
    }

    /// By the slope: what is left is the greatest of functions that are convex in it.
    fn even_spine(&self) -> Option<Fitted> {
        let rises = |slope: f64| -> Vec<f64> {
            let apart = self.depth / (ROWS - 1) as f64;
            (0..ROWS).map(|row| slope * apart * row as f64).collect()
        };
        let (mut low, mut high) = (-Spine::STEEPEST, Spine::STEEPEST);
        for _ in 0..60 {
            let third = (high - low) / 3.0;
            if self.left(&rises(low + third)) <= self.left(&rises(high - third)) {
                high -= third;
            } else {
                low += third;
            }
        }
        let rise = f64::midpoint(low, high) * self.depth;
        let ends = [(0.0, (-rise).max(0.0)), (self.depth, rise.max(0.0))];
        let knots = ends.map(|(y, rise)| Knot {
            y,
            rise: grid::nearest(rise),
        });
        self.fitted(Spine::new(knots.to_vec()).ok()?)
    }

    fn fitted(&self, spine: Spine) -> Option<Fitted> {
        let apart = self.depth / (ROWS - 1) as f64;
        let rises: Vec<f64> = (0..ROWS).map(|row| spine.rise(apart * row as f64)).collect();
        let leaves = self.left(&rises) + spine.deviation(OVERHANG).both();
        (spine.steepest() > 0.0).then_some(Fitted { spine, leaves })
    }
}

/// Draws every rise, but for the ends, towards its neighbours.
pub(crate) fn smooth(rises: &mut [f64]) {
    let before = rises.to_vec();
    for (rise, near) in rises.iter_mut().skip(1).zip(before.windows(3)) {
        *rise = near[0] / 4.0 + near[1] / 2.0 + near[2] / 4.0;
    }
}

/// A spine near the curve of which the rises, evenly spaced, are the control points. None where it is too steep or bends too much.
fn through(rises: &[f64], depth: f64) -> Option<Spine> {
    let rule = Rule {
        turn: libm::atan,
        off: f64::INFINITY,
        most: usize::MAX,
    };
    let places = knots(&[rises.to_vec()], depth, rule)?;
    let knot = |place: Place| {
        Some(Knot {
            y: place.y,
            rise: *place.heights.first()?,
        })
    };
    spine(places.into_iter().map(knot).collect::<Option<Vec<_>>>()?)
}

/// A spine through places that are put on the grid, the least of them at 0.
fn spine(mut knots: Vec<Knot>) -> Option<Spine> {
    let last = knots.len().checked_sub(1)?;
    for (number, knot) in knots.iter_mut().enumerate() {
        knot.rise = grid::nearest(knot.rise);
        if number != last {
            knot.y = grid::nearest(knot.y);
        }
    }
    let least = knots.iter().map(|knot| knot.rise).fold(f64::INFINITY, f64::min);
    for knot in &mut knots {
        knot.rise = grid::nearest(knot.rise - least);
    }
    Spine::new(knots).ok()
}

#[cfg(test)]
mod tests;
