//! The part of a sheet that describes a robot: an ortho-parallel arm with a spherical wrist, and the position limits of its axes.
//!
//! Angles are the controller's own. Lengths follow Brandstötter, Angerer, Hofbaur 2014 as in [`Opw`].

use super::types::{Body, Form};
use crate::facts::Sources;
use crate::kinematics::Mechanism;
use crate::kinematics::opw::{Coupling, Opw};
use vcutc_backend_api::ir::{Axis, AxisKind, Maker};
use vcutc_diagnostics::document::flaw::Flaw;
use vcutc_diagnostics::document::table::{
    ANGLE, LENGTH, Measure, TURNING_ACCELERATION, TURNING_JERK, TURNING_RATE, Table,
};

/// Sheets of robots.
pub(super) const FORM: Form = Form {
    keys: &["opw", "limits", "coupling"],
    read,
};

const OPW_LINES: &[(&str, &str)] = &[
    ("a1_mm", "a1_mm = 350.0"),
    ("a2_mm", "a2_mm = 41.0"),
    ("b_mm", "b_mm = 0.0"),
    ("c1_mm", "c1_mm = 675.0"),
    ("c2_mm", "c2_mm = 1350.0"),
    ("c3_mm", "c3_mm = 1400.0"),
    ("c4_mm", "c4_mm = 240.0"),
    (
        "joint_offsets_deg",
        "joint_offsets_deg = [0.0, -90.0, 0.0, 0.0, 0.0, 0.0]",
    ),
    ("joint_signs", "joint_signs = [-1, 1, 1, -1, 1, -1]"),
];

const LIMIT_KEYS: &[&str] = &[
    "limits_deg",
    "limits_source",
    "limits_note",
    "speeds_deg_s",
    "speeds_source",
    "accelerations_deg_s2",
    "accelerations_source",
    "jerks_deg_s3",
    "jerks_source",
    "joint_effort_limit_nm",
    "joint_effort_source",
    ELBOW_LIMIT,
];

/// A key that people look for, and that is refused with a reason.
const ELBOW_LIMIT: &str = "elbow_angle_limit_deg";

const COUPLING_KEYS: &[&str] = &[
    "j2_j3_parallelogram",
    "formula",
    "axis3_reference",
    "limits_note",
    "elbow_angle_limit_hint_deg",
    "source",
    "wrist_4_5_6_coupling_in_joint_space",
    "wrist_note",
];

/// Upper arm and forearm, without which an arm has no elbow.
const ARM_LENGTH: Measure = Measure {
    unit: "mm",
    min: 1.0,
    max: 100_000.0,
};

/// Three turns. Axis 6 of small ABB arms goes from -400 to 400 deg; nobody builds an axis with cables that turns farther
/// than this, so a wider range is a slip.
const WIDEST_RANGE: f64 = 1080.0;

fn read(root: &Table<'_>, maker: Maker, flaws: &mut Vec<Flaw>) -> Option<Body> {
    root.require(&[("opw", "[opw]"), ("limits", "[limits]")], flaws);
    let mut body = Body::default();
    let coupling = coupling(root, &mut body, flaws);
    let arm = arm(root, &mut body, flaws);
    let axes = axes(root, maker, &mut body, flaws);
    body.axes = axes?;
    let mechanism = Mechanism::OrthoParallel(Opw {
        coupling: coupling?,
        ..arm?
    });
    body.mechanism = Some(mechanism);
    Some(body)
}

