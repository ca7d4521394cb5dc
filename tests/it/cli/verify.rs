//! `vcutc verify` from outside.

use super::{folder, json_lines, names, vcutc};
use crate::repository::root;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A folder with the job of `tests/verify` and its program.
fn bench() -> TempDir {
    let folder = folder();
    fs::copy(
        root().join("tests/verify/bench.vcut"),
        folder.path().join("bench.vcut"),
    )
    .unwrap();
    let run = vcutc(folder.path(), &["-q", "bench.vcut", "--target", "krl"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    folder
}

fn edit(folder: &Path, file: &str, from: &str, to: &str) {
    let text = fs::read_to_string(folder.join(file)).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
}

const PROGRAM: [&str; 4] = ["verify", "bench.vcut", "bench.dat", "bench.src"];

#[test]
fn a_program_of_its_job_passes() {
    let folder = bench();
    let before = names(folder.path());
    let run = vcutc(folder.path(), &PROGRAM);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.contains("the same program, byte for byte"),
        "{}",
        run.stderr
    );
    assert_eq!(run.stdout, "");
    assert_eq!(names(folder.path()), before, "nothing is written");
}

#[test]
fn a_changed_program_fails_at_both_places() {
    let folder = bench();
    edit(folder.path(), "bench.src", "Z 7.433", "Z 5.433");
    let run = vcutc(folder.path(), &PROGRAM);
    assert_eq!(run.code, Some(1));
    for part in [
        "error[VC0701]",
        "bench.src:93:1",
        "bench.vcut:18:1",
        "the tip ends at z 5.433 mm, the job says z 7.433 mm",
    ] {
        assert!(run.stderr.contains(part), "{part}: {}", run.stderr);
    }
}

#[test]
fn a_job_of_other_values_is_distinguished_from_its_program() {
    let folder = bench();
    let text = fs::read_to_string(folder.path().join("bench.vcut")).unwrap();
    let text = text
        .replace("cut = 200 mm/s", "cut = fast")
        .replace("stock {", "let fast = 200 mm/s\n\nstock {");
    fs::write(folder.path().join("bench.vcut"), text).unwrap();
    assert_eq!(vcutc(folder.path(), &PROGRAM).code, Some(0));
    let run = vcutc(
        folder.path(),
        &[&PROGRAM[..], &["--set", "fast=250mm/s"]].concat(),
    );
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("VC0705"), "{}", run.stderr);
}

#[test]
fn json_says_the_same() {
    let folder = bench();
    edit(folder.path(), "bench.src", "WAIT SEC 0.8", "WAIT SEC 0.1");
    let run = vcutc(
        folder.path(),
        &[&PROGRAM[..], &["--message-format", "json"]].concat(),
    );
    assert_eq!(run.code, Some(1));
    let lines = json_lines(&run.stderr);
    let codes: Vec<_> = lines.iter().filter_map(|line| line["code"].as_str()).collect();
    assert_eq!(codes, ["VC0701", "VC0708"]);
    assert_eq!(lines[0]["labels"][0]["file"], "bench.src");
    assert_eq!(lines[0]["labels"][0]["line"], 34);
    assert_eq!(lines[0]["labels"][1]["file"], "bench.vcut");
    let summary = lines.last().unwrap();
    assert_eq!(summary["kind"], "summary");
    assert_eq!(summary["errors"], 2);
}

