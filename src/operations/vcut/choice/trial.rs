//! Parameters by what is left in truth.
//!
//! The formulas compare a lattice's scallop bound [Cui 12] with the limit. That is always sound, and often
//! far from what a planned program leaves, because its residual strategy puts tips onto the part. So the
//! search for parameters is repeated with laxer limits on scallop ([`climb`]), over all swings, layers and
//! steps ([`spread`]) in the order of what is forecast of them ([`forecast`]), and beside the best ones
//! ([`around`]); each outcome is planned, written down and replayed. Only what leaves no more than the job's
//! own limit, with every chip free, is sound.
//!
//! Soundness does not grow or shrink steadily with a parameter, so this is a search, not a proof of least time: the best of a
//! bounded number of plans.

mod around;
mod climb;
mod forecast;
mod met;
mod spread;
#[cfg(test)]
mod tests;

pub(super) use met::TurnedDown;

use super::assumed::is_searched;
use super::bench::{Bench, Figures};
use super::redundant::{self, Skipping};
use super::{Contender, MOST_CUTS_COMPARED, Unplanned, limits, route};
use crate::asked::{Avoid, Lattice, Objective, Residual, RoughVcut};
use crate::plan::decision::Standing;
use crate::plan::floor::Floor;
use crate::plan::optimum::Bound;
use crate::plan::parameters::{self, Refusal, VcutParameters};
use crate::plan::searched::{End, Searched};
use crate::plan::{LaidOut, lay_out};
use core::cmp::Ordering;
use rayon::prelude::*;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_cancellation::Effort;
use vcutc_job::{Auto, PlanningJob};

/// Most plans that are tried, by the number of cuts of the first one: below the first number the second.
const PLANS: [(usize, usize); 3] = [(500, 48), (2_000, 24), (MOST_CUTS_COMPARED, 6)];

/// One that by the model takes this many times as long as it may is not planned where any plan within the limits will do: on
/// small parts the model is far from what is planned.
const BEYOND: f64 = 1.5;

/// One beside the best that by the model takes this many times as long as that is not planned.
const SLOWER: f64 = 1.3;

/// Lattices are given up after so many plans of the spread, if the best of them takes this many times as long as the best plan on another lattice.
const GIVEN_UP: (usize, f64) = (8, 1.5);

/// How parameters were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FoundBy {
    /// By formulas alone.
    Formulas,
    /// By what the simulated plan leaves.
    Simulation,
}

impl FoundBy {
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Formulas => "by formulas alone",
            Self::Simulation => "by simulation",
        }
    }
}

/// What the search came to.
pub(super) struct Found {
    /// The best.
    pub(super) parameters: VcutParameters,
    pub(super) by: FoundBy,
    /// The result of the formulas' parameters, where others are better.
    pub(super) by_formulas: Option<Standing>,
    /// How far it went; none where nothing was searched.
    pub(super) searched: Option<Searched>,
}

impl Found {
    /// Whether the formulas' choice stands, with more cuts by the model than are compared.
    pub(super) fn is_large(&self, job: &PlanningJob<'_>, asked: &RoughVcut) -> bool {
        let found = &self.parameters;
        self.by == FoundBy::Formulas && found.estimated_cuts(job, asked) > MOST_CUTS_COMPARED as f64
    }
}

/// The best parameters on one of these lattices. `rival` is the time of the best plan on others, which it is to beat.
pub(super) fn parameters(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
    rival: Option<Duration>,
) -> Result<Found, Unplanned> {
    let by_bound = match by_formulas(bench, asked, lattices) {
        Ok(found) if !is_searched(asked) => return Ok(plain(found, None)),
        Ok(found) => Ok(found),
        Err(refusal) if goes_on(asked, &refusal) => Err(refusal),
        Err(refusal) => return Err(refusal.into()),
    };
    let mut trials = Trials::new(bench, asked, lattices);
    trials.rival = rival;
    let by_formulas = trials.search(by_bound.as_ref().ok());
    let searched = trials.searched();
    match (trials.best(), by_bound) {
        (None, by_bound) => Ok(plain(by_bound?, searched)),
        (Some(best), Ok(bound)) if alike(&bound, &best) && !trials.is_fitted() => Ok(plain(bound, searched)),
        (Some(parameters), Ok(_) | Err(_)) => Ok(Found {
            parameters,
            by: FoundBy::Simulation,
            by_formulas,
            searched,
        }),
    }
}

