//! What is refused, in the order of the options, the machine and the ops.

use crate::support::{DIALECTS, Given, block, issues, issues_with, needed, recipe, rounds};
use vcutc_backend_api::backend::{BackendIssue, MachineMismatch, OptionValue};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Axis, PlacedFrame, Program, Ready};
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::testkit::{CellRecipe, Recipe};
use vcutc_backend_api::units::{AngularSpeed, Duration, Length, Speed};

fn with(dialect: &'static str, more: &[Given]) -> Vec<Given> {
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    given
}

/// What the issues are about, in a few words each.
fn subjects(issues: &[BackendIssue]) -> Vec<&str> {
    issues
        .iter()
        .map(|issue| match issue {
            BackendIssue::WrongMachine { .. } => "machine",
            BackendIssue::MissingMachineField { field, .. } => field,
            BackendIssue::OptionConflict { key, .. } | BackendIssue::Profile { key, .. } => key,
            BackendIssue::Unsupported { what, .. } | BackendIssue::OutOfRange { what, .. } => what,
            BackendIssue::Failed(_) => "fault",
        })
        .collect()
}

fn cell(recipe: CellRecipe) -> Program {
    Recipe {
        cell: recipe,
        ..Recipe::default()
    }
    .program()
}

#[test]
fn nothing_is_refused_that_can_be_said() {
    for dialect in DIALECTS {
        assert_eq!(issues(recipe().program(), &needed(dialect)), [], "{dialect}");
    }
}

#[test]
fn robots() {
    let found = issues(Recipe::default().program(), &needed("fanuc"));
    assert!(
        matches!(
            found.as_slice(),
            [BackendIssue::WrongMachine {
                mismatch: MachineMismatch::Kind,
                ..
            }]
        ),
        "{found:?}"
    );
}

#[test]
fn codes_that_only_the_builder_knows() {
    let alone = |dialect| vec![("dialect", OptionValue::Choice(dialect))];
    for (dialect, should) in [
        ("linuxcnc", vec!["tcp_on", "tcp_off"]),
        ("fanuc", vec!["on_code", "off_code"]),
        ("sinumerik", vec![]),
        ("heidenhain", vec!["on_code", "off_code"]),
    ] {
        let found = issues(recipe().program(), &alone(dialect));
        assert_eq!(subjects(&found), should, "{dialect}");
    }
    let waits = || {
        cell(CellRecipe {
            ready: Ready::Input(7),
            ..CellRecipe::five_axis()
        })
    };
    for (dialect, should) in [
        ("linuxcnc", vec![]),
        ("fanuc", vec!["ready_code"]),
        ("sinumerik", vec![]),
        ("heidenhain", vec![]),
    ] {
        assert_eq!(subjects(&issues(waits(), &needed(dialect))), should, "{dialect}");
        let given = with(dialect, &[("ready_code", block("M152"))]);
        assert_eq!(issues(waits(), &given), [], "{dialect}");
        // This machine is ready after a time.
        assert_eq!(
            subjects(&issues(recipe().program(), &given)),
            ["ready_code"],
            "{dialect}"
        );
    }
}

#[test]
fn codes_that_have_no_use_or_half_of_one() {
    for dialect in ["fanuc", "sinumerik", "heidenhain"] {
        let given = with(dialect, &[("tcp_on", block("M429"))]);
        assert_eq!(
            subjects(&issues(recipe().program(), &given)),
            ["tcp_on"],
            "{dialect}"
        );
    }
    let half = with("linuxcnc", &[("on_code", block("M101"))]);
    assert_eq!(subjects(&issues(recipe().program(), &half)), ["off_code"]);
}

#[test]
fn codes_that_are_not_a_block() {
    for text in ["", "   ", "M50\nG0 X0", "M\u{fc}", &"M50 ".repeat(40)] {
        let given = with("heidenhain", &[("on_code", block(text))]);
        assert_eq!(
            subjects(&issues(recipe().program(), &given)),
            ["on_code"],
            "{text:?}"
        );
    }
    let two = OptionValue::Lines(vec!["M50".to_owned(), "M51".to_owned()]);
    assert_eq!(
        subjects(&issues(recipe().program(), &with("fanuc", &[("on_code", two)]))),
        ["on_code"]
    );
}

/// Why the option of that name is refused, the only one that is.
fn refused(dialect: &'static str, key: &'static str, texts: &[&str]) -> Option<String> {
    let ready = cell(CellRecipe {
        ready: Ready::Input(7),
        ..CellRecipe::five_axis()
    });
    let lines = texts.iter().map(|&text| text.to_owned()).collect();
    let mut given = vec![
        ("ready_code", block("M152")),
        ("on_code", block("M150")),
        ("off_code", block("M151")),
    ];
    let needed = needed(dialect);
    given.retain(|(key, _)| needed.iter().all(|(other, _)| key != other));
    given.extend(needed);
    given.retain(|(other, _)| *other != key);
    given.push((key, OptionValue::Lines(lines)));
    match issues(ready, &given).as_slice() {
        [] => None,
        [BackendIssue::OptionConflict { key: about, why }] if *about == key => Some(why.clone()),
        more => panic!("{dialect} {key} {texts:?}: {more:?}"),
    }
}

