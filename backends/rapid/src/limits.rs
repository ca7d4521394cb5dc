//! What a controller does not take, found before anything is written.
//!
//! Sources: [A-KER] ABB 3HAC050946, RAPID kernel; [A-INS] ABB, RAPID instructions, functions and data types.

use crate::change;
use crate::names::{
    AXES_SPEED, BLEND, CHANGE, FEED, HOME, MAIN, RATE, SPEED, ZONE, is_name, main_name, part_module,
    part_routine,
};
use crate::options::{
    CHANGE_ROUTINE, READY_SIGNAL, SPINDLE_SIGNAL, Settings, TOOL_NAME, ULTRASONIC_SIGNAL, WORK_OBJECT_NAME,
};
use crate::profile::objection;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::arm::{ArmLimits, SpeedUnit, foreign_arm};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::chains::{first_joint, has_arcs};
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::findings::{Findings, Number, driven_cell};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, AxisValues, Blade, Cell, Load, Maker, OpId, Ready, Registered, Spindle};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::wrist::{TOO_FAR, turn};

const LIMITS: ArmLimits = ArmLimits {
    // A `num` is a single precision number [A-KER]: up to here it keeps half a micrometre, and no robot reaches half as far.
    farthest_mm: 9999.0,
    speed_unit: SpeedUnit::MillimetresPerSecond,
    // Zero is refused, and the fastest of ABB's own speeddata is v7000 [A-INS].
    tip_speed: (0.001, 7000.0),
    // That of ABB's own speeddata is 500 [A-INS].
    rate: (0.001, 500.0),
    // Of `loaddata`: zero is refused, and the largest arm is rated for 1000.
    load_kg: (0.001, 1000.0),
};

/// A centre of mass nearer than this to the flange's origin, in mm, counts as missing: all zeros are refused.
const NO_DISTANCE_MM: f64 = 0.001;

/// Points of an arc are at least so far apart, in mm [A-INS].
const NEAREST_MM: f64 = 0.1;

/// Middle and end of an arc lie in directions that are at least so far apart, in degrees, from where it begins [A-INS].
const NARROWEST_DEG: f64 = 1.0;

/// What modules may be called after the dot; RobotWare 7 writes the second.
const EXTENSIONS: [&str; 2] = ["mod", "modx"];

const HOME_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "home",
    why: "a RAPID program begins and ends with a move of all six axes to angles that the job states, so that it does not \
          depend on where the arm happens to stand",
};

const LOAD_MISSING: BackendIssue = BackendIssue::MissingMachineField {
    field: "load",
    why: "the tool is given by values, so the program declares a tooldata, and the controller refuses one without the mass \
          and the centre of mass of what the flange carries",
};

/// What a program needs to run on.
const DRIVES: &str = "ABB robots with six rotary axes and a spherical wrist";

/// The cell of a program, or everything that stands in the way of writing it.
pub(crate) fn check<'p>(
    program: &'p ReachableProgram,
    settings: &Settings<'_>,
    parts: usize,
) -> Result<&'p Cell, Vec<BackendIssue>> {
    let cell = driven_cell(program, DRIVES, |cell| {
        foreign_arm(program, cell, Maker::Abb, |stretch| {
            let axes = program.axes_after(stretch.from);
            axes.and_then(|axes| confdata(stretch.branch, &axes)).is_some()
        })
    })?;
    let mut findings = Findings::default();
    profile(settings, cell, &mut findings);
    names(settings, cell, &mut findings);
    reserved(settings, cell, &program.program().name, parts, &mut findings);
    machine(cell, &program.program().blades, &mut findings);
    change::names(cell, settings, &mut findings);
    findings.arm_ops(program, &LIMITS, &mut |_, _, _| {});
    turns(program, &mut findings);
    chains(program, settings, &mut findings);
    findings.result().map(|()| cell)
}

/// What the machine's profile asks for.
fn profile(settings: &Settings<'_>, cell: &Cell, findings: &mut Findings) {
    let profile = settings.common.profile;
    let mut refuse =
        |key: &'static str, why: String| findings.report(key, BackendIssue::Profile { key, why });
    if profile.line_numbers.is_some() {
        refuse("line_numbers", "RAPID has no numbers of lines".to_owned());
    }
    if let Some(extension) = &profile.extension
        && !EXTENSIONS.contains(&extension.to_ascii_lowercase().as_str())
    {
        refuse(
            "extension",
            format!("modules are called {}", EXTENSIONS.join(" or ")),
        );
    }
    for (key, lines) in [("header", &profile.header), ("footer", &profile.footer)] {
        let is_plain = |line: &String| line.bytes().all(|byte| matches!(byte, b'\t' | b' '..=b'~'));
        if let Some(line) = lines.iter().find(|line| !is_plain(line)) {
            refuse(key, format!("a line is not plain ASCII: {line:?}"));
        } else if let Some(why) = lines.iter().find_map(|line| objection(line, settings, cell)) {
            refuse(key, why);
        }
    }
}

