//! Cuts that each have a way of their own along the work: columns.
//!
//! Ways are polylines over y that all have their knots at the same places, so that between two of these, in a slab, every way is straight.
//! Columns of a single slab are straight cuts, each with a slope of its own: a fan.
//!
//! A part `p(x, y)` is covered from above by a surface `C(x, y)` that is linear in y within each slab: `p <= C`. A tip at `x_i` runs at
//! `z_i + s(x_i, y)`, so that all tips over one x are parallel. Both `C` and the flanks of a V, `z_i + s(x_i, y) + c |x - x_i|`, are linear
//! in y within a slab over each x. So a V that stays above `C` at every knot does so in between: no cut enters the part where none enters the
//! sections of its cover at the knots (derived here).
//!
//! A tip is planned by the height `z_i` of its lower end. There the knots `y_k` ask for at least
//! `f(x) = max over k of C_k(x) - s(x, y_k)`, with `C_k` the cover at that knot raised so that no flank is steeper, and `s >= 0`. A V over `f`
//! is clear at all knots, whatever the ways are (derived here).

use crate::cone::clearance;
use crate::curve::Point2;
use crate::grid;
use crate::offset::offset_up;
use crate::profile::{Profile, height_between, least_step};
use crate::spine::{Deviation, Knot, Spine, Station, off, turned};
use core::fmt;
use std::sync::Arc;
use vcutc_backend_api::units::Length;

/// Ways along y over each x, and a part as they cover it.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Where slabs end, in mm: the first at 0, the last at the depth of the stock.
    knots: Vec<f64>,
    /// The cover at each knot.
    covers: Vec<Profile>,
    /// From left to right. In between they rise evenly.
    lines: Vec<Line>,
}

/// The way of tips at a place.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    x: f64,
    /// How high it is at each knot above its lowest one, in mm.
    rises: Vec<f64>,
}

/// Why ways are no columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnsError {
    /// Fewer than two knots or places, not in order, or not as many heights and covers as knots.
    Order,
    /// Steeper than [`Spine::STEEPEST`], or its slope changes too much at a knot ([`Spine::LARGEST_BEND`]).
    Bends,
}

impl fmt::Display for ColumnsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Order => "columns have their knots and places in order, and a height for each",
            Self::Bends => "a column is too steep, or bends too much at a knot",
        })
    }
}

impl core::error::Error for ColumnsError {}

/// The way of a tip, and its flanks.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Across the cuts, in mm.
    pub x: f64,
    /// The height of the tip at each knot, in mm.
    pub tips: Arc<[f64]>,
    /// Rise of the flanks over x.
    pub flank: f64,
}

impl Column {
    /// The height of its V over a place, with knots there.
    #[must_use]
    pub fn height(&self, [x, y]: [f64; 2], knots: &[f64]) -> f64 {
        over(knots, &self.tips, y) + self.flank * (x - self.x).abs()
    }

    /// Whether its V lies nowhere above another one with flanks as steep.
    #[must_use]
    pub fn covers(&self, other: &Self) -> bool {
        let aside = self.flank * (self.x - other.x).abs();
        let pairs = self.tips.iter().zip(&*other.tips);
        pairs
            .map(|(own, other)| own + aside - other)
            .all(|above| above <= 0.0)
    }

