//! `vcutc optimize`: what it prints, what it writes, and what it refuses.

use super::{copy, folder, json_lines, names, vcutc};
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
        "write it again with the command in docs/optimum.md"
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
    // A finer surface takes longer, and each plan is within its limit.
    let points = operation["trade_off"]["points"].as_array().unwrap();
    let figure = |point: &Value, of: &str| point["planned"][of].as_f64().unwrap();
    let planned: Vec<&Value> = points
        .iter()
        .filter(|point| !point["planned"].is_null())
        .collect();
    assert!(planned.len() >= 3, "{points:?}");
    for point in &planned {
        assert!(
            figure(point, "leaves") <= point["limit"].as_f64().unwrap() + 1e-3,
            "{point}"
        );
    }
    for pair in planned.windows(2) {
        assert!(pair[0]["limit"].as_f64() < pair[1]["limit"].as_f64(), "{pair:?}");
        assert!(figure(pair[0], "time") > figure(pair[1], "time"), "{pair:?}");
    }
}

/// What a job without a machine takes, in s.
fn time_of(job: &str, more: &[&str]) -> f64 {
    let folder = folder();
    fs::write(folder.path().join("block.vcut"), job).unwrap();
    let asked = [
        &[
            "optimize",
            "block.vcut",
            "--points",
            "2",
            "--message-format",
            "json",
        ],
        more,
    ]
    .concat();
    let run = vcutc(folder.path(), &asked);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let answer: Value = serde_json::from_str(&run.stdout).unwrap();
    answer["operations"][0]["planned"]["time"].as_f64().unwrap()
}

/// A job that is changed as an answer says takes the time that the answer says.
#[test]
fn what_wider_limits_save_is_saved_by_the_changed_job() {
    let before = answer(&["--points", "2", "--set", "coarsest=6mm"]);
    let operation = &before["operations"][0];
    let now = operation["trade_off"]["now"]["time"].as_f64().unwrap();
    let wider = operation["wider"].as_array().unwrap();
    assert!(wider.len() >= 2, "{wider:?}");
    for bound in wider {
        let words = bound["words"].as_str().unwrap();
        let then = bound["wider"].as_str().unwrap();
        let coarsest = format!(
            "coarsest={}",
            if words.starts_with("scallop") { then } else { "6mm" }
        );
        let changed = match words {
            "scallop <= 6 mm" => BLOCK.to_owned(),
            "swing <= 50 deg" => BLOCK.replace(words, &format!("swing <= {then}")),
            "cutting_length = 10 mm" => BLOCK.replace(words, &format!("cutting_length = {then}")),
            other => panic!("the job says nothing of {other}"),
        };
        let took = time_of(&changed, &["--set", &coarsest]);
        assert!(
            (bound["planned"]["time"].as_f64().unwrap() - took).abs() < 1e-9,
            "{bound}: {took} s"
        );
        assert!(
            (now - took - bound["gain"].as_f64().unwrap()).abs() < 1e-9,
            "{bound}: {took} s"
        );
    }
}

/// Each plan of a trade-off keeps its limit, and the job under that limit is not faster.
#[test]
fn time_is_traded_against_cuts_and_edge() {
    for (against, figure) in [("scallop", "leaves"), ("cuts", "cuts"), ("edge", "edge")] {
        let answer = answer(&["--points", "5", "--against", against]);
        let trade_off = &answer["operations"][0]["trade_off"];
        assert_eq!(trade_off["against"], against);
        let points = trade_off["points"].as_array().unwrap();
        assert!(!points.is_empty(), "{trade_off}");
        for point in points.iter().filter(|point| !point["planned"].is_null()) {
            let limit = point["limit"].as_f64().unwrap();
            assert!(
                point["planned"][figure].as_f64().unwrap() <= limit + 1e-3,
                "{point}"
            );
            let unit = if against == "cuts" { "" } else { " mm" };
            let changed = match against {
                "scallop" => BLOCK.replace("let coarsest = 10 mm", &format!("let coarsest = {limit} mm")),
                other => BLOCK.replace(
                    "swing <= 50 deg,",
                    &format!("swing <= 50 deg, {other} <= {limit}{unit},"),
                ),
            };
            let took = time_of(&changed, &[]);
            assert!(
                point["planned"]["time"].as_f64().unwrap() <= took + 1e-9,
                "{point}: {took} s"
            );
        }
    }
}

