//! Choices that a job leaves open and that no formula makes: lattice, residual strategy, order of the flanks and sequence
//! of the Vs (`docs/process.md`, "Choices").
//!
//! Each way to cut an operation is planned, written down as a program and timed as that; where what it leaves differs, it
//! is replayed on what the operations before left, too. Ways whose chips all come free and that leave no more than they may
//! come first, then the least time, then the least material left, then the order in which the language names them. What was
//! compared is kept as a [`Decision`]. Operations are decided one after the other, because each depends on
//! the surface that those before left.
//!
//! An operation of more than [`MOST_CUTS_COMPARED`] cuts is not compared with itself in other guises: it is cut `mixed`,
//! `boustrophedon` and by `point`.

mod assumed;
mod bench;
mod chosen;
mod closer;
mod complaints;
mod finest;
mod limits;
mod narrowed;
mod offers;
mod redundant;
mod route;
#[cfg(test)]
mod tests;
mod thorough;
mod trial;

pub use bench::LITTLE;

use crate::asked::{Lattice, Objective, Residual, RoughVcut};
use crate::plan::decision::{Candidate, Decision, Excess, Standing};
use crate::plan::parameters::{Refusal, VcutParameters};
use crate::plan::refusal::Refused;
use crate::plan::residual::Strategies;
use crate::plan::searched::Searched;
use crate::plan::{LaidOut, PARAMETERS, PlannedVcut, lay_out, parameters};
use assumed::is_searched;
use bench::{Bench, Figures, MEASURED_TO};
use complaints::Sought;
use core::cmp::Ordering;
use rayon::prelude::*;
use redundant::Skipping;
use trial::{Found, FoundBy};
use vcutc_backend_api::units::{Area, Duration, Length};
use vcutc_cancellation::Effort;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::Auto;
use vcutc_job::follow::Family;
use vcutc_job::operation::{self, Ground};
use vcutc_job::search::RouteSet;
use vcutc_simulation::surface::Surface;

/// Most cuts of an operation for which other ways to cut it are planned. Larger ones take days; minutes are not what they
/// are chosen by.
pub const MOST_CUTS_COMPARED: usize = 20_000;

/// A lattice whose time by the mean-value model is longer than this many times that of the best plan is not planned.
const MUCH_SLOWER: f64 = 1.5;

/// Plans an operation on what those before it left of the stock.
///
/// # Errors
/// Why there is no plan: at once, before anything that helps is looked for.
pub(crate) fn plan<'j>(
    asked: &RoughVcut,
    ground: Ground<'j>,
) -> Result<(PlannedVcut, Surface), Box<dyn operation::Unplanned + 'j>> {
    let space = ground.space;
    let within = narrowed::within(asked, space.swing);
    let followed = space.machine.map(|machine| machine.by);
    let bench = Bench::new(asked, ground).on_machine(followed);
    match thorough::searched(&bench, asked, &within) {
        Ok(LaidOut { mut vcut, after, .. }) => {
            let machine = bench.job.machine.as_ref();
            let narrowed = narrowed::narrowed(asked, space.swing);
            if narrowed.is_some() {
                narrowed::restore(&mut vcut, asked.limits.swing);
            }
            match (space.machine, narrowed) {
                (Some(followed), _) => narrowed::explain_on_machine(&mut vcut, followed, machine),
                (None, Some(swing)) => narrowed::explain(&mut vcut, swing, machine),
                (None, None) => {}
            }
            Ok((vcut, after))
        }
        Err(unplanned) => Err(Box::new(Sought {
            bench,
            asked: within,
            unplanned,
        })),
    }
}

/// Whether an operation has a plan with nothing wrong that keeps all limits, as far as is seen with so much work. Where it has
/// one, [`plan`] finds one.
pub(crate) fn is_plannable(asked: &RoughVcut, ground: Ground<'_>, effort: &mut Effort) -> bool {
    offers::is_sound(&Bench::new(asked, ground), asked, effort)
}

/// The operation without its limits on time and cuts, and made fast where these hold what is to become small; none where
/// there are no such limits.
pub(crate) fn without_plan_limits(asked: &RoughVcut) -> Option<RoughVcut> {
    let is_limited = asked.limits.time.is_some() || asked.limits.cuts.is_some();
    is_limited.then(|| limits::of_plans(&assumed::as_time(asked)))
}

