//! Swings, steps, layers and overlaps over all that a job leaves open: what is better than what the formulas found may lie far
//! from it. Where nothing of it is sound, the search goes on from what leaves the least, or the fewest chips, to what leaves
//! less, step by step.
//!
//! Walls steeper than the flanks are followed by small swings only, thick blades leave little at wide ones only, and a fine
//! surface asks for small steps; which of them a part needs, no formula says. But what a swing or a step can leave at the
//! least is cheap to know ([`Floor`](crate::plan::floor::Floor)). So swings and steps that leave too much even so are left out,
//! and of each swing the widest steps that do not are found, before anything is planned.

use super::around::{FACTORS, MOVES};
use super::forecast::Forecast;
use super::{AHEAD, Goal, MOST_OVERLAP, Trials, alike, thousandths};
use crate::asked::Lattice;
use crate::choice::MOST_CUTS_COMPARED;
use crate::plan::decision::Standing;
use crate::plan::parameters::{Swung, VcutParameters};
use crate::plan::residual::least_gain;
use core::cmp::Ordering;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::grid;
use vcutc_job::Auto;

/// Most plans of the spread, by the number of cuts of the first one: below the first number the second.
const PLANS: [(usize, usize); 3] = [(500, 72), (2_000, 36), (MOST_CUTS_COMPARED, 12)];

/// After more plans than this since the best one, others are not planned.
const PATIENCE: usize = 16;

/// Most plans in turns where nothing of the spread is sound, in the same way.
const IN_TURNS: [(usize, usize); 3] = [(500, 72), (2_000, 24), (MOST_CUTS_COMPARED, 6)];

/// The widest swing to begin with where the job sets no limit.
const WIDEST: Angle = Angle::deg(50.0);

/// Swings as shares of the widest one.
const SWINGS: [f64; 7] = [1.0, 0.86, 0.74, 0.63, 0.5, 0.38, 0.27];

/// Swings beyond the widest to begin with, where the job sets no limit and asks for a surface that they may be needed for.
const WIDER: [Angle; 4] = [
    Angle::deg(60.0),
    Angle::deg(70.0),
    Angle::deg(77.0),
    Angle::deg(82.0),
];

/// More of both for fitted lattices, of which all are counted.
const CLOSER_SWINGS: [f64; 4] = [0.95, 0.9, 0.8, 0.68];
const CLOSER_WIDER: [Angle; 4] = [
    Angle::deg(53.0),
    Angle::deg(56.0),
    Angle::deg(65.0),
    Angle::deg(73.0),
];

/// Swings that may be needed beside walls.
const NARROWER: [Angle; 5] = [
    Angle::deg(10.0),
    Angle::deg(7.5),
    Angle::deg(5.5),
    Angle::deg(4.0),
    Angle::deg(3.0),
];

/// How often the way between a swing that can leave little enough and one that cannot is halved.
const HALVINGS: u32 = 6;

/// The widest swing that can leave little enough does so only with the closest steps; these shares of it have wider ones.
const WITHIN: [f64; 3] = [0.97, 0.92, 0.84];

/// Overlaps. Orthogonal lattices have their largest layer at a half.
const OVERLAPS: [f64; 3] = [0.0, 0.3, 0.5];

/// Layers as shares of the largest one at a swing.
const LAYERS: [f64; 6] = [1.0, 0.87, 0.72, 0.5, 0.33, 0.2];

/// Layers of fitted lattices as shares of the largest one at a swing.
const FITTED_LAYERS: [f64; 9] = [1.0, 0.95, 0.9, 0.85, 0.79, 0.72, 0.64, 0.5, 0.33];

/// Into how many steps of the last row one of the rows above is divided at least.
const FITTED_PARTS: [f64; 3] = [1.0, 2.0, 3.0];

/// The first step that is compared with the limit, as a share of the one that leaves as much on a level part.
const WIDEST_STEP: f64 = 1.4;

