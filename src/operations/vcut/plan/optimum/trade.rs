//! What bounds cost: what relaxing one buys, and which time goes with which scallop.

use super::conflict::solve;
use super::problem::{Bound, Infeasible, Optimum, Problem, Sensitivity};
use crate::asked::Objective;
use vcutc_backend_api::units::Length;

/// How tight a trade-off begins, as a share of the scallop that the fastest parameters leave, where nothing else limits it.
const TIGHTEST: f64 = 0.25;

/// Scallops closer than this share are the same point of a trade-off.
const APART: f64 = 1e-6;

/// What relaxing each bound that an optimum touches by a hundredth would buy on the optimum's own lattice, in the order of
/// [`Bound`]. Another lattice may have been better before; what that would buy has nothing to do with the bound.
#[must_use]
pub fn sensitivities(problem: &Problem, optimum: &Optimum) -> Vec<Sensitivity> {
    let alone = Problem {
        lattices: vec![optimum.lattice],
        ..problem.clone()
    };
    let relaxed = |&bound: &Bound| {
        let now = bound.value(problem)?;
        let relaxed = bound.relaxed(now);
        let then = solve(&bound.replaced(&alone, relaxed)).ok()?;
        Some(Sensitivity {
            bound,
            now,
            relaxed,
            then,
        })
    };
    optimum.binding.iter().filter_map(relaxed).collect()
}

/// The least times for so many scallop limits, from the tightest that can be kept, or a quarter of the slackest where none
/// is the tightest, to the slackest that still saves time. The problem's own scallop limit is one of them, its objective is
/// not looked at. Of two parameters, those with the larger scallop take less time.
#[must_use]
pub fn trade_off(problem: &Problem, points: u32) -> Vec<Optimum> {
    let at = |limit: Option<Length>| {
        let mut limited = problem.clone();
        limited.objective = Objective::Time;
        limited.scallop = limit;
        limited
    };
    let Ok(fastest) = solve(&at(None)) else {
        return Vec::new();
    };
    let slackest = fastest.scallop.to_mm();
    let mut finest = at(None);
    finest.objective = Objective::Scallop;
    let tightest = match solve(&finest) {
        Ok(finest) => finest.scallop.to_mm().max(TIGHTEST * slackest),
        Err(Infeasible::Unbounded | Infeasible::Conflict { .. }) => TIGHTEST * slackest,
    };
    let spacing = (slackest - tightest) / f64::from(points.max(2) - 1);
    let mut limits: Vec<f64> = (0..points.saturating_sub(1))
        .map(|i| tightest + f64::from(i) * spacing)
        .collect();
    limits.extend(
        problem
            .scallop
            .map(Length::to_mm)
            .filter(|limit| *limit < slackest),
    );
    limits.sort_unstable_by(f64::total_cmp);
    let solved = limits
        .into_iter()
        .filter_map(|limit| solve(&at(Some(Length::mm(limit)))).ok());
    let mut front: Vec<Optimum> = Vec::new();
    for optimum in solved.chain([fastest]) {
        let apart = front.last().is_none_or(|last| {
            optimum.scallop / last.scallop > 1.0 + APART && optimum.time / last.time < 1.0 - APART
        });
        if apart {
            front.push(optimum);
        }
    }
    front
}