/// The limits of an operation that a plan breaks, which was made without them, with what the plan keeps.
pub(crate) fn broken_limits(vcut: &PlannedVcut, asked: &RoughVcut, time: Duration) -> Option<Diagnostic> {
    let mut limited = vcut.clone();
    limited.asked.limits = asked.limits;
    limits::diagnostic(&limited, time)
}

/// Whether the routes of a set are all that is needed to choose this plan's again.
pub(crate) fn is_within(vcut: &PlannedVcut, routes: RouteSet) -> bool {
    route::allows(routes, &vcut.asked, (vcut.sequence, vcut.order))
}

/// Why an operation has no plan.
#[derive(Clone, Debug)]
enum Unplanned {
    /// What to report is known.
    Refused(Vec<Refused>),
    Parameters(Refusal),
}

impl From<Refused> for Unplanned {
    fn from(refused: Refused) -> Self {
        Self::Refused(vec![refused])
    }
}

impl From<Box<Refused>> for Unplanned {
    fn from(refused: Box<Refused>) -> Self {
        Self::Refused(vec![*refused])
    }
}

impl From<Refusal> for Unplanned {
    fn from(refusal: Refusal) -> Self {
        Self::Parameters(refusal)
    }
}

/// A way to cut an operation, and its result.
struct Contender {
    laid: LaidOut,
    standing: Standing,
    figures: Figures,
    residual: Area,
}

impl Contender {
    fn candidate(&self, what: &str) -> Candidate {
        Candidate {
            what: what.to_owned(),
            standing: self.standing,
        }
    }

    /// Fails if it leaves more than that, or breaks one of the operation's limits on time and cuts.
    fn held_to(mut self, limit: Option<Length>, asked: &RoughVcut) -> Self {
        let excess = limit.filter(|&limit| self.figures.height > limit + MEASURED_TO);
        if let (Standing::Takes(_), Some(limit)) = (self.standing, excess) {
            let height = self.figures.height;
            self.standing = Standing::Leaves { height, limit };
        } else if let Standing::Takes(time) = self.standing
            && let Some(excess) = limits::excess(asked, time, self.laid.vcut.cuts.len())
        {
            self.standing = Standing::Exceeds(excess);
        }
        self
    }

    /// The better one first.
    fn compare(&self, other: &Self) -> Ordering {
        if let (Standing::Fails(_), Standing::Fails(_)) = (self.standing, other.standing) {
            return Ordering::Equal;
        }
        if let (Standing::Takes(_), Standing::Takes(_)) = (self.standing, other.standing) {
            let merit = |one: &Self| one.figures.merit(one.laid.vcut.asked.objective.value);
            let by_merit = merit(self).total_cmp(&merit(other));
            let by_time = self.figures.time.total_cmp(&other.figures.time);
            return by_merit
                .then(by_time)
                .then(self.residual.total_cmp(&other.residual));
        }
        self.standing
            .compare(&other.standing)
            .then(self.figures.time.total_cmp(&other.figures.time))
            .then(self.residual.total_cmp(&other.residual))
    }
}

/// The best of those planned, and what was said of the others. The first one stands among equals.
struct Contest {
    best: Option<(&'static str, Contender)>,
    others: Vec<Candidate>,
}

impl Contest {
    const fn new() -> Self {
        Self {
            best: None,
            others: Vec::new(),
        }
    }

    fn enter(&mut self, what: &'static str, contender: Contender) {
        match &self.best {
            Some((_, best)) if contender.compare(best) != Ordering::Less => {
                self.others.push(contender.candidate(what));
            }
            Some(_) | None => {
                if let Some((beaten, best)) = self.best.replace((what, contender)) {
                    self.others.push(best.candidate(beaten));
                }
            }
        }
    }

    fn rule_out(&mut self, what: &'static str, standing: Standing) {
        self.others.push(Candidate {
            what: what.to_owned(),
            standing,
        });
    }

