//! What the command line says to words that are nearly right, and what it makes for shells and manuals.

use super::jobs::RIB;
use super::{command, folder, names, run, vcutc};
use crate::commit;
use crate::repository::root;
use std::fs;

#[test]
fn a_folder_without_a_target_is_an_error() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    for args in [
        &["rib.vcut", "-o", "out"][..],
        &["-q", "rib.vcut", "-o", "out"],
        &["watch", "rib.vcut", "-o", "out"],
    ] {
        let run = vcutc(folder.path(), args);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(
            run.stderr.starts_with("error: `-o out` gives a place for files, but no target was given, so there are none\n  help: write `--target "),
            "{}",
            run.stderr
        );
    }
    assert_eq!(names(folder.path()), ["rib.vcut"]);
}

#[test]
fn jobs_and_commands_that_were_meant_are_offered() {
    let folder = folder();
    fs::write(folder.path().join("ok.vcut"), RIB).unwrap();
    for (args, expected) in [
        (&["ok"][..], "did you mean the job `ok.vcut`?"),
        (&["check", "okk.vcut"], "did you mean the job `ok.vcut`?"),
        (
            &["chek", "ok.vcut"],
            "error: there is no command `chek`\n  help: did you mean `vcutc check`?\n",
        ),
    ] {
        let run = vcutc(folder.path(), args);
        assert_eq!(run.code, Some(2), "{args:?}");
        assert!(run.stderr.contains(expected), "{args:?}: {}", run.stderr);
    }
}

#[test]
fn data_that_is_given_as_a_job_says_what_it_is() {
    let out = folder();
    for (name, text, words) in [
        (
            "heights.csv",
            "x,z\n0,18\n",
            "it is a file of points, not a job; a job names it: `profile { points \"heights.csv\" }`",
        ),
        (
            "rib.dat",
            "rib\n1 0\n",
            "it is a file of an airfoil, not a job; a job names it: `profile { airfoil \"rib.dat\" { ... } }`",
        ),
        (
            "rib.src",
            "DEF rib()\nEND\n",
            "it is a program, not a job; `vcutc verify JOB PROGRAM` compares it with its job",
        ),
    ] {
        fs::write(out.path().join(name), text).unwrap();
        for arguments in [&[name][..], &["check", name]] {
            let run = vcutc(out.path(), arguments);
            assert_eq!(run.code, Some(2), "{}", run.stderr);
            assert_eq!(
                run.stderr,
                format!("error: cannot read the job {name}: {words}\n")
            );
        }
    }
}

/// What a target refuses is not buried under the figures of the plan.
#[test]
fn a_refused_option_has_no_summary_above_it() {
    let out = folder();
    let folder = out.path().to_str().unwrap();
    let job = "examples/spoiler_clarky.vcut";
    let run = vcutc(
        root(),
        &[
            job,
            "--target",
            "krl",
            "-o",
            folder,
            "--option",
            "aproximation=2mm",
        ],
    );
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("help: use `approximation`"), "{}", run.stderr);
    assert!(!run.stderr.contains("per layer"), "{}", run.stderr);
    assert!(
        run.stderr.ends_with("1 error; nothing was written\n"),
        "{}",
        run.stderr
    );
}

#[test]
fn controls_lead_to_their_targets() {
    let folder = folder();
    for (name, flags) in [
        ("kuka", "--target krl"),
        ("abb", "--target rapid"),
        ("fanuc", "--target gcode --option dialect=fanuc"),
        ("sinumerik", "--target gcode --option dialect=sinumerik"),
        ("heidenhain", "--target gcode --option dialect=heidenhain"),
        ("LinuxCNC", "--target gcode --option dialect=linuxcnc"),
    ] {
        let run = vcutc(folder.path(), &["rib.vcut", "--target", name]);
        let known = vcutc::registry::backends()
            .iter()
            .any(|backend| flags.contains(backend.id()));
        assert_eq!(run.code, Some(2));
        let expected = format!("did you mean `{flags}`?");
        assert_eq!(run.stderr.contains(&expected), known, "{}", run.stderr);
    }
}

