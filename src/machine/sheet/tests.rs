//! Sheets with one fault each, small sheets of users, and sheets meant to do harm.

use super::*;
use crate::kinematics::opw::Coupling;
use proptest::prelude::*;
use vcutc_backend_api::ir::AxisKind;
use vcutc_diagnostics::document::{LARGEST, MOST_FAULTS};

fn parse(text: &str) -> Result<Sheet, Vec<Diagnostic>> {
    super::parse(FileId::ALONE, text)
}

/// The least a user writes.
pub(crate) const SMALL: &str = r#"
model = "Shop arm"
[opw]
a1_mm = 300
a2_mm = -100.0
b_mm = 0.0
c1_mm = 700.0
c2_mm = 900.0
c3_mm = 1_000.0
c4_mm = 150.0
joint_offsets_deg = [0.0, 0.0, -90.0, 0.0, 0.0, 0.0]
joint_signs = [1, 1, 1, 1, 1, 1]
[limits]
limits_deg = [[-180.0, 180.0], [-60.0, 80.0], [-70.0, 160.0], [-300.0, 300.0], [-120.0, 120.0], [-360.0, 360.0]]
"#;

/// The faults of the small sheet after a change, each with the text it points at.
fn faults(from: &str, to: &str) -> Vec<(String, String)> {
    assert!(SMALL.contains(from), "{from}");
    let text = SMALL.replacen(from, to, 1);
    let faults = parse(&text).expect_err(to);
    faults
        .into_iter()
        .map(|fault| {
            let place = text.get(fault.primary.span.bytes()).expect("a place in the text");
            (place.to_owned(), fault.message)
        })
        .collect()
}

/// The only fault after a change.
fn fault(from: &str, to: &str) -> (String, String) {
    let mut found = faults(from, to);
    assert_eq!(found.len(), 1, "{found:#?}");
    found.remove(0)
}

fn assert_fault(from: &str, to: &str, place: &str, message: &str) {
    assert_eq!(fault(from, to), (place.to_owned(), message.to_owned()));
}

#[test]
fn a_small_sheet_is_a_machine() {
    let sheet = parse(SMALL).unwrap();
    assert_eq!(sheet.maker(), Maker::Other);
    let model = sheet.machine("arm.toml");
    assert_eq!(model.kind(), MachineKind::Robot);
    let Mechanism::OrthoParallel(arm) = &model.mechanism else {
        panic!("an arm is wanted");
    };
    assert_eq!((arm.a1, arm.c3), (300.0, 1000.0));
    assert_eq!(arm.coupling, Coupling::Serial);
    let third = &model.axes[2];
    assert_eq!((third.name.as_str(), third.kind), ("J3", AxisKind::Rotary));
    assert_eq!(
        (third.min, third.max),
        ((-70_f64).to_radians(), 160_f64.to_radians())
    );
    assert_eq!((third.rate, third.acceleration), (None, None));
}

#[test]
fn a_maker_and_rates_and_coupling_are_optional() {
    let text = SMALL.replace("model =", "manufacturer = \"Kuka\"\nmodel =")
        + "speeds_deg_s = [100, 100, 100, 150, 150, 200]\naccelerations_deg_s2 = [200, 200, 200, 300, 300, 400]\n[coupling]\nj2_j3_parallelogram = true\n";
    let sheet = parse(&text).unwrap();
    assert_eq!(sheet.maker(), Maker::Kuka);
    let sixth = sheet.axes[5].clone();
    assert_eq!(sixth.name, "A6");
    assert_eq!(sixth.rate, Some(200_f64.to_radians()));
    assert_eq!(sixth.acceleration, Some(400_f64.to_radians()));
    let Mechanism::OrthoParallel(arm) = sheet.mechanism else {
        panic!("an arm is wanted");
    };
    assert_eq!(arm.coupling, Coupling::Parallelogram);
}

#[test]
fn what_is_missing_is_listed() {
    let (place, message) = fault("c2_mm = 900.0\nc3_mm = 1_000.0\n", "");
    assert!(place.starts_with("[opw]"), "{place}");
    assert_eq!(message, "`[opw]` needs `c2_mm`, `c3_mm`");
    assert_eq!(fault("model = \"Shop arm\"", "").1, "a sheet needs `model`");
    let limits = &SMALL[SMALL.find("[limits]").unwrap()..];
    assert_eq!(fault(limits, "").1, "a sheet needs `limits`");
    assert_eq!(fault(limits, "[limits]").1, "`[limits]` needs `limits_deg`");
}

