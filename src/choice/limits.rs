//! Limits on time and cuts, held against the plan itself.
//!
//! The mean-value model says before there is a plan how long an operation takes and how many cuts it has, a few percent off. So
//! where parameters are searched for by what is simulated, these limits are not asked of the model; what the formulas
//! choose keeps them by the model, and is chosen again with tighter ones where its plan does not. What no plan keeps in the end
//! is refused, with the value that the plan would keep.

use crate::diag::{Code, Diagnostic};
use crate::job::{Objective, RoughVcut};
use crate::plan::PlannedVcut;
use crate::plan::decision::Excess;
use crate::plan::parameters::show;
use vcutc_backend_api::units::Duration;

/// How often limits are tightened for the model.
pub(super) const MOST_TIGHTENED: u32 = 4;

/// How much tighter than in proportion: whole cuts and layers make a plan jump.
const SPARE: f64 = 0.995;

/// The operation without limits on time and cuts, for those who hold plans to them.
pub(super) fn of_plans(asked: &RoughVcut) -> RoughVcut {
    let mut asked = asked.clone();
    asked.limits.time = None;
    asked.limits.cuts = None;
    asked
}

/// Which of its limits a plan of so many cuts breaks that takes this time.
pub(super) fn excess(asked: &RoughVcut, time: Duration, cuts: usize) -> Option<Excess> {
    let limits = &asked.limits;
    let late = limits
        .time
        .map(|limit| limit.value)
        // A plan is timed to better than a microsecond.
        .filter(|&limit| time > limit + Duration::s(1e-6))
        .map(|limit| Excess::Time { time, limit });
    let many = limits
        .cuts
        .map(|limit| limit.value)
        .filter(|&limit| cuts as f64 > limit)
        .map(|limit| Excess::Cuts { cuts, limit });
    late.or(many)
}

/// The operation with the limit that a plan broke tightened for the model by as much.
pub(super) fn tightened(assumed: &RoughVcut, excess: Excess) -> RoughVcut {
    let mut tighter = assumed.clone();
    match excess {
        Excess::Time { time, limit } => {
            if let Some(bound) = &mut tighter.limits.time {
                bound.value = bound.value * (limit / time * SPARE);
            }
        }
        Excess::Cuts { cuts, limit } => {
            if let Some(bound) = &mut tighter.limits.cuts {
                bound.value = (bound.value * (limit / cuts as f64 * SPARE)).max(1.0);
            }
        }
    }
    tighter
}

/// A plan that breaks a limit: what it comes to, and the limit that it keeps.
pub(super) fn complaint(vcut: &PlannedVcut, excess: Excess) -> Diagnostic {
    let asked = &vcut.asked;
    let limits = &asked.limits;
    let (plan, limit, span, keeps) = match excess {
        Excess::Time { time, limit } => {
            let keeps = show((time.to_s() * 10.0 - 1e-6).ceil() / 10.0);
            (
                format!("takes {keeps} s"),
                format!("{} s", show(limit.to_s())),
                limits.time.and_then(|limit| limit.span),
                format!("time <= {keeps} s"),
            )
        }
        Excess::Cuts { cuts, limit } => (
            format!("has {cuts} cuts"),
            show(limit.floor()),
            limits.cuts.and_then(|limit| limit.span),
            format!("cuts <= {cuts}"),
        ),
    };
    let which = match (asked.objective.value, excess, super::trial::is_searched(asked)) {
        (Objective::Time, Excess::Time { .. }, true) => "the fastest plan found",
        (Objective::Cuts, Excess::Cuts { .. }, true) => "the plan of the fewest cuts found",
        (Objective::Time | Objective::Cuts | Objective::Scallop | Objective::BladeLoad, _, _) => "the plan",
    };
    let value = keeps.rsplit("<= ").next().unwrap_or_default().to_owned();
    Diagnostic::new(
        Code::LimitsConflict,
        format!("{which} {plan}, the limit is {limit}"),
        span.unwrap_or(asked.head_span),
        "the limit",
    )
    .note("this is the operation as planned, at programmed speeds, not an estimate")
    .fix(format!("use `{keeps}`"), span.unwrap_or(asked.head_span), value)
}
