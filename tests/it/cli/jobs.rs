//! Jobs from the disk to the disk: what is written, what is reported, and what stays as it was.

use super::{Run, command, folder, json_lines, names, run, vcutc, vcutc_reading};
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::verify::verify;

/// A small job that compiles.
pub(super) const RIB: &str = r#"job "rib"

let width = 40 mm

stock { size = (width, 30 mm, 30 mm) }

profile {
  start (0 mm, 10 mm)
  line  to (width, 16 mm)
}

blade dagger {
  cutting_length = 10 mm
  half_apex      = 7.13 deg
  thickness      = 1.5 mm
  edges          = double
}

rough vcut {
  blade     = dagger
  lattice   = orthogonal
  rake      = 60 deg
  swing     = 35 deg
  layer     = 4 mm
  step      = auto
  feed      { cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}

machine cell = robot "kuka/kr210_r3100_ultra" {
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1700 mm, y = -600 mm, z = 650 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  load       = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}
"#;

/// The names of the program of [`RIB`].
const PROGRAM: [&str; 2] = ["rib.dat", "rib.src"];

/// A folder with the job `rib.vcut`, and `bad.vcut` with an error of meaning.
fn shop() -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    let bad = RIB.replace("rake      = 60 deg", "rake      = 60 mm");
    fs::write(folder.path().join("bad.vcut"), bad).unwrap();
    folder
}

