//! Torques above the limits of drives, in words.

use crate::arms::Unknown;
use crate::figures::{AxisTorque, Reliance, TorqueFigures, percent, whole};
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Machine;

/// What is wrong with the torques of a program, if something is: an error where the numbers are those of the machine, and a warning
/// where they are those of others, or not all.
#[must_use]
pub fn above_limit(figures: &TorqueFigures, machine: &Machine) -> Option<Diagnostic> {
    let nearest = figures.nearest().filter(|axis| is_above(figures, axis))?;
    let limit = nearest.limit?;
    let (code, indicative) = match figures.reliance() {
        Reliance::Sound => (Code::TorqueAboveLimit, String::new()),
        Reliance::Indicative => (
            Code::TorqueIndicative,
            format!(". Indicative: {}", figures.backing()),
        ),
    };
    let message = format!(
        "{} needs up to {} Nm at {}, but its limit is {}; there {}{indicative}",
        nearest.name,
        whole(nearest.most),
        nearest.at.words,
        allowed(figures, limit),
        nearest.parts(),
    );
    let diagnostic = match machine.torque_limit.and_then(|limit| limit.span) {
        None => {
            let label = "its drive is too weak for this program";
            Diagnostic::new(code, message, machine.model_span, label)
        }
        Some(span) => {
            let drive = format!("the drive of {} gives {} Nm", nearest.name, show(limit));
            let diagnostic = Diagnostic::new(code, message, span, "the share that it may use");
            kept(
                nearest.most / limit,
                span,
                diagnostic.and(machine.model_span, drive),
            )
        }
    };
    let others = figures.axes.iter().filter(|axis| is_above(figures, axis)).count() - 1;
    Some(match others {
        0 => diagnostic,
        1 => diagnostic.note("another axis is above its limit, too"),
        others => diagnostic.note(format!("{others} other axes are above their limits, too")),
    })
}

/// Offers the least share that is kept, where there is one: `share` is the largest that an axis needs.
fn kept(share: f64, limit: Span, diagnostic: Diagnostic) -> Diagnostic {
    if share > 1.0 {
        return diagnostic.note("the whole torque of its drive does not suffice");
    }
    let percent = format!("{} %", percent(share));
    diagnostic.fix(format!("`torque <= {percent}` is kept"), limit, percent)
}

/// A limit on torques that nothing can check, where there is one.
#[must_use]
pub fn not_checked(figures: &Result<TorqueFigures, Unknown>, machine: &Machine) -> Option<Diagnostic> {
    let limit = machine.torque_limit?;
    let name = &machine.model.name;
    let (why, help) = match figures {
        Ok(figures) if figures.limits.is_some() => return None,
        Ok(_) => (
            format!("`{name}` does not state the torques of its drives"),
            "state `[torque]` in a sheet of your machine (docs/machines.md), or delete the limit",
        ),
        Err(Unknown::Masses) if machine.model.kind() == MachineKind::FiveAxis => {
            (format!("`{name}` is not an arm"), "delete the limit")
        }
        Err(Unknown::Masses) => (
            format!("`{name}` does not state the masses of its links"),
            "state `[dynamics]` in a sheet of your machine (docs/machines.md), or delete the limit",
        ),
        Err(Unknown::Load) => (
            "the load on the flange is not stated".to_owned(),
            "state `load = load(...)` in the machine, or delete the limit",
        ),
    };
    let diagnostic = Diagnostic::new(
        Code::LimitNotChecked,
        format!("`torque` cannot be checked: {why}"),
        limit.span.unwrap_or(machine.head_span),
        "a limit that nothing checks",
    );
    Some(diagnostic.help(help))
}

/// Whether no axis needs more than its drive gives.
#[must_use]
pub fn is_within_limits(figures: &TorqueFigures) -> bool {
    !figures.axes.iter().any(|axis| is_above(figures, axis))
}

/// `A2 needs 2850 Nm`: what the axis needs that is nearest to its limit.
#[must_use]
pub fn relief(figures: &TorqueFigures) -> String {
    let nearest = figures.nearest();
    nearest.map_or_else(String::new, |axis| {
        format!("{} needs {} Nm", axis.name, whole(axis.most))
    })
}

fn is_above(figures: &TorqueFigures, axis: &AxisTorque) -> bool {
    axis.share()
        .is_some_and(|share| share > figures.allowed.unwrap_or(1.0))
}

/// `9600 Nm`, or `80 % of 9600 Nm`.
fn allowed(figures: &TorqueFigures, limit: f64) -> String {
    let share = figures.allowed.map_or_else(String::new, |share| {
        format!("{} % of ", show(rounded(share * 100.0, 1e9)))
    });
    format!("{share}{} Nm", show(limit))
}
