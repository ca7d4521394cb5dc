//! A posture that the two rotary axes of a five-axis machine cannot hold, in words: by how much the blade plane stays turned,
//! and which axis is missing.

use crate::rig::Rig;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Machine;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::five_axis::FiveAxis;
use vcutc_machine::kinematics::pose::Pose;

/// What is reported of a pose of the blade in the work that rotary axes without limits do not reach. None for other machines, and
/// for poses that they do. `place` says which pose it is, such as `layer 7, cut 12`.
pub(super) fn lacks_an_axis(
    machine: &Machine,
    place: &str,
    tip: Point3,
    held: Orientation,
) -> Option<Diagnostic> {
    let five_axis = match &machine.model.mechanism {
        Mechanism::FiveAxis(five_axis) => five_axis,
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => return None,
    };
    let rig = Rig::of(machine);
    let blade_in_work = Pose::from(Frame {
        origin: tip,
        orientation: held,
    });
    let turned = five_axis.blade_turned(&rig.flange_in_root(&blade_in_work))?;
    let name = &machine.model.name;
    let angle = show(turned.abs().to_degrees());
    let headline =
        format!("`{name}` cannot hold the blade for {place}: its plane would be turned by {angle} deg");
    Some(if cuts_along_y(held) {
        along_y(machine, five_axis, headline)
    } else {
        along_walls(machine, headline)
    })
}

/// How far the normal of a blade that cuts along y may lean that way, which is rounding.
const UPRIGHT: f64 = 1e-6;

/// Whether the blade cuts along y of the work, which its plane shows. One that follows a wall cuts along that.
fn cuts_along_y(held: Orientation) -> bool {
    let [_, [_, along, _], _] = held.matrix();
    along.abs() < UPRIGHT
}

/// Walls point in all directions, so it does not help to mount blade or work otherwise.
fn along_walls(machine: &Machine, headline: String) -> Diagnostic {
    Diagnostic::new(
        Code::PostureNeedsAxis,
        headline,
        machine.model_span,
        "lacks a rotary axis that turns the blade about itself: an orientable spindle (C' or S)",
    )
    .note("a blade that follows walls turns with them; two rotary axes hold it along one direction")
    .help(
        "use a robot, or a machine whose rotary axes swing and rake the blade and that turns it about itself below them: a head with B carrying A, \
         and `spindle = \"c\"` in its sheet",
    )
}

fn along_y(machine: &Machine, five_axis: &FiveAxis, headline: String) -> Diagnostic {
    let tool = machine.tools.first().frame.span.unwrap_or(machine.head_span);
    let base = machine.base.span.unwrap_or(machine.head_span);
    if five_axis.swings_then_rakes() {
        return Diagnostic::new(
            Code::PostureNeedsAxis,
            headline,
            tool,
            "with the blade mounted like this",
        )
        .and(base, "and the work like this")
        .note("B swings the blade and A rakes it, as long as the blade stands upright at zero angles and cuts along Y of the machine")
        .help(
            "turn the blade about itself in `tool` (`a = -90 deg` sets it along Y), or the work in `base`, until the cuts run along Y of the machine; \
             or use a machine with an orientable spindle",
        );
    }
    Diagnostic::new(
        Code::PostureNeedsAxis,
        headline,
        machine.model_span,
        "lacks a rotary axis that turns the blade about itself: an orientable spindle (C' or S)",
    )
    .and(tool, "the blade is mounted here")
    .note("its two rotary axes point the blade in the right direction; what is left is a turn about the blade itself")
    .help(
        "use a machine with an orientable spindle, such as \"generic/head_head_ac_spindle\", or add `spindle = \"s\"` and `[axis.s]` to the sheet if it has one",
    )
    .help("or use one whose rotary axes swing and rake the blade: a head with B carrying A, a head with A over a table with B, or a table with A carrying B")
}
