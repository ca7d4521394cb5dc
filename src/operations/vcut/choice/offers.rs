//! What is reported of an operation that has no plan. Of the changes that may fix it, only those are offered
//! whose plan is sound: they are planned, written down, replayed and tried on the machine of the job before
//! they are reported.

use super::assumed::{as_time, is_searched, limited};
use super::bench::{Bench, Figures};
use super::trial::{self, TurnedDown};
use super::{Unplanned, within_limits};
use crate::asked::{Lattice, RoughVcut};
use crate::plan::parameters::{self, Refusal, VcutParameters};
use crate::plan::refusal::{Ladder, Offer, Refused};
use vcutc_backend_api::units::Duration;
use vcutc_cancellation::Effort;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::operation::WorksThere;

/// Longest times that are offered where nothing else holds the layer, as shares of the least time.
const LONGER: [f64; 3] = [1.5, 2.5, 4.0];

/// Puts into words why there is no plan, with what works of all that may: here, and for the stages after
/// planning.
pub(super) fn diagnostics(
    (bench, asked): (&Bench<'_>, &RoughVcut),
    unplanned: Unplanned,
    effort: &mut Effort,
    works_there: &mut WorksThere<'_>,
) -> Vec<Diagnostic> {
    let refused = match unplanned {
        Unplanned::Refused(refused) => refused,
        Unplanned::Parameters(Refusal::Unbounded) => {
            let times = longer_than_the_least(bench, asked);
            vec![parameters::nothing_holds_the_layer(asked, &times)]
        }
        Unplanned::Parameters(refusal) => refusal.in_words(asked),
    };
    refused
        .into_iter()
        .map(|refused| {
            with_what_works(refused, effort, |offer, effort| {
                let is_over = |effort: &Effort| effort.is_spent() || bench.wanted.is_needless();
                if is_over(effort) {
                    return Attempt::LeftOut;
                }
                let is_good = is_sound(bench, &offer.changed, effort) && works_there(&offer.edits);
                match is_good {
                    true => Attempt::Works,
                    // What was broken off says nothing.
                    false if bench.wanted.is_needless() => Attempt::LeftOut,
                    false => Attempt::Fails,
                }
            })
        })
        .collect()
}

/// The result of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Attempt {
    Works,
    Fails,
    /// It was not tried, or not to its end.
    LeftOut,
}

