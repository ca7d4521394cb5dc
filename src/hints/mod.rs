//! Hints after success: what would make a plan faster that its machine, not the process, made slow.
//!
//! Where a machine does not follow what a job makes of itself, the compiler helps itself with other routes and narrower swings
//! (`src/driver/yielding.rs`). It then knows the faster plan, and what the machine lacks for it. A lower speed, another place of
//! the base or another direction may give the machine what it lacks, and the time that this costs may be far less than
//! what it saves. Slower is not always faster: a lower `reorient` is a ceiling below which a few values are compared.
//!
//! What looks promising is found by a few telling motions of the plan that was refused; then the changed job is compiled as a
//! whole, so the time that a hint states is that of the job with its edits. How often that is done is bounded by the number
//! of cuts ([`tries`]), and ends when nobody wants the hints any more.

mod change;
#[cfg(test)]
mod tests;

use crate::diag::Fix;
use crate::driver::{self, Compiled, Yielded};
use crate::job::{CheckedJob, Direction, Machine, Operation};
use crate::lower;
use crate::plan::PlannedOperation;
use crate::reach::path::Violation;
use crate::reach::place::strokes::Strokes;
use crate::reach::rig::Rig;
use crate::reach::trouble::{Failing, Trouble};
use crate::remedy;
use crate::remedy::speed::{self, Field};
use crate::source::SourceMap;
use crate::summary::time;
use crate::wanted::Wanted;
use change::Change;
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::verify::verify;

/// Most hints for one job.
const MOST_HINTS: usize = 3;
/// Least share of the time that a change saves which is worth a hint.
const WORTH_IT: f64 = 0.03;
/// Most times that a changed job is compiled.
const MOST_TRIES: usize = 6;
/// Most cuts of all changed jobs together.
const MOST_CUTS_TRIED: usize = 6_000;
/// The lowest speed that is looked at, as a share of what the job asks for.
const SLOWEST: f64 = 0.3;
/// How often the way between a speed that is followed and one that is not is halved.
const HALVINGS: u32 = 9;
/// A speed below the highest one that is followed, as a share of it: the axes may not follow all motions at that one.
const BELOW: f64 = 0.92;

/// A change that was tried and saves time.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// What it does, such as `` `reorient = 65 deg/s` saves 31 % (26 min 58.2 s) ``, and what to write where; without edits where that
    /// is not written in a file.
    pub fix: Fix,
    /// How long the changed job takes.
    pub time: Duration,
    /// The share of the time that this saves, from 0 to 1.
    pub saved: f64,
}

/// What would make a job faster that its machine made slow: at most three changes, the one that saves most first. Those that were
/// found while they were wanted; none for a job whose machine follows what it makes of itself.
#[must_use]
pub fn hints(job: &CheckedJob, compiled: &Compiled, wanted: &Wanted) -> Vec<Hint> {
    let (Some(yielded), Some(machine)) = (&compiled.yielded, &job.machine) else {
        return Vec::new();
    };
    let search = Search {
        job,
        machine,
        yielded,
        now: compiled.report.times.all.total(),
        wanted,
    };
    let mut tries = tries(compiled.report.cuts());
    let mut found: Vec<(Change, Duration)> = Vec::new();
    let kinds = [
        Search::at_the_ceiling,
        Search::elsewhere,
        Search::around_the_ceiling,
        Search::otherwise,
    ];
    for kind in kinds {
        if tries == 0 || wanted.is_needless() {
            break;
        }
        for change in kind(&search) {
            if tries == 0 || wanted.is_needless() {
                break;
            }
            tries -= 1;
            found.extend(search.time_with(&change).map(|time| (change, time)));
        }
    }
    search.worth_it(found)
}

/// How often a job of so many cuts may be compiled.
fn tries(cuts: usize) -> usize {
    (MOST_CUTS_TRIED / cuts.max(1)).min(MOST_TRIES)
}

struct Search<'s> {
    job: &'s CheckedJob,
    machine: &'s Machine,
    yielded: &'s Yielded,
    /// How long the job takes as it is.
    now: Duration,
    wanted: &'s Wanted,
}

