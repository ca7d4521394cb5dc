//! `vcutc convert`: a milling program becomes a job or a program, and both are the same.

use super::{folder, names, vcutc};
use crate::repository::{read, root};
use std::fs;

const PANEL: &str = "examples/milling/panel.src";
const HOW: [&str; 8] = [
    "--rake",
    "60deg",
    "--swing",
    "34.16deg",
    "--extension",
    "8mm",
    "--stock",
    "85x50x50",
];
const CELL: [&str; 4] = ["--cell", "examples/shop/cells.vcut", "--machine", "large_cell"];

fn convert<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["convert", PANEL][..], &HOW, more].concat()
}

#[test]
fn the_job_gives_the_program_that_is_written_at_once() {
    let out = folder();
    let (job, direct, later) = (
        out.path().join("job"),
        out.path().join("direct"),
        out.path().join("later"),
    );
    let texts = [&job, &direct, &later].map(|path| path.to_str().unwrap());
    for target in ["krl", "rapid", "gcode"] {
        let cell = match target {
            "krl" => "large_cell",
            "rapid" => "abb_cell",
            _ => "knife_gantry",
        };
        let cell = [
            "--cell",
            "examples/shop/cells.vcut",
            "--machine",
            cell,
            "--travel",
            "500mm/s",
        ];
        let run = vcutc(
            root(),
            &convert(&[&cell[..], &["--as-job", "-o", texts[0]]].concat()),
        );
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let run = vcutc(
            root(),
            &convert(&[&cell[..], &["--target", target, "-o", texts[1]]].concat()),
        );
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let path = job.join("panel.vcut");
        let run = vcutc(
            root(),
            &[path.to_str().unwrap(), "--target", target, "-o", texts[2]],
        );
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    let written = names(&direct);
    assert_eq!(written, names(&later));
    assert!(written.len() >= 4, "{written:?}");
    for name in written {
        assert_eq!(
            fs::read(direct.join(&name)).unwrap(),
            fs::read(later.join(&name)).unwrap(),
            "{name}"
        );
    }
}

/// What the page shows is what is printed, and its picture is drawn.
#[test]
fn the_page_is_true() {
    let out = folder();
    let picture = out.path().join("paths.svg");
    let program = out.path().join("program");
    let arguments = [
        &CELL[..],
        &[
            "--target",
            "krl",
            "-o",
            program.to_str().unwrap(),
            "--picture",
            picture.to_str().unwrap(),
        ],
    ];
    let run = vcutc(root(), &convert(&arguments.concat()));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let page = read("docs/convert.md");
    for line in run.stderr.lines().filter(|line| line.starts_with("  ")) {
        let is_inference = ["blank", "passes", "feed", "clearance", "blade", "profile"]
            .iter()
            .any(|subject| line.trim_start().starts_with(subject));
        assert!(!is_inference || page.contains(line), "{line}");
    }
    let drawn = fs::read_to_string(picture).unwrap();
    let path = root().join("docs/images/panel_paths.svg");
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        fs::write(&path, &drawn).unwrap();
    }
    assert_eq!(
        fs::read_to_string(path).unwrap(),
        drawn,
        "UPDATE_PICTURES=1 writes it again"
    );
    let text = fs::read_to_string(program.join("panel.src"))
        .unwrap()
        .replace("\r\n", "\n");
    let shown = page
        .split("```krl\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .unwrap();
    assert!(text.contains(shown), "{shown}");
}

#[test]
fn messages_about_tips_show_the_line_of_the_program() {
    let run = vcutc(root(), &convert(&["--edge", "9mm"]));
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("error[VC0401]"), "{}", run.stderr);
    assert!(run.stderr.contains("panel.src:"), "{}", run.stderr);
    assert!(
        run.stderr.contains("the pass that it comes from"),
        "{}",
        run.stderr
    );
}