fn compile(folder: &Path, job: &str, more: &[&str]) -> Run {
    vcutc(folder, &[&[job, "--target", "krl", "-o", "out"], more].concat())
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn a_program_is_written_and_reported() {
    let shop = shop();
    let run = compile(shop.path(), "rib.vcut", &[]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
    assert_eq!(names(&shop.path().join("out")), PROGRAM);
    for name in PROGRAM {
        let line = format!("wrote {}", Path::new("out").join(name).display());
        assert!(
            run.stderr.lines().any(|printed| printed == line),
            "{}",
            run.stderr
        );
    }
}

/// A program takes the place of another job's only with a word about it, and of its own without.
#[test]
fn who_replaces_the_program_of_another_job_says_so() {
    let shop = shop();
    let text = read(shop.path(), "rib.vcut");
    let renamed = text.replace("job \"rib\"", "job \"rib!\"");
    assert_ne!(renamed, text);
    fs::write(shop.path().join("other.vcut"), renamed).unwrap();
    let own = "was the program of another job";
    for (job, replaced) in [
        ("rib.vcut", None),
        ("rib.vcut", None),
        ("other.vcut", Some("`rib`")),
        ("other.vcut", None),
    ] {
        let run = compile(shop.path(), job, &[]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert_eq!(
            run.stderr.contains(own),
            replaced.is_some(),
            "{job}: {}",
            run.stderr
        );
        assert!(
            run.stderr.contains(replaced.unwrap_or_default()),
            "{job}: {}",
            run.stderr
        );
    }
    let run = compile(shop.path(), "rib.vcut", &["--message-format", "json"]);
    let summary = json_lines(&run.stderr)
        .into_iter()
        .find(|line| line["kind"] == "summary")
        .unwrap();
    assert_eq!(summary["replaced"][0]["job"], "rib!", "{summary}");
}

#[test]
fn a_shortened_name_is_reported_and_does_not_belong_to_another_job() {
    let shop = shop();
    let text = read(shop.path(), "rib.vcut");
    for end in ["a", "b"] {
        let job = format!("{end}.vcut");
        let name = format!("job \"rib_of_the_left_wing_{end}\"");
        fs::write(shop.path().join(&job), text.replace("job \"rib\"", &name)).unwrap();
        let run = compile(shop.path(), &job, &[]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(
            run.stderr.contains("the program is called `rib_of_the_"),
            "{}",
            run.stderr
        );
    }
    assert_eq!(names(&shop.path().join("out")).len(), 4);
    let run = compile(shop.path(), "rib.vcut", &[]);
    assert!(!run.stderr.contains("the program is called"), "{}", run.stderr);
}

#[test]
fn without_a_folder_files_go_to_the_current_one() {
    let shop = shop();
    let run = vcutc(shop.path(), &["rib.vcut", "--target", "krl"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(names(shop.path()), ["bad.vcut", "rib.dat", "rib.src", "rib.vcut"]);
}

#[test]
fn standard_output_carries_the_same_files_under_headings() {
    let shop = shop();
    let run = vcutc(shop.path(), &["rib.vcut", "--target", "krl", "-o", "-"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(names(shop.path()), ["bad.vcut", "rib.vcut"]);
    compile(shop.path(), "rib.vcut", &[]);
    let expected: String = ["rib.src", "rib.dat"]
        .map(|name| format!("; file: {name}\n{}", read(&shop.path().join("out"), name)))
        .concat();
    assert_eq!(run.stdout, expected);
}

#[test]
fn the_same_job_gives_the_same_bytes() {
    let (first, second) = (shop(), shop());
    for shop in [&first, &second] {
        compile(shop.path(), "rib.vcut", &[]);
    }
    for name in PROGRAM {
        assert_eq!(
            read(&first.path().join("out"), name),
            read(&second.path().join("out"), name)
        );
    }
}

#[test]
fn a_job_with_errors_leaves_nothing_and_touches_nothing() {
    let shop = shop();
    let run = compile(shop.path(), "bad.vcut", &[]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("error[VC0203]"), "{}", run.stderr);
    assert!(
        run.stderr.ends_with("bad.vcut: 1 error; nothing was written\n"),
        "{}",
        run.stderr
    );
    assert_eq!(names(shop.path()), ["bad.vcut", "rib.vcut"]);

    fs::create_dir(shop.path().join("out")).unwrap();
    fs::write(shop.path().join("out/rib.src"), "earlier").unwrap();
    assert_eq!(compile(shop.path(), "bad.vcut", &[]).code, Some(1));
    assert_eq!(read(shop.path(), "out/rib.src"), "earlier");
}

#[test]
fn a_target_that_cannot_say_the_job_leaves_nothing_either() {
    let shop = shop();
    let (without_machine, _) = RIB.split_once("machine").unwrap();
    fs::write(shop.path().join("table.vcut"), without_machine).unwrap();
    let run = compile(shop.path(), "table.vcut", &[]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("error[VC0601]"), "{}", run.stderr);
    assert!(!shop.path().join("out").exists());
    assert_eq!(
        vcutc(shop.path(), &["table.vcut"]).code,
        Some(0),
        "without a target it is well"
    );
}

#[test]
fn a_file_that_cannot_be_replaced_keeps_all_others_as_they_were() {
    let shop = shop();
    let out = shop.path().join("out");
    // The program's second file cannot be written: a folder has its name.
    fs::create_dir_all(out.join("rib.dat")).unwrap();
    fs::write(out.join("rib.src"), "earlier").unwrap();
    let run = compile(shop.path(), "rib.vcut", &[]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("rib.dat"), "{}", run.stderr);
    assert_eq!(names(&out), PROGRAM);
    assert_eq!(read(&out, "rib.src"), "earlier");
}

#[test]
fn a_file_in_place_of_the_folder_is_trouble_not_a_fault_of_the_job() {
    let shop = shop();
    fs::write(shop.path().join("out"), "a file").unwrap();
    let run = compile(shop.path(), "rib.vcut", &[]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("it is a file, not a folder"),
        "{}",
        run.stderr
    );
    assert_eq!(read(shop.path(), "out"), "a file");
}

#[test]
fn a_job_that_cannot_be_read_is_not_a_job_with_errors() {
    let shop = shop();
    for (job, why) in [
        ("none.vcut", "no such file"),
        (".", "folder"),
        ("", "no such file"),
    ] {
        let run = vcutc(shop.path(), &["check", job]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{job}");
        assert!(run.stderr.contains(why), "{}", run.stderr);
    }
}

#[test]
fn a_command_taken_for_a_job_is_recognised() {
    let run = vcutc(shop().path(), &["target"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("did you mean the command `vcutc targets`?"),
        "{}",
        run.stderr
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_a_job_is_refused_and_not_waited_for() {
    let shop = shop();
    let made = std::process::Command::new("mkfifo")
        .arg(shop.path().join("pipe.vcut"))
        .status()
        .unwrap();
    assert!(made.success());
    let run = vcutc(shop.path(), &["check", "pipe.vcut"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("use `-`"), "{}", run.stderr);
}

#[test]
fn a_job_can_come_from_standard_input() {
    let shop = shop();
    let run = vcutc_reading(shop.path(), &["-", "--target", "krl", "-o", "out"], RIB);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(names(&shop.path().join("out")), PROGRAM);
    let run = vcutc_reading(shop.path(), &["check", "-"], "job");
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("<stdin>:1:"), "{}", run.stderr);
}

#[test]
fn a_let_can_be_replaced() {
    let shop = shop();
    let cuts = |more: &[&str]| {
        let run = vcutc(shop.path(), &[&["rib.vcut", "--emit", "plan"], more].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stdout.lines().count()
    };
    assert!(cuts(&["--set", "width=80mm"]) > cuts(&[]));
    let run = vcutc(shop.path(), &["rib.vcut", "--set", "widht=80mm"]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("error[VC0216]") && run.stderr.contains("width"),
        "{}",
        run.stderr
    );
}

#[test]
fn the_worst_of_several_jobs_decides() {
    let shop = shop();
    let code = |jobs: &[&str]| vcutc(shop.path(), &[&["check"], jobs].concat()).code;
    assert_eq!(code(&["rib.vcut", "rib.vcut"]), Some(0));
    assert_eq!(code(&["bad.vcut", "rib.vcut"]), Some(1));
    assert_eq!(code(&["bad.vcut", "none.vcut", "rib.vcut"]), Some(2));
}

#[test]
fn checking_writes_nothing_and_says_why_where_a_program_was_expected() {
    let shop = shop();
    let run = vcutc(shop.path(), &["rib.vcut"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
    assert!(
        run.stderr.contains("no --target was given (targets: "),
        "{}",
        run.stderr
    );
    assert_eq!(names(shop.path()), ["bad.vcut", "rib.vcut"]);
}

#[test]
fn quiet_is_quiet_until_something_is_wrong() {
    let shop = shop();
    let run = compile(shop.path(), "rib.vcut", &["-q"]);
    assert_eq!(
        (run.code, run.stdout.as_str(), run.stderr.as_str()),
        (Some(0), "", "")
    );
    let run = compile(shop.path(), "bad.vcut", &["-q"]);
    assert!(run.stderr.contains("error[VC0203]"), "{}", run.stderr);
}

#[test]
fn verbose_names_every_stage() {
    let shop = shop();
    let run = compile(shop.path(), "rib.vcut", &["-v"]);
    for stage in ["reading", "planning", "proving", "emitting"] {
        let mut lines = run.stderr.lines();
        assert!(
            lines.any(|line| line.starts_with(stage) && line.ends_with(" ms")),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn for_programs_every_line_is_json_and_the_last_is_the_summary() {
    let shop = shop();
    let run = compile(shop.path(), "rib.vcut", &["--message-format", "json", "-v"]);
    let lines = json_lines(&run.stderr);
    // Hints come before the summary.
    let [hints @ .., summary] = lines.as_slice() else {
        panic!("{lines:?}")
    };
    assert!(hints.iter().all(|line| line["kind"] == "hint"), "{lines:?}");
    assert_eq!(
        (&summary["kind"], &summary["errors"]),
        (&"summary".into(), &0.into())
    );
    assert_eq!(summary["files"].as_array().unwrap().len(), 2);
    assert_eq!(summary["stages"].as_array().unwrap().len(), 5);

    let run = compile(shop.path(), "bad.vcut", &["--message-format", "json"]);
    let lines = json_lines(&run.stderr);
    let [diagnostic, summary] = lines.as_slice() else {
        panic!("{lines:?}")
    };
    assert_eq!(diagnostic["code"], "VC0203");
    assert_eq!(
        (&summary["kind"], &summary["errors"]),
        (&"summary".into(), &1.into())
    );
    assert_eq!(summary["files"].as_array().unwrap().len(), 0);
}

#[test]
fn diagnostics_are_coloured_when_asked_for() {
    let shop = shop();
    let plain = vcutc(shop.path(), &["check", "bad.vcut"]);
    let coloured = vcutc(shop.path(), &["check", "bad.vcut", "--color", "always"]);
    assert!(!plain.stderr.contains('\u{1b}') && coloured.stderr.contains('\u{1b}'));
    assert_eq!(
        anstream::adapter::strip_str(&coloured.stderr).to_string(),
        plain.stderr
    );
}

#[test]
fn the_intermediate_program_is_a_program() {
    let shop = shop();
    let run = vcutc(shop.path(), &["rib.vcut", "--emit", "ir"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let program: Program = serde_json::from_str(&run.stdout).unwrap();
    assert!(verify(program).is_ok());
}

#[test]
fn the_plan_has_a_row_for_each_cut() {
    let shop = shop();
    let run = vcutc(shop.path(), &["rib.vcut", "--emit", "plan", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(names(&shop.path().join("out")), ["rib.plan.csv"]);
    let plan = read(shop.path(), "out/rib.plan.csv");
    let (header, rows) = plan.split_once('\n').unwrap();
    assert_eq!(
        header,
        "operation,layer,cut,kind,blade,x_mm,z_mm,swing_deg,lead_deg,left_mm,right_mm,bottom_mm,top_mm,origin,y_mm,length_mm,entry"
    );
    let counted = run
        .stderr
        .split_once(" cuts in")
        .and_then(|(before, _)| before.rsplit(' ').next())
        .unwrap();
    assert_eq!(rows.lines().count().to_string(), counted);
}

#[test]
fn the_tree_is_shown_for_a_job_with_errors_too() {
    let shop = shop();
    let run = vcutc(shop.path(), &["bad.vcut", "--emit", "ast"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stdout.starts_with("Ast {"), "{}", run.stdout);
    let run = vcutc(shop.path(), &["bad.vcut", "--emit", "ir", "-o", "out"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(!shop.path().join("out/bad.ir.json").exists());
}

#[test]
fn a_reader_that_has_seen_enough_of_a_program_is_not_an_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let shop = shop();
    let mut command = command(shop.path(), &["rib.vcut", "--target", "krl", "-o", "-", "-q"]);
    command.stdout(writer);
    let output = command
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap()
        .wait_with_output()
        .unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}

#[test]
fn a_job_is_found_from_another_folder_with_the_files_it_uses() {
    let shop = shop();
    let (above, blade_and_below) = RIB.split_once("blade dagger").unwrap();
    let (blade, below) = blade_and_below.split_once("rough vcut").unwrap();
    fs::create_dir(shop.path().join("shop")).unwrap();
    fs::write(
        shop.path().join("shop/blades.vcut"),
        format!("blade dagger{blade}"),
    )
    .unwrap();
    let job = format!("{above}use \"shop/blades.vcut\"\nrough vcut{below}");
    fs::write(shop.path().join("uses.vcut"), job).unwrap();
    let elsewhere = folder();
    let path = shop.path().join("uses.vcut");
    let run = run(command(elsewhere.path(), &["check", path.to_str().unwrap()]));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

#[test]
fn the_job_of_the_readme_compiles() {
    let folder = folder();
    let out = folder.path().to_str().unwrap();
    let job = "examples/spoiler_clarky.vcut";
    let run = vcutc(crate::repository::root(), &[job, "--target", "krl", "-o", out]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(names(folder.path()), ["spoiler_clarky.dat", "spoiler_clarky.src"]);
}
