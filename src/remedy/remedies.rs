//! Changes that make an unreachable job reachable.
//!
//! Nothing is offered that has not been through the whole pipeline: planned again where the change concerns the cuts, proven,
//! and carried out by the machine from home to home. Places for the base are sorted out by the taught poses before.
//!
//! | What breaks | What is tried |
//! | --- | --- |
//! | a rate | the highest speeds that the axes follow (`speed`) |
//! | reach, limits, singular poses, the branch | another direction or order of the cuts, a smaller swing (`process`), the base moved or turned by the least that helps (`base`) |
//! | a turn that sweeps the blade through the work | a larger extension or clearance, another direction (`process`) |
//! | the way from home or to home | a home above the first cut (`home`), else the base |
//!
//! A rate that would need speeds far below those asked for is taken for a place the arm had better avoid: what fixes the
//! other kinds is tried then, too.

use crate::case::Case;
use crate::change::{Change, Elsewhere};
use crate::{base, home, nearer, process, speed};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_job::operation::WorksThere;
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::path::Violation;
use vcutc_motion::solve::Unreachable;
use vcutc_motion::trouble::Trouble;
use vcutc_motion::verdict;

/// Most remedies that are offered.
const MOST_OFFERED: usize = 3;
/// Explains why a program is not carried out, and offers changes of the job that fix it: those that were found while they
/// were wanted.
#[must_use]
pub fn diagnose<'c>(
    job: &'c CheckedJob,
    plan: &'c PlannedJob,
    unreachable: &'c Unreachable,
    wanted: &Wanted,
    works: &'c mut WorksThere<'c>,
) -> Option<Diagnostic> {
    let explained = verdict::explain(job, unreachable)?;
    let Some(general) = explained.advice else {
        return Some(explained.diagnostic);
    };
    let mut case = Case::of(job, plan, unreachable, wanted, works)?;
    let remedies = remedies(&mut case);
    let diagnostic = explained.diagnostic;
    if !remedies.is_empty() {
        return Some(remedies.into_iter().fold(diagnostic, |diagnostic, remedy| {
            if remedy.edits.is_empty() {
                diagnostic.help(remedy.advice)
            } else {
                diagnostic.fix_all(remedy.advice, &remedy.edits)
            }
        }));
    }
    let diagnostic = diagnostic.help(general);
    let diagnostic = if wanted.is_needless() {
        // That nothing helps is not known.
        diagnostic
    } else {
        let mut changed = vec!["speed"];
        changed.extend(process::choices(&case));
        diagnostic.note(format!(
            "changing any one of {}, home or base did not help, as far as was tried",
            changed.join(", ")
        ))
    };
    Some(diagnostic.help(LOOK_ON))
}

const LOOK_ON: &str = "run `vcutc place` on this job: it searches around the base, or as far as `--x`, `--y`, `--z` and `--yaw` say, for a place that works";

/// Changes that let the machine carry the job out, at most [`MOST_OFFERED`]: those of the program first, then the base, the
/// nearest first.
fn remedies(case: &mut Case<'_>) -> Vec<Change> {
    let mut found = match &case.unreachable.trouble {
        Trouble::Motion { failing, .. } => match failing.worst.what {
            Violation::Rate { .. } => slower(case),
            Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => elsewhere(case),
        },
        Trouble::NoCommonBranch { .. } => elsewhere(case),
        Trouble::Way { .. } => {
            let home = home::raised(case).or_else(|| base::moved(case));
            home.into_iter().collect()
        }
        Trouble::Sweep(sweep) => {
            let room = process::more_room(case, sweep.cure);
            room.into_iter().chain(process::other_direction(case)).collect()
        }
        Trouble::Stray(_) => Vec::new(),
        Trouble::Nowhere => base::moved(case).into_iter().collect(),
    };
    found.truncate(MOST_OFFERED);
    found
}

/// The nearest place for the base, moved or turned, where the machine carries out this very plan.
pub(crate) fn elsewhere_for(
    job: &CheckedJob,
    plan: &PlannedJob,
    unreachable: &Unreachable,
    wanted: &Wanted,
) -> Option<Elsewhere> {
    let mut works = |_: &[(Span, String)]| false;
    let mut case = Case::of(job, plan, unreachable, wanted, &mut works)?;
    base::moved_to(&mut case).or_else(|| base::turned_to(&mut case))
}

/// Lower speeds, and where they would be far lower, another posture before them.
fn slower(case: &mut Case<'_>) -> Vec<Change> {
    match speed::lowered(case) {
        Some((remedy, speed::Loss::Bearable)) => {
            let base = base::moved(case);
            core::iter::once(remedy).chain(base).collect()
        }
        Some((remedy, speed::Loss::Severe)) => {
            let mut found = elsewhere(case);
            found.truncate(MOST_OFFERED - 1);
            found.push(remedy);
            found
        }
        None => elsewhere(case),
    }
}

/// The same cuts in another way, cuts that ask less of the arm, or the work in another place: one of each kind.
fn elsewhere(case: &mut Case<'_>) -> Vec<Change> {
    // Where the work is out of all reach, neither its cuts nor small steps matter.
    if let Some(nearer) = nearer::nearer(case) {
        return vec![nearer];
    }
    let way = process::other_direction(case).or_else(|| process::other_order(case));
    let swing = process::smaller_swing(case);
    let base = base::moved(case).or_else(|| base::turned(case));
    [way, swing, base].into_iter().flatten().collect()
}
