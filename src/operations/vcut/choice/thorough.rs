//! Searches with more effort than usual (`--effort high`): more plans, and plans for other aims that may serve the job's own better.

use super::assumed::is_searched;
use super::bench::Bench;
use super::{Contender, Unplanned, chosen};
use crate::asked::{Objective, RoughVcut};
use crate::plan::LaidOut;
use crate::plan::searched::Searched;
use core::cmp::Ordering;
use rayon::prelude::*;
use vcutc_job::Sourced;
use vcutc_job::search::SearchEffort;

/// The best operation that a search with the bench's effort finds.
pub(super) fn searched(
    bench: &Bench<'_>,
    asked: &RoughVcut,
    within: &RoughVcut,
) -> Result<LaidOut, Unplanned> {
    let found = chosen::within_all_limits(bench, asked, within);
    match bench.effort {
        SearchEffort::Normal => found,
        SearchEffort::High => {
            let usual = bench.with_effort(SearchEffort::Normal);
            let others = asked_otherwise(within).into_par_iter().map(|other| {
                let mut laid = chosen::within_all_limits(&usual, asked, &other)?;
                // A limit that was chosen stays.
                if within.limits.scallop.is_some() {
                    laid.vcut.asked.limits = within.limits;
                }
                laid.vcut.asked.objective = within.objective;
                Ok(laid)
            });
            best_of(
                bench,
                within,
                [found].into_iter().chain(others.collect::<Vec<_>>()),
            )
        }
    }
}

/// The share of the limit on the scallop for which a search with more effort plans, too.
const TIGHTER: f64 = 0.9;

/// What a search with more effort plans, too, as usual: the operation as it is, because more plans lead other ways, not always to better
/// ends; and with a tighter limit on the scallop or for the fewest cuts, where time is to be short, because a plan that keeps it may be
/// faster all the same. Where the job gives all parameters there is nothing else to ask for.
fn asked_otherwise(within: &RoughVcut) -> Vec<RoughVcut> {
    let mut others = vec![within.clone()];
    if is_searched(within)
        && let (Objective::Time, Some(limit)) = (within.objective.value, within.limits.scallop)
    {
        let mut fewest = within.clone();
        fewest.objective.value = Objective::Cuts;
        let mut tighter = within.clone();
        tighter.limits.scallop = Some(Sourced {
            value: limit.value * TIGHTER,
            ..limit
        });
        others.extend([fewest, tighter]);
    }
    others
}

/// The best of several plans of an operation, the first one among equals, with the plans of all searches counted.
fn best_of(
    bench: &Bench<'_>,
    within: &RoughVcut,
    found: impl Iterator<Item = Result<LaidOut, Unplanned>>,
) -> Result<LaidOut, Unplanned> {
    let mut refused = None;
    let mut best: Option<Contender> = None;
    let mut plans: Option<Searched> = None;
    for found in found {
        match found {
            Err(unplanned) => {
                refused.get_or_insert(unplanned);
            }
            Ok(laid) => {
                plans = plans.map_or(laid.vcut.searched, |plans| {
                    Some(laid.vcut.searched.map_or(plans, |other| plans.after(other)))
                });
                let limit = laid.vcut.asked.limits.scallop.map(|limit| limit.value);
                let other = bench.weigh(laid).held_to(limit, within);
                if best
                    .as_ref()
                    .is_none_or(|best| other.compare(best) == Ordering::Less)
                {
                    best = Some(other);
                }
            }
        }
    }
    match (best, refused) {
        (Some(mut best), _) => {
            best.laid.vcut.searched = plans;
            Ok(best.laid)
        }
        (None, Some(unplanned)) => Err(unplanned),
        (None, None) => Err(Unplanned::Refused(Vec::new())),
    }
}
