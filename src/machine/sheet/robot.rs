//! The part of a sheet that describes a robot: an ortho-parallel arm with a spherical wrist, and the position limits of its axes.
//!
//! Angles are the controller's own. Lengths follow Brandstötter, Angerer, Hofbaur 2014 as in [`Opw`].

use super::types::{Body, Form};
use crate::elasticity;
use crate::facts::Sources;
use crate::kinematics::Mechanism;
use crate::kinematics::opw::{Coupling, Opw};
use crate::masses;
use crate::payload;
use crate::ranges::{ANGLE, ARM_LENGTH, LENGTH, TORQUE, TURNING_ACCELERATION, TURNING_JERK, TURNING_RATE};
use vcutc_backend_api::ir::{Axis, AxisKind, Maker};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, block, optional, value};

/// Sheets of robots.
pub(super) const FORM: Form = Form {
    fields: &[
        block("opw", "[opw]").required(),
        block("limits", "[limits]").required(),
        optional("coupling"),
        optional(masses::KEY),
        optional(masses::TORQUE_KEY),
        optional(elasticity::KEY),
        optional(payload::KEY),
    ],
    read,
};

const OPW: &[FieldSpec] = &[
    value("a1_mm", "350.0").required().within(LENGTH),
    value("a2_mm", "41.0").required().within(LENGTH),
    value("b_mm", "0.0").required().within(LENGTH),
    value("c1_mm", "675.0").required().within(LENGTH),
    value("c2_mm", "1350.0").required().within(ARM_LENGTH),
    value("c3_mm", "1400.0").required().within(ARM_LENGTH),
    value("c4_mm", "240.0").required().within(LENGTH),
    value("joint_offsets_deg", "[0.0, -90.0, 0.0, 0.0, 0.0, 0.0]")
        .required()
        .within(ANGLE),
    value(SIGNS, "[-1, 1, 1, -1, 1, -1]").required(),
    optional("source"),
];

const LIMITS: &[FieldSpec] = &[
    value(
        "limits_deg",
        "[[-185.0, 185.0], [-140.0, -5.0], [-120.0, 155.0], [-350.0, 350.0], [-122.5, 122.5], [-350.0, 350.0]]",
    )
    .required()
    .within(ANGLE),
    optional("limits_source"),
    optional("limits_note"),
    optional("speeds_deg_s").within(TURNING_RATE),
    optional("speeds_source"),
    optional("accelerations_deg_s2").within(TURNING_ACCELERATION),
    optional("accelerations_source"),
    optional("jerks_deg_s3").within(TURNING_JERK),
    optional("jerks_source"),
    optional("joint_effort_limit_nm").within(TORQUE),
    optional("joint_effort_source"),
    optional(ELBOW_LIMIT),
];

const COUPLING: &[FieldSpec] = &[
    optional(PARALLELOGRAM),
    optional("formula"),
    optional("axis3_reference"),
    optional("limits_note"),
    optional("elbow_angle_limit_hint_deg").within(ANGLE),
    optional("source"),
    optional(WRIST),
    optional("wrist_note"),
];

const SIGNS: &str = "joint_signs";
/// A key that people look for, and that is refused with a reason.
const ELBOW_LIMIT: &str = "elbow_angle_limit_deg";
const PARALLELOGRAM: &str = "j2_j3_parallelogram";
const WRIST: &str = "wrist_4_5_6_coupling_in_joint_space";

/// Three turns. Axis 6 of small ABB arms goes from -400 to 400 deg; an axis with cables turns no farther than this,
/// so a wider range is a slip.
const WIDEST_RANGE: f64 = 1080.0;

fn read(root: &Table<'_>, maker: Maker, faults: &mut Vec<Diagnostic>) -> Option<Body> {
    let mut body = Body::default();
    let coupling = coupling(root, &mut body, faults);
    let arm = arm(root, &mut body, faults);
    let axes = axes(root, maker, &mut body, faults);
    body.axes = axes?;
    let mechanism = Mechanism::OrthoParallel(Opw {
        coupling: coupling?,
        ..arm?
    });
    body.mechanism = Some(mechanism);
    Some(body)
}

/// The arm, as one without coupling.
fn arm(root: &Table<'_>, body: &mut Body, faults: &mut Vec<Diagnostic>) -> Option<Opw> {
    let opw = root.table("opw", OPW, faults)?;
    body.sources
        .push(Sources::read("lengths", &opw, "source", faults));
    let lengths = ["a1_mm", "a2_mm", "b_mm", "c1_mm", "c2_mm", "c3_mm", "c4_mm"];
    let [a1, a2, b, c1, c2, c3, c4] = lengths.map(|key| opw.number(key, faults));
    let offsets: Option<[f64; 6]> = opw.numbers("joint_offsets_deg", faults);
    let signs = signs(&opw, faults);
    Some(Opw {
        a1: a1?,
        a2: a2?,
        b: b?,
        c1: c1?,
        c2: c2?,
        c3: c3?,
        c4: c4?,
        offsets: offsets?.map(f64::to_radians),
        signs: signs?,
        coupling: Coupling::Serial,
    })
}

