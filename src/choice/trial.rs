//! Parameters by what is left in truth.
//!
//! The formulas hold a lattice's scallop bound [Cui 12] against the limit. That is always sound, and often far from what a
//! planned program leaves, for its residual strategy puts tips onto the part. So the search for parameters is repeated with
//! laxer limits on scallop, and with swings and layers beside the best ones; each outcome is planned, written down and
//! replayed. Only what leaves no more than the job's own limit, with every chip free, is sound, and the fastest sound one is
//! taken. Soundness does not grow or shrink steadily with a parameter, so this is a search, not a proof of least time: the
//! best of a bounded number of plans.

use super::bench::Bench;
use super::{Contender, MOST_CUTS_COMPARED, route};
use crate::diag::{Code, Diagnostic};
use crate::job::{Auto, Formulas, Lattice, Objective, RoughVcut, Sourced};
use crate::plan::decision::{Candidate, Decision, Standing};
use crate::plan::lay_out;
use crate::plan::optimum::Bound;
use crate::plan::parameters::{self, ScallopBy, VcutParameters};
use vcutc_backend_api::units::{Angle, Duration, Length};

/// Most plans that are tried, by the number of cuts of the first one: below the first number the second.
const PLANS: [(usize, usize); 3] = [(500, 48), (2_000, 24), (MOST_CUTS_COMPARED, 6)];

/// Into how many equal ratios the way from the limit to the freest bound is divided.
const RUNGS: u32 = 5;

/// How often the way between a sound limit and an unsound one is halved.
const HALVINGS: usize = 3;

/// By which factors swing and layer are changed, the coarse ones first.
const FACTORS: [f64; 3] = [1.3, 1.12, 1.04];

/// Directions in which swing and layer are changed, those first that promise most.
const MOVES: [(i32, i32); 8] = [
    (0, 1),
    (1, 0),
    (-1, 1),
    (1, 1),
    (-1, 0),
    (1, -1),
    (0, -1),
    (-1, -1),
];

/// A candidate that by the model takes this many times as long as the best one is not planned.
const BEHIND: f64 = 1.15;

/// Parameters, and how they were found where formulas alone did not do it.
pub(super) struct Found {
    pub(super) parameters: VcutParameters,
    pub(super) decision: Option<Decision>,
}

/// The best parameters on one of these lattices.
pub(super) fn parameters(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
    cuts_left: usize,
) -> Result<Found, Vec<Diagnostic>> {
    let mut told = Vec::new();
    let by_bound = parameters::resolve_on(bench.job, asked, lattices.to_vec(), &mut told);
    let is_conflict = told.iter().all(|one| one.code == Code::LimitsConflict);
    if !is_searched(asked) || (by_bound.is_none() && !(is_conflict && asked.limits.scallop.is_some())) {
        return plain(by_bound, told);
    }
    let mut trials = Trials::new(bench, asked, lattices, cuts_left);
    let first = by_bound.clone().and_then(|found| trials.weigh(found));
    trials.climb();
    trials.wander();
    let Some(best) = trials.best else {
        return plain(by_bound, told);
    };
    if by_bound
        .as_ref()
        .is_some_and(|found| alike(found, &best.parameters))
    {
        return plain(by_bound, told);
    }
    let mut parameters = best.parameters;
    parameters.binding.retain(|&bound| bound != Bound::Scallop);
    if trials.leaves_too_much {
        parameters.binding.push(Bound::Scallop);
    }
    let bound = parameters.scallop_bound(asked);
    if asked.limits.scallop.is_some_and(|limit| bound > limit.value) {
        parameters.scallop_by = ScallopBy::Simulation;
    }
    let others = first.map(|standing| Candidate {
        what: "by the lattice's bound".to_owned(),
        standing,
    });
    let taken = Candidate {
        what: "as simulated".to_owned(),
        standing: Standing::Takes(best.time),
    };
    Ok(Found {
        parameters,
        decision: Some(Decision {
            field: "parameters",
            taken,
            others: others.into_iter().collect(),
        }),
    })
}

/// What the formulas say.
fn plain(by_bound: Option<VcutParameters>, told: Vec<Diagnostic>) -> Result<Found, Vec<Diagnostic>> {
    by_bound.ok_or(told).map(|parameters| Found {
        parameters,
        decision: None,
    })
}

