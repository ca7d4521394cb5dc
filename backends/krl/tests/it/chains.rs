//! Chains: lines and arcs through the work without a stop between them.

use crate::read_back::{Count, Original, replayed, statements, text};
use crate::support::{emit, issues, lines, options, reachable};
use proptest::prelude::*;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::backend::{BackendIssue, OptionValue};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Divergence, DivergenceKind, Mismatch, ProgramFile, program_files};
use vcutc_backend_api::testkit::{Recipe, chained};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};

pub(crate) fn recipe() -> Recipe {
    Recipe {
        layers: 1,
        cuts: 1,
        ..Recipe::default()
    }
}

pub(crate) fn program(recipe: &Recipe) -> Program {
    chained(recipe.program(), Angle::deg(60.0), Length::mm(0.1))
}

fn spline() -> Vec<(&'static str, OptionValue)> {
    vec![
        ("motion", OptionValue::Choice("spline")),
        ("approximation", OptionValue::Length(Length::mm(2.5))),
    ]
}

fn files(program: &ReachableProgram, values: &[(&str, OptionValue)]) -> Vec<ProgramFile> {
    program_files(&emit(program, values))
}

fn replay(
    program: &ReachableProgram,
    values: &[(&str, OptionValue)],
    files: &[ProgramFile],
) -> Result<usize, Divergence> {
    let options = options(values);
    let statements = statements(files, program, &options);
    replayed(&statements, program, &options).map(|places| places.len())
}

/// The lines of the chain, with what is set between its pieces.
fn chain(program: &ReachableProgram, values: &[(&str, OptionValue)]) -> String {
    let bundle = emit(program, values);
    let lines = lines(&bundle, "sample.src");
    let arcs = |line: &String| line.starts_with("CIRC") || line.starts_with("SCIRC");
    let first = lines.iter().position(arcs).unwrap();
    let last = lines.iter().rposition(arcs).unwrap();
    let setup = lines.iter().filter(|line| line.contains("_TYPE"));
    let shown = setup.chain(&lines[first - 5..=last + 3]);
    shown.map(|line| format!("{line}\n")).collect()
}

#[test]
fn classic() {
    insta::assert_snapshot!(chain(&reachable(program(&recipe())), &[]));
}

