//! Parameters by what is left in truth.
//!
//! The formulas hold a lattice's scallop bound [Cui 12] against the limit. That is always sound, and often far from what a
//! planned program leaves, for its residual strategy puts tips onto the part. So the search for parameters is repeated with
//! laxer limits on scallop, and with swings and layers beside the best ones; each outcome is planned, written down and
//! replayed. Only what leaves no more than the job's own limit, with every chip free, is sound. Where none of these is sound,
//! smaller swings and layers are tried until one is ([`spread`]). The best few sound ones are the [`Finalist`]s: they
//! are compared again along the routes and with the residual strategies that they would be cut by.
//!
//! Soundness does not grow or shrink steadily with a parameter, so this is a search, not a proof of least time: the best of a
//! bounded number of plans.

mod around;
mod spread;

use super::bench::Bench;
use super::{Contender, MOST_CUTS_COMPARED, limits, route};
use crate::diag::{Code, Diagnostic};
use crate::job::{Auto, CheckedJob, Formulas, Lattice, Objective, Residual, RoughVcut, Sourced};
use crate::plan::decision::Standing;
use crate::plan::floor::Floor;
use crate::plan::optimum::Bound;
use crate::plan::parameters::{self, ScallopBy, VcutParameters};
use crate::plan::{LaidOut, lay_out};
use rayon::prelude::*;
use vcutc_backend_api::units::{Angle, Duration, Length};

/// Most plans that are tried, by the number of cuts of the first one: below the first number the second.
const PLANS: [(usize, usize); 3] = [(500, 48), (2_000, 24), (MOST_CUTS_COMPARED, 6)];

/// Into how many equal ratios the way from the limit to the freest bound is divided.
const RUNGS: u32 = 5;

/// How often the way between a sound limit and an unsound one is halved.
const HALVINGS: usize = 3;

/// A candidate that by the model takes this many times as long as the best one is not planned.
const BEHIND: f64 = 1.15;

/// Most finalists of operations of up to so many cuts.
const FINALISTS: [(usize, usize); 2] = [(2_000, 3), (MOST_CUTS_COMPARED, 2)];

/// Parameters that are to be compared along the routes that they would be cut by.
pub(super) struct Finalist {
    pub(super) parameters: VcutParameters,
    pub(super) found: FoundBy,
}

/// How parameters were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FoundBy {
    /// By formulas alone.
    Formulas,
    /// By what the simulated plan leaves.
    Simulation,
}

impl FoundBy {
    /// In words.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Formulas => "by the lattice's bound",
            Self::Simulation => "as simulated",
        }
    }
}

/// What the search came to.
pub(super) struct Found {
    /// The best ones; at least one.
    pub(super) finalists: Vec<Finalist>,
    /// What came of the formulas' parameters, where they are no finalist.
    pub(super) by_formulas: Option<Standing>,
}

impl Found {
    /// Whether the formulas' choice stands, with more cuts by the model than are compared.
    pub(super) fn is_large(&self, job: &CheckedJob, asked: &RoughVcut) -> bool {
        match &self.finalists[..] {
            [only] if only.found == FoundBy::Formulas => {
                let found = &only.parameters;
                let model = found.time_model(job, asked);
                model.cuts(found.layer, found.step) > MOST_CUTS_COMPARED as f64
            }
            _ => false,
        }
    }
}

/// The best parameters on one of these lattices.
pub(super) fn parameters(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
    cuts_left: usize,
) -> Result<Found, Vec<Diagnostic>> {
    let mut told = Vec::new();
    let by_bound = parameters::resolve_on(bench.job, &of_model(asked), lattices.to_vec(), &mut told);
    let is_conflict = told.iter().all(|one| one.code == Code::LimitsConflict);
    if !is_searched(asked) || (by_bound.is_none() && !(is_conflict && asked.limits.scallop.is_some())) {
        return plain(by_bound, told);
    }
    let mut trials = Trials::new(bench, asked, lattices, cuts_left);
    let first = trials.search(by_bound.as_ref());
    let (finalists, leaves_too_much) = (trials.finalists(by_bound.as_ref()), trials.leaves_too_much);
    if finalists.is_empty() {
        return plain(by_bound, told);
    }
    let is_by_bound = |found: &VcutParameters| by_bound.as_ref().is_some_and(|bound| alike(bound, found));
    let named = |parameters: VcutParameters| {
        if is_by_bound(&parameters) {
            Finalist {
                parameters,
                found: FoundBy::Formulas,
            }
        } else {
            Finalist {
                parameters: held_by_simulation(asked, parameters, leaves_too_much),
                found: FoundBy::Simulation,
            }
        }
    };
    let finalists: Vec<Finalist> = finalists.into_iter().map(named).collect();
    let is_in = finalists.iter().any(|one| one.found == FoundBy::Formulas);
    Ok(Found {
        finalists,
        by_formulas: first.filter(|_| !is_in),
    })
}

