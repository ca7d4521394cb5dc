//! Figures of programs that are kept in a repository: when a build holds, and when it fails.

use super::jobs::RIB;
use super::{folder, json_lines, vcutc};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const LIST: &str = r#"[[program]]
jobs = "jobs/*.vcut"
target = "krl"
output = "programs"

[baseline]
file = "numbers.json"
time = "2 %"
scallop = "0 %"
"#;

fn repository() -> TempDir {
    let folder = folder();
    let path = folder.path();
    fs::create_dir_all(path.join("jobs")).unwrap();
    fs::write(path.join("jobs/rib.vcut"), RIB).unwrap();
    fs::write(path.join("vcut.toml"), LIST).unwrap();
    folder
}

fn accepted() -> TempDir {
    let folder = repository();
    let run = vcutc(folder.path(), &["build", "--accept"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    folder
}

/// What a build says, which ends with that code.
fn reported(path: &Path, arguments: &[&str], code: i32) -> String {
    let run = vcutc(path, arguments);
    assert_eq!(run.code, Some(code), "{}", run.stderr);
    run.stderr
}

fn numbers(path: &Path) -> String {
    fs::read_to_string(path.join("numbers.json")).unwrap()
}

fn change_job(path: &Path, old: &str, new: &str) {
    assert!(RIB.contains(old));
    fs::write(path.join("jobs/rib.vcut"), RIB.replace(old, new)).unwrap();
}

#[test]
fn an_accepted_program_holds_and_its_file_stays() {
    let repository = accepted();
    let path = repository.path();
    let first = numbers(path);
    reported(path, &["build"], 0);
    reported(path, &["build", "--check"], 0);
    // From a folder below, too.
    reported(&path.join("jobs"), &["build", "--check"], 0);
    assert_eq!(numbers(path), first);
    let record = &serde_json::from_str::<serde_json::Value>(&first).unwrap()[0];
    assert_eq!(
        (&record["job"], &record["target"], &record["output"]),
        (&"jobs/rib.vcut".into(), &"krl".into(), &"programs".into())
    );
    // The same figures as in messages.
    let run = vcutc(path, &["build", "--message-format", "json"]);
    let lines = json_lines(&run.stderr);
    let summary = lines.iter().find(|line| line["kind"] == "summary").unwrap();
    assert_eq!(summary["numbers"], record["numbers"]);
    let single = vcutc(path, &["check", "jobs/rib.vcut", "--message-format", "json"]);
    let lines = json_lines(&single.stderr);
    assert_eq!(lines.last().unwrap()["numbers"], record["numbers"]);
}

#[test]
fn a_program_that_takes_longer_is_not_written() {
    let repository = accepted();
    let path = repository.path();
    let before = fs::read(path.join("programs/rib.src")).unwrap();
    // A tenth slower while cutting: worse than 2 %; nothing else changes.
    change_job(path, "cut = 200 mm/s", "cut = 180 mm/s");
    let text = reported(path, &["build"], 1);
    assert!(
        text.contains("error[VC0806]: the program's time of jobs/rib.vcut for krl has grown from "),
        "{text}"
    );
    assert!(
        text.contains("2 % are allowed") && text.contains("vcut.toml:8:8"),
        "{text}"
    );
    assert!(
        text.contains("nothing was written") && text.contains("1 failed"),
        "{text}"
    );
    assert_eq!(fs::read(path.join("programs/rib.src")).unwrap(), before);
    reported(path, &["build", "--check"], 1);
    // What helps is what the message says.
    reported(path, &["build", "--accept"], 0);
    reported(path, &["build"], 0);
    assert_ne!(fs::read(path.join("programs/rib.src")).unwrap(), before);
}

#[test]
fn a_program_that_is_better_holds_and_the_bar_stays() {
    let repository = accepted();
    let path = repository.path();
    let first = numbers(path);
    change_job(path, "cut = 200 mm/s", "cut = 400 mm/s");
    reported(path, &["build"], 0);
    assert_eq!(numbers(path), first);
}

#[test]
fn a_program_within_its_tolerance_holds() {
    let repository = accepted();
    let path = repository.path();
    change_job(path, "clearance = 10 mm", "clearance = 10.5 mm");
    reported(path, &["build"], 0);
}

#[test]
fn a_program_that_is_new_is_reported() {
    let repository = accepted();
    let path = repository.path();
    fs::write(path.join("jobs/two.vcut"), RIB.replace("\"rib\"", "\"two\"")).unwrap();
    let text = reported(path, &["build"], 1);
    assert!(text.contains("error[VC0808]"), "{text}");
    assert!(
        text.contains("numbers.json has no figures of jobs/two.vcut"),
        "{text}"
    );
    assert!(!path.join("programs/two.src").exists());
    // Accepting one of them keeps the figures of the other.
    let rib = numbers(path).lines().nth(1).unwrap().to_owned();
    reported(path, &["build", "two", "--accept"], 0);
    assert!(numbers(path).contains(&rib));
    reported(path, &["build"], 0);
    // One that is not listed any more is forgotten.
    fs::remove_file(path.join("jobs/rib.vcut")).unwrap();
    reported(path, &["build", "--accept"], 0);
    assert!(!numbers(path).contains("jobs/rib.vcut"));
}

#[test]
fn a_job_with_errors_keeps_its_figures() {
    let repository = accepted();
    let path = repository.path();
    let first = numbers(path);
    change_job(path, "layer     = 4 mm", "layer     = 9 mm");
    reported(path, &["build", "--accept"], 1);
    assert_eq!(numbers(path), first);
}

#[test]
fn a_baseline_that_cannot_be_used_is_reported_at_its_place() {
    let repository = repository();
    let path = repository.path();
    let text = reported(path, &["build"], 1);
    assert!(
        text.contains("error[VC0807]: there is no file numbers.json"),
        "{text}"
    );
    assert!(text.contains("vcut.toml:7:8"), "{text}");
    fs::write(path.join("numbers.json"), "[\n{\"job\": 3}]").unwrap();
    let text = reported(path, &["build"], 1);
    assert!(
        text.contains("error[VC0807]: these are not the figures of programs"),
        "{text}"
    );
    assert!(text.contains("numbers.json:2:"), "{text}");
    fs::write(path.join("vcut.toml"), LIST.split("[baseline]").next().unwrap()).unwrap();
    let text = reported(path, &["build", "--accept"], 1);
    assert!(text.contains("error[VC0807]: the list names no file"), "{text}");
    reported(path, &["build"], 0);
}

#[test]
fn a_file_that_is_not_a_baseline_is_not_overwritten() {
    let repository = repository();
    let path = repository.path();
    for name in ["vcut.toml", "jobs/rib.vcut", "programs/rib.src"] {
        let list = LIST.replace("numbers.json", name);
        fs::write(path.join("vcut.toml"), &list).unwrap();
        let text = reported(path, &["build", "--accept"], 2);
        assert!(text.contains("does not contain figures of programs"), "{text}");
        assert_eq!(fs::read_to_string(path.join("vcut.toml")).unwrap(), list);
    }
    assert_eq!(fs::read_to_string(path.join("jobs/rib.vcut")).unwrap(), RIB);
    // Nor is one that was spoiled, by a merge for one.
    let repository = accepted();
    let path = repository.path();
    let spoiled = format!("<<<<<<< ours\n{}", numbers(path));
    fs::write(path.join("numbers.json"), &spoiled).unwrap();
    reported(path, &["build", "--accept"], 2);
    assert_eq!(numbers(path), spoiled);
}