    /// The lowest place of its tip, in mm.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.tips.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The highest place of its tip, in mm.
    #[must_use]
    pub fn highest(&self) -> f64 {
        self.tips.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The same so much lower.
    #[must_use]
    pub fn lowered(&self, by: f64) -> Self {
        Self {
            tips: self.tips.iter().map(|tip| tip - by).collect(),
            ..*self
        }
    }
}

/// The slab that a y is in, by its number; the first one or the last one beyond the knots.
#[must_use]
pub fn slab(knots: &[f64], y: f64) -> usize {
    let after = knots.partition_point(|knot| *knot < y);
    after.clamp(1, knots.len().max(2) - 1) - 1
}

/// The height at a y of what has these heights at the knots.
fn over(knots: &[f64], heights: &[f64], y: f64) -> f64 {
    let from = slab(knots, y);
    match (knots.get(from..=from + 1), heights.get(from..=from + 1)) {
        (Some(&[front, back]), Some(&[low, high])) => low + (high - low) * ((y - front) / (back - front)),
        (Some(_) | None, _) => 0.0,
    }
}

/// Corners of profiles that lie so near to a straight line between others are left out, in mm: the profile is nowhere lower without them,
/// but for rounding, and nowhere higher than by this.
const STRAIGHT: f64 = 1e-3;

/// What rounding lifts a corner off a straight line, in mm.
const ROUNDING: f64 = 1e-8;

/// So many corners one after the other are left out at most.
const MOST_LEFT_OUT: usize = 64;

impl Columns {
    /// Columns with these knots over a part that these profiles cover at each of them. `ways` are places from left to right, in mm, each
    /// with the heights of its way at the knots, above whatever level; they span what the covers do.
    ///
    /// # Errors
    /// See [`ColumnsError`].
    pub fn new(
        knots: Vec<f64>,
        covers: Vec<Profile>,
        ways: Vec<(f64, Vec<f64>)>,
    ) -> Result<Self, ColumnsError> {
        let rises = |values: &[f64]| values.windows(2).all(|pair| pair[0] < pair[1]);
        let places: Vec<f64> = ways.iter().map(|(x, _)| *x).collect();
        let is_ordered = [&knots, &places]
            .iter()
            .all(|values| values.len() >= 2 && rises(values));
        let fit = covers.len() == knots.len() && ways.iter().all(|(_, heights)| heights.len() == knots.len());
        if !is_ordered || !fit || knots.first() != Some(&0.0) {
            return Err(ColumnsError::Order);
        }
        if ways.iter().any(|(_, heights)| bends(&knots, heights)) {
            return Err(ColumnsError::Bends);
        }
        let lines = ways.into_iter().map(|(x, heights)| {
            let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
            Line {
                x,
                rises: heights.iter().map(|height| height - least).collect(),
            }
        });
        Ok(Self {
            lines: lines.collect(),
            knots,
            covers,
        })
    }

    /// Where slabs end, in mm: from 0 to the depth of the stock.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// How many slabs there are.
    #[must_use]
    pub const fn slabs(&self) -> usize {
        self.knots.len() - 1
    }

    /// Whether every way is straight.
    #[must_use]
    pub const fn is_fan(&self) -> bool {
        self.slabs() == 1
    }

    /// The depth of the stock, in mm.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.knots.last().copied().unwrap_or_default()
    }

    /// The cover at each knot.
    #[must_use]
    pub fn covers(&self) -> &[Profile] {
        &self.covers
    }

    /// How high the cover is over a place of the stock, in mm.
    #[must_use]
    pub fn cover(&self, [x, y]: [f64; 2]) -> f64 {
        let from = slab(&self.knots, y);
        let ends = self.covers.iter().skip(from).take(2);
        let heights: Vec<f64> = ends.map(|cover| cover.height(x)).collect();
        let ends = self.knots.get(from..=from + 1).unwrap_or_default();
        over(ends, &heights, y)
    }

    /// How high the way at an x is at each knot above its lowest one, in mm.
    fn rises(&self, x: f64) -> Vec<f64> {
        let after = self.lines.partition_point(|line| line.x < x);
        let after = after.clamp(1, self.lines.len() - 1);
        match self.lines.get(after - 1..=after) {
            Some([from, to]) => {
                let share = (x - from.x) / (to.x - from.x);
                let pairs = from.rises.iter().zip(&to.rises);
                pairs.map(|(low, high)| low + (high - low) * share).collect()
            }
            Some(_) | None => vec![0.0; self.knots.len()],
        }
    }

