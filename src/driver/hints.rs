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

use crate::summary::time;
use crate::{self as driver, Compiled, Yielded};
use change::Change;
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::verify::verify;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::Fix;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::PlannedJob;
use vcutc_job::setup::SpeedField as Field;
use vcutc_job::{CheckedJob, Direction, Machine};
use vcutc_motion::path::Violation;
use vcutc_motion::place::motions::TellingMotions;
use vcutc_motion::remedy;
use vcutc_motion::remedy::speed;
use vcutc_motion::rig::Rig;
use vcutc_motion::summary as reach_summary;
use vcutc_motion::trouble::{Failing, Trouble};
use vcutc_process::lower;

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
    let mut search = Search {
        job,
        machine,
        yielded,
        now: compiled.report.times.all.total(),
        wanted,
        tries: tries(compiled.report.cuts()),
        found: Vec::new(),
    };
    let followed = search.slower();
    search.elsewhere();
    if let Some(followed) = followed {
        search.less_slow(&followed);
    }
    search.otherwise();
    search.worth_it()
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
    /// How often a changed job may still be compiled.
    tries: usize,
    /// The changes that were tried and compile.
    found: Vec<Tried>,
}

/// A change that compiles.
struct Tried {
    change: Change,
    time: Duration,
    /// What has the smallest margin then: `margin A5 6.5 %`.
    margin: Option<String>,
}

/// A speed, and how much of it the machine follows.
struct Followed {
    field: Field,
    /// What the job asks for.
    asked: f64,
    /// The highest value that was tried and compiles.
    most: f64,
}

