//! The part of a sheet that describes a five-axis machine: which rotary axes it has and where, and what its axes can do.
//!
//! ```toml
//! [arrangement]
//! head = ["b", "a"]   # from the frame outwards: B carries A
//! table = []          # from the frame to the work
//! spindle = "s"       # an orientable spindle; left out without one
//! nose_mm = [0.0, 0.0, 0.0]
//! mount_mm = [0.0, 0.0, -800.0]
//!
//! [axis.x]
//! travel_mm = [-1000.0, 1000.0]
//! rate_mm_s = 500.0
//! acceleration_mm_s2 = 3000.0
//!
//! [axis.b]
//! about = "+Y"
//! centre_mm = [0.0, 0.0, 250.0]
//! range_deg = [-110.0, 110.0]
//! rate_deg_s = 90.0
//! ```
//!
//! All positions are seen from the machine frame with all axes at zero, see [`FiveAxis`].

use super::types::{Body, Form};
use crate::facts::Sources;
use crate::kinematics::Mechanism;
use crate::kinematics::five_axis::{Arrangement, Direction, FiveAxis, Rotary, SpindleSense, Unfit};
use crate::ranges::{
    ANGLE, LENGTH, SLIDING_ACCELERATION, SLIDING_JERK, SLIDING_RATE, TURNING_ACCELERATION, TURNING_JERK,
    TURNING_RATE,
};
use glam::DVec3;
use vcutc_backend_api::ir::{Axis, AxisKind, Maker};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, block, optional, value};
use vcutc_diagnostics::source::Span;

/// Sheets of five-axis machines.
pub(super) const FORM: Form = Form {
    fields: &[
        block("arrangement", "[arrangement]").required(),
        block("axis", "[axis.x]").required(),
    ],
    read,
};

const ARRANGEMENT: &[FieldSpec] = &[
    value("head", "[\"b\", \"a\"]").required(),
    value("table", "[]").required(),
    optional("spindle"),
    value("nose_mm", "[0.0, 0.0, 0.0]").required().within(LENGTH),
    value("mount_mm", "[0.0, 0.0, -800.0]").required().within(LENGTH),
    optional("source"),
    optional("note"),
];

/// Names that rotary axes may have. What an axis turns about is not said by its name but by `about`: a machine can have two
/// called C.
const ROTARY_NAMES: &[&str] = &["a", "b", "c", "s"];
const LINEAR_NAMES: [&str; 3] = ["x", "y", "z"];

const LINEAR: &[FieldSpec] = &[
    value("travel_mm", "[-1000.0, 1000.0]").required().within(LENGTH),
    optional("rate_mm_s").within(SLIDING_RATE),
    optional("acceleration_mm_s2").within(SLIDING_ACCELERATION),
    optional("jerk_mm_s3").within(SLIDING_JERK),
    optional("source"),
];
const RANGE: FieldSpec = value("range_deg", "[-110.0, 110.0]").required().within(ANGLE);
const RATE: FieldSpec = optional("rate_deg_s").within(TURNING_RATE);
const ACCELERATION: FieldSpec = optional("acceleration_deg_s2").within(TURNING_ACCELERATION);
const JERK: FieldSpec = optional("jerk_deg_s3").within(TURNING_JERK);
const ROTARY: &[FieldSpec] = &[
    value("about", "\"+Y\"").required(),
    value("centre_mm", "[0.0, 0.0, 250.0]").required().within(LENGTH),
    RANGE,
    RATE,
    ACCELERATION,
    JERK,
    optional("source"),
];
const SPINDLE: &[FieldSpec] = &[
    value("about", "\"+Z\"").required(),
    RANGE,
    RATE,
    ACCELERATION,
    JERK,
    optional("source"),
];

const DIRECTIONS: &[(&str, Direction)] = &[
    ("+X", Direction::PlusX),
    ("-X", Direction::MinusX),
    ("+Y", Direction::PlusY),
    ("-Y", Direction::MinusY),
    ("+Z", Direction::PlusZ),
    ("-Z", Direction::MinusZ),
];
const SENSES: &[(&str, SpindleSense)] = &[("+Z", SpindleSense::PlusZ), ("-Z", SpindleSense::MinusZ)];

/// Longest travel of a linear axis in mm.
const LONGEST_TRAVEL: f64 = 200_000.0;
/// Two turns, as for robots.
const WIDEST_RANGE: f64 = 720.0;