    /// How far the way through an x lies at a y, which may lie beyond the stock, above its lower end over the stock.
    #[must_use]
    pub fn rise(&self, x: f64, y: f64) -> f64 {
        over(&self.knots, &self.rises(x), y)
    }

    /// The places of the way at an x that continues straight to a `front` before the stock and to a `back` beyond it. Their rises are on the
    /// grid, nowhere below the way itself.
    #[must_use]
    pub fn stations(&self, x: f64, [front, back]: [f64; 2]) -> Vec<Station> {
        let rises: Vec<f64> = self.rises(x).into_iter().map(grid::up).collect();
        let mut places: Vec<Knot> = self
            .knots
            .iter()
            .zip(&rises)
            .map(|(&y, &rise)| Knot { y, rise })
            .collect();
        let ends = [front, back].map(|y| Knot {
            y,
            rise: grid::up(over(&self.knots, &rises, y)),
        });
        if let [first, .., last] = places.as_mut_slice() {
            [*first, *last] = ends;
        }
        stations(&places)
    }

    /// The slopes of a line, slab by slab.
    fn slopes<'l>(&'l self, line: &'l Line) -> impl Iterator<Item = f64> + 'l {
        slopes(&self.knots, &line.rises)
    }

    /// The largest slope of its ways, up or down.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        let all = self.lines.iter().flat_map(|line| self.slopes(line));
        all.map(f64::abs).fold(0.0, f64::max)
    }

    /// The slopes of each way at y = 0 and at the depth of the stock, as y grows, with how high it is there.
    fn ends(&self) -> impl Iterator<Item = [(f64, f64); 2]> + '_ {
        self.lines.iter().map(|line| {
            let first = self.slopes(line).next().zip(line.rises.first().copied());
            let last = self.slopes(line).last().zip(line.rises.last().copied());
            [first, last].map(Option::unwrap_or_default)
        })
    }

    /// The largest slope at the sides of the stock, up or down.
    #[must_use]
    pub fn steepest_at_sides(&self) -> f64 {
        let slopes = self.ends().flatten().map(|(slope, _)| slope.abs());
        slopes.fold(0.0, f64::max)
    }

    /// How far ways go down at most over so many mm beyond a side of the stock: from there on, and below their lower ends.
    #[must_use]
    pub fn down_beyond(&self, extension: f64) -> [f64; 2] {
        let falls = self.ends().flat_map(|[(first, front), (last, back)]| {
            [(first * extension, front), (-last * extension, back)].map(|(fall, rise)| [fall, fall - rise])
        });
        falls.fold([0.0; 2], |most, fall| {
            [most[0].max(fall[0]), most[1].max(fall[1])]
        })
    }

    /// By how much more one of its sections rises over x than another at most.
    #[must_use]
    pub fn shear(&self) -> f64 {
        let pairs = self.lines.windows(2).map(|pair| {
            let apart = pair[1].x - pair[0].x;
            let rates = pair[1].rises.iter().zip(&pair[0].rises);
            let range = rates.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], (to, from)| {
                let rate = (to - from) / apart;
                [least.min(rate), most.max(rate)]
            });
            range[1] - range[0]
        });
        pairs.fold(0.0, f64::max)
    }

    /// How far flanks lie off the Vs of their tips, where the blade lies over the work by at most `overhang` mm before and after its tip
    /// along y. How far they do is linear in the way, so that the ways in between lie off by no more.
    #[must_use]
    pub fn deviation(&self, overhang: f64) -> Deviation {
        if self.is_fan() {
            return Deviation::default();
        }
        let each = self.lines.iter().map(|line| {
            let places = self.knots.iter().zip(&line.rises);
            Spine::of_column(places.map(|(&y, &rise)| Knot { y, rise }).collect()).deviation(overhang)
        });
        each.fold(Deviation::default(), Deviation::larger)
    }

    /// How far a flank that rises by `flank` across the cuts may lie off its V, in mm, because an edge of that length is not just where
    /// it is to be; see [`Spine::off`]. A fan has no places at which it could leave its way.
    #[must_use]
    pub fn off(&self, edge: Length, blend: Length, flank: f64) -> f64 {
        let moved = if self.is_fan() { 0.0 } else { turned(edge, blend) };
        off(moved, flank, self.steepest())
    }

    /// How many times as long as the stock is deep its ways are at most.
    #[must_use]
    pub fn lengthening(&self) -> f64 {
        let lengths = self.lines.iter().map(|line| {
            let pieces = self.knots.windows(2).zip(self.slopes(line));
            let lengths = pieces.map(|(ends, slope)| (ends[1] - ends[0]) * libm::hypot(1.0, slope));
            lengths.sum::<f64>()
        });
        lengths.fold(0.0, f64::max) / self.depth()
    }

    /// The lower end of a tip at these heights, as it is seen with the rises of its way taken off.
    #[must_use]
    pub fn lower_end(&self, x: f64, tips: &[f64]) -> f64 {
        let rises = self.rises(x);
        let seen = tips.iter().zip(rises).map(|(tip, rise)| tip - rise);
        seen.fold(f64::NEG_INFINITY, f64::max)
    }

    /// How much more steeply than its flanks the V of a tip at x rises at most to the left and to the right, where ways are seen from
    /// their lower ends: what any of its sections shows lies below that.
    #[must_use]
    pub fn opening(&self, x: f64) -> [f64; 2] {
        let own = self.rises(x);
        let mut most = [0.0_f64; 2];
        for line in &self.lines {
            let side = usize::from(line.x > x);
            let above = own.iter().zip(&line.rises).map(|(own, rise)| own - rise);
            let above = above.fold(0.0, f64::max) / (line.x - x).abs();
            if above.is_finite()
                && let Some(most) = most.get_mut(side)
            {
                *most = most.max(above);
            }
        }
        most
    }

    /// The cover at each knot with an allowance. Its ball is taken for one that is as high as the ellipse that it makes across the
    /// steepest place of the cover, `sqrt(1 + m^2)` times as high as wide: no place of the cover as far away along y as the ball reaches
    /// lies higher than by `m` times that, and what lies above a cover that is linear in y is no less so.
    #[must_use]
    pub fn covers_with(&self, allowance: Length) -> Vec<Profile> {
        let stretched = allowance * libm::hypot(1.0, self.steepest_cover());
        let covers = self.covers.iter();
        covers.map(|cover| offset_up(cover, stretched)).collect()
    }

    /// The largest slope of the cover along y, up or down.
    fn steepest_cover(&self) -> f64 {
        let slabs = self.covers.windows(2).zip(self.knots.windows(2));
        let each = slabs.map(|(covers, ends)| {
            let corners = covers.iter().flat_map(Profile::points);
            let apart = corners.map(|corner| (covers[1].height(corner.x) - covers[0].height(corner.x)).abs());
            apart.fold(0.0, f64::max) / (ends[1] - ends[0])
        });
        each.fold(0.0, f64::max)
    }

    /// The part as the lower ends of tips see it: `f` of the module. Flanks may rise by `flank` or more.
    #[must_use]
    pub fn section(&self, flank: f64, allowance: Length) -> Profile {
        let covers = self.covers_with(allowance).into_iter();
        let clear: Vec<Profile> = covers.map(|cover| clearance(&cover, flank)).collect();
        self.seen(&clear)
    }

    /// The same without flanks or allowance: what tips that are infinitely close leave.
    #[must_use]
    pub fn shadow(&self) -> Profile {
        self.seen(&self.covers)
    }

    /// The greatest of what lies at the knots, with the rises of ways taken off. Between two corners of any of it it is convex, so that a
    /// chord lies above it.
    fn seen(&self, covers: &[Profile]) -> Profile {
        let corners = covers
            .iter()
            .flat_map(|cover| cover.points().iter().map(|corner| corner.x));
        let mut places: Vec<f64> = corners.chain(self.lines.iter().map(|line| line.x)).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|next, before| *next - *before < least_step(*next));
        let height = |x: f64| {
            let rises = self.rises(x);
            let seen = covers
                .iter()
                .zip(rises)
                .map(|(cover, rise)| cover.height(x) - rise);
            Point2::new(x, seen.fold(f64::NEG_INFINITY, f64::max))
        };
        let whole: Vec<Point2> = places.into_iter().map(height).collect();
        Profile::from_ascending(if self.is_fan() { whole } else { thinned(&whole) })
    }
}