/// Whether simulation may find something where the formulas find nothing.
fn goes_on(asked: &RoughVcut, refusal: &Refusal) -> bool {
    is_searched(asked) && refusal.is_conflict() && asked.limits.scallop.is_some()
}

/// What was found where any sound plan would do.
pub(super) struct Any {
    /// The first sound plan, if there was one.
    pub(super) sound: Option<(VcutParameters, Figures)>,
    /// Plans that broke limits before.
    pub(super) turned_down: Vec<TurnedDown>,
}

/// The first parameters on one of these lattices whose plan keeps all limits, of those that are searched.
pub(super) fn any(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
    effort: Effort,
) -> (Any, Effort) {
    let mut trials = Trials::new(bench, asked, lattices);
    (trials.goal, trials.effort) = (Goal::Any, effort);
    match by_formulas(bench, asked, lattices) {
        Ok(found) => {
            trials.search(Some(&found));
        }
        Err(refusal) if goes_on(asked, &refusal) => {
            trials.search(None);
        }
        Err(_) => {}
    }
    let first = trials.sound.into_iter().next();
    let found = Any {
        sound: first.map(|sound| (sound.parameters.found_by_simulation(asked), sound.figures)),
        turned_down: trials.turned_down,
    };
    (found, trials.effort)
}

/// The best results of changing parameters, for as long as they become better by the objective.
pub(super) fn from(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    start: &VcutParameters,
    turned_down: Vec<TurnedDown>,
) -> Option<VcutParameters> {
    let lattices = [start.lattice];
    let mut trials = Trials::new(bench, asked, &lattices);
    trials.turned_down = turned_down;
    trials.weigh(start.clone());
    trials.wander();
    trials.comb();
    trials.best()
}

/// How much goes with an operation of so many cuts.
fn by_cuts(table: &[(usize, usize)], cuts: usize) -> usize {
    table
        .iter()
        .find(|(below, _)| cuts < *below)
        .map_or(1, |&(_, most)| most)
}

/// What the formulas say.
const fn plain(parameters: VcutParameters, searched: Option<Searched>) -> Found {
    Found {
        parameters,
        by: FoundBy::Formulas,
        by_formulas: None,
        searched,
    }
}

/// What is asked of the model: where plans are searched, those are held to the limits on time and cuts. A scallop or an edge
/// that is to be small needs them all the same: they hold the layer.
pub(super) fn of_model(asked: &RoughVcut) -> RoughVcut {
    match asked.objective.value {
        Objective::Time | Objective::Cuts if is_searched(asked) => limits::of_plans(asked),
        Objective::Time | Objective::Cuts | Objective::Scallop | Objective::BladeLoad => asked.clone(),
    }
}

/// The formulas' parameters on one of these lattices. Fitted tips keep the limit on the scallop whatever these are.
fn by_formulas(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
) -> Result<VcutParameters, Refusal> {
    let mut asked = of_model(asked);
    if lattices == [Lattice::Fitted] && is_searched(&asked) {
        asked.limits.scallop = None;
    }
    parameters::resolve_on(&bench.job, &asked, lattices.to_vec())
}

/// The parameters if nothing were known of the scallop.
pub(super) fn freest(bench: &Bench<'_>, asked: &RoughVcut, lattice: Lattice) -> Option<VcutParameters> {
    let mut assumed = of_model(asked);
    if is_searched(asked) {
        assumed.limits.scallop = None;
    }
    parameters::resolve_on(&bench.job, &assumed, vec![lattice]).ok()
}

/// Whether both give the same cuts.
fn alike(one: &VcutParameters, two: &VcutParameters) -> bool {
    (one.lattice, one.swing, one.layer, one.step) == (two.lattice, two.swing, two.layer, two.step)
}

/// A plan with nothing wrong.
struct Sound {
    parameters: VcutParameters,
    figures: Figures,
    model: Duration,
}

/// Parameters that were planned, and their result.
struct Tried {
    parameters: VcutParameters,
    standing: Standing,
}

/// How many plans are made side by side, whatever the number of threads. Only those that are then weighed count, so what comes
/// of the search is the same as one after the other.
const AHEAD: usize = 2;

/// The result of planning parameters.
#[derive(Clone, Copy)]
enum Outcome {
    /// There are no cuts, or too many.
    Impossible,
    /// More cuts than are compared.
    TooLarge { cuts: usize },
    Planned {
        standing: Standing,
        figures: Figures,
        /// How many Vs it had before redundant ones were skipped.
        laid_out: usize,
    },
}

