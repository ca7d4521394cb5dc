//! `vcutc tools`: what it prints, what it writes, and what it refuses.

use super::{folder, vcutc};
use crate::repository::root;
use std::fs;

const RECT: &str = "examples/spoiler_rect.vcut";
const VCUT: &str = "examples/two_blades.vcut";

#[test]
fn a_table_has_the_tools_of_both_blades() {
    let run = vcutc(root(), &["tools", RECT]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let lines: Vec<&str> = run
        .stdout
        .lines()
        .filter(|line| !line.starts_with("  "))
        .collect();
    let [dagger, disc] = lines[..] else {
        panic!("{}", run.stdout)
    };
    // 2 * 32 mm * sin(9 deg), and 32 mm * cos(9 deg).
    assert!(
        dagger.contains("diameter 10.012 mm, height 31.606 mm"),
        "{dagger}"
    );
    assert!(disc.contains("diameter 50 mm, height 12 mm"), "{disc}");
    assert!(
        run.stdout.contains("lacks the plane of the blade"),
        "{}",
        run.stdout
    );
}

/// The cones are of the swing in the job, 34 deg, one for each blade.
#[test]
fn apt_and_csv_are_one_text() {
    let out = folder();
    let apt = vcutc(root(), &["tools", VCUT, "--emit", "apt"]);
    assert_eq!((apt.code, apt.stderr.as_str()), (Some(0), ""));
    let cutters: Vec<&str> = apt
        .stdout
        .lines()
        .filter(|line| line.starts_with("CUTTER/"))
        .collect();
    assert_eq!(cutters.len(), 4, "{}", apt.stdout);
    assert_eq!(cutters.iter().filter(|line| line.contains(",56,0,")).count(), 2);
    let file = out.path().join("two.csv");
    let run = vcutc(
        root(),
        &["tools", VCUT, "--emit", "csv", "-o", file.to_str().unwrap()],
    );
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
    let csv = fs::read_to_string(file).unwrap();
    assert_eq!(csv.lines().count(), 5);
    assert!(csv.lines().all(|line| line.matches(',').count() == 8), "{csv}");
    assert_eq!(csv.lines().filter(|line| line.contains(",cone,")).count(), 2);
}

#[test]
fn tool_bits_and_facets_are_a_file_each() {
    let out = folder();
    for (form, start) in [("stl", "solid "), ("fctb", "{")] {
        let path = out.path().join(form);
        let run = vcutc(
            root(),
            &["tools", RECT, "--emit", form, "-o", path.to_str().unwrap()],
        );
        assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
        for name in ["long_dagger_cylinder", "disc_50_crushing"] {
            let text = fs::read_to_string(path.join(format!("{name}.{form}"))).unwrap();
            assert!(text.starts_with(start) && text.contains(name), "{form}");
        }
        assert_eq!(fs::read_dir(path).unwrap().count(), 2);
    }
    for output in ["-", "one.stl"] {
        let run = vcutc(root(), &["tools", RECT, "--emit", "stl", "-o", output]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
        assert!(run.stderr.contains("give a folder with `-o`"), "{}", run.stderr);
    }
}

#[test]
fn a_job_with_errors_has_no_tools() {
    let run = vcutc(root(), &["tools", "examples/too_deep.vcut"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(
        run.stderr.ends_with("1 error; nothing was written\n"),
        "{}",
        run.stderr
    );
}
