//! What every program of a dialect keeps to, over all samples and over random programs.

use crate::chains;
use crate::support::{
    DIALECTS, Given, block as given_block, emit, emit_with, needed, options, reachable, recipe, rounds,
};
use crate::words::{Block, Vocabulary, block};
use proptest::prelude::*;
use std::collections::BTreeMap;
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{Action, Axis, AxisKind, Edges, OpId, PlacedFrame, Ready};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::testkit::{CellRecipe, Crossing, Passes, Recipe, conformance_with, five_axis_samples};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_gcode::Gcode;

fn lines(bytes: &[u8]) -> Vec<&str> {
    core::str::from_utf8(bytes).unwrap().lines().collect()
}

/// Blocks of all files in the order in which they are carried out: files lie after their caller in the order
/// of the calls.
fn blocks(bundle: &Bundle, dialect: &str) -> Vec<Block> {
    let files = bundle.files().iter();
    files
        .flat_map(|(_, bytes)| lines(bytes))
        .filter_map(|line| block(line, dialect))
        .collect()
}

/// Option sets that change the text most.
fn sets(dialect: &str) -> Vec<Vec<Given>> {
    let mut sets = vec![
        vec![],
        vec![
            ("lines_per_part", OptionValue::Integer(6)),
            (
                "header",
                OptionValue::Lines(vec!["Ä (1,5) ; \u{7f} %".repeat(30)]),
            ),
        ],
    ];
    if rounds(dialect) {
        sets.push(vec![
            ("approximation", OptionValue::Length(Length::mm(3.0))),
            ("decimals", OptionValue::Integer(4)),
            ("tool_number", OptionValue::Integer(7)),
        ]);
    }
    sets
}

#[test]
fn the_backend_keeps_the_promises_of_all_backends() {
    let samples = five_axis_samples().unwrap();
    for dialect in DIALECTS {
        let result = conformance_with(&Gcode, &samples, &options(&needed(dialect)));
        assert_eq!(result, Ok(()), "{dialect}");
    }
}

#[test]
fn no_block_has_a_word_that_its_dialect_does_not_know_or_a_letter_twice() {
    for dialect in DIALECTS {
        let vocabulary = Vocabulary::of(dialect);
        let samples = five_axis_samples().unwrap().into_iter();
        for (name, program) in samples.chain(chains::of(dialect).map(|program| ("chain", program))) {
            for set in sets(dialect) {
                for block in blocks(&emit(&program, dialect, &set), dialect) {
                    assert_eq!(vocabulary.breach(&block), None, "{dialect} {name}: {block:?}");
                }
            }
        }
    }
}

#[test]
fn lines_are_short_and_plain() {
    for (dialect, longest) in [
        ("linuxcnc", 255),
        ("fanuc", 127),
        ("sinumerik", 255),
        ("heidenhain", 127),
    ] {
        for (_, program) in five_axis_samples().unwrap() {
            for set in sets(dialect) {
                for (name, bytes) in emit(&program, dialect, &set).files() {
                    assert!(bytes.ends_with(b"\n"), "{name}");
                    for line in lines(bytes) {
                        assert!(line.len() <= longest, "{name}: {line}");
                        assert!(
                            line.bytes().all(|byte| matches!(byte, b' '..=b'~')),
                            "{name}: {line}"
                        );
                        assert_eq!(
                            line.matches('(').count(),
                            line.matches(')').count(),
                            "{name}: {line}"
                        );
                    }
                }
            }
        }
    }
}

/// Only axis moves come with tool-centre-point control off, and only straight moves with it on.
#[test]
fn tip_moves_come_with_tool_centre_point_control_and_axis_moves_without() {
    for dialect in DIALECTS {
        let (on, off) = match dialect {
            "linuxcnc" => ("M429", "M428"),
            "fanuc" => ("G43.4", "G49"),
            "sinumerik" => ("TRAORI", "TRAFOOF"),
            _ => ("FUNCTION TCPM", "FUNCTION RESET TCPM"),
        };
        for (_, program) in five_axis_samples().unwrap() {
            for set in sets(dialect) {
                for (name, bytes) in emit(&program, dialect, &set).files() {
                    let mut tcp = None;
                    for line in lines(bytes) {
                        let machine = ["G53", "SUPA", "M91"].iter().any(|word| line.contains(word));
                        if line.contains(off) {
                            tcp = Some(false);
                        } else if line.contains(on) {
                            tcp = Some(true);
                        } else if machine {
                            assert_eq!(tcp, Some(false), "{name}: {line}");
                        } else if line.contains("G1 ") || line.contains(" L ") {
                            assert_eq!(tcp, Some(true), "{name}: {line}");
                        }
                    }
                    assert_ne!(tcp, Some(true), "{name} ends with it on");
                }
            }
        }
    }
}