/// Names that the job gives must be such.
fn names(settings: &Settings<'_>, cell: &Cell, findings: &mut Findings) {
    for key in [
        TOOL_NAME,
        WORK_OBJECT_NAME,
        ULTRASONIC_SIGNAL,
        SPINDLE_SIGNAL,
        READY_SIGNAL,
    ] {
        if let Some(name) = settings.given(key)
            && !is_name(name)
        {
            let why = format!(
                "`{name}` is not a name: a letter, then letters, digits and `_`, at most 32 in all, no word or data of RAPID, \
                 and no `vc_` at its start, with which the program's own names begin"
            );
            findings.report(key, BackendIssue::OptionConflict { key, why });
        }
    }
    let mut taken = own_names();
    for (key, name) in used_names(settings, cell) {
        if taken.iter().any(|other| other.eq_ignore_ascii_case(&name)) {
            let why = format!("`{name}` already stands for something else in the program");
            findings.report(key, BackendIssue::OptionConflict { key, why });
        }
        taken.push(name);
    }
}

/// The names of frames and signals, with the option that gives each.
fn used_names(settings: &Settings<'_>, cell: &Cell) -> Vec<(&'static str, String)> {
    let tools = cell.tools.iter();
    let mut used: Vec<(&'static str, String)> = tools
        .map(|(id, _)| (TOOL_NAME, settings.tool(cell, id)))
        .collect();
    used.push((WORK_OBJECT_NAME, settings.work_object(cell)));
    let routine = settings.given(CHANGE_ROUTINE).map(str::to_owned);
    used.extend(routine.map(|name| (CHANGE_ROUTINE, name)));
    used.extend(
        cell.ultrasonic
            .map(|number| (ULTRASONIC_SIGNAL, settings.output(cell, number))),
    );
    used.extend(
        cell.spindle
            .and_then(Spindle::output)
            .map(|number| (SPINDLE_SIGNAL, settings.output(cell, number))),
    );
    match cell.ready {
        Ready::Input(number) => used.push((READY_SIGNAL, settings.input(number))),
        Ready::After(_) => {}
    }
    used
}

/// The names of data that every program declares.
fn own_names() -> Vec<String> {
    [HOME, CHANGE, AXES_SPEED, ZONE, BLEND]
        .map(str::to_owned)
        .to_vec()
}

/// Names that the module of a program must not have, in addition to those of RAPID itself.
pub(crate) fn taken_names(settings: &Settings<'_>, cell: &Cell) -> Vec<String> {
    let used = used_names(settings, cell).into_iter().map(|(_, name)| name);
    let mut taken = own_names();
    taken.extend(used);
    taken.extend(settings.common.profile.reserved.iter().cloned());
    taken
}

/// Names that the machine keeps for itself, against those that a program cannot change.
fn reserved(settings: &Settings<'_>, cell: &Cell, job: &str, parts: usize, findings: &mut Findings) {
    let reserved = &settings.common.profile.reserved;
    if reserved.is_empty() {
        return;
    }
    let is_own = |name: &str| {
        let numbered = [FEED, RATE, SPEED].into_iter().any(|start| {
            let rest = name.to_ascii_lowercase();
            let number = rest.strip_prefix(start).map(str::to_owned);
            number.is_some_and(|number| !number.is_empty() && number.bytes().all(|c| c.is_ascii_digit()))
        });
        numbered
            || name.eq_ignore_ascii_case(MAIN)
            || own_names().iter().any(|own| own.eq_ignore_ascii_case(name))
    };
    let main = main_name(job, &taken_names(settings, cell));
    let is_part = |name: &str| {
        let mut of_parts = (1..=parts).flat_map(|part| [part_module(&main, part), part_routine(&main, part)]);
        parts > 1 && of_parts.any(|part| part.eq_ignore_ascii_case(name))
    };
    if let Some(name) = reserved.iter().find(|name| is_own(name) || is_part(name)) {
        let key = "reserved";
        let why = format!("the program has something of the name `{name}` that cannot be called otherwise");
        findings.report(key, BackendIssue::Profile { key, why });
    }
}

fn machine(cell: &Cell, blades: &[Blade], findings: &mut Findings) {
    if cell.home.is_none() {
        findings.report("home", HOME_MISSING);
    }
    findings.generator(cell, blades);
    for (_, tool) in cell.tools.iter().filter(|(_, tool)| tool.frame.number.is_none()) {
        findings.frame(["tool X", "tool Y", "tool Z"], tool.frame, &LIMITS);
        match tool.load {
            Some(Registered::Value(carried)) => load(carried, findings),
            Some(Registered::Number(_)) | None => findings.report("load", LOAD_MISSING),
        }
    }
    findings.frame(["base X", "base Y", "base Z"], cell.base, &LIMITS);
    match cell.ready {
        Ready::Input(_) => {}
        Ready::After(time) => findings.wait(None, "time until ready", time),
    }
}

fn load(load: Load, findings: &mut Findings) {
    findings.load(load, &LIMITS);
    let Point3 { x, y, z } = load.centre;
    if [x, y, z].iter().all(|part| part.abs() < NO_DISTANCE_MM) {
        let what = "load centre of mass";
        findings.report(
            what,
            BackendIssue::OutOfRange {
                op: None,
                what,
                value: "0, 0, 0 mm".to_owned(),
                allowed: "anywhere but at the origin of the flange, such as 0, 0, 50 mm".to_owned(),
                range: None,
            },
        );
    }
}

/// The first op with a point that the robot passes without a stop, as the end of a piece of a chain or as a waypoint on it.
pub(crate) fn first_passed(program: &ReachableProgram) -> Option<OpId> {
    let is_piece = |op: OpId| {
        let action = program.program().op(op).map(|op| op.action);
        matches!(action, Some(Action::Follow { .. }))
    };
    let mut waypoints = program.motion().waypoints.iter().map(|waypoint| waypoint.op);
    let joint = first_joint(program.program());
    joint.into_iter().chain(waypoints.find(|op| is_piece(*op))).min()
}

/// Joints need a zone, and arcs points that are apart.
fn chains(program: &ReachableProgram, settings: &Settings<'_>, findings: &mut Findings) {
    if let Some(passed) = first_passed(program) {
        findings.blend(program.program(), passed);
    }
    if !has_arcs(program.program()) {
        return;
    }
    let waypoints = &program.motion().waypoints;
    for segment in program.program().segments() {
        let Some(line) = segment.line().filter(|line| line.via.is_some()) else {
            continue;
        };
        let before = waypoints.partition_point(|waypoint| waypoint.op < segment.id);
        let on_way = waypoints.iter().skip(before);
        let on_way = on_way.take_while(|waypoint| waypoint.op == segment.id);
        let (mut from, mut done) = (line.from.tip, 0.0);
        for waypoint in on_way {
            if let Some(via) = line.via_between([done, waypoint.done]) {
                arc(segment.id, [from, via, waypoint.frame.origin], settings, findings);
            }
            (from, done) = (waypoint.frame.origin, waypoint.done);
        }
        let whole = line.via.filter(|_| done == 0.0);
        if let Some(via) = whole.or_else(|| line.via_between([done, 1.0])) {
            arc(segment.id, [from, via, line.to.tip], settings, findings);
        }
    }
}

/// Limits of `MoveC` [A-INS]. An arc of more than 240 deg would be another; no blade that turns with its way goes round by more than
/// half a turn.
fn arc(op: OpId, points: [Point3; 3], settings: &Settings<'_>, findings: &mut Findings) {
    findings.printed_arc(op, points, settings.common.lengths);
    let [from, via, to] = points;
    for (what, distance) in [
        (
            "distance from where an arc begins to its middle point",
            from.distance(via),
        ),
        (
            "distance from where an arc begins to where it ends",
            from.distance(to),
        ),
    ] {
        let value = distance.to_mm();
        let unit = "mm";
        findings.range(
            Some(op),
            &Number { what, value, unit },
            (NEAREST_MM, LIMITS.farthest_mm),
        );
    }
    // From a point of a circle an arc of it is seen under half its angle.
    let circle = CircularArc::through(points.map(Point3::to_array));
    let seen = circle.map(|circle| circle.sweep() * (0.5 * (1.0 - circle.done_at(via.to_array()))));
    if let Some(seen) = seen {
        let number = Number {
            what: "angle between middle and end of an arc, seen from where it begins",
            value: seen.to_deg(),
            unit: "deg",
        };
        findings.range(Some(op), &number, (NARROWEST_DEG, 180.0));
    }
}

/// The controller refuses to turn a wrist far in one move; the motion has waypoints for that.
fn turns(program: &ReachableProgram, findings: &mut Findings) {
    let motion = program.motion();
    let mut waypoints = motion.waypoints.iter().peekable();
    let mut before: Option<AxisValues> = None;
    for ((op, of), end) in program.verified().ops().zip(&motion.ends) {
        let mut points = Vec::new();
        while let Some(waypoint) = waypoints.next_if(|waypoint| waypoint.op == op) {
            points.push(waypoint.axes);
        }
        points.push(*end);
        for point in points {
            let goes_far = before.is_some_and(|before| turn(&before, &point) >= TOO_FAR);
            if goes_far
                && !matches!(
                    of.action,
                    Action::Home | Action::ChangePlace | Action::AxisTravel { .. }
                )
            {
                let what = "a move that turns an axis of the wrist by 90 deg or more at once";
                findings.report(what, BackendIssue::Unsupported { op, what });
            }
            before = Some(point);
        }
    }
}
