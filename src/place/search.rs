//! The search for the best place: a grid over the bounds, then a climb from the best of it.
//!
//! Everything happens on the lattice of [`Spot`]s, so that what is found is what people paste, and in an order that does not
//! depend on threads: the places of a round are judged in parallel, gathered in their order, and the first of equals wins.

use crate::score::{Score, Scorer};
use crate::spot::Spot;
use core::cmp::Ordering;
use rayon::prelude::*;
use vcutc_backend_api::geometry::Frame;
use vcutc_motion::critical::ask_all;
use vcutc_motion::critical::margin::Effort;

/// Where the base may stand: the least and the greatest spot, each coordinate by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// The least of each coordinate.
    pub least: Spot,
    /// The greatest of each; none below its least.
    pub most: Spot,
}

/// A spot and how good it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    pub spot: Spot,
    /// How good it is by the poses and cuts asked.
    pub score: Score,
}

/// Aimed-at spacing of the grid: mm in x, y and z, tenths of a degree.
const SPACING: [i32; 4] = [100, 100, 100, 150];
/// Most values of each coordinate on the grid.
const MOST_VALUES: [i32; 4] = [13, 13, 7, 13];
/// The same where every pose is searched for numerically.
const FEW_VALUES: [i32; 4] = [5, 5, 3, 3];
/// How many places of the grid are climbed from.
const CLIMBS: usize = 6;
/// Most places of the grid that are asked whether the axes are fast enough there.
const MOST_ASKED: usize = 600;
/// How many are asked at once.
const BATCH: usize = 24;
/// Most rounds of a climb. Ten halve the steps down to one, the others go somewhere.
const MOST_ROUNDS: usize = 60;
/// The same where every pose is searched for numerically.
const FEW_ROUNDS: usize = 12;

impl Bounds {
    /// Whether a spot lies within them.
    #[must_use]
    pub fn contain(&self, spot: Spot) -> bool {
        let ranges = self.least.parts().into_iter().zip(self.most.parts());
        spot.parts()
            .into_iter()
            .zip(ranges)
            .all(|(value, (least, most))| (least..=most).contains(&value))
    }

    /// Whether a spot lies at an edge that leaves room to go on beyond it.
    #[must_use]
    pub fn touch(&self, spot: Spot) -> bool {
        let ranges = self.least.parts().into_iter().zip(self.most.parts());
        spot.parts()
            .into_iter()
            .zip(ranges)
            .any(|(value, (least, most))| least < most && (value == least || value == most))
    }

    /// The grid, in the order of x, then y, z and turn.
    fn grid(&self, effort: Effort) -> Vec<Spot> {
        let most = match effort {
            Effort::Full => MOST_VALUES,
            Effort::Sparing => FEW_VALUES,
        };
        let [xs, ys, zs, yaws] = [0, 1, 2, 3].map(|part| self.values(part, most[part]));
        let mut spots = Vec::with_capacity(xs.len() * ys.len() * zs.len() * yaws.len());
        for &x in &xs {
            for &y in &ys {
                for &z in &zs {
                    spots.extend(yaws.iter().map(|&yaw| Spot { x, y, z, yaw }));
                }
            }
        }
        spots
    }

    /// Evenly from the least to the greatest, both included.
    fn values(&self, part: usize, at_most: i32) -> Vec<i32> {
        let (least, most) = (self.least.parts()[part], self.most.parts()[part]);
        let steps = (most.saturating_sub(least)).div_euclid(SPACING[part]) + 1;
        evenly(least, most, steps.min(at_most - 1))
    }
}

/// `steps + 1` values from the least to the greatest, fewer where they would be the same.
#[must_use]
pub fn evenly(least: i32, most: i32, steps: i32) -> Vec<i32> {
    let width = f64::from(most) - f64::from(least);
    let mut values: Vec<i32> = (0..=steps.max(1))
        .map(|step| least.saturating_add((width * f64::from(step) / f64::from(steps.max(1))).round() as i32))
        .collect();
    values.dedup();
    values
}

/// What a search goes by.
#[derive(Clone, Copy)]
pub struct Criteria<'c, 'm> {
    /// Scores the grid.
    pub rough: Scorer<'c, 'm>,
    /// Scores the climbs.
    pub fine: Scorer<'c, 'm>,
    /// Whether the axes are fast enough with the work in a place; asked of places that are good otherwise.
    pub admits: &'c (dyn Fn(Spot) -> bool + Sync),
}

