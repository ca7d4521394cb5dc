//! `vcutc plot`: what it prints, what it writes, and what it refuses.

use super::{folder, names, vcutc, vcutc_reading};
use crate::pictures::BENT_HILL;
use crate::repository::{read, root};
use std::fs;

const EXAMPLE: &str = "examples/wavy_panel.vcut";

#[test]
fn a_picture_goes_into_its_file_or_to_standard_output() {
    let out = folder();
    let file = out.path().join("times").join("time.svg");
    let run = vcutc(
        root(),
        &["plot", EXAMPLE, "--what", "time", "-o", file.to_str().unwrap()],
    );
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
    let expected = format!("wrote {}\n{EXAMPLE}: no errors\n", file.display());
    assert_eq!(run.stderr, expected);
    let drawn = fs::read_to_string(&file).unwrap();
    assert_eq!(drawn, read("docs/images/wavy_panel_time.svg"));
    for output in [&[][..], &["-o", "-"]] {
        let run = vcutc(root(), &[&["plot", EXAMPLE, "--what", "time"], output].concat());
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        assert_eq!(run.stdout, drawn);
    }
}

#[test]
fn every_picture_can_be_drawn() {
    for what in ["lattice", "contour", "deviation", "correlation", "joints", "time"] {
        let run = vcutc(root(), &["plot", EXAMPLE, "--what", what]);
        assert_eq!(run.code, Some(0), "{what}: {}", run.stderr);
        assert!(
            run.stdout.starts_with("<svg ") && run.stdout.ends_with("</svg>\n"),
            "{what}"
        );
    }
}

#[test]
fn maps_are_drawn_of_a_surface_and_refused_for_a_profile() {
    let out = folder();
    fs::write(out.path().join("hill.vcut"), BENT_HILL).unwrap();
    let run = vcutc(out.path(), &["plot", "hill.vcut", "-o", "all"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let drawn = names(&out.path().join("all"));
    assert_eq!(
        drawn,
        [
            "class",
            "contour",
            "correlation",
            "curvature",
            "deviation",
            "lattice",
            "residual",
            "surface",
            "time"
        ]
        .map(|what| format!("hill_{what}.svg"))
    );
    for what in ["surface", "curvature", "class", "residual"] {
        let one = vcutc(out.path(), &["plot", "hill.vcut", "--what", what]);
        let path = out.path().join("all").join(format!("hill_{what}.svg"));
        assert_eq!(
            (one.code, one.stdout),
            (Some(0), fs::read_to_string(path).unwrap())
        );
        let refused = vcutc(root(), &["plot", EXAMPLE, "--what", what]);
        assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
        assert_eq!(
            refused.stderr,
            "error: the part is a profile, the same at every y, so there is nothing to show from above\n  \
             help: draw `--what contour` or `--what deviation`, or write `surface { ... }` instead of `profile`\n"
        );
    }
}

#[test]
fn what_finishing_leaves_is_drawn_of_tracks_on_a_surface_only() {
    let drawn = vcutc(
        root(),
        &["plot", "examples/finished_dome.vcut", "--what", "finished"],
    );
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    assert!(
        drawn
            .stdout
            .contains("finished_dome: left above the part after finishing")
    );
    let refused = vcutc(
        root(),
        &["plot", "examples/finished_hood.vcut", "--what", "finished"],
    );
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
    assert_eq!(
        refused.stderr,
        "error: the part is a profile, the same at every y, so there is no map of what finishing leaves\n  \
         help: draw `--what contour`, or write `surface { ... }` instead of `profile`\n"
    );
}

#[test]
fn a_job_with_errors_is_not_drawn() {
    let out = folder();
    let file = out.path().join("x.svg");
    let run = vcutc(
        root(),
        &[
            "plot",
            "examples/too_deep.vcut",
            "--what",
            "contour",
            "-o",
            file.to_str().unwrap(),
        ],
    );
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("VC0401"), "{}", run.stderr);
    assert!(
        run.stderr.ends_with("1 error; nothing was drawn\n"),
        "{}",
        run.stderr
    );
    assert_eq!(names(out.path()), [""; 0]);
}

#[test]
fn pictures_are_svg_and_axes_need_a_machine() {
    let run = vcutc(root(), &["plot", EXAMPLE, "--what", "time", "-o", "time.png"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert_eq!(
        run.stderr,
        "error: pictures are in SVG: give `-o` the name of a file that ends in .svg, not time.png\n"
    );
    let job = read("examples/block_cui.vcut");
    let (without_machine, _) = job.split_once("machine cell").unwrap();
    let run = vcutc_reading(root(), &["plot", "-", "--what", "joints"], without_machine);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert!(
        run.stderr
            .starts_with("error: the job has no machine, so there are no axes to show\n  help: add a block"),
        "{}",
        run.stderr
    );
    let run = vcutc_reading(root(), &["plot", "-", "--what", "time"], without_machine);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

#[test]
fn a_drawing_that_the_job_is_made_from_is_not_written_over() {
    let out = folder();
    let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg" width="85mm" height="50mm" viewBox="0 0 85 50">
        <path d="M 0 45 L 40 35 L 85 45"/></svg>"#;
    let job = read("examples/block_cui.vcut");
    let (job, _) = job.split_once("machine cell").unwrap();
    let (before, after) = job.split_once("profile {").unwrap();
    let (_, after) = after.split_once("\n}\n").unwrap();
    fs::write(out.path().join("rib.svg"), drawing).unwrap();
    let job = format!("{before}profile = svg(\"rib.svg\")\n{after}");
    fs::write(out.path().join("rib.vcut"), job).unwrap();
    let run = |output: &str| {
        vcutc(
            out.path(),
            &["plot", "rib.vcut", "--what", "lattice", "-o", output],
        )
    };
    let over = run("./rib.svg");
    assert_eq!(over.code, Some(2), "{}", over.stderr);
    assert_eq!(
        over.stderr,
        "error: ./rib.svg is an input of the job: choose another name for the output\n"
    );
    assert_eq!(fs::read_to_string(out.path().join("rib.svg")).unwrap(), drawing);
    assert_eq!(run("lattice.svg").code, Some(0));
}
