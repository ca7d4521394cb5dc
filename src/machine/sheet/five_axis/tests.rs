//! Sheets of five-axis machines: those of the catalogue, and one with a fault at a time.

use crate::catalogue;
use crate::kinematics::Mechanism;
use crate::kinematics::five_axis::FiveAxis;
use crate::sheet::{self, Sheet};
use glam::DVec3;
use vcutc_backend_api::ir::AxisKind;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::FileId;

fn parse(text: &str) -> Result<Sheet, Vec<Diagnostic>> {
    sheet::parse(FileId::ALONE, text)
}

fn machine(name: &str) -> FiveAxis {
    match catalogue::find(name).unwrap().mechanism {
        Mechanism::FiveAxis(machine) => machine,
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
            panic!("{name} is an arm")
        }
    }
}

fn generic() -> Vec<&'static str> {
    catalogue::names()
        .filter(|name| name.starts_with("generic/"))
        .collect()
}

#[test]
fn axes_come_in_the_order_of_the_arrangement() {
    let names = |name| {
        let axes = catalogue::find(name).unwrap().axes;
        axes.iter()
            .map(|axis| axis.name.clone())
            .collect::<Vec<_>>()
            .join(" ")
    };
    assert_eq!(names("generic/head_head_ba"), "X Y Z B A");
    assert_eq!(names("generic/head_table_ab"), "X Y Z A B");
    assert_eq!(names("generic/table_table_ac"), "X Y Z A C");
    assert_eq!(names("generic/head_head_ac_spindle"), "X Y Z C A S");
}

#[test]
fn ranges_and_rates_come_in_radians_and_mm() {
    let axes = catalogue::find("generic/head_head_ba").unwrap().axes;
    assert_eq!(axes[0].kind, AxisKind::Linear);
    assert_eq!(
        (axes[0].min, axes[0].max, axes[0].rate),
        (-1000.0, 1000.0, Some(500.0))
    );
    assert_eq!(axes[3].kind, AxisKind::Rotary);
    assert!((axes[3].max.to_degrees() - 110.0).abs() < 1e-12);
    assert!((axes[3].rate.unwrap().to_degrees() - 90.0).abs() < 1e-12);
    assert!((axes[3].acceleration.unwrap().to_degrees() - 400.0).abs() < 1e-12);
}

#[test]
fn the_arrangements_that_swing_and_rake_are_three() {
    let bare: Vec<_> = generic()
        .into_iter()
        .filter(|name| machine(name).swings_then_rakes())
        .collect();
    assert_eq!(
        bare,
        [
            "generic/head_head_ba",
            "generic/head_table_ab",
            "generic/table_table_ab"
        ]
    );
    let spindles: Vec<_> = generic()
        .into_iter()
        .filter(|name| machine(name).spindle().is_some())
        .collect();
    assert_eq!(spindles, ["generic/head_head_ac_spindle"]);
}

/// Positive angles lean the spindle, seen from the work, as ISO 841 wants them: A from Y to Z, B from Z to X.
#[test]
fn positive_angles_turn_the_blade_right_handed_against_the_work() {
    for name in generic() {
        let model = catalogue::find(name).unwrap();
        for (place, axis) in model.axes.iter().enumerate().skip(3) {
            let mut joints = [0.0; 6];
            joints[place] = 0.1;
            let turned = machine(name).forward(&joints).rotation
                * machine(name).forward(&[0.0; 6]).rotation.transpose();
            let about = match axis.name.as_str() {
                "A" => DVec3::X,
                "B" => DVec3::Y,
                _ => DVec3::Z,
            };
            assert!(
                (turned - glam::DMat3::from_axis_angle(about, 0.1))
                    .determinant()
                    .abs()
                    < 1e-9
            );
            let across = about.any_orthonormal_vector();
            assert!(
                about.dot(across.cross(turned * across)) > 0.09,
                "{name} {}",
                axis.name
            );
        }
    }
}

fn faults(name: &str, from: &str, to: &str) -> Vec<Diagnostic> {
    let text = catalogue::text(name).unwrap();
    assert!(text.contains(from), "{from}");
    parse(&text.replacen(from, to, 1)).expect_err(to)
}

