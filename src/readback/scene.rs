//! Two programs that are compared, and where they and their job say what.

use super::told::Told;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::readback::{Grain, Judge, Moment, Place};
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

/// The moment before every op of a program, and after the last one.
pub(super) fn moments(program: &Program) -> Vec<Moment> {
    let mut moments = Vec::with_capacity(program.ops.len() + 1);
    let mut segments = program.segments();
    moments.extend(segments.by_ref().map(|segment| Moment {
        op: segment.id,
        before: segment.before,
    }));
    moments.push(Moment {
        op: OpId(u32::try_from(program.ops.len()).unwrap_or(u32::MAX)),
        before: segments.state(),
    });
    moments
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
    let op = op.and_then(|op| program.op(op));
    let operation = op
        .and_then(|op| op.site.operation())
        .and_then(|operation| job.operations.get(usize::from(operation.0)));
    match operation {
        Some(operation) => operation.setup().head_span,
        None => job.name_span,
    }
}
