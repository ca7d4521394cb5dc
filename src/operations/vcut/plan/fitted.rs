//! Tips fitted to the part: the last row as wide apart as the scallop allows, and rows above it as wide apart as the reach of the blade
//! allows (`docs/process.md`, "Fitted tips").
//!
//! Write `p = z - c x` and `q = z + c x` for a point and flanks of slope `c`. A V takes away all points whose `p` and `q` are at least those
//! of its tip. Its right flank runs along its own `p`; it comes out within the reach `r` if the point `(p, q + 2 r)` is gone
//! before, and its left flank if `(p + 2 r, q)` is. So a V asks for two points, and any V whose tip has no larger `p` and `q` than a point
//! takes it. Rows are built from the last one up, each to take what the row below it asks for: some tips of the last row, cut first, take
//! the points of all between them; above them one V takes the right point of a tip and the left point of the next one.

#[cfg(test)]
mod tests;

use super::parameters::VcutParameters;
use crate::asked::RoughVcut;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_job::PlanningJob;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::surface::{Surface, Vee};

/// Flanks are planned to come out this much before their reach ends, in mm, because tips are rounded to the grid.
const ROUNDING: f64 = 4.0 * grid::SPACING;

/// Tips of the last row are raised by this, in mm. Along a wall as steep as the flanks, the tips above them are rounded down row by row; so
/// they still stay clear of it.
const RAISED: f64 = 16.0 * grid::SPACING;

/// How far beside the point that it takes a tip near a wall may lie, in grid spacings.
const MOST_ASIDE: i32 = 100;

/// Heights this close are equal: closer than those that the simulation takes for equal.
const TOUCH: f64 = 1e-9;

/// How closely the steps of the last row are found, in mm.
const PRECISION: f64 = 0.005;

/// Limits that the flanks cannot keep are widened by this factor, for the proof to say how much they leave.
const LAXER: f64 = 1.1;

/// The narrowest step of the last row, in mm.
const LEAST_STEP: f64 = 0.01;

/// How the limit on the scallop is tested between two tips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Testing {
    /// Everywhere.
    Everywhere,
    /// At the highest point alone, to count tips: it nearly always decides.
    AtPeaks,
}

/// The work to which the tips of one swing are fitted.
pub(crate) struct Fitting<'f> {
    part: &'f Profile,
    /// The most that may stay on it.
    limit: Length,
    /// The lowest that tips may lie, but for the drop.
    clearance: &'f Profile,
    before: Surface,
    /// Most tips.
    most: usize,
    slope: f64,
    drop: f64,
    testing: Testing,
    /// The last row with no limit on its steps but the scallop, once it was needed.
    widest: Option<Result<Vec<Point2>, Unfit>>,
}

/// Why no tips fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unfit {
    /// The flanks leave more than the limit, however close the tips are.
    LeavesMore,
    /// So many tips are needed, or more, than may be cut.
    TooMany(usize),
}

/// What the blade asks of all rows.
struct Reach {
    /// How far above its tip a flank comes out at most.
    rise: f64,
    clear_height: f64,
}

impl<'f> Fitting<'f> {
    /// Of the swing of these parameters.
    pub(crate) fn new(
        job: &'f PlanningJob<'_>,
        asked: &RoughVcut,
        parameters: &VcutParameters,
        clearance: &'f Profile,
        before: &Surface,
        most: usize,
    ) -> Self {
        let limit = asked.limits.scallop.map(|limit| limit.value);
        Self {
            part: &job.profile,
            limit: limit.unwrap_or_else(|| parameters.scallop_bound(asked)),
            clearance,
            before: before.clone(),
            most,
            slope: parameters.flanks.slope,
            drop: parameters.drop.to_mm(),
            testing: Testing::Everywhere,
            widest: None,
        }
    }

    /// The same with another test.
    pub(crate) fn tested(self, testing: Testing) -> Self {
        Self {
            testing,
            widest: None,
            ..self
        }
    }

    /// The same under the least limit that the flanks can keep, or little more, where they cannot keep its own.
    pub(crate) fn laxer(self) -> Self {
        let mut fitting = self;
        while fitting.last_row(f64::INFINITY) == Err(Unfit::LeavesMore) {
            fitting = Self {
                limit: (fitting.limit * LAXER).max(Length::mm(LEAST_STEP)),
                widest: None,
                ..fitting
            };
        }
        fitting
    }

