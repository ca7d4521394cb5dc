//! What has to be set up before a program runs, as names and values: the same on the page and on the set-up
//! sheet.

use super::Material;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{
    Action, AxisKind, Change, Changer, Edges, Load, OperationId, Program, Ready, Registered,
};
use vcutc_backend_api::units::Speed;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_job::description::speed_text;
use vcutc_job::{BladeRef, Body, CheckedJob, HeldTool, Machine, Setup, StraightBlade};

/// A name and a value, as plain text.
pub(super) type Fact = (&'static str, String);

/// The size of the stock.
pub(super) fn stock(job: &CheckedJob) -> Vec<Fact> {
    let stock = job.stock;
    let [x, y, z] = [stock.width, stock.depth, stock.height].map(|length| show(length.to_mm()));
    vec![("stock x, y, z", format!("{x} x {y} x {z} mm"))]
}

/// Where the work is.
pub(super) fn base(machine: Option<&Machine>) -> Vec<Fact> {
    let base = machine.map_or_else(
        || "the job has no machine".to_owned(),
        |machine| frame(&machine.base.value.frame),
    );
    vec![("base frame", base)]
}

fn frame(frame: &Frame) -> String {
    let (origin, turn) = (frame.origin, frame.orientation.to_zyx());
    let [a, b, c] = [turn.a, turn.b, turn.c].map(|angle| show(angle.to_deg()));
    let [x, y, z] = [origin.x, origin.y, origin.z].map(show);
    format!("x {x}, y {y}, z {z}; a {a}, b {b}, c {c}")
}

/// The blades of a job, each once.
pub(super) fn blades<'a>(material: &Material<'a>) -> Vec<BladeRef<'a>> {
    let mut named: Vec<BladeRef<'_>> = Vec::new();
    for blade in material
        .plan
        .operations
        .iter()
        .flat_map(|planned| planned.asked().blades())
    {
        if named.iter().all(|other| other.name() != blade.name()) {
            named.push(blade);
        }
    }
    named
}