/// What the search is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    /// The best plans.
    Best,
    /// Any plan that keeps all limits.
    Any,
}

struct Trials<'t> {
    bench: &'t Bench<'t>,
    asked: &'t RoughVcut,
    lattices: &'t [Lattice],
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
    turned_down: Vec<TurnedDown>,
    /// The least time by the model of those that were not planned, because they must leave too much.
    passed_over: Option<Duration>,
    goal: Goal,
    effort: Effort,
    /// The time of the best plan on other lattices, where that is to be beaten.
    rival: Option<Duration>,
    /// How many plans were made before the spread, once that has begun.
    spread_from: Option<usize>,
    /// How many plans were made since the best one.
    since_best: usize,
    /// Why the search ends.
    end: End,
}

impl<'t> Trials<'t> {
    fn new(bench: &'t Bench<'t>, asked: &'t RoughVcut, lattices: &'t [Lattice]) -> Self {
        Self {
            bench,
            asked,
            lattices,
            floor: Floor::new(&bench.job, bench.work()),
            plans_left: None,
            most_plans: &PLANS,
            tried: Vec::new(),
            ahead: Vec::new(),
            sound: Vec::new(),
            turned_down: Vec::new(),
            passed_over: None,
            goal: Goal::Best,
            effort: Effort::UNBOUNDED,
            rival: None,
            spread_from: None,
            since_best: 0,
            end: End::NoneBetter,
        }
    }

    /// The whole search. Returns the result of the formulas' parameters.
    fn search(&mut self, by_bound: Option<&VcutParameters>) -> Option<Standing> {
        let first = by_bound.and_then(|found| self.weigh(found.clone()));
        let parts: &[fn(&mut Self)] = if self.is_fitted() {
            &[Self::spread, Self::wander, Self::comb]
        } else {
            &[Self::climb, Self::spread, Self::wander, Self::comb]
        };
        for part in parts {
            if self.is_answered() {
                break;
            }
            part(self);
        }
        first
    }

    /// Whether the search may end: its answer is found, nothing better is to be expected, or the answer is not wanted.
    fn is_answered(&self) -> bool {
        let is_found = match self.goal {
            Goal::Best => false,
            Goal::Any => !self.sound.is_empty(),
        };
        is_found || self.is_much_slower() || self.effort.is_spent() || self.bench.wanted.is_needless()
    }

    /// Whether tips are fitted to the part: then no formula holds the scallop, and what forecasts say of cuts is counted.
    fn is_fitted(&self) -> bool {
        self.lattices == [Lattice::Fitted]
    }

    /// How many times as many plans as usual may be made.
    const fn times(&self) -> usize {
        self.bench.effort.times()
    }

    /// Whether the best plan so far takes far longer than the best one on other lattices.
    fn is_much_slower(&self) -> bool {
        let (plans, as_long) = GIVEN_UP;
        let (Some(rival), Some(best), Some(from)) = (self.rival, self.sound.first(), self.spread_from) else {
            return false;
        };
        self.tried.len() >= from + plans * self.times() && best.figures.time > rival * as_long
    }

    /// The best parameters, with the bounds that keep them from being better.
    fn best(&self) -> Option<VcutParameters> {
        let sound = self.sound.first()?;
        let mut parameters = sound.parameters.clone().found_by_simulation(self.asked);
        parameters.binding = met::binding(self.asked, sound, &self.turned_down);
        let is_faster = self.passed_over.is_some_and(|model| model < sound.model);
        if self.asked.objective.value == Objective::Time && is_faster {
            parameters.binding.push(Bound::Scallop);
            parameters.binding.sort_unstable();
            parameters.binding.dedup();
        }
        Some(parameters)
    }

    /// How far it went; none where nothing was planned.
    fn searched(&self) -> Option<Searched> {
        (!self.tried.is_empty()).then_some(Searched {
            plans: self.tried.len(),
            lattices: self.lattices.len(),
            end: self.end,
            effort: self.bench.effort,
        })
    }

    fn may_go_on(&self) -> bool {
        self.plans_left != Some(0) && !self.is_answered()
    }

