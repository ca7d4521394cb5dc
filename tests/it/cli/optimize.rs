//! `vcutc optimize`: what it prints, what it writes, and what it refuses.

use super::{folder, names, vcutc};
use crate::repository::{read, root};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The block of Cui et al., without a machine.
const BLOCK: &str = "\
job \"block\"

stock { size = (85 mm, 50 mm, 50 mm) }

profile {
  start (0 mm, 6 mm)
  arc to (85 mm, 6 mm) through (42.5 mm, 16.514 mm)
}

blade dagger {
  cutting_length = 10 mm
  half_apex = 7.13 deg
  thickness = 0 mm
  edges = double
}

let coarsest = 10 mm

rough vcut {
  blade = dagger
  rake = 60 deg
  limits { swing <= 50 deg, scallop <= coarsest }
  feed { cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";

fn optimised(folder: &Path, more: &[&str]) -> super::Run {
    fs::write(folder.join("block.vcut"), BLOCK).unwrap();
    vcutc(folder, &[&["optimize", "block.vcut"], more].concat())
}

fn answer(more: &[&str]) -> Value {
    let run = optimised(folder().path(), &[&["--message-format", "json"], more].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    serde_json::from_str(&run.stdout).unwrap()
}

#[test]
fn tables_are_printed_and_a_picture_is_drawn() {
    let out = folder();
    let run = optimised(out.path(), &["--points", "6", "-o", "pareto.svg"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    insta::assert_snapshot!(run.stdout);
    assert_eq!(
        fs::read_to_string(out.path().join("block.vcut")).unwrap(),
        BLOCK,
        "the job stays as it is"
    );
    assert_eq!(names(out.path()), ["block.vcut", "pareto.svg"]);
}

/// The picture in the documentation is the one of the command there.
#[test]
fn the_picture_in_the_documentation_is_current() {
    let out = folder();
    let drawn = out.path().join("pareto.svg");
    let run = vcutc(
        root(),
        &[
            "optimize",
            "examples/block_cui.vcut",
            "-o",
            drawn.to_str().unwrap(),
        ],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(
        fs::read_to_string(drawn).unwrap(),
        read("docs/pictures/block_cui_pareto.svg"),
        "write it anew with the command in docs/optimum.md"
    );
}

#[test]
fn figures_come_as_json() {
    let answer = answer(&["--points", "4"]);
    assert_eq!(answer["kind"], "optimisation");
    let operation = &answer["operations"][0];
    assert_eq!(operation["lattice_given"], Value::Null);
    let rows = operation["best"].as_array().unwrap();
    assert_eq!(rows.len(), 6);
    let chosen: Vec<&Value> = rows.iter().filter(|row| row["chosen"] == true).collect();
    let [chosen] = chosen.as_slice() else {
        panic!("one is chosen, not {}", chosen.len());
    };
    let time = |row: &Value| row["parameters"]["time"].as_f64().unwrap();
    let exact = rows.iter().filter(|row| row["model"] == "exact");
    assert!(exact.clone().all(|row| time(chosen) <= time(row)));
    let planned = &operation["planned"];
    let above = planned["model"].as_f64().unwrap() / planned["time"].as_f64().unwrap() - 1.0;
    assert!((above - planned["model_above"].as_f64().unwrap()).abs() < 1e-12);
    // Finer surfaces take longer.
    let front = operation["trade_off"].as_array().unwrap();
    let falls = front.windows(2).all(|pair| {
        pair[0]["scallop"].as_f64() < pair[1]["scallop"].as_f64()
            && pair[0]["time"].as_f64() > pair[1]["time"].as_f64()
    });
    assert!(front.len() >= 4 && falls, "{front:?}");
}

/// What relaxing a bound is said to save is saved when the job is changed so.
#[test]
fn what_relaxing_a_bound_saves_is_saved_by_the_changed_job() {
    let time = |answer: &Value| {
        let rows = answer["operations"][0]["best"].as_array().unwrap().clone();
        let chosen = rows.into_iter().find(|row| row["chosen"] == true).unwrap();
        chosen["parameters"]["time"].as_f64().unwrap()
    };
    let before = answer(&["--points", "2", "--set", "coarsest=6mm"]);
    let binding = before["operations"][0]["binding"].as_array().unwrap().clone();
    let scallop = binding
        .iter()
        .find(|bound| bound["bound"] == "scallop")
        .unwrap_or_else(|| panic!("{binding:?}"));
    assert_eq!(scallop["words"], "scallop <= 6 mm");
    let relaxed = format!("coarsest={}", scallop["relaxed"].as_str().unwrap());
    let after = answer(&["--points", "2", "--set", &relaxed]);
    let saves = scallop["saves"].as_f64().unwrap();
    assert!(saves > 0.0, "{scallop}");
    assert!((time(&before) - time(&after) - saves).abs() < 1e-6 * time(&before));
}

#[test]
fn jobs_with_errors_are_told_of_as_ever() {
    let run = vcutc(root(), &["optimize", "examples/too_deep.vcut"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(
        run.stdout.is_empty() && run.stderr.contains("error[VC0401]"),
        "{}",
        run.stderr
    );
    let run = vcutc(root(), &["optimize", "none.vcut"]);
    assert_eq!(run.code, Some(2));
    let run = vcutc(root(), &["optimize", "examples/block_cui.vcut", "--points", "1"]);
    assert_eq!(run.code, Some(2));
}

#[test]
fn operations_along_given_tips_are_named() {
    let job = {
        let jobs = crate::repository::files("tests/jobs", "job.vcut");
        jobs.into_iter()
            .find(|job| job.text.contains("\n  tips"))
            .unwrap()
    };
    let folder = super::folder();
    let path = folder.path().join("job.vcut");
    std::fs::write(&path, &job.text).unwrap();
    let run = vcutc(root(), &["optimize", path.to_str().unwrap()]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stdout.contains("tips are given (") && run.stdout.contains("so there is nothing to choose"),
        "{}",
        run.stdout
    );
}

/// What has no formulas is reported as it is planned.
#[test]
fn a_job_without_lattices_is_reported_as_planned() {
    let run = vcutc(root(), &["optimize", "examples/hill_rect.vcut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("; as planned"), "{}", run.stdout);
    assert!(run.stdout.contains(" slits, "), "{}", run.stdout);
    // A picture that is asked for and cannot be made is not passed over.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.svg");
    let arguments = [
        "optimize",
        "examples/hill_rect.vcut",
        "-o",
        file.to_str().unwrap(),
    ];
    let run = vcutc(root(), &arguments);
    assert!(run.stdout.contains("no picture: "), "{}", run.stdout);
    assert!(!file.exists());
}
