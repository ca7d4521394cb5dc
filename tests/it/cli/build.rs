//! `vcutc build`: what is built from a list of programs, and what is reported of wrong lists.

use super::jobs::RIB;
use super::{folder, json_lines, names, vcutc};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const LIST: &str = r#"[[program]]
name = "ribs"
jobs = "jobs/*.vcut"
target = "krl"
output = "programs/{target}/{job}"

[[program]]
jobs = ["rib.vcut"]
target = "krl"
output = "narrow"
set = ["width=30mm"]
options = ["lines_per_part=0"]
"#;

/// A repository with a list of three programs.
fn repository() -> TempDir {
    let folder = folder();
    let path = folder.path();
    fs::create_dir_all(path.join("jobs/deeper")).unwrap();
    for name in ["left", "right"] {
        let job = RIB.replace("job \"rib\"", &format!("job \"{name}\""));
        fs::write(path.join(format!("jobs/{name}.vcut")), job).unwrap();
    }
    fs::write(path.join("rib.vcut"), RIB).unwrap();
    fs::write(path.join("vcut.toml"), LIST).unwrap();
    folder
}

fn without_time(text: &str) -> String {
    let lines = text.lines().map(|line| match line.rsplit_once(" (") {
        Some((start, end)) if end.ends_with(" s)") => format!("{start} (TIME)"),
        _ => line.to_owned(),
    });
    lines.map(|line| line.replace('\\', "/") + "\n").collect()
}

fn reported(folder: &Path, arguments: &[&str], code: i32) -> String {
    let run = vcutc(folder, arguments);
    assert_eq!(run.code, Some(code), "{}", run.stderr);
    assert_eq!(run.stdout, "");
    without_time(&run.stderr)
}

#[test]
fn a_whole_repository_is_built_then_unchanged_then_checked() {
    let repository = repository();
    let path = repository.path();
    let first = reported(path, &["build"], 0);
    assert_eq!(names(&path.join("programs/krl/left")), ["left.dat", "left.src"]);
    assert_eq!(names(&path.join("narrow")), ["rib.dat", "rib.src"]);
    let again = reported(&path.join("jobs/deeper"), &["build"], 0);
    assert!(again.contains("3 programs: 3 unchanged"), "{again}");
    let checked = reported(path, &["build", "--check"], 0);
    fs::write(
        path.join("programs/krl/right/right.src"),
        "DEF right( )\r\nEND\r\n",
    )
    .unwrap();
    fs::write(path.join("jobs/left.vcut"), RIB.replace("60 deg", "60 mm")).unwrap();
    let different = reported(path, &["build", "--check"], 1);
    assert!(
        different.contains("1 unchanged, 1 different, 1 failed"),
        "{different}"
    );
    insta::assert_snapshot!([first, again, checked].join("\n"));
}

#[test]
fn a_failing_job_leaves_the_others_their_programs() {
    let repository = repository();
    let path = repository.path();
    fs::write(path.join("jobs/left.vcut"), "job").unwrap();
    let reported = reported(path, &["build"], 1);
    assert!(reported.contains("3 programs: 2 written, 1 failed"), "{reported}");
    assert_eq!(names(&path.join("programs/krl")), ["right"]);
}

#[test]
fn single_programs_are_chosen_by_section_job_or_path() {
    let repository = repository();
    let path = repository.path();
    for (word, count) in [
        ("ribs", "2 programs"),
        ("left", "1 program:"),
        ("jobs/right.vcut", "1 program:"),
        ("./rib.vcut", "1 program:"),
    ] {
        let reported = reported(path, &["build", word, "--manifest", "vcut.toml"], 0);
        assert!(reported.contains(count), "{word}: {reported}");
    }
    let reported = reported(path, &["build", "lefft"], 2);
    assert!(reported.contains("did you mean `left`?"), "{reported}");
}

