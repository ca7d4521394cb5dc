//! What people want to know of a machine apart from what is computed with: sources, disagreements, published
//! poses.

use crate::kinematics::{Joints, Mechanism};
use crate::ranges::{ANGLE, LENGTH, QUATERNION_PART, TOLERANCE};
use glam::DVec3;
use vcutc_backend_api::geometry::{Frame, Orientation};
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};

/// For people.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    pub sources: Vec<Sources>,
    /// What else there is to know of a group of numbers.
    pub remarks: Vec<String>,
    /// How far the wrist centre gets from axis 1, in mm.
    pub wrist_reach: Option<f64>,
    /// The reach that the model's name promises, in mm.
    pub designated_reach: Option<f64>,
    /// Where sources differ, and what was adopted.
    pub disagreements: Vec<String>,
    /// Poses that others publish or compute.
    pub fk_checks: Vec<FkCheck>,
}

/// Where the numbers of a group come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// The group, such as `lengths`.
    pub of: &'static str,
    /// A repository with a path, or a document, each.
    pub list: Vec<String>,
}

impl Sources {
    /// Those that a table states under a key.
    pub(super) fn read(of: &'static str, table: &Table<'_>, key: &str, faults: &mut Vec<Diagnostic>) -> Self {
        let list = table.texts(key, faults);
        Self { of, list }
    }
}

/// A pose of the flange that others publish or compute, with which the model of a sheet is tested.
#[derive(Clone, Debug, PartialEq)]
pub struct FkCheck {
    /// Axis values as the controller counts them, in deg.
    pub joints_deg: [f64; 6],
    /// The flange in the root, in mm.
    pub xyz_mm: [f64; 3],
    /// Its orientation, `[w, x, y, z]`, when published.
    pub quaternion: Option<[f64; 4]>,
    /// How far the model may be off, in mm.
    pub position_tolerance_mm: f64,
    /// How far the model may be turned, in deg.
    pub rotation_tolerance_deg: f64,
    pub source: Option<String>,
    /// In what way that source is independent of the model.
    pub independence: Option<String>,
    /// What else there is to know.
    pub note: Option<String>,
    /// Where it is in the sheet.
    pub span: Span,
}

impl FkCheck {
    /// How far a mechanism with these axes is from the published pose: in mm, and in deg.
    #[must_use]
    pub fn apart(&self, mechanism: &Mechanism, axes: &[Axis]) -> (f64, f64) {
        let mut joints = Joints::default();
        for (joint, (value, axis)) in joints.iter_mut().zip(self.joints_deg.iter().zip(axes)) {
            *joint = match axis.kind {
                AxisKind::Rotary => value.to_radians(),
                AxisKind::Linear => *value,
            };
        }
        let flange_in_root = mechanism.flange_in_root(&joints);
        let apart = flange_in_root.position.distance(DVec3::from_array(self.xyz_mm));
        let published = self
            .quaternion
            .and_then(|[w, x, y, z]| Orientation::from_quaternion(w, x, y, z));
        let turned = published.map_or(0.0, |published| {
            published
                .angle_to(Frame::from(flange_in_root).orientation)
                .to_deg()
        });
        (apart, turned)
    }

    /// The fault of a sheet whose mechanism does not reach the pose.
    pub(super) fn missed(&self, mechanism: &Mechanism, axes: &[Axis]) -> Option<Diagnostic> {
        let (apart, turned) = self.apart(mechanism, axes);
        if apart <= self.position_tolerance_mm && turned <= self.rotation_tolerance_deg {
            return None;
        }
        let missed = Diagnostic::new(
            Code::BadMachineFile,
            format!(
                "the numbers of this sheet put the flange {apart:.3} mm and {turned:.3} deg away from a known pose"
            ),
            self.span,
            format!(
                "known to {} mm and {} deg",
                self.position_tolerance_mm, self.rotation_tolerance_deg
            ),
        );
        Some(missed.help("compare lengths, `joint_offsets_deg` and `joint_signs` with those of the machine, or the pose with its source"))
    }
}