/// Whether the plan has a say in the parameters. The formulas of the paper stand as they are printed.
pub(super) fn is_searched(asked: &RoughVcut) -> bool {
    let is_open = asked.swing.value == Auto::Auto
        || asked.layer.value == Auto::Auto
        || (asked.step.value == Auto::Auto && asked.limits.scallop.is_some());
    let is_planned = match asked.objective.value {
        Objective::Time | Objective::Cuts => true,
        Objective::Scallop | Objective::BladeLoad => false,
    };
    is_open && is_planned && asked.formulas.value == Formulas::Exact
}

/// The parameters if nothing were known of the scallop.
pub(super) fn freest(bench: &Bench<'_>, asked: &RoughVcut, lattice: Lattice) -> Option<VcutParameters> {
    let mut assumed = asked.clone();
    if is_searched(asked) {
        assumed.limits.scallop = None;
    }
    parameters::resolve_on(bench.job, &assumed, vec![lattice], &mut Vec::new())
}

/// Whether the same cuts come of both.
fn alike(one: &VcutParameters, two: &VcutParameters) -> bool {
    (one.lattice, one.swing, one.layer, one.step) == (two.lattice, two.swing, two.layer, two.step)
}

/// The best plan so far.
struct Best {
    parameters: VcutParameters,
    time: Duration,
    measure: f64,
    model: Duration,
}

struct Trials<'t> {
    bench: &'t Bench<'t>,
    asked: &'t RoughVcut,
    lattices: &'t [Lattice],
    cuts_left: usize,
    /// How many plans may still be made; not known before the first one.
    plans_left: Option<usize>,
    tried: Vec<(VcutParameters, Standing)>,
    best: Option<Best>,
    leaves_too_much: bool,
}

impl<'t> Trials<'t> {
    const fn new(
        bench: &'t Bench<'t>,
        asked: &'t RoughVcut,
        lattices: &'t [Lattice],
        cuts_left: usize,
    ) -> Self {
        Self {
            bench,
            asked,
            lattices,
            cuts_left,
            plans_left: None,
            tried: Vec::new(),
            best: None,
            leaves_too_much: false,
        }
    }

    fn may_go_on(&self) -> bool {
        self.plans_left != Some(0)
    }

    /// What comes of parameters; none where no more plans may be made or none can be.
    fn weigh(&mut self, found: VcutParameters) -> Option<Standing> {
        if let Some((_, known)) = self.tried.iter().find(|(tried, _)| alike(tried, &found)) {
            return Some(*known);
        }
        if !self.may_go_on() {
            return None;
        }
        let model = self.model(&found);
        let laid = lay_out(
            self.bench.job,
            self.asked,
            found.clone(),
            self.cuts_left,
            &self.bench.before,
        );
        let Ok(laid) = laid else {
            self.spend(MOST_CUTS_COMPARED - 1);
            self.tried.push((found, Standing::Impossible));
            return Some(Standing::Impossible);
        };
        let cuts = laid.vcut.cuts.len();
        self.spend(cuts);
        if cuts > MOST_CUTS_COMPARED {
            return None;
        }
        let limit = self.asked.limits.scallop.map(|limit| limit.value);
        let Contender { standing, time, .. } =
            self.bench.weigh(route::usual(self.bench, laid)).held_to(limit);
        self.tried.push((found.clone(), standing));
        match standing {
            Standing::Takes(_) => self.keep(found, time, cuts, model),
            Standing::Leaves { .. } => self.leaves_too_much = true,
            Standing::Fails(_)
            | Standing::Impossible
            | Standing::ByModel(_)
            | Standing::NotCompared
            | Standing::Last => {}
        }
        Some(standing)
    }

    fn keep(&mut self, parameters: VcutParameters, time: Duration, cuts: usize, model: Duration) {
        let measure = match self.asked.objective.value {
            Objective::Cuts => f64::from(u32::try_from(cuts).unwrap_or(u32::MAX)),
            Objective::Time | Objective::Scallop | Objective::BladeLoad => time.to_s(),
        };
        if self.best.as_ref().is_none_or(|best| measure < best.measure) {
            self.best = Some(Best {
                parameters,
                time,
                measure,
                model,
            });
        }
    }

