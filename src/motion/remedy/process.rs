//! Cuts that ask less of the arm: in another direction or order, or with a smaller swing.

use super::{Case, Remedy, trial};
use crate::sweep::{Cure, Sweep};
use crate::trouble::Trouble;
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::operation::{Operation, Variant, Variation};
use vcutc_job::{Auto, CheckedJob, Direction, PlannedOperation, Setup};

/// The same cuts in another direction.
pub(super) fn other_direction(case: &mut Case<'_>) -> Option<Remedy> {
    let troubled = Troubled::of(case)?;
    let setup = troubled.asked.setup();
    [Direction::Forward, Direction::Backward, Direction::Alternate]
        .into_iter()
        .filter(|direction| *direction != setup.direction.value)
        .find(|&direction| troubled.works(case, |setup| setup.direction.value = direction))
        .map(|direction| Remedy {
            advice: format!("cut with `direction = {}`", direction.word()),
            edits: setup.stated("direction", setup.direction.span, direction.word()),
        })
}

/// The same cuts in the other order.
pub(super) fn other_order(case: &mut Case<'_>) -> Option<Remedy> {
    variant(case, Variation::Order)
}

/// The largest of a few smaller swings that works, in whole degrees.
pub(super) fn smaller_swing(case: &mut Case<'_>) -> Option<Remedy> {
    variant(case, Variation::SmallerSwing)
}

/// The first of the operation's own variants that works.
fn variant(case: &mut Case<'_>, of: Variation) -> Option<Remedy> {
    let troubled = Troubled::of(case)?;
    let variants = troubled.asked.variants(troubled.planned, of);
    variants.into_iter().find_map(|variant| {
        let Variant {
            advice,
            edits,
            operation,
        } = variant;
        troubled
            .works_as(case, operation)
            .then_some(Remedy { advice, edits })
    })
}

/// The blade farther beside the work where it turns, or higher above it.
pub(super) fn more_room(case: &mut Case<'_>) -> Option<Remedy> {
    let cure = match &case.unreachable.trouble {
        Trouble::Sweep(sweep) => sweep.cure,
        Trouble::Motion { .. } | Trouble::NoCommonBranch { .. } | Trouble::Way { .. } | Trouble::Nowhere => {
            return None;
        }
    };
    let troubled = Troubled::of(case)?;
    let setup = troubled.asked.setup();
    match cure {
        Cure::FartherOut(by) => {
            let extension = roomy(troubled.planned.extension() + by);
            troubled
                .works(case, |setup| setup.extension.value = Auto::Given(extension))
                .then(|| stated_length(setup, "extension", setup.extension.span, extension))
        }
        Cure::HigherUp(by) => {
            let clearance = roomy(setup.clearance.value + by);
            troubled
                .works(case, |setup| setup.clearance.value = clearance)
                .then(|| stated_length(setup, "clearance", setup.clearance.span, clearance))
        }
        Cure::Unknown => None,
    }
}

/// A length rounded up to what people like to paste: tenths of a millimetre.
fn roomy(length: Length) -> Length {
    Length::mm((length.to_mm() * 10.0 - 1e-6).ceil() / 10.0)
}

fn stated_length(setup: &Setup, field: &str, span: Option<Span>, length: Length) -> Remedy {
    let text = format!("{} mm", show(length.to_mm()));
    Remedy {
        advice: format!("let the blade turn with `{field} = {text}`"),
        edits: setup.stated(field, span, &text),
    }
}

/// The operation that the machine does not follow.
struct Troubled<'c> {
    place: usize,
    asked: &'c dyn Operation,
    planned: &'c dyn PlannedOperation,
}

impl<'c> Troubled<'c> {
    fn of(case: &Case<'c>) -> Option<Self> {
        let op: OpId = match &case.unreachable.trouble {
            Trouble::Motion { failing, .. } | Trouble::NoCommonBranch { failing, .. } => failing.op,
            Trouble::Way { op, .. } | Trouble::Sweep(Sweep { op, .. }) => *op,
            Trouble::Nowhere => return None,
        };
        let program = case.unreachable.program.program();
        let operation = program.ops.get(op.0 as usize)?.site.operation()?;
        let place = usize::from(operation.0);
        Some(Self {
            place,
            asked: &**case.job.operations.get(place)?,
            planned: case.plan.operation(operation)?,
        })
    }

    /// Whether the job compiles with a change of the operation's set-up.
    fn works(&self, case: &mut Case<'_>, change: impl FnOnce(&mut Setup)) -> bool {
        let mut changed = self.asked.copied();
        change(changed.setup_mut());
        self.works_as(case, changed)
    }

    /// Whether the job compiles with this operation in the place of the troubled one.
    fn works_as(&self, case: &mut Case<'_>, changed: Box<dyn Operation>) -> bool {
        if !case.may_plan_again() || !case.may_try() {
            return false;
        }
        let put = |job: &mut CheckedJob| {
            if let Some(operation) = job.operations.get_mut(self.place) {
                *operation = changed;
            }
        };
        trial::whole(case, put).is_some()
    }
}
