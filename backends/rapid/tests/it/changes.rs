//! Programs that change the blade.

use crate::round_trip::replayed;
use crate::support::{cell, emit_with, issues, lines, one_cut, options, reachable};
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::ir::{Changer, Program};
use vcutc_backend_api::readback::{DivergenceKind, FrameRole, program_files};
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{CellRecipe, Recipe, two_blades};

fn recipe() -> Recipe {
    Recipe {
        name: "two".to_owned(),
        operations: 2,
        ..one_cut()
    }
}

fn program(by: Changer) -> Program {
    two_blades(recipe().program(), by)
}

fn routine() -> (&'static str, OptionValue) {
    ("change_routine", OptionValue::Text("CellTool".to_owned()))
}

/// What is found of a program in whose text something is replaced.
fn edited(by: Changer, edit: impl Fn(&str) -> String) -> DivergenceKind {
    let (program, options) = (reachable(program(by)), options(&[routine()]));
    let mut files = program_files(&emit_with(&program, &options));
    for file in &mut files {
        file.text = edit(&file.text);
    }
    replayed(&program, &options, &files).unwrap_err().what
}

#[test]
fn a_routine_of_the_cell_changes_the_blade() {
    let options = options(&[routine()]);
    let bundle = emit_with(&reachable(program(Changer::Program)), &options);
    let lines = lines(&bundle, "two.mod");
    let place = lines.iter().position(|line| line == "    CellTool 2;").unwrap();
    assert_eq!(
        lines[place - 1],
        "    MoveAbsJ vc_change\\NoEOffs,vc_axes,fine,vc_tool\\WObj:=vc_wobj;"
    );
    assert_eq!(
        lines[place + 1..place + 4],
        ["    ConfJ\\On;", "    ConfL\\On;", "    SingArea\\Off;"]
    );
    assert!(
        lines[place + 5].ends_with(",vc_tool2\\WObj:=vc_wobj;"),
        "{}",
        lines[place + 5]
    );
    // The routine may leave other modes.
    for mode in ["ConfJ\\On;", "ConfL\\On;", "SingArea\\Off;"] {
        edited(Changer::Program, |text| {
            let parts = text.rsplit_once(mode);
            parts.map_or_else(|| text.to_owned(), |(before, after)| format!("{before}{after}"))
        });
    }
    let declared = |name: &str| lines.iter().any(|line| line.trim_start().starts_with(name));
    assert!(declared("PERS tooldata vc_tool:=[TRUE,[["));
    assert!(declared("PERS tooldata vc_tool2:=[TRUE,[[1.000,2.000,250.000],"));
    assert!(declared("CONST jointtarget vc_change:=[["));
}

#[test]
fn a_person_changes_the_blade() {
    let bundle = emit_with(&reachable(program(Changer::Hand)), &options(&[]));
    let lines = lines(&bundle, "two.mod");
    let place = lines.iter().position(|line| line == "    Stop;").unwrap();
    assert_eq!(lines[place - 1], "    TPWrite \"Put in blade short\";");
}

#[test]
fn both_are_read_back() {
    let kept = Recipe {
        cell: CellRecipe {
            tool: crate::support::numbered(3),
            load: None,
            ..cell()
        },
        ..recipe()
    };
    for recipe in [recipe(), kept] {
        for by in [Changer::Program, Changer::Hand] {
            let program = reachable(two_blades(recipe.program(), by));
            for limit in [0, 1, 40] {
                let options = options(&[routine(), (LINES_PER_PART, OptionValue::Integer(limit))]);
                let files = program_files(&emit_with(&program, &options));
                let places = replayed(&program, &options, &files).unwrap();
                assert_eq!(places.len(), program.program().ops.len());
            }
        }
    }
}

#[test]
fn what_is_changed_in_a_change_is_found() {
    let without = |text: &str, line: &str| {
        let kept = text.lines().filter(|found| found.trim() != line);
        kept.collect::<Vec<_>>().join("\r\n") + "\r\n"
    };
    let by_program = |from: &str, to: &str| edited(Changer::Program, |text| text.replace(from, to));
    let tool = DivergenceKind::Frame(FrameRole::Tool);
    assert_eq!(
        edited(Changer::Program, |text| without(text, "CellTool 2;")),
        tool
    );
    assert_eq!(edited(Changer::Hand, |text| without(text, "Stop;")), tool);
    assert!(matches!(
        by_program("CellTool 2;", "CellTool 1;"),
        DivergenceKind::Differs(_)
    ));
    assert!(matches!(
        by_program("MoveAbsJ vc_change", "MoveAbsJ vc_home"),
        DivergenceKind::Differs(_)
    ));
    for (from, to) in [
        ("CellTool 2;", "OtherTool 2;"),
        ("CellTool 2;", "CellTool 7;"),
        ("vc_tool2:=[TRUE,[[1.000", "vc_tool2:=[TRUE,[[1.100"),
        ("],[2.5,[", "],[2.6,["),
    ] {
        assert_eq!(by_program(from, to), DivergenceKind::NotUnderstood, "{to}");
    }
    for by in [Changer::Program, Changer::Hand] {
        // The tool of the first blade stays; and the other one is taken before it is there.
        let stays = edited(by, |text| text.replace(",vc_tool2\\", ",vc_tool\\"));
        assert_eq!(stays, tool);
        let early = edited(by, |text| text.replacen(",vc_tool\\", ",vc_tool2\\", 1));
        assert_eq!(early, tool);
    }
}

#[test]
fn names_that_are_missing_or_one_for_two_tools_are_refused() {
    let refused = |values: &[(&str, OptionValue)]| {
        let keys = issues(program(Changer::Program), values)
            .into_iter()
            .map(|issue| match issue {
                BackendIssue::OptionConflict { key, .. } => key,
                other => panic!("{other:?}"),
            });
        keys.collect::<Vec<_>>()
    };
    assert_eq!(refused(&[routine()]), Vec::<&str>::new());
    let named = |name: &str| ("change_routine", OptionValue::Text(name.to_owned()));
    for name in ["", "MoveL", "2nd"] {
        assert_eq!(refused(&[named(name)]), ["change_routine"], "{name}");
    }
    let tool = ("tool_name", OptionValue::Text("tKnife".to_owned()));
    assert!(refused(&[routine(), tool]).contains(&"tool_name"));
}
