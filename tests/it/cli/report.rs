//! `vcutc report`: what is written, what is in it, and what cannot get into it.

use super::jobs::RIB;
use super::{folder, json_lines, names, vcutc, vcutc_reading};
use crate::pipeline::{Files, compile_on};
use crate::repository::root;
use insta::assert_snapshot;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use vcutc::vcut::PlannedVcut;

/// What a hostile author would call things.
pub(crate) const HOSTILE: &str =
    r#"</code></script><script>top.hacked=1</script><img src=x onerror=top.hacked=1>'&amp;"#;

/// Slits with a straight blade and strips with a disc, which a person changes.
pub(crate) const STRIPS: &str = r#"job "strips"

stock { size = (100 mm, 60 mm, 50 mm) }

profile { start (0 mm, 10 mm) line to (100 mm, 40 mm) }

blade dagger { cutting_length = 13 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }
blade wheel = disc {
  radius = 25 mm, thickness = 1 mm, depth = 12 mm, width = 20 mm, spin = 3000 rev/min
  body (1 mm, 8 mm) (60 mm, 25 mm)
}

rough rect {
  blade = dagger
  disc = wheel
  rake = 60 deg
  layer = 10 mm, step = 10 mm, residual = lift
  feed { cut = 150 mm/s, free = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}

machine kuka = robot "kuka/kr210_r3100_ultra" {
  tool dagger { frame = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 1 }
  tool wheel { frame = frame(x = 0 mm, y = 0 mm, z = 280 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 2 }
  base = frame(x = 1700 mm, y = -600 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  ultrasonic = output(12)
  spindle = output(13)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  change { at = joints(60 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg), time = 10 s, by = hand }
}

cell { machine = kuka }
"#;

/// A folder with the job `rib.vcut`.
fn shop(job: &str) -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    folder
}

/// The rib with hostile names and comments.
pub(crate) fn hostile_rib() -> String {
    let named = RIB.replace("job \"rib\"", &format!("job \"{HOSTILE}\""));
    format!("// {HOSTILE}\n{named}// -->{HOSTILE}]]>\n")
}

fn written(folder: &Path) -> String {
    // Which hints are found in a given time is not what is tested here.
    let arguments = [
        "report",
        "-q",
        "rib.vcut",
        "-o",
        "rib.html",
        "--help-budget",
        "0s",
    ];
    let run = vcutc(folder, &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    fs::read_to_string(folder.join("rib.html")).unwrap()
}

/// A page without what stands between these marks, the marks aside.
fn without(mut page: &str, start: &str, end: &str) -> String {
    let mut rest = String::new();
    while let Some(at) = page.find(start) {
        rest += &format!("{}{start} ... {end}", &page[..at]);
        let inside = &page[at + start.len()..];
        page = &inside[inside.find(end).unwrap() + end.len()..];
    }
    rest + page
}

#[test]
fn a_page_is_written_once_and_then_unchanged() {
    let shop = shop(RIB);
    let path = shop.path();
    let run = vcutc(
        path,
        &[
            "report",
            "rib.vcut",
            "-o",
            "out/rib.html",
            "--help-budget",
            "none",
        ],
    );
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
    assert!(run.stderr.contains("wrote out"), "{}", run.stderr);
    assert_eq!(names(&path.join("out")), ["rib.html"]);
    let page = fs::read_to_string(path.join("out/rib.html")).unwrap();
    let run = vcutc(
        path,
        &[
            "report",
            "rib.vcut",
            "-o",
            "out/rib.html",
            "--help-budget",
            "none",
        ],
    );
    assert!(run.stderr.contains("unchanged: out"), "{}", run.stderr);

    let run = vcutc(
        path,
        &["report", "-q", "rib.vcut", "-o", "-", "--help-budget", "none"],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(run.stdout, page, "the same page everywhere");
    let run = vcutc(
        path,
        &[
            "report",
            "rib.vcut",
            "-o",
            "out/rib.html",
            "--message-format",
            "json",
            "--help-budget",
            "none",
        ],
    );
    let [summary] = json_lines(&run.stderr).try_into().unwrap();
    assert_eq!(summary["kind"], "summary");
    assert_eq!(summary["errors"], 0);
    assert!(summary["unchanged"][0].as_str().unwrap().ends_with("rib.html"));
}

#[test]
fn a_job_with_errors_writes_nothing() {
    let shop = shop(&RIB.replace("rake      = 60 deg", "rake      = 60 mm"));
    let run = vcutc(shop.path(), &["report", "rib.vcut", "-o", "rib.html"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("error[VC0203]"), "{}", run.stderr);
    assert!(
        run.stderr.ends_with("rib.vcut: 1 error; nothing was written\n"),
        "{}",
        run.stderr
    );
    assert_eq!(names(shop.path()), ["rib.vcut"]);
}

#[test]
fn what_is_not_a_page_or_cannot_be_written_is_refused() {
    let shop = shop(RIB);
    let run = vcutc(shop.path(), &["report", "rib.vcut", "-o", "rib.pdf"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("ends in .html, not rib.pdf"),
        "{}",
        run.stderr
    );
    let run = vcutc(shop.path(), &["report", "rob.vcut", "-o", "rib.html"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("cannot read the job rob.vcut"),
        "{}",
        run.stderr
    );
    let run = vcutc(shop.path(), &["report", "rib.vcut", "-o", "rib.vcut/rib.html"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("cannot write into rib.vcut"),
        "{}",
        run.stderr
    );
    assert_eq!(names(shop.path()), ["rib.vcut"]);
}

/// All of the page but pictures, playback, style, scripts and data, for reviewers.
#[test]
fn what_the_page_says() {
    let page = written(shop(RIB).path());
    let page = without(&page, "<section id=\"playback\"", "</section>");
    let page = without(&page, "<svg", "</svg>");
    let page = without(&page, "<style", "</style>");
    let page = without(&page, "<script", "</script>");
    let page = without(&page, "'sha256-", "'");
    let page = page.replace(env!("CARGO_PKG_VERSION"), "VERSION");
    assert_snapshot!(page);
}

/// Also files that only give values to names, and values of the command line.
#[test]
fn every_text_that_the_job_was_made_from_is_listed() {
    let run = vcutc(
        root(),
        &[
            "report",
            "-q",
            "examples/spoiler_clarky.vcut",
            "-o",
            "-",
            "--set",
            "chord=280mm",
        ],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let (_, sources) = run.stdout.split_once("<section id=\"job\"").unwrap();
    let names: Vec<&str> = sources
        .split("<summary>")
        .skip(1)
        .map(|rest| rest.split_once("</summary>").unwrap().0)
        .collect();
    for name in [
        "spoiler_clarky.vcut",
        "speeds.vcut",
        "blades.vcut",
        "cells.vcut",
        "--set chord=280mm",
    ] {
        assert!(
            names.iter().any(|shown| shown.ends_with(name)),
            "{name}: {names:?}"
        );
    }
}

#[test]
fn a_sheet_has_what_a_set_up_needs() {
    let shop = shop(RIB);
    let path = shop.path();
    let run = vcutc(
        path,
        &[
            "report", "-q", "rib.vcut", "--sheet", "--target", "krl", "-o", "rib.html",
        ],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let sheet = fs::read_to_string(path.join("rib.html")).unwrap();
    let run = vcutc(path, &["rib.vcut", "-q", "--target", "krl", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let run = vcutc(
        path,
        &["report", "-q", "rib.vcut", "--target", "krl", "-o", "page.html"],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let page = fs::read_to_string(path.join("page.html")).unwrap();
    for name in names(&path.join("out")) {
        let digest = hmac_sha256::Hash::hash(&fs::read(path.join("out").join(&name)).unwrap());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        for text in [&sheet, &page] {
            assert!(text.contains(&name) && text.contains(&digest), "{name} {digest}");
        }
    }
    assert!(page.contains("the written text reads back as the same program"));
    assert!(sheet.contains("default-src 'none'; script-src 'none'"));
    let sheet = without(&sheet, "<style", "</style>");
    assert_snapshot!(sheet.replace(env!("CARGO_PKG_VERSION"), "VERSION"));
}

/// The sheet has every blade with its place and speed, and counts the changes as the program asks for them.
#[test]
fn a_sheet_of_several_blades_says_how_they_are_changed() {
    for (by, whose) in [
        ("hand", "the others at hand"),
        ("program", "the others in their places"),
    ] {
        let shop = shop(&STRIPS.replace("by = hand", &format!("by = {by}")));
        let path = shop.path();
        let run = vcutc(path, &["report", "-q", "rib.vcut", "--sheet", "-o", "rib.html"]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        let sheet = fs::read_to_string(path.join("rib.html")).unwrap();
        let run = vcutc(path, &["report", "-q", "rib.vcut", "-o", "page.html"]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        let page = fs::read_to_string(path.join("page.html")).unwrap();
        let page = page.replace('\u{a0}', " ");
        let run = vcutc(path, &["rib.vcut", "-q", "--emit", "ir", "-o", "-"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let changes = run.stdout.matches("\"tool_change\"").count();
        assert!(changes > 1, "{changes}");
        let by = match by {
            "hand" => "by hand",
            _ => "by the program",
        };
        for text in [
            format!("dagger first; {changes} changes {by}, 10 s each"),
            "cut 150 mm/s with dagger, 100 mm/s with wheel, travel 200 mm/s".to_owned(),
            "; place 1<".to_owned(),
            "; place 2<".to_owned(),
        ] {
            assert!(sheet.contains(&text) && page.contains(&text), "{text}");
        }
        for text in [
            "<h2>Blades</h2>",
            "Blades no.",
            "Blades as named above",
            "Spindle switches on",
            "Load data on the control are those of each blade",
            &format!("Blade dagger in the machine, {whose}"),
        ] {
            assert!(sheet.contains(text), "{text}");
        }
    }
}

/// An example that its machine makes slow says what would help, if that is looked for.
#[test]
fn the_page_says_what_would_help() {
    let page = |budget: &str| {
        let job = "examples/rib_dxf.vcut";
        let run = vcutc(root(), &["report", "-q", job, "-o", "-", "--help-budget", budget]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        run.stdout
    };
    let (with, without) = (page("none"), page("0s"));
    assert!(!without.contains("What would help"));
    let (_, rest) = with.split_once("<section class=\"help\"").unwrap();
    let (block, _) = rest.split_once("</section>").unwrap();
    assert!(block.contains("which saves "), "{block}");
    // It says what to write, and leads to the line of the base.
    assert!(block.contains("<code>base = frame(x = "), "{block}");
    let (_, link) = block.rsplit_once("<a href=\"#text-").unwrap();
    let (_, line) = link.split_once("<code>").unwrap();
    assert!(line.starts_with("base "), "{line}");
    assert_eq!(
        with.replace(&format!("<section class=\"help\"{block}</section>\n"), ""),
        without
    );
}

/// The table of cuts has each cut of the plan once, at its place.
#[test]
fn the_page_lists_every_cut() {
    // Flank by flank, and layer by layer: first the one flank of all cuts, then the other.
    assert_lists_every_cut("examples/spoiler_clarky.vcut", "large_cell");
    assert_lists_every_cut("examples/fairing.vcut", "gantry");
}

fn assert_lists_every_cut(job: &str, machine: &str) {
    let arguments = [
        "report",
        "-q",
        job,
        "--machine",
        machine,
        "-o",
        "-",
        "--help-budget",
        "0s",
    ];
    let run = vcutc(root(), &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let outcome = compile_on(Some(machine), job, &Files::of(root()));
    let (plan, report) = (outcome.plan.unwrap(), outcome.compiled.unwrap().report);
    let vcut = PlannedVcut::of(&*plan.operations[0]).unwrap();
    let mut planned: Vec<String> = vcut
        .cuts
        .iter()
        .map(|cut| format!("{} {:.2} {:.2}", cut.layer, cut.tip.x, cut.tip.z))
        .collect();
    planned.sort();
    let (mut listed, mut seconds) = (Vec::new(), 0.0);
    for layer in run.stdout.split("<summary>Layer ").skip(1) {
        let (number, rest) = layer.split_once(": ").unwrap();
        let body = rest.split("</tbody>").next().unwrap();
        let mut before = -1.0;
        for row in body.split("<tr><th scope=\"row\">").skip(1) {
            let cells: Vec<&str> = row
                .split("<td>")
                .map(|cell| cell.split('<').next().unwrap())
                .collect();
            listed.push(format!("{number} {} {}", cells[1], cells[2]));
            let [z, depth] = [2, 3].map(|cell| cells[cell].parse::<f64>().unwrap());
            assert!((z + depth - plan.stock.height.to_mm()).abs() < 0.011, "{row}");
            seconds += cells[6].parse::<f64>().unwrap();
            let start: f64 = row
                .split("data-seek=\"")
                .nth(1)
                .unwrap()
                .split('"')
                .next()
                .unwrap()
                .parse()
                .unwrap();
            assert!(start > before, "{row}");
            before = start;
        }
    }
    listed.sort();
    assert_eq!(listed, planned);
    let all = report.times.all.total().to_s();
    assert!(
        seconds <= all + 0.05 * planned.len() as f64 && seconds > 0.8 * all,
        "{seconds} of {all}"
    );
}

#[test]
fn the_page_asks_for_nothing() {
    let page = written(shop(RIB).path());
    assert!(page.contains("default-src 'none'"));
    let page = without(&page, "<script", "</script>").replace("http://www.w3.org/2000/svg", "");
    for ask in ["http:", "https:", " src=", "<link", "<iframe", "@import", "url("] {
        assert!(!page.contains(ask), "{ask}");
    }
}

/// Each place that a parameter is said to come from holds the line that is shown with it.
#[test]
fn parameters_come_from_the_lines_that_they_name() {
    let page = written(shop(RIB).path());
    let lines: Vec<&str> = RIB.lines().collect();
    let mut count = 0;
    for link in page.split("<a href=\"#text-0-").skip(1) {
        let (number, rest) = link.split_once("\">").unwrap();
        let (place, rest) = rest.split_once("</a> <code>").unwrap();
        let shown = rest.split_once("</code>").unwrap().0.replace("&quot;", "\"");
        let number: usize = number.parse().unwrap();
        assert_eq!(shown, lines[number - 1].trim(), "{place}");
        assert!(place.starts_with(&format!("rib.vcut:{number}:")), "{place}");
        count += 1;
    }
    assert!(count > 15, "{count} places");
    for row in [
        "<th scope=\"row\">swing</th><td>35\u{a0}deg</td>",
        "<th scope=\"row\">run_out</th><td>2\u{a0}mm</td><td>default</td>",
        "<th scope=\"row\">extension</th><td>",
        "<strong>auto</strong>: the blade's overhang and the run-out",
    ] {
        assert!(page.contains(row), "{row}");
    }
}

#[test]
fn a_value_of_the_command_line_is_said_to_come_from_there() {
    let shop = shop(RIB);
    let run = vcutc(
        shop.path(),
        &["report", "-q", "rib.vcut", "-o", "-", "--set", "width=36mm"],
    );
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("36 x 30 x 30\u{a0}mm"));
}

#[test]
fn names_cannot_break_out_of_the_page() {
    let page = written(shop(&hostile_rib()).path());
    assert!(page.contains("&lt;script&gt;top.hacked=1&lt;/script&gt;"));
    assert!(!page.contains("<script>top"));
    assert!(!page.contains("<img"));
}

#[test]
fn a_job_without_a_machine_and_one_from_standard_input_are_reported() {
    let (job, _) = RIB.split_once("machine cell").unwrap();
    let run = vcutc_reading(folder().path(), &["report", "-q", "-", "-o", "-"], job);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert!(run.stdout.contains("the job has no machine"));
    assert!(!run.stdout.contains("id=\"machine\""));
}
