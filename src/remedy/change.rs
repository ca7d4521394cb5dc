//! A change of a job, as it is tried and as it is offered.

use crate::wording;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{AxisValues, PlacedFrame};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::operation::Variant;
use vcutc_job::setup::SpeedField as Field;
use vcutc_job::{CheckedJob, Direction, Machine, Setup, Sourced};

/// A change of a job: in words, as edits of its text, and as the resulting job.
#[derive(Clone, Debug)]
pub struct Change {
    /// What to do, in the imperative, with the value.
    pub advice: String,
    /// What to write, such as `reorient = 65 deg/s`.
    pub written: String,
    /// What to write where. Empty if one of the values is not written in a file.
    pub edits: Edits,
    /// The job then.
    pub job: CheckedJob,
}

/// What is replaced in a text, and by what.
pub type Edits = Vec<(Span, String)>;

/// Directions in the order in which they are tried.
pub(crate) const DIRECTIONS: [Direction; 3] = [Direction::Forward, Direction::Backward, Direction::Alternate];

/// Speeds by operation and field, in mm/s and deg/s.
pub(crate) type Speeds = BTreeMap<(usize, Field), f64>;

/// Another place for the base.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Elsewhere {
    /// How it gets there, in the imperative.
    pub(crate) how: String,
    /// The place, as it is written.
    pub(crate) base: PlacedFrame,
}

impl Change {
    /// Operations at these speeds.
    pub(crate) fn speeds(job: &CheckedJob, speeds: &Speeds) -> Self {
        let mut changed = job.clone();
        let (mut words, mut edits) = (Vec::new(), Vec::new());
        for (&(operation, field), &speed) in speeds {
            let Some(setup) = setup(&mut changed, operation) else {
                continue;
            };
            let text = format!("{} {}", show(speed), field.unit());
            let word = format!("{} = {text}", field.name());
            // Two operations may ask for the same.
            if !words.contains(&word) {
                words.push(word);
            }
            edits.push(field.span(setup).map(|span| (span, text)));
            field.set(setup, speed);
        }
        let written = words.join("` with `");
        Self {
            advice: format!("use `{written}`, which the axes follow"),
            written,
            edits: all(edits),
            job: changed,
        }
    }

    /// Some operations cut in another direction.
    pub(crate) fn direction(job: &CheckedJob, operations: &[usize], direction: Direction) -> Self {
        let mut changed = job.clone();
        let mut edits = Vec::new();
        for &operation in operations {
            let Some(setup) = setup(&mut changed, operation) else {
                continue;
            };
            // Some operations have no direction to choose.
            if let Some(asked) = setup.direction {
                let stated = setup.stated("direction", asked.span, direction.word());
                edits.push(stated.into_iter().next());
                setup.direction = Some(Sourced {
                    value: direction,
                    ..asked
                });
            }
        }
        Self::of_field("cut with", ("direction", direction.word()), edits, changed)
    }

    /// One operation with another length.
    pub(crate) fn length(
        job: &CheckedJob,
        operation: usize,
        (field, text): (&str, &str),
        change: impl FnOnce(&mut Setup) -> Option<Span>,
    ) -> Self {
        let mut changed = job.clone();
        let edits = setup(&mut changed, operation).map(|setup| {
            let span = change(setup);
            setup.stated(field, span, text).into_iter().next()
        });
        Self::of_field("let the blade turn with", (field, text), edits, changed)
    }

    /// The base in another place.
    pub(crate) fn base(job: &CheckedJob, elsewhere: &Elsewhere) -> Self {
        let text = wording::frame_text(&elsewhere.base);
        let lead = format!("{}:", elsewhere.how);
        Self::of_machine(job, &lead, ("base", &text), |machine| {
            machine.base.value = elsewhere.base;
            machine.base.span
        })
    }

    /// Another home.
    pub(crate) fn home(job: &CheckedJob, home: &AxisValues) -> Self {
        let model = job.machine.as_ref().map(|machine| &machine.model);
        let text = model.map_or_else(String::new, |model| wording::home_text(model, home));
        Self::of_machine(job, "begin above the work:", ("home", &text), |machine| {
            let stated = machine.home.as_mut()?;
            stated.value = *home;
            stated.span
        })
    }

    /// One operation as a variant of itself.
    pub(crate) fn variant(job: &CheckedJob, operation: usize, variant: Variant) -> Self {
        let mut changed = job.clone();
        if let Some(place) = changed.operations.get_mut(operation) {
            *place = variant.operation;
        }
        Self {
            advice: variant.advice,
            written: String::new(),
            edits: variant.edits,
            job: changed,
        }
    }

    /// A field of the machine changed, which says where it is written.
    fn of_machine(
        job: &CheckedJob,
        lead: &str,
        (field, text): (&str, &str),
        change: impl FnOnce(&mut Machine) -> Option<Span>,
    ) -> Self {
        let mut changed = job.clone();
        let span = changed.machine.as_mut().and_then(change);
        let edit = span.map(|span| (span, text.to_owned()));
        Self::of_field(lead, (field, text), [edit], changed)
    }

    fn of_field(
        lead: &str,
        (field, text): (&str, &str),
        edits: impl IntoIterator<Item = Option<(Span, String)>>,
        job: CheckedJob,
    ) -> Self {
        let written = format!("{field} = {text}");
        Self {
            advice: format!("{lead} `{written}`"),
            written,
            edits: all(edits),
            job,
        }
    }
}

/// All edits, each once, since two operations may take a value from one place; none if one is missing.
fn all(edits: impl IntoIterator<Item = Option<(Span, String)>>) -> Edits {
    let edits: Option<Edits> = edits.into_iter().collect();
    let mut edits = edits.unwrap_or_default();
    edits.sort_by_key(|(span, _)| *span);
    edits.dedup();
    edits
}

fn setup(job: &mut CheckedJob, operation: usize) -> Option<&mut Setup> {
    let operation = job.operations.get_mut(operation)?;
    Some(operation.setup_mut())
}
