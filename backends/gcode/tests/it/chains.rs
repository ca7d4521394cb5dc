//! Chains: what each dialect writes of them, reads back, and refuses.

use crate::head::{on_the_head, product};
use crate::read_back::replayed;
use crate::support::{DIALECTS, Given, emit, needed, options, recipe, rounds, text};
use core::num::NonZeroU32;
use proptest::prelude::*;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue};
use vcutc_backend_api::geometry::{Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{Action, Joint, Op, OrientationId, Program, ViaId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{DivergenceKind, Mismatch, ProgramFile, program_files};
use vcutc_backend_api::testkit::{Recipe, chained};
use vcutc_backend_api::units::{Angle, Length, Speed};
use vcutc_backend_gcode::Gcode;

/// Those that state how far the tip may leave a chain.
const CHAINING: [&str; 3] = ["linuxcnc", "sinumerik", "heidenhain"];

/// A chain after one cut: a line, an arc to the right, one to the left, a line.
pub(crate) fn chain() -> Program {
    let one_cut = Recipe {
        layers: 1,
        cuts: 1,
        ..recipe()
    };
    chained(one_cut.program(), Angle::deg(60.0), Length::mm(0.1))
}

/// Chains as a dialect has them, the arcs of one in another plane.
pub(crate) fn of(dialect: &str) -> impl Iterator<Item = ReachableProgram> {
    let programs = match dialect {
        "fanuc" => vec![stopping(chain()), stopping(turned(0.0, 90.0, 0.0))],
        "heidenhain" => vec![chain()],
        "linuxcnc" => vec![chain(), turned(0.0, 0.0, 90.0)],
        _ => vec![chain(), turned(0.0, 90.0, 0.0), turned(0.0, 30.0, 20.0)],
    };
    programs.into_iter().map(on_the_head)
}

/// The same on a machine on which the work lies turned so.
fn turned(a: f64, b: f64, c: f64) -> Program {
    lying(chain(), [a, b, c])
}

fn lying(mut program: Program, turns: [f64; 3]) -> Program {
    if let Some(cell) = &mut program.cell {
        let [a, b, c] = turns.map(Angle::deg);
        cell.base.frame.orientation = Orientation::from_zyx(Zyx { a, b, c });
    }
    program
}

/// The same in which every piece stops.
fn stopping(mut program: Program) -> Program {
    for op in &mut program.ops {
        if let Action::Follow { joint, .. } = &mut op.action {
            *joint = Joint::Stop;
        }
    }
    program
}

fn blended(mut program: Program, blend: f64) -> Program {
    program.blend = Length::mm(blend);
    program
}

fn issues(program: Program, dialect: &'static str, more: &[Given]) -> Vec<BackendIssue> {
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    let options = options(&given);
    Gcode
        .check(&on_the_head(program), &options)
        .err()
        .unwrap_or_default()
}

/// What is not supported, in the words of the message.
fn unsupported(program: Program, dialect: &'static str) -> Vec<&'static str> {
    let issues = issues(program, dialect, &[]);
    issues
        .iter()
        .map(|issue| match issue {
            BackendIssue::Unsupported { what, .. } => *what,
            other => panic!("{dialect}: {other:?}"),
        })
        .collect()
}

fn written(program: &ReachableProgram, dialect: &'static str, more: &[Given]) -> Vec<ProgramFile> {
    program_files(&emit(program, dialect, more))
}

fn is_read_back(program: &ReachableProgram, dialect: &'static str, more: &[Given]) {
    let files = written(program, dialect, more);
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    let read = replayed(program, &files, &options(&given)).0;
    let ops = program.program().ops.len();
    assert_eq!(
        read.map(|places| places.len()),
        Ok(ops),
        "{dialect}\n{}",
        files[0].text
    );
}

/// What is wrong with an edited program.
fn departs(program: &Program, dialect: &'static str, (from, to): (&str, &str)) -> DivergenceKind {
    let program = on_the_head(program.clone());
    let mut files = written(&program, dialect, &[]);
    assert!(
        files[0].text.contains(from),
        "{dialect} {from}\n{}",
        files[0].text
    );
    files[0].text = files[0].text.replacen(from, to, 1);
    match replayed(&program, &files, &options(&needed(dialect))).0 {
        Err(divergence) => divergence.what,
        Ok(_) => panic!("{dialect} passes:\n{}", files[0].text),
    }
}

#[test]
fn a_chain_in_every_dialect() {
    let program = on_the_head(chain());
    for dialect in CHAINING {
        insta::assert_snapshot!(format!("chain_{dialect}"), text(&emit(&program, dialect, &[])));
    }
    let stops = on_the_head(stopping(chain()));
    insta::assert_snapshot!("chain_fanuc", text(&emit(&stops, "fanuc", &[])));
}

/// Planes are those of the work offset: turned about an axis of the machine by a quarter an arc is in another one, by less in none.
#[test]
fn arcs_in_other_planes() {
    for (program, plane, first) in [
        (turned(0.0, 0.0, 90.0), "G18 ", "G3"),
        (turned(0.0, 90.0, 0.0), "G19 ", "G2"),
        (turned(180.0, 0.0, 0.0), "", "G2"),
        (turned(30.0, 0.0, 180.0), "", "G3"),
    ] {
        let program = on_the_head(program);
        for (dialect, centres) in [("linuxcnc", "G91.1 "), ("sinumerik", "")] {
            let files = written(&program, dialect, &[]);
            let block = format!("\n{plane}{centres}{first} X");
            assert!(files[0].text.contains(&block), "{block}{}", files[0].text);
            is_read_back(&program, dialect, &[]);
        }
    }
    let oblique = turned(0.0, 30.0, 20.0);
    let program = on_the_head(oblique.clone());
    insta::assert_snapshot!("oblique_chain_sinumerik", text(&emit(&program, "sinumerik", &[])));
    is_read_back(&program, "sinumerik", &[]);
    for dialect in ["linuxcnc", "heidenhain"] {
        let found = unsupported(oblique.clone(), dialect);
        assert!(found[0].starts_with("arcs out of the plane"), "{found:?}");
    }
    let found = unsupported(turned(0.0, 90.0, 0.0), "heidenhain");
    assert!(found[0].starts_with("arcs out of the plane XY"), "{found:?}");
}

#[test]
fn chains_are_read_back() {
    for dialect in CHAINING {
        let most = if dialect == "heidenhain" { 4 } else { 6 };
        for decimals in 3..=most {
            for lines in [0, 5] {
                let more = [
                    ("decimals", OptionValue::Integer(decimals)),
                    ("lines_per_part", OptionValue::Integer(lines)),
                ];
                for program in [chain(), turned(25.0, 0.0, 0.0), stopping(chain())] {
                    is_read_back(&on_the_head(program), dialect, &more);
                }
            }
        }
    }
    is_read_back(&on_the_head(stopping(chain())), "fanuc", &[]);
}

/// Corners in the air are rounded by another distance than chains, so a reader can distinguish them.
#[test]
fn a_blend_as_far_as_corners_are_rounded() {
    let same = [("approximation", OptionValue::Length(Length::mm(0.1)))];
    let program = on_the_head(chain());
    for (dialect, word, other) in [
        ("linuxcnc", "G64 P0.0999 Q0", "G64 P0.1 Q0"),
        ("sinumerik", "G641 ADIS=0.0999", "G641 ADIS=0.1"),
    ] {
        let files = written(&program, dialect, &same);
        for word in [word, other] {
            assert!(files[0].text.contains(word), "{}", files[0].text);
        }
        is_read_back(&program, dialect, &same);
    }
}

/// What stands in the program is rounded down.
#[test]
fn the_distance_is_never_more_than_that_of_the_program() {
    for (blend, said) in [(0.123_49, "0.1234"), (0.1, "0.1"), (2.0, "2.0"), (0.001, "0.001")] {
        let program = on_the_head(blended(chain(), blend));
        for (dialect, word) in [
            ("linuxcnc", format!("G64 P{said} Q0\n")),
            ("sinumerik", format!("G641 ADIS={said}\n")),
            ("heidenhain", format!("CYCL DEF 32.1 T{said}\n")),
        ] {
            let files = written(&program, dialect, &[]);
            assert!(files[0].text.contains(&word), "{}", files[0].text);
            is_read_back(&program, dialect, &[]);
        }
    }
}

#[test]
fn what_cannot_be_said_is_refused() {
    let found = unsupported(chain(), "fanuc");
    assert!(found[0].starts_with("pieces of a chain that go on"), "{found:?}");
    for dialect in CHAINING {
        let found = issues(blended(chain(), 0.0), dialect, &[]);
        assert!(
            matches!(
                found.as_slice(),
                [BackendIssue::OutOfRange {
                    what: "blend of chains",
                    ..
                }]
            ),
            "{dialect} {found:?}"
        );
        assert_eq!(
            issues(stopping(blended(chain(), 0.0)), dialect, &[]),
            [],
            "{dialect}"
        );
    }
    for dialect in DIALECTS {
        let found = unsupported(with_small_arc(0.005), dialect);
        assert_eq!(
            found,
            ["arcs that the decimals of the program cannot hold"],
            "{dialect}"
        );
        assert_eq!(issues(with_small_arc(5.0), dialect, &[]), [], "{dialect}");
        is_read_back(&on_the_head(with_small_arc(5.0)), dialect, &[]);
        // Nearly straight, with its centre beyond the largest coordinate.
        let found = issues(with_arc(150_000.0, 50.0, 25.0), dialect, &[]);
        let what = found.iter().map(|issue| match issue {
            BackendIssue::OutOfRange { what, .. } => *what,
            other => panic!("{dialect}: {other:?}"),
        });
        assert_eq!(what.collect::<Vec<_>>(), ["centre of an arc"], "{dialect}");
    }
    // A point a hundredth from the start: printed, it bends the arc by much, which a centre does not mind.
    let badly_known = with_arc(200.0, 150.0, 0.01);
    assert_eq!(issues(badly_known.clone(), "linuxcnc", &[]), []);
    let found = unsupported(lying(badly_known, [0.0, 30.0, 20.0]), "sinumerik");
    assert_eq!(found, ["arcs that the decimals of the program cannot hold"]);
}

/// One more piece after the chain, an arc of this radius and as long. To the control one of some units of the last decimal may be
/// a circle or none, whichever its ends are rounded to.
fn with_small_arc(radius: f64) -> Program {
    with_arc(radius, radius, 0.5 * radius)
}

/// One more piece after the chain: an arc of a radius and length, known by the point so far along it.
fn with_arc(radius: f64, length: f64, via_at: f64) -> Program {
    let mut program = stopping(chain());
    let is_piece = |op: &Op| matches!(op.action, Action::Follow { .. });
    let last = program.ops.iter().rposition(is_piece).unwrap();
    let mut op = program.ops[last];
    let start = op.action.tip().unwrap();
    let at = |far: f64| {
        let (sin, cos) = libm::sincos(far / radius);
        Point3::new(start.x + radius * (1.0 - cos), start.y + radius * sin, start.z)
    };
    program.vias.push(at(via_at));
    let count = u32::try_from(program.vias.len()).unwrap();
    let held = program.orientation(op.action.orientation().unwrap()).unwrap();
    program.orientations.push(turned_right(held, length / radius));
    if let Action::Follow {
        to, via, orientation, ..
    } = &mut op.action
    {
        (*to, *via) = (at(length), NonZeroU32::new(count).map(ViaId));
        *orientation = OrientationId(u32::try_from(program.orientations.len() - 1).unwrap());
    }
    program.ops.insert(last + 1, op);
    program
}

/// Turned about the vertical, to the right, by an angle in rad.
fn turned_right(held: Orientation, angle: f64) -> Orientation {
    let (sin, cos) = libm::sincos(-0.5 * angle);
    let [w, x, y, z] = product([cos, 0.0, 0.0, sin], held.quaternion());
    Orientation::from_quaternion(w, x, y, z).unwrap()
}

/// Layout, order and words that stay make no difference.
#[test]
fn another_layout_is_the_same_chain() {
    let program = chain();
    let stops = stopping(chain());
    let oblique = turned(0.0, 30.0, 20.0);
    let arc = "X29.899 Y26.601 Z45.000 I9.986 J0.523 B0.0000 A-30.0000 C-90.0000";
    for (program, dialect, from, to) in [
        (
            &program,
            "linuxcnc",
            format!("G91.1 G2 {arc} F942.477796"),
            "g91.1 (once)\ng17\nj.523 i9.986c-90 g2 x29.899 y26.601 f942.477796 ; to the right",
        ),
        (
            &program,
            "sinumerik",
            format!("G2 {arc} F942.477796"),
            "g17 g2 x=29.899 y=AC(26.601) i=9.986 j.523 c-90 f942.477796 ; to the right",
        ),
        (
            &stops,
            "fanuc",
            format!("G2 {} F942.477", arc.replace("0000", "000")),
            "N7G02X29.899Y26.601I9.986J.523C-90.F942.477",
        ),
        (
            &program,
            "heidenhain",
            "36 CC X+30.422 Y+16.615\n37 C X+29.899 Y+26.601 B+0.0000 A-30.0000 C-90.0000 DR- R0 F942.477"
                .to_owned(),
            "36 CC Y+16.615 X+30.422 ; pole\n37 c y+26.601 C-90 DR- X29.899 F942.477",
        ),
        (
            &oblique,
            "sinumerik",
            "CIP X52.482 Y8.101 Z28.401 I1=45.857 J1=5.349 K1=31.069 B0.0000".to_owned(),
            "k1=AC(31.069) i1 = 45.857 cip z28.401 y8.101 x=52.482 j1=5.349",
        ),
    ] {
        let program = on_the_head(program.clone());
        let mut files = written(&program, dialect, &[]);
        assert!(files[0].text.contains(&from), "{from}\n{}", files[0].text);
        files[0].text = files[0].text.replacen(&from, to, 1);
        let read = replayed(&program, &files, &options(&needed(dialect))).0;
        let ops = program.program().ops.len();
        assert_eq!(read.map(|places| places.len()), Ok(ops), "{dialect}");
    }
}

/// Words of an arc that no program has, or that another control reads otherwise.
#[test]
fn words_that_are_not_an_arc() {
    let (program, stops) = (chain(), stopping(chain()));
    let oblique = turned(0.0, 30.0, 20.0);
    for (program, dialect, from, to) in [
        (&program, "linuxcnc", " I9.986 J0.523", " R10"),
        (&program, "linuxcnc", " I9.986 J0.523", ""),
        (&program, "linuxcnc", " I9.986 J0.523", " I9.986 J0.523 K0.0"),
        (&program, "linuxcnc", " I9.986 J0.523", " I9.986 J0.523 P2"),
        (&program, "linuxcnc", "X29.899 Y26.601", "X20.436 Y16.092"),
        (&program, "linuxcnc", "G64 P0.1 Q0", "G64 P0.1"),
        (&stops, "fanuc", "I9.986", "I9"),
        (&program, "sinumerik", " I9.986", " I=AC(9.986)"),
        (&program, "sinumerik", " I9.986", " I1=9.986"),
        (&program, "sinumerik", " I9.986 J0.523", " CR=10"),
        (&program, "sinumerik", " I9.986 J0.523", " I9.986 J0.523 TURN=1"),
        (&program, "sinumerik", "G641 ADIS=0.1", "G642 ADIS=0.1"),
        (&oblique, "sinumerik", " J1=5.349", ""),
        (&oblique, "sinumerik", " J1=5.349", " J2=5.349"),
        (&oblique, "sinumerik", " J1=5.349", " J1=IC(5.349)"),
        (&oblique, "sinumerik", " J1=5.349", " J1=5.349 I5"),
        (&program, "heidenhain", "CC X+30.422 Y+16.615", "CC X+30.422"),
        (
            &program,
            "heidenhain",
            "CC X+30.422 Y+16.615",
            "CC X+30.422 Y+16.615 Z+0",
        ),
        (&program, "heidenhain", "36 CC X+30.422 Y+16.615\n", ""),
        (&program, "heidenhain", "DR- ", ""),
        (&program, "heidenhain", "DR-", "DR"),
        (&program, "heidenhain", "C X+29.899", "CR X+29.899"),
        (&program, "heidenhain", "CYCL DEF 32.1 T0.1", "CYCL DEF 32.1 T0"),
        (
            &program,
            "heidenhain",
            "CYCL DEF 32.1 T0.1",
            "CYCL DEF 32.1 T0.1\n34 CYCL DEF 32.2 HSC-MODE:1 TA5",
        ),
    ] {
        let what = departs(program, dialect, (from, to));
        assert_eq!(what, DivergenceKind::NotUnderstood, "{dialect} {from} -> {to}");
    }
}

/// Each difference by its name.
#[test]
fn edits_of_a_chain_are_named() {
    let program = chain();
    let kind = DivergenceKind::Differs(vec![Mismatch::Kind]);
    for dialect in CHAINING {
        // The other way round.
        let (from, to) = match dialect {
            "heidenhain" => ("DR-", "DR+"),
            _ => ("G2 X", "G3 X"),
        };
        assert_eq!(departs(&program, dialect, (from, to)), kind, "{dialect}");
    }
    for (dialect, from, to) in [
        ("linuxcnc", "G64 P0.1 Q0", "G64 P0.2 Q0"),
        ("sinumerik", "G641 ADIS=0.1", "G641 ADIS=0.2"),
        ("heidenhain", "CYCL DEF 32.1 T0.1", "CYCL DEF 32.1 T0.2"),
    ] {
        let (is, should) = (Length::mm(0.2), Length::mm(0.1));
        let wider = DivergenceKind::Differs(vec![Mismatch::Blend { is, should }]);
        assert_eq!(departs(&program, dialect, (from, to)), wider, "{dialect}");
    }
    for (dialect, from) in [("linuxcnc", "G64 P0.1 Q0\n"), ("sinumerik", "G641 ADIS=0.1\n")] {
        let stops = DivergenceKind::Differs(vec![Mismatch::Stops]);
        assert_eq!(departs(&program, dialect, (from, "")), stops, "{dialect}");
    }
    for (dialect, word) in [("linuxcnc", "G61.1 G1"), ("sinumerik", "G60 G1")] {
        let goes_on = DivergenceKind::Differs(vec![Mismatch::NoStop]);
        assert_eq!(departs(&program, dialect, (word, "G1")), goes_on, "{dialect}");
    }
    let tolerance = "33 CYCL DEF 32.0 TOLERANCE\n34 CYCL DEF 32.1 T0.1\n";
    let stops = DivergenceKind::Differs(vec![Mismatch::Stops]);
    assert_eq!(departs(&program, "heidenhain", (tolerance, "")), stops);
    let reset = "40 CYCL DEF 32.0 TOLERANCE\n41 CYCL DEF 32.1\n";
    let goes_on = DivergenceKind::Differs(vec![Mismatch::NoStop]);
    assert_eq!(departs(&program, "heidenhain", (reset, "")), goes_on);
    for dialect in CHAINING {
        let faster = departs(&program, dialect, ("F942.", "F943."));
        assert!(
            matches!(&faster, DivergenceKind::Differs(what) if matches!(what.as_slice(), [Mismatch::Feed { .. }])),
            "{dialect} {faster:?}"
        );
        let turned = departs(&program, dialect, ("C-90.0000", "C-89.0000"));
        assert!(
            matches!(&turned, DivergenceKind::Differs(what) if matches!(what.as_slice(), [Mismatch::Axis { .. }])),
            "{dialect} {turned:?}"
        );
    }
    for dialect in ["linuxcnc", "sinumerik"] {
        // Higher at its end it is a helix.
        let helix = departs(&program, dialect, ("Z45.000 I9", "Z45.010 I9"));
        assert_eq!(helix, DivergenceKind::NotUnderstood, "{dialect}");
        // Another plane has another centre; without a centre, or with one across it, no arc is read.
        let plane = departs(&program, dialect, ("G2 X", "G18 G2 X"));
        assert_eq!(plane, DivergenceKind::NotUnderstood, "{dialect}");
        let line = departs(&program, dialect, ("G2 X", "G1 X"));
        assert_eq!(line, DivergenceKind::NotUnderstood, "{dialect}");
    }
    let radius = departs(&program, "linuxcnc", ("I9.986", "I9.966"));
    assert_eq!(radius, DivergenceKind::NotUnderstood);
    // On the line at equal distances from both ends it is another arc.
    let centre = departs(&program, "linuxcnc", ("I9.986 J0.523", "I10.082 J0.437"));
    assert!(
        matches!(&centre, DivergenceKind::Differs(what) if matches!(what.as_slice(), [Mismatch::Arc { .. }, ..])),
        "{centre:?}"
    );
    assert_eq!(
        departs(&program, "linuxcnc", ("G91.1 ", "")),
        DivergenceKind::NotUnderstood
    );
    assert_eq!(
        departs(&program, "linuxcnc", ("G91.1 ", "G90.1 ")),
        DivergenceKind::NotUnderstood
    );
    let oblique = turned(0.0, 30.0, 20.0);
    let text = &written(&on_the_head(oblique.clone()), "sinumerik", &[])[0].text;
    let at = text.find(" I1=").unwrap();
    let number = text[at + 4..].split(' ').next().unwrap();
    let moved = format!("{:.3}", number.parse::<f64>().unwrap() + 0.01);
    let found = departs(
        &oblique,
        "sinumerik",
        (&format!(" I1={number}"), &format!(" I1={moved}")),
    );
    assert!(
        matches!(&found, DivergenceKind::Differs(what) if matches!(what.as_slice(), [Mismatch::Arc { .. }])),
        "{found:?}"
    );
    assert_eq!(
        departs(&oblique, "sinumerik", ("CIP", "G1")),
        DivergenceKind::NotUnderstood
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_chains_are_read_back(
        (rake, blend, approximation) in (20.0..89.0_f64, 0.001..3.0_f64, 0.0..3.0_f64),
        turns in [-180.0..180.0_f64, -80.0..80.0, -180.0..180.0],
        decimals in 3..=6_u32,
        lines in prop::sample::select(vec![0, 5]),
        feed in 1.0..900.0_f64,
    ) {
        let recipe = Recipe { layers: 1, cuts: 1, cut_feed: Speed::mm_per_s(feed), ..recipe() };
        let program = chained(recipe.program(), Angle::deg(rake), Length::mm(blend));
        for dialect in DIALECTS {
            let most = if matches!(dialect, "fanuc" | "heidenhain") { 4 } else { 6 };
            let mut more = vec![
                ("decimals", OptionValue::Integer(decimals.min(most))),
                ("lines_per_part", OptionValue::Integer(lines)),
            ];
            if rounds(dialect) {
                more.push(("approximation", OptionValue::Length(Length::mm(approximation))));
            }
            let [a, b, c] = turns;
            let tilted = if dialect == "sinumerik" { [a, b, c] } else { [a, 0.0, 0.0] };
            let program = match dialect {
                "fanuc" => stopping(program.clone()),
                _ => program.clone(),
            };
            let program = on_the_head(lying(program, tilted));
            is_read_back(&program, dialect, &more);
            arcs_are_those_of_the_program(&program, &written(&program, dialect, &more), dialect);
        }
    }
}

/// The arcs of a text by a way of its own: the printed numbers, school geometry, and no reader.
fn arcs_are_those_of_the_program(program: &ReachableProgram, files: &[ProgramFile], dialect: &str) {
    let base = program
        .program()
        .cell
        .as_ref()
        .unwrap()
        .base
        .frame
        .orientation
        .matrix();
    let in_offset =
        |point: [f64; 3]| base.map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2]);
    let lines = program.program().segments();
    let arcs = lines.filter_map(|segment| segment.line()?.arc());
    let mut said = said_arcs(files, dialect).into_iter();
    for arc in arcs {
        let said = said.next().unwrap();
        let half = in_offset(arc.at(0.5 * arc.sweep().to_rad()));
        let (centre, radius) = (said.centre, distance(said.from, said.centre));
        for point in arc.points(16).map(in_offset) {
            let off = (distance(point, centre) - radius).abs();
            assert!(off < 0.003, "{dialect}: {off} mm beside {said:?}");
        }
        let middle = said.middle();
        assert!(
            distance(middle, half) < 0.003,
            "{dialect}: {middle:?} {half:?} {said:?}"
        );
    }
    assert!(said.next().is_none(), "{dialect}");
}

/// An arc of a text. It goes round its axis by the rule of the right hand.
#[derive(Debug)]
struct SaidArc {
    from: [f64; 3],
    to: [f64; 3],
    centre: [f64; 3],
    axis: [f64; 3],
}

impl SaidArc {
    /// The point half way round: on the line through the centre square to the chord, to the side to which it goes round.
    fn middle(&self) -> [f64; 3] {
        let chord = minus(self.to, self.from);
        let out = crossed(chord, self.axis);
        let radius = distance(self.from, self.centre);
        let scale = radius / distance(out, [0.0; 3]);
        [0, 1, 2].map(|place| self.centre[place] + out[place] * scale)
    }
}

fn said_arcs(files: &[ProgramFile], dialect: &str) -> Vec<SaidArc> {
    let (mut at, mut pole) = ([0.0; 3], [0.0; 2]);
    let mut normal = 2;
    let mut arcs = Vec::new();
    for line in files.iter().flat_map(|file| file.text.lines()) {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| {
            let mut texts = words.iter();
            texts.find_map(|text| text.strip_prefix(word)?.parse::<f64>().ok())
        };
        for (plane, across) in [("G17", 2), ("G18", 1), ("G19", 0)] {
            if words.contains(&plane) {
                normal = across;
            }
        }
        let from = at;
        for (place, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
            at[place] = number(letter).unwrap_or(at[place]);
        }
        if words.contains(&"CC") {
            pole = [at[0], at[1]];
            at = from;
        }
        let turn = |left: bool| {
            let mut axis = [0.0; 3];
            axis[normal] = if left { 1.0 } else { -1.0 };
            axis
        };
        let along = |letter| number(letter).unwrap_or_default();
        let offset = ["I", "J", "K"].map(along);
        let centre = [0, 1, 2].map(|place| from[place] + offset[place]);
        let (centre, axis) = if dialect == "heidenhain" && words.contains(&"C") {
            ([pole[0], pole[1], from[2]], turn(words.contains(&"DR+")))
        } else if words.contains(&"G2") || words.contains(&"G3") {
            (centre, turn(words.contains(&"G3")))
        } else if words.contains(&"CIP") {
            let via = ["I1=", "J1=", "K1="].map(|word| number(word).unwrap());
            let arc = CircularArc::through([from, via, at]).unwrap();
            (arc.centre(), arc.axis())
        } else {
            continue;
        };
        let to = at;
        arcs.push(SaidArc {
            from,
            to,
            centre,
            axis,
        });
    }
    arcs
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|place| a[place] - b[place])
}

fn crossed(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    minus(a, b).iter().map(|along| along * along).sum::<f64>().sqrt()
}