/// The best places within bounds, best first; those that are not admitted come last. `base` is where the work stands now.
#[must_use]
pub fn search(criteria: &Criteria<'_, '_>, base: &Frame, bounds: &Bounds) -> Vec<Placed> {
    let mut grid = scored(&criteria.rough, base, bounds.grid(criteria.rough.effort()));
    // Stable, so that of equals the first stays first.
    grid.sort_by(|a, b| b.score.better(&a.score));
    let mut starts = admitted(criteria, &grid);
    // Where nothing is admitted, the best of the rest say what it breaks on.
    starts.extend(
        grid.iter()
            .take(CLIMBS - starts.len().min(CLIMBS))
            .map(|place| place.spot),
    );
    let now = Spot::near(base);
    starts.extend(bounds.contain(now).then_some(now));
    let mut places: Vec<(bool, Placed)> = starts
        .into_iter()
        .filter_map(|start| climb(criteria, base, bounds, start))
        .map(|place| ((criteria.admits)(place.spot), place))
        .collect();
    places.sort_by(|(a_admitted, a), (b_admitted, b)| {
        b_admitted
            .cmp(a_admitted)
            .then(b.score.better(&a.score))
            .then(a.spot.cmp(&b.spot))
    });
    places.dedup_by_key(|(_, place)| place.spot);
    places.into_iter().map(|(_, place)| place).collect()
}

/// The first few places of a grid that are admitted, sorted as it is.
fn admitted(criteria: &Criteria<'_, '_>, grid: &[Placed]) -> Vec<Spot> {
    let mut spots = Vec::new();
    let reached = grid.iter().filter(|place| place.score.reached().is_some());
    for batch in reached.take(MOST_ASKED).collect::<Vec<_>>().chunks(BATCH) {
        let admits = ask_all(batch, |place| (criteria.admits)(place.spot));
        let admitted = batch.iter().zip(admits).filter(|(_, admits)| *admits);
        spots.extend(admitted.map(|(place, _)| place.spot));
        if spots.len() >= CLIMBS {
            break;
        }
    }
    spots.truncate(CLIMBS);
    spots
}

/// Scores spots, in parallel and in their order.
#[must_use]
pub fn scored(scorer: &Scorer<'_, '_>, base: &Frame, spots: Vec<Spot>) -> Vec<Placed> {
    spots
        .into_par_iter()
        .map(|spot| Placed {
            spot,
            score: scorer.score(&spot.work_in_root(base)),
        })
        .collect()
}

/// Pattern search [Hooke, Jeeves: "Direct search" solution of numerical and statistical problems, 1961] with steps along each
/// coordinate and each pair of them: the smallest of many margins has ridges that lead anywhere. Steps halve where none is
/// better, down to a millimetre and a tenth of a degree.
fn climb(criteria: &Criteria<'_, '_>, base: &Frame, bounds: &Bounds, start: Spot) -> Option<Placed> {
    let mut best = scored(&criteria.fine, base, vec![start]).pop()?;
    let keeps = (criteria.admits)(start);
    let mut step = SPACING.map(|spacing| spacing / 2);
    let rounds = match criteria.fine.effort() {
        Effort::Full => MOST_ROUNDS,
        Effort::Sparing => FEW_ROUNDS,
    };
    for _ in 0..rounds {
        let around: Vec<Spot> = neighbours(best.spot, step)
            .filter(|&spot| bounds.contain(spot))
            .collect();
        let mut better: Vec<Placed> = scored(&criteria.fine, base, around)
            .into_iter()
            .filter(|next| next.score.better(&best.score) == Ordering::Greater)
            .collect();
        better.sort_by(|a, b| b.score.better(&a.score));
        // A climb that began where the axes are fast enough stays where they are.
        let next = better
            .into_iter()
            .find(|next| !keeps || (criteria.admits)(next.spot));
        match next {
            Some(next) => best = next,
            None if step == [1; 4] => break,
            None => step = step.map(|part| (part / 2).max(1)),
        }
    }
    Some(best)
}

/// The spots a step away, along one coordinate or two.
fn neighbours(spot: Spot, step: [i32; 4]) -> impl Iterator<Item = Spot> {
    let ways = |code: i32| [1, 3, 9, 27].map(|place| code / place % 3 - 1);
    (0..81)
        .map(ways)
        .filter(|ways| (1..=2).contains(&ways.iter().filter(|&&way| way != 0).count()))
        .map(move |ways| {
            let parts = spot.parts();
            Spot::from_parts(core::array::from_fn(|i| {
                parts[i].saturating_add(ways[i] * step[i])
            }))
        })
}