/// Each step that is compared with the limit as a share of the one before.
const CLOSER: f64 = 0.95;

/// As many of them: down to an eighth.
const MOST_STEPS: i32 = 40;

/// Most steps of a swing that are tried, and how far apart they are at least.
const STEPS: usize = 4;
const APART: f64 = 0.93;

/// Whether a lattice of the spread is likely to leave no more than it may.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outlook {
    /// Even if every tip lies higher than it could by what is not worth a cut.
    Good,
    /// Only if tips lie as low as they can.
    Open,
}

impl Trials<'_> {
    /// Goes over the spread until no better one has come for a while, and on until something is sound.
    pub(super) fn spread(&mut self) {
        (self.plans_left, self.most_plans) = (None, &PLANS);
        self.spread_from = Some(self.tried.len());
        let forecasts = self.forecasts();
        // What is likely to be sound first, until something is.
        for one in &forecasts {
            if !self.sound.is_empty() {
                break;
            }
            if self.outlook(&one.parameters) == Outlook::Good {
                self.weigh_if_promising(one.parameters.clone());
            }
        }
        self.in_order(&forecasts, Self::is_likely_sound);
        // Where that filter knows too little.
        if self.sound.is_empty() || !self.is_bound_to_columns() {
            self.in_order(&forecasts, Self::may_be_sound_anyhow);
        }
        if self.sound.is_empty() {
            self.in_turns(&forecasts);
        }
        while self.sound.is_empty() && self.may_go_on() {
            if !self.has_better_neighbour() {
                break;
            }
        }
        (self.plans_left, self.most_plans) = (None, &super::PLANS);
    }

    /// One after the other, until no better one has come for a while.
    fn in_order(&mut self, forecasts: &[Forecast], is_likely: fn(&Self, &Forecast) -> bool) {
        self.since_best = 0;
        let mut next = forecasts.iter().peekable();
        while next.peek().is_some() && self.may_go_on() {
            if !self.sound.is_empty() && self.since_best > PATIENCE * self.times() {
                return;
            }
            let mut worth: Vec<&Forecast> = Vec::new();
            while worth.len() < AHEAD
                && let Some(one) = next.next()
            {
                let is_twice = worth
                    .iter()
                    .any(|other| alike(&other.parameters, &one.parameters));
                if !is_twice && self.is_worth_a_plan(one) && is_likely(self, one) {
                    worth.push(one);
                }
            }
            self.plan_ahead(worth.iter().map(|one| &one.parameters));
            for one in worth {
                self.weigh(one.parameters.clone());
            }
        }
    }

    fn is_worth_a_plan(&self, one: &Forecast) -> bool {
        let is_promising = match self.goal {
            Goal::Best => true,
            Goal::Any => !self.is_slower(self.model(&one.parameters)),
        };
        let is_known = self
            .tried
            .iter()
            .any(|tried| alike(&tried.parameters, &one.parameters));
        is_promising && !is_known
    }

    /// Whether more may be sound than what leaves little by its columns.
    fn may_be_sound_anyhow(&self, one: &Forecast) -> bool {
        !self.is_bound_to_columns() || self.leaves_little(one)
    }

    /// Swing after swing, the narrowest first, one plan of each and then the next of each, until something is sound: those
    /// that are forecast to be best all have wide swings, and beside a wall none of those may do.
    fn in_turns(&mut self, forecasts: &[Forecast]) {
        (self.plans_left, self.most_plans) = (None, &IN_TURNS);
        let mut by_swing: Vec<(Angle, Vec<&VcutParameters>)> = Vec::new();
        for Forecast { parameters, .. } in forecasts {
            match by_swing.iter_mut().find(|(swing, _)| *swing == parameters.swing) {
                Some((_, of_swing)) => of_swing.push(parameters),
                None => by_swing.push((parameters.swing, vec![parameters])),
            }
        }
        by_swing.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let longest = by_swing.iter().map(|(_, of_swing)| of_swing.len()).max();
        for turn in 0..longest.unwrap_or(0) {
            for (_, of_swing) in &by_swing {
                if !self.sound.is_empty() || !self.may_go_on() {
                    return;
                }
                if let Some(&found) = of_swing.get(turn) {
                    self.weigh_if_promising(found.clone());
                }
            }
        }
    }

    /// All parameters of the spread.
    pub(super) fn spots(&self) -> Vec<VcutParameters> {
        let mut spots = Vec::new();
        for &lattice in self.lattices {
            for swing in self.swings() {
                if self.bench.wanted.is_needless() {
                    break;
                }
                let Some(swung) = Swung::new(self.asked, lattice, swing) else {
                    continue;
                };
                if lattice == Lattice::Fitted {
                    self.spots_fitted(&swung, &mut spots);
                } else if self.is_step_of_the_blade() {
                    self.spots_by_reach(&swung, &mut spots);
                } else {
                    self.spots_by_overlap(&swung, &mut spots);
                    self.spots_by_step(&swung, &mut spots);
                }
            }
        }
        spots
    }

    /// The swings that are open and can leave little enough.
    pub(super) fn swings(&self) -> Vec<Angle> {
        let limits = self.asked.limits.swing;
        let widest = match (self.asked.swing.value, limits.most) {
            (Auto::Given(swing), _) => return vec![swing],
            (Auto::Auto, most) => most.map_or(WIDEST, |most| most.value),
        };
        let mut swings: Vec<Angle> = SWINGS.map(|share| thousandths(widest * share)).to_vec();
        if self.is_fitted() {
            swings.extend(CLOSER_SWINGS.map(|share| thousandths(widest * share)));
        }
        if self.asked.limits.scallop.is_none() {
            return swings;
        }
        if limits.most.is_none() {
            swings.extend(WIDER);
            if self.is_fitted() {
                swings.extend(CLOSER_WIDER);
            }
        }
        swings.extend(NARROWER.into_iter().filter(|&narrow| narrow < widest));
        swings.retain(|&swing| limits.hold(swing));
        swings.sort_by(|one, other| other.total_cmp(one));
        let (can, cannot): (Vec<Angle>, Vec<Angle>) =
            swings.into_iter().partition(|&swing| self.can_follow(swing));
        let Some(&widest) = can.first() else {
            return Vec::new();
        };
        let beyond = cannot.into_iter().rfind(|&swing| swing > widest);
        let edge = beyond.map_or(widest, |beyond| self.widest_between(widest, beyond));
        let within = WITHIN.map(|share| thousandths(edge * share));
        can.into_iter()
            .chain([edge])
            .chain(within.into_iter().filter(|&swing| self.can_follow(swing)))
            .filter(|&swing| limits.hold(swing))
            .collect()
    }

    /// Whether the flanks of a swing can leave no more than the limit, however close they are.
    fn can_follow(&self, swing: Angle) -> bool {
        let Some(limit) = self.asked.limits.scallop else {
            return true;
        };
        // All lattices have the same flanks.
        let lattice = self.lattices.first().copied().unwrap_or(Lattice::Orthogonal);
        Swung::new(self.asked, lattice, swing).is_some_and(|swung| {
            let followed = self.floor.followed(swung.flanks.slope);
            followed.of_flanks(swung.drop(), limit.value).is_some()
        })
    }

    /// The widest swing that can follow the part, between one that can and one that cannot.
    fn widest_between(&self, can: Angle, cannot: Angle) -> Angle {
        let (mut can, mut cannot) = (can, cannot);
        for _ in 0..HALVINGS {
            let middle = thousandths((can + cannot) / 2.0);
            if self.can_follow(middle) {
                can = middle;
            } else {
                cannot = middle;
            }
        }
        can
    }

    /// The largest layer that the blade reaches, and smaller ones, each with its widest step.
    fn spots_by_reach(&self, swung: &Swung<'_>, spots: &mut Vec<VcutParameters>) {
        let layers: Vec<Length> = match self.asked.layer.value {
            Auto::Given(layer) => vec![layer],
            Auto::Auto => shares(swung.largest_layer()),
        };
        for layer in layers {
            if let Some((step, overlap)) = swung.widest_fitting_step(layer) {
                self.add(swung.parameters(layer, step, overlap), spots);
            }
        }
    }

    /// The largest layer whose Vs just meet, and smaller ones, with steps of the last row of which a whole number makes one of theirs.
    fn spots_fitted(&self, swung: &Swung<'_>, spots: &mut Vec<VcutParameters>) {
        let layers: Vec<Length> = match self.asked.layer.value {
            Auto::Given(layer) => vec![layer],
            Auto::Auto => FITTED_LAYERS
                .map(|share| Length::mm(grid::down(swung.layer_at_overlap(0.0).to_mm() * share)))
                .to_vec(),
        };
        for layer in layers {
            let steps = match (self.asked.step.value, self.asked.overlap.value) {
                (Auto::Given(step), _) => vec![step],
                (Auto::Auto, Auto::Given(overlap)) => vec![swung.widest_step(layer, overlap)],
                (Auto::Auto, Auto::Auto) => FITTED_PARTS
                    .map(|parts| swung.widest_step(layer, 1.0 - 1.0 / parts))
                    .to_vec(),
            };
            for step in steps {
                let limit = self.asked.limits.step.most;
                let step = limit.map_or(step, |most| step.min(Length::mm(grid::down(most.value.to_mm()))));
                self.add(swung.parameters(layer, step, swung.overlap(layer, step)), spots);
            }
        }
    }

    /// The largest layers at some overlaps, and smaller ones.
    fn spots_by_overlap(&self, swung: &Swung<'_>, spots: &mut Vec<VcutParameters>) {
        let overlaps: Vec<f64> = match self.asked.overlap.value {
            Auto::Given(overlap) => vec![overlap],
            Auto::Auto if self.has_open_overlap() => OVERLAPS.to_vec(),
            // The step is given, and the overlap follows from it.
            Auto::Auto => vec![0.0],
        };
        for overlap in overlaps {
            let layers: Vec<Length> = match (self.asked.layer.value, self.asked.step.value) {
                (Auto::Given(layer), _) => vec![layer],
                (Auto::Auto, Auto::Given(step)) => shares(swung.layer_at_step(step).unwrap_or(Length::ZERO)),
                (Auto::Auto, Auto::Auto) => shares(swung.layer_at_overlap(overlap)),
            };
            for layer in layers {
                let step = self.asked.step.value.or(swung.widest_step(layer, overlap));
                let overlap = match self.asked.step.value {
                    Auto::Given(_) => swung.overlap(layer, step),
                    Auto::Auto => overlap,
                };
                self.add(swung.parameters(layer, step, overlap), spots);
            }
        }
    }

    /// The widest steps that can leave no more than the limit, and their layers.
    fn spots_by_step(&self, swung: &Swung<'_>, spots: &mut Vec<VcutParameters>) {
        if !self.has_open_overlap() {
            return;
        }
        for step in self.steps(swung) {
            self.spots_of_step(swung, step, spots);
        }
    }

    /// The largest layer at a step, on the grid, and smaller ones.
    pub(super) fn spots_of_step(&self, swung: &Swung<'_>, step: Length, spots: &mut Vec<VcutParameters>) {
        if !self.has_open_overlap() {
            return;
        }
        // Half a step of an interlaced lattice lies on the grid too.
        let step = Length::mm(2.0 * grid::down(step.to_mm() / 2.0));
        if step <= Length::ZERO || !self.asked.limits.step.hold(step) {
            return;
        }
        let layers: Vec<Length> = match self.asked.layer.value {
            Auto::Given(layer) => vec![layer],
            Auto::Auto => shares(swung.layer_at_step(step).unwrap_or(Length::ZERO)),
        };
        for layer in layers {
            let overlap = swung.overlap(layer, step);
            if layer >= swung.least_layer(step) && overlap <= MOST_OVERLAP {
                self.add(swung.parameters(layer, step, overlap), spots);
            }
        }
    }

    /// Some of the widest steps at which a lattice with this swing can leave no more than the limit.
    fn steps(&self, swung: &Swung<'_>) -> Vec<Length> {
        let Some(limit) = self.asked.limits.scallop else {
            return Vec::new();
        };
        let room = limit.value - self.asked.allowance.value - swung.drop();
        // Between two tips on a level part their flanks meet at half the way's rise. Interlaced tips are half a step apart.
        let apart = room * (2.0 / swung.flanks.slope);
        let level = apart * swung.tips_per_step() * WIDEST_STEP;
        let widest = level.min(self.bench.job.stock.width);
        if !self.may_pay(swung, widest) {
            return Vec::new();
        }
        let followed = self.floor.followed(swung.flanks.slope);
        let mut steps: Vec<Length> = Vec::new();
        for count in 0..MOST_STEPS {
            let step = widest * libm::pow(CLOSER, f64::from(count));
            // Half a step of an interlaced lattice lies on the grid too.
            let step = Length::mm(2.0 * grid::down(step.to_mm() / 2.0));
            let is_near = steps.last().is_some_and(|last| step > *last * APART);
            let is_allowed = step > Length::ZERO && self.asked.limits.step.hold(step);
            if is_near || !is_allowed {
                continue;
            }
            let layer = swung.least_layer(step);
            let can = swung
                .parameters(layer, step, 0.0)
                .and_then(|found| followed.of_lattice(&found, limit.value));
            if can.is_some() {
                steps.push(step);
            }
            if steps.len() == STEPS {
                break;
            }
        }
        steps
    }

    /// Whether anything with a swing and steps of up to so much may be better than what is known.
    fn may_pay(&self, swung: &Swung<'_>, widest: Length) -> bool {
        let layer = OVERLAPS
            .map(|overlap| swung.layer_at_overlap(overlap))
            .into_iter()
            .fold(Length::ZERO, Length::max);
        let step = widest.max(swung.widest_step(layer, 0.0));
        swung
            .parameters(layer, step, 0.0)
            .is_some_and(|found| !self.is_slower(self.model(&found)))
    }

    /// Adds parameters that keep what the job asks of them.
    fn add(&self, found: Option<VcutParameters>, spots: &mut Vec<VcutParameters>) {
        spots.extend(found.filter(|found| self.is_within(found)));
    }

    fn outlook(&self, found: &VcutParameters) -> Outlook {
        let Some(limit) = self.asked.limits.scallop else {
            return Outlook::Good;
        };
        let least_gain = least_gain(self.asked, found.layer);
        match self.least_left(found) {
            Some(left) if left + least_gain <= limit.value => Outlook::Good,
            Some(_) | None => Outlook::Open,
        }
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
            MOVES.into_iter().any(|moved| {
                let found = self.beside(&from, factor, moved);
                let came = found.and_then(|found| self.weigh(found));
                came.is_some_and(|came| lack(came, standing) == Ordering::Less)
            })
        })
    }
}

/// A layer and smaller ones, on the grid.
fn shares(largest: Length) -> Vec<Length> {
    LAYERS
        .into_iter()
        .map(|share| Length::mm(grid::down(largest.to_mm() * share)))
        .filter(|layer| *layer > Length::ZERO)
        .collect()
}

/// What comes nearer to being sound first: what leaves less than other plans, then what leaves fewer chips.
fn lack(one: Standing, other: Standing) -> Ordering {
    match (one, other) {
        (Standing::Fails(count), Standing::Fails(than)) => count.cmp(&than),
        (one, other) => one.compare(&other),
    }
}
