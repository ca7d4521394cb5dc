//! What an operation is taken for while its plans are searched.

use crate::asked::{Formulas, Objective, RoughVcut};
use vcutc_backend_api::units::Length;
use vcutc_job::{Auto, Sourced};

/// Whether the plan has a say in the parameters. The formulas of the paper stand as they are printed.
pub(super) fn is_searched(asked: &RoughVcut) -> bool {
    let is_open = asked.swing.value == Auto::Auto
        || asked.layer.value == Auto::Auto
        || (asked.step.value == Auto::Auto
            && asked.overlap.value == Auto::Auto
            && asked.limits.scallop.is_some());
    is_open && asked.formulas.value == Formulas::Exact
}

/// The operation made fast, or with few cuts where only these are limited, under a limit on what it is to make small; with
/// none, under the job's own.
pub(super) fn limited(asked: &RoughVcut, limit: Option<Length>) -> RoughVcut {
    let mut assumed = under(asked, limit);
    assumed.objective.value = match (asked.limits.time, asked.limits.cuts) {
        (None, Some(_)) => Objective::Cuts,
        (Some(_), _) | (None, None) => Objective::Time,
    };
    assumed
}

/// The operation with the objective under which its plans are searched: a small scallop, or edge in use, is a limit on it
/// while time is made small.
pub(super) fn as_time(asked: &RoughVcut) -> RoughVcut {
    match asked.objective.value {
        Objective::Scallop | Objective::BladeLoad if is_searched(asked) => limited(asked, None),
        Objective::Time | Objective::Cuts | Objective::Scallop | Objective::BladeLoad => asked.clone(),
    }
}

/// The operation under a limit on what it makes small.
pub(super) fn under(asked: &RoughVcut, limit: Option<Length>) -> RoughVcut {
    let mut assumed = asked.clone();
    let Some(value) = limit else { return assumed };
    let narrowed = |written: Option<Sourced<Length>>| {
        Some(Sourced {
            value,
            span: written.and_then(|written| written.span),
        })
    };
    let limits = &mut assumed.limits;
    match asked.objective.value {
        Objective::Scallop => limits.scallop = narrowed(limits.scallop),
        Objective::BladeLoad => limits.edge = narrowed(limits.edge),
        Objective::Time | Objective::Cuts => {}
    }
    assumed
}
