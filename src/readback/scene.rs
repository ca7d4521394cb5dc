//! Two programs that are compared, and where they and their job say what.

use super::told::Told;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::motion::pose_after;
use vcutc_backend_api::readback::{Grain, Judge, Place};
use vcutc_backend_api::stroke::Pose;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_job::CheckedJob;

/// Two programs, and the job that one of them was made from.
pub(super) struct Scene<'s> {
    pub(super) job: &'s CheckedJob,
    pub(super) judge: Judge<'s>,
    pub(super) grain: Grain,
    pub(super) fresh: &'s Told<'s>,
    /// For every fresh statement the op that it says.
    pub(super) owners: &'s [Option<OpId>],
    pub(super) given: &'s Told<'s>,
    /// The files of the given program among the sources.
    pub(super) sources: &'s [FileId],
}

/// The pose in front of every op.
pub(super) fn poses_before(program: &Program) -> Vec<Option<Pose>> {
    let mut at = None;
    let before = program.ops.iter().map(|op| {
        let before = at;
        at = pose_after(at, &op.action);
        before
    });
    before.collect()
}

/// Where a statement of a given program stands; behind the last one where there is none of that number.
pub(super) fn place_in(given: &Told<'_>, sources: &[FileId], index: usize) -> Option<Span> {
    let span = |place: Place| {
        let file = *sources.get(place.file as usize)?;
        Some(Span {
            file,
            start: place.start,
            end: place.end,
        })
    };
    match given.statements.get(index) {
        Some(statement) => span(statement.place),
        None => match given.statements.last() {
            Some(statement) => span(statement.place).map(Span::after),
            None => sources.first().map(|&file| Span::of_bytes(file, 0..0)),
        },
    }
}

/// Where in the job an op is asked for: its operation, or the job as a whole.
pub(super) fn asked(job: &CheckedJob, program: &Program, op: Option<OpId>) -> Span {
    let op = op.and_then(|op| program.ops.get(op.0 as usize));
    let operation = op
        .and_then(|op| op.site.operation())
        .and_then(|operation| job.operations.get(usize::from(operation.0)));
    match operation {
        Some(operation) => operation.setup().head_span,
        None => job.name_span,
    }
}
