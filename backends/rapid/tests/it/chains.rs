//! Chains: lines and arcs through the work without a stop between them.

use crate::round_trip::replayed;
use crate::support::{emit, emit_with, issues, lines, one_cut, options, reachable, recipe};
use proptest::prelude::*;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{DivergenceKind, Mismatch, ProgramFile, program_files};
use vcutc_backend_api::testkit::{Recipe, chained};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};

pub(crate) fn program() -> Program {
    chained(one_cut().program(), Angle::deg(60.0), Length::mm(0.1))
}

fn files(program: &ReachableProgram) -> Vec<ProgramFile> {
    program_files(&emit(program, &[]))
}

#[test]
fn zones_of_joints_and_arcs_in_stretches() {
    let bundle = emit(
        &reachable(program()),
        &[("approximation", OptionValue::Length(Length::mm(2.5)))],
    );
    let shown = lines(&bundle, "sample.mod").into_iter().filter(|line| {
        let words = ["zonedata", "On;", "Off;", "Frame;", "vc_blend", "MoveC"];
        words.iter().any(|word| line.contains(word)) || line.starts_with("      [")
    });
    insta::assert_snapshot!(shown.map(|line| format!("{line}\n")).collect::<String>());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn chains_are_read_back(
        (rake, blend) in (45.0..90.0_f64, 0.001..20.0_f64),
        (cut, rate) in (1.0..900.0_f64, 1.0..400.0_f64),
        (layers, cuts) in (1..3_u32, 1..3_u32),
        (lines, distance) in (prop::sample::select(vec![0, 12, 5000]), prop::sample::select(vec![0.0, 0.1, 2.5])),
        decimals in 3..=6_u32,
    ) {
        let recipe = Recipe {
            layers,
            cuts,
            cut_feed: Speed::mm_per_s(cut),
            rate: AngularSpeed::deg_per_s(rate),
            ..recipe()
        };
        let program = reachable(chained(recipe.program(), Angle::deg(rake), Length::mm(blend)));
        let options = options(&[
            ("decimals", OptionValue::Integer(decimals)),
            ("lines_per_part", OptionValue::Integer(lines)),
            ("approximation", OptionValue::Length(Length::mm(distance))),
        ]);
        let files = program_files(&emit_with(&program, &options));
        let replayed = replayed(&program, &options, &files).map(|places| places.len());
        prop_assert_eq!(replayed, Ok(program.program().ops.len()));
    }
}

/// The numbers of a line's positions, each the first list of a target.
fn positions(line: &str) -> Vec<[f64; 3]> {
    let starts = line.match_indices("[[").map(|(at, _)| &line[at + 2..]);
    starts
        .map(|rest| {
            let numbers = rest.split(']').next().unwrap().split(',');
            let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        })
        .collect()
}

/// What a controller makes of the words, by circles through the points in the text: one after the other the arcs of the program.
#[test]
fn arcs_are_those_of_the_program() {
    let program = reachable(program());
    assert!(!program.motion().waypoints.is_empty());
    let code = lines(&emit(&program, &[]), "sample.mod").join("\n");
    let mut tip = [0.0; 3];
    let mut pieces = Vec::new();
    let moves = code.split(";\n").map(str::trim);
    for statement in
        moves.filter(|statement| statement.starts_with("MoveC") || statement.starts_with("MoveL"))
    {
        match (statement.starts_with("MoveC"), positions(statement).as_slice()) {
            (true, &[via, to]) => {
                pieces.push(CircularArc::through([tip, via, to]).unwrap());
                assert!(statement.contains(",vc_blend,"), "{statement}");
                tip = to;
            }
            (false, &[to]) => tip = to,
            (_, _) => panic!("{statement}"),
        }
    }
    let segments = program.program().segments();
    let wanted: Vec<_> = segments
        .filter_map(|segment| segment.line().and_then(|line| line.arc()))
        .collect();
    assert_eq!(wanted.len(), 2);
    assert!(pieces.len() > wanted.len());
    let way = pieces.iter().map(|arc| arc.length().to_mm()).sum::<f64>();
    let should = wanted.iter().map(|arc| arc.length().to_mm()).sum::<f64>();
    assert!((way - should).abs() < 0.01, "{way} {should}");
    for point in pieces.iter().flat_map(|piece| piece.points(20)) {
        let off = wanted.iter().map(|arc| {
            let nearest = arc.at(arc.done_at(point) * arc.sweep().to_rad());
            Point3::from(nearest).distance(Point3::from(point)).to_mm()
        });
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off < 0.005, "{off}");
    }
}

/// One text put in the place of another, once; where there is a mark, after it.
fn edited(mark: &str, from: &str, to: &str) -> DivergenceKind {
    let program = reachable(program());
    let mut files = files(&program);
    let at = files[0].text.find(mark).unwrap();
    let (before, after) = files[0].text.split_at(at);
    assert!(after.contains(from), "{from}");
    files[0].text = format!("{before}{}", after.replacen(from, to, 1));
    replayed(&program, &options(&[]), &files).unwrap_err().what
}

fn mismatch(from: &str, to: &str) -> Mismatch {
    match edited("MoveC", from, to) {
        DivergenceKind::Differs(found) => found[0],
        other => panic!("{from} {to}: {other:?}"),
    }
}

