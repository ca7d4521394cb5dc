//! Changes that make an unreachable job reachable, each of them tried.
//!
//! Nothing is offered that has not been through the whole pipeline: planned again where the change concerns the cuts, proven,
//! and carried out by the machine from home to home. That is dear for a job of many cuts, so places for the base are sorted
//! out by the taught poses before, and all tries together are bounded ([`MOST_TRIES`]).
//!
//! | What breaks | What is tried |
//! | --- | --- |
//! | a rate | the highest speeds that the axes follow (`speed`) |
//! | reach, limits, singular poses, the branch | another direction or order of the cuts, a smaller swing (`process`), the base moved or turned by the least that helps (`base`) |
//! | a turn that sweeps the blade through the work | a larger extension or clearance, another direction (`process`) |
//! | the way from home or to home | a home above the first cut (`home`), else the base |
//!
//! A rate that would need speeds far below those asked for is taken for a place the arm had better avoid: what mends the
//! other kinds is tried then, too.

mod base;
mod extension;
mod home;
mod nearer;
mod process;
pub mod speed;
pub mod trial;
pub mod wording;

pub use base::Elsewhere;
pub use extension::farther_out;

use crate::path::Violation;
use crate::solve::Unreachable;
use crate::trouble::Trouble;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_job::{CheckedJob, Machine, PlannedJob};

/// A change that was tried and makes the job compile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remedy {
    /// What to do, in the imperative, with the value.
    pub advice: String,
    /// What to write where, when the value stands in a file.
    pub edits: Vec<(Span, String)>,
}

/// Most remedies that are offered.
const MOST_OFFERED: usize = 3;
/// Most times that a job is taken through the whole pipeline for one message.
const MOST_TRIES: u32 = 20;
/// Most cuts that are tried in all for one message, beyond two tries: a few seconds on one processor.
const MOST_CUTS_TRIED: usize = 4_000;
/// Most cuts of a job that is planned again. Beyond it only the machine's side is changed, which leaves the cuts as they are.
const MOST_CUTS_PLANNED_AGAIN: usize = 20_000;

/// What remedies are sought for.
struct Case<'c> {
    job: &'c CheckedJob,
    plan: &'c PlannedJob,
    machine: &'c Machine,
    unreachable: &'c Unreachable,
    tries_left: u32,
    /// Whether anybody still waits for them.
    wanted: &'c Wanted,
    /// Whether the job compiles with these changes of its text.
    works: &'c mut Works<'c>,
}

/// Whether the job compiles with these changes of its text.
pub type Works<'w> = dyn FnMut(&[(Span, String)]) -> bool + 'w;

impl Case<'_> {
    /// A remedy, if the text that comes of it compiles: as soon as it is found, so that none is lost when time is over.
    fn confirmed(&mut self, remedy: Remedy) -> Option<Remedy> {
        (remedy.edits.is_empty() || (self.works)(&remedy.edits)).then_some(remedy)
    }

    /// Takes a try from those that are left.
    fn may_try(&mut self) -> bool {
        let left = self.tries_left.checked_sub(1);
        match left.filter(|_| !self.wanted.is_needless()) {
            Some(left) => {
                self.tries_left = left;
                true
            }
            None => false,
        }
    }

    /// Whether planning the cuts again is affordable.
    fn may_plan_again(&self) -> bool {
        self.plan.cuts() <= MOST_CUTS_PLANNED_AGAIN
    }
}

/// How often a job may be tried: less often the larger it is, for a try takes as long as its cuts are many.
fn tries(plan: &PlannedJob) -> u32 {
    let affordable = MOST_CUTS_TRIED / plan.cuts().max(1);
    u32::try_from(affordable)
        .unwrap_or(MOST_TRIES)
        .clamp(2, MOST_TRIES)
}

