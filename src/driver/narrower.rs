//! A narrower swing where the machine left a faster route out.
//!
//! Where the machine does not follow the fastest route, slower routes come first, since they leave the lattice as it is. But
//! a narrower swing may let it follow the faster route, and cost less than the slower one. Both are compiled, and the
//! faster is taken.

use super::{Compiled, Ended, Kept, Stage, axis_moves, compiled, reaching};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Diagnostic, has_errors};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_job::operation::Aim;
use vcutc_job::search::SearchSpace;
use vcutc_motion::solve::Changes;
use vcutc_process::plan;
use vcutc_process::verdict;
use vcutc_remedy::fallback::Fallback;

/// A plan that the machine follows along a slower route, perhaps.
pub(super) struct Slower {
    pub(super) plan: Box<PlannedJob>,
    pub(super) warnings: Vec<Diagnostic>,
    /// What came of it.
    pub(super) compiled: Box<Compiled>,
}

/// This plan, or a faster one with a narrower swing along the route that was left out.
pub(super) fn or_with_a_narrower_swing<'j>(
    mut best: Slower,
    job: &CheckedJob,
    sources: &SourceMap,
    mut fallback: Fallback<'_>,
    kept: &mut Kept<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Ended<'j> {
    if job
        .operations
        .iter()
        .all(|operation| operation.aim() == Aim::Time)
    {
        // Limits that the compiler chose are kept: what leaves more on the part is not faster.
        let within = plan::settled(job, &best.plan).unwrap_or_else(|| job.clone());
        while let Some(space) = fallback.narrow_for_a_faster_route() {
            match faster(&best, (job, &within), space, sources, kept, progress) {
                Tried::Faster(found) => {
                    best = *found;
                    break;
                }
                Tried::Slower => break,
                Tried::NotFollowed => {}
            }
        }
    }
    if kept.wanted.is_needless() {
        return Ended::Overtaken;
    }
    best.compiled.not_followed = fallback.into_first();
    Ended::Compiled(best.plan, best.warnings, best.compiled)
}

/// What came of a narrower swing.
enum Tried {
    Faster(Box<Slower>),
    /// It takes as long or longer, or there is no such plan.
    Slower,
    /// The machine does not follow it.
    NotFollowed,
}

fn faster(
    than: &Slower,
    (job, within): (&CheckedJob, &CheckedJob),
    space: SearchSpace,
    sources: &SourceMap,
    kept: &mut Kept<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Tried {
    progress(Stage::Planning);
    let Ok(plan) = kept.memory.choose(within, space, kept.wanted) else {
        return Tried::Slower;
    };
    let plan = reaching::as_asked(plan, job);
    progress(Stage::Proving);
    let Ok(proven) = verdict::prove(&plan, sources) else {
        return Tried::Slower;
    };
    let mut warnings = verdict::diagnose_while(job, &plan, &proven, &Wanted::never(), &mut |_| false);
    let time = than.compiled.report.times.all.total();
    if has_errors(&warnings) || proven.report.times.all.total() >= time {
        return Tried::Slower;
    }
    let Ok(program) = reaching::reach(job, proven.program, Changes::InTheAir, kept, progress) else {
        return Tried::NotFollowed;
    };
    let reached = program.reached();
    warnings.extend(reached.and_then(|reached| axis_moves::many(job, reached)));
    let compiled = compiled(job, program, &plan, proven.report, sources);
    if compiled.report.times.all.total() >= time {
        return Tried::Slower;
    }
    Tried::Faster(Box::new(Slower {
        plan: Box::new(plan),
        warnings,
        compiled: Box::new(compiled),
    }))
}