    /// The tips of a layer and a step, row by row from the top down, each from left to right.
    ///
    /// # Errors
    /// Why there are none.
    pub(crate) fn rows(&mut self, parameters: &VcutParameters) -> Result<Vec<Vec<Point2>>, Unfit> {
        let reach = Reach {
            rise: (parameters.layer.to_mm() - ROUNDING).max(grid::SPACING),
            clear_height: parameters.clear_height.to_mm(),
        };
        let last = self.last_row(parameters.step.to_mm())?;
        let [first, rest] = self.cut_first(&last, &reach);
        let mut count = last.len();
        let mut rows = vec![rest, first];
        while let Some(below) = rows.last() {
            let row = self.row_above(below, &reach);
            if row.is_empty() {
                break;
            }
            count += row.len();
            if count > self.most {
                return Err(Unfit::TooMany(count));
            }
            rows.push(row);
        }
        rows.reverse();
        rows.retain(|row| !row.is_empty());
        Ok(rows)
    }

    /// Whether the last row would have wider steps without that limit on them.
    pub(crate) fn is_narrowed_by(&mut self, step: Length) -> bool {
        self.widest_step_of(Length::mm(f64::INFINITY)) > step
    }

    /// The widest step of the last row with steps of no more than that, rounded up to the grid; zero for a single tip.
    pub(crate) fn widest_step_of(&mut self, step: Length) -> Length {
        let row = self.last_row(step.to_mm()).unwrap_or_default();
        Length::mm(grid::up(widest_step(&row)))
    }

    /// The last row with steps of no more than that.
    fn last_row(&mut self, step: f64) -> Result<Vec<Point2>, Unfit> {
        let widest = match self.widest.take() {
            Some(widest) => widest,
            None => self.row_on_the_part(f64::INFINITY),
        };
        self.widest = Some(widest.clone());
        let widest = widest?;
        if widest_step(&widest) <= step {
            return Ok(widest);
        }
        self.row_on_the_part(step)
    }

    const fn width(&self) -> f64 {
        self.before.width()
    }

    /// How low a tip may lie.
    fn lowest(&self, x: f64) -> f64 {
        self.clearance.height(x) + self.drop
    }

    /// The lowest tip on the grid.
    fn lowest_tip(&self, x: f64) -> Point2 {
        let x = grid::nearest(x);
        Point2 {
            x,
            z: grid::up(self.lowest(x)),
        }
    }

    /// Tips on the part, each as far from the one before as the limit allows.
    fn row_on_the_part(&mut self, step: f64) -> Result<Vec<Point2>, Unfit> {
        let step = step.min(self.width());
        let mut row: Vec<Point2> = Vec::new();
        while !self.ends_low(row.last().copied(), step) {
            let next = self.farthest_next(row.last().copied(), step);
            row.push(next.ok_or(Unfit::LeavesMore)?);
            if row.len() > self.most {
                return Err(Unfit::TooMany(row.len()));
            }
        }
        row.retain(|&tip| self.before.covers(tip));
        Ok(row)
    }

    /// Whether the last row may end with a tip.
    fn ends_low(&mut self, last: Option<Point2>, step: f64) -> bool {
        let is_near = last.is_some_and(|last| self.width() - last.x <= step / 2.0);
        is_near && self.is_peak_low(last, None) && self.is_low(last, None)
    }

    /// The farthest tip after one, or after the left side, so that no more stays between them than may. The highest point between them is
    /// tested first, because that takes less time; it nearly always decides.
    fn farthest_next(&mut self, last: Option<Point2>, step: f64) -> Option<Point2> {
        self.farthest_by(last, step, Self::is_peak_low)
            .filter(|&next| self.is_low(last, Some(next)))
            .or_else(|| self.farthest_by(last, step, Self::is_low))
    }

