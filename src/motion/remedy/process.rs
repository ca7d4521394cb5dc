//! Cuts that ask less of the arm: in another direction or order, or with a smaller swing.

use super::{Case, Remedy, trial};
use crate::sweep::{Cure, Sweep};
use crate::trouble::Trouble;
use vcutc_backend_api::ir::{OpId, OperationId};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::{Auto, CheckedJob, Direction, Operation, Order, RoughVcut};
use vcutc_process::plan::PlannedOperation;

/// By how many degrees the swing is made smaller, one after the other.
const SMALLER: [f64; 4] = [2.0, 5.0, 10.0, 20.0];

/// The same cuts in another direction.
pub(super) fn other_direction(case: &mut Case<'_>) -> Option<Remedy> {
    let (operation, asked) = asked(case)?;
    [Direction::Forward, Direction::Backward, Direction::Alternate]
        .into_iter()
        .filter(|direction| *direction != asked.direction.value)
        .find(|&direction| works(case, operation, |asked| asked.direction.value = direction))
        .map(|direction| stated(asked, "direction", asked.direction.span, direction.word()))
}

/// The same cuts in the other order.
pub(super) fn other_order(case: &mut Case<'_>) -> Option<Remedy> {
    let (operation, asked) = asked(case)?;
    let order = match asked.order.value.or(Order::Point) {
        Order::Point => Order::Layer,
        Order::Layer => Order::Point,
    };
    works(case, operation, |asked| asked.order.value = Auto::Given(order))
        .then(|| stated(asked, "order", asked.order.span, order.word()))
}

/// The largest of a few smaller swings that works, in whole degrees.
pub(super) fn smaller_swing(case: &mut Case<'_>) -> Option<Remedy> {
    let (operation, asked) = asked(case)?;
    let planned = case.plan.operations.get(usize::from(operation.0))?;
    let PlannedOperation::RoughVcut(vcut) = planned;
    let now = vcut.parameters.swing.to_deg().ceil();
    SMALLER
        .into_iter()
        .map(|less| now - less)
        .filter(|&swing| swing > 0.0)
        .find(|&swing| {
            works(case, operation, |asked| {
                asked.swing.value = Auto::Given(Angle::deg(swing));
            })
        })
        .map(|swing| {
            let text = format!("{} deg", show(swing));
            Remedy::replace(format!("use a `swing` of {text}"), asked.swing.span, text)
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
    let (operation, asked) = asked(case)?;
    let PlannedOperation::RoughVcut(vcut) = case.plan.operations.get(usize::from(operation.0))?;
    let planned = vcut.parameters.extension;
    match cure {
        Cure::FartherOut(by) => {
            let extension = roomy(planned + by);
            works(case, operation, |asked| {
                asked.extension.value = Auto::Given(extension)
            })
            .then(|| stated_length(asked, "extension", asked.extension.span, extension))
        }
        Cure::HigherUp(by) => {
            let clearance = roomy(asked.clearance.value + by);
            works(case, operation, |asked| asked.clearance.value = clearance)
                .then(|| stated_length(asked, "clearance", asked.clearance.span, clearance))
        }
        Cure::Unknown => None,
    }
}

/// A length rounded up to what people like to paste: tenths of a millimetre.
fn roomy(length: Length) -> Length {
    Length::mm((length.to_mm() * 10.0 - 1e-6).ceil() / 10.0)
}

fn stated_length(asked: &RoughVcut, field: &str, span: Option<Span>, length: Length) -> Remedy {
    let text = format!("{} mm", show(length.to_mm()));
    let Remedy { edits, .. } = stated(asked, field, span, &text);
    Remedy {
        advice: format!("let the blade turn with `{field} = {text}`"),
        edits,
    }
}

/// A field with a word in place of the one it has, or added behind another where it is left out.
pub(super) fn stated(asked: &RoughVcut, field: &str, span: Option<Span>, word: &str) -> Remedy {
    let behind_rake = asked.rake.span.map(|rake| Span {
        start: rake.end,
        ..rake
    });
    let edit = match (span, behind_rake) {
        (Some(span), _) => Some((span, word.to_owned())),
        (None, Some(end)) => Some((end, format!("\n  {field} = {word}"))),
        (None, None) => None,
    };
    Remedy {
        advice: format!("cut with `{field} = {word}`"),
        edits: edit.into_iter().collect(),
    }
}

fn works(case: &mut Case<'_>, operation: OperationId, change: impl FnOnce(&mut RoughVcut)) -> bool {
    if !case.may_plan_again() || !case.may_try() {
        return false;
    }
    let changed = |job: &mut CheckedJob| {
        if let Some(Operation::RoughVcut(asked)) = job.operations.get_mut(usize::from(operation.0)) {
            change(asked);
        }
    };
    trial::whole(case, changed).is_some()
}

/// The operation in which the trouble is.
fn asked<'c>(case: &Case<'c>) -> Option<(OperationId, &'c RoughVcut)> {
    let op: OpId = match &case.unreachable.trouble {
        Trouble::Motion { failing, .. } | Trouble::NoCommonBranch { failing, .. } => failing.op,
        Trouble::Way { op, .. } | Trouble::Sweep(Sweep { op, .. }) => *op,
        Trouble::Nowhere => return None,
    };
    let program = case.unreachable.program.program();
    let operation = program.ops.get(op.0 as usize)?.site.operation()?;
    let Operation::RoughVcut(asked) = case.job.operations.get(usize::from(operation.0))?;
    Some((operation, asked))
}