    /// The result of parameters; none where no more plans may be made, or none can be made.
    fn weigh(&mut self, found: VcutParameters) -> Option<Standing> {
        let known = self.tried.iter().find(|tried| alike(&tried.parameters, &found));
        if let Some(known) = known {
            return Some(known.standing);
        }
        if !self.may_go_on() || self.is_too_large(&found) || self.is_beyond_the_machine(&found) {
            return None;
        }
        let model = self.model(&found);
        if self.must_leave_too_much(&found) {
            let least = self.passed_over.map_or(model, |least| least.min(model));
            self.passed_over = Some(least);
            return None;
        }
        let known = self.ahead.iter().find(|(planned, _)| *planned == found);
        let outcome = known.map_or_else(|| self.outcome(&found), |(_, outcome)| *outcome);
        let (standing, figures, laid_out) = match outcome {
            Outcome::Impossible => {
                self.spend(MOST_CUTS_COMPARED - 1, 0);
                return Some(self.note(found, Standing::Impossible));
            }
            Outcome::TooLarge { cuts } => {
                self.spend(cuts, cuts);
                return None;
            }
            Outcome::Planned {
                standing,
                figures,
                laid_out,
            } => (standing, figures, laid_out),
        };
        self.spend(laid_out, laid_out);
        if standing.time().is_some() {
            self.keep(Sound {
                parameters: found.clone(),
                figures,
                model,
            });
        }
        self.turned_down.extend(TurnedDown::of(standing, figures));
        Some(self.note(found, standing))
    }

    /// Plans parameters.
    fn outcome(&self, found: &VcutParameters) -> Outcome {
        if self.bench.wanted.is_needless() {
            return Outcome::Impossible;
        }
        let laid = lay_out(&self.bench.job, self.asked, found.clone(), self.bench.work());
        let Ok(laid) = laid else {
            return Outcome::Impossible;
        };
        let cuts = laid.vcut.cuts.len();
        if cuts > MOST_CUTS_COMPARED {
            return Outcome::TooLarge { cuts };
        }
        // Above fitted tips more stands than between the rows of a lattice.
        if found.lattice == Lattice::Fitted && !self.bench.clears_bodies(&laid.vcut) {
            return Outcome::Impossible;
        }
        let limit = self.asked.limits.scallop.map(|limit| limit.value);
        let held = self.held_to();
        let thinned = match Skipping::of(&self.bench.job, self.asked) {
            Skipping::Never => None,
            Skipping::IfBetter | Skipping::Always => self.bench.thinned(&laid),
        };
        let weighed = |laid| self.weighed(laid).held_to(limit, &held);
        let outcome = match thinned {
            Some(thinned) => redundant::better(self.asked, [thinned, laid], weighed),
            None => weighed(laid),
        };
        let Contender {
            standing, figures, ..
        } = outcome;
        Outcome::Planned {
            standing,
            figures,
            laid_out: cuts,
        }
    }