/// Changes that let the machine carry the job out, at most [`MOST_OFFERED`]: those of the program first, then the base, the
/// nearest first. No more are looked for once nobody wants them.
#[must_use]
pub fn remedies(
    job: &CheckedJob,
    plan: &PlannedJob,
    unreachable: &Unreachable,
    wanted: &Wanted,
    works: &mut Works<'_>,
) -> Vec<Remedy> {
    let Some(machine) = &job.machine else {
        return Vec::new();
    };
    let mut case = Case {
        job,
        plan,
        machine,
        unreachable,
        tries_left: tries(plan),
        wanted,
        works: &mut |edits| works(edits),
    };
    let mut found = match &unreachable.trouble {
        Trouble::Motion { failing, .. } => match failing.worst.what {
            Violation::Rate { .. } => slower(&mut case),
            Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => elsewhere(&mut case),
        },
        Trouble::NoCommonBranch { .. } => elsewhere(&mut case),
        Trouble::Way { .. } => {
            let home = tried(&mut case, home::raised);
            let base = home.or_else(|| tried(&mut case, base::moved));
            base.into_iter().collect()
        }
        Trouble::Sweep(_) => {
            let room = tried(&mut case, process::more_room);
            let way = tried(&mut case, process::other_direction);
            room.into_iter().chain(way).collect()
        }
        Trouble::Nowhere => tried(&mut case, base::moved).into_iter().collect(),
    };
    found.truncate(MOST_OFFERED);
    found
}

/// The nearest place for the base, moved or turned, where the machine carries out this very plan.
#[must_use]
pub fn elsewhere_for(
    job: &CheckedJob,
    plan: &PlannedJob,
    unreachable: &Unreachable,
    wanted: &Wanted,
) -> Option<Elsewhere> {
    let mut case = Case {
        job,
        plan,
        machine: job.machine.as_ref()?,
        unreachable,
        tries_left: tries(plan),
        wanted,
        works: &mut |_| false,
    };
    base::moved_to(&mut case).or_else(|| base::turned_to(&mut case))
}

/// What is found and confirmed.
fn tried<'c>(case: &mut Case<'c>, find: impl FnOnce(&mut Case<'c>) -> Option<Remedy>) -> Option<Remedy> {
    let found = find(case)?;
    case.confirmed(found)
}

/// Lower speeds, and where they would be far lower, another posture before them.
fn slower(case: &mut Case<'_>) -> Vec<Remedy> {
    let confirmed = |case: &mut Case<'_>, lowered: Option<(Remedy, speed::Loss)>| {
        let (remedy, loss) = lowered?;
        Some((case.confirmed(remedy)?, loss))
    };
    // One speed is compiled soonest. Without a place in a file there is nothing to compile.
    let at_once = speed::of_a_linear_axis(case).filter(|(remedy, _)| !remedy.edits.is_empty());
    let lowered = confirmed(case, at_once).or_else(|| {
        let lowered = speed::lowered(case);
        confirmed(case, lowered)
    });
    match lowered {
        Some((remedy, speed::Loss::Bearable)) => {
            let base = tried(case, base::moved);
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
fn elsewhere(case: &mut Case<'_>) -> Vec<Remedy> {
    // Where the work is out of all reach, neither its cuts nor small steps matter.
    if let Some(nearer) = tried(case, nearer::nearer) {
        return vec![nearer];
    }
    let way = tried(case, process::other_direction).or_else(|| tried(case, process::other_order));
    let swing = tried(case, process::smaller_swing);
    let base = tried(case, base::moved).or_else(|| tried(case, base::turned));
    [way, swing, base].into_iter().flatten().collect()
}

impl Remedy {
    /// Advice without a place in a file to change.
    fn advice(advice: String) -> Self {
        Self {
            advice,
            edits: Vec::new(),
        }
    }

    /// Replaces the text of a field where it is written, says what to write where it is not.
    fn replace(advice: String, span: Option<Span>, text: String) -> Self {
        Self {
            advice,
            edits: span.map(|span| (span, text)).into_iter().collect(),
        }
    }
}

pub const LOOK_ON: &str = "run `vcutc place` on this job: it searches around the base, or as far as `--x`, `--y`, `--z` and `--yaw` say, for a place that works";

/// Adds remedies to a diagnostic; says where to look on when there are none.
#[must_use]
pub fn offer(diagnostic: Diagnostic, remedies: &[Remedy], general: &str) -> Diagnostic {
    if remedies.is_empty() {
        return diagnostic
            .help(general)
            .note(
                "changing any one of speed, direction, order, swing, home or base did not help, as far as was tried",
            )
            .help(LOOK_ON);
    }
    remedies.iter().fold(diagnostic, |diagnostic, remedy| {
        if remedy.edits.is_empty() {
            diagnostic.help(remedy.advice.clone())
        } else {
            diagnostic.fix_all(remedy.advice.clone(), &remedy.edits)
        }
    })
}
