//! Between a job and a target: options compared with what the target takes, and the target's objections in words.

mod options;
mod speeds;
mod words;

pub(super) use options::{options, unknown_targets};
pub(super) use speeds::with_help;
pub(super) use words::{by_maker, departed, failed, kind_words, without_machine};

use super::{Compiled, Request};
use options::block;
use vcutc_backend_api::backend::{Backend, BackendIssue, Origin};
use vcutc_backend_api::ir::{Action, OpId, Program};
use vcutc_backend_api::verify::{Capability, VerifiedProgram};
use vcutc_diagnostics::Diagnostic;
use vcutc_job::CheckedJob;
use words::objection;

/// What a target of the job's machine does not take.
pub(super) struct Objection {
    pub(super) diagnostic: Diagnostic,
    /// The speeds that decide it, and by which factor they are off.
    off: Option<speeds::Off>,
}

impl From<Diagnostic> for Objection {
    fn from(diagnostic: Diagnostic) -> Self {
        Self {
            diagnostic,
            off: None,
        }
    }
}

/// What the targets for which the job's machine has a block object to its program, so that it is known before anything is
/// written. A block may stand there before the machine's signals and home are known: what is missing of those is reported when the
/// program is written. Targets that are programs of their own are not run for it.
pub(super) fn objections(job: &CheckedJob, compiled: &Compiled, request: Request<'_>) -> Vec<Objection> {
    let Some(reached) = compiled.program.reached() else {
        return Vec::new();
    };
    let is_asked = |backend: &&&dyn Backend| {
        backend.origin() == Origin::Linked
            && block(job.machine.as_ref(), backend.id()).is_some()
            // A run for one target reports the objections of that target.
            && request.options.target.is_empty()
    };
    let program = reached.program.program();
    let mut all = Vec::new();
    for &backend in request.targets.iter().filter(is_asked) {
        let options = match options(job, backend) {
            Ok(options) => options,
            Err(diagnostics) => {
                all.extend(diagnostics.into_iter().map(Objection::from));
                continue;
            }
        };
        let mut issues = missing(backend, reached.program.verified());
        if issues.is_empty()
            && let Err(found) = backend.check(&reached.program, &options)
        {
            issues = found;
        }
        issues.retain(is_of_program);
        all.extend(issues.iter().map(|issue| Objection {
            diagnostic: objection(job, backend, program, issue, &[]),
            off: speeds::Off::of(job, program, issue),
        }));
    }
    all
}

/// Whether an objection is to the program, not to what the machine's block says of the machine.
const fn is_of_program(issue: &BackendIssue) -> bool {
    match issue {
        BackendIssue::OutOfRange { .. }
        | BackendIssue::Unsupported { .. }
        | BackendIssue::OptionConflict { .. }
        | BackendIssue::Profile { .. } => true,
        BackendIssue::WrongMachine { .. }
        | BackendIssue::MissingMachineField { .. }
        | BackendIssue::Failed(_) => false,
    }
}

/// What the program needs and the target does not have at all; of a machine that it does not drive, that
/// alone is reported.
pub(super) fn missing(backend: &dyn Backend, program: &VerifiedProgram) -> Vec<BackendIssue> {
    let cell = program.program().cell.as_ref();
    if cell.is_some_and(|cell| backend.mismatch(cell.kind, cell.maker).is_some()) {
        return Vec::new();
    }
    let missing = program.needs().missing_from(backend.capabilities());
    missing
        .map(|capability| BackendIssue::Unsupported {
            op: needing(program, capability),
            what: capability.words(),
        })
        .collect()
}

/// The first op that needs something, as far as it is reported: after a change of the blade, what comes next of an operation.
fn needing(program: &VerifiedProgram, capability: Capability) -> OpId {
    let mut ops = program.ops();
    let found = match capability {
        Capability::ToolChange => {
            let _ = ops.find(|(_, op)| matches!(op.action, Action::ToolChange { .. }));
            ops.find(|(_, op)| op.site.operation().is_some())
        }
        Capability::Chain => ops.find(|(_, op)| matches!(op.action, Action::Follow { .. })),
        Capability::Spindle => ops.find(|(_, op)| matches!(op.action, Action::Spin { .. })),
        Capability::LinearMove
        | Capability::JointMove
        | Capability::StillTipTurn
        | Capability::Output
        | Capability::AwaitInput
        | Capability::Dwell => ops.next(),
    };
    found.map_or(OpId(0), |(id, _)| id)
}

/// A target's objections in words.
pub(super) fn diagnose(
    job: &CheckedJob,
    backend: &dyn Backend,
    program: &Program,
    issues: &[BackendIssue],
    drivers: &[&str],
) -> Vec<Diagnostic> {
    issues
        .iter()
        .map(|issue| objection(job, backend, program, issue, drivers))
        .collect()
}

/// The targets of this build that drive the machine of a job, as far as they say by themselves.
pub(super) fn drivers(job: &CheckedJob, targets: &[&'static dyn Backend]) -> Vec<&'static str> {
    let Some(machine) = &job.machine else {
        return Vec::new();
    };
    let (kind, maker) = (machine.model.kind(), machine.model.maker);
    let drivers = targets
        .iter()
        .filter(|backend| backend.origin() == Origin::Linked && backend.mismatch(kind, maker).is_none());
    drivers.map(|backend| backend.id()).collect()
}
