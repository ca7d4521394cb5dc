//! Programs that change the blade.

use crate::read_back::replayed;
use crate::support::{DIALECTS, Given, emit, issues, needed, options, reachable, recipe};
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::ir::{Action, Changer, PlacedFrame, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Divergence, ProgramFile, program_files};
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{Recipe, two_blades};

const CHANGERS: [Changer; 2] = [Changer::Program, Changer::Hand];

/// The second tool differs from the first by its number or by its place.
#[derive(Clone, Copy)]
enum Numbers {
    Given,
    Left,
}

fn program(by: Changer, numbers: Numbers) -> Program {
    let recipe = Recipe {
        name: "two".to_owned(),
        operations: 2,
        layers: 1,
        cuts: 1,
        ..recipe()
    };
    let mut program = recipe.program();
    if let (Numbers::Given, Some(cell)) = (numbers, &mut program.cell) {
        let mut tool = *cell.tools.first();
        tool.frame = PlacedFrame {
            number: Some(4),
            ..tool.frame
        };
        cell.tools = vcutc_backend_api::ir::Tools::one(tool);
    }
    two_blades(program, by)
}

fn files(program: &ReachableProgram, dialect: &'static str, more: &[Given]) -> Vec<ProgramFile> {
    program_files(&emit(program, dialect, more))
}

fn read(
    program: &ReachableProgram,
    dialect: &'static str,
    files: &[ProgramFile],
) -> Result<usize, Divergence> {
    let places = replayed(program, files, &options(&needed(dialect))).0;
    places.map(|places| places.len())
}

/// The blocks from the comment about the blade to the first motion of the tip.
fn change(dialect: &'static str, by: Changer, numbers: Numbers) -> Vec<String> {
    let files = files(&reachable(program(by, numbers)), dialect, &[]);
    let lines = files[0].text.lines().map(without_number);
    let asks = |line: &str| line.contains("put in blade") || line.contains("change to blade");
    let mut lines = lines.skip_while(|line| !asks(&line.to_lowercase()));
    lines.by_ref().skip(1).take(16).collect()
}

/// Heidenhain's lines have numbers.
fn without_number(line: &str) -> String {
    let after = line.trim_start_matches(|c: char| c.is_ascii_digit());
    after.trim_start().to_owned()
}

#[test]
fn each_dialect_says_it_in_its_words() {
    for (dialect, by, word, length) in [
        ("linuxcnc", Changer::Program, "T2 M6", "G43 H5"),
        ("linuxcnc", Changer::Hand, "M0", "G43 H5"),
        ("fanuc", Changer::Program, "T2 M6", "G43.4 H5"),
        ("fanuc", Changer::Hand, "M0", "G43.4 H5"),
        ("sinumerik", Changer::Program, "T2 M6", "D5"),
        ("sinumerik", Changer::Hand, "M0", "D5"),
        ("heidenhain", Changer::Program, "TOOL CALL 5 Z", "FUNCTION TCPM"),
        ("heidenhain", Changer::Hand, "TOOL CALL 5 Z", "FUNCTION TCPM"),
    ] {
        let lines = change(dialect, by, Numbers::Given);
        assert_eq!(lines[0], word, "{dialect} {by:?}");
        assert!(
            lines[1..].iter().any(|line| line.starts_with(length)),
            "{dialect} {by:?}: {lines:#?}"
        );
        // A macro or a person may leave other modes.
        let restated = lines[1..].iter().any(|line| line.contains("G90"));
        assert_eq!(restated, dialect != "heidenhain", "{dialect} {by:?}: {lines:#?}");
    }
}

#[test]
fn tools_without_numbers_have_those_of_their_places() {
    for (dialect, length) in [
        ("linuxcnc", "G43 H2"),
        ("fanuc", "G43.4 H2"),
        // The edge of the tool that `T2` has called.
        ("sinumerik", "D1"),
        ("heidenhain", "TOOL CALL 2 Z"),
    ] {
        let lines = change(dialect, Changer::Program, Numbers::Left);
        assert!(
            lines.iter().any(|line| line.starts_with(length)),
            "{dialect}: {lines:#?}"
        );
    }
}

