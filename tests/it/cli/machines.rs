//! `vcutc machines`: the catalogue, one machine, a file of one's own, and what is neither.

use super::{folder, json_lines, vcutc};
use crate::repository::read;
use insta::assert_snapshot;
use std::fs;

const ARM: &str = r#"model = "Shop arm"
[opw]
a1_mm = 300.0
a2_mm = -100.0
b_mm = 0.0
c1_mm = 700.0
c2_mm = 900.0
c3_mm = 1000.0
c4_mm = 150.0
joint_offsets_deg = [0, 0, -90, 0, 0, 0]
joint_signs = [1, 1, 1, 1, 1, 1]
[limits]
limits_deg = [[-180, 180], [-60, 80], [-70, 160], [-300, 300], [-120, 120], [-360, 360]]
"#;

#[test]
fn the_catalogue_is_a_table() {
    let run = vcutc(folder().path(), &["machines"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_snapshot!("machines", run.stdout);
}

#[test]
fn one_machine_is_shown_with_its_sources() {
    let run = vcutc(folder().path(), &["machines", "kuka/kr210_r3100_ultra"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_snapshot!("machines_one", run.stdout);
}

#[test]
fn programs_read_the_same_as_json() {
    let run = vcutc(folder().path(), &["machines", "--message-format", "json"]);
    let list = json_lines(&run.stdout);
    assert!(
        list.iter()
            .all(|line| line["kind"] == "machine" && line["schema"] == 1)
    );
    let ultra = list
        .iter()
        .find(|line| line["name"] == "kuka/kr210_r3100_ultra")
        .unwrap();
    assert_eq!(ultra["payload_kg"], 210.0);
    assert_eq!(ultra["confidence"], "high");

    let run = vcutc(
        folder().path(),
        &["machines", "abb/irb6660_205_190", "--message-format", "json"],
    );
    let [machine] = json_lines(&run.stdout).try_into().unwrap();
    assert_eq!(machine["axes"][1]["min"], -42.0);
    assert_eq!(machine["mechanism"]["j2_j3_parallelogram"], true);
    assert_eq!(machine["mechanism"]["c2_mm"], 700.0);
    assert_eq!(machine["facts"]["fk_checks"][0]["xyz_mm"][2], 1794.5);
}

#[test]
fn a_file_of_ones_own_is_shown_or_refused_with_its_places() {
    let folder = folder();
    fs::write(folder.path().join("arm.toml"), ARM).unwrap();
    let run = vcutc(folder.path(), &["machines", "arm.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_snapshot!(run.stdout, @r"
    arm.toml  Shop arm
      robot, controller: other

      axis  from      to       rate  acceleration  jerk
      J1    -180 deg  180 deg  -     -             -
      J2    -60 deg   80 deg   -     -             -
      J3    -70 deg   160 deg  -     -             -
      J4    -300 deg  300 deg  -     -             -
      J5    -120 deg  120 deg  -     -             -
      J6    -360 deg  360 deg  -     -             -

      ortho-parallel arm with spherical wrist (Brandstötter, Angerer, Hofbaur 2014)
        lengths in mm   a1 300  a2 -100  b 0  c1 700  c2 900  c3 1000  c4 150
        zero offsets    0 0 -90 0 0 0 deg
        senses          1 1 1 1 1 1
        axis 3 counts   the angle at the elbow
    ");

    fs::write(
        folder.path().join("arm.toml"),
        ARM.replace("[-60, 80]", "[80, -60]"),
    )
    .unwrap();
    let run = vcutc(folder.path(), &["machines", "arm.toml"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert_snapshot!(run.stderr, @r"
    error[VC0502]: a range of `limits_deg` ends before it begins: 80 deg is not below -60 deg
        ╭─[ arm.toml:13:28 ]
        │
     13 │ limits_deg = [[-180, 180], [80, -60], [-70, 160], [-300, 300], [-120, 120], [-360, 360]]
        │                            ┬────────
        │                            ╰────────── the first number is the lower end
        │
        = help: write `[-60.0, 80.0]`
    ");
}

#[test]
fn the_sheet_of_the_manual_is_a_machine() {
    let manual = read("docs/machines.md");
    let sheet = manual
        .split("```toml\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    let folder = folder();
    fs::write(folder.path().join("arm.toml"), sheet).unwrap();
    let run = vcutc(folder.path(), &["machines", "arm.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert!(run.stdout.contains("controller: ABB"), "{}", run.stdout);
}

#[test]
fn what_is_not_a_machine_is_refused_with_what_was_meant() {
    let folder = folder();
    let run = vcutc(folder.path(), &["machines", "kuka/kr210_r3199"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    let expected =
        "error: there is no machine `kuka/kr210_r3199` in the catalogue\n  help: did you mean `kuka/";
    assert!(run.stderr.starts_with(expected), "{}", run.stderr);
    let run = vcutc(folder.path(), &["machines", "none.toml"]);
    assert_eq!(run.code, Some(2));
    assert_snapshot!(run.stderr, @"error: cannot read `none.toml`: there is no such file");
    fs::write(folder.path().join("bytes.toml"), [0x6d, 0xff]).unwrap();
    let run = vcutc(folder.path(), &["machines", "bytes.toml"]);
    assert_eq!(run.code, Some(2));
    assert_snapshot!(run.stderr, @"error: cannot read `bytes.toml`: it is not a UTF-8 text file, byte 2 is not valid");
}