/// Says of parameters by what the limit on scallop was held against them.
fn held_by_simulation(
    asked: &RoughVcut,
    mut parameters: VcutParameters,
    leaves_too_much: bool,
) -> VcutParameters {
    parameters.binding.retain(|&bound| bound != Bound::Scallop);
    if leaves_too_much {
        parameters.binding.push(Bound::Scallop);
    }
    let bound = parameters.scallop_bound(asked);
    if asked.limits.scallop.is_some_and(|limit| bound > limit.value) {
        parameters.scallop_by = ScallopBy::Simulation;
    }
    parameters
}

/// What the formulas say.
fn plain(by_bound: Option<VcutParameters>, told: Vec<Diagnostic>) -> Result<Found, Vec<Diagnostic>> {
    by_bound.ok_or(told).map(|parameters| Found {
        finalists: vec![Finalist {
            parameters,
            found: FoundBy::Formulas,
        }],
        by_formulas: None,
    })
}

/// Whether the plan has a say in the parameters. The formulas of the paper stand as they are printed.
pub(super) fn is_searched(asked: &RoughVcut) -> bool {
    let is_open = asked.swing.value == Auto::Auto
        || asked.layer.value == Auto::Auto
        || (asked.step.value == Auto::Auto
            && asked.overlap.value == Auto::Auto
            && asked.limits.scallop.is_some());
    let is_planned = match asked.objective.value {
        Objective::Time | Objective::Cuts => true,
        Objective::Scallop | Objective::BladeLoad => false,
    };
    is_open && is_planned && asked.formulas.value == Formulas::Exact
}

/// What is asked of the model: where plans are searched, those are held to the limits on time and cuts.
pub(super) fn of_model(asked: &RoughVcut) -> RoughVcut {
    if is_searched(asked) {
        limits::of_plans(asked)
    } else {
        asked.clone()
    }
}

/// The parameters if nothing were known of the scallop.
pub(super) fn freest(bench: &Bench<'_>, asked: &RoughVcut, lattice: Lattice) -> Option<VcutParameters> {
    let mut assumed = of_model(asked);
    if is_searched(asked) {
        assumed.limits.scallop = None;
    }
    parameters::possible_on(bench.job, &assumed, vec![lattice])
}

/// Whether the same cuts come of both.
fn alike(one: &VcutParameters, two: &VcutParameters) -> bool {
    (one.lattice, one.swing, one.layer, one.step) == (two.lattice, two.swing, two.layer, two.step)
}

/// A plan with nothing wrong.
struct Sound {
    parameters: VcutParameters,
    merit: f64,
    cuts: usize,
    model: Duration,
}

/// Parameters that were planned, and what came of them.
struct Tried {
    parameters: VcutParameters,
    standing: Standing,
}

/// How many plans are made side by side, whatever the number of threads. Only those that are then weighed count, so what comes
/// of the search is the same as one after the other.
const AHEAD: usize = 2;

/// What comes of parameters when they are planned.
#[derive(Clone, Copy)]
enum Outcome {
    /// There are no cuts, or too many.
    Impossible,
    /// More cuts than are compared.
    TooLarge { cuts: usize },
    /// A plan.
    Planned {
        cuts: usize,
        standing: Standing,
        merit: f64,
    },
}

struct Trials<'t> {
    bench: &'t Bench<'t>,
    asked: &'t RoughVcut,
    lattices: &'t [Lattice],
    cuts_left: usize,
    floor: Floor<'t>,
    /// How many plans may still be made; not known before the first one.
    plans_left: Option<usize>,
    /// How many plans there are in all, by the cuts of the first one.
    most_plans: &'static [(usize, usize)],
    tried: Vec<Tried>,
    /// What was planned ahead and perhaps is asked for next.
    ahead: Vec<(VcutParameters, Outcome)>,
    /// The best first.
    sound: Vec<Sound>,
    leaves_too_much: bool,
}