    /// Counts a plan.
    fn spend(&mut self, cuts: usize) {
        let left = self.plans_left.unwrap_or_else(|| {
            let fitting = PLANS.iter().find(|(below, _)| cuts < *below);
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
        parameters::resolve_on(self.bench.job, assumed, self.lattices.to_vec(), &mut Vec::new())
    }

    /// The parameters under another limit on scallop.
    fn under(&self, limit: Option<Length>) -> Option<VcutParameters> {
        let mut assumed = self.asked.clone();
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
        matches!(self.weigh(found), Some(Standing::Takes(_)))
    }

    /// Changes swing and layer for as long as something better comes of it: from the best, and before that from the
    /// largest layers at some swings.
    fn wander(&mut self) {
        for swing in self.swings() {
            if let Some(found) = self.largest_layer(swing) {
                self.weigh_if_promising(found);
            }
        }
        for factor in FACTORS {
            while self.may_go_on() {
                let Some(best) = &self.best else { return };
                let (from, measure) = (best.parameters.clone(), best.measure);
                let is_better = MOVES.into_iter().any(|moved| {
                    if let Some(found) = self.beside(&from, factor, moved) {
                        self.weigh_if_promising(found);
                    }
                    self.best.as_ref().is_some_and(|best| best.measure < measure)
                });
                if !is_better {
                    break;
                }
            }
        }
    }

    fn weigh_if_promising(&mut self, found: VcutParameters) {
        let model = self.model(&found);
        let is_behind = match self.asked.objective.value {
            Objective::Time => self.best.as_ref().is_some_and(|best| model > best.model * BEHIND),
            Objective::Cuts | Objective::Scallop | Objective::BladeLoad => false,
        };
        if !is_behind {
            self.weigh(found);
        }
    }

    /// The limit on swing, and less.
    fn swings(&self) -> Vec<Angle> {
        match (self.asked.swing.value, self.asked.limits.swing.most) {
            (Auto::Auto, Some(most)) => [1.0, 0.8, 2.0 / 3.0]
                .map(|share| thousandths(most.value * share))
                .to_vec(),
            (Auto::Auto, None) => [30.0, 40.0, 50.0].map(Angle::deg).to_vec(),
            (Auto::Given(_), _) => Vec::new(),
        }
    }

    fn largest_layer(&self, swing: Angle) -> Option<VcutParameters> {
        let mut assumed = self.asked.clone();
        assumed.limits.scallop = None;
        assumed.swing.value = Auto::Given(swing);
        self.resolve(&assumed).filter(|found| self.is_within(found))
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

    /// The parameters with swing and layer changed by a factor.
    fn beside(
        &self,
        from: &VcutParameters,
        factor: f64,
        (swing, layer): (i32, i32),
    ) -> Option<VcutParameters> {
        let mut assumed = self.asked.clone();
        assumed.limits.scallop = None;
        assumed.lattice.value = Auto::Given(from.lattice);
        match self.asked.swing.value {
            Auto::Auto => {
                let bounds = self.asked.limits.swing;
                let changed = thousandths(from.swing * libm::pow(factor, f64::from(swing)));
                let changed =
                    bounds.most.map_or(
                        changed,
                        |most| if changed > most.value { most.value } else { changed },
                    );
                if changed >= Angle::deg(89.0) || changed <= Angle::deg(1.0) {
                    return None;
                }
                assumed.swing.value = Auto::Given(changed);
            }
            Auto::Given(_) if swing != 0 => return None,
            Auto::Given(_) => {}
        }
        match self.asked.layer.value {
            Auto::Auto => {
                let changed = from.layer.to_mm() * libm::pow(factor, f64::from(layer));
                let changed = Length::mm((changed * 1000.0).floor() / 1000.0);
                if changed <= Length::ZERO {
                    return None;
                }
                assumed.layer.value = Auto::Given(changed);
            }
            Auto::Given(_) if layer != 0 => return None,
            Auto::Given(_) => {}
        }
        parameters::resolve_on(self.bench.job, &assumed, vec![from.lattice], &mut Vec::new())
            .filter(|found| self.is_within(found))
    }
}

/// Swings are chosen to a thousandth of a degree.
fn thousandths(swing: Angle) -> Angle {
    Angle::deg((swing.to_deg() * 1000.0).floor() / 1000.0)
}
