//! What `auto` came out as, at the place where it stands.

use super::analysis::Analysis;
use super::sites::Site;
use vcutc_driver::summary::compared;
use vcutc_process::plan::{PlannedOperation, PlannedVcut};

/// What came of a field that was left open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Chosen {
    /// This, and why.
    As {
        /// The value, as it would be written.
        value: String,
        /// What was compared, or what kept it from coming out better; empty if there is nothing to say.
        why: String,
    },
    /// Nothing is known: the job is not planned yet, or cannot be.
    Unknown,
}

/// What became of the `auto` at a site.
pub(super) fn chosen(analysis: &Analysis, path: &str, site: &Site<'_>) -> Chosen {
    match looked_up(analysis, path, site) {
        Some((value, why)) => Chosen::As { value, why },
        None => Chosen::Unknown,
    }
}

fn looked_up(analysis: &Analysis, path: &str, site: &Site<'_>) -> Option<(String, String)> {
    // Only the job's own file has operations.
    if analysis.root != path {
        return None;
    }
    let field = site.place.field?.name;
    let plan = analysis.planned()?.plan.as_ref()?;
    let PlannedOperation::RoughVcut(planned) = plan.operations.get(site.place.operation?)?;
    let value = value(planned, field)?;
    Some((value, why(planned, field)))
}

/// The value of a field that was left open.
fn value(planned: &PlannedVcut, field: &str) -> Option<String> {
    let choices = planned.parameters.choices(&planned.asked);
    if let Some(choice) = choices.into_iter().find(|choice| choice.name == field) {
        return Some(choice.value);
    }
    match field {
        "overlap" => Some(overlap(planned)),
        "residual" => Some(planned.strategy.word().to_owned()),
        "order" => Some(planned.order.word().to_owned()),
        "sequence" => Some(planned.sequence.word().to_owned()),
        _ => None,
    }
}

/// The share by which neighbouring cuts overlap, by step and layer: `s = 2 (1 - eps) h tan(alpha)` [Cui 6, 7].
fn overlap(planned: &PlannedVcut) -> String {
    let parameters = &planned.parameters;
    let share = 1.0 - parameters.step.to_mm() * parameters.flanks.slope / (2.0 * parameters.layer.to_mm());
    format!("{:.1} %", share * 100.0)
}

/// Why it came out so.
fn why(planned: &PlannedVcut, field: &str) -> String {
    let decision = planned.decisions.iter().find(|decision| decision.field == field);
    if let Some(decision) = decision {
        return compared(decision);
    }
    let reasons = planned.parameters.reasons(&planned.asked);
    let is_bound = matches!(field, "lattice" | "swing" | "layer" | "step" | "overlap");
    if is_bound && !reasons.is_empty() {
        format!("bound by {}", reasons.join(", "))
    } else {
        String::new()
    }
}
