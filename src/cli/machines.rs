//! `vcutc machines`: the machines of the catalogue, and what is known about one of them or about one of a user's file.

mod mechanism;
mod text;

use super::Exit;
use super::console::{Console, Failure};
use super::files::Disk;
use serde_json::{Value, json};
use vcutc_backend_api::ir::{Axis, AxisKind, MachineKind, Maker};
use vcutc_diagnostics::source::{Loader, SourceMap, text_from_bytes};
use vcutc_machine::catalogue::Summary;
use vcutc_machine::facts::{Facts, FkCheck};
use vcutc_machine::masses::{Covered, Masses, Torques};
use vcutc_machine::path_limits::PathLimits;
use vcutc_machine::sheet::{self, Sheet};
use vcutc_machine::{self as machine, FileKind, Model, Origin, catalogue};

/// Version of the JSON objects that describe machines and their poses.
pub(super) const SCHEMA: u32 = 1;

/// Prints the list, or one machine.
pub(super) fn machines(name: Option<&str>, console: &Console) -> Exit {
    match name {
        None => list(&catalogue::summaries(), console),
        Some(part) if !matching(part).is_empty() => list(&matching(part), console),
        Some(name) => match description(name, console) {
            Ok(description) => show(&description, console),
            Err(exit) => exit,
        },
    }
}

/// The machine of a name of the catalogue or of a file. What is wrong has been reported when there is none.
pub(super) fn load(name: &str, console: &Console) -> Result<Model, Exit> {
    description(name, console).map(|description| description.model)
}

/// A machine, and what else its sheet says if it has one.
struct Description {
    model: Model,
    sheet: Option<Sheet>,
}

impl Description {
    fn of_sheet(sheet: Sheet, name: &str) -> Self {
        Self {
            model: sheet.machine(name),
            sheet: Some(sheet),
        }
    }
}

fn description(name: &str, console: &Console) -> Result<Description, Exit> {
    match Origin::of(name) {
        Origin::Catalogue => match catalogue::sheet(name) {
            Some(sheet) => Ok(Description::of_sheet(sheet, name)),
            None => Err(console.failure(&unknown(name))),
        },
        Origin::File(kind) => of_file(name, kind, console),
    }
}

fn unknown(name: &str) -> Failure {
    let failure = Failure::new(format!("there is no machine `{name}` in the catalogue"));
    let near: Vec<String> = catalogue::near(name)
        .iter()
        .map(|near| format!("`{near}`"))
        .collect();
    let failure = if near.is_empty() {
        failure
    } else {
        failure.help(format!("did you mean {}?", near.join(" or ")))
    };
    failure.help("run `vcutc machines` for the list; names of files end in `.toml` or `.urdf`")
}

fn of_file(path: &str, kind: FileKind, console: &Console) -> Result<Description, Exit> {
    let refuse = |reason: String| console.failure(&Failure::new(format!("cannot read `{path}`: {reason}")));
    let disk = Disk::around(path);
    let bytes = disk.load(disk.job()).map_err(|error| refuse(error.to_string()))?;
    let text = text_from_bytes(bytes).map_err(|at| {
        refuse(format!(
            "it is not a UTF-8 text file, byte {} is not valid",
            at + 1
        ))
    })?;
    let mut sources = SourceMap::default();
    let file = sources.add(path, text.clone());
    let description = match kind {
        FileKind::Sheet => sheet::parse(file, &text).map(|sheet| Description::of_sheet(sheet, path)),
        FileKind::Urdf => {
            let model = machine::read(path, kind, file, &text);
            model.map(|model| Description { model, sheet: None })
        }
    };
    description.map_err(|faults| {
        console.diagnostics(&faults, &sources);
        Exit::JobHasErrors
    })
}

/// The machines whose name or model holds a word that is the name of none of them.
fn matching(part: &str) -> Vec<Summary> {
    if catalogue::text(part).is_some() || matches!(Origin::of(part), Origin::File(_)) {
        return Vec::new();
    }
    let part = part.to_lowercase();
    let holds = |text: &str| text.to_lowercase().contains(&part);
    let all = catalogue::summaries().into_iter();
    all.filter(|summary| holds(summary.name) || holds(&summary.model))
        .collect()
}

fn list(summaries: &[Summary], console: &Console) -> Exit {
    if !console.speaks_json() {
        return console.document(&text::list(summaries));
    }
    let lines = summaries.iter().map(|summary| {
        let line = json!({
            "kind": "machine",
            "schema": SCHEMA,
            "name": summary.name,
            "is": kind_word(summary.kind),
            "model": summary.model,
            "payload_kg": summary.payload,
            "reach_mm": summary.reach,
            "confidence": summary.confidence.map(sheet::Confidence::word),
        });
        format!("{line}\n")
    });
    console.document(&lines.collect::<String>())
}

fn show(description: &Description, console: &Console) -> Exit {
    if console.speaks_json() {
        console.document(&format!("{}\n", in_json(description)))
    } else {
        console.document(&text::machine(description))
    }
}

/// The word for a kind in jobs.
const fn kind_word(kind: MachineKind) -> &'static str {
    match kind {
        MachineKind::Robot => "robot",
        MachineKind::FiveAxis => "five_axis",
    }
}

const fn maker_word(maker: Maker) -> &'static str {
    match maker {
        Maker::Abb => "ABB",
        Maker::Kuka => "KUKA",
        Maker::Other => "other",
    }
}