#[test]
fn all_of_them_are_read_back() {
    for dialect in DIALECTS {
        for by in CHANGERS {
            for limit in [0, 1, 40] {
                let program = reachable(program(by, Numbers::Given));
                let files = files(
                    &program,
                    dialect,
                    &[(LINES_PER_PART, OptionValue::Integer(limit))],
                );
                let read = read(&program, dialect, &files);
                assert_eq!(read, Ok(program.program().ops.len()), "{dialect} {by:?} {limit}");
            }
        }
        let program = reachable(program(Changer::Program, Numbers::Left));
        let read = read(&program, dialect, &files(&program, dialect, &[]));
        assert_eq!(read, Ok(program.program().ops.len()), "{dialect} without numbers");
    }
}

/// What changes blades may move axes, so the next motion of all axes is as slow as from anywhere.
#[test]
fn the_way_from_a_change_is_taken_to_begin_anywhere() {
    let program = reachable(program(Changer::Program, Numbers::Given));
    let files = files(&program, "linuxcnc", &[]);
    let moves: Vec<f64> = files[0]
        .text
        .lines()
        .filter(|line| line.starts_with("G53 G1"))
        .map(|line| line.rsplit_once('F').unwrap().1.parse().unwrap())
        .collect();
    let change = program
        .program()
        .ops
        .iter()
        .filter(|op| {
            matches!(
                op.action,
                Action::Home | Action::AxisTravel { .. } | Action::ChangePlace
            )
        })
        .position(|op| op.action == Action::ChangePlace)
        .unwrap();
    // In inverse time the longest way of any axis has the lowest F.
    assert_eq!(moves[change + 1], moves[0]);
    assert!(moves[change] > moves[0]);
}

#[test]
fn what_is_changed_in_a_change_is_found() {
    for dialect in DIALECTS {
        for by in CHANGERS {
            let program = reachable(program(by, Numbers::Given));
            let files = files(&program, dialect, &[]);
            let text = &files[0].text;
            let word = change(dialect, by, Numbers::Given)[0].clone();
            let line = text.lines().find(|line| without_number(line) == word).unwrap();
            let edited = |text: String| {
                let mut edited = files.clone();
                edited[0].text = text;
                read(&program, dialect, &edited)
            };
            let twice = format!("{line}\n{line}");
            let mut wrong = vec![
                text.replacen(&format!("{line}\n"), "", 1),
                text.replacen(line, &twice, 1),
            ];
            if by == Changer::Program {
                wrong.extend(
                    [
                        "T1 M6",
                        "T3 M6",
                        "M6",
                        "T2",
                        "M0",
                        "TOOL CALL 6 Z",
                        "TOOL CALL 4 Z",
                    ]
                    .map(|other| text.replacen(line, &line.replace(&word, other), 1)),
                );
            }
            if dialect != "heidenhain" {
                let start = text.rfind("G17 ").unwrap();
                let (before, rest) = text.split_at(start);
                wrong.push(format!("{before}{}", rest.split_once('\n').unwrap().1));
            }
            for (length, other) in [("H5", "H4"), ("D5", "D4")] {
                if text.contains(length) {
                    wrong.push(text.replace(length, other));
                }
            }
            for (edit, text) in wrong.into_iter().enumerate() {
                // Heidenhain's call of the tool in the spindle changes nothing.
                let is_heidenhain = dialect == "heidenhain" && text.contains(&twice);
                assert!(
                    edited(text.clone()).is_err() != is_heidenhain,
                    "{dialect} {by:?} {edit}\n{text}"
                );
            }
        }
    }
}

#[test]
fn two_tools_of_one_number_are_refused() {
    let mut program = program(Changer::Hand, Numbers::Left);
    if let Some(cell) = &mut program.cell {
        let mut tools = cell.tools.iter().map(|(_, tool)| *tool);
        let unplaced = tools.next().into_iter().chain(tools).map(|mut tool| {
            tool.place = None;
            tool
        });
        let [first, second]: [_; 2] = unplaced.collect::<Vec<_>>().try_into().unwrap();
        cell.tools = vcutc_backend_api::ir::Tools::one(first).and(second);
    }
    for dialect in DIALECTS {
        let issues = issues(program.clone(), &needed(dialect));
        assert!(
            matches!(
                issues.as_slice(),
                [BackendIssue::OptionConflict {
                    key: "tool_number",
                    ..
                }]
            ),
            "{dialect}: {issues:?}"
        );
    }
}