pub(super) fn of_blades(blades: &[BladeRef<'_>]) -> Vec<Fact> {
    blades.iter().map(|blade| ("blade", words(*blade))).collect()
}

/// How the blade is mounted.
pub(super) fn tool(material: &Material<'_>) -> Vec<Fact> {
    let Some(machine) = &material.job.machine else {
        return Vec::new();
    };
    let several = machine.tools.iter().count() > 1;
    let round: Vec<&str> = blades(material)
        .into_iter()
        .filter(|blade| !matches!(blade, BladeRef::Straight(_)))
        .map(|blade| blade.name())
        .collect();
    let held = |tool: &HeldTool| {
        let of = (tool.blade.as_ref()).map_or_else(String::new, |blade| format!("{}: ", blade.node));
        let placed = &tool.frame.value.frame;
        // A blade that stays where it is needs no place in a changer.
        let place = tool.place.filter(|_| several);
        let place = place.map_or_else(String::new, |place| format!("; place {}", place.value));
        let mut list = vec![("tool frame", format!("{of}{}{place}", frame(placed)))];
        // A round blade has no leading edge and no flat.
        let is_round = (tool.blade.as_ref()).is_some_and(|blade| round.contains(&blade.node.as_str()));
        if !is_round {
            let [edge, flat, tip] = axes(placed);
            list.push((
                "tool axes",
                format!(
                    "{of}x (edge) {edge}; y (flat) {flat}; z (out of the tip) {tip}, seen from the flange"
                ),
            ));
        }
        list
    };
    machine.tools.iter().flat_map(held).collect()
}

/// `8 kg at x 0, y 0, z 120 mm`: a load, with its moments of inertia where it states some.
pub(crate) fn carried(load: Registered<Load>) -> String {
    match load {
        Registered::Number(number) => format!("number {number} of the controller"),
        Registered::Value(load) => {
            let [x, y, z] = [load.centre.x, load.centre.y, load.centre.z].map(show);
            let moments = load.inertia.map_or_else(String::new, |inertia| {
                let [x, y, z] = inertia.to_array().map(|moment| rounded(moment, 1e6));
                format!(", {x}, {y} and {z} kg m2 about x, y and z")
            });
            format!(
                "{} kg at x {x}, y {y}, z {z} mm{moments}",
                show(load.mass.to_kg())
            )
        }
    }
}

/// How blades are changed: which one is there at first, how often another one comes, and by whom.
fn changed(change: Change, program: &Program) -> String {
    let by = match change.by {
        Changer::Program => "by the program",
        Changer::Hand => "by hand",
    };
    let time = show(change.time.to_s());
    match (program.blades.first(), changes(program)) {
        (None, _) | (_, 0) => format!("changed {by} in {time} s"),
        (Some(first), 1) => format!("{} first; 1 change {by} in {time} s", first.name),
        (Some(first), count) => format!("{} first; {count} changes {by}, {time} s each", first.name),
    }
}

/// How often a program changes the blade.
pub(super) fn changes(program: &Program) -> usize {
    let ops = program.ops.iter();
    ops.filter(|op| matches!(op.action, Action::ToolChange { .. }))
        .count()
}

fn words(blade: BladeRef<'_>) -> String {
    let measures = match blade {
        BladeRef::Straight(blade) => straight(blade),
        BladeRef::Disc(disc) => format!(
            "disc of radius {} mm, {} mm thick, {} rev/min",
            show(disc.radius.value.to_mm()),
            show(disc.thickness.value.to_mm()),
            show(disc.spin.value.to_rev_per_min())
        ),
        BladeRef::Crusher(crusher) => format!(
            "crusher of radius {} mm, {} mm high, {} rev/min",
            show(crusher.radius.value.to_mm()),
            show(crusher.height.value.to_mm()),
            show(crusher.spin.value.to_rev_per_min())
        ),
    };
    let body = blade.body().map_or_else(String::new, body);
    format!("{}: {measures}{body}", blade.name())
}

fn straight(blade: &StraightBlade) -> String {
    let edges = match blade.edges {
        Edges::Single => "single",
        Edges::Double => "double",
    };
    format!(
        "{edges} edge {} mm long, half apex {} deg, {} mm thick",
        show(blade.cutting_length.value.to_mm()),
        show(blade.half_apex.value.to_deg()),
        show(blade.thickness.value.to_mm())
    )
}

/// `; body of radius 8 mm from 40 mm on, 30 mm from 90 mm on`.
fn body(body: &Body) -> String {
    let stages = body.stages.iter().map(|stage| {
        let (from, radius) = (stage.from.value.to_mm(), stage.radius.value.to_mm());
        format!("{} mm from {} mm on", show(radius), show(from))
    });
    format!("; body of radius {}", stages.collect::<Vec<_>>().join(", "))
}

/// Where x, y and z of a tool point, seen from the flange.
fn axes(tool: &Frame) -> [String; 3] {
    let matrix = tool.orientation.matrix();
    [0, 1, 2].map(|column| direction(matrix.map(|row| row[column])))
}

/// A direction in words: an axis where it is one within half a degree.
fn direction(parts: [f64; 3]) -> String {
    // The cosine of half a degree.
    const NEARLY: f64 = 0.999_962;
    let along = ["x", "y", "z"]
        .into_iter()
        .zip(parts)
        .find(|(_, part)| part.abs() > NEARLY);
    match along {
        Some((name, part)) if part > 0.0 => format!("+{name}"),
        Some((name, _)) => format!("-{name}"),
        None => {
            let [x, y, z] = parts.map(|part| format!("{:.2}", part + 0.0));
            format!("({x}, {y}, {z})")
        }
    }
}

/// What is wired, weighed and taught: generator, load, changes of blade and home.
pub(super) fn control(material: &Material<'_>) -> Vec<Fact> {
    let Some(machine) = material.job.machine.as_ref() else {
        return Vec::new();
    };
    let output = machine.ultrasonic.map_or_else(
        || "no output given".to_owned(),
        |output| format!("output {}", output.value),
    );
    let ready = match machine.ready.value {
        Ready::Input(number) => format!("ready at input {number}"),
        Ready::After(time) => format!("ready {} s after switching on", show(time.to_s())),
    };
    let mut list = vec![("generator", format!("{output}, {ready}"))];
    list.extend(
        machine
            .spindle
            .map(|output| ("spindle", format!("output {}", output.value))),
    );
    for tool in machine.tools.iter() {
        let of = (tool.blade.as_ref()).map_or_else(String::new, |blade| format!("{}: ", blade.node));
        list.extend(
            tool.load
                .map(|load| ("load", format!("{of}{}", carried(load.value)))),
        );
    }
    let program = material.compiled.program.verified().program();
    list.extend((machine.change).map(|held| ("blades", changed(held.change, program))));
    list.extend(machine.home.map(|home| {
        let axes = machine.model.axes.iter().zip(home.value.0);
        let values = axes.map(|(axis, value)| match axis.kind {
            AxisKind::Rotary => format!("{} {}", axis.name, show(value.to_degrees())),
            AxisKind::Linear => format!("{} {} mm", axis.name, show(value)),
        });
        ("home", values.collect::<Vec<_>>().join(", "))
    }));
    list
}

/// The speeds of all operations, each set once.
pub(super) fn speeds(material: &Material<'_>) -> Vec<Fact> {
    let program = material.compiled.program.verified().program();
    let mut list: Vec<Fact> = Vec::new();
    for (operation, planned) in (0..).zip(&material.plan.operations) {
        let Setup {
            cut_feed,
            travel_feed,
            reorient_rate,
            clearance,
            ..
        } = planned.asked().setup();
        let words = format!(
            "cut {}, travel {} mm/s, turn {} deg/s; clearance {} mm",
            cutting(program, OperationId(operation), cut_feed.value),
            show(travel_feed.value.to_mm_per_s()),
            show(reorient_rate.value.to_deg_per_s()),
            show(clearance.value.to_mm())
        );
        if list.iter().all(|(_, known)| *known != words) {
            list.push(("speeds", words));
        }
    }
    list
}

/// How fast an operation cuts: of several blades with each of them, else as its setup says.
fn cutting(program: &Program, operation: OperationId, set: Speed) -> String {
    if program.blades_of(operation).count() < 2 {
        return speed_text(set);
    }
    let mut words: Vec<String> = Vec::new();
    for segment in program.segments() {
        let feed = match segment.op.action {
            Action::Cut { feed, .. } | Action::Follow { feed, .. } => feed,
            Action::Home
            | Action::Travel { .. }
            | Action::AxisTravel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Turn { .. }
            | Action::Ultrasonic { .. }
            | Action::Spin { .. }
            | Action::AwaitReady
            | Action::Dwell { .. }
            | Action::ChangePlace
            | Action::ToolChange { .. } => continue,
        };
        let with = (program.feed(feed).zip(program.blade(segment.before.tool)))
            .map(|(feed, blade)| format!("{} with {}", speed_text(feed), blade.name));
        if segment.op.site.operation() == Some(operation)
            && let Some(with) = with
            && !words.contains(&with)
        {
            words.push(with);
        }
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_axes_where_they_are() {
        assert_eq!(direction([0.0, -1.0, 0.0]), "-y");
        assert_eq!(direction([1.0, 0.001, 0.0]), "+x");
        assert_eq!(direction([0.6, 0.0, -0.8]), "(0.60, 0.00, -0.80)");
    }
}