#[test]
fn numbers_are_finite_numbers_in_range() {
    assert_fault("300", "nan", "nan", "`a1_mm` takes a finite number");
    assert_fault("300", "-inf", "-inf", "`a1_mm` takes a finite number");
    assert_fault("300", "1e999", "1e999", "`a1_mm` takes a finite number");
    assert_fault("300", "\"300\"", "\"300\"", "`a1_mm` takes a number, not a text");
    assert_fault(
        "300",
        "1e6",
        "1e6",
        "`a1_mm` must be at least -100 m and at most 100 m, but is 1000000 mm",
    );
    assert_fault(
        "900.0",
        "0.0",
        "0.0",
        "`c2_mm` must be at least 1 mm and at most 100 m, but is 0 mm",
    );
    assert_fault(
        "1_000.0",
        "-5.0",
        "-5.0",
        "`c3_mm` must be at least 1 mm and at most 100 m, but is -5 mm",
    );
    assert_fault(
        "[0.0, 0.0, -90.0, 0.0, 0.0, 0.0]",
        "[0.0, 0.0, -90.0]",
        "[0.0, 0.0, -90.0]",
        "`joint_offsets_deg` takes 6 entries, not 3",
    );
}

#[test]
fn senses_are_plus_or_minus_one() {
    let (place, message) = fault("[1, 1, 1, 1, 1, 1]", "[1, 1, 0, 1, 1, 1]");
    assert_eq!(place, "[1, 1, 0, 1, 1, 1]");
    assert_eq!(message, "a sense of rotation is 1 or -1, not 0");
}

#[test]
fn limits_are_ranges() {
    assert_fault(
        "[-60.0, 80.0]",
        "[80.0, -60.0]",
        "[80.0, -60.0]",
        "a range of `limits_deg` ends before it begins: 80 deg is not below -60 deg",
    );
    assert_fault(
        "[-360.0, 360.0]",
        "[-600.0, 600.0]",
        "[-600.0, 600.0]",
        "a range of `limits_deg` is 1200 deg wide, at most 1080 deg can be handled",
    );
    assert_fault(
        "[-60.0, 80.0]",
        "-60.0",
        "-60.0",
        "`limits_deg` takes a list of 2 numbers, not a number",
    );
    let (place, message) = fault(", [-360.0, 360.0]]", "]");
    assert!(place.starts_with("[[-180"), "{place}");
    assert_eq!(message, "`limits_deg` takes 6 entries, not 5");
}

#[test]
fn rates_are_above_nothing() {
    for bad in ["0", "-10"] {
        let line = format!("[limits]\nspeeds_deg_s = [100, {bad}, 100, 150, 150, 200]\n");
        let (place, message) = fault("[limits]\n", &line);
        assert_eq!(place, bad);
        assert_eq!(
            message,
            format!(
                "`speeds_deg_s` must be at least 0.001 deg/s and at most 100000 deg/s, but is {bad} deg/s"
            )
        );
    }
}

#[test]
fn unknown_keys_are_reported_with_what_was_meant() {
    let text = SMALL.replace("c4_mm", "c4");
    let found = parse(&text).unwrap_err();
    let messages: Vec<_> = found.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(messages, ["`[opw]` needs `c4_mm`", "`[opw]` has no field `c4`"]);
    let found = parse(&SMALL.replace("[limits]", "[limit]")).unwrap_err();
    let fixes = found.iter().flat_map(|fault| &fault.fixes);
    let titles: Vec<_> = fixes.map(|fix| fix.title.as_str()).collect();
    assert!(titles.contains(&"did you mean `limits`?"), "{titles:?}");
}

#[test]
fn a_known_pose_that_is_missed_is_reported_with_the_distance() {
    let check =
        "[[fk_check]]\njoints_deg = [0, 0, 0, 0, 0, 0]\nquat_wxyz = [0.70710678, 0.0, 0.70710678, 0.0]\n";
    let right = format!("{SMALL}{check}xyz_mm = [1450.0, 0.0, 1700.0]\n");
    assert!(parse(&right).is_ok(), "{:?}", parse(&right));
    let wrong = format!("{SMALL}{check}xyz_mm = [1450.0, 3.0, 1700.0]\n");
    let found = parse(&wrong).unwrap_err();
    assert_eq!(found.len(), 1, "{found:#?}");
    assert!(found[0].message.contains("3.000 mm and 0.000 deg"), "{found:#?}");
    let turned = right
        .replace("= [1, 1, 1, 1, 1, 1]", "= [1, 1, 1, 1, 1, -1]")
        .replace("[0, 0, 0, 0, 0, 0]", "[0, 0, 0, 0, 0, 15]");
    let found = parse(&turned).unwrap_err();
    assert!(found[0].message.contains("0.000 mm and 15.000 deg"), "{found:#?}");
}

#[test]
fn a_known_pose_is_a_rotation() {
    let check = "[[fk_check]]\njoints_deg = [0, 0, 0, 0, 0, 0]\nxyz_mm = [1450.0, 0.0, 1700.0]\n";
    for (quaternion, length) in [("[0, 0, 0, 0]", "0.000"), ("[0.9, 0, 0.7071, 0]", "1.145")] {
        let found = parse(&format!("{SMALL}{check}quat_wxyz = {quaternion}\n")).unwrap_err();
        let message = format!("`quat_wxyz` has the length {length}, a rotation has 1");
        assert_eq!(found[0].message, message);
    }
}

#[test]
fn texts_can_be_shown() {
    let (place, message) = fault("Shop arm", "Shop \\u001b[2J arm");
    assert!(place.contains("u001b"), "{place}");
    assert_eq!(
        message,
        "the text of `model` has a character that cannot be shown"
    );
    let key = "k".repeat(1000);
    let (_, message) = fault("model", &format!("{key} = 1\nmodel"));
    assert_eq!(message, format!("a sheet has no field `{}...`", "k".repeat(40)));
}