/// The names of the rotary axes by where they are.
struct Names<'t> {
    head: Vec<&'t str>,
    table: Vec<&'t str>,
    spindle: Option<&'t str>,
}

impl Names<'_> {
    /// Where in `[arrangement]` an axis is named; the last place if it has several.
    fn place(&self, table: &Table<'_>, name: &str) -> Span {
        table.span_of(if self.spindle == Some(name) {
            "spindle"
        } else if self.table.contains(&name) {
            "table"
        } else {
            "head"
        })
    }
}

fn read(root: &Table<'_>, _: Maker, faults: &mut Vec<Diagnostic>) -> Option<Body> {
    let mut body = Body::default();
    let table = root.table("arrangement", ARRANGEMENT, faults)?;
    body.sources
        .push(Sources::read("arrangement", &table, "source", faults));
    body.remarks.extend(table.text("note", faults).map(str::to_owned));
    let names = names(&table, faults);
    let nose = table.numbers("nose_mm", faults).map(DVec3::from_array);
    let mount = table.numbers("mount_mm", faults).map(DVec3::from_array);
    let names = names?;
    let axes = axis_tables(root, &names, faults)?;
    let linear = LINEAR_NAMES.map(|name| linear_axis(&axes, name, faults));
    let mut rotary = |name: &&str| rotary_axis(&axes, name, faults);
    let head: Vec<_> = names.head.iter().map(&mut rotary).collect();
    let below: Vec<_> = names.table.iter().map(&mut rotary).collect();
    let spindle = names.spindle.map(|name| spindle_axis(&axes, name, faults));
    let (mut rotaries, mut parts) = (Vec::new(), linear.into_iter().collect::<Option<Vec<Axis>>>()?);
    for found in head.into_iter().chain(below) {
        let (rotary, axis) = found?;
        rotaries.push(rotary);
        parts.push(axis);
    }
    let sense = match spindle {
        Some(found) => {
            let (sense, axis) = found?;
            parts.push(axis);
            Some(sense)
        }
        None => None,
    };
    body.axes = parts;
    let arrangement = arranged(&names, &rotaries)?;
    match FiveAxis::new(arrangement, sense, nose?, mount?) {
        Ok(machine) => body.mechanism = Some(Mechanism::FiveAxis(machine)),
        Err(unfit) => faults.push(cannot_tilt(&table, &names, unfit)),
    }
    Some(body)
}

fn names<'t>(table: &Table<'t>, faults: &mut Vec<Diagnostic>) -> Option<Names<'t>> {
    let before = faults.len();
    let names = Names {
        head: table.names("head", faults),
        table: table.names("table", faults),
        spindle: table.text("spindle", faults),
    };
    let count = names.head.len() + names.table.len();
    if faults.len() == before && count != 2 {
        faults.push(
            table
                .fault(
                    table.span_of("head"),
                    format!("head and table have {count} rotary axes together, a five-axis machine has 2"),
                    format!("with `table`, {count} rotary axes"),
                )
                .help(
                    "name two in `head` and `table`; one that turns the blade about itself goes to `spindle`",
                ),
        );
        return None;
    }
    let all = || names.head.iter().chain(&names.table).chain(&names.spindle);
    if let Some(name) = all().find(|name| !ROTARY_NAMES.contains(name)) {
        faults.push(
            table
                .fault(
                    names.place(table, name),
                    format!("a rotary axis cannot be called \"{name}\""),
                    "names a rotary axis",
                )
                .help(format!("call rotary axes one of {}", ROTARY_NAMES.join(", "))),
        );
    }
    if let Some(name) = all().find(|name| all().filter(|other| other == name).count() > 1) {
        faults.push(
            table
                .fault(
                    names.place(table, name),
                    format!("two rotary axes are called \"{name}\""),
                    "names an axis that has that name",
                )
                .help("give each axis its own name; an orientable spindle can be called \"s\""),
        );
    }
    (faults.len() == before).then_some(names)
}

/// `[axis]` with a table for each axis of the arrangement.
fn axis_tables<'t>(root: &Table<'t>, names: &Names<'t>, faults: &mut Vec<Diagnostic>) -> Option<Table<'t>> {
    let rotary = names.head.iter().chain(&names.table).chain(&names.spindle);
    let known: Vec<&str> = LINEAR_NAMES.iter().chain(rotary).copied().collect();
    let axes = root.loose_table("axis", faults)?;
    axes.allow(&known, faults);
    let before = faults.len();
    for name in known.iter().filter(|name| !axes.has(name)) {
        faults.push(
            root.fault(
                root.span_of("axis"),
                format!("the sheet lacks `[axis.{name}]`"),
                format!("no axis {}", name.to_uppercase()),
            )
            .help(format!("add a table `[axis.{name}]` with its range")),
        );
    }
    (faults.len() == before).then_some(axes)
}

