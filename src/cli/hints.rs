//! Hints after success: looked for once the program is written, for as long as `--help-budget` says or as the job took to
//! compile. The time decides which hints there are, not what they say.

use super::console::Console;
use super::patience::{HelpBudget, Timer};
use super::snapshot::Made;
use crate::driver::Outcome;
use crate::hints::{Hint, hints};
use crate::wanted::Wanted;
use std::time::Duration;

/// Tells what would make a job faster that its machine made slow.
pub(super) fn tell(outcome: &Outcome, made: &Made, timings: &[(&'static str, Duration)], console: &Console) {
    // Who compares wants to know what differs.
    if !console.tells_more() || made.differences.is_some() || !made.diagnostics.is_empty() {
        return;
    }
    let compiling: Duration = timings.iter().map(|(_, time)| *time).sum();
    for hint in found_within(outcome, console.help_budget(), compiling) {
        console.hint(&hint, &outcome.sources);
    }
}

/// The hints of a page, which is the same for the same job: they are found by a bounded amount of work, however long it takes;
/// none where no time is given at all.
pub(super) fn of_a_page(outcome: &Outcome, budget: HelpBudget) -> Vec<Hint> {
    let work = match budget {
        HelpBudget::Of(Duration::ZERO) => budget,
        HelpBudget::Of(_) | HelpBudget::Unlimited => HelpBudget::Unlimited,
    };
    found_within(outcome, work, Duration::ZERO)
}

/// The hints that are found in that time, or in the time that the job took; none where no time is given at all.
fn found_within(outcome: &Outcome, budget: HelpBudget, compiling: Duration) -> Vec<Hint> {
    let (Some(job), Some(compiled)) = (&outcome.job, &outcome.compiled) else {
        return Vec::new();
    };
    match budget {
        HelpBudget::Unlimited => hints(job, compiled, &Wanted::ALWAYS),
        HelpBudget::Of(Duration::ZERO) => Vec::new(),
        HelpBudget::Of(limit) => {
            let (wanted, interest) = Wanted::while_held();
            let _timer = Timer::start(limit.max(compiling), interest);
            hints(job, compiled, &wanted)
        }
    }
}