#[test]
fn what_is_changed_in_a_chain_is_named() {
    let text = files(&reachable(program()))[0].text.clone();
    let at = text.find("MoveC").unwrap();
    let (arc, rest) = text[at..].split_once(";\r\n").unwrap();
    let (via, to) = arc.split_once(",\r\n").unwrap();
    let [x, ..] = positions(via)[0];
    let moved = via.replacen(&format!("{x:.3}"), &format!("{:.3}", x + 0.002), 1);
    let straight = format!("MoveL {}", to.trim());
    assert!(matches!(mismatch("vc_blend", "fine"), Mismatch::Stops));
    assert!(matches!(mismatch(via, &moved), Mismatch::Arc { .. }));
    assert!(matches!(mismatch(arc, &straight), Mismatch::Kind));
    assert!(matches!(
        mismatch(&format!("{arc};\r\n"), ""),
        Mismatch::Arc { .. }
    ));
    let (second, _) = rest.split_once(";\r\n").unwrap();
    assert!(matches!(
        mismatch(&format!("{second};\r\n"), ""),
        Mismatch::Arc { .. }
    ));
    let larger = edited(
        "vc_blend",
        "[FALSE,0.1,0.1,0.1,0.01,0.1,0.01]",
        "[FALSE,0.2,0.2,0.2,0.02,0.2,0.02]",
    );
    assert!(
        matches!(larger, DivergenceKind::Differs(ref found) if matches!(found[..], [Mismatch::Blend { .. }])),
        "{larger:?}"
    );
}

#[test]
fn words_and_modes_of_other_chains_are_not_understood() {
    for (mark, from, to) in [
        ("PROC", "CirPathMode\\ObjectFrame;", ""),
        ("PROC", "CirPathMode\\ObjectFrame;", "CirPathMode\\PathFrame;"),
        ("PROC", "CirPathMode\\ObjectFrame;", "CirPathMode\\Wrist45;"),
        ("MoveC", "vc_blend", "z1"),
        ("MoveC", "vc_tool", "tool0"),
        ("MoveC", "MoveC [[", "MoveC [[1,"),
        ("vc_blend", "[FALSE,0.1,", "[FALSE,0.2,"),
        (
            "vc_blend",
            "[FALSE,0.1,0.1,0.1,0.01,0.1,0.01]",
            "[FALSE,0,0,0,0,0,0]",
        ),
        (
            "MoveC",
            "ENDPROC",
            "CirPathMode\\ObjectFrame; CirPathMode\\CirPointOri; ENDPROC",
        ),
    ] {
        let found = edited(mark, from, to);
        assert!(
            matches!(found, DivergenceKind::NotUnderstood),
            "{from} {to}: {found:?}"
        );
    }
}

/// The reader of the zone of a joint does not take it for a corner in the air.
#[test]
fn a_blend_as_large_as_the_approximation() {
    let program = reachable(chained(one_cut().program(), Angle::deg(60.0), Length::mm(2.5)));
    let options = options(&[("approximation", OptionValue::Length(Length::mm(2.5)))]);
    let files = program_files(&emit_with(&program, &options));
    assert!(
        files[0].text.contains("vc_blend:=[FALSE,2.499999,"),
        "{}",
        files[0].text
    );
    assert!(replayed(&program, &options, &files).is_ok());
}

/// What a program is refused for.
fn refused(program: Program) -> Vec<&'static str> {
    let subjects = issues(program, &[]).into_iter().map(|issue| match issue {
        BackendIssue::OutOfRange {
            op: Some(_), what, ..
        } => what,
        other => panic!("{other:?}"),
    });
    subjects.collect()
}

#[test]
fn without_a_zone_a_robot_stops() {
    let none = chained(one_cut().program(), Angle::deg(60.0), Length::ZERO);
    assert_eq!(refused(none), ["blend of a chain"]);
}

/// The pretend arm needs waypoints on arcs of a quarter turn; where none states the axes, the points are the program's own.
#[test]
fn points_of_arcs_that_are_too_near_are_refused() {
    let mut recipe = one_cut();
    // A radius of 0.2 mm: stretches of the arc are shorter than a controller takes.
    recipe.stock.width = Length::mm(1.0);
    let program = chained(recipe.program(), Angle::deg(60.0), Length::mm(0.001));
    let found = refused(program);
    assert!(
        found.contains(&"distance from where an arc begins to its middle point"),
        "{found:?}"
    );
}

/// Every digit of every place on the arcs, and of the zone, made another: each is a difference of an op.
#[test]
fn no_digit_of_a_place_on_an_arc_can_be_changed() {
    let program = reachable(program());
    let files = files(&program);
    let text = &files[0].text;
    let mut places = Vec::new();
    for (start, _) in text.match_indices("MoveC") {
        let statement = &text[start..start + text[start..].find(';').unwrap()];
        for (at, _) in statement.match_indices("[[") {
            let end = at + statement[at..].find(']').unwrap();
            places.extend((at..end).map(|at| start + at));
        }
    }
    let is_digit = |at: &usize| text.as_bytes()[*at].is_ascii_digit();
    let mut tried = 0;
    for at in places.into_iter().filter(is_digit) {
        let other = (text.as_bytes()[at] - b'0' + 1) % 10;
        let mut changed = files.clone();
        changed[0].text.replace_range(at..=at, &other.to_string());
        let found = replayed(&program, &options(&[]), &changed).unwrap_err().what;
        assert!(matches!(found, DivergenceKind::Differs(_)), "{at}: {found:?}");
        tried += 1;
    }
    assert!(tried > 100, "{tried}");
}