/// The options that a dialect takes.
fn options_of(dialect: &str) -> &'static [&'static str] {
    match dialect {
        "linuxcnc" => &["tcp_on", "tcp_off", "on_code", "off_code", "ready_code"],
        _ => &["on_code", "off_code", "ready_code"],
    }
}

#[test]
fn codes_that_could_do_more_than_switch() {
    for dialect in DIALECTS {
        for key in options_of(dialect) {
            for text in [
                "G0 Z-100",
                "G91 M50",
                "M50 G91",
                "G0 X5",
                "L X+0 M91",
                "L X+0",
                "/M50",
                "(M50)",
                "M429 (x",
                "M429 (x)",
                "M50 ; on",
                "M50 M60",
                "M50.1",
                "M50 X1",
                "M50 F1",
                "N10 M50",
                "M1=50",
                "M#1",
                "S100",
                "%",
                "O100",
                "o<x> call",
                "CALL PGM X",
                "TRAFOOF",
                "US_ON",
                "$A_OUT[3]=1",
            ] {
                let why = refused(dialect, key, &[text]).unwrap_or_default();
                assert!(why.contains("not one M code"), "{dialect} {key} {text}: {why}");
            }
            for text in ["M0", "M00", "M01", "M2", "M30", "M6", "M06", "M19", "M98", "M99"] {
                let why = refused(dialect, key, &[text]).unwrap_or_default();
                assert!(why.contains(" on "), "{dialect} {key} {text}: {why}");
            }
            for text in ["M250", "m0250", " M 250 "] {
                assert_eq!(refused(dialect, key, &[text]), None, "{dialect} {key} {text}");
            }
        }
    }
}

#[test]
fn codes_and_words_that_a_dialect_has_for_itself() {
    for (dialect, fits, does_not) in [
        (
            "linuxcnc",
            vec!["M101 P1 Q2", "M68 E3 Q1", "M3 S1000"],
            vec!["M62 P3", "M50", "M60", "M72", "M64 P3", "M66 P3 L3", "M101 H1"],
        ),
        (
            "fanuc",
            vec!["M101 P1", "M3 S1000"],
            vec!["M198 P1", "M96 P1", "M50 H2"],
        ),
        ("sinumerik", vec!["M101 H5"], vec!["M17", "M70", "M101 P2"]),
        (
            "heidenhain",
            vec!["M36", "M250"],
            vec!["M89", "M91", "M127", "M128", "M140", "M3 S1000"],
        ),
    ] {
        for text in fits {
            assert_eq!(refused(dialect, "on_code", &[text]), None, "{dialect} {text}");
        }
        for text in does_not {
            assert!(refused(dialect, "on_code", &[text]).is_some(), "{dialect} {text}");
        }
    }
    // The sample configurations switch the kinematics so.
    let samples = ["M68 E3 Q1", "M66 E0 L0"];
    assert_eq!(refused("linuxcnc", "tcp_on", &samples), None);
}

#[test]
fn codes_that_cannot_be_distinguished() {
    for dialect in DIALECTS {
        let [on, off] = match dialect {
            "fanuc" | "heidenhain" => ["M50", "M051"],
            _ => ["M150", "M0151"],
        };
        for (key, text) in [("off_code", on), ("ready_code", on), ("ready_code", off)] {
            let why = refused(dialect, key, &[text]).unwrap_or_default();
            assert!(why.contains("have to differ"), "{dialect} {key} {text}: {why}");
        }
    }
    let same = refused("linuxcnc", "tcp_off", &["M429"]).unwrap_or_default();
    assert!(same.contains("`tcp_on` as well"), "{same}");
    let longer = refused("linuxcnc", "tcp_off", &["M427", "M429"]);
    assert!(longer.is_some());
    let generator = refused("linuxcnc", "on_code", &["M428"]).unwrap_or_default();
    assert!(generator.contains("`tcp_off` as well"), "{generator}");

    let shared = |line: &str| OptionValue::Lines(vec![line.to_owned(), "M66 E0 L0".to_owned()]);
    let given = [("tcp_on", shared("M68 E3 Q1")), ("tcp_off", shared("M68 E3 Q0"))];
    assert_eq!(issues(recipe().program(), &with("linuxcnc", &given)), []);

    // The program switches output 12 by this.
    let own = with("linuxcnc", &[("tcp_on", block("M64 p012"))]);
    assert_eq!(subjects(&issues(recipe().program(), &own)), ["tcp_on"]);
}