impl<'t> Trials<'t> {
    fn new(bench: &'t Bench<'t>, asked: &'t RoughVcut, lattices: &'t [Lattice], cuts_left: usize) -> Self {
        Self {
            bench,
            asked,
            lattices,
            cuts_left,
            floor: Floor::new(bench.job, bench.work()),
            plans_left: None,
            most_plans: &PLANS,
            tried: Vec::new(),
            ahead: Vec::new(),
            sound: Vec::new(),
            leaves_too_much: false,
        }
    }

    /// The whole search; what came of the formulas' parameters.
    fn search(&mut self, by_bound: Option<&VcutParameters>) -> Option<Standing> {
        let first = by_bound.and_then(|found| self.weigh(found.clone()));
        self.climb();
        self.spread();
        self.wander();
        self.comb();
        first
    }

    /// The best few, the best first, and the formulas' parameters if they are sound.
    fn finalists(&self, by_bound: Option<&VcutParameters>) -> Vec<VcutParameters> {
        let Some(best) = self.sound.first() else {
            return Vec::new();
        };
        let most = FINALISTS.iter().find(|(below, _)| best.cuts < *below);
        let most = most.map_or(1, |&(_, count)| count);
        self.sound
            .iter()
            .enumerate()
            .filter(|(rank, sound)| {
                *rank < most || (most > 1 && by_bound.is_some_and(|bound| alike(bound, &sound.parameters)))
            })
            .map(|(_, sound)| sound.parameters.clone())
            .collect()
    }

    fn may_go_on(&self) -> bool {
        self.plans_left != Some(0)
    }

    /// What comes of parameters; none where no more plans may be made or none can be.
    fn weigh(&mut self, found: VcutParameters) -> Option<Standing> {
        let known = self.tried.iter().find(|tried| alike(&tried.parameters, &found));
        if let Some(known) = known {
            return Some(known.standing);
        }
        if !self.may_go_on() || !self.may_be_sound(&found) {
            return None;
        }
        let model = self.model(&found);
        let known = self.ahead.iter().find(|(planned, _)| *planned == found);
        let outcome = known.map_or_else(|| self.outcome(&found), |(_, outcome)| *outcome);
        let (cuts, standing, merit) = match outcome {
            Outcome::Impossible => {
                self.spend(MOST_CUTS_COMPARED - 1);
                return Some(self.note(found, Standing::Impossible));
            }
            Outcome::TooLarge { cuts } => {
                self.spend(cuts);
                return None;
            }
            Outcome::Planned {
                cuts,
                standing,
                merit,
            } => (cuts, standing, merit),
        };
        self.spend(cuts);
        if standing.time().is_some() {
            self.keep(Sound {
                parameters: found.clone(),
                merit,
                cuts,
                model,
            });
        }
        self.leaves_too_much |= matches!(standing, Standing::Leaves { .. });
        Some(self.note(found, standing))
    }

    /// Plans parameters.
    fn outcome(&self, found: &VcutParameters) -> Outcome {
        let laid = lay_out(
            self.bench.job,
            self.asked,
            found.clone(),
            self.cuts_left,
            self.bench.work(),
        );
        let Ok(laid) = laid else {
            return Outcome::Impossible;
        };
        let cuts = laid.vcut.cuts.len();
        if cuts > MOST_CUTS_COMPARED {
            return Outcome::TooLarge { cuts };
        }
        let limit = self.asked.limits.scallop.map(|limit| limit.value);
        let weighed = self.bench.weigh(self.along_its_route(laid));
        let Contender { standing, merit, .. } = weighed.held_to(limit, &self.held_to());
        Outcome::Planned {
            cuts,
            standing,
            merit,
        }
    }