/// What is offered to a job for one maker's robot is never refused as a target of another maker's.
#[test]
fn targets_are_offered_that_drive_the_machine_of_the_job() {
    let folder = folder();
    let gantry = "generic/head_head_ac";
    for (machine, flag) in [
        ("kuka/kr210_r3100_ultra", "krl"),
        ("abb/irb6700_200_260", "rapid"),
        (gantry, "gcode"),
    ] {
        let made = vcutc(folder.path(), &["init", flag, "--robot", machine]);
        assert_eq!(made.code, Some(0), "{}", made.stderr);
        let job = format!("{flag}.vcut");
        for args in [
            &[job.as_str(), "-o", "out"][..],
            &["watch", job.as_str(), "-o", "out"],
            &[job.as_str(), "--target", "kuka"],
            &[job.as_str(), "--target", "abb"],
            &["report", job.as_str(), "--target", "fanuc"],
            &["verify", job.as_str(), job.as_str(), "--target", "cnc"],
            &[job.as_str(), "--target", "something"],
        ] {
            let run = vcutc(folder.path(), args);
            assert_eq!(run.code, Some(2), "{args:?}");
            let offer = format!("--target {flag}");
            let others = ["krl", "rapid", "gcode"]
                .into_iter()
                .filter(|other| *other != flag);
            let known = vcutc::registry::backend(flag).is_some();
            assert_eq!(run.stderr.contains(&offer), known, "{args:?}: {}", run.stderr);
            for other in others {
                let offer = format!("--target {other}");
                assert!(!run.stderr.contains(&offer), "{args:?}: {}", run.stderr);
            }
        }
    }
    let (without, _) = RIB.split_once("machine cell").unwrap();
    fs::write(folder.path().join("rib.vcut"), without).unwrap();
    let run = vcutc(folder.path(), &["rib.vcut", "-o", "out"]);
    assert!(run.stderr.contains("the job has no machine"), "{}", run.stderr);
}

/// Options of the machine's block that a dialect does not have are taken back in what is offered, which then works as it is.
#[test]
#[cfg(feature = "gcode")]
fn a_dialect_is_offered_with_what_its_job_needs() {
    let folder = folder();
    let made = vcutc(
        folder.path(),
        &["init", "part", "--robot", "generic/head_head_ac"],
    );
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let run = vcutc(
        folder.path(),
        &["part.vcut", "--target", "sinumerik", "-o", "out"],
    );
    assert_eq!(run.code, Some(2));
    let offer = run.stderr.split("did you mean `").nth(1);
    let offer = offer.and_then(|rest| rest.split('`').next()).unwrap_or_default();
    assert!(offer.contains("dialect=sinumerik"), "{}", run.stderr);
    let mut args = vec!["part.vcut", "-o", "out"];
    args.extend(offer.split(' '));
    let run = vcutc(folder.path(), &args);
    assert_eq!(run.code, Some(0), "{args:?}: {}", run.stderr);
}

#[test]
fn lists_with_blanks_are_answered_with_commas() {
    let run = vcutc(
        folder().path(),
        &[
            "fk",
            "kuka/kr210_r3100_ultra",
            "--joints",
            "0",
            "-90",
            "90",
            "0",
            "45",
            "0",
        ],
    );
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr
            .starts_with("error: --joints takes numbers separated by commas: --joints 0,-90,90,0,45,0\n"),
        "{}",
        run.stderr
    );
}

#[test]
fn a_length_without_its_unit_is_offered_with_it() {
    let folder = folder();
    let job = crate::repository::read("examples/block_cui.vcut");
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    let run = vcutc(
        folder.path(),
        &["rib.vcut", "--target", "krl", "--option", "approximation=2"],
    );
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("use `2 mm`"), "{}", run.stderr);
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = folder();
    let job = crate::repository::read("examples/block_cui.vcut");
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    // No files can be made there, not even by root.
    let run = vcutc(
        folder.path(),
        &["-q", "rib.vcut", "--target", "krl", "-o", "/proc/self"],
    );
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(
        run.stderr.starts_with("error: cannot write into /proc/self: "),
        "{}",
        run.stderr
    );
    assert!(!run.stderr.contains(".vcutc-"), "{}", run.stderr);
}

