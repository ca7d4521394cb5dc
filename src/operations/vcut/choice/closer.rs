//! Fitted tips laid out for less than the limit on the scallop: closer tips may need fewer above them, and another number of them may
//! share the width better.

use super::bench::Bench;
use super::{Contender, best_residual};
use crate::asked::RoughVcut;
use crate::plan::PARAMETERS;
use core::cmp::Ordering;
use rayon::prelude::*;

/// Shares of the limit on the scallop for which tips are laid out again.
const CLOSER: [f64; 6] = [0.98, 0.95, 0.92, 0.88, 0.84, 0.8];

/// The best of these fitted tips, and of those with the same parameters for shares of the limit on the scallop.
pub(super) fn best(bench: &Bench<'_>, asked: &RoughVcut, fitted: Contender) -> Contender {
    let closer = CLOSER
        .into_par_iter()
        .map(|share| for_share(bench, asked, &fitted, share));
    let closer: Vec<Option<Contender>> = closer.collect();
    let better = |best: Contender, other: Contender| {
        if other.compare(&best) == Ordering::Less {
            other
        } else {
            best
        }
    };
    closer.into_iter().flatten().fold(fitted, better)
}

fn for_share(bench: &Bench<'_>, asked: &RoughVcut, fitted: &Contender, share: f64) -> Option<Contender> {
    let mut closer = asked.clone();
    closer.limits.scallop.as_mut()?.value = asked.limits.scallop?.value * share;
    let mut laid = best_residual(bench, &closer, &fitted.laid.vcut.parameters).ok()?;
    laid.vcut.asked.limits = asked.limits;
    laid.vcut.searched = fitted.laid.vcut.searched;
    let is_clear = bench.clears_bodies(&laid.vcut);
    let mut judged = bench.judged(laid, asked);
    let mut before = fitted.laid.vcut.decisions.iter();
    if let Some(decision) = before.find(|decision| decision.field == PARAMETERS) {
        let mut decision = decision.clone();
        decision.taken.standing = judged.standing;
        judged.laid.vcut.decisions.insert(0, decision);
    }
    (is_clear && judged.standing.time().is_some()).then_some(judged)
}