/// The part of a sheet that holds facts.
pub(super) const FIELDS: &[FieldSpec] = &[
    optional("standard_dh_equivalent"),
    optional("reach_check"),
    optional("reference_pose"),
    optional("verification"),
    optional("notes"),
    optional("paper_variant"),
    optional("fk_check"),
];

/// Sections that are kept for people who read the sheet itself.
const LOOSE: &[&str] = &["standard_dh_equivalent", "reference_pose", "verification"];

const REACH: &[FieldSpec] = &[
    optional("wrist_reach_mm").within(LENGTH),
    optional("formula"),
    optional("designation_reach_mm").within(LENGTH),
    optional("difference_mm"),
];

const FK_CHECK: &[FieldSpec] = &[
    value("joints_deg", "[0.0, -90.0, 90.0, 0.0, 0.0, 0.0]")
        .required()
        .within(ANGLE),
    value("xyz_mm", "[1990.0, 0.0, 1984.0]").required().within(LENGTH),
    optional("quat_wxyz").within(QUATERNION_PART),
    optional("abc_deg"),
    optional("source"),
    optional("independence"),
    optional("position_tolerance_mm").within(TOLERANCE),
    optional("rotation_tolerance_deg").within(TOLERANCE),
    optional("residual_mm"),
    optional("residual_deg"),
    optional("note"),
];

/// Tolerance of a check that states none, in mm and in deg.
const USUAL_TOLERANCE: f64 = 0.01;

/// Reads the facts of a sheet.
pub(super) fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Facts {
    for key in LOOSE {
        root.loose_table(key, faults);
    }
    let mut facts = Facts {
        fk_checks: fk_checks(root, faults),
        ..Facts::default()
    };
    if let Some(reach) = root.table("reach_check", REACH, faults) {
        facts.wrist_reach = reach.number("wrist_reach_mm", faults);
        facts.designated_reach = reach.number("designation_reach_mm", faults);
    }
    if let Some(notes) = root.table("notes", &[optional("disagreements")], faults) {
        facts.disagreements = notes.texts("disagreements", faults);
    }
    if let Some(variant) = root.loose_table("paper_variant", faults) {
        let assessment = variant.text("assessment", faults);
        facts
            .remarks
            .extend(assessment.map(|text| format!("values of a research paper: {text}")));
    }
    facts
}

fn fk_checks(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Vec<FkCheck> {
    let tables = root.tables("fk_check", FK_CHECK, faults);
    tables
        .iter()
        .filter_map(|check| fk_check(check, faults))
        .collect()
}

/// How far the length of a rotation's quaternion may be from 1: figures are printed with some decimals only.
const UNIT_WITHIN: f64 = 1e-3;

fn fk_check(check: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<FkCheck> {
    let joints = check.numbers("joints_deg", faults);
    let xyz = check.numbers("xyz_mm", faults);
    let quaternion: Option<[f64; 4]> = check.numbers("quat_wxyz", faults);
    if let Some(parts) = quaternion {
        let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        if (length - 1.0).abs() > UNIT_WITHIN {
            let message = format!("`quat_wxyz` has the length {length:.3}, a rotation has 1");
            faults.push(check.fault(check.span(), message, "not a rotation"));
            return None;
        }
    }
    let mut text = |key| check.text(key, faults).map(str::to_owned);
    let (source, independence, note) = (text("source"), text("independence"), text("note"));
    let mut tolerance = |key| check.number(key, faults).unwrap_or(USUAL_TOLERANCE);
    Some(FkCheck {
        joints_deg: joints?,
        xyz_mm: xyz?,
        quaternion,
        position_tolerance_mm: tolerance("position_tolerance_mm"),
        rotation_tolerance_deg: tolerance("rotation_tolerance_deg"),
        source,
        independence,
        note,
        span: check.span(),
    })
}
