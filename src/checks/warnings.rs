//! What there is to warn of: checks that were not made because the job's machine lacks a number that its owner can find out.

use super::Checks;
use super::words::listed;
use crate::diag::{Code, Diagnostic};
use crate::job::Machine;
use crate::machine::{FileKind, Origin};
use vcutc_backend_api::ir::MachineKind;

impl Checks {
    /// The warnings of a job on its machine. What no description of a machine can say is named among what is not checked, and
    /// is not warned of: a warning that comes with every job is read by nobody.
    #[must_use]
    pub fn warnings(&self, machine: &Machine) -> Vec<Diagnostic> {
        let (_, unknown) = self.axes();
        if unknown.is_empty() {
            return Vec::new();
        }
        let (axes, name) = (listed(&unknown), &machine.model.name);
        let (rates, are) = match unknown.len() {
            1 => ("rate", "is"),
            _ => ("rates", "are"),
        };
        vec![
            Diagnostic::new(
                Code::RatesNotChecked,
                format!("the {rates} of {axes} {are} not known, so that no motion was checked against {}", match unknown.len() { 1 => "it", _ => "them" }),
                machine.model_span,
                format!("its description states no {rates} of {axes}"),
            )
            .note("a motion that is too fast for an axis is slowed down or stopped by the control, or leaves its line")
            .help(remedy(machine, name)),
        ]
    }
}

/// Where the rates are to be written.
fn remedy(machine: &Machine, name: &str) -> String {
    let key = match machine.model.kind() {
        MachineKind::Robot => "`speeds_deg_s`",
        MachineKind::FiveAxis => "`rate_mm_s` and `rate_deg_s`",
    };
    match Origin::of(name) {
        Origin::Catalogue => format!(
            "read the rates from the data sheet of your machine, and describe it in a sheet of your own with {key}; `vcutc machines {name}` shows all other numbers"
        ),
        Origin::File(FileKind::Sheet) => format!("add {key} to {name}, from the data sheet of your machine"),
        Origin::File(FileKind::Urdf) => {
            format!("add `velocity` to each `limit` of {name}, in rad/s, from the data sheet of your machine")
        }
    }
}
