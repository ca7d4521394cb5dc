//! Warnings: what they keep from being written when they are denied, and what is said of a program in JSON.

use super::jobs::RIB;
use super::{folder, json_lines, names, vcutc};
use std::fs;
use tempfile::TempDir;

/// A folder with the rib on a robot without known rates, `slow.vcut`, and on the usual one, `rib.vcut`.
fn shop() -> TempDir {
    let folder = folder();
    let slow = RIB
        .replace("job \"rib\"", "job \"slow\"")
        .replace("kr210_r3100_ultra", "kr120_r2500_pro")
        .replace("x = 1700 mm, y = -600 mm", "x = 1500 mm, y = -400 mm");
    assert_ne!(slow, RIB);
    fs::write(folder.path().join("slow.vcut"), slow).unwrap();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    folder
}

#[test]
fn denied_warnings_end_with_1_and_write_nothing() {
    let shop = shop();
    let path = shop.path();
    let before = names(path);
    for (args, last) in [
        (
            vec!["check", "slow.vcut", "--deny-warnings"],
            "slow.vcut: no errors and 1 warning; warnings are denied\n",
        ),
        (
            vec!["slow.vcut", "--target", "krl", "-o", "out", "--deny-warnings"],
            "slow.vcut: no errors and 1 warning; warnings are denied; nothing was written\n",
        ),
        (
            vec!["slow.vcut", "--emit", "plan", "-o", "out", "--deny-warnings"],
            "slow.vcut: no errors and 1 warning; warnings are denied\n",
        ),
    ] {
        let run = vcutc(path, &args);
        assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""), "{args:?}");
        assert!(run.stderr.contains("warning[VC0517]"), "{}", run.stderr);
        assert!(run.stderr.ends_with(last), "{}", run.stderr);
        assert_eq!(names(path), before, "{args:?}");
    }
    // What is allowed is shown all the same.
    let run = vcutc(
        path,
        &["check", "slow.vcut", "--deny-warnings", "--allow", "VC0517"],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("warning[VC0517]"), "{}", run.stderr);
    let run = vcutc(
        path,
        &["check", "slow.vcut", "--deny-warnings", "--allow", "VC0529"],
    );
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    for (code, reason) in [
        ("VC0512", "VC0512 is an error"),
        ("VC9999", "there is no such code"),
    ] {
        let run = vcutc(path, &["check", "slow.vcut", "--deny-warnings", "--allow", code]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(reason), "{}", run.stderr);
    }
    // Without a warning nothing changes, and without the flag the warning is only shown.
    let run = vcutc(
        path,
        &["rib.vcut", "--target", "krl", "-o", "out", "--deny-warnings"],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let run = vcutc(path, &["slow.vcut", "--target", "krl", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(
        names(&path.join("out")),
        ["rib.dat", "rib.src", "slow.dat", "slow.src"]
    );
}

#[test]
fn a_list_writes_the_programs_without_warnings() {
    let shop = shop();
    let list = "[[program]]\njobs = [\"*.vcut\"]\ntarget = \"krl\"\noutput = \"out\"\n";
    fs::write(shop.path().join("vcut.toml"), list).unwrap();
    let run = vcutc(shop.path(), &["build", "--deny-warnings"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(
        run.stderr
            .contains("slow.vcut: no errors and 1 warning; warnings are denied; for krl nothing was written"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr.contains("2 programs: 1 written, 1 failed"),
        "{}",
        run.stderr
    );
    assert_eq!(names(&shop.path().join("out")), ["rib.dat", "rib.src"]);
    let run = vcutc(shop.path(), &["build"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

/// Warnings that come with the files of a program keep it from being written, too.
#[test]
fn parts_of_an_earlier_version_are_a_warning_as_any_other() {
    let shop = shop();
    fs::create_dir(shop.path().join("out")).unwrap();
    fs::write(shop.path().join("out/rib_p001.src"), "earlier").unwrap();
    let run = vcutc(
        shop.path(),
        &["rib.vcut", "--target", "krl", "-o", "out", "--deny-warnings"],
    );
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("warning[VC0805]"), "{}", run.stderr);
    assert_eq!(names(&shop.path().join("out")), ["rib_p001.src"]);
}

/// The summary of a run in JSON.
fn summary(shop: &TempDir, args: &[&str]) -> serde_json::Value {
    let run = vcutc(shop.path(), &[args, &["--message-format", "json"]].concat());
    let mut lines = json_lines(&run.stderr);
    lines.pop().unwrap()
}

#[test]
fn json_names_the_checks_with_their_reasons() {
    let shop = shop();
    let of = |summary: &serde_json::Value, name: &str| -> Vec<serde_json::Value> {
        let checks = summary["verdict"]["checks"].as_array().unwrap();
        checks
            .iter()
            .filter(|check| check["check"] == name)
            .cloned()
            .collect()
    };
    let slow = summary(&shop, &["check", "slow.vcut"]);
    assert_eq!(slow["errors"], 0);
    assert_eq!(slow["warnings"], 1);
    assert_eq!(slow["verdict"]["standing"], "in_part");
    let rates = of(&slow, "axis_rate");
    assert_eq!(rates.len(), 6);
    assert!(
        rates
            .iter()
            .all(|rate| rate["made"] == false && rate["reason"] == "not_stated")
    );
    assert!(of(&slow, "read_back").is_empty(), "nothing was written");

    let rib = summary(&shop, &["rib.vcut", "--target", "krl", "-o", "out"]);
    assert_eq!(rib["verdict"]["standing"], "proven");
    assert!(of(&rib, "axis_rate").iter().all(|rate| rate["made"] == true));
    assert_eq!(of(&rib, "read_back")[0]["made"], true);
    assert_eq!(of(&rib, "collisions")[0]["reason"], "no_body");
    assert!(
        rib["verdict"]["not_checked"]
            .as_str()
            .unwrap()
            .contains("collisions of the machine")
    );
}

#[test]
fn json_has_the_parameters_as_numbers() {
    let shop = shop();
    let rib = summary(&shop, &["check", "rib.vcut"]);
    let parameters = rib["operations"][0]["parameters"].as_array().unwrap();
    let of = |name: &str| parameters.iter().find(|one| one["name"] == name).unwrap();
    assert_eq!(
        of("layer"),
        &serde_json::json!({"name": "layer", "value": 4.0, "unit": "mm", "origin": "given"})
    );
    assert_eq!(of("lattice")["value"], "orthogonal");
    assert_eq!(of("step")["origin"], "auto");
    assert_eq!(of("run_out")["origin"], "default");
    // The line for people has the same number.
    let auto = rib["lines"].as_array().unwrap().iter().find_map(|line| {
        let line = line.as_str()?.trim_start().strip_prefix("auto")?;
        line.trim()
            .split(", ")
            .find_map(|one| one.trim().strip_prefix("step = "))
    });
    assert_eq!(auto.unwrap(), format!("{} mm", of("step")["value"]));
    // Nothing has more decimals than the planner distinguishes.
    for one in parameters.iter().filter_map(|one| one["value"].as_f64()) {
        assert!(
            one.to_string().split('.').nth(1).unwrap_or("").len() <= 3,
            "{one}"
        );
    }
}

/// The first line is the answer, from the same numbers.
#[test]
fn the_summary_begins_with_the_answer() {
    let shop = shop();
    let rib = summary(&shop, &["check", "rib.vcut"]);
    let numbers = &rib["numbers"];
    let head = rib["lines"][0].as_str().unwrap();
    let scallop = numbers["scallop_mm"].as_f64().unwrap();
    let expected = format!(
        ", {} cuts in {} layers, scallop {scallop:.2} mm, margin {} ",
        numbers["cuts"],
        numbers["layers"],
        rib["reach"]["least"]["of"].as_str().unwrap()
    );
    let (time, margin) = head
        .split_once(&expected)
        .unwrap_or_else(|| panic!("{head} / {expected}"));
    assert!(time.starts_with("rib: ") && time.ends_with(" s"), "{time}");
    // Rounded down to a tenth of a percent, from a share of four decimals.
    let margin: f64 = margin.trim_end_matches(" %").parse().unwrap();
    let share = rib["reach"]["margin"].as_f64().unwrap() * 100.0;
    assert!((-0.006..0.11).contains(&(share - margin)), "{share} {margin}");
}
