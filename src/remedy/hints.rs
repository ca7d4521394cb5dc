//! Hints after success: what would make a plan faster that its machine, not the process, made slow.
//!
//! Where a machine does not follow what a job makes of itself, the compiler falls back to other routes and narrower swings
//! ([`crate::fallback`]). It then knows the faster plan, and what the machine lacks for it. A lower speed, another place of
//! the base or another direction may give the machine what it lacks, and the time that this costs may be far less than
//! what it saves. Slower is not always faster: a lower `reorient` is a ceiling below which a few values are compared.
//!
//! What looks promising by the refused plan is compiled as a whole, so the time that a hint states is that of the job with
//! its edits.

use crate::budget::{Budget, Size};
use crate::change::{Change, DIRECTIONS, Speeds};
use crate::fallback::NotFollowed;
use crate::remedies::elsewhere_for;
use crate::speed::lower;
use crate::trial::looks_promising;
use vcutc_backend_api::units::Duration;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::{Edit, Fix};
use vcutc_job::setup::SpeedField as Field;
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::moves::pacing;
use vcutc_motion::path::Violation;

/// Most hints for one job.
pub const MOST_HINTS: usize = 3;
/// Least share of the time that a change saves which is worth a hint.
pub const WORTH_IT: f64 = 0.03;
/// The lowest speed that is looked at, as a share of what the job asks for.
const SLOWEST: f64 = 0.3;
/// How often the gap between a speed that is followed and one that is not is halved.
const HALVINGS: u32 = 9;
/// A speed below the highest one that is followed, as a share of it: the axes may not follow all motions at that one.
const BELOW: f64 = 0.92;

/// A change that was tried and makes the job better.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// What it does, such as `` `reorient = 65 deg/s` saves 31 % (26 min 58.2 s) ``, and what to write where; without edits where that
    /// is not written in a file.
    pub fix: Fix,
    /// How long the changed job takes.
    pub time: Duration,
    /// The share of the time that this saves, up to 1; below 0 where it takes longer.
    pub saved: f64,
}

/// A changed job that compiles.
pub struct Made {
    pub plan: PlannedJob,
    pub time: Duration,
    /// The time and the smallest margin in words.
    pub words: String,
}

/// Compiles a changed job; none where it has errors, or is not wanted any more.
pub type Compile<'c> = dyn Fn(&CheckedJob) -> Option<Made> + 'c;