fn signs(opw: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<[f64; 6]> {
    let signs: [f64; 6] = opw.numbers(SIGNS, faults)?;
    let wrong = signs.iter().find(|sign| sign.abs().total_cmp(&1.0).is_ne());
    if let Some(wrong) = wrong {
        let message = format!("a sense of rotation is 1 or -1, not {wrong}");
        let fault = opw.fault(opw.span_of(SIGNS), message, "only 1 and -1");
        faults.push(fault.help(format!(
            "write `{SIGNS} = [-1, 1, 1, -1, 1, -1]` for KUKA, `[1, 1, 1, 1, 1, 1]` for ABB"
        )));
        return None;
    }
    Some(signs)
}

/// What J3 counts; serial when the sheet does not say.
fn coupling(root: &Table<'_>, body: &mut Body, faults: &mut Vec<Diagnostic>) -> Option<Coupling> {
    if !root.has("coupling") {
        return Some(Coupling::Serial);
    }
    let table = root.table("coupling", COUPLING, faults)?;
    body.sources
        .push(Sources::read("coupling", &table, "source", faults));
    for key in ["axis3_reference", "limits_note", "wrist_note"] {
        body.remarks.extend(table.text(key, faults).map(str::to_owned));
    }
    if let Some((min, max)) = table.range("elbow_angle_limit_hint_deg", WIDEST_RANGE, faults) {
        body.remarks.push(format!(
            "hint, unconfirmed and not checked: the angle J3 - J2 keeps from {min} to {max} deg"
        ));
    }
    if table.truth(WRIST, faults) == Some(true) {
        let message = "a wrist whose joint values are coupled cannot be computed";
        faults.push(
            table.fault(table.span_of(WRIST), message, "not supported")
            .help("give limits and zero positions of decoupled joint values, as controllers show them, and write `false`"),
        );
    }
    if table.has(PARALLELOGRAM) && table.truth(PARALLELOGRAM, faults)? {
        return Some(Coupling::Parallelogram);
    }
    Some(Coupling::Serial)
}

fn axes(root: &Table<'_>, maker: Maker, body: &mut Body, faults: &mut Vec<Diagnostic>) -> Option<Vec<Axis>> {
    let table = root.table("limits", LIMITS, faults)?;
    refuse_elbow_limit(&table, faults);
    for (of, key) in [
        ("limits", "limits_source"),
        ("speeds", "speeds_source"),
        ("accelerations", "accelerations_source"),
        ("jerks", "jerks_source"),
    ] {
        body.sources.push(Sources::read(of, &table, key, faults));
    }
    body.remarks
        .extend(table.text("limits_note", faults).map(str::to_owned));
    let ranges: Option<[(f64, f64); 6]> = table.ranges("limits_deg", WIDEST_RANGE, faults);
    let before = faults.len();
    let rates = of_axes(&table, "speeds_deg_s", faults);
    let accelerations = of_axes(&table, "accelerations_deg_s2", faults);
    let jerks = of_axes(&table, "jerks_deg_s3", faults);
    if faults.len() > before {
        return None;
    }
    let letter = match maker {
        Maker::Kuka => 'A',
        Maker::Abb | Maker::Other => 'J',
    };
    let rows = ranges?
        .into_iter()
        .zip(rates)
        .zip(accelerations.into_iter().zip(jerks));
    let axes = (1..)
        .zip(rows)
        .map(|(number, (((min, max), rate), (acceleration, jerk)))| Axis {
            name: format!("{letter}{number}"),
            kind: AxisKind::Rotary,
            min: min.to_radians(),
            max: max.to_radians(),
            rate: rate.map(f64::to_radians),
            acceleration: acceleration.map(f64::to_radians),
            jerk: jerk.map(f64::to_radians),
        });
    Some(axes.collect())
}

/// Numbers of all axes, or of none.
fn of_axes(table: &Table<'_>, key: &str, faults: &mut Vec<Diagnostic>) -> [Option<f64>; 6] {
    let numbers: Option<[f64; 6]> = table.numbers(key, faults);
    numbers.map_or([None; 6], |numbers| numbers.map(Some))
}

/// The angle at the elbow is a limit on two axes at once, which the proof of a motion does not know.
fn refuse_elbow_limit(table: &Table<'_>, faults: &mut Vec<Diagnostic>) {
    if table.has(ELBOW_LIMIT) {
        let message =
            "a limit on the elbow angle J3 - J2 cannot be checked: limits apply to each axis separately";
        let fault = table.fault(table.span_of(ELBOW_LIMIT), message, "not supported");
        faults.push(
            fault.help("delete this line, and narrow `limits_deg` of axes 2 and 3 until J3 - J2 is in range for all their values"),
        );
    }
}