    /// Plans those that would be weighed next as far as can be seen, side by side.
    fn plan_ahead<'f>(&mut self, next: impl IntoIterator<Item = &'f VcutParameters>) {
        if !self.may_go_on() {
            self.ahead.clear();
            return;
        }
        let is_new = |found: &&VcutParameters| {
            !self.is_behind(self.model(found))
                && !self.tried.iter().any(|tried| alike(&tried.parameters, found))
                && self.may_be_sound(found)
        };
        let worth: Vec<&VcutParameters> = next.into_iter().filter(is_new).collect();
        let planned = worth
            .into_par_iter()
            .map(|found| (found.clone(), self.outcome(found)));
        self.ahead = planned.collect();
    }

    /// Whether parameters are worth a plan, as far as is known before.
    fn may_be_sound(&self, found: &VcutParameters) -> bool {
        !self.is_too_large(found) && !self.must_leave_too_much(found)
    }

    /// Whether there will be far more cuts than are compared, by the model: to lay them out takes long.
    fn is_too_large(&self, found: &VcutParameters) -> bool {
        let model = found.time_model(self.bench.job, self.asked);
        model.cuts(found.layer, found.step) > 1.5 * MOST_CUTS_COMPARED as f64
    }

    /// The operation along its usual route, or along the fastest one where its time is limited and something else made small.
    fn along_its_route(&self, laid: LaidOut) -> LaidOut {
        match (self.asked.objective.value, self.asked.limits.time) {
            (Objective::Cuts, Some(_)) => route::best(self.bench, laid),
            (Objective::Time | Objective::Cuts | Objective::Scallop | Objective::BladeLoad, _) => {
                route::usual(self.bench, laid)
            }
        }
    }

    /// What plans are held to: all but the limit on what is made small, which the best one keeps if any does.
    fn held_to(&self) -> RoughVcut {
        let mut held = self.asked.clone();
        match held.objective.value {
            Objective::Time => held.limits.time = None,
            Objective::Cuts => held.limits.cuts = None,
            Objective::Scallop | Objective::BladeLoad => {}
        }
        held
    }

    fn note(&mut self, parameters: VcutParameters, standing: Standing) -> Standing {
        self.tried.push(Tried { parameters, standing });
        standing
    }

    /// Puts a sound plan in its place; behind its equals.
    fn keep(&mut self, sound: Sound) {
        let rank = self.sound.partition_point(|other| other.merit <= sound.merit);
        self.sound.insert(rank, sound);
    }

    /// Counts a plan.
    fn spend(&mut self, cuts: usize) {
        let left = self.plans_left.unwrap_or_else(|| {
            let fitting = self.most_plans.iter().find(|(below, _)| cuts < *below);
            fitting.map_or(1, |&(_, plans)| plans)
        });
        self.plans_left = Some(left.saturating_sub(1));
    }

    fn model(&self, found: &VcutParameters) -> Duration {
        found
            .time_model(self.bench.job, self.asked)
            .estimate(found.swing, found.layer, found.step)
    }

    fn resolve(&self, assumed: &RoughVcut) -> Option<VcutParameters> {
        parameters::possible_on(self.bench.job, assumed, self.lattices.to_vec())
    }

    /// The parameters under another limit on scallop.
    fn under(&self, limit: Option<Length>) -> Option<VcutParameters> {
        let mut assumed = limits::of_plans(self.asked);
        assumed.limits.scallop = limit.map(|value| Sourced { value, span: None });
        self.resolve(&assumed)
    }

    /// From the freest parameters down to a limit that is sound, and up again by halves.
    fn climb(&mut self) {
        let Some(limit) = self.asked.limits.scallop else {
            return;
        };
        let Some(free) = self.under(None) else { return };
        let most = free.scallop_bound(self.asked);
        if self.is_sound(free) || most <= limit.value {
            return;
        }
        let ratio = most.to_mm() / limit.value.to_mm();
        let at = |share: f64| Some(limit.value * libm::pow(ratio, share));
        let share = |rung: u32| f64::from(rung) / f64::from(RUNGS);
        let mut unsound = 1.0;
        let mut sound = 0.0;
        for rung in (1..RUNGS).rev() {
            if self
                .under(at(share(rung)))
                .is_some_and(|found| self.is_sound(found))
            {
                sound = share(rung);
                break;
            }
            unsound = share(rung);
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(sound, unsound);
            if self.under(at(middle)).is_some_and(|found| self.is_sound(found)) {
                sound = middle;
            } else {
                unsound = middle;
            }
        }
    }

    fn is_sound(&mut self, found: VcutParameters) -> bool {
        self.weigh(found)
            .is_some_and(|standing| standing.time().is_some())
    }

    fn weigh_if_promising(&mut self, found: VcutParameters) {
        if !self.is_behind(self.model(&found)) {
            self.weigh(found);
        }
    }

    /// Whether a time by the model is far behind that of the best one.
    fn is_behind(&self, model: Duration) -> bool {
        match self.asked.objective.value {
            Objective::Time => self.sound.first().is_some_and(|best| model > best.model * BEHIND),
            Objective::Cuts | Objective::Scallop | Objective::BladeLoad => false,
        }
    }

    /// Whether parameters keep the job's limits. Swing and layer that are given are taken as they are, with a step that may
    /// keep no limit, for the proof to judge; those that are tried here are not the job's.
    fn is_within(&self, found: &VcutParameters) -> bool {
        let limits = &self.asked.limits;
        limits.swing.hold(found.swing)
            && limits.layer.hold(found.layer)
            && limits.step.hold(found.step)
            && found.lattice_fits()
    }

    /// Whether the overlap is open, and more of it may help: without a limit on scallop the formulas choose it.
    fn has_open_overlap(&self) -> bool {
        self.asked.step.value == Auto::Auto
            && self.asked.overlap.value == Auto::Auto
            && self.asked.limits.scallop.is_some()
    }

    /// Whether step and overlap are open, and as wide as the blade's reach allows.
    fn is_step_of_the_blade(&self) -> bool {
        self.asked.step.value == Auto::Auto
            && self.asked.overlap.value == Auto::Auto
            && self.asked.limits.scallop.is_none()
    }

    /// The least that any plan of a lattice can leave with its tips in their columns, where that is no more than may stay.
    fn least_left(&self, found: &VcutParameters) -> Option<Length> {
        let limit = self.asked.limits.scallop?;
        let followed = self.floor.followed(found.flanks.slope);
        followed.of_lattice(found, limit.value)
    }

    /// Whether a plan must leave too much.
    fn must_leave_too_much(&self, found: &VcutParameters) -> bool {
        let moves_tips = self.asked.residual.value == Auto::Given(Residual::Shift);
        !moves_tips && self.asked.limits.scallop.is_some() && self.least_left(found).is_none()
    }
}