/// The only fault after a change of a sheet: the text it points at, and what it says.
fn fault(name: &str, from: &str, to: &str) -> (String, String) {
    let text = catalogue::text(name).unwrap().replacen(from, to, 1);
    let mut found = faults(name, from, to);
    assert_eq!(found.len(), 1, "{found:#?}");
    let fault = found.remove(0);
    (text[fault.primary.span.bytes()].to_owned(), fault.message)
}

fn assert_fault(from: &str, to: &str, place: &str, message: &str) {
    let found = fault("generic/head_head_ac_spindle", from, to);
    assert_eq!((found.0.as_str(), found.1.as_str()), (place, message));
}

#[test]
fn arrangements_have_two_rotary_axes_with_names_of_their_own() {
    assert_fault(
        "[\"c\", \"a\"]",
        "[\"c\"]",
        "[\"c\"]",
        "head and table have 1 rotary axes together, a five-axis machine has 2",
    );
    assert_fault("\"s\"", "\"w\"", "\"w\"", "a rotary axis cannot be called \"w\"");
    assert_fault("\"s\"", "\"c\"", "\"c\"", "two rotary axes are called \"c\"");
    assert_fault(
        "[\"c\", \"a\"]",
        "\"ca\"",
        "\"ca\"",
        "`head` takes a list of names, not a text",
    );
    assert_fault(
        "[\"c\", \"a\"]",
        "[\"c\", 1]",
        "1",
        "`head` takes names in quotes, not a number",
    );
}

#[test]
fn rotary_axes_have_to_tilt_the_blade() {
    assert_fault(
        "[\"c\", \"a\"]",
        "[\"a\", \"c\"]",
        "[\"a\", \"c\"]",
        "axis C lies along the spindle, so the blade tilts in only one direction",
    );
    let (place, message) = fault("generic/head_head_ba", "\"+Y\"", "\"-X\"");
    assert_eq!(place, "[\"b\", \"a\"]");
    assert_eq!(
        message,
        "the two rotary axes are parallel, so the blade tilts in only one direction"
    );
    let (place, _) = fault("generic/table_table_ac", "[\"a\", \"c\"]", "[\"c\", \"a\"]");
    assert_eq!(place, "[\"c\", \"a\"]");
}

#[test]
fn every_axis_has_a_table_with_its_range() {
    let name = "generic/head_head_ac_spindle";
    let missing = faults(name, "[axis.s]", "[axis.t]");
    assert!(
        missing
            .iter()
            .any(|fault| fault.message == "the sheet lacks `[axis.s]`"),
        "{missing:#?}"
    );
    assert!(
        missing
            .iter()
            .any(|fault| fault.message == "`[axis]` has no field `t`"),
        "{missing:#?}"
    );
    let (_, message) = fault(name, "travel_mm = [-1000.0, 1000.0]\n", "");
    assert_eq!(message, "`[axis.x]` needs `travel_mm`");
    assert_fault(
        "[-1000.0, 1000.0]",
        "[1000.0, -1000.0]",
        "[1000.0, -1000.0]",
        "a range of `travel_mm` ends before it begins: 1000 mm is not below -1000 mm",
    );
    assert_fault(
        "rate_deg_s = 120.0",
        "rate_deg_s = nan",
        "nan",
        "`rate_deg_s` takes a finite number",
    );
    let (place, message) = fault(name, "about = \"+X\"", "about = \"X\"");
    assert_eq!(
        (place.as_str(), message.as_str()),
        ("\"X\"", "`about` cannot be `\"X\"`")
    );
}

/// Nothing uses them there, so that stating them would promise too much.
#[test]
fn masses_torques_and_stiffness_are_of_arms() {
    for heading in ["dynamics", "torque", "elasticity"] {
        let with = format!("\n[{heading}]\nsource = \"a scale\"\n[");
        let (place, message) = fault("generic/head_head_ac_spindle", "\n[", &with);
        assert_eq!(place, heading);
        assert!(message.contains(&format!("`{heading}`")), "{message}");
    }
}

#[test]
fn the_sheet_of_the_manual_is_a_machine() {
    let manual = include_str!("../../../../docs/machines_five_axis.md");
    let (_, rest) = manual.split_once("```toml\n").unwrap();
    let (text, _) = rest.split_once("```").unwrap();
    let sheet = parse(text).unwrap();
    let names: Vec<_> = sheet.axes.iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["X", "Y", "Z", "B", "A"]);
}
