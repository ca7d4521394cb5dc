//! What a controller does not take, found before anything is written.
//!
//! Sources: [K-SI] KUKA, KSS 8.3 Operating and Programming Instructions for System Integrators; [K-SYS] KUKA, System
//! Variables for KSS 8.1 to 8.4. Of each kind of problem only the first is reported, with its op: a stock
//! placed too far away would otherwise be reported a million times.

use crate::change;
use crate::options::Settings;
use vcutc_backend_api::arm::{ArmLimits, SpeedUnit, foreign_arm};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::chains::{first_joint, has_arcs};
use vcutc_backend_api::findings::{Findings, Number, driven_cell};
use vcutc_backend_api::ir::{
    Action, AxisValues, Blade, Cell, Maker, OpId, PlacedFrame, Ready, Registered, Tool,
};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::script::Part;
use vcutc_backend_api::status::kuka_status;

const LIMITS: ArmLimits = ArmLimits {
    // KRL's `REAL` has seven digits, so beyond this a hundredth of a millimetre is lost; no robot reaches a tenth of it.
    farthest_mm: 99_999.0,
    speed_unit: SpeedUnit::MetresPerSecond,
    // `$VEL.CP`: zero is refused, and `$VEL_MA.CP` is 3 as delivered [K-SYS].
    tip_speed: (0.000_001, 3.0),
    // Of a turn. Neither of its parts is faster, and `$VEL_MA.ORI1` and `.ORI2` are 400 as delivered [K-SYS]; neither is below
    // a tenth of it, and four decimals say that to a hundredth.
    rate: (0.1, 400.0),
    // `$LOAD.M`; the largest arm is rated for 1300.
    load_kg: (0.001, 1300.0),
};

/// Largest axis angle, in degrees: beyond it T does not say which turn is meant. Arms with six axes end at
/// 350 or before.
const LARGEST_AXIS_DEG: f64 = 360.0;

/// `TOOL_DATA[16]` and `LOAD_DATA[16]` [K-SYS].
const TOOLS: u32 = 16;

/// `BASE_DATA[32]` [K-SYS].
const BASES: u32 = 32;

/// `$IN[4096]` and `$OUT[4096]` [K-SYS].
const SIGNALS: u32 = 4096;

/// Inputs that the controller itself holds at TRUE and FALSE: the one never waits, the other waits without
/// end.
const FIXED_INPUTS: [u32; 2] = [1025, 1026];

const HOME_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "home",
    why: "a KRL program begins and ends with a move of all six axes to angles that the job states, so that it does not \
          depend on where the arm happens to stand",
};

/// What a program needs to run on.
const DRIVES: &str = "KUKA robots with six rotary axes and a spherical wrist";

/// The cell of a program, or everything that stands in the way of writing it.
pub(crate) fn check<'p>(
    program: &'p ReachableProgram,
    parts: &[Part],
    settings: &Settings<'_>,
) -> Result<&'p Cell, Vec<BackendIssue>> {
    let cell = driven_cell(program, DRIVES, |cell| {
        foreign_arm(program, cell, Maker::Kuka, |stretch| {
            kuka_status(stretch.branch).is_some()
        })
    })?;
    let mut found = Findings::default();
    machine(cell, &program.program().blades, &mut found);
    change::routine(cell, settings, &mut found);
    found.arm_ops(program, &LIMITS, &mut |found, id, action| {
        if matches!(action, Action::AxisTravel { .. }) {
            turns(program, id, found);
        }
    });
    restarts(program, parts, &mut found);
    chains(program, settings, &mut found);
    found.result().map(|()| cell)
}

/// Joints need something to round, and arcs their shape.
fn chains(program: &ReachableProgram, settings: &Settings<'_>, found: &mut Findings) {
    let program = program.program();
    if let Some(joint) = first_joint(program) {
        found.blend(program, joint);
    }
    if !has_arcs(program) {
        return;
    }
    for segment in program.segments() {
        let Some((line, via)) = segment.line().and_then(|line| line.via.map(|via| (line, via))) else {
            continue;
        };
        let points = [line.from.tip, via, line.to.tip];
        found.printed_arc(segment.id, points, settings.common.lengths);
        // As it is written: so that the blade has the time to turn.
        let number = Number {
            what: "tip speed on an arc",
            value: (line.length() / line.duration()).to_m_per_s(),
            unit: "m/s",
        };
        found.range(Some(segment.id), &number, LIMITS.tip_speed);
    }
}

fn machine(cell: &Cell, blades: &[Blade], found: &mut Findings) {
    match cell.home {
        Some(angles) => axes(None, "home angle", angles, found),
        None => found.report("home", HOME_MISSING),
    }
    if let Some(change) = cell.change {
        axes(None, "angle of the change place", change.at, found);
    }
    for (_, tool) in cell.tools.iter() {
        self::tool(tool, found);
    }
    frame(
        cell.base,
        ["base X", "base Y", "base Z"],
        ("base number", BASES),
        found,
    );
    for output in cell.outputs() {
        found.number("output number", output, 1..=SIGNALS);
    }
    found.generator(cell, blades);
    match cell.ready {
        Ready::Input(number) => input(number, found),
        Ready::After(time) => found.wait(None, "time until ready", time),
    }
}

fn tool(tool: &Tool, found: &mut Findings) {
    frame(
        tool.frame,
        ["tool X", "tool Y", "tool Z"],
        ("tool number", TOOLS),
        found,
    );
    match tool.load {
        Some(Registered::Value(load)) => found.load(load, &LIMITS),
        Some(Registered::Number(number)) => found.number("load number", number, 1..=TOOLS),
        None => {}
    }
}

fn axes(op: Option<OpId>, what: &'static str, axes: AxisValues, found: &mut Findings) {
    for angle in axes.0 {
        let value = angle.to_degrees();
        let unit = "deg";
        found.range(
            op,
            &Number { what, value, unit },
            (-LARGEST_AXIS_DEG, LARGEST_AXIS_DEG),
        );
    }
}

fn frame(
    placed: PlacedFrame,
    coordinates: [&'static str; 3],
    (what, highest): (&'static str, u32),
    found: &mut Findings,
) {
    found.frame(coordinates, placed, &LIMITS);
    if let Some(number) = placed.number {
        found.number(what, number, 1..=highest);
    }
}

fn input(input: u32, found: &mut Findings) {
    found.number("input number", input, 1..=SIGNALS);
    if FIXED_INPUTS.contains(&input) {
        found.report(
            "input number",
            BackendIssue::OutOfRange {
                op: None,
                what: "input number",
                value: input.to_string(),
                allowed: "1 to 4096 but not 1025 and 1026, which the controller holds on and off".to_owned(),
                range: None,
            },
        );
    }
}

/// Parts begin with a move of all axes to where the op before them ended.
fn restarts(program: &ReachableProgram, parts: &[Part], found: &mut Findings) {
    let before = |part: &Part| u32::try_from(part.ops.start.checked_sub(1)?).ok();
    for op in parts.iter().filter_map(before) {
        turns(program, OpId(op), found);
    }
}

/// The axes at the end of an op, where T has to say which turn is meant.
fn turns(program: &ReachableProgram, op: OpId, found: &mut Findings) {
    if let Some(values) = program.axes_after(op) {
        axes(Some(op), "axis angle", values, found);
    }
}
