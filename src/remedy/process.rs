//! Cuts that ask less of the arm: in another direction or order, or with a smaller swing.

use crate::case::Case;
use crate::change::{Change, DIRECTIONS};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_job::operation::{Operation, Variation};
use vcutc_job::{CheckedJob, PlannedOperation};
use vcutc_motion::sweep::Cure;

/// The same cuts in another direction.
pub(crate) fn other_direction(case: &mut Case<'_>) -> Option<Change> {
    let Troubled {
        job, place, asked, ..
    } = Troubled::of(case)?;
    let asked = asked.setup().direction?;
    let others = DIRECTIONS
        .into_iter()
        .filter(|&direction| direction != asked.value);
    case.first(others.map(|direction| Change::direction(job, &[place], direction)))
}

/// The same cuts in the other order.
pub(crate) fn other_order(case: &mut Case<'_>) -> Option<Change> {
    variant(case, Variation::Order)
}

/// The largest of a few smaller swings that works, in whole degrees.
pub(crate) fn smaller_swing(case: &mut Case<'_>) -> Option<Change> {
    variant(case, Variation::SmallerSwing)
}

/// The first of the operation's own variants that works.
fn variant(case: &mut Case<'_>, of: Variation) -> Option<Change> {
    let troubled = Troubled::of(case)?;
    let variants = troubled.asked.variants(troubled.planned, of).into_iter();
    case.first(variants.map(|variant| Change::variant(troubled.job, troubled.place, variant)))
}

/// The blade farther beside the work where it turns, or higher above it.
pub(crate) fn more_room(case: &mut Case<'_>, cure: Cure) -> Option<Change> {
    let Troubled {
        job,
        place,
        asked,
        planned,
    } = Troubled::of(case)?;
    let change = match cure {
        Cure::FartherOut(by) => {
            let setup = asked.setup();
            let (room, text) = roomy(setup.turning_room(planned.extension()) + by);
            let (field, span) = setup.turning_field();
            Change::length(job, place, (field, &text), |setup| {
                setup.set_turning_room(room);
                span
            })
        }
        Cure::HigherUp(by) => {
            let (clearance, text) = roomy(asked.setup().clearance.value + by);
            Change::length(job, place, ("clearance", &text), |setup| {
                setup.clearance.value = clearance;
                setup.clearance.span
            })
        }
        Cure::Unknown => return None,
    };
    case.first([change])
}

/// Which of the cuts' own fields can be changed where the machine does not follow, by name.
pub(crate) fn choices(case: &Case<'_>) -> Vec<&'static str> {
    let Some(Troubled { asked, planned, .. }) = Troubled::of(case) else {
        return Vec::new();
    };
    let varies = |of| !asked.variants(planned, of).is_empty();
    let choices = [
        ("direction", asked.setup().direction.is_some()),
        ("order", varies(Variation::Order)),
        ("swing", varies(Variation::SmallerSwing)),
    ];
    choices
        .into_iter()
        .filter_map(|(field, is_there)| is_there.then_some(field))
        .collect()
}

/// A length rounded up to what people like to paste: tenths of a millimetre.
fn roomy(length: Length) -> (Length, String) {
    let tenths = (length.to_mm() * 10.0 - 1e-6).ceil() / 10.0;
    (Length::mm(tenths), format!("{} mm", show(tenths)))
}

/// The operation that the machine does not follow.
struct Troubled<'c> {
    job: &'c CheckedJob,
    place: usize,
    asked: &'c dyn Operation,
    planned: &'c dyn PlannedOperation,
}

impl<'c> Troubled<'c> {
    fn of(case: &Case<'c>) -> Option<Self> {
        let op = case.unreachable.trouble.op()?;
        let operation = case.unreachable.program.program().op(op)?.site.operation()?;
        let place = usize::from(operation.0);
        Some(Self {
            job: case.job,
            place,
            asked: &**case.job.operations.get(place)?,
            planned: case.plan.operation(operation)?,
        })
    }
}
