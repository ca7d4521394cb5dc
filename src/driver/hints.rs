//! Hints after success: what would make a job faster that its machine made slow ([`vcutc_remedy::hints`]), and leave less on a part that
//! changes along y.

#[cfg(test)]
mod tests;

use crate::families::{self, Chosen, FamilyCame};
use crate::memory::Memory;
use crate::summary::time;
use crate::{Compiled, compile_checked};
use crate::{Run, Unhurried};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Edit, Fix};
use vcutc_job::CheckedJob;
use vcutc_motion::summary::least_margin;
pub use vcutc_remedy::hints::Hint;
use vcutc_remedy::hints::{self, Made};

/// What cuts that rise and fall with the part leave instead of level ones, planned as `follow = auto` does; none where level cuts leave
/// little more than these might, or `auto` takes no others.
#[must_use]
pub fn following(job: &CheckedJob, compiled: &Compiled, wanted: &Wanted) -> Option<Hint> {
    let left = compiled.left_over?;
    left.level?;
    let (changed, edits) = job.following_best()?;
    let mut run = Run {
        memory: &mut Memory::none(),
        wanted,
        patience: &mut Unhurried,
    };
    let Chosen { decided, families } =
        families::decided(&changed, &SourceMap::default(), &mut run, &mut |_| ())?;
    let taken = families.first().filter(|_| decided.job.part.guide().is_some())?;
    let FamilyCame::Compiled(figures) = &taken.came else {
        return None;
    };
    let now = compiled.report.times.all.total();
    let title = format!(
        "let the cuts follow the part: `follow = auto` takes `{}`, which leaves at most {:.2} mm instead of {:.2} mm on the part, in {} \
         instead of {}",
        taken.family.word(),
        figures.highest.to_mm(),
        left.all.highest.height.to_mm(),
        time(figures.time),
        time(now)
    );
    let edits = edits
        .into_iter()
        .map(|(span, replacement)| Edit { span, replacement });
    Some(Hint {
        fix: Fix {
            title,
            edits: edits.collect(),
        },
        time: figures.time,
        saved: 1.0 - figures.time / now,
    })
}

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