/// What F means.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Feed {
    Tip,
    Inverse,
    Rotary,
}

/// A motion as its block says it.
#[derive(Debug)]
struct Moved {
    /// The words are positions of the axes.
    machine: bool,
    said: BTreeMap<char, f64>,
    feed: Option<(Feed, f64)>,
}

/// Follows the blocks as a control would: what F means is what was set last.
fn moves(bundle: &Bundle, dialect: &str) -> Vec<Moved> {
    let mut moves = Vec::new();
    let mut feed = Feed::Tip;
    for (_, bytes) in bundle.files() {
        for line in lines(bytes) {
            if line.contains("F CONT") {
                feed = Feed::Rotary;
            } else if line.contains("F TCP") {
                feed = Feed::Tip;
            }
            let Some(block) = block(line, dialect) else {
                continue;
            };
            if block.has("G93") {
                feed = Feed::Inverse;
            } else if block.has("G94") {
                feed = Feed::Tip;
            }
            let words = "XYZABC".chars();
            let said: BTreeMap<char, f64> = words
                .filter_map(|letter| Some((letter, block.number(letter)?)))
                .collect();
            if !said.is_empty() && !block.has("G4") {
                moves.push(Moved {
                    machine: block.has("G53") || block.has("M91") || line.contains("SUPA"),
                    said,
                    feed: block.number('F').map(|value| (feed, value)),
                });
            }
        }
    }
    moves
}

/// The root of the sum of squares of what some of the words change.
fn way(letters: &str, from: &BTreeMap<char, f64>, to: &BTreeMap<char, f64>) -> f64 {
    let moved = letters
        .chars()
        .filter_map(|letter| Some(to.get(&letter)? - from.get(&letter)?));
    moved.map(|moved| moved * moved).sum::<f64>().sqrt()
}

/// What the words should be at the end of an op: tip positions, or axis positions of a move of all axes.
fn words_at(program: &ReachableProgram, op: OpId, tip: Option<Point3>) -> BTreeMap<char, f64> {
    let cell = program.program().cell.as_ref().unwrap();
    let base = cell.base.frame.orientation.matrix();
    let axes = program.axes_after(op).unwrap();
    let word = |(place, axis): (usize, &Axis)| {
        let value = match (axis.kind, tip) {
            (AxisKind::Linear, Some(Point3 { x, y, z })) => {
                base[place][0] * x + base[place][1] * y + base[place][2] * z
            }
            (AxisKind::Linear, None) => axes.0[place],
            (AxisKind::Rotary, _) => axes.0[place].to_degrees(),
        };
        (axis.name.chars().next().unwrap(), value)
    };
    cell.axes.iter().enumerate().map(word).collect()
}

/// The motions of a program, one by one, against the blocks of one file, read without any knowledge of the writer.
fn compare(program: &ReachableProgram, bundle: &Bundle, dialect: &str, grain: f64) {
    let mut at = BTreeMap::new();
    let mut moves = moves(bundle, dialect).into_iter();
    for segment in program.program().segments() {
        let (id, op) = (segment.id, segment.op);
        let all_axes = match op.action {
            Action::Home | Action::ChangePlace | Action::AxisTravel { .. } => true,
            Action::Travel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Follow { .. }
            | Action::Turn { .. } => false,
            Action::Ultrasonic { .. }
            | Action::Spin { .. }
            | Action::AwaitReady
            | Action::Dwell { .. }
            | Action::ToolChange { .. } => continue,
        };
        let moved = moves.next().unwrap();
        assert_eq!(moved.machine, all_axes, "{dialect} {id:?}");
        let there = segment.end().map(|pose| pose.tip);
        let tip = there.filter(|_| !all_axes);
        let before = at.clone();
        if all_axes {
            at.clear();
        }
        at.extend(moved.said);
        for (letter, should) in words_at(program, id, tip) {
            let is = at[&letter];
            assert!(
                (is - should).abs() <= grain,
                "{dialect} {id:?} {letter} {is} {should}"
            );
        }
        if all_axes {
            // Where the tip is now, for the way of the next motion.
            at = words_at(program, id, there);
            continue;
        }
        let should = segment.line().unwrap().duration().to_s();
        let (feed, value) = moved.feed.unwrap();
        let is = 60.0 / value
            * match feed {
                Feed::Tip => way("XYZ", &before, &at),
                Feed::Inverse => 1.0,
                Feed::Rotary => way("ABC", &before, &at),
            };
        // Ways between printed points are longer or shorter by some units of the last place, and F is printed too.
        let speed = match feed {
            Feed::Tip | Feed::Rotary => value / 60.0,
            Feed::Inverse => f64::INFINITY,
        };
        let tolerance = should * 0.001 / value + 4.0 * grain / speed + 1e-9;
        assert!(
            (is - should).abs() <= tolerance,
            "{dialect} {id:?} {:?}: {is} s, not {should} s",
            op.action
        );
        // F is rounded down: only printed ways may be shorter, never times.
        assert!(
            is >= should * (1.0 - 1e-9) - 4.0 * grain / speed,
            "{dialect} {id:?} {:?}: {is} s, less than {should} s",
            op.action
        );
    }
    assert!(moves.next().is_none(), "{dialect}: more moves than ops");
}

