//! `machine NAME = robot "model" { ... }`: the machine that carries the blade.

use super::arguments::{Arguments, Parameter, calls};
use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, Place, value};
use super::options;
use super::range::{AXIS_ANGLE, COORDINATE, FRAME_ANGLE, MASS, SIGNAL, TABLE_NUMBER, WAIT};
use super::read::{Reader, default, sourced};
use super::report::Checked;
use super::session::Session;
use crate::diag::{Code, Diagnostic};
use crate::job::{Machine, Sourced};
use crate::machine::{Model, catalogue};
use crate::source::Spanned;
use crate::syntax::ast::{Block, Expr};
use std::sync::Arc;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{AxisValues, Load, MachineKind, PlacedFrame, Ready, Registered};
use vcutc_backend_api::units::{Angle, Duration, Mass};

const FRAME: &str = "frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)";
const LOAD: &str = "load(mass = 8 kg, x = 0 mm, y = 0 mm, z = 120 mm)";
const JOINTS: &str = "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)";

const SPEC: BlockSpec = BlockSpec {
    title: "`machine`",
    fields: &[
        value("tool", FRAME),
        value(
            "base",
            "frame(x = 1800 mm, y = 0 mm, z = 700 mm, a = 0 deg, b = 0 deg, c = 0 deg)",
        ),
        value("load", LOAD),
        value("home", JOINTS),
        value("ultrasonic", "output(12)"),
        value("ready", "after(0.5 s)"),
    ],
    inner: Inner::TargetOptions,
};

/// A coordinate of a frame's origin or a load's centre.
const fn coordinate(name: &'static str) -> Parameter {
    Parameter {
        name,
        range: COORDINATE,
        typical: "0 mm",
    }
}

const FRAME_PARAMETERS: &[Parameter] = &[
    coordinate("x"),
    coordinate("y"),
    coordinate("z"),
    Parameter {
        name: "a",
        range: FRAME_ANGLE,
        typical: "0 deg",
    },
    Parameter {
        name: "b",
        range: FRAME_ANGLE,
        typical: "0 deg",
    },
    Parameter {
        name: "c",
        range: FRAME_ANGLE,
        typical: "0 deg",
    },
];

const LOAD_PARAMETERS: &[Parameter] = &[
    Parameter {
        name: "mass",
        range: MASS,
        typical: "8 kg",
    },
    coordinate("x"),
    coordinate("y"),
    coordinate("z"),
];

/// Time after which the generator counts as up, when the job does not say: a usual value, from no source. The language
/// reference asks users to measure theirs.
const SETTLED: Duration = Duration::s(0.5);

/// What the head of a machine's block says.
#[derive(Clone, Copy)]
pub(crate) struct Head<'a> {
    /// Its name.
    pub(crate) name: Spanned<&'a str>,
    /// What it is.
    pub(crate) kind: MachineKind,
    /// Its model.
    pub(crate) model: Spanned<&'a str>,
}

/// The machine.
pub(crate) fn check(
    head: &Head<'_>,
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Machine> {
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let targets = options::read(&fields.targets, scope, session);
    let mut reader = Reader {
        scope,
        reports: &mut session.reports,
    };
    let model = model(head, &mut reader);
    let tool = required_frame(&fields, "tool", &mut reader);
    let base = required_frame(&fields, "base", &mut reader);
    let load = optional(&fields, "load", &mut reader, load);
    let home = optional(&fields, "home", &mut reader, home);
    let ultrasonic = optional(&fields, "ultrasonic", &mut reader, ultrasonic);
    let ready = optional(&fields, "ready", &mut reader, ready);
    Ok(Machine {
        name: head.name.node.to_owned(),
        head_span: place.head,
        model: model?,
        model_span: head.model.span,
        tool: tool?,
        base: base?,
        load: load?,
        home: home?,
        ultrasonic: ultrasonic?,
        ready: ready?.unwrap_or(default(Ready::After(SETTLED))),
        targets: targets?,
    })
}

/// The model that the head names.
fn model(head: &Head<'_>, reader: &mut Reader<'_>) -> Checked<Arc<Model>> {
    let name = head.model.node;
    match catalogue::find(name) {
        Some(model) if model.kind() == head.kind => Ok(Arc::new(model)),
        Some(_) | None => {
            let diagnostic = Diagnostic::new(
                Code::UnknownName,
                format!("there is no robot `{name}`"),
                head.model.span,
                "not in the catalogue",
            );
            Err(reader.reports.push(diagnostic))
        }
    }
}

fn required_frame(fields: &Fields<'_>, name: &str, reader: &mut Reader<'_>) -> Checked<Sourced<PlacedFrame>> {
    let expr = fields.required_value(name, reader.reports)?;
    Ok(sourced(frame(name, expr, reader)?, expr.span))
}

fn optional<T>(
    fields: &Fields<'_>,
    name: &str,
    reader: &mut Reader<'_>,
    read: fn(&str, &Spanned<Expr>, &mut Reader<'_>) -> Checked<T>,
) -> Checked<Option<Sourced<T>>> {
    match fields.value(name)? {
        Some(expr) => Ok(Some(sourced(read(name, expr, reader)?, expr.span))),
        None => Ok(None),
    }
}

/// A number of the controller's own table, from 1.
fn registered(call: &Arguments<'_>, reader: &mut Reader<'_>) -> Checked<u32> {
    let number = call.single(reader.reports)?;
    reader.whole(number, TABLE_NUMBER, "a number of the controller's table")
}

fn frame(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<PlacedFrame> {
    const CALLS: &[(&str, &str)] = &[("frame", FRAME)];
    let call = calls(field, expr, CALLS, reader.reports)?;
    let [x, y, z, a, b, c] = call.named(FRAME_PARAMETERS, reader)?;
    let angles = Zyx {
        a: Angle::rad(a),
        b: Angle::rad(b),
        c: Angle::rad(c),
    };
    Ok(PlacedFrame {
        frame: Frame {
            origin: Point3::new(x, y, z),
            orientation: Orientation::from_zyx(angles),
        },
        number: None,
    })
}

fn load(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Registered<Load>> {
    const CALLS: &[(&str, &str)] = &[("load", LOAD), ("number", "number(2)")];
    let call = calls(field, expr, CALLS, reader.reports)?;
    if call.function == "number" {
        return registered(&call, reader).map(Registered::Number);
    }
    let [mass, x, y, z] = call.named(LOAD_PARAMETERS, reader)?;
    Ok(Registered::Value(Load {
        mass: Mass::kg(mass),
        centre: Point3::new(x, y, z),
    }))
}

fn home(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<AxisValues> {
    let call = calls(field, expr, &[("joints", JOINTS)], reader.reports)?;
    let angles: [f64; 6] = call.listed(AXIS_ANGLE, "the angle of an axis", reader)?;
    Ok(AxisValues(angles))
}

fn ultrasonic(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<u32> {
    let call = calls(field, expr, &[("output", "output(12)")], reader.reports)?;
    let number = call.single(reader.reports)?;
    reader.whole(number, SIGNAL, "the number of an output")
}

fn ready(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Ready> {
    const CALLS: &[(&str, &str)] = &[("input", "input(7)"), ("after", "after(0.5 s)")];
    let call = calls(field, expr, CALLS, reader.reports)?;
    let value = call.single(reader.reports)?;
    if call.function == "input" {
        return reader
            .whole(value, SIGNAL, "the number of an input")
            .map(Ready::Input);
    }
    let time = reader.within(value, WAIT, "`after`", Some("0.5 s"))?;
    Ok(Ready::After(Duration::s(time)))
}