#[test]
fn the_last_object_is_the_total() {
    let repository = repository();
    let run = vcutc(repository.path(), &["build", "--message-format", "json"]);
    let lines = json_lines(&run.stderr);
    let kinds: Vec<_> = lines.iter().map(|line| line["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["summary", "summary", "summary", "total"]);
    assert_eq!(
        (&lines[3]["programs"], &lines[3]["written"]),
        (&3.into(), &3.into())
    );
}

#[test]
fn faults_of_a_list_are_reported_at_their_places() {
    let repository = repository();
    let text = LIST
        .replace("jobs = \"jobs", "job = \"jobs")
        .replace("{job}", "{jbo}")
        .replace(
            "target = \"krl\"\noutput = \"narrow",
            "target = 3\noutput = \"narrow",
        );
    fs::write(repository.path().join("vcut.toml"), text).unwrap();
    insta::assert_snapshot!(reported(repository.path(), &["build"], 1));
    assert!(!repository.path().join("narrow").exists());
}

#[test]
fn missing_jobs_are_reported() {
    let repository = repository();
    let text = LIST
        .replace("jobs/*.vcut", "job/*.vcut")
        .replace("\"rib.vcut\"", "\"rip.vcut\"");
    fs::write(repository.path().join("vcut.toml"), text).unwrap();
    insta::assert_snapshot!(reported(repository.path(), &["build"], 1));
}

#[test]
fn a_missing_target_is_reported() {
    let repository = repository();
    let text = LIST.replacen("\"krl\"", "\"krll\"", 1);
    fs::write(repository.path().join("vcut.toml"), text).unwrap();
    insta::assert_snapshot!(reported(repository.path(), &["build"], 1));
}

#[test]
fn two_programs_for_one_file_are_refused_before_anything_is_written() {
    let repository = repository();
    let path = repository.path();
    let text = LIST
        .replace("jobs/*.vcut", "*/*.vcut")
        .replace("programs/{target}/{job}", "narrow");
    fs::write(path.join("vcut.toml"), text).unwrap();
    fs::write(
        path.join("jobs/left.vcut"),
        RIB.replace("job \"rib\"", "job \"RIB\""),
    )
    .unwrap();
    insta::assert_snapshot!(reported(path, &["build"], 1));
    assert!(!path.join("narrow").exists() || names(&path.join("narrow")).is_empty());
    let run = vcutc(
        path,
        &["rib.vcut", "jobs/left.vcut", "--target", "krl", "-o", "both"],
    );
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("would both write"), "{}", run.stderr);
}

#[test]
fn several_jobs_can_share_a_folder_without_a_list() {
    let repository = repository();
    let path = repository.path();
    let arguments = ["rib.vcut", "jobs/left.vcut", "--target", "krl", "-o", "out"];
    assert!(reported(path, &arguments, 0).contains("2 programs: 2 written"));
    assert!(reported(path, &[&arguments[..], &["--check"]].concat(), 0).contains("2 programs: 2 unchanged"));
}

#[test]
fn hostile_lists_end_in_messages() {
    let folder = folder();
    for text in [
        "[[program]]\n".repeat(1000),
        "\0".repeat(1000),
        "a.".repeat(50_000),
        String::new(),
    ] {
        fs::write(folder.path().join("vcut.toml"), text).unwrap();
        let run = vcutc(folder.path(), &["build"]);
        assert_eq!(run.code, Some(1), "{}", run.stderr);
        assert!(run.stderr.contains("error[VC0801]"), "{}", run.stderr);
    }
    fs::write(folder.path().join("vcut.toml"), [0xff, 0xfe]).unwrap();
    assert_eq!(vcutc(folder.path(), &["build"]).code, Some(2));
}

#[test]
fn the_examples_of_the_repository_are_up_to_date() {
    let reported = reported(
        crate::repository::root(),
        &["build", "--check", "--manifest", "examples/vcut.toml"],
        0,
    );
    assert!(reported.contains("3 programs: 3 unchanged"), "{reported}");
}
