//! Changes of a job that a hint may speak of: what they do to the checked job, and what to write where.

use vcutc_diagnostics::Edit;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::setup::SpeedField as Field;
use vcutc_job::{CheckedJob, Direction, Setup};
use vcutc_motion::remedy::{Elsewhere, wording};

/// A change of a job.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Change {
    /// A speed is no higher than this, in mm/s or deg/s.
    Speed { field: Field, most: f64 },
    /// The work is cut in another direction.
    Direction(Direction),
    /// The base is somewhere else.
    Base(Elsewhere),
}

impl Change {
    /// Changes an operation, as far as the change is one of operations.
    pub(super) fn apply_to(&self, setup: &mut Setup) {
        match self {
            Self::Speed { field, most } if field.value(setup) > *most => field.set(setup, *most),
            Self::Direction(direction) => setup.direction.value = *direction,
            Self::Speed { .. } | Self::Base(_) => {}
        }
    }

    /// The job with this change.
    pub(super) fn of(&self, job: &CheckedJob) -> CheckedJob {
        let mut changed = job.clone();
        for operation in &mut changed.operations {
            self.apply_to(operation.setup_mut());
        }
        if let (Self::Base(elsewhere), Some(machine)) = (self, &mut changed.machine) {
            machine.base.value = elsewhere.base;
        }
        changed
    }

    /// What to write: `reorient = 65 deg/s`.
    pub(super) fn written(&self) -> String {
        match self {
            Self::Speed { field, most } => format!("{} = {} {}", field.name(), show(*most), field.unit()),
            Self::Direction(direction) => format!("direction = {}", direction.word()),
            Self::Base(elsewhere) => format!("base = {}", wording::frame_text(&elsewhere.base)),
        }
    }

    /// The same as edits; empty where something of it is not written anywhere.
    pub(super) fn edits(&self, job: &CheckedJob) -> Vec<Edit> {
        let setups = job.operations.iter().map(|operation| operation.setup());
        let edits: Option<Vec<(Span, String)>> = match self {
            Self::Speed { field, most } => setups
                .filter(|setup| field.value(setup) > *most)
                .map(|setup| Some((field.span(setup)?, format!("{} {}", show(*most), field.unit()))))
                .collect(),
            Self::Direction(direction) => {
                let stated = setups
                    .map(|setup| setup.stated("direction", setup.direction.span, direction.word()))
                    .map(|edits| (!edits.is_empty()).then_some(edits));
                stated.collect::<Option<Vec<_>>>().map(|edits| edits.concat())
            }
            Self::Base(elsewhere) => job.machine.as_ref().and_then(|machine| {
                let text = wording::frame_text(&elsewhere.base);
                Some(vec![(machine.base.span?, text)])
            }),
        };
        let mut edits = edits.unwrap_or_default();
        // Two operations may take a value from one place.
        edits.sort_by_key(|(span, _)| *span);
        edits.dedup();
        let edit = |(span, replacement)| Edit { span, replacement };
        edits.into_iter().map(edit).collect()
    }
}