/// Overlaps are tried up to this, as the formulas do.
const MOST_OVERLAP: f64 = 0.95;

/// Swings are chosen to a thousandth of a degree.
fn thousandths(swing: Angle) -> Angle {
    Angle::deg((swing.to_deg() * 1000.0).floor() / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Latitude;
    use crate::geom::curve::Point2;
    use crate::job::Operation;
    use crate::plan::tests::{operation, paper_job};
    use crate::sim::surface::Surface;

    /// Plans of the formulas' choice and laxer limits, of the spread and its turns, of the changes, and of layers close to the best one.
    const MOST: usize = 48 + 72 + 72 + 48 + 10;

    #[test]
    fn the_search_is_bounded() {
        let heights: [fn(f64) -> f64; 3] = [
            |x| 20.0 + 3.0 * libm::sin(x / 9.0),
            |x| (30.0 - 8.0 * (x - 40.0)).clamp(10.0, 30.0),
            |x| if x < 42.0 { 10.0 } else { 40.0 },
        ];
        for height in heights {
            for scallop in [0.02, 0.4, 3.0, 20.0] {
                let corners = (0..=85).map(f64::from).map(|x| Point2 { x, z: height(x) });
                let mut job = paper_job(corners.collect());
                let asked = operation(&mut job);
                asked.swing.value = Auto::Auto;
                asked.layer.value = Auto::Auto;
                asked.step.value = Auto::Auto;
                asked.limits.scallop = Some(Sourced {
                    value: Length::mm(scallop),
                    span: None,
                });
                let Operation::RoughVcut(asked) = job.operations[0].clone();
                let untouched = Surface::flat(job.stock.width.to_mm(), job.stock.height.to_mm());
                let bench = Bench::new(&job, &asked, untouched, Latitude::Full);
                for lattice in [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free] {
                    let by_bound = parameters::resolve_on(&job, &asked, vec![lattice], &mut Vec::new());
                    let lattices = [lattice];
                    let mut trials = Trials::new(&bench, &asked, &lattices, 1_000_000);
                    trials.search(by_bound.as_ref());
                    assert!(trials.tried.len() <= MOST, "{}", trials.tried.len());
                }
            }
        }
    }
}