#[test]
fn what_controllers_do_to_files_is_read() {
    let folder = bench();
    // Comments in Latin-1, lines that end in LF only, and a name in capitals.
    let text = fs::read(folder.path().join("bench.src")).unwrap();
    let mut latin = Vec::new();
    for line in text.split(|&byte| byte == b'\n') {
        latin.extend_from_slice(line.strip_suffix(b"\r").unwrap_or(line));
        latin.extend_from_slice(b" ; gepr\xfcft\n");
    }
    fs::remove_file(folder.path().join("bench.src")).unwrap();
    fs::write(folder.path().join("BENCH.SRC"), latin).unwrap();
    let run = vcutc(folder.path(), &["verify", "bench.vcut", "BENCH.SRC", "bench.dat"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("layout or comments differ"), "{}", run.stderr);
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = bench();
    fs::write(folder.path().join("notes.txt"), "nothing").unwrap();
    fs::create_dir(folder.path().join("old")).unwrap();
    fs::copy(
        folder.path().join("bench.src"),
        folder.path().join("old/BENCH.src"),
    )
    .unwrap();
    for (args, words) in [
        (&["verify", "bench.vcut"][..], "PROGRAM"),
        (
            &["verify", "bench.vcut", "none.src"],
            "cannot read the program none.src: there is no such file",
        ),
        (
            &["verify", "bench.vcut", "notes.txt"],
            "give the target with --target",
        ),
        (
            &["verify", "bench.vcut", "bench.src", "old/BENCH.src"],
            "two files are called BENCH.src",
        ),
        (
            &["verify", "none.vcut", "bench.src"],
            "cannot read the job none.vcut",
        ),
        (
            &["verify", "bench.vcut", "bench.src", "--target", "krll"],
            "did you mean `--target krl`?",
        ),
    ] {
        let run = vcutc(folder.path(), args);
        assert_eq!(run.code, Some(2), "{args:?}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{args:?}: {}", run.stderr);
    }
}

#[test]
fn a_job_with_errors_has_no_program_to_compare_with() {
    let folder = bench();
    edit(
        folder.path(),
        "bench.vcut",
        "swing     = 45 deg",
        "swing     = 45 mm",
    );
    let run = vcutc(folder.path(), &PROGRAM);
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("VC0203") && !run.stderr.contains("VC07"),
        "{}",
        run.stderr
    );
}

#[test]
fn an_air_cut_is_verified_with_its_height() {
    let folder = bench();
    let run = vcutc(
        folder.path(),
        &["-q", "bench.vcut", "--target", "krl", "--air-cut", "100mm"],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let files = ["verify", "bench.vcut", "bench_air.dat", "bench_air.src"];
    let with_height = [files.as_slice(), &["--air-cut", "100mm"]].concat();
    let run = vcutc(folder.path(), &with_height);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("byte for byte"), "{}", run.stderr);
    // Without its height it is not the program of the job.
    assert_eq!(vcutc(folder.path(), &files).code, Some(1));
    // A cut that comes down into the stock.
    edit(folder.path(), "bench_air.src", "Z 107.433", "Z 7.433");
    let run = vcutc(folder.path(), &with_height);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("error[VC0701]"), "{}", run.stderr);
    assert!(run.stderr.contains("error[VC0708]"), "{}", run.stderr);
    assert!(run.stderr.contains("comes down to the stock"), "{}", run.stderr);
}

#[test]
fn a_program_that_was_emptied_has_no_beginning() {
    let folder = bench();
    let run = vcutc(folder.path(), &["-q", "bench.vcut", "--target", "krl"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    fs::write(folder.path().join("bench.src"), "").unwrap();
    let run = vcutc(folder.path(), &["verify", "bench.vcut", "bench.dat", "bench.src"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    let words = "the beginning of the program is missing";
    assert!(run.stderr.contains(words), "{}", run.stderr);
    assert!(!run.stderr.contains("split differently"), "{}", run.stderr);
}

#[test]
fn the_summary_of_an_air_cut_claims_no_surface() {
    let folder = bench();
    let run = vcutc(folder.path(), &["check", "bench.vcut", "--air-cut", "100mm"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.contains("AIR CUT, lifted by 100 mm, generator off"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr
            .contains("chips, contour and scallop, because nothing is cut"),
        "{}",
        run.stderr
    );
    let json = vcutc(
        folder.path(),
        &[
            "--message-format",
            "json",
            "check",
            "bench.vcut",
            "--air-cut",
            "100mm",
        ],
    );
    let summary = json_lines(&json.stderr).pop().unwrap();
    assert!(
        summary.get("numbers").is_none_or(serde_json::Value::is_null),
        "{summary}"
    );
}