/// A job with errors is written, so that they can be fixed in it. The run says that it has them, and what was
/// not made.
#[test]
fn a_job_with_errors_is_written_as_such() {
    let out = folder();
    let (job, picture) = (out.path().join("x.vcut"), out.path().join("x.svg"));
    let [named, drawn] = [&job, &picture].map(|path| path.to_str().unwrap());
    let arguments = ["--as-job", "-o", named, "--picture", drawn];
    let run = vcutc(root(), &convert(&[&["--edge", "9mm"][..], &arguments].concat()));
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(
        run.stderr.contains("x.vcut is written with its errors"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("x.svg was not drawn"), "{}", run.stderr);
    assert!(!picture.exists());
    let again = vcutc(root(), &[named]);
    assert_eq!(again.code, Some(1), "{}", again.stderr);
    assert!(again.stderr.contains("error[VC0401]"), "{}", again.stderr);

    let run = vcutc(root(), &convert(&arguments));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(!run.stderr.contains("errors,"), "{}", run.stderr);
    assert!(picture.exists());
}

/// DOS ends texts with Ctrl-Z, and some posts fill a block with it.
#[test]
fn marks_at_the_end_of_a_file_are_not_statements() {
    let out = folder();
    let text = read(PANEL).replace("panel", "marked");
    for marks in ["\u{1a}", "\r\n\u{1a}", "\u{1a}\u{1a}\u{1a}\n"] {
        let path = out.path().join("marked.src");
        fs::write(&path, format!("\u{feff}{text}{marks}")).unwrap();
        let run = vcutc(root(), &[&["convert", path.to_str().unwrap()][..], &HOW].concat());
        assert_eq!(run.code, Some(0), "{marks:?}: {}", run.stderr);
        assert!(!run.stderr.contains("warning"), "{marks:?}: {}", run.stderr);
    }
}

/// A job in another folder names the files of the shop from there, so that both can be moved together.
#[test]
fn a_job_elsewhere_names_files_from_where_it_lies() {
    let out = folder();
    let shop = out.path().join("shop");
    fs::create_dir(&shop).unwrap();
    for file in fs::read_dir(root().join("examples/shop")).unwrap() {
        let file = file.unwrap();
        if file.path().is_file() {
            fs::copy(file.path(), shop.join(file.file_name())).unwrap();
        }
    }
    fs::write(
        shop.join("part.dxf"),
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n5\n\
         11\n85\n21\n5\n0\nENDSEC\n0\nEOF\n",
    )
    .unwrap();
    let text = |path: &std::path::Path| path.to_str().unwrap().to_owned();
    let (cell, profile) = (text(&shop.join("cells.vcut")), text(&shop.join("part.dxf")));
    let job = out.path().join("jobs").join("first").join("x.vcut");
    let named = text(&job);
    let arguments = [
        "--cell",
        &cell,
        "--machine",
        "large_cell",
        "--profile",
        &profile,
        "--profile-fields",
        "layer = \"0\"",
        "--as-job",
        "-o",
        &named,
    ];
    let run = vcutc(root(), &convert(&arguments));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let written = fs::read_to_string(&job).unwrap();
    assert!(written.contains("use \"../../shop/cells.vcut\""), "{written}");
    assert!(
        written.contains("dxf \"../../shop/part.dxf\" { layer = \"0\" }"),
        "{written}"
    );
    let run = vcutc(root(), &[&named]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

/// The program, the cells and the profile that a conversion is made from stay, whatever is to be written.
#[test]
fn nothing_that_is_read_is_written_over() {
    let out = folder();
    for file in ["examples/shop/cells.vcut", PANEL] {
        let from = root().join(file);
        fs::copy(&from, out.path().join(from.file_name().unwrap())).unwrap();
    }
    fs::write(
        out.path().join("part.svg"),
        "<svg xmlns='http://www.w3.org/2000/svg'/>",
    )
    .unwrap();
    let inputs =
        || ["panel.src", "cells.vcut", "part.svg"].map(|name| fs::read(out.path().join(name)).unwrap());
    let before = inputs();
    let convert = [&["convert", "panel.src"][..], &HOW].concat();
    for more in [
        &[
            "--cell",
            "cells.vcut",
            "--machine",
            "large_cell",
            "--as-job",
            "-o",
            "cells.vcut",
        ][..],
        &[
            "--profile",
            "part.svg",
            "--as-job",
            "-o",
            "x.vcut",
            "--picture",
            "part.svg",
        ],
    ] {
        let run = vcutc(out.path(), &[&convert, more].concat());
        assert_ne!(run.code, Some(0), "{more:?}: {}", run.stderr);
        assert_eq!(inputs(), before, "{more:?}");
    }

    // The sheets of the cells are where they were, so that a program is made, in the folder of the milling program.
    let panel = out.path().join("panel.src");
    let (panel, here) = (panel.to_str().unwrap(), out.path().to_str().unwrap());
    let arguments = [
        &["convert", panel][..],
        &HOW,
        &CELL,
        &["--target", "krl", "-o", here],
    ]
    .concat();
    let run = vcutc(root(), &arguments);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("is an input of the job"), "{}", run.stderr);
    assert_eq!(inputs(), before);
}

#[test]
fn files_that_no_controller_reads_say_how_to_save_them() {
    let out = folder();
    let program = read(PANEL);
    let wide: Vec<u8> = program.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let cases = [
        (
            "wide.src",
            [&[0xff, 0xfe], wide.as_slice()].concat(),
            "it is in UTF-16",
        ),
        ("bare.src", wide, "it is in UTF-16"),
        (
            "mac.src",
            program.replace('\n', "\r").into_bytes(),
            "its lines end with CR alone",
        ),
    ];
    for (name, bytes, said) in cases {
        let path = out.path().join(name);
        fs::write(&path, bytes).unwrap();
        let mut arguments = convert(&[]);
        arguments[1] = path.to_str().unwrap();
        let run = vcutc(root(), &arguments);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(
            run.stderr.contains(said) && run.stderr.contains("save it"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn a_program_needs_a_machine_and_files_have_to_be_there() {
    let run = vcutc(root(), &convert(&["--target", "krl"]));
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("--cell"), "{}", run.stderr);
    let mut arguments = convert(&[]);
    arguments[1] = "examples/milling/none.src";
    let run = vcutc(root(), &arguments);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr
            .contains("cannot read the program examples/milling/none.src"),
        "{}",
        run.stderr
    );
    let run = vcutc(root(), &convert(&["--picture", "paths.png"]));
    assert_eq!(run.code, Some(2));
}

#[test]
fn what_is_inferred_is_reported_to_programs_too() {
    let run = vcutc(root(), &convert(&["--message-format", "json"]));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let first = run.stderr.lines().next().unwrap();
    let body: serde_json::Value = serde_json::from_str(first).unwrap();
    assert_eq!(body["kind"], "inference");
    assert_eq!(body["subject"], "blank");
}
