//! Programs with a blade that spins.

use crate::read_back::replayed;
use crate::support::{DIALECTS, block, emit, issues, needed, options, reachable, recipe};
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::ir::{Changer, Program, Spindle};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{ProgramFile, program_files};
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{Recipe, with_disc};

fn program(spindle: Spindle) -> Program {
    let recipe = Recipe {
        name: "disc".to_owned(),
        layers: 1,
        cuts: 1,
        ..recipe()
    };
    with_disc(recipe.program(), Changer::Program, spindle)
}

fn is_read_back(program: &ReachableProgram, dialect: &'static str, files: &[ProgramFile]) -> bool {
    replayed(program, files, &options(&needed(dialect))).0.is_ok()
}

/// Heidenhain's lines have numbers.
fn blocks(files: &[ProgramFile]) -> Vec<String> {
    let lines = files.iter().flat_map(|file| file.text.lines());
    lines
        .map(|line| {
            line.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim()
                .to_owned()
        })
        .collect()
}

#[test]
fn each_dialect_turns_its_own_spindle() {
    for dialect in DIALECTS {
        let program = reachable(program(Spindle::Own));
        let files = program_files(&emit(&program, dialect, &[]));
        let blocks = blocks(&files);
        let on = match dialect {
            "heidenhain" => &["TOOL CALL S3000", "M3"][..],
            _ => &["S3000 M3"][..],
        };
        assert!(
            blocks.windows(on.len()).any(|window| window == on),
            "{dialect}: {blocks:#?}"
        );
        assert!(blocks.iter().any(|block| block == "M5"), "{dialect}");
        for limit in [0, 1, 20] {
            let given = [(LINES_PER_PART, OptionValue::Integer(limit))];
            let split = program_files(&emit(&program, dialect, &given));
            assert!(is_read_back(&program, dialect, &split), "{dialect} {limit}");
        }
    }
}

#[test]
fn every_change_of_it_is_found() {
    for dialect in DIALECTS {
        let program = reachable(program(Spindle::Own));
        for (from, to) in [
            ("S3000", "S3001"),
            ("M3\n", "M4\n"),
            ("M3\n", "M5\n"),
            ("M5\n", "M9\n"),
        ] {
            let mut files = program_files(&emit(&program, dialect, &[]));
            let mut changed = false;
            for file in &mut files {
                let text = file.text.replace(from, to);
                changed |= text != file.text;
                file.text = text;
            }
            assert!(changed, "{dialect}: {from}");
            assert!(!is_read_back(&program, dialect, &files), "{dialect}: {from} {to}");
        }
    }
}

/// Where a control has a word for outputs, one may run the drive of a disc.
#[test]
fn an_output_runs_a_spindle_where_a_control_has_a_word_for_it() {
    let program = reachable(program(Spindle::Output(3)));
    for dialect in DIALECTS {
        let refused =
            |issue: &BackendIssue| matches!(issue, BackendIssue::OptionConflict { key: "spindle", .. });
        if ["linuxcnc", "sinumerik"].contains(&dialect) {
            let files = program_files(&emit(&program, dialect, &[]));
            assert!(is_read_back(&program, dialect, &files), "{dialect}");
            let word = if dialect == "linuxcnc" {
                "M64 P3"
            } else {
                "$A_OUT[3]=1"
            };
            assert!(blocks(&files).iter().any(|block| block == word), "{dialect}");
        } else {
            let found = issues(program.program().clone(), &needed(dialect));
            assert!(found.iter().any(refused), "{dialect}: {found:?}");
        }
    }
}

#[test]
fn a_code_that_turns_the_spindle_does_not_switch_the_generator() {
    let given = |on: &'static str| {
        let mut given = needed("linuxcnc");
        given.extend([("on_code", block(on)), ("off_code", block("M102"))]);
        given
    };
    let is_conflict =
        |issue: &BackendIssue| matches!(issue, BackendIssue::OptionConflict { key: "on_code", .. });
    for on in ["M3", "M03 (on)", "m4"] {
        let found = issues(program(Spindle::Own), &given(on));
        assert!(found.iter().any(is_conflict), "{on}: {found:?}");
    }
    let found = issues(program(Spindle::Own), &given("M101"));
    assert!(!found.iter().any(is_conflict), "{found:?}");
    // A machine that spins nothing may use them.
    let still = issues(recipe().program(), &given("M3"));
    assert!(!still.iter().any(is_conflict), "{still:?}");
}