/// What messages offer is taken.
#[test]
fn codes_that_are_offered() {
    for dialect in DIALECTS {
        for key in options_of(dialect) {
            let why = refused(dialect, key, &["G0 X5"]).unwrap_or_default();
            let code = why.split('`').nth(3).unwrap_or_default();
            assert_eq!(refused(dialect, key, &[code]), None, "{dialect} {key}: {why}");
        }
    }
}

#[test]
fn rounding_and_decimals_that_a_dialect_lacks() {
    for dialect in DIALECTS {
        let given = with(
            dialect,
            &[("approximation", OptionValue::Length(Length::mm(1.0)))],
        );
        let found = issues(recipe().program(), &given);
        assert_eq!(
            subjects(&found).contains(&"approximation"),
            !rounds(dialect),
            "{dialect}"
        );
    }
    for (dialect, decimals, fits) in [
        ("fanuc", 4, true),
        ("fanuc", 5, false),
        ("heidenhain", 5, false),
        ("linuxcnc", 6, true),
    ] {
        let given = with(dialect, &[("decimals", OptionValue::Integer(decimals))]);
        let found = issues(recipe().program(), &given);
        assert_eq!(found.is_empty(), fits, "{dialect} {decimals}: {found:?}");
    }
}

/// `G53 G0` is rapid: no option says how fast.
#[test]
fn a_speed_of_moves_of_all_axes_that_a_dialect_cannot_say() {
    for dialect in DIALECTS {
        let given = with(dialect, &[("home_speed", OptionValue::Integer(30))]);
        let found = issues(recipe().program(), &given);
        let should: &[&str] = if dialect == "fanuc" { &["home_speed"] } else { &[] };
        assert_eq!(subjects(&found), should, "{dialect}");
    }
}

#[test]
fn profiles_that_a_dialect_cannot_follow() {
    let refused = |dialect, profile| {
        let found = issues_with(recipe().program(), &needed(dialect), profile);
        let of_profile = |issue: &BackendIssue| matches!(issue, BackendIssue::Profile { .. });
        assert!(found.iter().all(of_profile), "{found:?}");
        subjects(&found).join(" ")
    };
    let numbers = |start, step| Profile {
        line_numbers: Some(LineNumbers { start, step }),
        ..Profile::default()
    };
    assert_eq!(refused("heidenhain", numbers(0, 1)), "line_numbers");
    assert_eq!(refused("fanuc", numbers(10, 0)), "line_numbers");
    assert_eq!(refused("fanuc", numbers(100_000, 1)), "line_numbers");
    assert_eq!(refused("fanuc", numbers(0, 10)), "");
    let profile = Profile {
        header: vec!["M8\nM3".to_owned()],
        footer: vec!["x".repeat(300)],
        extension: Some("../nc".to_owned()),
        ..Profile::default()
    };
    assert_eq!(refused("fanuc", profile), "header footer extension");
}

#[test]
fn machines_that_lack_something() {
    let mut program = recipe().program();
    let cell = program.cell.as_mut().unwrap();
    cell.axes[3].rate = None;
    assert_eq!(
        subjects(&issues(program.clone(), &needed("linuxcnc"))),
        ["home_speed"]
    );
    assert_eq!(issues(program, &needed("fanuc")), []);

    let silent = cell_without_generator();
    assert_eq!(subjects(&issues(silent, &needed("sinumerik"))), ["ultrasonic"]);

    let mut homeless = recipe().program();
    homeless.cell.as_mut().unwrap().home = None;
    homeless.ops.retain(|op| !matches!(op.action, Action::Home));
    assert_eq!(subjects(&issues(homeless, &needed("sinumerik"))), ["home"]);
}

/// A program without any cut, since no program cuts with a silent blade.
fn cell_without_generator() -> Program {
    Recipe {
        layers: 0,
        cell: CellRecipe {
            ultrasonic: None,
            ..CellRecipe::five_axis()
        },
        ..Recipe::default()
    }
    .program()
}

#[test]
fn spindles_without_a_letter() {
    let spindle = |given: &[Given]| {
        let mut program = recipe().program();
        let cell = program.cell.as_mut().unwrap();
        cell.axes.push(Axis {
            name: "S".to_owned(),
            ..cell.axes[4].clone()
        });
        issues(program, given)
    };
    let given = |letter| with("sinumerik", &[("spindle_axis", OptionValue::Choice(letter))]);
    assert_eq!(subjects(&spindle(&needed("sinumerik"))), ["spindle_axis"]);
    assert_eq!(subjects(&spindle(&given("a"))), ["spindle_axis"]);
    assert_eq!(spindle(&given("c")), []);
}