#[test]
fn words_are_known_words() {
    let (place, message) = fault("model", "confidence = \"hihg\"\nmodel");
    assert_eq!(
        (place.as_str(), message.as_str()),
        ("\"hihg\"", "`confidence` cannot be `\"hihg\"`")
    );
    let (place, _) = fault("model", "kind = \"robt\"\nmodel");
    assert_eq!(place, "\"robt\"");
}

#[test]
fn limits_that_are_not_checked_are_refused() {
    let (place, message) = fault("[limits]\n", "[limits]\nelbow_angle_limit_deg = [-70.0, 70.0]\n");
    assert_eq!(place, "[-70.0, 70.0]");
    assert!(message.contains("each axis separately"), "{message}");
    let coupled = "[coupling]\nwrist_4_5_6_coupling_in_joint_space = true\n[limits]";
    assert_eq!(fault("[limits]", coupled).0, "true");
}

#[test]
fn several_faults_are_reported_at_once_in_the_order_of_the_text() {
    let text = SMALL
        .replace("a1_mm = 300", "a1_mm = nan")
        .replace("[1, 1, 1, 1, 1, 1]", "[2, 1, 1, 1, 1, 1]")
        .replace("[-60.0, 80.0]", "[80.0, -60.0]");
    let found = parse(&text).unwrap_err();
    assert_eq!(found.len(), 3, "{found:#?}");
    assert!(found.is_sorted_by_key(|fault| fault.primary.span.start));
}

#[test]
fn what_is_not_toml_is_reported_with_its_place() {
    let (place, message) = faults("a2_mm = -100.0", "a2_mm = = 3").remove(0);
    assert!(message.starts_with("the sheet is not TOML: "), "{message}");
    assert!(place.len() < 10, "{place}");
    let (_, twice) = faults("b_mm = 0.0", "b_mm = 0.0\nb_mm = 1.0").remove(0);
    assert!(twice.contains("duplicate"), "{twice}");
}

/// Deep trees are dropped by recursion, wide ones take time.
#[test]
fn hostile_sheets_end_in_faults() {
    let dots = "a.".repeat(100_000);
    let lists = "[".repeat(250_000);
    let tables = "{a=".repeat(80_000);
    let headings: String = (0..25_000).map(|i| format!("[a{i}]\n")).collect();
    let hostile = [
        format!("{dots}a = 1"),
        format!("[{dots}a]"),
        format!("x = {lists}"),
        format!("x = {tables}"),
        headings,
        "=\n".repeat(100_000),
        "x".repeat(LARGEST + 1),
        "\u{feff}\0\u{1f980}".repeat(1000),
    ];
    for text in hostile {
        let found = parse(&text).unwrap_err();
        assert!((1..=MOST_FAULTS).contains(&found.len()));
        for fault in found {
            assert!(text.get(fault.primary.span.bytes()).is_some(), "{fault:?}");
        }
    }
}

proptest! {
    /// Whatever one byte of a sheet becomes: a machine of finite numbers, or faults with a place in the text.
    #[test]
    fn no_change_of_a_sheet_makes_nonsense(at in 0..SMALL.len(), letter in "[ -~\\n]") {
        let mut text = SMALL.to_owned();
        text.replace_range(at..=at, &letter);
        match parse(&text) {
            Ok(sheet) => {
                for axis in &sheet.axes {
                    prop_assert!(axis.min < axis.max && (axis.max - axis.min).is_finite());
                }
                let pose = sheet.mechanism.flange_in_root(&[0.1; 6]);
                prop_assert!(pose.position.is_finite() && pose.rotation.is_finite());
            }
            Err(faults) => {
                prop_assert!(!faults.is_empty());
                for fault in faults {
                    prop_assert!(text.get(fault.primary.span.bytes()).is_some(), "{:?}", fault);
                }
            }
        }
    }
}

#[test]
fn jerks_and_numbers_of_the_path_are_optional() {
    let sheet = parse(SMALL).unwrap();
    assert_eq!(sheet.path, PathLimits::UNKNOWN);
    let text = SMALL.to_owned()
        + "jerks_deg_s3 = [900, 900, 900, 900, 900, 1800]\n[path]\nacceleration_mm_s2 = 2000\nturning_jerk_deg_s3 = 180\n";
    let sheet = parse(&text).unwrap();
    assert_eq!(sheet.axes[5].jerk, Some(1800_f64.to_radians()));
    let path = sheet.machine("arm.toml").path;
    assert_eq!(path.acceleration, Some(2000.0));
    assert_eq!((path.jerk, path.turning_acceleration), (None, None));
    assert_eq!(path.turning_jerk, Some(180_f64.to_radians()));
    let faults = parse(&text.replace("= 2000", "= 0")).unwrap_err();
    assert_eq!(
        &text[..faults[0].primary.span.start as usize].lines().last(),
        &Some("acceleration_mm_s2 = ")
    );
}
