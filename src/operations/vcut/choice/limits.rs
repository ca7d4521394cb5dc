//! Limits on time and cuts, compared with the plan itself.
//!
//! The mean-value model says before there is a plan how long an operation takes and how many cuts it has, a few percent off. So
//! where parameters are searched for by what is simulated, these limits are not asked of the model; what the formulas
//! choose keeps them by the model, and is chosen again with tighter ones where its plan does not. What no plan keeps in the end
//! is refused, with the value that the plan would keep.

use super::assumed::is_searched;
use super::bench::Bench;
use crate::asked::{Objective, RoughVcut};
use crate::plan::PlannedVcut;
use crate::plan::decision::Excess;
use crate::plan::refusal::{Offer, Refused};
use vcutc_backend_api::units::Duration;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};

/// How often limits are tightened for the model.
pub(super) const MOST_TIGHTENED: u32 = 4;

/// How much tighter than in proportion: whole cuts and layers make a plan jump.
const SPARE: f64 = 0.995;

/// The operation without limits on time and cuts, for callers that compare plans with them.
pub(super) fn of_plans(asked: &RoughVcut) -> RoughVcut {
    let mut asked = asked.clone();
    asked.limits.time = None;
    asked.limits.cuts = None;
    asked
}

/// Which of an operation's limits on time and cuts a plan breaks.
pub(super) fn broken(bench: &Bench<'_>, asked: &RoughVcut, vcut: &PlannedVcut) -> Option<Excess> {
    if asked.limits.time.is_none() && asked.limits.cuts.is_none() {
        return None;
    }
    let (_, time) = bench.timed(vcut)?;
    excess(asked, time, vcut.cuts.len())
}

/// Which of its limits a plan of so many cuts breaks that takes this time.
pub(super) fn excess(asked: &RoughVcut, time: Duration, cuts: usize) -> Option<Excess> {
    let [late, many] = excesses(asked, time, cuts);
    late.or(many)
}

/// By how much the limit on time and the limit on cuts are broken.
fn excesses(asked: &RoughVcut, time: Duration, cuts: usize) -> [Option<Excess>; 2] {
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
    [late, many]
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

/// How much wider than what the plan comes to a limit may have to be: what is searched for within limits may come out
/// otherwise.
const MARGINS: [f64; 4] = [1.0, 1.02, 1.1, 1.25];

/// A plan that breaks a limit: what it comes to, and wider limits, of which one may be kept.
pub(super) fn complaint(vcut: &PlannedVcut, excess: Excess) -> Refused {
    let asked = &vcut.asked;
    let ladder = MARGINS
        .into_iter()
        .map(|margin| wider(asked, &[excess], margin))
        .collect();
    Refused {
        diagnostic: found(vcut, excess),
        ladders: vec![ladder],
        resort: Offer::openings(asked),
        otherwise: Some("widen the limit, or leave more of the parameters `auto`".to_owned()),
    }
}

/// What a plan comes to that breaks a limit.
fn found(vcut: &PlannedVcut, excess: Excess) -> Diagnostic {
    let asked = &vcut.asked;
    let (plan, limit) = match excess {
        Excess::Time { time, limit } => (
            format!("takes {} s", show(tenths(time.to_s()))),
            format!("{} s", show(limit.to_s())),
        ),
        Excess::Cuts { cuts, limit } => (format!("has {cuts} cuts"), show(limit.floor())),
    };
    let which = match (asked.objective.value, excess, is_searched(asked)) {
        (Objective::Time, Excess::Time { .. }, true) => "the fastest plan found",
        (Objective::Cuts, Excess::Cuts { .. }, true) => "the plan of the fewest cuts found",
        (Objective::Time | Objective::Cuts | Objective::Scallop | Objective::BladeLoad, _, _) => "the plan",
    };
    Diagnostic::new(
        Code::LimitsConflict,
        format!("{which} {plan}, the limit is {limit}"),
        place(asked, excess),
        "the limit",
    )
    .note("this is the operation as planned, at programmed speeds, not an estimate")
}

/// In seconds, to a tenth, upwards.
fn tenths(seconds: f64) -> f64 {
    (seconds * 10.0 - 1e-6).ceil() / 10.0
}

/// The operation with the limits that a plan broke as wide as the plan needs them, and wider by a margin.
fn wider(asked: &RoughVcut, broken: &[Excess], margin: f64) -> Offer {
    let mut changed = asked.clone();
    let (mut titles, mut edits) = (Vec::new(), Vec::new());
    for &excess in broken {
        let (name, text) = match excess {
            Excess::Time { time, .. } => {
                let kept = tenths(time.to_s() * margin);
                if let Some(limit) = &mut changed.limits.time {
                    limit.value = Duration::s(kept);
                }
                ("time", format!("{} s", show(kept)))
            }
            Excess::Cuts { cuts, .. } => {
                let kept = (cuts as f64 * margin).ceil();
                if let Some(limit) = &mut changed.limits.cuts {
                    limit.value = kept;
                }
                ("cuts", show(kept))
            }
        };
        titles.push(format!("`{name} <= {text}`"));
        edits.push((place(asked, excess), text));
    }
    Offer {
        title: format!("use {}", titles.join(" and ")),
        edits,
        changed,
    }
}

/// Where the limit stands that a plan broke.
fn place(asked: &RoughVcut, excess: Excess) -> Span {
    let limits = &asked.limits;
    let span = match excess {
        Excess::Time { .. } => limits.time.and_then(|limit| limit.span),
        Excess::Cuts { .. } => limits.cuts.and_then(|limit| limit.span),
    };
    span.unwrap_or(asked.setup.head_span)
}

/// The diagnostic of a plan that breaks limits and was made without them. It keeps the nearest wider ones, so
/// they need not be tried.
pub(super) fn diagnostic(vcut: &PlannedVcut, time: Duration) -> Option<Diagnostic> {
    let broken: Vec<Excess> = excesses(&vcut.asked, time, vcut.cuts.len())
        .into_iter()
        .flatten()
        .collect();
    let offer = wider(&vcut.asked, &broken, 1.0);
    Some(found(vcut, *broken.first()?).fix_all(offer.title, &offer.edits))
}