#[test]
fn tools_beside_the_spindle_and_numbers_beyond_the_tables() {
    let tool = |x, y, number| {
        let five_axis = CellRecipe::five_axis();
        let mut tool = five_axis.tool;
        tool.frame.origin = Point3::new(x, y, 310.0);
        cell(CellRecipe {
            tool: PlacedFrame { number, ..tool },
            ..five_axis
        })
    };
    assert_eq!(issues(tool(0.0004, 0.0, None), &needed("fanuc")), []);
    let found = issues(tool(0.25, -3.0, Some(1000)), &needed("fanuc"));
    assert_eq!(subjects(&found), ["tool number", "tool X", "tool Y"]);
    assert!(
        matches!(&found[1], BackendIssue::OutOfRange { value, allowed, .. }
            if value == "0.25 mm" && allowed == "-0.0005 to 0.0005 mm"),
        "{found:?}"
    );
    let found = issues(tool(0.0, 0.0, Some(10)), &needed("sinumerik"));
    assert!(
        matches!(found.as_slice(), [BackendIssue::OutOfRange { what, allowed, .. }]
            if what.starts_with("D number") && allowed == "1 to 9"),
        "{found:?}"
    );
    assert_eq!(issues(tool(0.0, 0.0, Some(9)), &needed("sinumerik")), []);
    for (dialect, last) in [("linuxcnc", 9), ("fanuc", 54), ("sinumerik", 99)] {
        let base = |number| {
            let five_axis = CellRecipe::five_axis();
            let base = PlacedFrame {
                number: Some(number),
                ..five_axis.base
            };
            cell(CellRecipe { base, ..five_axis })
        };
        assert_eq!(issues(base(last), &needed(dialect)), [], "{dialect}");
        assert_eq!(
            subjects(&issues(base(last + 1), &needed(dialect))),
            ["base number"]
        );
    }
}

#[test]
fn signals_beyond_the_control() {
    let signals = |output, input| {
        cell(CellRecipe {
            ultrasonic: Some(output),
            ready: Ready::Input(input),
            ..CellRecipe::five_axis()
        })
    };
    assert_eq!(issues(signals(63, 63), &needed("linuxcnc")), []);
    assert_eq!(
        subjects(&issues(signals(64, 64), &needed("linuxcnc"))),
        ["output number", "input number"]
    );
    let own = [
        ("on_code", block("M101")),
        ("off_code", block("M102")),
        ("ready_code", block("M103")),
    ];
    assert_eq!(issues(signals(64, 64), &with("linuxcnc", &own)), []);
}

#[test]
fn speeds_and_times_that_cannot_be_said() {
    let slow = Recipe {
        cut_feed: Speed::mm_per_s(0.0005),
        ..recipe()
    };
    assert_eq!(subjects(&issues(slow.program(), &needed("fanuc"))), ["tip speed"]);
    assert_eq!(issues(slow.program(), &needed("linuxcnc")), []);
    let fast = Recipe {
        travel_feed: Speed::mm_per_s(1700.0),
        ..recipe()
    };
    assert_eq!(
        subjects(&issues(fast.program(), &needed("heidenhain"))),
        ["tip speed"]
    );
    let creeping = Recipe {
        rate: AngularSpeed::deg_per_s(0.001),
        ..recipe()
    };
    assert_eq!(
        subjects(&issues(creeping.program(), &needed("fanuc"))),
        ["reorientation rate", "tip speed"]
    );
    let patient = Recipe {
        dwell: Some(Duration::s(86_401.0)),
        ..recipe()
    };
    assert_eq!(
        subjects(&issues(patient.program(), &needed("fanuc"))),
        ["waiting time"]
    );
}

#[test]
fn coordinates_beyond_the_digits() {
    let far = |width| {
        let mut recipe = recipe();
        recipe.stock.width = Length::mm(2.0 * width);
        recipe.step = Length::mm(width);
        recipe.layers = 1;
        recipe.cuts = 1;
        recipe.program()
    };
    let fine = with("fanuc", &[("decimals", OptionValue::Integer(4))]);
    assert_eq!(issues(far(9_000.0), &fine), []);
    let found = issues(far(40_000.0), &fine);
    assert!(subjects(&found).contains(&"X"), "{found:?}");
    assert_eq!(issues(far(40_000.0), &needed("fanuc")), []);
}

#[test]
fn numbers_of_programs_that_are_the_builders() {
    let number = |number| {
        let given = with("fanuc", &[("program_number", OptionValue::Integer(number))]);
        subjects(&issues(recipe().program(), &given)).join(" ")
    };
    assert_eq!(number(7998), "");
    assert_eq!(number(7999), "program_number");
    let elsewhere = with("linuxcnc", &[("program_number", OptionValue::Integer(9999))]);
    assert_eq!(issues(recipe().program(), &elsewhere), []);
}
