//! What there is to warn of: checks of the machine's motions that were not made.

use super::words::listed;
use super::{About, Checks, Outcome};
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Machine;
use vcutc_machine::{FileKind, Origin};
use vcutc_motion::solve::Reached;

impl Checks {
    /// The warnings of a job on its machine: all that keeps it from counting as proven. What no job has checked, such as
    /// collisions, is named among what is not checked, and is not warned of: a warning that comes with every
    /// job is not read.
    #[must_use]
    pub fn warnings(&self, machine: &Machine, reached: &Reached) -> Vec<Diagnostic> {
        let not_made = self.iter().filter(|checked| checked.outcome != Outcome::Made);
        let others = not_made.filter_map(|checked| match checked.check.about() {
            About::ElbowAngle => Some(elbow_angle(machine, reached)),
            About::SingularPoses => Some(singular_poses(machine)),
            // All axes in one warning.
            About::Rate(_) => None,
            About::Motions | About::Bodies(_) | About::Others => None,
        });
        self.rates(machine).into_iter().chain(others).collect()
    }

    /// The warning of rates that are not known, if there are any.
    fn rates(&self, machine: &Machine) -> Option<Diagnostic> {
        let (_, unknown) = self.axes();
        let (axes, name) = (listed(&unknown), &machine.model.name);
        let (rates, are, them) = match unknown.len() {
            0 => return None,
            1 => ("speed limit", "is", "it"),
            _ => ("speed limits", "are", "them"),
        };
        let diagnostic = Diagnostic::new(
            Code::RatesNotChecked,
            format!("the {rates} of {axes} {are} not known, so no motion was checked against {them}"),
            machine.model_span,
            format!("its description states no {rates} of {axes}"),
        );
        Some(
            diagnostic.note("a motion that is too fast for an axis is slowed down or stopped by the controller, or leaves its line")
                .help(remedy(machine, name)),
        )
    }
}

/// The warning of a parallelogram, whose arms must not come too close to each other.
fn elbow_angle(machine: &Machine, reached: &Reached) -> Diagnostic {
    let between_arms = |joints: &[f64]| Some(joints.get(2)? - joints.get(1)?);
    let ends = reached.program.motion().ends.iter();
    let (low, high) = ends
        .filter_map(|end| between_arms(&end.0))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), angle| {
            (low.min(angle), high.max(angle))
        });
    let diagnostic = Diagnostic::new(
        Code::MotionNotChecked,
        "the angle between the arms, J3 - J2, was not checked",
        machine.model_span,
        "the range of its parallelogram is not known",
    )
    .note("a controller that finds this angle out of its range stops with an error");
    if low <= high {
        diagnostic.help(format!(
            "compare with the data sheet: at the ends of the motions of this program, J3 - J2 ranges from {:.1} to {:.1} deg",
            low.to_degrees(),
            high.to_degrees()
        ))
    } else {
        diagnostic
    }
}

/// The warning of an arm whose distance from singularities is not measured.
fn singular_poses(machine: &Machine) -> Diagnostic {
    Diagnostic::new(
        Code::MotionNotChecked,
        "the distance from singularities was not checked",
        machine.model_span,
        "this arm has no closed-form solution, so the distance is not measured",
    )
    .note("no motion passes through a singularity; close to one the controller may slow down")
    .help("run the program in the simulation of the controller, and look for places where it slows down")
}

/// Where the rates are to be written.
fn remedy(machine: &Machine, name: &str) -> String {
    let key = match machine.model.kind() {
        MachineKind::Robot => "`speeds_deg_s`",
        MachineKind::FiveAxis => "`rate_mm_s` and `rate_deg_s`",
    };
    match Origin::of(name) {
        Origin::Catalogue => format!(
            "take the speeds from the data sheet of your machine, and describe it in your own sheet with {key}; `vcutc machines {name}` shows all other numbers"
        ),
        Origin::File(FileKind::Sheet) => format!("add {key} to {name}, from the data sheet of your machine"),
        Origin::File(FileKind::Urdf) => {
            format!("add `velocity` to each `limit` of {name}, in rad/s, from the data sheet of your machine")
        }
    }
}
