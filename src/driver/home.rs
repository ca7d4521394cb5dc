//! A home outside of the position limits of its axes: of the homes within that are offered, those with which the job compiles.
//!
//! The nearest home within the limits may be one from which no clear way leads to the work. That is known only after the job was
//! planned and carried out with it, as every other offer is ([`Trials`]).

use super::trials::{Machine, Trials};
use super::{Outcome, Request, Run, Stage};
use vcutc_diagnostics::{Code, Diagnostic, Fix, Severity};

/// Leaves the homes that work, where the home is all that is wrong with a job.
pub(super) fn try_offers(
    outcome: &mut Outcome,
    request: Request<'_>,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) {
    let mut errors = outcome
        .diagnostics
        .iter()
        .filter(|one| one.severity() == Severity::Error);
    if !errors.all(|one| one.code == Code::HomeOutsideLimits) {
        return;
    }
    let limited = run
        .patience
        .refused(&at_once(&outcome.diagnostics), &outcome.sources);
    let wanted = run.wanted.and(&limited);
    progress(Stage::Helping);
    let before = outcome.diagnostics.clone();
    let mut trials = Trials::of(request, &outcome.sources, &before, Machine::Here, &wanted);
    for diagnostic in &mut outcome.diagnostics {
        if diagnostic.code != Code::HomeOutsideLimits {
            continue;
        }
        let offered = core::mem::take(&mut diagnostic.fixes);
        for fix in offered {
            let edits = fix.edits.iter().map(|edit| (edit.span, edit.replacement.clone()));
            if trials.works(&edits.collect::<Vec<_>>()) {
                diagnostic.fixes.push(fix);
            } else if wanted.is_needless() {
                diagnostic.help.push(untried(&fix));
            } else {
                diagnostic.notes.push(format!(
                    "{}, but with it the job does not compile either",
                    fix.title
                ));
            }
        }
        if diagnostic.fixes.is_empty() && diagnostic.help.is_empty() {
            let advice = "choose a home above the work, from which the blade comes to it through the air";
            diagnostic.help.push(advice.to_owned());
        }
    }
    if wanted.is_needless()
        && let Some(words) = run.patience.cut_short()
        && let Some(first) = outcome
            .diagnostics
            .iter_mut()
            .find(|one| one.code == Code::HomeOutsideLimits)
    {
        first.notes.push(words);
    }
}

fn untried(fix: &Fix) -> String {
    format!("{}; it was not tried", fix.title)
}

/// What to report before anything is tried.
fn at_once(diagnostics: &[Diagnostic]) -> Vec<Diagnostic> {
    let without_fixes = |one: &Diagnostic| {
        let mut one = one.clone();
        if one.code == Code::HomeOutsideLimits {
            let untried: Vec<String> = one.fixes.iter().map(untried).collect();
            one.help.extend(untried);
            one.fixes.clear();
        }
        one
    };
    diagnostics.iter().map(without_fixes).collect()
}