    /// Plans those that would be weighed next as far as can be seen, side by side.
    fn plan_ahead<'f>(&mut self, next: impl IntoIterator<Item = &'f VcutParameters>) {
        if !self.may_go_on() {
            self.ahead.clear();
            return;
        }
        let is_new = |found: &&VcutParameters| {
            !self.tried.iter().any(|tried| alike(&tried.parameters, found)) && self.may_be_sound(found)
        };
        let worth: Vec<&VcutParameters> = next.into_iter().filter(is_new).collect();
        let planned = worth
            .into_par_iter()
            .map(|found| (found.clone(), self.outcome(found)));
        self.ahead = planned.collect();
    }

    /// Whether parameters are worth a plan, as far as is known before.
    fn may_be_sound(&self, found: &VcutParameters) -> bool {
        !self.is_too_large(found) && !self.must_leave_too_much(found) && !self.is_beyond_the_machine(found)
    }

    /// Whether the machine refused a plan of this swing or a narrower one, and followed none of this swing or a wider one.
    fn is_beyond_the_machine(&self, found: &VcutParameters) -> bool {
        let is_refused =
            |tried: &Tried| tried.parameters.swing <= found.swing && tried.standing == Standing::NotFollowed;
        let is_followed = |tried: &Tried| {
            tried.parameters.swing >= found.swing
                && matches!(
                    tried.standing,
                    Standing::Takes(_) | Standing::Exceeds(_) | Standing::Leaves { .. }
                )
        };
        self.tried.iter().any(is_refused) && !self.tried.iter().any(is_followed)
    }

    /// Whether there will be far more cuts than are compared, by the model: to lay them out takes long.
    fn is_too_large(&self, found: &VcutParameters) -> bool {
        let cuts = found.estimated_cuts(&self.bench.job, self.asked);
        let most = match self.goal {
            Goal::Best => 1.5,
            Goal::Any => 1.0,
        };
        cuts > most * MOST_CUTS_COMPARED as f64 || self.effort.is_less_than(cuts)
    }

    /// The result of an operation along its usual route, or along the fastest one where its time is limited
    /// and something else made small.
    fn weighed(&self, laid: LaidOut) -> Contender {
        match (self.goal, self.asked.objective.value, self.asked.limits.time) {
            (Goal::Any, _, Some(_))
            | (Goal::Best, Objective::Cuts | Objective::Scallop | Objective::BladeLoad, Some(_)) => {
                self.bench.weigh(route::best(self.bench, laid))
            }
            (Goal::Best, Objective::Time, Some(_)) | (Goal::Best | Goal::Any, _, None) => {
                let faster = self.faster_order(&laid.vcut);
                let along = |laid, order| self.bench.weigh(route::usual(self.bench, laid, order));
                let other = (self.bench.followed.is_some() && route::is_order_open(self.bench, self.asked))
                    .then(|| laid.clone());
                let usual = along(laid, faster);
                // What the machine makes of a route no formula says.
                match other.map(|laid| along(laid, faster.other())) {
                    Some(other) if other.compare(&usual) == Ordering::Less => other,
                    Some(_) | None => usual,
                }
            }
        }
    }

    /// What plans are held to: all but the limit on what is made small, which the best one keeps if any does.
    fn held_to(&self) -> RoughVcut {
        let mut held = self.asked.clone();
        if self.goal == Goal::Any {
            return held;
        }
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

    /// Puts a sound plan in its place; after its equals.
    fn keep(&mut self, sound: Sound) {
        let merit = |sound: &Sound| sound.figures.merit(self.asked.objective.value);
        let rank = self.sound.partition_point(|other| merit(other) <= merit(&sound));
        if rank == 0 {
            self.since_best = 0;
        }
        self.sound.insert(rank, sound);
    }

    /// Counts a plan as one of an operation of so many cuts, of which so many were laid out.
    fn spend(&mut self, cuts: usize, laid_out: usize) {
        self.effort.spend(laid_out);
        self.since_best += 1;
        let left = self
            .plans_left
            .unwrap_or_else(|| by_cuts(self.most_plans, cuts) * self.times());
        self.plans_left = Some(left.saturating_sub(1));
        if left <= 1 {
            self.end = End::Budget;
        }
    }

    fn model(&self, found: &VcutParameters) -> Duration {
        found.estimate(&self.bench.job, self.asked)
    }

    fn resolve(&self, assumed: &RoughVcut) -> Option<VcutParameters> {
        parameters::resolve_on(&self.bench.job, assumed, self.lattices.to_vec()).ok()
    }

    fn is_sound(&mut self, found: VcutParameters) -> bool {
        self.weigh(found)
            .is_some_and(|standing| standing.time().is_some())
    }

    fn weigh_if_promising(&mut self, found: VcutParameters) {
        if !self.is_slower(self.model(&found)) {
            self.weigh(found);
        }
    }

    /// Whether a time by the model is much longer than that of the best one, or beyond the limit where any
    /// plan will do.
    fn is_slower(&self, model: Duration) -> bool {
        let limit = self.asked.limits.time;
        match (self.goal, self.asked.objective.value) {
            (Goal::Any, _) => limit.is_some_and(|limit| model > limit.value * BEYOND),
            (Goal::Best, Objective::Time) => {
                self.sound.first().is_some_and(|best| model > best.model * SLOWER)
            }
            (Goal::Best, Objective::Cuts | Objective::Scallop | Objective::BladeLoad) => false,
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
        self.is_bound_to_columns() && self.asked.limits.scallop.is_some() && self.least_left(found).is_none()
    }

    /// Whether no plan reaches below the lowest tips of regular Vs in their columns, as narrower flanks and moved tips do.
    fn is_bound_to_columns(&self) -> bool {
        let moves_tips = self.asked.residual.value == Auto::Given(Residual::Shift);
        self.asked.avoid.value == Avoid::Lift && !moves_tips
    }
}

/// Overlaps are tried up to this, as the formulas do.
const MOST_OVERLAP: f64 = 0.95;

/// Swings are chosen to a thousandth of a degree.
fn thousandths(swing: Angle) -> Angle {
    Angle::deg((swing.to_deg() * 1000.0).floor() / 1000.0)
}