/// What there are too many cuts for is not planned, and is named. The more points, the closer they are, and none is lost.
#[test]
fn what_is_not_planned_is_named() {
    let fine = BLOCK.replace(
        "  rake = 60 deg\n",
        "  rake = 60 deg\n  lattice = orthogonal\n  layer = 0.6 mm\n  model = paper\n",
    );
    let folder = folder();
    fs::write(folder.path().join("block.vcut"), fine).unwrap();
    let run = vcutc(
        folder.path(),
        &[
            "optimize",
            "block.vcut",
            "--points",
            "3",
            "--message-format",
            "json",
        ],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    let operation = &found["operations"][0];
    assert!(
        operation["planned"]["cuts"].as_u64().unwrap() > 3_000,
        "{}",
        operation["planned"]
    );
    let named = operation["not_wider"].as_array().unwrap();
    assert!(!named.is_empty(), "{operation}");
    let trade_off = &operation["trade_off"];
    assert_eq!(trade_off["now"]["cuts"], operation["planned"]["cuts"]);
    let points = trade_off["points"].as_array().unwrap();
    assert!(
        points.iter().any(|point| point["outcome"] == "not_planned"),
        "{trade_off}"
    );

    let limits = |points: &str| -> Vec<f64> {
        let answer = answer(&["--points", points]);
        let trade_off = answer["operations"][0]["trade_off"]["points"]
            .as_array()
            .unwrap()
            .clone();
        let planned = trade_off.iter().filter(|point| point["outcome"] != "not_planned");
        planned.map(|point| point["limit"].as_f64().unwrap()).collect()
    };
    assert!(limits("40").len() >= limits("10").len());
}

/// A limit that the compiler chose is part of what other lattices are compared under.
#[test]
fn a_chosen_limit_is_named_where_a_change_depends_on_it() {
    let open = BLOCK
        .replace(", scallop <= coarsest", "")
        .replace("  rake = 60 deg\n", "  rake = 60 deg\n  lattice = orthogonal\n");
    let folder = folder();
    fs::write(folder.path().join("block.vcut"), &open).unwrap();
    let run = vcutc(
        folder.path(),
        &[
            "optimize",
            "block.vcut",
            "--points",
            "2",
            "--message-format",
            "json",
        ],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let answer: Value = serde_json::from_str(&run.stdout).unwrap();
    let faster = &answer["operations"][0]["faster"][0];
    let change = faster["change"].as_str().unwrap();
    let (lattice, limits) = change
        .split_once(" and limits { ")
        .unwrap_or_else(|| panic!("{faster}"));
    let limit = limits.trim_end_matches(" }");
    let changed = open.replace("lattice = orthogonal", lattice).replace(
        "limits { swing <= 50 deg",
        &format!("limits {{ swing <= 50 deg, {limit}"),
    );
    let took = time_of(&changed, &[]);
    assert!(
        (faster["planned"]["time"].as_f64().unwrap() - took).abs() < 1e-9,
        "{change}: {took} s"
    );
}

/// The operations of a job are planned under other limits one by one, with those before them.
#[test]
fn jobs_of_several_operations_have_plans_under_other_limits() {
    let run = vcutc(
        root(),
        &[
            "optimize",
            "examples/two_blades.vcut",
            "--points",
            "3",
            "--message-format",
            "json",
        ],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let answer: Value = serde_json::from_str(&run.stdout).unwrap();
    let operations = answer["operations"].as_array().unwrap();
    assert_eq!(operations.len(), 2);
    for operation in operations {
        let trade_off = &operation["trade_off"];
        assert_eq!(trade_off["now"]["cuts"], operation["planned"]["cuts"]);
        let points = trade_off["points"].as_array().unwrap();
        assert!(
            points.iter().any(|point| !point["planned"].is_null()),
            "{trade_off}"
        );
    }
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
fn jobs_with_errors_are_reported_as_usual() {
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

/// Every saving that is listed is the one of the job with that change, as an engineer would make it.
#[test]
fn savings_of_other_operations_are_those_of_the_changed_job() {
    let out = folder();
    copy(&root().join("examples/shop"), &out.path().join("shop"));
    let text = read("examples/window.vcut");
    let job = out.path().join("window.vcut");
    fs::write(&job, &text).unwrap();
    let answer = json(out.path(), &["optimize", "window.vcut"]);
    let time = |text: &str| {
        fs::write(&job, text).unwrap();
        let run = vcutc(out.path(), &["check", "window.vcut", "--message-format", "json"]);
        let summary = json_lines(&run.stderr).pop().unwrap();
        summary["numbers"]["time_s"].as_f64().unwrap()
    };
    let now = time(&text);
    let mut kinds = std::collections::BTreeSet::new();
    for other in answer["others"].as_array().unwrap() {
        for value in other["values"].as_array().unwrap() {
            let words = value["words"].as_str().unwrap();
            let place: Vec<&str> = value["place"].as_str().unwrap().split(':').collect();
            let [file, line, column] = place.as_slice() else {
                panic!("{value}");
            };
            if *file != "window.vcut" {
                continue;
            }
            let (line, column): (usize, usize) = (line.parse().unwrap(), column.parse().unwrap());
            let before = words.split("= ").nth(1).unwrap();
            let start: usize = text
                .lines()
                .take(line - 1)
                .map(|line| line.len() + 1)
                .sum::<usize>()
                + column
                - 1;
            assert!(text[start..].starts_with(before), "{value}");
            let changed = format!(
                "{}{}{}",
                &text[..start],
                value["other"].as_str().unwrap(),
                &text[start + before.len()..]
            );
            let then = time(&changed);
            assert!(
                (then - value["time"].as_f64().unwrap()).abs() < 1e-3,
                "{value}: {then}"
            );
            assert!(
                (1.0 - then / now - value["share"].as_f64().unwrap()).abs() < 1e-4,
                "{value}: {then} of {now}"
            );
            kinds.insert(words.split(" = ").next().unwrap().to_owned());
        }
    }
    assert!(
        kinds.contains("feed plunge") && kinds.contains("feed cut"),
        "{kinds:?}"
    );
}

/// A finer surface takes the disc longer, and the picture is that of its operation.
#[test]
fn time_is_traded_against_the_scallop_of_a_disc() {
    let out = folder();
    let picture = out.path().join("dome.svg");
    let arguments = [
        "optimize",
        "examples/finished_dome.vcut",
        "--points",
        "3",
        "-o",
        picture.to_str().unwrap(),
    ];
    let answer = json(root(), &arguments);
    let points = answer["others"][0]["trade_off"].as_array().unwrap();
    let figures: Vec<(f64, f64)> = points
        .iter()
        .map(|point| (point["limit"].as_f64().unwrap(), point["time"].as_f64().unwrap()))
        .collect();
    let limits: Vec<f64> = figures.iter().map(|(limit, _)| *limit).collect();
    assert_eq!(limits, [0.025, 0.1, 0.4]);
    assert!(
        figures.windows(2).all(|pair| pair[0].1 > pair[1].1),
        "{figures:?}"
    );
    assert_eq!(names(out.path()), ["dome_1.svg", "dome_2.svg"]);
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let run = vcutc(folder, &[arguments, &["--message-format", "json"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    serde_json::from_str(&run.stdout).unwrap()
}