impl Search<'_> {
    /// Lowers the speed that the refused plan failed by, as little as its telling motions allow. The plan that this leads to may
    /// be another one, and be followed at a higher speed: that one is tried next.
    fn slower(&mut self) -> Option<Followed> {
        let (field, asked) = self.pacing()?;
        let slowest = speed::lower(asked * SLOWEST)?;
        let first = self.highest(&self.yielded.plan, field, slowest, asked)?;
        let lower = |most: f64| speed::lower(most * BELOW);
        let change = |most| Change::Speed { field, most };
        let (most, plan) = match self.try_out(change(first)) {
            Some(plan) => (first, plan),
            None => lower(first).and_then(|most| Some((most, self.try_out(change(most))?)))?,
        };
        let next = self
            .highest(&plan, field, most, asked)
            .filter(|next| *next > most);
        let reached = next.and_then(|next| match self.try_out(change(next)) {
            Some(_) => Some(next),
            None => lower(next).filter(|least| *least > most && self.try_out(change(*least)).is_some()),
        });
        Some(Followed {
            field,
            asked,
            most: reached.unwrap_or(most),
        })
    }

    /// Between the highest speed that was tried and the one that the job asks for, part of a wider plan may be followed.
    fn less_slow(&mut self, followed: &Followed) {
        let Followed { field, asked, most } = *followed;
        let between = speed::lower((most * asked).sqrt());
        if let Some(between) = between.filter(|between| *between > most && *between < asked) {
            self.try_out(Change::Speed { field, most: between });
        }
    }

    /// The base moved or turned by the least with which the machine follows the refused plan.
    fn elsewhere(&mut self) {
        let Yielded { plan, unreachable } = self.yielded;
        if let Some(elsewhere) = remedy::elsewhere_for(self.job, plan, unreachable, self.wanted) {
            self.try_out(Change::Base(elsewhere));
        }
    }

    /// Other directions in which the telling motions of the refused plan are followed.
    fn otherwise(&mut self) {
        for direction in [Direction::Forward, Direction::Backward, Direction::Alternate] {
            let change = Change::Direction(direction);
            let mut setups = self.job.operations.iter().map(|operation| operation.setup());
            let is_given = setups.all(|setup| setup.direction.value == direction);
            if !is_given && self.is_promising(&self.yielded.plan, &change) {
                self.try_out(change);
            }
        }
    }

    /// Compiles the changed job as it would be. The plan that it leads to; none where it has errors.
    fn try_out(&mut self, change: Change) -> Option<PlannedJob> {
        if self.tries == 0 || self.wanted.is_needless() {
            return None;
        }
        self.tries -= 1;
        let (plan, compiled) = driver::compile_checked(&change.of(self.job), self.wanted)?;
        self.found.push(Tried {
            change,
            time: compiled.report.times.all.total(),
            margin: compiled.figures.as_ref().map(reach_summary::least_margin),
        });
        Some(plan)
    }

    /// The speed that paces the motion that the refused plan failed by, and what the job asks for; none where it failed by
    /// something else than a rate.
    fn pacing(&self) -> Option<(Field, f64)> {
        let failing = failing(&self.yielded.unreachable.trouble)?;
        match failing.worst.what {
            Violation::Rate { .. } => {}
            Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
        }
        let field = speed::pacing(self.yielded.unreachable.program.program(), failing.op)?;
        let setups = self.job.operations.iter().map(|operation| operation.setup());
        let asked = setups.map(|setup| field.value(setup)).reduce(f64::max)?;
        Some((field, asked))
    }

    /// The highest value of a speed, from one that is low up to the one asked for, at which the telling motions of a plan are
    /// followed; none where they are not followed even at the low one.
    fn highest(&self, plan: &PlannedJob, field: Field, low: f64, asked: f64) -> Option<f64> {
        let follows = |most: f64| self.is_promising(plan, &Change::Speed { field, most });
        let (mut follows_at, mut fails_at) = (low, asked);
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
        speed::lower(follows_at)
    }

    /// Whether the machine follows the telling motions of a plan with a change.
    fn is_promising(&self, plan: &PlannedJob, change: &Change) -> bool {
        let mut plan = plan.clone();
        let operations = plan.operations.iter_mut().zip(&self.job.operations);
        for (planned, asked) in operations {
            let setup = planned.asked_mut().setup_mut();
            // The plan may be that of a job with lower speeds.
            for field in Field::ALL {
                field.set(setup, field.value(asked.setup()));
            }
            change.apply_to(setup);
        }
        let Ok(program) = verify(lower::lower(&plan, &SourceMap::default())) else {
            return false;
        };
        let (tool, base) = (self.machine.tool.value.frame, self.machine.base.value.frame);
        let rig = Rig::new(&self.machine.model, tool, base);
        TellingMotions::of(program.program()).are_each_followed(&rig)
    }

    /// The best of each kind, as far as it is worth a hint, what saves most first.
    fn worth_it(mut self) -> Vec<Hint> {
        let mut found = core::mem::take(&mut self.found);
        // Stable, so that of equally good ones the first stays first.
        found.sort_by(|one, other| one.time.total_cmp(&other.time));
        let mut kinds = Vec::new();
        found.retain(|tried| {
            let kind = core::mem::discriminant(&tried.change);
            let is_new = !kinds.contains(&kind);
            kinds.push(kind);
            is_new
        });
        found
            .into_iter()
            .map(|tried| (1.0 - tried.time / self.now, tried))
            .filter(|(saved, _)| *saved >= WORTH_IT)
            .take(MOST_HINTS)
            .map(|(saved, tried)| Hint {
                fix: Fix {
                    title: self.advice(&tried, saved),
                    edits: tried.change.edits(self.job),
                },
                time: tried.time,
                saved,
            })
            .collect()
    }

    fn advice(&self, tried: &Tried, saved: f64) -> String {
        let change = &tried.change;
        let margin = tried
            .margin
            .as_ref()
            .map_or_else(String::new, |margin| format!(", {margin}"));
        let saves = format!("saves {:.0} % ({}{margin})", saved * 100.0, time(tried.time));
        let written = change.written();
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
        Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => None,
    }
}
