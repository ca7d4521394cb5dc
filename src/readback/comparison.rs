//! Two programs that are compared, and where they and their job say what.

use super::listing::Listing;
use vcutc_backend_api::ir::{OpId, Program};
use vcutc_backend_api::readback::{Comparator, Moment, Place, Resolution};
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_job::CheckedJob;

/// Two programs, and the job that one of them was made from.
pub(super) struct Comparison<'s> {
    pub(super) job: &'s CheckedJob,
    pub(super) comparator: Comparator<'s>,
    pub(super) resolution: Resolution,
    pub(super) fresh: &'s Listing<'s>,
    /// For every fresh statement the op that it says.
    pub(super) owners: &'s [Option<OpId>],
    pub(super) given: &'s Listing<'s>,
    /// The files of the given program among the sources.
    pub(super) sources: &'s [FileId],
}

impl<'s> Comparison<'s> {
    /// The fresh program.
    pub(super) fn program(&self) -> &'s Program {
        self.comparator.reachable().program()
    }

    /// The op that a fresh statement says.
    pub(super) fn owner(&self, fresh: usize) -> Option<OpId> {
        self.owners.get(fresh).copied().flatten()
    }

    /// The moment before every op of the fresh program, and after the last one.
    pub(super) fn moments(&self) -> Vec<Moment> {
        let program = self.program();
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

    /// Where a statement of the given program stands; after the last one where there is none of that number.
    pub(super) fn span(&self, given: usize) -> Span {
        let span = |place: Place| {
            let file = *self.sources.get(place.file as usize)?;
            Some(Span {
                file,
                start: place.start,
                end: place.end,
            })
        };
        let statements = &self.given.statements;
        let found = match (statements.get(given), statements.last()) {
            (Some(statement), _) => span(statement.place),
            (None, Some(last)) => span(last.place).map(Span::after),
            (None, None) => self.sources.first().map(|&file| Span::of_bytes(file, 0..0)),
        };
        found.unwrap_or(self.job.name_span)
    }

    /// Where in the job an op of a program is asked for: its operation, or the job as a whole.
    pub(super) fn asked(&self, program: &Program, op: Option<OpId>) -> Span {
        let operation = op
            .and_then(|op| program.op(op)?.site.operation())
            .and_then(|operation| self.job.operations.get(usize::from(operation.0)));
        operation.map_or(self.job.name_span, |operation| operation.setup().head_span)
    }
}