/// The diagnostic with the first offer of each ladder that works, or with what was tried. Each ladder may spend as much as
/// every other, and on it each offer.
fn with_what_works(
    refused: Refused,
    effort: &mut Effort,
    mut attempt: impl FnMut(&Offer, &mut Effort) -> Attempt,
) -> Diagnostic {
    let Refused {
        mut diagnostic,
        ladders,
        resort,
        otherwise,
    } = refused;
    let mut rest = ladders.len() + 1;
    let mut failed = Vec::new();
    for ladder in ladders {
        let mut part = effort.part(rest);
        rest -= 1;
        match first_that_works(ladder, &mut part, &mut attempt) {
            Ok(offer) => diagnostic = diagnostic.fix_all(offer.title, &offer.edits),
            Err(titles) => failed.extend(in_short(&titles)),
        }
        effort.give_back(&part);
    }
    if !diagnostic.fixes.is_empty() {
        return diagnostic;
    }
    match first_that_works(resort, effort, &mut attempt) {
        Ok(offer) => return diagnostic.fix_all(offer.title, &offer.edits),
        Err(titles) => failed.extend(in_short(&titles)),
    }
    let diagnostic = match failed.as_slice() {
        [] => diagnostic,
        _ => diagnostic.note(format!(
            "tried one at a time, but not enough: {}",
            failed.join("; ")
        )),
    };
    match otherwise {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

/// Most changes that are named one by one.
const MOST_NAMED: usize = 3;

/// The changes of offers that failed: the first few, and how many more there were.
fn in_short(titles: &[String]) -> Option<String> {
    let named: Vec<&str> = titles
        .iter()
        .take(MOST_NAMED)
        .map(|title| title.trim_start_matches("use "))
        .collect();
    let named = named.join(", ");
    match titles.len().saturating_sub(MOST_NAMED) {
        0 if titles.is_empty() => None,
        0 => Some(named),
        more => Some(format!("{named} and {more} more")),
    }
}

/// What one offer may spend at least of what its ladder has left: one part of so many.
const LARGEST_SHARE: usize = 8;

/// The first offer that works, or the titles of those that do not.
fn first_that_works(
    ladder: Ladder,
    effort: &mut Effort,
    attempt: &mut impl FnMut(&Offer, &mut Effort) -> Attempt,
) -> Result<Offer, Vec<String>> {
    let mut rest = ladder.len();
    let mut failed = Vec::new();
    for offer in ladder {
        // The first ones are the nearest, and may cost more.
        let mut part = effort.part(rest.min(LARGEST_SHARE));
        rest -= 1;
        let came = attempt(&offer, &mut part);
        effort.give_back(&part);
        match came {
            Attempt::Works => return Ok(offer),
            Attempt::Fails => failed.push(offer.title),
            Attempt::LeftOut => {}
        }
    }
    Err(failed)
}

/// Whether an operation has a plan that keeps all its limits and has nothing wrong, as far as is seen with so much work. Where
/// there is one, the choice comes to one.
pub(super) fn is_sound(bench: &Bench<'_>, asked: &RoughVcut, effort: &mut Effort) -> bool {
    if effort.is_spent() || bench.wanted.is_needless() {
        return false;
    }
    if !is_searched(asked) {
        if is_too_large(bench, asked, effort) {
            return false;
        }
        let Ok(laid) = within_limits(bench, asked) else {
            effort.spend(0);
            return false;
        };
        effort.spend(laid.vcut.cuts.len());
        return bench.judged(laid, asked).standing.time().is_some();
    }
    let (assumed, lattices) = (as_time(asked), super::lattices(bench, asked));
    any(bench, &assumed, &lattices, effort, &mut Vec::new()).is_some()
        || keeps_what_the_best_plan_needs(bench, asked, effort)
}

/// Whether the choice keeps limits on time and cuts that a search for any plan does not: the best plan of all may do.
fn keeps_what_the_best_plan_needs(bench: &Bench<'_>, asked: &RoughVcut, effort: &mut Effort) -> bool {
    let is_limited = asked.limits.time.is_some() || asked.limits.cuts.is_some();
    if !is_limited || bench.wanted.is_needless() {
        return false;
    }
    let Ok(laid) = within_limits(bench, asked) else {
        return false;
    };
    effort.spend(laid.vcut.cuts.len());
    bench.judged(laid, asked).standing.time().is_some()
}

/// Whether an operation has more cuts by the model than may be planned.
fn is_too_large(bench: &Bench<'_>, asked: &RoughVcut, effort: &Effort) -> bool {
    let found = parameters::resolve(&bench.job, asked);
    found.is_ok_and(|found| effort.is_less_than(found.estimated_cuts(&bench.job, asked)))
}

/// The first sound plan on any of some lattices, and plans that broke limits before.
pub(super) fn any(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    lattices: &[Lattice],
    effort: &mut Effort,
    turned_down: &mut Vec<TurnedDown>,
) -> Option<(VcutParameters, Figures)> {
    let rest = (1..=lattices.len()).rev();
    lattices.iter().zip(rest).find_map(|(&lattice, rest)| {
        let (found, left) = trial::any(bench, asked, &[lattice], effort.part(rest));
        effort.give_back(&left);
        turned_down.extend(found.turned_down);
        found.sound
    })
}

/// Times that leave more room than the least there is.
fn longer_than_the_least(bench: &Bench<'_>, asked: &RoughVcut) -> Vec<Duration> {
    if bench.wanted.is_needless() {
        return Vec::new();
    }
    let fastest = within_limits(bench, &limited(asked, None));
    let least = fastest
        .ok()
        .and_then(|laid| bench.timed(&laid.vcut))
        .map(|(_, time)| time);
    let longer = |least: Duration| LONGER.map(|share| rounded_up(least * share));
    least.map(longer).into_iter().flatten().collect()
}

/// To whole seconds, to tens of them or to minutes.
fn rounded_up(time: Duration) -> Duration {
    let whole = match time.to_s() {
        short if short < 60.0 => 1.0,
        long if long < 600.0 => 10.0,
        _ => 60.0,
    };
    Duration::s((time.to_s() / whole).ceil() * whole)
}
