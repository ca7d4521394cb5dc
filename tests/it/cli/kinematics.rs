//! `vcutc fk` and `vcutc ik`: known poses, all turns, and invalid numbers.

use super::{Run, folder, json_lines, vcutc};
use insta::assert_snapshot;

const ULTRA: &str = "kuka/kr210_r3100_ultra";

fn answer(args: &[&str]) -> String {
    let run = vcutc(folder().path(), args);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{args:?}");
    run.stdout
}

fn refusal(args: &[&str]) -> String {
    let Run { code, stdout, stderr } = vcutc(folder().path(), args);
    assert_eq!((code, stdout.as_str()), (Some(2), ""), "{args:?}");
    stderr
}

#[test]
fn home_of_a_kuka_has_status_2_and_turn_2() {
    assert_snapshot!(answer(&["fk", ULTRA, "--joints", "0,-90,90,0,0,0"]), @r"
    kuka/kr210_r3100_ultra: flange in the root
      x 1990 mm, y 0 mm, z 1984 mm
      a 0 deg, b 90 deg, c 0 deg
      quaternion 0.70710678, 0, 0.70710678, 0
      wrist in front of axis 1, forearm folded forward, axis 5 positive
      S 2 ('B010')
      on a boundary: axis 5 is at 0, so that of axes 4 and 6 only the sum counts
      T 2 ('B000010')
    ");
}

#[test]
fn tool_and_base_make_it_the_blade_in_the_work() {
    let text = answer(&[
        "fk",
        "abb/irb6700_200_260",
        "--joints",
        "0 deg, 0, 0, 0, 200deg, 0",
        "--tool",
        "0,0,100,0,0,0",
        "--base",
        "1662.5,0,2105mm,0,90,0",
    ]);
    assert_snapshot!("fk_with_tool_and_base", text);
}

#[test]
fn all_ways_of_an_arm_are_listed_with_their_turns() {
    let text = answer(&["ik", ULTRA, "--pose", "1800,200,1500,0,100,10"]);
    assert_snapshot!("ik_of_a_kuka", text);
    let text = answer(&[
        "ik",
        "abb/irb6660_205_190",
        "--pose",
        "1500,200,1000",
        "--quaternion",
        "0,0,1,0",
    ]);
    assert_snapshot!("ik_of_an_abb", text);
}

#[test]
fn what_an_inverse_lists_leads_back() {
    let line = answer(&[
        "ik",
        ULTRA,
        "--pose",
        "1800,200,1500,0,100,10",
        "--message-format",
        "json",
    ]);
    let [found] = json_lines(&line).try_into().unwrap();
    let solutions = found["solutions"].as_array().unwrap();
    assert!(solutions.len() > 8);
    for solution in solutions {
        let joints: Vec<String> = solution["joints"]
            .as_array()
            .unwrap()
            .iter()
            .map(ToString::to_string)
            .collect();
        let line = answer(&[
            "fk",
            ULTRA,
            "--joints",
            &joints.join(","),
            "--message-format",
            "json",
        ]);
        let [reached] = json_lines(&line).try_into().unwrap();
        for (at, want) in [1800.0, 200.0, 1500.0].into_iter().enumerate() {
            assert!((reached["pose"]["xyz_mm"][at].as_f64().unwrap() - want).abs() < 1e-5);
        }
        for key in ["status", "turn", "stands", "within_limits"] {
            assert_eq!(reached[key], solution[key], "{key}");
        }
    }
}

#[test]
fn a_five_axis_machine_says_what_it_lacks() {
    let pose = ["--pose", "0,0,400,0,30,150"];
    let bare = answer(&["ik", "generic/head_head_ac", pose[0], pose[1]]);
    assert_snapshot!("ik_of_a_head_that_lacks_a_spindle", bare);
    let with_spindle = answer(&["ik", "generic/head_head_ac_spindle", pose[0], pose[1]]);
    assert_snapshot!("ik_of_a_head_with_a_spindle", with_spindle);
    let swinging = answer(&["ik", "generic/head_head_ba", pose[0], pose[1]]);
    assert_snapshot!("ik_of_a_head_that_swings_and_rakes", swinging);
}

#[test]
fn axes_outside_of_their_limits_are_named() {
    let text = answer(&["fk", ULTRA, "--joints", "0,-150,90,0,0,400"]);
    assert!(text.contains("outside of its limits: A2 by 10 deg"), "{text}");
    assert!(text.contains("outside of its limits: A6 by 50 deg"), "{text}");
}

#[test]
fn bad_numbers_are_refused_with_a_way_out() {
    let wrong: &[&[&str]] = &[
        &["fk", ULTRA, "--joints", "0,-90,90"],
        &["fk", ULTRA, "--joints", "0,-90,90,0,NaN,0"],
        &["fk", ULTRA, "--joints", "0,-90,90,0,,0"],
        &["fk", ULTRA, "--joints", "0,-90,90 mm,0,0,0"],
        &["ik", ULTRA, "--pose", "1,2,3,4,5,1e300"],
        &["ik", ULTRA, "--pose", "1,2,3,4,5,6", "--quaternion", "1,0,0,0"],
        &["ik", ULTRA, "--pose", "1,2,3", "--quaternion", "1,0,0,1"],
        &["ik", ULTRA, "--pose", "1,2,3", "--quaternion", "0,0,0,0"],
        &["ik", ULTRA, "--pose", "1,2,3,4,5,6", "--tool", "1"],
        &["fk", "kuka/kr210_r3100_ulta", "--joints", "0"],
    ];
    let refusals = wrong
        .iter()
        .map(|args| format!("$ vcutc {}\n{}\n", args.join(" "), refusal(args)));
    assert_snapshot!("numbers_that_are_none", refusals.collect::<String>());
}

#[test]
fn a_place_out_of_reach_has_no_way() {
    let text = answer(&["ik", ULTRA, "--pose", "9000,0,0,0,0,0"]);
    assert!(
        text.ends_with("out of reach: no axis values bring it there\n"),
        "{text}"
    );
}
