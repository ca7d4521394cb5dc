//! Hints after success: what would make a job faster that its machine made slow ([`vcutc_remedy::hints`]).

#[cfg(test)]
mod tests;

use crate::summary::time;
use crate::{Compiled, compile_checked};
use vcutc_cancellation::Wanted;
use vcutc_job::CheckedJob;
use vcutc_motion::summary::least_margin;
pub use vcutc_remedy::hints::Hint;
use vcutc_remedy::hints::{self, Made};

/// The hints for a job; none for one whose machine follows what it makes of itself.
#[must_use]
pub fn hints(job: &CheckedJob, compiled: &Compiled, wanted: &Wanted) -> Vec<Hint> {
    let Some(refused) = &compiled.not_followed else {
        return Vec::new();
    };
    let compile = |changed: &CheckedJob| {
        let (plan, compiled) = compile_checked(changed, wanted)?;
        let total = compiled.report.times.all.total();
        let margin = compiled.figures.as_ref().map(least_margin);
        let words = core::iter::once(time(total)).chain(margin);
        Some(Made {
            plan,
            time: total,
            words: words.collect::<Vec<_>>().join(", "),
        })
    };
    let now = (compiled.report.times.all.total(), compiled.report.cuts());
    hints::hints(job, refused, now, wanted, &compile)
}
