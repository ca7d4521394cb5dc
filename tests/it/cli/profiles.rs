//! Profiles on their way from a file into a program.

use super::jobs::RIB;
use super::{Run, folder, vcutc};
use std::fs;
use tempfile::TempDir;

/// A target, a machine that it drives, and how its programs are read here.
struct Target {
    name: &'static str,
    /// What stands instead of the machine of [`RIB`]; empty where that one will do.
    machine: &'static str,
    /// The file of the program.
    file: &'static str,
    /// What stands before the first coordinate.
    before: &'static str,
}

const KRL: Target = Target {
    name: "krl",
    machine: "",
    file: "rib.src",
    before: "LIN {X ",
};

#[cfg(feature = "rapid")]
const RAPID: Target = Target {
    name: "rapid",
    machine: r#"machine cell = robot "abb/irb6700_155_285" {
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1700 mm, y = -700 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  load       = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)
  home       = joints(0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}
"#,
    file: "rib.mod",
    before: "MoveL [[",
};

#[cfg(feature = "gcode")]
const GCODE: Target = Target {
    name: "gcode",
    machine: r#"machine cell = five_axis "generic/head_head_ba" {
  tool       = frame(x = 0 mm, y = 0 mm, z = 200 mm, a = -90 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 10 mm, y = -20 mm, z = 50 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = axes(x = 0 mm, y = 0 mm, z = 300 mm, b = 0 deg, a = 0 deg)
  ultrasonic = output(12)
}
"#,
    file: "RIB.MPF",
    before: "G1 X",
};

/// The job for that target with this block, and a profile.
fn compiled(target: &Target, block: &str, profile: &str) -> (TempDir, Run) {
    let folder = folder();
    let job = match (RIB.split_once("machine cell"), target.machine) {
        (None, _) | (_, "") => RIB.to_owned(),
        (Some((head, _)), machine) => format!("{head}{machine}"),
    };
    // As fast as the slowest of the machines can.
    let job = job.replace("reorient = 90 deg/s", "reorient = 60 deg/s");
    let job = job.replace(
        "output(12)\n",
        &format!("output(12)\n  {} {{ {block} }}\n", target.name),
    );
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    fs::create_dir(folder.path().join("shop")).unwrap();
    fs::write(folder.path().join("shop/arm.toml"), profile).unwrap();
    let run = vcutc(folder.path(), &["rib.vcut", "--target", target.name, "-q"]);
    (folder, run)
}

/// Decimals of the first coordinate of a program.
fn decimals(target: &Target, block: &str, profile: &str) -> usize {
    let (folder, run) = compiled(target, block, profile);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let text = fs::read_to_string(folder.path().join(target.file)).unwrap();
    let (_, coordinate) = text.split_once(target.before).unwrap();
    let number = coordinate.split([',', ' ']).next().unwrap();
    number.split_once('.').unwrap().1.len()
}

fn an_option_goes_before_the_profile_and_that_before_the_default(target: &Target, needed: &str) {
    let decimals = |own: &str, profile: &str| {
        let block = format!("{needed} {own} profile = \"shop/arm.toml\"");
        decimals(target, &block, profile)
    };
    assert_eq!(decimals("", ""), 3);
    assert_eq!(decimals("", "decimals = 5"), 5);
    assert_eq!(decimals("decimals = 4", "decimals = 5"), 4);
    assert_eq!(decimals("decimals = 6", "decimals = 5"), 6);
    assert_eq!(decimals("decimals = 3", "decimals = 5"), 3);
}

#[test]
fn in_krl_an_option_goes_before_the_profile() {
    an_option_goes_before_the_profile_and_that_before_the_default(&KRL, "");
}

#[test]
#[cfg(feature = "rapid")]
fn in_rapid_an_option_goes_before_the_profile() {
    an_option_goes_before_the_profile_and_that_before_the_default(&RAPID, "");
}

#[test]
#[cfg(feature = "gcode")]
fn in_gcode_an_option_goes_before_the_profile() {
    an_option_goes_before_the_profile_and_that_before_the_default(&GCODE, "dialect = sinumerik");
}

/// Decimals that a dialect does not read are a fault of the text that gives them.
#[test]
#[cfg(feature = "gcode")]
fn decimals_that_do_not_fit_are_reported_where_they_come_from() {
    let reported = |own: &str| {
        let block =
            format!("dialect = fanuc on_code = \"M50\" off_code = \"M51\" {own} profile = \"shop/arm.toml\"");
        let (_folder, run) = compiled(&GCODE, &block, "decimals = 5");
        assert_eq!(run.code, Some(1));
        run.stderr
    };
    let of_profile = reported("");
    assert!(
        of_profile.contains("VC0604") && of_profile.contains("what the profile's `decimals` asks"),
        "{of_profile}"
    );
    let of_option = reported("decimals = 6");
    assert!(
        of_option.contains("VC0604") && of_option.contains("option `decimals` does not fit"),
        "{of_option}"
    );
}

#[test]
fn a_profile_that_is_not_there_is_reported_where_it_is_named() {
    let (_folder, run) = compiled(&KRL, "profile = \"shop/leg.toml\"", "");
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("VC0212") && run.stderr.contains("`shop/leg.toml`"),
        "{}",
        run.stderr
    );
    let (_folder, run) = compiled(&KRL, "profile = arm", "");
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr
            .contains("`profile` takes the name of a file in quotes"),
        "{}",
        run.stderr
    );
}
