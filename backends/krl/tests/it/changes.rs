//! Programs that change the blade.

use crate::read_back::{replayed, statements};
use crate::support::{emit, issues, lines, options, reachable};
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{Action, Changer, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Divergence, DivergenceKind, FrameRole, ProgramFile, program_files};
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{Recipe, two_blades};

fn program(by: Changer) -> Program {
    let recipe = Recipe {
        name: "two".to_owned(),
        operations: 2,
        layers: 1,
        cuts: 1,
        ..Recipe::default()
    };
    two_blades(recipe.program(), by)
}

fn routine() -> (&'static str, OptionValue) {
    ("change_routine", OptionValue::Text("CELL_TOOL".to_owned()))
}

/// The lines of the change, from the end of the first operation to the first way of the second.
fn change(bundle: &Bundle) -> Vec<String> {
    let lines = lines(bundle, "two.src");
    let start = lines.iter().position(|line| line == "PTP XVC_CHANGE").unwrap();
    lines.into_iter().skip(start).take(20).collect()
}

fn read(files: &[ProgramFile], program: &ReachableProgram) -> Result<usize, Divergence> {
    let options = options(&[routine()]);
    replayed(&statements(files, program, &options), program, &options).map(|places| places.len())
}

/// What is found of a program in whose text something is replaced.
fn edited(by: Changer, edit: impl Fn(&str) -> String) -> DivergenceKind {
    let program = reachable(program(by));
    let mut files = program_files(&emit(&program, &[routine()]));
    for file in &mut files {
        file.text = edit(&file.text);
    }
    read(&files, &program).unwrap_err().what
}

#[test]
fn a_routine_of_the_cell_changes_the_blade() {
    let bundle = emit(&reachable(program(Changer::Program)), &[routine()]);
    let expected = [
        "PTP XVC_CHANGE",
        "CELL_TOOL(2)",
        ";FOLD SETUP",
        "$TOOL={X 1.000,Y 2.000,Z 250.000,A 0.0000,B 0.0000,C 0.0000}",
        "$BASE={X 1800.000,Y -25.000,Z 700.000,A 0.0000,B 0.0000,C 90.0000}",
        "$LOAD={M 2.5,CM {X 0.000,Y 0.000,Z 80.000,A 0.0,B 0.0,C 0.0},J {X 0.012,Y 0.0115,Z 0.004}}",
    ];
    let found = change(&bundle);
    assert_eq!(found[..6], expected);
    let speeds = found
        .iter()
        .position(|line| line.starts_with("$VEL.ORI1="))
        .unwrap();
    let motion = found.iter().position(|line| line.starts_with("PTP {X ")).unwrap();
    assert!(speeds < motion);
    assert!(found[..motion].contains(&"; operation 2: rough vcut with blade short".to_owned()));
    let data = lines(&bundle, "two.dat");
    assert!(
        data.iter()
            .any(|line| line.starts_with("DECL E6AXIS XVC_CHANGE={A1 "))
    );
}

#[test]
fn a_person_changes_the_blade() {
    let bundle = emit(&reachable(program(Changer::Hand)), &[]);
    assert_eq!(
        change(&bundle)[..3],
        ["PTP XVC_CHANGE", "; put in blade short", "HALT"]
    );
}

#[test]
fn both_are_read_back() {
    for by in [Changer::Program, Changer::Hand] {
        let program = reachable(program(by));
        for limit in [0, 1, 40] {
            let values = [routine(), (LINES_PER_PART, OptionValue::Integer(limit))];
            let files = program_files(&emit(&program, &values));
            assert_eq!(read(&files, &program).unwrap(), program.program().ops.len());
        }
    }
}

#[test]
fn every_part_sets_up_the_blade_that_it_begins_with() {
    let program = reachable(program(Changer::Program));
    let bundle = emit(&program, &[routine(), (LINES_PER_PART, OptionValue::Integer(1))]);
    let mut second = false;
    for (name, text) in bundle.files() {
        let text = String::from_utf8_lossy(text);
        if !(name.contains("_p") && name.ends_with("src")) {
            continue;
        }
        let first = text.lines().find(|line| line.starts_with("$TOOL")).unwrap();
        assert_eq!(first.contains("Z 250.000"), second, "{name}");
        second |= text.contains("CELL_TOOL(2)");
    }
    assert!(second);
}

#[test]
fn what_is_changed_in_a_change_is_found() {
    let without = |text: &str, line: &str| {
        let kept = text.lines().filter(|found| *found != line);
        kept.collect::<Vec<_>>().join("\r\n") + "\r\n"
    };
    let by_program = |from: &str, to: &str| edited(Changer::Program, |text| text.replace(from, to));
    assert_eq!(
        edited(Changer::Program, |text| without(text, "CELL_TOOL(2)")),
        DivergenceKind::Frame(FrameRole::Tool)
    );
    assert!(matches!(
        by_program("CELL_TOOL(2)", "CELL_TOOL(1)"),
        DivergenceKind::Differs(_)
    ));
    assert!(matches!(
        by_program("PTP XVC_CHANGE", "PTP XVC_HOME"),
        DivergenceKind::Differs(_)
    ));
    assert_eq!(
        by_program("$TOOL={X 1.000", "$TOOL={X 1.100"),
        DivergenceKind::Frame(FrameRole::Tool)
    );
    assert_eq!(
        by_program("$LOAD={M 2.5", "$LOAD={M 2.6"),
        DivergenceKind::NotUnderstood
    );
    assert_eq!(
        by_program("CELL_TOOL(2)", "OTHER_TOOL(2)"),
        DivergenceKind::NotUnderstood
    );
    assert_eq!(
        edited(Changer::Hand, |text| without(text, "HALT")),
        DivergenceKind::Frame(FrameRole::Tool)
    );
    // The last one: the tool of the blade that was put in.
    let frame = |text: &str| {
        text.lines()
            .rfind(|line| line.starts_with("$TOOL"))
            .map(str::to_owned)
    };
    for by in [Changer::Program, Changer::Hand] {
        let found = edited(by, |text| match frame(text) {
            Some(line) => without(text, &line),
            None => text.to_owned(),
        });
        assert!(
            matches!(
                found,
                DivergenceKind::NoFrame(FrameRole::Tool) | DivergenceKind::NotUnderstood
            ),
            "{found:?}"
        );
    }
}

#[test]
fn a_routine_without_a_name_is_refused() {
    let refused = |values: &[(&str, OptionValue)]| issues(program(Changer::Program), values);
    assert_eq!(refused(&[routine()]), []);
    for name in ["", "2nd", "HALT", "a-b"] {
        let values = [("change_routine", OptionValue::Text(name.to_owned()))];
        assert!(
            matches!(
                refused(&values).as_slice(),
                [BackendIssue::OptionConflict {
                    key: "change_routine",
                    ..
                }]
            ),
            "{name}"
        );
    }
    assert_eq!(issues(program(Changer::Hand), &[]), []);
}

#[test]
fn a_program_without_a_change_says_nothing_of_one() {
    let plain = reachable(Recipe::default().program());
    assert!(
        !plain
            .program()
            .ops
            .iter()
            .any(|op| op.action == Action::ChangePlace)
    );
    for (_, text) in emit(&plain, &[routine()]).files() {
        let text = String::from_utf8_lossy(text);
        assert!(!text.contains("CHANGE") && !text.contains("CELL_TOOL"));
    }
}