    /// The farthest one for which a test holds. The test is taken to fail beyond the first place where it does.
    fn farthest_by(
        &mut self,
        last: Option<Point2>,
        step: f64,
        is_low: impl Fn(&mut Self, Option<Point2>, Option<Point2>) -> bool,
    ) -> Option<Point2> {
        let from = last.map_or(0.0, |last| last.x);
        let most = match last {
            Some(_) => step,
            None => step / 2.0,
        };
        let mut low_next = |apart: f64| {
            let lowest = self.lowest_tip((from + apart).min(self.width()));
            let next = Point2 {
                z: grid::nearest(lowest.z + RAISED),
                ..lowest
            };
            is_low(self, last, Some(next)).then_some(next)
        };
        if let Some(next) = low_next(most) {
            return Some(next);
        }
        let (mut near, mut far) = (None, most);
        let mut apart = most;
        while near.is_none() {
            far = apart;
            apart /= 2.0;
            if apart < LEAST_STEP {
                return None;
            }
            near = low_next(apart).map(|next| (apart, next));
        }
        while let Some((close, _)) = near
            && far - close > PRECISION
        {
            let middle = f64::midpoint(close, far);
            match low_next(middle) {
                Some(next) => near = Some((middle, next)),
                None => far = middle,
            }
        }
        near.map(|(_, next)| next)
    }

    /// Whether the highest point left between two tips, or between a tip and a side, keeps the limit.
    fn is_peak_low(&mut self, left: Option<Point2>, right: Option<Point2>) -> bool {
        let slope = self.slope;
        let peak = match (left, right) {
            (Some(left), Some(right)) => self.at(left.z - slope * left.x, right.z + slope * right.x),
            (Some(tip), None) => Point2 {
                x: self.width(),
                z: tip.z + slope * (self.width() - tip.x),
            },
            (None, Some(tip)) => Point2 {
                x: 0.0,
                z: tip.z + slope * tip.x,
            },
            (None, None) => return false,
        };
        let peak = Point2 {
            z: peak.z.min(self.before.height(peak.x)),
            ..peak
        };
        self.part.nearest_distance(peak) <= self.limit.to_mm()
    }

    /// Whether no more than the limit stays between two tips, or between a tip and a side.
    fn is_low(&mut self, left: Option<Point2>, right: Option<Point2>) -> bool {
        let from = left.map_or(0.0, |tip| tip.x);
        let to = right.map_or(self.width(), |tip| tip.x);
        if to <= from {
            return true;
        }
        if self.testing == Testing::AtPeaks {
            return self.is_peak_low(left, right);
        }
        let mut between = self.before.part(from, to);
        for tip in [left, right].into_iter().flatten() {
            between.release(Vee::even(tip, self.slope));
        }
        let corners: Vec<Point2> = between.corners().collect();
        farthest(&corners, self.part).height <= self.limit
    }

    /// Those of the last row that are cut first, as far apart as they may be to take what those between them ask for, and the rest.
    fn cut_first(&mut self, row: &[Point2], reach: &Reach) -> [Vec<Point2>; 2] {
        let [mut first, mut rest] = [Vec::new(), Vec::new()];
        let mut before: Option<Point2> = None;
        // What those since then ask for on their right.
        let mut asked: Option<Point2> = None;
        let next = row.iter().copied().skip(1).map(Some).chain([None]);
        for (&tip, next) in row.iter().zip(next) {
            let [left, right] = self.asked_for(tip, reach);
            let together = self.both(asked, right);
            if self.takes(before, left) && self.takes(next, together) {
                rest.push(tip);
                asked = together;
            } else {
                first.push(tip);
                (before, asked) = (Some(tip), None);
            }
        }
        [first, rest]
    }

    /// Whether a V takes what is asked for, if anything is.
    fn takes(&self, tip: Option<Point2>, asked: Option<Point2>) -> bool {
        asked.is_none_or(|point| tip.is_some_and(|tip| is_taken(point, tip, self.slope)))
    }

    /// The points that must be gone before the flanks of a V come out, left and right; none where the work has no material there.
    fn asked_for(&mut self, tip: Point2, reach: &Reach) -> [Option<Point2>; 2] {
        let (rise, width) = (reach.rise, self.width());
        let aside = rise / self.slope;
        [tip.x - aside, tip.x + aside].map(|x| {
            let point = if (0.0..=width).contains(&x) {
                Point2 { x, z: tip.z + rise }
            } else {
                // Beside the stock flanks are free, but the blade must lean over what stands there.
                Point2 {
                    x: x.clamp(0.0, width),
                    z: tip.z + reach.clear_height,
                }
            };
            (self.before.height(point.x) > point.z + TOUCH).then_some(point)
        })
    }

