//! Swings, layers and overlaps over all that a job leaves open, those first that are fastest by the model: what is better than
//! what the formulas found may lie far from it. Where nothing of it is sound, the search goes on from what leaves the least, or
//! the fewest chips, to what leaves less, step by step.
//!
//! Walls steeper than the flanks are followed by small swings only, and a fine surface asks for small layers or overlaps;
//! which of them a part needs, no formula says.

use super::{AHEAD, FACTORS, MOVES, Trials, give_overlap, thousandths};
use crate::choice::MOST_CUTS_COMPARED;
use crate::job::Auto;
use crate::plan::decision::Standing;
use crate::plan::parameters::{self, VcutParameters};
use core::cmp::Ordering;
use rayon::prelude::*;
use vcutc_backend_api::units::{Angle, Duration, Length};

/// Most plans of the spread, by the number of cuts of the first one: below the first number the second.
const PLANS: [(usize, usize); 3] = [(500, 72), (2_000, 36), (MOST_CUTS_COMPARED, 8)];

/// The widest swing to begin with where the job sets no limit.
const WIDEST: Angle = Angle::deg(50.0);

/// Swings as shares of the widest one.
const SWINGS: [f64; 7] = [1.0, 0.86, 0.74, 0.63, 0.5, 0.38, 0.27];

/// Overlaps.
const OVERLAPS: [f64; 2] = [0.0, 0.3];

/// Layers as shares of the largest one at a swing.
const LAYERS: [f64; 6] = [1.0, 0.87, 0.72, 0.5, 0.33, 0.2];

impl Trials<'_> {
    /// Goes over the spread as far as it may be better than what is known, and on until something is sound.
    pub(super) fn spread(&mut self) {
        (self.plans_left, self.most_plans) = (None, &PLANS);
        for next in self.grid().chunks(AHEAD) {
            self.plan_ahead(next);
            next.iter()
                .for_each(|found| self.weigh_if_promising(found.clone()));
        }
        while self.sound.is_empty() && self.may_go_on() {
            if !self.has_better_neighbour() {
                break;
            }
        }
        (self.plans_left, self.most_plans) = (None, &super::PLANS);
    }

    /// Swings and layers over what the job leaves open, the fastest by the model first.
    fn grid(&self) -> Vec<VcutParameters> {
        let swings: Vec<Option<Angle>> = match (self.asked.swing.value, self.asked.limits.swing.most) {
            (Auto::Given(_), _) => vec![None],
            (Auto::Auto, most) => {
                let widest = most.map_or(WIDEST, |most| most.value);
                SWINGS.map(|share| Some(thousandths(widest * share))).to_vec()
            }
        };
        let places: Vec<(Option<Angle>, f64)> = swings
            .into_iter()
            .flat_map(|swing| self.overlaps().map(move |overlap| (swing, overlap)))
            .collect();
        let mut grid: Vec<(Duration, VcutParameters)> = places
            .into_par_iter()
            .flat_map_iter(|(swing, overlap)| self.layers_at(swing, overlap))
            .map(|found| (self.model(&found), found))
            .collect();
        grid.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        grid.into_iter().map(|(_, found)| found).collect()
    }

    /// Overlaps, as far as they are open and help: with a limit on scallop.
    fn overlaps(&self) -> impl Iterator<Item = f64> + use<> {
        let count = if self.has_open_overlap() {
            OVERLAPS.len()
        } else {
            1
        };
        OVERLAPS.into_iter().take(count)
    }

    /// The largest layer at a swing with an overlap, and smaller ones.
    fn layers_at(&self, swing: Option<Angle>, overlap: f64) -> Vec<VcutParameters> {
        let mut assumed = self.asked.clone();
        assumed.limits.scallop = None;
        give_overlap(&mut assumed, overlap);
        if let Some(swing) = swing {
            assumed.swing.value = Auto::Given(swing);
        }
        let Some(largest) = self.resolve(&assumed) else {
            return Vec::new();
        };
        if let Auto::Given(_) = self.asked.layer.value {
            return vec![largest];
        }
        let at = |share: f64| {
            let layer = (largest.layer.to_mm() * share * 1000.0).floor() / 1000.0;
            let mut assumed = assumed.clone();
            assumed.layer.value = Auto::Given(Length::mm(layer));
            (layer > 0.0).then(|| {
                let lattices = vec![largest.lattice];
                parameters::possible_on(self.bench.job, &assumed, lattices)
            })?
        };
        LAYERS
            .into_iter()
            .filter_map(at)
            .filter(|found| self.is_within(found))
            .collect()
    }

    /// Whether something beside what came nearest to being sound comes nearer still.
    fn has_better_neighbour(&mut self) -> bool {
        let nearest = self
            .tried
            .iter()
            .min_by(|one, other| lack(one.standing, other.standing));
        let Some(nearest) = nearest else { return false };
        let (from, standing) = (nearest.parameters.clone(), nearest.standing);
        FACTORS.into_iter().any(|factor| {
            MOVES.chunks(AHEAD).any(|moves| {
                let found: Vec<VcutParameters> = moves
                    .par_iter()
                    .filter_map(|&moved| self.beside(&from, factor, moved))
                    .collect();
                self.plan_ahead(&found);
                found.into_iter().any(|found| {
                    let came = self.weigh(found);
                    came.is_some_and(|came| lack(came, standing) == Ordering::Less)
                })
            })
        })
    }
}

/// What comes nearer to being sound first: what leaves less than other plans, then what leaves fewer chips.
fn lack(one: Standing, other: Standing) -> Ordering {
    match (one, other) {
        (Standing::Fails(count), Standing::Fails(than)) => count.cmp(&than),
        (one, other) => one.compare(&other),
    }
}