/// The arm, as one without coupling.
fn arm(root: &Table<'_>, body: &mut Body, flaws: &mut Vec<Flaw>) -> Option<Opw> {
    let mut keys: Vec<&str> = OPW_LINES.iter().map(|(key, _)| *key).collect();
    keys.push("source");
    let opw = root.table("opw", &keys, flaws)?;
    opw.require(OPW_LINES, flaws);
    body.sources.push(Sources {
        of: "lengths",
        list: opw.texts("source", flaws),
    });
    let mut length = |key, measure| opw.number(key, measure, flaws);
    let [a1, a2, b, c1, c4] = ["a1_mm", "a2_mm", "b_mm", "c1_mm", "c4_mm"].map(|key| length(key, LENGTH));
    let [c2, c3] = ["c2_mm", "c3_mm"].map(|key| length(key, ARM_LENGTH));
    let offsets: Option<[f64; 6]> = opw.numbers("joint_offsets_deg", ANGLE, flaws);
    let signs = signs(&opw, flaws);
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

fn signs(opw: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<[f64; 6]> {
    const KEY: &str = "joint_signs";
    let any = Measure {
        unit: "",
        min: -1e9,
        max: 1e9,
    };
    let signs: [f64; 6] = opw.numbers(KEY, any, flaws)?;
    let wrong = signs.iter().find(|sign| sign.abs().total_cmp(&1.0).is_ne());
    if let Some(wrong) = wrong {
        flaws.push(
            Flaw::new(
                opw.span_of(KEY),
                format!("a sense of rotation is 1 or -1, not {wrong}"),
                "only 1 and -1",
            )
            .help(format!(
                "write `{KEY} = [-1, 1, 1, -1, 1, -1]` for KUKA, `[1, 1, 1, 1, 1, 1]` for ABB"
            )),
        );
        return None;
    }
    Some(signs)
}

/// What J3 counts; serial when the sheet does not say.
fn coupling(root: &Table<'_>, body: &mut Body, flaws: &mut Vec<Flaw>) -> Option<Coupling> {
    const PARALLELOGRAM: &str = "j2_j3_parallelogram";
    const WRIST: &str = "wrist_4_5_6_coupling_in_joint_space";
    if !root.has("coupling") {
        return Some(Coupling::Serial);
    }
    let table = root.table("coupling", COUPLING_KEYS, flaws)?;
    body.sources.push(Sources {
        of: "coupling",
        list: table.texts("source", flaws),
    });
    for key in ["axis3_reference", "limits_note", "wrist_note"] {
        body.remarks.extend(table.text(key, flaws).map(str::to_owned));
    }
    if let Some((min, max)) = table.range("elbow_angle_limit_hint_deg", ANGLE, WIDEST_RANGE, flaws) {
        body.remarks.push(format!(
            "hint, unconfirmed and not checked: the angle J3 - J2 keeps from {min} to {max} deg"
        ));
    }
    if table.truth(WRIST, flaws) == Some(true) {
        flaws.push(
            Flaw::new(
                table.span_of(WRIST),
                "a wrist whose joint values are coupled cannot be computed",
                "not supported",
            )
            .help("give limits and zero positions of decoupled joint values, as controllers show them, and write `false`"),
        );
    }
    if table.has(PARALLELOGRAM) {
        let coupled = table.truth(PARALLELOGRAM, flaws)?;
        return Some(if coupled {
            Coupling::Parallelogram
        } else {
            Coupling::Serial
        });
    }
    Some(Coupling::Serial)
}

fn axes(root: &Table<'_>, maker: Maker, body: &mut Body, flaws: &mut Vec<Flaw>) -> Option<Vec<Axis>> {
    const LIMITS: &str = "limits_deg";
    let table = root.table("limits", LIMIT_KEYS, flaws)?;
    table.require(
        &[(
            LIMITS,
            "limits_deg = [[-185.0, 185.0], [-140.0, -5.0], [-120.0, 155.0], [-350.0, 350.0], [-122.5, 122.5], [-350.0, 350.0]]",
        )],
        flaws,
    );
    refuse_elbow_limit(&table, flaws);
    for (of, key) in [
        ("limits", "limits_source"),
        ("speeds", "speeds_source"),
        ("accelerations", "accelerations_source"),
        ("jerks", "jerks_source"),
    ] {
        body.sources.push(Sources {
            of,
            list: table.texts(key, flaws),
        });
    }
    body.remarks
        .extend(table.text("limits_note", flaws).map(str::to_owned));
    let ranges: Option<[(f64, f64); 6]> = table.ranges(LIMITS, ANGLE, WIDEST_RANGE, flaws);
    let before = flaws.len();
    let rates = optional(&table, "speeds_deg_s", TURNING_RATE, flaws);
    let accelerations = optional(&table, "accelerations_deg_s2", TURNING_ACCELERATION, flaws);
    let jerks = optional(&table, "jerks_deg_s3", TURNING_JERK, flaws);
    if flaws.len() > before {
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
fn optional(table: &Table<'_>, key: &str, measure: Measure, flaws: &mut Vec<Flaw>) -> [Option<f64>; 6] {
    let numbers: Option<[f64; 6]> = table.numbers(key, measure, flaws);
    numbers.map_or([None; 6], |numbers| numbers.map(Some))
}

/// The angle at the elbow is a limit on two axes at once, which the proof of a motion does not know.
fn refuse_elbow_limit(table: &Table<'_>, flaws: &mut Vec<Flaw>) {
    if table.has(ELBOW_LIMIT) {
        flaws.push(
            Flaw::new(
                table.span_of(ELBOW_LIMIT),
                "a limit on the elbow angle J3 - J2 cannot be checked: limits apply to each axis separately",
                "not supported",
            )
            .help("delete this line, and narrow `limits_deg` of axes 2 and 3 until J3 - J2 is in range for all their values"),
        );
    }
}
