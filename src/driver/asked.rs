//! What is asked for before anything is planned: the job as it is understood, and its machine in words.

use super::{Request, target};
use std::collections::BTreeSet;
use vcutc_backend_api::backend::{Backend, BackendIssue};
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::CheckedJob;
use vcutc_job::sema;
use vcutc_machine::Model;

/// The job alone, understood and not planned; none where it has errors or cannot be read.
#[must_use]
pub fn understood(request: Request<'_>) -> Option<CheckedJob> {
    let (mut sources, mut found) = (SourceMap::default(), Vec::new());
    let choices = request.choices();
    let checked = sema::check(request.path, request.loader, choices, &mut sources, &mut found);
    checked.ok().and_then(|(_, job)| job)
}

/// The options that do not go together with the program of a job for a target, each once; none where there is no such program for
/// other reasons, too. Options that are typed for that target are set.
#[must_use]
pub fn misfits(request: Request<'_>, backend: &dyn Backend) -> Option<Vec<&'static str>> {
    let outcome = super::compile_unhelped(request).ok()?;
    let (job, compiled) = (outcome.job.as_ref()?, outcome.compiled.as_ref()?);
    let reached = compiled.program.reached()?;
    let options = target::options(job, backend).ok()?;
    let issues = match backend.check(&reached.program, &options) {
        Ok(_) => Vec::new(),
        Err(issues) => issues,
    };
    let key = |issue: &BackendIssue| match issue {
        BackendIssue::OptionConflict { key, .. } => Some(*key),
        _ => None,
    };
    let keys: Option<BTreeSet<&str>> = issues.iter().map(key).collect();
    keys.map(|keys| keys.into_iter().collect())
}

/// A machine as messages say it: `kuka/kr210_r3100_ultra, a robot by KUKA`.
#[must_use]
pub fn machine_words(model: &Model) -> String {
    match model.kind() {
        MachineKind::FiveAxis => format!("{}, {}", model.name, target::kind_words(Some(model))),
        MachineKind::Robot => format!("{}, {}", model.name, target::by_maker(Some(model))),
    }
}
