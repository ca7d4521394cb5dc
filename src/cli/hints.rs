//! Hints after success: looked for once the program is written, for as long as `--help-budget` says or as the job took to
//! compile. The time decides which hints there are, not what they say.

use super::console::Console;
use super::patience::{HelpBudget, Timer};
use super::snapshot::Made;
use std::time::Duration;
use vcutc_cancellation::Wanted;
use vcutc_driver::hints::{Hint, following, hints};
use vcutc_driver::{Compiled, Outcome};
use vcutc_job::CheckedJob;

/// Reports what would make a job faster that its machine made slow, and what would leave less on its part.
pub(super) fn report(
    outcome: &Outcome,
    made: &Made,
    timings: &[(&'static str, Duration)],
    console: &Console,
) {
    // A comparison reports what differs.
    if !console.shows_more() || made.differences.is_some() || !made.diagnostics.is_empty() {
        return;
    }
    let compiling: Duration = timings.iter().map(|(_, time)| *time).sum();
    let search = |job: &CheckedJob, compiled: &Compiled, wanted: &Wanted| {
        let mut found = hints(job, compiled, wanted);
        found.extend(following(job, compiled, wanted));
        found
    };
    let found = found_within(outcome, console.help_budget(), compiling, search);
    for hint in found.hints {
        console.hint(&hint, &outcome.sources);
    }
    if let Some(limit) = found.ended_after {
        console.remark(&format!(
            "the search for changes that make this job better ended after {:.1} s; `--help-budget {:.0}s` searches longer",
            limit.as_secs_f64(),
            (limit.as_secs_f64() * 10.0).ceil()
        ));
    }
}

/// What was found in some time.
#[derive(Default)]
struct Found {
    hints: Vec<Hint>,
    /// The time, where it was over before the search was.
    ended_after: Option<Duration>,
}

/// The hints of a page, which is the same for the same job: they are found by a bounded amount of work, however long it takes;
/// none where no time is given at all.
pub(super) fn of_a_page(outcome: &Outcome, budget: HelpBudget) -> Vec<Hint> {
    let work = match budget {
        HelpBudget::Of(Duration::ZERO) => budget,
        HelpBudget::Of(_) | HelpBudget::Unlimited => HelpBudget::Unlimited,
    };
    found_within(outcome, work, Duration::ZERO, hints).hints
}

/// The hints that are found in that time, or in the time that the job took; none where no time is given at all.
fn found_within(
    outcome: &Outcome,
    budget: HelpBudget,
    compiling: Duration,
    search: impl Fn(&CheckedJob, &Compiled, &Wanted) -> Vec<Hint>,
) -> Found {
    let (Some(job), Some(compiled)) = (&outcome.job, &outcome.compiled) else {
        return Found::default();
    };
    match budget {
        HelpBudget::Unlimited => Found {
            hints: search(job, compiled, &Wanted::ALWAYS),
            ended_after: None,
        },
        HelpBudget::Of(Duration::ZERO) => Found::default(),
        HelpBudget::Of(limit) => {
            let limit = limit.max(compiling);
            let (wanted, interest) = Wanted::while_held();
            let _timer = Timer::start(limit, interest);
            Found {
                hints: search(job, compiled, &wanted),
                ended_after: wanted.is_needless().then_some(limit),
            }
        }
    }
}
