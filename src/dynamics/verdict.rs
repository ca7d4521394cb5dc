//! Torques above the limits of drives, in words.

use crate::figures::{AxisTorque, Reliance, TorqueFigures, whole};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Machine;

/// What is wrong with the torques of a program, if something is: an error where the numbers are those of the machine, and a warning
/// where they are those of others, or not all.
#[must_use]
pub fn above_limit(figures: &TorqueFigures, machine: &Machine) -> Option<Diagnostic> {
    let nearest = figures.nearest().filter(|axis| is_above(axis))?;
    let limit = nearest.limit?;
    let (code, indicative) = match figures.reliance() {
        Reliance::Sound => (Code::TorqueAboveLimit, String::new()),
        Reliance::Indicative => (
            Code::TorqueIndicative,
            format!(". Indicative: {}", figures.backing()),
        ),
    };
    let along = nearest.torque.signum();
    let diagnostic = Diagnostic::new(
        code,
        format!(
            "{} needs up to {} Nm at {}, but its limit is {} Nm: weight {} Nm, motion {} Nm{indicative}",
            nearest.name,
            whole(nearest.torque.abs()),
            nearest.at.words,
            show(limit),
            whole(along * nearest.weight),
            whole(along * nearest.motion),
        ),
        machine.model_span,
        "its drive is too weak for this program",
    );
    let others = figures.axes.iter().filter(|axis| is_above(axis)).count() - 1;
    Some(match others {
        0 => diagnostic,
        1 => diagnostic.note("another axis is above its limit, too"),
        others => diagnostic.note(format!("{others} other axes are above their limits, too")),
    })
}

/// Whether no axis needs more than its drive gives.
#[must_use]
pub fn is_within_limits(figures: &TorqueFigures) -> bool {
    !figures.axes.iter().any(is_above)
}

/// `A2 needs 2850 Nm`: what the axis needs that is nearest to its limit.
#[must_use]
pub fn relief(figures: &TorqueFigures) -> String {
    let nearest = figures.nearest();
    nearest.map_or_else(String::new, |axis| {
        format!("{} needs {} Nm", axis.name, whole(axis.torque.abs()))
    })
}

fn is_above(axis: &AxisTorque) -> bool {
    axis.share().is_some_and(|share| share > 1.0)
}