    /// The tips that take all that a row asks for.
    fn row_above(&mut self, below: &[Point2], reach: &Reach) -> Vec<Point2> {
        let mut row: Vec<Point2> = Vec::new();
        let mut asked: Option<Point2> = None;
        for &tip in below {
            let [left, right] = self.asked_for(tip, reach);
            row.extend(self.takers(asked, left, reach));
            asked = right;
        }
        row.extend(self.takers(asked, None, reach));
        row.sort_by(|one, other| one.x.total_cmp(&other.x));
        self.without_covered(row)
    }

    /// The tip that takes two points; one for each where that would enter the part, or lie so low that two rise more, V for V.
    fn takers(&self, one: Option<Point2>, other: Option<Point2>, reach: &Reach) -> Vec<Point2> {
        let one_for_both = one.zip(other).and_then(|(one, other)| {
            let least = f64::midpoint(one.z, other.z) - reach.rise / 2.0;
            let both = self.both(Some(one), Some(other))?;
            (both.z >= least).then(|| self.on_grid(both)).flatten()
        });
        match one_for_both {
            Some(tip) => vec![tip],
            None => {
                let each = [one, other].into_iter().flatten();
                each.filter_map(|point| self.on_grid(point)).collect()
            }
        }
    }

    /// The highest point that no V can take without taking both.
    fn both(&self, one: Option<Point2>, other: Option<Point2>) -> Option<Point2> {
        let lower = |one: Point2, other: Point2| {
            let p = |point: Point2| point.z - self.slope * point.x;
            let q = |point: Point2| point.z + self.slope * point.x;
            self.at(p(one).min(p(other)), q(one).min(q(other)))
        };
        [one, other].into_iter().flatten().reduce(lower)
    }

    fn at(&self, p: f64, q: f64) -> Point2 {
        Point2 {
            x: (q - p) / (2.0 * self.slope),
            z: f64::midpoint(p, q),
        }
    }

    /// A row without the tips that others take away.
    fn without_covered(&self, row: Vec<Point2>) -> Vec<Point2> {
        let mut kept: Vec<Point2> = Vec::new();
        for tip in row {
            if self.takes(kept.last().copied(), Some(tip)) {
                continue;
            }
            while kept.last().is_some_and(|&last| is_taken(last, tip, self.slope)) {
                kept.pop();
            }
            kept.push(tip);
        }
        kept
    }

    /// The tip on the grid that takes a point; none where that would enter the part. Near a wall it is the one that keeps farthest from
    /// that, of those beside the point: then most room is left to the tips above it.
    fn on_grid(&self, point: Point2) -> Option<Point2> {
        let nearest = grid::nearest(point.x.clamp(0.0, self.width()));
        let below = |offset: i32| {
            let x = grid::nearest(nearest + f64::from(offset) * grid::SPACING).clamp(0.0, self.width());
            Point2 {
                x,
                z: grid::down(point.z - self.slope * (point.x - x).abs()),
            }
        };
        let room = |tip: &Point2| tip.z - self.lowest(tip.x);
        let tip = below(0);
        if room(&tip) > RAISED {
            return Some(tip);
        }
        let beside = (-MOST_ASIDE..=MOST_ASIDE).map(below);
        let tip = beside.max_by(|one, other| room(one).total_cmp(&room(other)))?;
        (tip.z >= self.lowest_tip(tip.x).z).then_some(tip)
    }
}

/// The widest step of a row.
fn widest_step(row: &[Point2]) -> f64 {
    let steps = row.iter().zip(row.iter().skip(1));
    steps.map(|(one, next)| next.x - one.x).fold(0.0, f64::max)
}

/// Whether a V with that tip takes a point.
fn is_taken(point: Point2, tip: Point2, slope: f64) -> bool {
    Vee::even(tip, slope).height(point.x) <= point.z + TOUCH
}