/// Whether a way is too steep or bends too much at a knot, where its heights are put on the grid.
#[must_use]
pub fn bends(knots: &[f64], heights: &[f64]) -> bool {
    let lengths = knots.windows(2).map(|ends| ends[1] - ends[0]);
    // How much rounding of both ends turns a piece.
    let turned: Vec<f64> = lengths.map(|length| grid::SPACING / length).collect();
    let slopes: Vec<f64> = slopes(knots, heights).collect();
    // Comparisons with NaN are false.
    let is_gentle = slopes
        .iter()
        .zip(&turned)
        .all(|(slope, turned)| slope.abs() + turned <= Spine::STEEPEST);
    let mut knots = slopes.windows(2).zip(turned.windows(2));
    !is_gentle
        || knots.any(|(slopes, turned)| {
            (slopes[1] - slopes[0]).abs() + turned[0] + turned[1] > Spine::LARGEST_BEND
        })
}

fn slopes<'k>(knots: &'k [f64], heights: &'k [f64]) -> impl Iterator<Item = f64> + 'k {
    let pairs = knots.windows(2).zip(heights.windows(2));
    pairs.map(|(ends, heights)| (heights[1] - heights[0]) / (ends[1] - ends[0]))
}

/// The places of a way: at its ends the slope of its first and of its last piece, and between two pieces the mean of theirs.
#[must_use]
pub fn stations(places: &[Knot]) -> Vec<Station> {
    let slopes: Vec<f64> = places
        .windows(2)
        .map(|pair| (pair[1].rise - pair[0].rise) / (pair[1].y - pair[0].y))
        .collect();
    let slope = |number: usize| {
        let before = number.checked_sub(1).and_then(|before| slopes.get(before));
        match (before, slopes.get(number)) {
            (Some(&before), Some(&after)) => f64::midpoint(before, after),
            (Some(&only), None) | (None, Some(&only)) => only,
            (None, None) => 0.0,
        }
    };
    let places = places.iter().enumerate();
    places
        .map(|(number, &Knot { y, rise })| Station {
            y,
            rise,
            slope: slope(number),
        })
        .collect()
}

/// A polyline without corners that hardly bend it, which it does not lie below.
fn thinned(points: &[Point2]) -> Vec<Point2> {
    let mut kept: Vec<Point2> = Vec::with_capacity(points.len());
    // Where what was left out since the last corner begins.
    let mut open = 0;
    for (number, &point) in points.iter().enumerate() {
        if let Some(&last) = kept.last() {
            let between = points.get(open..number).unwrap_or_default();
            let is_straight = |corner: &Point2| {
                let above = height_between(last, point, corner.x) - corner.z;
                (-ROUNDING..=STRAIGHT).contains(&above)
            };
            let is_done = between.len() > MOST_LEFT_OUT || !between.iter().all(is_straight);
            if let (true, Some(&before)) = (is_done, between.last()) {
                kept.push(before);
                open = number;
            }
        } else {
            kept.push(point);
            open = number + 1;
        }
    }
    kept.extend(points.last().filter(|last| kept.last() != Some(last)));
    kept
}

#[cfg(test)]
mod tests;
