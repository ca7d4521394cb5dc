//! `--check` and `--option`: programs compared with a folder, files that stay as they are, parts that stay
//! behind.

use super::jobs::RIB;
use super::{Run, folder, json_lines, names, vcutc};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn shop() -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    folder
}

fn compile(folder: &Path, more: &[&str]) -> Run {
    vcutc(
        folder,
        &[&["rib.vcut", "--target", "krl", "-o", "out"], more].concat(),
    )
}

/// A shop whose program has been written.
fn written() -> TempDir {
    let shop = shop();
    let run = compile(shop.path(), &[]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    shop
}

fn change(folder: &Path, name: &str, change: impl Fn(String) -> String) {
    let path = folder.join("out").join(name);
    let text = fs::read_to_string(&path).unwrap();
    let changed = change(text.clone());
    assert_ne!(text, changed);
    fs::write(path, changed).unwrap();
}

#[test]
fn a_program_that_is_up_to_date_takes_one_line() {
    let shop = written();
    let run = compile(shop.path(), &["--check"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""));
    assert_eq!(
        run.stderr,
        "rib.vcut: no errors; the program in the folder is up to date (2 files)\n"
    );
}

#[test]
fn what_differs_is_shown_as_a_diff_and_not_mended() {
    let shop = written();
    change(shop.path(), "rib.src", |text| {
        let mut lines: Vec<&str> = text.lines().collect();
        let motions: Vec<usize> = (0..lines.len())
            .filter(|&at| lines[at].starts_with("LIN "))
            .collect();
        let other = lines[motions[9]].replace("X ", "X 9");
        lines[motions[9]] = &other;
        lines.remove(motions[3]);
        lines.join("\r\n") + "\r\n"
    });
    let before = fs::read(shop.path().join("out/rib.src")).unwrap();
    let run = compile(shop.path(), &["--check"]);
    assert_eq!(run.code, Some(1));
    insta::assert_snapshot!(run.stderr.replace('\\', "/"));
    assert_eq!(fs::read(shop.path().join("out/rib.src")).unwrap(), before);
    let coloured = compile(shop.path(), &["--check", "--color", "always"]);
    assert!(coloured.stderr.contains("\u{1b}[31m-"), "{}", coloured.stderr);
    assert_eq!(
        anstream::adapter::strip_str(&coloured.stderr).to_string(),
        run.stderr
    );
}

#[test]
fn missing_files_and_line_ends_are_reported() {
    let shop = written();
    fs::remove_file(shop.path().join("out/rib.dat")).unwrap();
    change(shop.path(), "rib.src", |text| text.replace("\r\n", "\n"));
    let run = compile(shop.path(), &["--check"]);
    assert_eq!(run.code, Some(1));
    insta::assert_snapshot!(run.stderr.replace('\\', "/"));
    assert_eq!(names(&shop.path().join("out")), ["rib.src"]);
    let nowhere = self::shop();
    assert_eq!(compile(nowhere.path(), &["--check"]).code, Some(1));
    assert!(!nowhere.path().join("out").exists());
}

#[test]
fn for_programs_every_file_that_differs_is_an_object() {
    let shop = written();
    change(shop.path(), "rib.src", |text| text.replace("LIN ", "PTP "));
    fs::remove_file(shop.path().join("out/rib.dat")).unwrap();
    let run = compile(shop.path(), &["--check", "--message-format", "json"]);
    let lines = json_lines(&run.stderr);
    let kinds: Vec<_> = lines.iter().map(|line| line["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["difference", "difference", "summary"]);
    let text = lines.iter().find(|line| line["change"] == "text").unwrap();
    assert!(text["text"]["removed"].as_u64().unwrap() > 10);
    assert!(
        text["text"]["hunks"][0]["about"]
            .as_str()
            .unwrap()
            .contains("layer 1")
    );
    assert!(lines.iter().any(|line| line["change"] == "missing"));
}

#[test]
fn for_github_every_file_is_annotated_at_its_first_difference() {
    let shop = written();
    let text = fs::read_to_string(shop.path().join("out/rib.src")).unwrap();
    let line = 1 + text.lines().position(|line| line.starts_with("LIN ")).unwrap();
    change(shop.path(), "rib.src", |text| text.replacen("LIN ", "PTP ", 1));
    let run = compile(shop.path(), &["--check", "--message-format", "github"]);
    let wanted =
        format!("rib.src,line={line},col=1,title=not up to date::2 lines differ from what rib.vcut gives\n");
    assert!(run.stderr.contains(&wanted), "{}", run.stderr);
}

#[test]
fn files_with_the_same_bytes_are_left_alone() {
    let shop = written();
    let changed = |name: &str| {
        fs::metadata(shop.path().join("out").join(name))
            .unwrap()
            .modified()
            .unwrap()
    };
    change(shop.path(), "rib.dat", |text| text + "; more\r\n");
    let before = (changed("rib.src"), changed("rib.dat"));
    let run = compile(shop.path(), &[]);
    assert_eq!(run.code, Some(0));
    let lines: Vec<_> = run.stderr.lines().filter(|line| line.contains("rib.")).collect();
    let path = |name: &str| Path::new("out").join(name).display().to_string();
    assert!(
        lines.contains(&format!("unchanged: {}", path("rib.src")).as_str()),
        "{lines:?}"
    );
    assert!(
        lines.contains(&format!("wrote {}", path("rib.dat")).as_str()),
        "{lines:?}"
    );
    assert_eq!(changed("rib.src"), before.0);
    assert_ne!(changed("rib.dat"), before.1);
}

#[test]
fn parts_of_an_earlier_version_are_named_and_left() {
    let shop = written();
    fs::write(shop.path().join("out/rib_p007.src"), "DEF rib_p007( )").unwrap();
    fs::write(shop.path().join("out/rib_2.src"), "another program").unwrap();
    let run = compile(shop.path(), &[]);
    assert_eq!(run.code, Some(0));
    insta::assert_snapshot!(
        run.stderr
            .lines()
            .take_while(|line| !line.starts_with("rib: "))
            .collect::<Vec<_>>()
            .join("\n")
    );
    assert!(shop.path().join("out/rib_p007.src").exists());
    let run = compile(shop.path(), &["--check"]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr
            .contains("rib_p007.src is left from an earlier version"),
        "{}",
        run.stderr
    );
    assert!(!run.stderr.contains("rib_2"), "{}", run.stderr);
}

#[test]
fn options_of_the_command_line_go_before_those_of_the_job() {
    let shop = shop();
    let job = RIB.replace("output(12)\n", "output(12)\n  krl { lines_per_part = 0 }\n");
    fs::write(shop.path().join("rib.vcut"), job).unwrap();
    let run = compile(shop.path(), &["--option", "lines_per_part=50"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(names(&shop.path().join("out")).contains(&"rib_p001.src".to_owned()));
    let run = compile(shop.path(), &["--check"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("rib_p001.src is left"), "{}", run.stderr);
    assert_eq!(
        compile(shop.path(), &["--check", "--option", "lines_per_part = 50"]).code,
        Some(0)
    );
}

#[test]
fn wrong_options_are_reported_in_their_own_text() {
    let shop = shop();
    let cases: [&[&str]; 4] = [
        &["--option", "lines_per_prat=0"],
        &["--option", "lines_per_part=3 mm"],
        &["--option", "lines_per_part"],
        &["--option", "lines_per_part=0", "--option", "lines_per_part=1"],
    ];
    let messages: Vec<String> = cases
        .iter()
        .map(|options| {
            let run = compile(shop.path(), &[*options, &["-q"]].concat());
            assert_eq!(run.code, Some(1), "{}", run.stderr);
            run.stderr
        })
        .collect();
    insta::assert_snapshot!(messages.join("\n"));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let shop = shop();
    let cases: [&[&str]; 5] = [
        &["rib.vcut", "--check"],
        &["rib.vcut", "--target", "krl", "-o", "-", "--check"],
        &["rib.vcut", "rib.vcut"],
        &["rib.vcut", "rib.vcut", "--emit", "ir"],
        &["rib.vcut", "rib.vcut", "--target", "krl", "-o", "-"],
    ];
    for arguments in cases {
        let run = vcutc(shop.path(), arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(names(shop.path()), ["rib.vcut"]);
}