/// What would make a job faster that its machine made slow: at most three changes, the one that saves most first. Those that were
/// found while they were wanted. `now` is how long the job takes as it is, and how many cuts it has.
#[must_use]
pub fn hints(
    job: &CheckedJob,
    refused: &NotFollowed,
    (now, cuts): (Duration, usize),
    wanted: &Wanted,
    compile: &Compile<'_>,
) -> Vec<Hint> {
    let mut search = Search {
        job,
        refused,
        now,
        cuts,
        budget: Budget::new(Size::HINTS, wanted),
        compile,
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

struct Search<'s> {
    job: &'s CheckedJob,
    refused: &'s NotFollowed,
    /// How long the job takes as it is.
    now: Duration,
    /// How many cuts the job has.
    cuts: usize,
    budget: Budget,
    compile: &'s Compile<'s>,
    /// The changes that were tried and compile.
    found: Vec<(Kind, Hint)>,
}

/// What a change is of. Of each kind one is offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Speed,
    Base,
    Direction,
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
    /// Lowers the speed that the refused plan failed by, as little as its motions allow. The plan that this leads to may
    /// be another one, and be followed at a higher speed: that one is tried next.
    fn slower(&mut self) -> Option<Followed> {
        let (field, asked) = self.pacing()?;
        let slowest = lower(asked * SLOWEST)?;
        let first = self.highest(&self.refused.plan, field, slowest, asked)?;
        let below = |most: f64| lower(most * BELOW);
        let (most, plan) = match self.try_speed(field, first) {
            Some(plan) => (first, plan),
            None => below(first).and_then(|most| Some((most, self.try_speed(field, most)?)))?,
        };
        let next = self
            .highest(&plan, field, most, asked)
            .filter(|next| *next > most);
        let reached = next.and_then(|next| match self.try_speed(field, next) {
            Some(_) => Some(next),
            None => below(next).filter(|least| *least > most && self.try_speed(field, *least).is_some()),
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
        let between = lower((most * asked).sqrt());
        if let Some(between) = between.filter(|between| *between > most && *between < asked) {
            self.try_speed(field, between);
        }
    }

    /// The base moved or turned by the least with which the machine follows the refused plan.
    fn elsewhere(&mut self) {
        let NotFollowed { plan, unreachable } = self.refused;
        if let Some(elsewhere) = elsewhere_for(self.job, plan, unreachable, &self.budget.wanted) {
            let change = Change::base(self.job, &elsewhere);
            self.try_out(Kind::Base, change, |written, saves| {
                format!("{}, which {saves}: `{written}`", elsewhere.how)
            });
        }
    }

    /// Other directions that look promising.
    fn otherwise(&mut self) {
        let all: Vec<usize> = (0..self.job.operations.len()).collect();
        for direction in DIRECTIONS {
            let change = Change::direction(self.job, &all, direction);
            let is_given = change.job.operations == self.job.operations;
            if !is_given && looks_promising(&with(&self.refused.plan, &change)) {
                self.try_out(Kind::Direction, change, of_a_field);
            }
        }
    }

    fn try_speed(&mut self, field: Field, most: f64) -> Option<PlannedJob> {
        self.try_out(Kind::Speed, self.at_most(field, most), of_a_field)
    }

    /// The job with a speed that is no higher than this.
    fn at_most(&self, field: Field, most: f64) -> Change {
        let operations = self.job.operations.iter().enumerate();
        let faster = operations.filter(|(_, asked)| field.value(asked.setup()) > most);
        let speeds: Speeds = faster.map(|(index, _)| ((index, field), most)).collect();
        Change::speeds(self.job, &speeds)
    }

    /// Compiles the changed job. The plan that it leads to; none where it has errors.
    fn try_out(
        &mut self,
        kind: Kind,
        change: Change,
        title: impl FnOnce(&str, &str) -> String,
    ) -> Option<PlannedJob> {
        if !self.budget.take(self.cuts) {
            return None;
        }
        let Made { plan, time, words } = (self.compile)(&change.job)?;
        let saved = 1.0 - time / self.now;
        let saves = format!("saves {:.0} % ({words})", saved * 100.0);
        let edit = |(span, replacement)| Edit { span, replacement };
        let fix = Fix {
            title: title(&change.written, &saves),
            edits: change.edits.into_iter().map(edit).collect(),
        };
        self.found.push((kind, Hint { fix, time, saved }));
        Some(plan)
    }

    /// The speed that paces the motion that the refused plan failed by, and what the job asks for; none where it failed by
    /// something else than a rate.
    fn pacing(&self) -> Option<(Field, f64)> {
        let unreachable = &self.refused.unreachable;
        let failing = unreachable.trouble.hardest()?;
        match failing.worst.what {
            Violation::Rate { .. } => {}
            Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
        }
        let field = pacing(unreachable.program.program(), failing.op)?;
        let setups = self.job.operations.iter().map(|operation| operation.setup());
        let asked = setups.map(|setup| field.value(setup)).reduce(f64::max)?;
        Some((field, asked))
    }

    /// The highest value of a speed, from one that is low up to the one asked for, at which a plan looks promising; none where
    /// it does not even at the low one.
    fn highest(&self, plan: &PlannedJob, field: Field, low: f64, asked: f64) -> Option<f64> {
        let follows = |most: f64| looks_promising(&with(plan, &self.at_most(field, most)));
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
        lower(follows_at)
    }

    /// The best of each kind, as far as it is worth a hint, what saves most first.
    fn worth_it(self) -> Vec<Hint> {
        let mut found = self.found;
        // Stable, so that of equally good ones the first stays first.
        found.sort_by(|(_, one), (_, other)| one.time.total_cmp(&other.time));
        let mut kinds = Vec::new();
        found.retain(|(kind, _)| {
            let is_new = !kinds.contains(kind);
            kinds.push(*kind);
            is_new
        });
        let hints = found.into_iter().map(|(_, hint)| hint);
        hints
            .filter(|hint| hint.saved >= WORTH_IT)
            .take(MOST_HINTS)
            .collect()
    }
}

fn of_a_field(written: &str, saves: &str) -> String {
    format!("`{written}` {saves}")
}

/// A plan whose operations are as fast, and cut in the direction, as with a change.
fn with(plan: &PlannedJob, change: &Change) -> PlannedJob {
    let mut plan = plan.clone();
    for (planned, asked) in plan.operations.iter_mut().zip(&change.job.operations) {
        let (setup, asked) = (planned.asked_mut().setup_mut(), asked.setup());
        for field in Field::ALL {
            field.set(setup, field.value(asked));
        }
        setup.direction = asked.direction;
    }
    plan
}
