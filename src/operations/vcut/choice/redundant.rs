//! Redundant Vs: cut or skipped, as the operation asks, or as is better where that is open (`docs/process.md`, "Redundant Vs").

use super::bench::Bench;
use super::{Contender, MOST_CUTS_COMPARED, route};
use crate::asked::{Avoid, Compensate, Formulas, Objective, Redundant, RoughVcut};
use crate::plan::LaidOut;
use core::cmp::Ordering;
use vcutc_backend_api::ir::MachineKind;
use vcutc_job::{Auto, BladeRef, CheckedJob, Order};

/// When the redundant Vs of an operation are skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Skipping {
    Never,
    IfBetter,
    Always,
}

impl Skipping {
    /// What an operation asks for. Left open, Vs are skipped only where the compiler chooses their distances, it is known how much
    /// may stay, and nothing depends on how much edge is in the material.
    pub(super) fn of(job: &CheckedJob, asked: &RoughVcut) -> Self {
        match asked.redundant.value {
            Auto::Given(Redundant::Keep) => Self::Never,
            Auto::Given(Redundant::Skip) => Self::Always,
            Auto::Auto if is_open(asked) && is_free_to_leave_more(job, asked) => Self::IfBetter,
            Auto::Auto => Self::Never,
        }
    }
}

/// Whether nothing is in the way of what stands higher for a while: neither an operation after this one that cuts with a straight blade,
/// nor a machine whose control turns the blade axis by axis, because then it sweeps farther beside its tip
/// than the plan knows.
fn is_free_to_leave_more(job: &CheckedJob, asked: &RoughVcut) -> bool {
    let kind = job.machine.as_ref().map(|machine| machine.model.kind());
    if kind == Some(MachineKind::FiveAxis) {
        return false;
    }
    let operations = job.operations.iter();
    let from_this_on = operations.skip_while(|one| one.setup().head_span != asked.setup.head_span);
    let mut blades = from_this_on.skip(1).flat_map(|later| later.blades());
    blades.all(|blade| !matches!(blade, BladeRef::Straight(_)))
}

fn is_open(asked: &RoughVcut) -> bool {
    let limits = &asked.limits;
    let is_chosen = asked.layer.value == Auto::Auto
        && asked.step.value == Auto::Auto
        && asked.overlap.value == Auto::Auto
        && limits.layer.most.is_none()
        && limits.step.most.is_none();
    let pays = match asked.objective.value {
        Objective::Time | Objective::Cuts => true,
        // Fewer Vs leave room in the limit for a finer lattice.
        Objective::Scallop | Objective::BladeLoad => limits.time.is_some() || limits.cuts.is_some(),
    };
    let is_pushed = limits.deviation.is_some() || asked.compensate.value == Compensate::Forces;
    is_chosen
        && pays
        && !is_pushed
        && limits.scallop.is_some()
        && asked.formulas.value == Formulas::Exact
        // Flanks that were narrowed depend on what stands beside them.
        && asked.avoid.value == Avoid::Lift
}

/// The operation with or without its redundant Vs.
pub(super) fn decided(bench: &Bench<'_>, all: LaidOut, asked: &RoughVcut) -> LaidOut {
    let skipping = Skipping::of(&bench.job, asked);
    let is_large = all.vcut.cuts.len() > MOST_CUTS_COMPARED;
    if skipping == Skipping::Never || (skipping == Skipping::IfBetter && is_large) {
        return all;
    }
    let Some(thinned) = bench.thinned(&all) else {
        return all;
    };
    if skipping == Skipping::Always {
        return thinned;
    }
    let weighed = |laid| bench.judged(route::usual(bench, laid, Order::Point), asked);
    better(asked, [thinned, all], weighed).laid
}

/// The better one of an operation without its redundant Vs and the same with all of them.
pub(super) fn better(
    asked: &RoughVcut,
    [thinned, all]: [LaidOut; 2],
    weigh: impl Fn(LaidOut) -> Contender,
) -> Contender {
    let thinned = weigh(thinned);
    let is_less_work = match asked.objective.value {
        // Fewer Vs hardly ever take longer.
        Objective::Time | Objective::Cuts => thinned.standing.time().is_some(),
        Objective::Scallop | Objective::BladeLoad => false,
    };
    if is_less_work {
        return thinned;
    }
    let all = weigh(all);
    if thinned.compare(&all) == Ordering::Less {
        thinned
    } else {
        all
    }
}
