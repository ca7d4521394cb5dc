//! The least scallop, and the least edge in use, of what is planned within the limits on time, cuts and parameters.
//!
//! What leaves less takes longer. So the question is turned round, as the epsilon-constraint method does [Haimes 1971]: under a
//! limit on the scallop, is there a plan that keeps all other limits? Plans of least time are searched for as
//! usual ([`trial`]), so whatever makes them fast makes room for less scallop. The limit is narrowed for as
//! long as there is one, then the way between the last that is kept and the first that is not is halved: at
//! first any plan will do, at last the fastest is searched for. What was found is then changed for as long as
//! it leaves less. The formulas' choice is compared with it.

use super::assumed::{limited, under};
use super::bench::{Bench, Figures};
use super::trial::{self, Found, FoundBy, TurnedDown};
use super::{Contender, MOST_CUTS_COMPARED, Unplanned, best_found, best_on, offers, route, within_limits};
use crate::asked::{Lattice, Objective, RoughVcut};
use crate::plan::optimum::Bound;
use crate::plan::parameters::{self, VcutParameters};
use crate::plan::{LaidOut, lay_out};
use vcutc_backend_api::units::Length;
use vcutc_cancellation::Effort;

/// How limits are narrowed.
struct Narrowing {
    /// Most limits that are looked at.
    most: u32,
    /// The first step below what is known to be kept, as a share of it.
    farther: f64,
    /// How near to one another a limit that is kept and one that is not are brought.
    near: f64,
}

/// Where any plan will do.
const COARSE: Narrowing = Narrowing {
    most: 12,
    farther: 0.6,
    near: 1.05,
};

/// Where the fastest plan is searched for.
const FINE: Narrowing = Narrowing {
    most: 5,
    farther: 0.9,
    near: 1.04,
};

/// What is made small.
fn measure(asked: &RoughVcut, figures: &Figures) -> Length {
    Length::mm(figures.merit(asked.objective.value))
}

/// The operation with the least scallop, or the least edge in use.
pub(super) fn finest(bench: &Bench<'_>, asked: &RoughVcut) -> Result<LaidOut, Unplanned> {
    let by_formulas = match parameters::resolve(&bench.job, asked) {
        Ok(found) => Some(found),
        Err(refusal) if refusal.is_conflict() => None,
        Err(refusal) => return Err(refusal.into()),
    };
    let fastest = within_limits(bench, &limited(asked, None))?;
    if fastest.vcut.laid_out() > MOST_CUTS_COMPARED {
        return Ok(as_asked(fastest, asked));
    }
    let fastest = bench.judged(fastest, asked);
    let formulas = by_formulas.and_then(|found| planned(bench, asked, found));
    let by_formulas = formulas.as_ref().map(|one| one.standing);
    let is_sound = |one: &Contender| one.standing.time().is_some();
    let start = match formulas.filter(is_sound) {
        Some(sound)
            if !is_sound(&fastest) || measure(asked, &sound.figures) < measure(asked, &fastest.figures) =>
        {
            sound
        }
        Some(_) | None => fastest,
    };
    if !is_sound(&start) {
        // No plan keeps the job's own limits, so there is none to be narrowed.
        return Ok(as_asked(start.laid, asked));
    }
    let mut search = Search {
        bench,
        asked,
        turned_down: Vec::new(),
    };
    let kept = measure(asked, &start.figures);
    let start = (start.laid.vcut.parameters, kept);
    let start = narrowed(&COARSE, start, |lattice, next| search.any(lattice, next));
    let (parameters, kept) = narrowed(&FINE, start, |lattice, next| search.fastest(lattice, next));
    let assumed = under(asked, Some(kept));
    let found = Found {
        parameters: search.changed(&assumed, parameters),
        by: FoundBy::Simulation,
        by_formulas,
        searched: None,
    };
    best_found(bench, &assumed, found).map(|laid| as_asked(laid, asked))
}

/// A plan with the job's own limits.
fn as_asked(mut laid: LaidOut, asked: &RoughVcut) -> LaidOut {
    laid.vcut.asked.limits = asked.limits;
    laid.vcut.asked.objective = asked.objective;
    laid
}

/// The result of parameters along the fastest route.
fn planned(bench: &Bench<'_>, asked: &RoughVcut, found: VcutParameters) -> Option<Contender> {
    let laid = lay_out(&bench.job, asked, found, bench.work()).ok()?;
    if laid.vcut.cuts.len() > MOST_CUTS_COMPARED {
        return None;
    }
    Some(bench.judged(route::best(bench, laid), asked))
}

struct Search<'s> {
    bench: &'s Bench<'s>,
    asked: &'s RoughVcut,
    /// Plans that broke the job's limits.
    turned_down: Vec<TurnedDown>,
}

/// Parameters, and the limit on what is made small that they keep.
type Kept = (VcutParameters, Length);

/// The parameters under the tightest limit that any are found for, and that limit.
fn narrowed(by: &Narrowing, start: Kept, mut find: impl FnMut(Lattice, Length) -> Option<Kept>) -> Kept {
    let mut best = start;
    let mut fails: Option<Length> = None;
    for _ in 0..by.most {
        let (parameters, kept) = &best;
        let next = match fails {
            Some(fails) if *kept / fails < by.near => break,
            Some(fails) => Length::mm((kept.to_mm() * fails.to_mm()).sqrt()),
            None => *kept * by.farther,
        };
        match find(parameters.lattice, next) {
            Some(found) => best = found,
            None => fails = Some(next),
        }
    }
    best
}

impl Search<'_> {
    /// Any parameters whose plan keeps a limit and all others, on some lattice first.
    fn any(&mut self, first: Lattice, limit: Length) -> Option<Kept> {
        let assumed = limited(self.asked, Some(limit));
        let mut lattices = super::lattices(self.bench, &assumed);
        lattices.sort_by_key(|&lattice| lattice != first);
        let mut effort = Effort::OF_A_PROBE;
        let (parameters, figures) = offers::any(
            self.bench,
            &assumed,
            &lattices,
            &mut effort,
            &mut self.turned_down,
        )?;
        Some((parameters, limit.min(measure(self.asked, &figures))))
    }

    /// The fastest parameters found under a limit, if their plan keeps all others.
    fn fastest(&mut self, lattice: Lattice, limit: Length) -> Option<Kept> {
        let assumed = limited(self.asked, Some(limit));
        let laid = best_on(self.bench, &assumed, &[lattice]).ok()?;
        let found = self.bench.judged(laid, &assumed);
        self.turned_down
            .extend(TurnedDown::of(found.standing, found.figures));
        found.standing.time()?;
        let kept = limit.min(measure(self.asked, &found.figures));
        Some((found.laid.vcut.parameters, kept))
    }

    /// The best results of changing parameters, with what bounds them: the limits that the job sets.
    fn changed(self, assumed: &RoughVcut, start: VcutParameters) -> VcutParameters {
        let objective = self.asked.objective.value;
        let is_assumed = |bound: Bound| match objective {
            Objective::Scallop => bound == Bound::Scallop,
            Objective::BladeLoad => bound == Bound::Edge,
            Objective::Time | Objective::Cuts => false,
        };
        let mut turned_down = self.turned_down;
        turned_down.retain(|other| !is_assumed(other.bound));
        match trial::from(self.bench, assumed, &start, turned_down) {
            Some(mut best) => {
                best.binding.retain(|&bound| !is_assumed(bound));
                best
            }
            None => start,
        }
    }
}
