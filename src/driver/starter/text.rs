//! The words of a first job.

use super::Setup;
use super::places::BLOCK;
use core::fmt::Write;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::ir::{Axis, MachineKind, Maker, PlacedFrame};
use vcutc_machine::Model;
use vcutc_remedy::wording;

/// A job that is planned and proven, but has no machine.
pub(super) fn without_machine(name: &str) -> String {
    let mut text = cuts(name, 60, 60, BLOCK);
    text += "
// A program needs a machine. `vcutc init NAME --robot MODEL` writes one, and `vcutc machines` lists the models.
";
    text
}

/// The block, the part, the blade and the cuts.
pub(super) fn cuts(name: &str, rake: u32, reorient: u32, [width, depth, height]: [u32; 3]) -> String {
    let middle = width / 2;
    format!(
        r#"// A first part. Check it with `vcutc check`, then adapt the sizes, the profile and the blade to yours.
// docs/language.md explains every word.
job "{name}"

stock {{ size = ({width} mm, {depth} mm, {height} mm) }}      // x across the cuts, y along them, z up

profile {{                                      // the surface of the part, seen along the cuts; z is the height above the bottom of the block
  start (0 mm, 12 mm)
  arc   to ({width} mm, 12 mm) through ({middle} mm, 28 mm)
}}

blade dagger {{                                 // measure yours
  cutting_length = 32 mm
  half_apex      = 9 deg
  thickness      = 1.6 mm
  edges          = double
}}

rough vcut {{
  blade     = dagger
  rake      = {rake} deg                          // between the blade's axis and the feed
  lattice   = auto                            // auto: the compiler chooses the best value within the limits
  swing     = auto
  layer     = auto
  step      = auto
  limits    {{ swing <= 40 deg, scallop <= 10 mm }}   // scallop: the height of material that may stay on the part
  feed      {{ cut = 200 mm/s, travel = 300 mm/s, reorient = {reorient} deg/s }}
  clearance = 20 mm
}}
"#
    )
}

/// The same with a machine.
pub(super) fn with_machine(
    name: &str,
    model: &Model,
    setup: &Setup,
    targets: &[&'static dyn Backend],
) -> String {
    let mut text = cuts(name, setup.tool.rake, setup.reorient, setup.tool.block);
    text.push('\n');
    for remark in remarks(model, setup) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "// {remark}");
    }
    let placed = |frame| wording::frame_text(&PlacedFrame { frame, number: None });
    let fields = [
        (
            "tool",
            placed(setup.tool.frame()),
            "the blade's frame relative to the flange: from calibration",
        ),
        (
            "base",
            placed(setup.base),
            "the block's corner relative to the machine's root: from calibration",
        ),
        (
            "home",
            wording::home_text(model, &setup.home),
            "where the program starts and ends",
        ),
        (
            "ultrasonic",
            "output(1)".to_owned(),
            "the output that your generator is wired to",
        ),
        (
            "ready",
            "after(0.8 s)".to_owned(),
            "measured on your generator, or input(...)",
        ),
    ];
    let kind = match model.kind() {
        MachineKind::Robot => "robot",
        MachineKind::FiveAxis => "five_axis",
    };
    let _ = writeln!(text, "machine cell = {kind} \"{}\" {{", model.name);
    for (field, value, remark) in fields {
        let _ = writeln!(text, "  {field} = {value} // {remark}");
    }
    text += &load(model, setup);
    text += &options(model, targets);
    text += "}\n";
    text
}

/// What needs saying of the machine.
fn remarks(model: &Model, setup: &Setup) -> Vec<String> {
    let mut remarks = vec![
        "The frames and the home below were tried on this machine with this job: it compiles. They are not"
            .to_owned(),
        "those of your cell: measure tool and base, wire the generator, and enter your values.".to_owned(),
    ];
    if setup.tool.is_upright() {
        remarks.push(
            "With a blade that leans along the cut (`rake = 60 deg`) this machine cannot cut the job in any of"
                .to_owned(),
        );
        remarks.push(
            "the places that were tried, including this one, so the job has `rake = 90 deg`:".to_owned(),
        );
        remarks.push("see docs/machines_five_axis.md about an orientable spindle.".to_owned());
    }
    let unknown = |known: &dyn Fn(&Axis) -> bool| -> String {
        let names = model.axes.iter().filter(|axis| !known(axis));
        names
            .map(|axis| axis.name.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let rates = unknown(&|axis| axis.rate.is_some());
    if !rates.is_empty() {
        remarks.push(format!(
            "The sheet has no speeds of {rates}: they are not checked. `vcutc machines` shows the sheet;"
        ));
        remarks.push("your own copy can state them (docs/machines.md).".to_owned());
    }
    let accelerations = unknown(&|axis| axis.acceleration.is_some());
    if !accelerations.is_empty() {
        remarks.push(format!(
            "The sheet has no accelerations of {accelerations}: times assume programmed speeds."
        ));
    }
    remarks
}

/// What the flange carries; five-axis machines are not asked.
fn load(model: &Model, setup: &Setup) -> String {
    match model.kind() {
        MachineKind::FiveAxis => String::new(),
        MachineKind::Robot => {
            // Arms that carry a short blade have payloads from 3 kg.
            let mass = if setup.tool.length < 200.0 { 2 } else { 8 };
            let middle = setup.tool.length / 2.0;
            format!("  load = load(mass = {mass} kg, x = 0 mm, y = 0 mm, z = {middle} mm) // weigh it\n")
        }
    }
}

/// Options without which a target writes no program, if this build has it.
fn options(model: &Model, targets: &[&'static dyn Backend]) -> String {
    let block = match (model.kind(), model.maker) {
        (MachineKind::Robot, Maker::Abb) => Some((
            "rapid",
            "ultrasonic_signal = \"doUltrasonic\" // the signal's name in your controller",
        )),
        (MachineKind::FiveAxis, _) => Some((
            "gcode",
            "dialect = linuxcnc // or fanuc, heidenhain, sinumerik: these take no tcp_on and tcp_off\n    \
             tcp_on = (\"M429\") // your machine's codes\n    tcp_off = (\"M428\")\n    \
             // fanuc and heidenhain need codes for the generator: on_code = \"M50\" off_code = \"M51\"\n    \
             // fanuc also needs one that waits for an input of `ready`: ready_code = \"M52\"",
        )),
        (MachineKind::Robot, Maker::Kuka | Maker::Other) => None,
    };
    // S is a speed in G-code, so the control moves an orientable spindle by another letter.
    let has = |letter: &str| {
        model
            .axes
            .iter()
            .any(|axis| axis.name.eq_ignore_ascii_case(letter))
    };
    let free = ["c", "b", "a"].into_iter().find(|letter| !has(letter));
    let spindle = match (has("s"), free) {
        (true, Some(letter)) => {
            format!(
                "\n    spindle_axis = {letter} // the letter with which your controller moves the spindle"
            )
        }
        (_, _) => String::new(),
    };
    match block {
        Some((id, lines)) if targets.iter().any(|target| target.id() == id) => {
            format!("  {id} {{\n    {lines}{spindle}\n  }}\n")
        }
        Some(_) | None => String::new(),
    }
}