    /// The best one, which remembers what it was compared with.
    fn finish(self, field: &'static str) -> Option<Contender> {
        let (what, mut best) = self.best?;
        if !self.others.is_empty() {
            let taken = best.candidate(what);
            best.laid.vcut.decisions.insert(
                0,
                Decision {
                    field,
                    taken,
                    others: sorted(self.others),
                },
            );
        }
        Some(best)
    }
}

/// The best first.
fn sorted(mut others: Vec<Candidate>) -> Vec<Candidate> {
    others.sort_by(|a, b| a.standing.compare(&b.standing));
    others
}

/// The strategies beside `mixed`.
const OTHERS: [Residual; 3] = [Residual::Discard, Residual::Lift, Residual::Shift];

/// The best operation that keeps its limits on time and cuts when it is planned.
fn within_limits(bench: &Bench<'_>, asked: &RoughVcut) -> Result<LaidOut, Unplanned> {
    let first = best_lattice(bench, asked)?;
    let Some(broken) = limits::broken(bench, asked, &first.vcut) else {
        return Ok(first);
    };
    if is_searched(asked) {
        return kept_by_any(bench, asked, (first, broken));
    }
    let (mut assumed, mut by) = (asked.clone(), broken);
    for _ in 0..limits::MOST_TIGHTENED {
        assumed = limits::tightened(&assumed, by);
        let Ok(mut laid) = best_lattice(bench, &assumed) else {
            break;
        };
        laid.vcut.asked.limits = asked.limits;
        match limits::broken(bench, asked, &laid.vcut) {
            Some(still) => by = still,
            None => return Ok(laid),
        }
    }
    Err(limits::complaint(&first.vcut, broken).into())
}

/// A plan that keeps the limits on time and cuts where the best one that was searched for within them does not: the best one
/// of all if that keeps them, because the search goes on from one sound plan to the next, and limits take
/// some of them away; else any. Of the plans that break them, the one that comes nearest is reported.
fn kept_by_any(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    (first, broken): (LaidOut, Excess),
) -> Result<LaidOut, Unplanned> {
    let free = best_lattice(bench, &limits::of_plans(asked)).ok();
    let free = free.and_then(|laid| {
        let weighed = bench.judged(laid, &limits::of_plans(asked));
        let is_sound = weighed.standing.time().is_some();
        let mut laid = weighed.laid;
        laid.vcut.asked.limits = asked.limits;
        is_sound.then_some(laid)
    });
    let still = free.as_ref().map(|laid| limits::broken(bench, asked, &laid.vcut));
    if let (Some(laid), Some(None)) = (&free, &still) {
        return Ok(laid.clone());
    }
    if let Some(kept) = any_within_limits(bench, asked) {
        return Ok(kept);
    }
    Err(match (free, still.flatten()) {
        (Some(laid), Some(excess)) if excess.share() < broken.share() => {
            limits::complaint(&laid.vcut, excess).into()
        }
        (Some(_) | None, _) => limits::complaint(&first.vcut, broken).into(),
    })
}

/// The operation with any parameters whose plan keeps all limits: what is held to them from the start goes other ways than what
/// becomes small first.
fn any_within_limits(bench: &Bench<'_>, asked: &RoughVcut) -> Option<LaidOut> {
    let lattices = parameters::open_lattices(asked);
    let mut effort = Effort::OF_A_PROBE;
    let (parameters, _) = offers::any(bench, asked, &lattices, &mut effort, &mut Vec::new())?;
    let found = Found {
        parameters,
        by: FoundBy::Simulation,
        by_formulas: None,
        searched: None,
    };
    let laid = best_found(bench, asked, found).ok()?;
    limits::broken(bench, asked, &laid.vcut).is_none().then_some(laid)
}

/// The operation on the best lattice, or on the one that it asks for.
fn best_lattice(bench: &Bench<'_>, asked: &RoughVcut) -> Result<LaidOut, Unplanned> {
    match (asked.lattice.value, asked.objective.value) {
        (_, Objective::Scallop | Objective::BladeLoad) if is_searched(asked) => finest::finest(bench, asked),
        (_, Objective::Cuts) if is_searched(asked) => fewest(bench, asked),
        (Auto::Auto, Objective::Time) => compare_lattices(bench, asked),
        // The fewest cuts do not depend on the route: all lattices are searched at once.
        (Auto::Given(_), _) | (Auto::Auto, Objective::Scallop | Objective::Cuts | Objective::BladeLoad) => {
            best_on(bench, asked, &parameters::open_lattices(asked))
        }
    }
}

/// The operation with the fewest cuts: those that a search for them finds, with fitted tips or others, or the fastest plan where that has
/// fewer.
fn fewest(bench: &Bench<'_>, asked: &RoughVcut) -> Result<LaidOut, Unplanned> {
    let searched = best_on(bench, asked, &parameters::open_lattices(asked));
    let mut fast = asked.clone();
    fast.objective.value = Objective::Time;
    let fastest = best_lattice(bench, &fast).ok().map(|mut laid| {
        laid.vcut.asked.objective = asked.objective;
        laid
    });
    let weighed = |laid: LaidOut| bench.judged(laid, asked);
    let others = best_fitted(bench, asked).into_iter().chain(fastest.map(weighed));
    // The first one stands among equals.
    let better = |best: Contender, other: Contender| {
        if other.compare(&best) == Ordering::Less {
            other
        } else {
            best
        }
    };
    match searched {
        Ok(searched) => Ok(others.fold(weighed(searched), better).laid),
        Err(unplanned) => others.reduce(better).map(|best| best.laid).ok_or(unplanned),
    }
}

/// The operation with the best parameters on one of these lattices.
fn best_on(bench: &Bench<'_>, asked: &RoughVcut, lattices: &[Lattice]) -> Result<LaidOut, Unplanned> {
    let found = trial::parameters(bench, asked, lattices, None)?;
    best_found(bench, asked, found)
}

/// The operation with the parameters that a search came to.
fn best_found(bench: &Bench<'_>, asked: &RoughVcut, found: Found) -> Result<LaidOut, Unplanned> {
    let mut laid = best_residual(bench, asked, &found.parameters)?;
    laid.vcut.searched = found.searched;
    match found.by {
        FoundBy::Formulas => Ok(laid),
        FoundBy::Simulation => {
            let best = bench.judged(laid, asked);
            let candidate = |by: FoundBy, standing| Candidate {
                what: by.words().to_owned(),
                standing,
            };
            let decision = Decision {
                field: PARAMETERS,
                taken: candidate(FoundBy::Simulation, best.standing),
                others: found
                    .by_formulas
                    .into_iter()
                    .map(|standing| candidate(FoundBy::Formulas, standing))
                    .collect(),
            };
            let mut laid = best.laid;
            laid.vcut.decisions.insert(0, decision);
            Ok(laid)
        }
    }
}

fn compare_lattices(bench: &Bench<'_>, asked: &RoughVcut) -> Result<LaidOut, Unplanned> {
    let mut refused = None;
    let mut by_model: Vec<(Duration, Lattice)> = Vec::new();
    for lattice in parameters::open_lattices(asked) {
        // A lattice on which the operation is not possible is not a fault of the job while there is another.
        if let Some(found) = trial::freest(bench, asked, lattice) {
            by_model.push((found.estimate(&bench.job, asked), lattice));
        }
    }
    by_model.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let mut contest = Contest::new();
    let mut searched: Vec<Searched> = Vec::new();
    if let Some(fitted) = best_fitted(bench, asked) {
        searched.extend(fitted.laid.vcut.searched);
        contest.enter(Lattice::Fitted.word(), fitted);
    }
    // A lattice on which too many cuts are needed to compare them is the last resort.
    let mut large: Option<(&'static str, Found)> = None;
    for &(time, lattice) in &by_model {
        let what = lattice.word();
        let best = contest.best.as_ref().map(|(_, best)| best);
        if best.is_some_and(|best| is_much_slower(time, best)) {
            contest.rule_out(what, Standing::ByModel(time));
            continue;
        }
        let rival = best.and_then(|best| best.standing.time());
        let found = trial::parameters(bench, asked, &[lattice], rival);
        searched.extend(found.as_ref().ok().and_then(|found| found.searched));
        match found {
            Ok(found) if found.is_large(&bench.job, asked) => {
                contest.rule_out(what, Standing::NotCompared);
                large.get_or_insert((what, found));
            }
            found => match found.and_then(|found| best_found(bench, asked, found)) {
                Ok(laid) => {
                    contest.enter(what, bench.judged(laid, asked));
                }
                Err(refusal) => {
                    contest.rule_out(what, Standing::Impossible);
                    refused.get_or_insert(refusal);
                }
            },
        }
    }
    let best = contest.finish("lattice").map(|mut best| {
        best.laid.vcut.searched = searched.into_iter().reduce(Searched::and);
        best
    });
    match (best, large) {
        (Some(best), None) => Ok(best.laid),
        (Some(best), Some(_)) if best.standing.time().is_some() => Ok(best.laid),
        (_, Some((what, found))) => {
            let mut laid = best_found(bench, asked, found)?;
            laid.vcut
                .decisions
                .insert(0, not_compared("lattice", what.to_owned()));
            Ok(laid)
        }
        (None, None) => {
            // All lattices together: what is reported of one alone would not be about the job.
            let together = parameters::resolve(&bench.job, &trial::of_model(asked));
            Err(match (together, refused) {
                (Err(refusal), _) => refusal.into(),
                (Ok(_), Some(refused)) => refused,
                (Ok(_), None) => Unplanned::Refused(Vec::new()),
            })
        }
    }
}

/// The best operation with fitted tips, where they may be taken and nothing is wrong with it. More stands above them than between the rows
/// of a lattice, so the body of the blade may meet it.
fn best_fitted(bench: &Bench<'_>, asked: &RoughVcut) -> Option<Contender> {
    if !is_fitted_open(bench, asked) {
        return None;
    }
    let laid = best_on(bench, asked, &[Lattice::Fitted]).ok()?;
    let is_clear = bench.clears_bodies(&laid.vcut);
    let weighed = bench.judged(laid, asked);
    let best = (is_clear && weighed.standing.time().is_some()).then_some(weighed)?;
    Some(closer::best(bench, asked, best))
}

/// The lattices that are searched one after the other, fitted tips first where they may be.
fn lattices(bench: &Bench<'_>, asked: &RoughVcut) -> Vec<Lattice> {
    let fitted = is_fitted_open(bench, asked).then_some(Lattice::Fitted);
    let others = parameters::open_lattices(asked);
    fitted.into_iter().chain(others).collect()
}

/// Whether tips may be fitted to the part where the lattice is open: as Vs may be skipped, and nothing asks for rows and columns.
fn is_fitted_open(bench: &Bench<'_>, asked: &RoughVcut) -> bool {
    asked.lattice.value == Auto::Auto
        && asked.residual.value == Auto::Auto
        && asked.family == Family::Straight
        && asked.limits.layer.least.is_none()
        && asked.limits.step.least.is_none()
        && asked.limits.scallop.is_some()
        && Skipping::of(&bench.job, asked) != Skipping::Never
}

/// Whether a time by the model is much longer than that of a plan: than its own time, and than what the model
/// says of it, because on small parts the model is far from what is planned.
fn is_much_slower(model: Duration, best: &Contender) -> bool {
    let time = best.standing.time();
    time.is_some_and(|time| model > time.max(best.laid.vcut.estimate) * MUCH_SLOWER)
}

/// The operation with the best residual strategy, or with the one that it asks for, along the best route.
fn best_residual(bench: &Bench<'_>, asked: &RoughVcut, found: &VcutParameters) -> Result<LaidOut, Unplanned> {
    if bench.wanted.is_needless() {
        return Err(Unplanned::Refused(Vec::new()));
    }
    let first = lay_out(&bench.job, asked, found.clone(), bench.work())?;
    let first = redundant::decided(bench, first, asked);
    let is_open = asked.residual.value == Auto::Auto && first.strategies == Strategies::Differing;
    let mut first = route::best(bench, first);
    if !is_open {
        return Ok(first);
    }
    if first.vcut.laid_out() > MOST_CUTS_COMPARED {
        first
            .vcut
            .decisions
            .insert(0, not_compared("residual", "mixed".to_owned()));
        return Ok(first);
    }
    let along_other = |residual: Residual| -> Option<Contender> {
        if bench.wanted.is_needless() {
            return None;
        }
        let mut asked = asked.clone();
        asked.residual.value = Auto::Given(residual);
        let mut laid = lay_out(&bench.job, &asked, found.clone(), bench.work()).ok()?;
        laid.vcut.asked.residual.value = Auto::Auto;
        let laid = redundant::decided(bench, laid, &asked);
        Some(bench.weigh(route::best(bench, laid)))
    };
    let (mixed, others): (Contender, Vec<(Residual, Option<Contender>)>) = rayon::join(
        || bench.weigh(first),
        || {
            OTHERS
                .into_par_iter()
                .map(|residual| (residual, along_other(residual)))
                .collect()
        },
    );
    let mut contest = Contest::new();
    // Where the job sets no limit, none may leave more than `mixed` or the lattice itself does.
    let limit = match asked.limits.scallop {
        Some(limit) => limit.value,
        None => {
            let bound = mixed.laid.vcut.parameters.scallop_bound(asked);
            mixed.figures.height.max(bound)
        }
    };
    contest.enter("mixed", mixed.held_to(Some(limit), asked));
    for (residual, other) in others {
        match other {
            Some(contender) => contest.enter(residual.word(), contender.held_to(Some(limit), asked)),
            None => contest.rule_out(residual.word(), Standing::Impossible),
        }
    }
    contest
        .finish("residual")
        .map(|best| best.laid)
        .ok_or(Unplanned::Refused(Vec::new()))
}

/// A choice for which nothing else was tried.
fn not_compared(field: &'static str, what: String) -> Decision {
    Decision {
        field,
        taken: Candidate {
            what,
            standing: Standing::NotCompared,
        },
        others: Vec::new(),
    }
}
