//! Help, pages and lists; and everything that is refused before a job is looked at.

use super::{command, folder, json_lines, run, vcutc};
use insta::assert_snapshot;
use std::process::Stdio;
use vcutc::diagnostics::Code;

#[test]
fn help_teaches() {
    let folder = folder();
    for (name, args) in [
        ("help", vec!["--help"]),
        ("help_short", vec!["-h"]),
        ("help_check", vec!["check", "--help"]),
        ("help_explain", vec!["explain", "--help"]),
    ] {
        let run = vcutc(folder.path(), &args);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        assert_snapshot!(name, run.stdout);
    }
}

#[test]
fn without_arguments_the_help_is_shown_and_nothing_is_well() {
    let folder = folder();
    let run = vcutc(folder.path(), &[]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert!(run.stderr.contains("Usage: vcutc"), "{}", run.stderr);
}

#[test]
fn the_version_is_that_of_the_package() {
    let run = vcutc(folder().path(), &["--version"]);
    assert_eq!(run.stdout, concat!("vcutc ", env!("CARGO_PKG_VERSION"), "\n"));
    assert_eq!(run.code, Some(0));
}

/// The line that says which targets there are.
fn known_targets() -> String {
    let ids: Vec<&str> = vcutc::registry::backends()
        .iter()
        .map(|backend| backend.id())
        .collect();
    format!(
        "  help: targets: {}; others are programs `vcutc-backend-NAME` on the PATH or in a folder of `--backend-path`\n",
        ids.join(", ")
    )
}

#[test]
fn an_unknown_target_is_answered_with_the_known_ones() {
    let run = vcutc(folder().path(), &["rib.vcut", "--target", "klr"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    let help = format!(
        "error: there is no target `klr`\n  help: did you mean `--target krl`?\n{}",
        known_targets()
    );
    assert_eq!(run.stderr, help);
}

#[test]
fn a_target_like_no_other_is_answered_without_a_guess() {
    let run = vcutc(folder().path(), &["rib.vcut", "--target", "mazatrol"]);
    assert_eq!(run.code, Some(2));
    assert_eq!(
        run.stderr,
        format!("error: there is no target `mazatrol`\n{}", known_targets())
    );
}

#[test]
fn a_mistyped_command_is_answered_with_the_right_one() {
    let run = vcutc(folder().path(), &["explian", "VC0203"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("`vcutc explain`"), "{}", run.stderr);
}

#[test]
fn a_program_and_an_inner_form_exclude_each_other() {
    let run = vcutc(folder().path(), &["rib.vcut", "--target", "krl", "--emit", "ir"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("--emit"), "{}", run.stderr);
}

#[test]
fn arguments_of_a_compilation_cannot_stand_in_front_of_a_command() {
    for args in [
        ["--target", "krl", "targets"].as_slice(),
        &["rib.vcut", "targets"],
        &["--set", "a=1", "targets"],
    ] {
        let run = vcutc(folder().path(), args);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(run.stderr.contains("before a command"), "{}", run.stderr);
    }
}

#[test]
fn arguments_on_display_may_stand_anywhere() {
    for args in [
        ["--color", "never", "explain", "VC0203"].as_slice(),
        &["explain", "VC0203", "--color", "never"],
    ] {
        let run = vcutc(folder().path(), args);
        assert_eq!(
            (run.code, run.stdout.as_str()),
            (Some(0), Code::WrongDimension.page())
        );
    }
}

#[test]
fn explain_without_a_code_lists_them_all() {
    let run = vcutc(folder().path(), &["explain"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    for code in Code::ALL {
        assert!(run.stdout.contains(code.title()), "{}", code.number());
    }
}

#[test]
fn an_unknown_code_is_answered_with_a_near_one() {
    let run = vcutc(folder().path(), &["explain", "VC203"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert!(run.stderr.contains("did you mean `VC0203`?"), "{}", run.stderr);
}

#[test]
fn targets_are_listed_with_every_option() {
    let run = vcutc(folder().path(), &["targets"]);
    assert_eq!(run.code, Some(0));
    for backend in vcutc::registry::backends() {
        assert!(run.stdout.contains(backend.summary()), "{}", run.stdout);
        for option in backend.options() {
            assert!(
                run.stdout.contains(option.key) && run.stdout.contains(option.help),
                "{}",
                option.key
            );
        }
    }
}

#[test]
fn refusals_are_json_where_json_is_asked_for() {
    let run = vcutc(
        folder().path(),
        &["rib.vcut", "--target", "klr", "--message-format", "json"],
    );
    assert_eq!(run.code, Some(2));
    let lines = json_lines(&run.stderr);
    let [line] = lines.as_slice() else {
        panic!("{lines:?}")
    };
    assert_eq!(line["kind"], "failure");
    assert_eq!(line["message"], "there is no target `klr`");
}

#[test]
fn colours_come_when_asked_for_and_go_when_refused() {
    let folder = folder();
    let refused = ["rib.vcut", "--target", "klr"];
    let is_coloured = |args: &[&str], variable: Option<(&str, &str)>| {
        let mut command = command(folder.path(), &[&refused, args].concat());
        command.envs(variable);
        run(command).stderr.contains('\u{1b}')
    };
    assert!(!is_coloured(&[], None), "standard error is no terminal here");
    assert!(is_coloured(&["--color", "always"], None));
    assert!(
        is_coloured(&["--color", "always"], Some(("NO_COLOR", "1"))),
        "the argument outranks the variable"
    );
    assert!(is_coloured(&[], Some(("CLICOLOR_FORCE", "1"))));
    assert!(!is_coloured(&["--color", "never"], Some(("CLICOLOR_FORCE", "1"))));
}

#[test]
fn a_reader_that_has_seen_enough_is_not_an_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let folder = folder();
    let mut command = command(folder.path(), &["explain"]);
    command.stdout(writer).stderr(Stdio::piped());
    let output = command.spawn().unwrap().wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
