//! Parameters around the best ones: changed by factors, the coarse ones first, for as long as the result
//! improves.

use super::{AHEAD, MOST_OVERLAP, Trials, alike, thousandths};
use crate::choice::MOST_CUTS_COMPARED;
use crate::plan::parameters::{Swung, VcutParameters};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::grid;
use vcutc_job::Auto;

/// By which factors swing and layer are changed, the coarse ones first.
pub(super) const FACTORS: [f64; 3] = [1.3, 1.12, 1.04];

/// Directions in which swing, layer and overlap are changed, those first that promise most.
pub(super) const MOVES: [Move; 11] = [
    [0, 1, 0],
    [1, 0, 0],
    [-1, 1, 0],
    [1, 1, 0],
    [-1, 0, 0],
    [1, -1, 0],
    [0, 0, -1],
    [0, 1, 1],
    [0, 0, 1],
    [0, -1, 0],
    [-1, -1, 0],
];

/// A change of swing, layer and overlap: up, down or not at all.
pub(super) type Move = [i32; 3];

/// How many of the best ones are changed.
const STARTS: usize = 4;

/// How many larger layers than the best one are tried closely, and by which factor they are apart.
const TEETH: i32 = 10;
const APART: f64 = 1.02;

/// As [`PLANS`](super::PLANS), for these.
const TEETH_PLANNED: [(usize, usize); 3] = [(500, 10), (2_000, 5), (MOST_CUTS_COMPARED, 1)];

impl Trials<'_> {
    /// From the best ones on, changes swing, layer and overlap for as long as the result improves.
    pub(super) fn wander(&mut self) {
        let starts: Vec<VcutParameters> = self
            .sound
            .iter()
            .take(STARTS * self.times())
            .map(|sound| sound.parameters.clone())
            .collect();
        for start in starts {
            self.wander_from(start);
        }
    }

    fn wander_from(&mut self, mut from: VcutParameters) {
        for factor in FACTORS {
            while self.may_go_on() {
                let Some(merit) = self.merit_of(&from) else { return };
                let better = MOVES.chunks(AHEAD).find_map(|moves| {
                    let found: Vec<VcutParameters> = moves
                        .iter()
                        .filter_map(|&moved| self.beside(&from, factor, moved))
                        .filter(|found| !self.is_slower(self.model(found)))
                        .collect();
                    self.plan_ahead(&found);
                    found.into_iter().find(|found| {
                        self.weigh(found.clone());
                        self.merit_of(found).is_some_and(|other| other < merit)
                    })
                });
                let Some(better) = better else { break };
                from = better;
            }
        }
    }

    /// What the objective comes to for parameters whose plan is sound.
    fn merit_of(&self, found: &VcutParameters) -> Option<f64> {
        let sound = self.sound.iter().find(|sound| alike(&sound.parameters, found))?;
        Some(sound.figures.merit(self.asked.objective.value))
    }

    /// Goes over layers a little larger than the best one. Right at a wall, which of them are sound changes with every tip that
    /// happens to lie there, back and forth.
    pub(super) fn comb(&mut self) {
        (self.plans_left, self.most_plans) = (None, &TEETH_PLANNED);
        let Some(best) = self.sound.first() else { return };
        let from = best.parameters.clone();
        let teeth: Vec<VcutParameters> = (1..=TEETH)
            .filter_map(|tooth| self.beside(&from, libm::pow(APART, f64::from(tooth)), [0, 1, 0]))
            .collect();
        for next in teeth.chunks(AHEAD) {
            let worth: Vec<&VcutParameters> = next
                .iter()
                .filter(|found| !self.is_slower(self.model(found)))
                .collect();
            self.plan_ahead(worth);
            for found in next {
                self.weigh_if_promising(found.clone());
            }
        }
    }

    /// The parameters with swing, layer and overlap changed by a factor.
    pub(super) fn beside(
        &self,
        from: &VcutParameters,
        factor: f64,
        [swing, layer, overlap]: Move,
    ) -> Option<VcutParameters> {
        let swing = changed(self.asked.swing.value, from.swing, swing, |way| {
            let bounds = self.asked.limits.swing;
            let changed = thousandths(from.swing * libm::pow(factor, f64::from(way)));
            bounds.most.map_or(
                changed,
                |most| if changed > most.value { most.value } else { changed },
            )
        })?;
        let layer = changed(self.asked.layer.value, from.layer, layer, |way| {
            Length::mm(grid::down(from.layer.to_mm() * libm::pow(factor, f64::from(way))))
        })?;
        let is_angle = swing < Angle::deg(89.0) && swing > Angle::deg(1.0);
        if !is_angle || layer <= Length::ZERO {
            return None;
        }
        let swung = Swung::new(self.asked, from.lattice, swing)?;
        let by = (factor - 1.0) / 2.0 * f64::from(overlap);
        let (step, overlap) = match (self.asked.step.value, overlap) {
            (Auto::Given(step), 0) => (step, swung.overlap(layer, step)),
            (Auto::Auto, 0) if self.is_step_of_the_blade() => swung.widest_fitting_step(layer)?,
            (Auto::Auto, 0) => (swung.widest_step(layer, from.overlap), from.overlap),
            (Auto::Auto, _) if self.has_open_overlap() => {
                let overlap = from.overlap + by;
                if from.overlap <= 0.0 && by < 0.0 || from.overlap >= MOST_OVERLAP && by > 0.0 {
                    return None;
                }
                let overlap = overlap.clamp(0.0, MOST_OVERLAP);
                (swung.widest_step(layer, overlap), overlap)
            }
            (Auto::Given(_) | Auto::Auto, _) => return None,
        };
        swung
            .parameters(layer, step, overlap)
            .filter(|found| self.is_within(found))
    }
}

/// A value that is open, changed; none where a given one is to be.
fn changed<T>(asked: Auto<T>, from: T, way: i32, change: impl Fn(i32) -> T) -> Option<T> {
    match (asked, way) {
        (_, 0) => Some(from),
        (Auto::Auto, way) => Some(change(way)),
        (Auto::Given(_), _) => None,
    }
}