#[test]
fn blocks_say_where_the_program_goes_and_how_long_it_takes() {
    for dialect in DIALECTS {
        for (_, program) in five_axis_samples().unwrap() {
            compare(&program, &emit(&program, dialect, &[]), dialect, 0.000_51);
        }
    }
}

/// In a move of all axes from a known place the slowest axis goes as fast as it may, and from an unknown one none goes faster,
/// wherever the machine stands.
#[test]
fn moves_of_all_axes_keep_to_the_home_speed() {
    let program = reachable(recipe().program());
    let axes = &program.program().cell.as_ref().unwrap().axes;
    let letter = |axis: &Axis| axis.name.chars().next().unwrap();
    let unit = |axis: &Axis| match axis.kind {
        AxisKind::Linear => 1.0,
        AxisKind::Rotary => 1.0_f64.to_degrees(),
    };
    for (dialect, percent) in [("linuxcnc", 10), ("sinumerik", 35), ("heidenhain", 100)] {
        let given = [("home_speed", OptionValue::Integer(percent))];
        let allowed = f64::from(percent) / 100.0;
        let all = moves(&emit(&program, dialect, &given), dialect);
        let machine: Vec<&Moved> = all.iter().filter(|moved| moved.machine).collect();
        let [home, work, _] = machine.as_slice() else {
            panic!("{machine:?}")
        };
        // How much of its rate an axis uses on a way in mm or deg.
        let used = |axis: &Axis, way: f64, seconds: f64| way / seconds / (axis.rate.unwrap() * unit(axis));
        let (_, feed) = work.feed.unwrap();
        let seconds = match dialect {
            "heidenhain" => way("XYZABC", &home.said, &work.said) / feed * 60.0,
            _ => 60.0 / feed,
        };
        let fastest = axes.iter().map(|axis| {
            let way = (work.said[&letter(axis)] - home.said[&letter(axis)]).abs();
            used(axis, way, seconds)
        });
        let fastest = fastest.fold(0.0, f64::max);
        assert!((fastest / allowed - 1.0).abs() < 1e-5, "{dialect}: {fastest}");
        let (_, feed) = home.feed.unwrap();
        for axis in axes {
            let is = match dialect {
                // F is along the way of all axes, so no axis is faster than that.
                "heidenhain" => used(axis, feed / 60.0, 1.0),
                _ => used(axis, (axis.max - axis.min) * unit(axis), 60.0 / feed),
            };
            assert!(is <= allowed * 1.01, "{dialect} {}: {is}", axis.name);
        }
    }
}

