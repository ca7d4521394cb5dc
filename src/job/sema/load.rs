//! What the flange carries: `load = load(mass = ..., ...)` or `load = number(2)`, and whether the machine may carry it.

use super::arguments::{Parameter, calls};
use super::field_ranges::{INERTIA, MASS};
use super::frame::{coordinate, table_number};
use super::read::Reader;
use super::report::{Checked, Reports};
use crate::HeldTools;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Inertia, Load, Registered};
use vcutc_backend_api::units::Mass;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_machine::Model;
use vcutc_machine::payload::{Excess, Turned};
use vcutc_syntax::ast::Expr;

/// What a load looks like.
pub(crate) const LOAD: &str = "load(mass = 8 kg, x = 0 mm, y = 0 mm, z = 120 mm)";

/// How a load is stated.
pub(crate) const LOADS: &[(&str, &str)] = &[("load", LOAD), ("number", "number(2)")];

const POINT: [Parameter<'_>; 4] = [
    Parameter {
        name: "mass",
        range: MASS,
        typical: "8 kg",
    },
    coordinate("x"),
    coordinate("y"),
    coordinate("z"),
];

const MOMENTS: [Parameter<'_>; 3] = [moment("ix"), moment("iy"), moment("iz")];

/// The values of a load.
pub(crate) const PARAMETERS: [Parameter<'_>; 7] = {
    let ([mass, x, y, z], [ix, iy, iz]) = (POINT, MOMENTS);
    [mass, x, y, z, ix, iy, iz]
};

const fn moment(name: &str) -> Parameter<'_> {
    Parameter {
        name,
        range: INERTIA,
        typical: "0.3 kgm2",
    }
}

/// Reads a load.
pub(crate) fn read(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Registered<Load>> {
    let call = calls(field, expr, LOADS, reader.reports)?;
    if call.function == "number" {
        let number = call.single(reader.reports)?;
        return table_number(number, reader).map(Registered::Number);
    }
    let states_moments =
        call.all().len() > POINT.len() || MOMENTS.iter().any(|moment| call.find(moment.name).is_some());
    if !states_moments {
        let [mass, x, y, z] = call.named(&POINT, reader)?;
        return Ok(Registered::Value(load([mass, x, y, z], None)));
    }
    let [mass, x, y, z, ix, iy, iz] = call.named(&PARAMETERS, reader)?;
    let [ix, iy, iz] = [ix, iy, iz].map(|moment| moment / Dimension::INERTIA.unit_size());
    let load = load([mass, x, y, z], Some(Inertia { x: ix, y: iy, z: iz }));
    match impossible(&load, call.span) {
        Some(diagnostic) => Err(reader.reports.push(diagnostic)),
        None => Ok(Registered::Value(load)),
    }
}

const fn load([mass, x, y, z]: [f64; 4], inertia: Option<Inertia>) -> Load {
    Load {
        mass: Mass::kg(mass),
        centre: Point3::new(x, y, z),
        inertia,
    }
}

/// What is wrong with a load whose moments of inertia no body of its mass has.
fn impossible(load: &Load, span: Span) -> Option<Diagnostic> {
    let inertia = load.inertia.filter(|inertia| *inertia != Inertia::POINT)?;
    if load.mass <= Mass::ZERO {
        let diagnostic = Diagnostic::new(
            Code::OutOfRange,
            "a load of 0 kg has no moments of inertia",
            span,
            "without mass",
        );
        return Some(diagnostic.help("state its mass, or delete `ix`, `iy` and `iz`"));
    }
    if inertia.is_possible() {
        return None;
    }
    let mut moments = inertia.to_array();
    moments.sort_by(f64::total_cmp);
    let [least, middle, most] = moments.map(to_six_places);
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        format!(
            "no body has these moments of inertia: {most} kgm2 is more than {least} and {middle} kgm2 together"
        ),
        span,
        "about the centre of mass, along x, y and z of the flange",
    );
    Some(diagnostic.help("compare the numbers and their units with where they come from"))
}

/// As many decimals as programs have: moments of small tools are far below a thousandth.
fn to_six_places(value: f64) -> f64 {
    rounded(value, 1e6)
}

/// Whether the machine may carry each load.
pub(crate) fn check(tools: &HeldTools, model: &Model, named: Span, reports: &mut Reports) -> Checked<()> {
    let mut checked = Ok(());
    for load in tools.iter().filter_map(|tool| tool.load) {
        let (Registered::Value(value), Some(span)) = (load.value, load.span) else {
            continue;
        };
        if let Some(excess) = model.payload.excess(&value) {
            checked = Err(reports.push(too_much(excess, &value, span, model).and(named, "this machine")));
        }
    }
    checked
}

fn too_much(excess: Excess, load: &Load, span: Span, model: &Model) -> Diagnostic {
    let (mass, name) = (to_six_places(load.mass.to_kg()), &model.name);
    match excess {
        Excess::Mass { rated } => Diagnostic::new(
            Code::LoadTooMuch,
            format!("the load is {mass} kg, but `{name}` is rated for {rated} kg"),
            span,
            format!("{} kg too much", to_six_places(mass - rated)),
        )
        .help(
            "use a lighter tool, or a stronger machine; if yours is rated for more, state `rated_payload_kg` in a sheet of it \
             (docs/machines.md)",
        ),
        Excess::Inertia(turned) => too_hard_to_turn(&turned, load, span, model),
    }
}

fn too_hard_to_turn(turned: &Turned, load: &Load, span: Span, model: &Model) -> Diagnostic {
    let (mass, name) = (to_six_places(load.mass.to_kg()), &model.name);
    let Turned {
        axis, inertia, most, ..
    } = turned;
    let as_point = if load.inertia.is_none() {
        ", as a point,"
    } else {
        ""
    };
    let message = format!(
        "the load of {mass} kg{as_point} has {} kgm2 about axis {axis}, but `{name}` takes {most} kgm2",
        to_six_places(*inertia),
    );
    let from_axis = show(rounded(turned.from_axis, 10.0));
    let label = match load.inertia {
        None => format!("its centre is {from_axis} mm from axis {axis}"),
        Some(_) => format!(
            "its centre is {from_axis} mm from axis {axis}, and about itself it has {} kgm2",
            to_six_places(turned.own)
        ),
    };
    let diagnostic = Diagnostic::new(Code::LoadTooMuch, message, span, label);
    let whole_grams = |mass: f64| (mass * 1e3).floor() / 1e3;
    match turned.heaviest.map(whole_grams).filter(|mass| *mass > 0.0) {
        Some(heaviest) => diagnostic.help(format!(
            "with its centre there a load may be {heaviest} kg; use a lighter tool, or one with its centre nearer to the flange",
        )),
        None => diagnostic.help("use a smaller tool, or a stronger machine"),
    }
}