#[test]
fn splines_beside_corners_in_the_air() {
    insta::assert_snapshot!(chain(&reachable(program(&recipe())), &spline()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn chains_are_read_back(
        (rake, blend) in (45.0..90.0_f64, 0.001..20.0_f64),
        (cut, rate) in (1.0..3000.0_f64, 5.0..400.0_f64),
        (layers, cuts) in (1..3_u32, 1..3_u32),
        (lines, distance) in (prop::sample::select(vec![0, 12, 2500]), prop::sample::select(vec![0.0, 0.1, 2.5])),
        (decimals, motion) in (3..=6_u32, prop::sample::select(vec!["classic", "spline"])),
    ) {
        let recipe = Recipe {
            layers,
            cuts,
            cut_feed: Speed::mm_per_s(cut),
            rate: AngularSpeed::deg_per_s(rate),
            ..recipe()
        };
        let program = reachable(chained(recipe.program(), Angle::deg(rake), Length::mm(blend)));
        let values = [
            ("decimals", OptionValue::Integer(decimals)),
            ("lines_per_part", OptionValue::Integer(lines)),
            ("approximation", OptionValue::Length(Length::mm(distance))),
            ("motion", OptionValue::Choice(motion)),
        ];
        let replayed = replay(&program, &values, &files(&program, &values));
        prop_assert_eq!(replayed, Ok(program.program().ops.len()));
    }
}

/// The joint of a chain is never taken for a corner in the air, though both are left as far before their end.
#[test]
fn a_blend_as_large_as_the_approximation() {
    let program = reachable(chained(recipe().program(), Angle::deg(60.0), Length::mm(2.5)));
    let files = files(&program, &spline());
    assert!(
        files[0].text.contains("$APO.CDIS=2.499999\r\n"),
        "{}",
        files[0].text
    );
    assert_eq!(
        replay(&program, &spline(), &files),
        Ok(program.program().ops.len())
    );
}

/// What a controller makes of the words, by circles through the points in the text: the arc of the program, in the time of the
/// program, at a speed that alone is slow enough.
#[test]
fn arcs_are_those_of_the_program() {
    let program = reachable(program(&recipe()));
    let bundle = emit(&program, &[]);
    let numbers = |target: &str| -> [f64; 3] {
        let parts: Vec<f64> = target
            .trim_matches(['{', '}'])
            .split(',')
            .take(3)
            .map(|part| part.split_once(' ').unwrap().1.parse().unwrap())
            .collect();
        parts.try_into().unwrap()
    };
    let mut tip = [0.0; 3];
    let mut speed = 0.0;
    let mut arcs = Vec::new();
    for line in lines(&bundle, "sample.src") {
        if let Some(value) = line.strip_prefix("$VEL.CP=") {
            speed = value.parse::<f64>().unwrap() * 1000.0;
        } else if let Some(rest) = line.strip_prefix("LIN ") {
            tip = numbers(rest.split_once('}').unwrap().0);
        } else if let Some(rest) = line.strip_prefix("CIRC ") {
            let (via, to) = rest.split_once("},{").unwrap();
            let (via, to) = (numbers(via), numbers(to));
            arcs.push((CircularArc::through([tip, via, to]).unwrap(), speed));
            tip = to;
        }
    }
    let segments = program.program().segments();
    let wanted: Vec<_> = segments
        .filter_map(|segment| segment.line().filter(|line| line.via.is_some()))
        .collect();
    assert_eq!((arcs.len(), wanted.len()), (2, 2));
    for ((is, speed), line) in arcs.into_iter().zip(wanted) {
        let should = line.arc().unwrap();
        for (a, b) in is.points(50).zip(should.points(50)) {
            assert!(Point3::from(a).distance(Point3::from(b)).to_mm() < 0.002);
        }
        let (time, planned) = (is.length().to_mm() / speed, line.duration().to_s());
        assert!(
            (-1e-6..1e-3).contains(&(time / planned - 1.0)),
            "{time} {planned}"
        );
    }
}

/// One text put in the place of another, once: in the chain, or where it is not there before it.
fn edited(values: &[(&str, OptionValue)], from: &str, to: &str) -> DivergenceKind {
    let program = reachable(program(&recipe()));
    let mut files = files(&program, values);
    let (before, chain) = files[0].text.split_once("$APO.CDIS=0.1").unwrap();
    let chain = format!("$APO.CDIS=0.1{chain}");
    assert!(before.contains(from) || chain.contains(from), "{from}");
    files[0].text = if chain.contains(from) {
        format!("{before}{}", chain.replacen(from, to, 1))
    } else {
        format!("{}{chain}", before.replacen(from, to, 1))
    };
    replay(&program, values, &files).unwrap_err().what
}

/// The first mismatch that an edit leads to.
fn mismatch(from: &str, to: &str) -> Mismatch {
    match edited(&[], from, to) {
        DivergenceKind::Differs(found) => found[0],
        other => panic!("{from} {to}: {other:?}"),
    }
}

/// The first arc of the program, from its word to the end of its line.
fn first_arc(values: &[(&str, OptionValue)]) -> String {
    let program = reachable(program(&recipe()));
    let text = files(&program, values)[0].text.clone();
    let arc = text.lines().find(|line| line.contains("CIRC {")).unwrap();
    arc.to_owned()
}

#[test]
fn what_is_changed_in_a_chain_is_named() {
    let arc = first_arc(&[]);
    let (via, rest) = arc.split_once("},{").unwrap();
    let far = via.replacen("CIRC {X ", "CIRC {X 1", 1);
    let straight = format!("LIN {{{rest}");
    let speed = "$VEL.CP=0.015707";
    assert!(matches!(
        mismatch("$APO.CDIS=0.1", "$APO.CDIS=0.2"),
        Mismatch::Blend { .. }
    ));
    assert!(matches!(mismatch("} C_DIS", "}"), Mismatch::Stops));
    assert!(matches!(mismatch(via, &far), Mismatch::Arc { .. }));
    assert!(matches!(mismatch(&arc, &straight), Mismatch::Kind));
    assert!(matches!(
        mismatch(&format!("{arc}\r\n"), ""),
        Mismatch::Arc { .. }
    ));
    assert!(matches!(
        mismatch(speed, "$VEL.CP=0.015709"),
        Mismatch::Feed { .. }
    ));
    assert!(matches!(
        mismatch(&format!("{speed}\r\n"), ""),
        Mismatch::Feed { .. }
    ));
    let rates = [("$VEL.ORI1=75", "$VEL.ORI1=85"), ("$VEL.ORI2=53", "$VEL.ORI2=63")];
    for (from, to) in rates {
        assert!(matches!(mismatch(from, to), Mismatch::Rate { .. }));
    }
    // A point farther round the same circle is another.
    let program = reachable(program(&recipe()));
    let circle = program
        .program()
        .segments()
        .find_map(|segment| segment.line()?.arc());
    let circle = circle.unwrap();
    let [x, y, z] = circle.at(0.3 * circle.sweep().to_rad());
    let found = mismatch(via, &format!("CIRC {{X {x:.3},Y {y:.3},Z {z:.3}"));
    assert!(matches!(found, Mismatch::Arc { .. }), "{found:?}");
}

#[test]
fn words_and_modes_of_other_chains_are_not_understood() {
    let arc = first_arc(&spline());
    let (via, _) = arc.split_once("},{").unwrap();
    let (place, held) = via.split_once(",A ").unwrap();
    let (_, rest) = held.split_once(',').unwrap();
    let (turned, rest) = (format!("{place},A 47.0000,{rest}"), place.to_owned());
    for (values, from, to) in [
        (vec![], "$APO.CDIS=0.1", "$APO.CDIS=0.0"),
        (vec![], "$APO.CDIS=0.1\r\n", ""),
        (vec![], "} C_DIS", "} C_ORI"),
        (vec![], "} C_DIS", "} C_SPL"),
        (vec![], "$CIRC_TYPE=#PATH", "$CIRC_TYPE=#BASE"),
        (vec![], "$CIRC_TYPE=#PATH\r\n", ""),
        (vec![], "$ORI_TYPE=#VAR", "$ORI_TYPE=#CONSTANT"),
        (vec![], "CIRC {", "SCIRC {"),
        (vec![], "CIRC {", "CIRC_REL {"),
        (spline(), "SCIRC {", "CIRC {"),
        (spline(), via, &turned),
        (spline(), via, &rest),
    ] {
        let found = edited(&values, from, to);
        assert!(
            matches!(found, DivergenceKind::NotUnderstood),
            "{from} {to}: {found:?}"
        );
    }
}

/// Arcs that a controller takes otherwise than the program means are not read as arcs.
#[test]
fn other_arcs_are_unknown() {
    let program = reachable(program(&recipe()));
    let options = options(&[]);
    for (from, to) in [
        ("} C_DIS", ", CA 90.0 C_DIS"),
        ("CIRC {X", "CIRC {E1 5.0,X"),
        ("CIRC {X", "CIRC {A1 5.0,X"),
    ] {
        let mut files = files(&program, &[]);
        let at = files[0].text.find("CIRC {X").unwrap();
        let (before, after) = files[0].text.split_at(at);
        let (line, rest) = after.split_once("\r\n").unwrap();
        let line = if to.starts_with(", CA") {
            line.replacen(" C_DIS", to, 1)
        } else {
            line.replacen(from, to, 1)
        };
        files[0].text = format!("{before}{line}\r\n{rest}");
        let statements = statements(&files, &program, &options);
        let statement = statements
            .iter()
            .find(|statement| text(&files, statement).starts_with("CIRC"))
            .unwrap();
        assert!(statement.effect.command().is_none(), "{statement:?}");
    }
}

#[test]
fn no_character_and_no_line_of_a_chain_can_be_changed_unnoticed() {
    let mut count = Count::default();
    let program = reachable(program(&recipe()));
    let original = Original::new(&program, &[]);
    original.change_characters(&mut count);
    original.change_lines(&mut count);
    Original::new(&program, &spline()).change_lines(&mut count);
    assert!(count.departed > 4_000 && count.other_statement > 100, "{count:?}");
}

/// What `program` is refused for.
fn refused(program: Program) -> Vec<(&'static str, String)> {
    let subjects = issues(program, &[]).into_iter().map(|issue| match issue {
        BackendIssue::OutOfRange {
            op: Some(_),
            what,
            value,
            ..
        } => (what, value),
        other => panic!("{other:?}"),
    });
    subjects.collect()
}

#[test]
fn without_anything_to_round_a_robot_stops() {
    let none = chained(recipe().program(), Angle::deg(60.0), Length::ZERO);
    assert_eq!(refused(none), [("blend of a chain", "0.0 mm".to_owned())]);
}

#[test]
fn an_arc_that_print_changes_is_refused() {
    let mut program = program(&recipe());
    let circle = program.segments().find_map(|segment| segment.line()?.arc());
    // Half a micrometre from where the arc begins.
    program.vias[0] = Point3::from(circle.unwrap().at(0.000_05));
    let refused = issues(program, &[]);
    assert!(
        matches!(refused[..], [BackendIssue::Unsupported { .. }]),
        "{refused:?}"
    );
}

/// Every digit of every place on the arcs made another: each is a difference of an op.
#[test]
fn no_digit_of_an_arc_can_be_changed() {
    let program = reachable(program(&recipe()));
    let files = files(&program, &[]);
    let text = &files[0].text;
    let mut tried = 0;
    for (start, _) in text.match_indices("CIRC {") {
        let line = &text[start..start + text[start..].find(",A ").unwrap()];
        let digits = line.char_indices().filter(|(_, c)| c.is_ascii_digit());
        for at in digits.map(|(at, _)| start + at) {
            let other = (text.as_bytes()[at] - b'0' + 1) % 10;
            let mut changed = files.clone();
            changed[0].text.replace_range(at..=at, &other.to_string());
            let found = replay(&program, &[], &changed).unwrap_err().what;
            assert!(matches!(found, DivergenceKind::Differs(_)), "{at}: {found:?}");
            tried += 1;
        }
    }
    // Two arcs with six coordinates of five digits.
    assert_eq!(tried, 60);
}