#[test]
fn a_part_of_a_name_lists_the_machines_that_have_it() {
    let run = vcutc(folder().path(), &["machines", "irb4600"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let listed = run
        .stdout
        .lines()
        .filter(|line| line.contains("abb/irb4600_"))
        .count();
    assert_eq!(listed, 3, "{}", run.stdout);
    assert!(!run.stdout.contains("kuka/"), "{}", run.stdout);
    let none = vcutc(folder().path(), &["machines", "fanuc"]);
    assert_eq!(none.code, Some(2), "{}", none.stdout);
}

#[test]
fn shells_know_every_command() {
    let folder = folder();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let run = vcutc(folder.path(), &["completions", shell]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{shell}");
        for word in ["verify", "optimize", "message-format"] {
            assert!(run.stdout.contains(word), "{shell}: no {word}");
        }
    }
    assert_eq!(vcutc(folder.path(), &["completions", "dos"]).code, Some(2));
}

#[test]
fn there_is_a_manual_page_for_every_command_without_a_date() {
    let folder = folder();
    let made = vcutc(folder.path(), &["man", "-o", "man1"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let pages = names(&folder.path().join("man1"));
    for page in ["vcutc.1", "vcutc-check.1", "vcutc-init.1", "vcutc-verify.1"] {
        assert!(pages.iter().any(|name| name == page), "{page}: {pages:?}");
    }
    let check = fs::read_to_string(folder.path().join("man1/vcutc-check.1")).unwrap();
    let title = check.lines().find(|line| line.starts_with(".TH")).unwrap();
    assert!(title.starts_with(".TH vcutc-check 1"), "{title}");
    assert!(!title.contains("20"), "a page without a date: {title}");
}

#[test]
fn plots_without_a_choice_draw_all_into_a_folder() {
    let folder = folder();
    let job = crate::repository::read("examples/block_cui.vcut");
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    let drawn = vcutc(folder.path(), &["plot", "rib.vcut", "-o", "pictures"]);
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    assert_eq!(
        names(&folder.path().join("pictures")),
        ["contour", "correlation", "deviation", "joints", "lattice", "time"]
            .map(|what| format!("rib_{what}.svg"))
    );
    let one = vcutc(folder.path(), &["plot", "rib.vcut", "--what", "time"]);
    assert_eq!(
        one.stdout,
        fs::read_to_string(folder.path().join("pictures/rib_time.svg")).unwrap()
    );
    for output in ["-", "one.svg"] {
        let run = vcutc(folder.path(), &["plot", "rib.vcut", "-o", output]);
        assert_eq!(run.code, Some(2));
        assert!(run.stderr.contains("--what contour"), "{}", run.stderr);
    }
}

#[cfg(unix)]
#[test]
fn a_report_is_named_after_its_job_and_opened() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let job = crate::repository::read("examples/block_cui.vcut");
    fs::write(folder.path().join("rib.vcut"), job).unwrap();
    let browser = folder.path().join("browser");
    fs::write(&browser, "#!/bin/sh\necho \"$1\" > opened\n").unwrap();
    fs::set_permissions(&browser, fs::Permissions::from_mode(0o755)).unwrap();
    let mut opening = command(folder.path(), &["report", "rib.vcut", "--open"]);
    opening.env("BROWSER", &browser);
    let opened = run(opening);
    assert_eq!(opened.code, Some(0), "{}", opened.stderr);
    assert_eq!(
        fs::read_to_string(folder.path().join("opened")).unwrap(),
        "rib.html\n"
    );
    assert!(folder.path().join("rib.html").is_file());
    let mut failing = command(folder.path(), &["report", "rib.vcut", "--open"]);
    failing.env("BROWSER", folder.path().join("none"));
    let failed = run(failing);
    assert_eq!(failed.code, Some(2));
    assert!(
        failed.stderr.contains("cannot open rib.html"),
        "{}",
        failed.stderr
    );
    let streamed = vcutc(folder.path(), &["report", "rib.vcut", "-o", "-", "--open"]);
    assert_eq!(streamed.code, Some(2));
}

#[test]
fn a_program_is_verified_by_its_folder() {
    let folder = folder();
    let job = crate::repository::read("examples/block_cui.vcut");
    fs::write(folder.path().join("rib.vcut"), &job).unwrap();
    fs::write(
        folder.path().join("other.vcut"),
        job.replace("block_cui", "other"),
    )
    .unwrap();
    for job in ["rib.vcut", "other.vcut"] {
        let written = vcutc(folder.path(), &["-q", job, "--target", "krl", "-o", "out"]);
        assert_eq!(written.code, Some(0), "{}", written.stderr);
    }
    let verify = || vcutc(folder.path(), &["verify", "rib.vcut", "out"]);
    let same = verify();
    assert_eq!(same.code, Some(0), "{}", same.stderr);
    let program = folder.path().join("out/block_cui.src");
    let text = fs::read_to_string(&program).unwrap();
    fs::write(&program, text.replacen("WAIT", "HALT ; WAIT", 1)).unwrap();
    let changed = verify();
    assert_eq!(changed.code, Some(1), "{}", changed.stderr);
    fs::remove_file(&program).unwrap();
    fs::remove_file(folder.path().join("out/block_cui.dat")).unwrap();
    let missing = verify();
    assert_eq!(missing.code, Some(2), "{}", missing.stderr);
    assert!(
        missing.stderr.contains("no program of this job"),
        "{}",
        missing.stderr
    );
}

/// Checkouts, second working trees, packed branches and packages say their commit; an archive says none.
#[test]
fn a_release_knows_its_commit() {
    let hash = "0123456789abcdef0123456789abcdef01234567";
    let folder = folder();
    let root = folder.path();
    assert_eq!(commit::of(root), None);
    fs::write(
        root.join(".cargo_vcs_info.json"),
        format!("{{\"git\": {{\"sha1\": \"{hash}\"}}}}"),
    )
    .unwrap();
    assert_eq!(commit::of(root).as_deref(), Some("012345678"));
    fs::create_dir_all(root.join(".git/refs/heads")).unwrap();
    fs::write(root.join(".git/HEAD"), "ref: refs/heads/main\n").unwrap();
    fs::write(
        root.join(".git/packed-refs"),
        format!("# pack-refs\n{} refs/heads/main\n", hash.replace("012", "abc")),
    )
    .unwrap();
    assert_eq!(commit::of(root).as_deref(), Some("abc345678"));
    fs::write(
        root.join(".git/refs/heads/main"),
        format!("{}\n", hash.replace("012", "def")),
    )
    .unwrap();
    assert_eq!(commit::of(root).as_deref(), Some("def345678"));
    assert_eq!(commit::files(root).len(), 4);
    fs::write(root.join(".git/HEAD"), format!("{hash}\n")).unwrap();
    assert_eq!(commit::of(root).as_deref(), Some("012345678"));
    let tree = super::folder();
    fs::write(
        tree.path().join(".git"),
        format!("gitdir: {}\n", root.join(".git").display()),
    )
    .unwrap();
    assert_eq!(commit::of(tree.path()).as_deref(), Some("012345678"));
}

#[test]
fn what_the_system_refuses_is_explained() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for (args, words) in [
        (
            &["rib.vcut", "--target", "krl", "-o", "rib.vcut/out"][..],
            "a part of its path is a file, not a folder: check the path",
        ),
        (
            &["check", "rib.vcut/job.vcut"],
            "a part of its path is a file, not a folder: check the path",
        ),
    ] {
        let run = vcutc(folder.path(), args);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(
            run.stderr.contains(words) || vcutc::registry::backend("krl").is_none(),
            "{}",
            run.stderr
        );
        assert!(!run.stderr.contains("os error"), "{}", run.stderr);
    }
}

#[test]
fn a_height_below_zero_is_a_height_and_no_option() {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    for height in ["-5mm", "-5", "-0.1m"] {
        let run = vcutc(folder.path(), &["check", "rib.vcut", "--air-cut", height]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        let words = "a height must be greater than 0 mm and at most 10 m";
        assert!(run.stderr.contains(words), "{}", run.stderr);
    }
}

#[test]
fn advice_is_called_help_whoever_gives_it() {
    let run = vcutc(folder().path(), &["check", "rib.vcut", "--quit"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr
            .contains("\n  help: a similar argument exists: '--quiet'"),
        "{}",
        run.stderr
    );
    assert!(!run.stderr.contains("tip:"), "{}", run.stderr);
}

#[test]
fn a_first_job_names_the_words_that_each_dialect_needs() {
    let folder = folder();
    let made = vcutc(
        folder.path(),
        &["init", "first", "--robot", "generic/head_head_ac"],
    );
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let text = fs::read_to_string(folder.path().join("first.vcut")).unwrap();
    let known = vcutc::registry::backend("gcode").is_some();
    for word in ["on_code", "off_code", "ready_code", "tcp_on"] {
        assert_eq!(text.contains(word), known, "{word}: {text}");
    }
}