fn in_json(description: &Description) -> Value {
    let Description { model, sheet } = description;
    let mut value = json!({
        "kind": "machine",
        "schema": SCHEMA,
        "name": model.name,
        "is": kind_word(model.kind()),
        "maker": maker_word(model.maker),
        "axes": model.axes.iter().map(axis_in_json).collect::<Vec<_>>(),
        "mechanism": mechanism::in_json(&model.mechanism),
        "path": path_in_json(&model.path),
    });
    if let (Some(sheet), Some(object)) = (sheet, value.as_object_mut()) {
        let more = [
            ("model", json!(sheet.model)),
            ("manufacturer", json!(sheet.manufacturer)),
            ("payload_kg", json!(sheet.payload.rated)),
            (
                "wrist_inertia_limit_kg_m2",
                json!(sheet.payload.wrist.map(|wrist| [wrist.axis_5, wrist.axis_6])),
            ),
            ("confidence", json!(sheet.confidence.map(sheet::Confidence::word))),
            ("facts", facts_in_json(&sheet.facts)),
            ("masses", json!(sheet.masses.as_ref().map(masses_in_json))),
            ("torques", json!(sheet.torques.as_ref().map(torques_in_json))),
        ];
        object.extend(more.map(|(key, value)| (key.to_owned(), value)));
    }
    value
}

fn axis_in_json(axis: &Axis) -> Value {
    let unit = axis_unit(axis);
    json!({
        "name": axis.name,
        "unit": unit.name,
        "min": unit.of(axis.min),
        "max": unit.of(axis.max),
        "rate": axis.rate.map(|rate| unit.of(rate)),
        "acceleration": axis.acceleration.map(|acceleration| unit.of(acceleration)),
        "jerk": axis.jerk.map(|jerk| unit.of(jerk)),
    })
}

/// An object with a key for each number that is known.
fn path_in_json(path: &PathLimits) -> Value {
    let known = path_numbers(path)
        .into_iter()
        .filter_map(|number| Some((number.key.to_owned(), json!(number.value?))));
    Value::Object(known.collect())
}

/// A number of the controller's planner.
struct PathNumber {
    /// As sheets call it.
    key: &'static str,
    /// For people.
    words: &'static str,
    unit: &'static str,
    value: Option<f64>,
}

fn path_numbers(path: &PathLimits) -> [PathNumber; 4] {
    let number = |key, words, unit, value| PathNumber {
        key,
        words,
        unit,
        value,
    };
    let degrees = |value: Option<f64>| value.map(|value| DEGREES.of(value));
    [
        number("acceleration_mm_s2", "acceleration", "mm/s2", path.acceleration),
        number("jerk_mm_s3", "jerk", "mm/s3", path.jerk),
        number(
            "turning_acceleration_deg_s2",
            "acceleration of turning",
            "deg/s2",
            degrees(path.turning_acceleration),
        ),
        number(
            "turning_jerk_deg_s3",
            "jerk of turning",
            "deg/s3",
            degrees(path.turning_jerk),
        ),
    ]
}

/// The unit in which people read an axis.
pub(super) struct Unit {
    pub(super) name: &'static str,
    pub(super) size: f64,
}

impl Unit {
    /// A value in this unit, free of what the conversion has added in the last digits.
    pub(super) fn of(&self, value: f64) -> f64 {
        const STEPS: f64 = 1e9;
        (value / self.size * STEPS).round() / STEPS
    }
}

const DEGREES: Unit = Unit {
    name: "deg",
    size: core::f64::consts::PI / 180.0,
};

const MILLIMETRES: Unit = Unit {
    name: "mm",
    size: 1.0,
};

pub(super) const fn axis_unit(axis: &Axis) -> Unit {
    match axis.kind {
        AxisKind::Rotary => DEGREES,
        AxisKind::Linear => MILLIMETRES,
    }
}

fn facts_in_json(facts: &Facts) -> Value {
    let sources = facts.sources.iter().filter(|sources| !sources.list.is_empty());
    let sources: Vec<Value> = sources
        .map(|sources| json!({ "of": sources.of, "list": sources.list }))
        .collect();
    json!({
        "sources": sources,
        "remarks": facts.remarks,
        "wrist_reach_mm": facts.wrist_reach,
        "designated_reach_mm": facts.designated_reach,
        "disagreements": facts.disagreements,
        "fk_checks": facts.fk_checks.iter().map(check_in_json).collect::<Vec<_>>(),
    })
}

fn check_in_json(check: &FkCheck) -> Value {
    json!({
        "joints_deg": check.joints_deg,
        "xyz_mm": check.xyz_mm,
        "quat_wxyz": check.quaternion,
        "position_tolerance_mm": check.position_tolerance_mm,
        "rotation_tolerance_deg": check.rotation_tolerance_deg,
        "source": check.source,
        "independence": check.independence,
        "note": check.note,
    })
}

fn masses_in_json(masses: &Masses) -> Value {
    let links: Vec<Value> = masses
        .links
        .iter()
        .map(|link| {
            let [x, y, z] = link.inertia.to_cols_array_2d();
            json!({
                "name": link.name,
                "mass_kg": link.mass,
                "com_mm": link.centre_mm.to_array(),
                "inertia_kg_m2": { "xx": x[0], "yy": y[1], "zz": z[2], "xy": x[1], "xz": x[2], "yz": y[2] },
            })
        })
        .collect();
    let covered = masses.covered.iter().copied().map(Covered::word);
    json!({
        "confidence": masses.backing.word(),
        "complete": covered.collect::<Vec<_>>(),
        "note": masses.note,
        "source": masses.sources,
        "total_mass_kg": masses.total_mass,
        "links": links,
    })
}

fn torques_in_json(torques: &Torques) -> Value {
    json!({
        "limits_nm": torques.limits,
        "confidence": torques.backing.word(),
        "source": torques.sources,
    })
}

/// Numbers with blanks between them.
fn row(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
    numbers.join(" ")
}