fn any_recipe() -> impl Strategy<Value = Recipe> {
    let base = (
        [-2e3..2e3_f64, -2e3..2e3, -500.0..500.0],
        [-180.0..180.0_f64, -10.0..10.0, -10.0..10.0],
    );
    (
        (0..3_u16, 0..3_u32, 0..4_u32),
        (10.0..55.0_f64, 50.0..88.0_f64),
        any::<[bool; 4]>(),
        base,
    )
        .prop_map(
            |((operations, layers, cuts), (swing, rake), flags, (origin, angles))| {
                let [layer_pass, single, by_axes, input] = flags;
                let orientation = Orientation::from_zyx(Zyx {
                    a: Angle::deg(angles[0]),
                    b: Angle::deg(angles[1]),
                    c: Angle::deg(angles[2]),
                });
                let cell = CellRecipe::five_axis();
                Recipe {
                    operations,
                    layers,
                    cuts,
                    swing: Angle::deg(swing),
                    rake: Angle::deg(rake),
                    passes: if layer_pass { Passes::Layer } else { Passes::Point },
                    edges: if single { Edges::Single } else { Edges::Double },
                    crossing: if by_axes {
                        Crossing::ByAxes
                    } else {
                        Crossing::Straight
                    },
                    cell: CellRecipe {
                        base: PlacedFrame {
                            frame: Frame {
                                origin: Point3::new(origin[0], origin[1], origin[2]),
                                orientation,
                            },
                            number: None,
                        },
                        ready: if input { Ready::Input(7) } else { cell.ready },
                        ..cell
                    },
                    ..Recipe::default()
                }
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_program_is_said_in_every_dialect(recipe in any_recipe()) {
        let input = matches!(recipe.cell.ready, Ready::Input(_));
        let program = reachable(recipe.program());
        for dialect in DIALECTS {
            let mut given = Vec::new();
            if input && dialect == "fanuc" {
                given.push(("ready_code", given_block("M52")));
            }
            let bundle = emit(&program, dialect, &given);
            let vocabulary = Vocabulary::of(dialect);
            for block in blocks(&bundle, dialect) {
                prop_assert_eq!(vocabulary.breach(&block), None, "{} {:?}", dialect, block);
            }
            compare(&program, &bundle, dialect, 0.000_51);
        }
    }
}

#[test]
fn a_program_without_any_op_is_still_one() {
    let mut program = recipe().program();
    program.ops.clear();
    let program = reachable(program);
    for dialect in DIALECTS {
        let bundle = emit(&program, dialect, &[]);
        assert_eq!(bundle.files().len(), 1);
        assert!(moves(&bundle, dialect).is_empty());
        assert!(
            blocks(&bundle, dialect)
                .iter()
                .any(|block| block.has("M2") || block.has("M30"))
        );
    }
}

/// Longest name, split one line beyond the limit and not before.
#[test]
fn parts_begin_one_line_beyond_the_limit() {
    let program = reachable(
        Recipe {
            name: "a_very_long_name_of_a_job_that_never_ends".to_owned(),
            ..recipe()
        }
        .program(),
    );
    let ops = u32::try_from(program.program().ops.len()).unwrap();
    // A comment for the operation and for each of six cuts.
    let all = ops + 1 + 6;
    for dialect in DIALECTS {
        let files = |lines| {
            let limit = [("lines_per_part", OptionValue::Integer(lines))];
            let bundle = emit(&program, dialect, &limit);
            let names: Vec<String> = bundle.files().iter().map(|(name, _)| name.clone()).collect();
            names
        };
        assert_eq!(files(all).len(), 1, "{dialect}");
        let parts = files(all - 1);
        assert_eq!(parts.len(), 3, "{dialect}");
        for name in &parts {
            assert!(name.split('.').next().unwrap().len() <= 24, "{name}");
        }
        assert_ne!(parts[1], parts[2]);
    }
}

#[test]
fn a_machine_has_its_habits() {
    let program = reachable(recipe().program());
    let profile = Profile {
        header: vec!["M8".to_owned()],
        footer: vec!["M9".to_owned()],
        extension: Some("tap".to_owned()),
        line_numbers: Some(LineNumbers { start: 10, step: 5 }),
        reserved: vec!["sample".to_owned()],
        ..Profile::default()
    };
    let bundle = emit_with(&program, "linuxcnc", &[], profile);
    let lines = lines(bundle.get("sample_2.tap").unwrap());
    let numbered: Vec<&&str> = lines.iter().filter(|line| line.starts_with('N')).collect();
    for (line, number) in numbered.iter().zip((10..).step_by(5)) {
        assert!(line.starts_with(&format!("N{number} ")), "{line}");
    }
    let at = |word: &str| lines.iter().position(|line| line.ends_with(word)).unwrap();
    assert!(at(" G54") < at(" M8") && at(" M9") + 1 == at("M2"));
    assert!(
        lines[at(" M8") + 2].contains("X0.000 Y0.000 Z900.000"),
        "{}",
        lines[at(" M8") + 2]
    );
}

#[test]
fn numbers_begin_again_after_five_digits() {
    let program = reachable(recipe().program());
    let profile = Profile {
        line_numbers: Some(LineNumbers {
            start: 99_000,
            step: 400,
        }),
        ..Profile::default()
    };
    let bundle = emit_with(&program, "fanuc", &[], profile);
    let text = core::str::from_utf8(bundle.get("SAMPLE.nc").unwrap()).unwrap();
    assert!(text.contains("N99800 G61\nN99000 G54\n"), "{text}");
}

/// Of parts that are started alone, the first motion is a move of all axes, and the generator runs before the blade cuts.
#[test]
fn parts_say_everything_again() {
    let program = reachable(recipe().program());
    for dialect in DIALECTS {
        let bundle = emit(&program, dialect, &[("lines_per_part", OptionValue::Integer(6))]);
        assert!(bundle.files().len() > 4);
        for (name, bytes) in bundle.files().iter().skip(1) {
            let text = core::str::from_utf8(bytes).unwrap();
            let first = text.lines().find(|line| line.contains(" X")).unwrap();
            let machine = ["G53", "SUPA", "M91"].iter().any(|word| first.contains(word));
            assert!(machine, "{name}: {first}");
        }
        let (_, second) = &bundle.files()[2];
        let text = core::str::from_utf8(second).unwrap();
        let on = ["M64 P12", "M50", "$A_OUT[12]=1"]
            .iter()
            .find_map(|word| text.find(word));
        let cut = text.find("layer").or_else(|| text.find("LAYER"));
        assert!(on.unwrap() < cut.unwrap(), "{text}");
    }
}