fn linear_axis(axes: &Table<'_>, name: &str, faults: &mut Vec<Diagnostic>) -> Option<Axis> {
    let table = axes.table(name, LINEAR, faults)?;
    let range = table.range("travel_mm", LONGEST_TRAVEL, faults);
    let keys = ["rate_mm_s", "acceleration_mm_s2", "jerk_mm_s3"];
    let [rate, acceleration, jerk] = keys.map(|key| given(&table, key, faults));
    let (min, max) = range?;
    Some(Axis {
        name: name.to_uppercase(),
        kind: AxisKind::Linear,
        min,
        max,
        rate: rate?,
        acceleration: acceleration?,
        jerk: jerk?,
    })
}

fn rotary_axis(axes: &Table<'_>, name: &str, faults: &mut Vec<Diagnostic>) -> Option<(Rotary, Axis)> {
    let table = axes.table(name, ROTARY, faults)?;
    let about = table.word("about", DIRECTIONS, faults);
    let centre = table.numbers("centre_mm", faults);
    let axis = turning_axis(&table, name, faults);
    let rotary = Rotary {
        about: about?,
        centre: DVec3::from_array(centre?),
    };
    Some((rotary, axis?))
}

fn spindle_axis(axes: &Table<'_>, name: &str, faults: &mut Vec<Diagnostic>) -> Option<(SpindleSense, Axis)> {
    let table = axes.table(name, SPINDLE, faults)?;
    let sense = table.word("about", SENSES, faults);
    let axis = turning_axis(&table, name, faults);
    Some((sense?, axis?))
}

fn turning_axis(table: &Table<'_>, name: &str, faults: &mut Vec<Diagnostic>) -> Option<Axis> {
    let range = table.range(RANGE.name, WIDEST_RANGE, faults);
    let numbers = [RATE, ACCELERATION, JERK].map(|field| given(table, field.name, faults));
    let [rate, acceleration, jerk] = numbers.map(|number| Some(number?.map(f64::to_radians)));
    let (min, max) = range?;
    Some(Axis {
        name: name.to_uppercase(),
        kind: AxisKind::Rotary,
        min: min.to_radians(),
        max: max.to_radians(),
        rate: rate?,
        acceleration: acceleration?,
        jerk: jerk?,
    })
}

/// A number that may be left out; none when it is there and faulty.
fn given(table: &Table<'_>, key: &str, faults: &mut Vec<Diagnostic>) -> Option<Option<f64>> {
    if table.has(key) {
        table.number(key, faults).map(Some)
    } else {
        Some(None)
    }
}

/// Two rotary axes in the places that their names have; none for another number of them.
fn arranged(names: &Names<'_>, rotaries: &[Rotary]) -> Option<Arrangement> {
    let &[first, second] = rotaries else { return None };
    match names.head.len() {
        2 => Some(Arrangement::HeadHead([first, second])),
        1 => Some(Arrangement::HeadTable {
            head: first,
            table: second,
        }),
        0 => Some(Arrangement::TableTable([first, second])),
        _ => None,
    }
}

fn cannot_tilt(table: &Table<'_>, names: &Names<'_>, unfit: Unfit) -> Diagnostic {
    let at_blade = match names.head.len() {
        0 => names.table.first(),
        _ => names.head.last(),
    };
    let at_blade = at_blade.copied().unwrap_or_default();
    let name = at_blade.to_uppercase();
    match unfit {
        Unfit::Parallel => table.fault(
            names.place(table, at_blade),
            "the two rotary axes are parallel, so the blade tilts in only one direction",
            "parallel axes",
        )
        .help("write `about` of one of them along another axis of the machine"),
        Unfit::AlongSpindle => table.fault(
            names.place(table, at_blade),
            format!("axis {name} lies along the spindle, so the blade tilts in only one direction"),
            format!("{name} does not tilt the blade"),
        )
        .help(format!(
            "let the other rotary axis be carried by {name} if that is how it is built, or name {name} as `spindle`"
        )),
    }
}

#[cfg(test)]
mod tests;