impl Search<'_> {
    /// The highest speed at which the telling motions of the refused plan are followed, if a speed is what it failed by.
    fn at_the_ceiling(&self) -> Vec<Change> {
        let ceiling = self.ceiling();
        ceiling
            .map(|(field, _, most)| Change::Speed { field, most })
            .into_iter()
            .collect()
    }

    /// Between that speed and the one that the job asks for something of the plan may be followed; below it, more of it.
    fn around_the_ceiling(&self) -> Vec<Change> {
        let Some((field, asked, most)) = self.ceiling() else {
            return Vec::new();
        };
        let between = (most * asked).sqrt();
        let values = [most * BELOW, between].map(speed::lower);
        values
            .into_iter()
            .flatten()
            .filter(|value| *value < asked && (*value - most).abs() > f64::EPSILON)
            .map(|most| Change::Speed { field, most })
            .collect()
    }

    /// The base moved or turned by the least with which the machine follows the refused plan.
    fn elsewhere(&self) -> Vec<Change> {
        let Yielded { plan, unreachable } = self.yielded;
        remedy::elsewhere_for(self.job, plan, unreachable, self.wanted)
            .map(Change::Base)
            .into_iter()
            .collect()
    }

    /// Other directions in which the telling motions of the refused plan are followed.
    fn otherwise(&self) -> Vec<Change> {
        let given = |direction: Direction| {
            let is_given = |Operation::RoughVcut(asked): &Operation| asked.direction.value == direction;
            self.job.operations.iter().all(is_given)
        };
        [Direction::Forward, Direction::Backward, Direction::Alternate]
            .into_iter()
            .filter(|direction| !given(*direction))
            .map(Change::Direction)
            .filter(|change| self.is_promising(change))
            .collect()
    }

    /// A speed, what the job asks for and the highest one that is followed.
    fn ceiling(&self) -> Option<(Field, f64, f64)> {
        let failing = failing(&self.yielded.unreachable.trouble)?;
        match failing.worst.what {
            Violation::Rate { .. } => {}
            Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
        }
        let field = speed::pacing(self.yielded.unreachable.program.program(), failing.op)?;
        let asked = |Operation::RoughVcut(asked): &Operation| field.value(asked);
        let asked = self.job.operations.iter().map(asked).reduce(f64::max)?;
        let follows = |most: f64| self.is_promising(&Change::Speed { field, most });
        let (mut follows_at, mut fails_at) = (speed::lower(asked * SLOWEST)?, asked);
        if !follows(follows_at) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(follows_at, fails_at);
            if follows(middle) {
                follows_at = middle;
            } else {
                fails_at = middle;
            }
        }
        Some((field, asked, speed::lower(follows_at)?))
    }

    /// Whether the machine follows the telling motions of the refused plan with a change.
    fn is_promising(&self, change: &Change) -> bool {
        let mut plan = self.yielded.plan.clone();
        for PlannedOperation::RoughVcut(vcut) in &mut plan.operations {
            change.apply_to(&mut vcut.asked);
        }
        let Ok(program) = verify(lower::lower(&plan, &SourceMap::default())) else {
            return false;
        };
        let (tool, base) = (self.machine.tool.value.frame, self.machine.base.value.frame);
        let rig = Rig::new(&self.machine.model, tool, base);
        Strokes::of(program.program()).are_each_followed(&rig)
    }

    /// How long the changed job takes, compiled as it would be; none where it has errors.
    fn time_with(&self, change: &Change) -> Option<Duration> {
        let changed = change.of(self.job);
        let (_, compiled) = driver::compile_checked(&changed, self.wanted)?;
        Some(compiled.report.times.all.total())
    }

    /// The best of each kind, as far as it is worth a hint, what saves most first.
    fn worth_it(&self, mut found: Vec<(Change, Duration)>) -> Vec<Hint> {
        // Stable, so that of equally good ones the first stays first.
        found.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        let mut kinds = Vec::new();
        found.retain(|(change, _)| {
            let kind = core::mem::discriminant(change);
            let is_new = !kinds.contains(&kind);
            kinds.push(kind);
            is_new
        });
        found
            .into_iter()
            .map(|(change, time)| (change, time, 1.0 - time / self.now))
            .filter(|(.., saved)| *saved >= WORTH_IT)
            .take(MOST_HINTS)
            .map(|(change, taken, saved)| Hint {
                fix: Fix {
                    title: self.advice(&change, taken, saved),
                    edits: change.edits(self.job),
                },
                time: taken,
                saved,
            })
            .collect()
    }

    fn advice(&self, change: &Change, taken: Duration, saved: f64) -> String {
        let saves = format!("saves {:.0} % ({})", saved * 100.0, time(taken));
        let written = change.written(self.job);
        match change {
            Change::Speed { .. } | Change::Direction(_) => format!("`{written}` {saves}"),
            Change::Base(elsewhere) => format!("{}, which {saves}: `{written}`", elsewhere.how),
        }
    }
}

/// Where the machine lacks most.
const fn failing(trouble: &Trouble) -> Option<&Failing> {
    match trouble {
        Trouble::Motion {
            hardest: Some(hardest),
            ..
        } => Some(hardest),
        Trouble::Motion { failing, .. } | Trouble::NoCommonBranch { failing, .. } => Some(failing),
        Trouble::Way { .. } | Trouble::Nowhere => None,
    }
}
