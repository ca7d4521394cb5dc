//! `vcutc init`: its jobs compile, on every machine of the catalogue, and nothing is written over.

use super::{command, folder, names, run, vcutc};
use crate::repository::read;
use std::fs;
use std::path::Path;
use vcutc::machine::catalogue;

#[test]
fn a_first_job_compiles_and_has_the_layout() {
    let folder = folder();
    let made = vcutc(folder.path(), &["init"]);
    assert_eq!(
        (made.code, made.stdout.as_str()),
        (Some(0), ""),
        "{}",
        made.stderr
    );
    assert_eq!(made.stderr, "wrote first.vcut\nnext: vcutc check first.vcut\n");
    for args in [["check", "first.vcut"], ["fmt", "--check"]] {
        let run = vcutc(folder.path(), &args);
        assert_eq!(run.code, Some(0), "{args:?}: {}", run.stderr);
    }
}

#[test]
fn a_job_that_is_there_is_not_written_over() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), "mine").unwrap();
    for name in ["rib", "rib.vcut"] {
        let run = vcutc(folder.path(), &["init", name]);
        assert_eq!(run.code, Some(2));
        assert!(
            run.stderr.starts_with("error: rib.vcut is already there\n"),
            "{}",
            run.stderr
        );
    }
    assert_eq!(
        fs::read_to_string(folder.path().join("rib.vcut")).unwrap(),
        "mine"
    );
}

#[test]
fn wrong_names_are_refused_and_leave_nothing() {
    let folder = folder();
    let machine = vcutc(folder.path(), &["init", "--robot", "kuka/kr210_r3100_ulta"]);
    assert_eq!(machine.code, Some(2));
    assert!(
        machine.stderr.contains("`kuka/kr210_r3100_ultra`"),
        "{}",
        machine.stderr
    );
    let name = vcutc(folder.path(), &["init", "\"a"]);
    assert_eq!(name.code, Some(2), "{}", name.stderr);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_machine_of_ones_own_will_do() {
    let folder = folder();
    fs::write(
        folder.path().join("gantry.toml"),
        read("examples/shop/gantry.toml"),
    )
    .unwrap();
    let made = vcutc(folder.path(), &["init", "rib", "--robot", "gantry.toml"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let written = vcutc(folder.path(), &["rib.vcut", "--target", "gcode", "-o", "out"]);
    assert_eq!(written.code, Some(0), "{}", written.stderr);
}

/// What is untrue of a job with an upright blade, if that can lean on its machine.
fn leans_all_the_same(folder: &Path, job: &str) -> Option<&'static str> {
    const UPRIGHT: &str = "rake      = 90 deg";
    if !job.contains(UPRIGHT) {
        return None;
    }
    let leaning = job.replace(UPRIGHT, "rake      = 60 deg");
    fs::write(folder.join("leaning.vcut"), leaning).unwrap();
    let run = vcutc(folder, &["check", "--help-budget", "0s", "leaning.vcut"]);
    let is_said = job.contains("With a blade that leans along the cut");
    match (run.code, is_said) {
        (Some(1), true) => None,
        (Some(1), false) => Some("does not say why the blade is upright"),
        (_, _) => Some("the blade could lean"),
    }
}

/// The job of every machine of the catalogue is written for its control, in the way that `init` says.
#[test]
fn every_machine_of_the_catalogue_gets_a_program() {
    let mut failed = Vec::new();
    for machine in catalogue::names() {
        let folder = folder();
        let made = vcutc(folder.path(), &["init", "part", "--robot", machine]);
        let next = made
            .stderr
            .lines()
            .find_map(|line| line.strip_prefix("next: vcutc "));
        let Some(next) = next.filter(|_| made.code == Some(0)) else {
            failed.push(format!("{machine}: {}", made.stderr));
            continue;
        };
        let args: Vec<&str> = next.split(' ').collect();
        let written = run(command(folder.path(), &args));
        if written.code != Some(0) || names(&folder.path().join("out")).is_empty() {
            failed.push(format!("{machine}: {}", written.stderr));
        }
        let job = fs::read_to_string(folder.path().join("part.vcut")).unwrap();
        if let Some(what) = leans_all_the_same(folder.path(), &job) {
            failed.push(format!("{machine}: {what}"));
        }
        let model = catalogue::find(machine).unwrap();
        let has_rates = model.axes.iter().all(|axis| axis.rate.is_some());
        if job.contains("has no speeds") == has_rates {
            failed.push(format!("{machine}: speeds that the sheet lacks are to be named"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
