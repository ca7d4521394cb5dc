//! What is written is read back as the program it was written from, in every dialect, whatever its layout.

use crate::support::{DIALECTS, Given, block, emit_with, needed, options, reachable, recipe, rounds};
use proptest::prelude::*;
use vcutc_backend_api::backend::{Backend, OptionValue, Options};
use vcutc_backend_api::geometry::{Orientation, Zyx};
use vcutc_backend_api::ir::{Edges, Ready};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::readback::{
    Comparator, Divergence, Place, ProgramFile, Replay, Sources, Statement, program_files,
};
use vcutc_backend_api::testkit::{Crossing, Passes, Recipe};
use vcutc_backend_api::units::{Angle, Duration, Length, Speed};
use vcutc_backend_gcode::Gcode;

/// Follows a program through files.
pub(crate) fn replayed(
    program: &ReachableProgram,
    files: &[ProgramFile],
    options: &Options,
) -> (Result<Vec<Place>, Divergence>, Vec<Statement>) {
    let reader = Gcode.reader().unwrap();
    let sources = Sources {
        files,
        cell: program.program().cell.as_ref().unwrap(),
        options,
    };
    let mut replay = Replay::new(
        Comparator::new(program, reader, reader.resolution(options)),
        reader.frames(),
    );
    let mut statements = Vec::new();
    reader.read(sources, &mut |statement| {
        replay.take(&statement);
        statements.push(statement);
    });
    (replay.finish(), statements)
}

/// Every statement is reported once, in place, and every op is found in the order of the program.
fn is_read_back(program: &ReachableProgram, dialect: &'static str, more: &[Given], profile: &Profile) {
    let bundle = emit_with(program, dialect, more, profile.clone());
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    let options = options(&given).with_profile(profile.clone());
    let files = program_files(&bundle);
    let (result, statements) = replayed(program, &files, &options);
    let places = match result {
        Ok(places) => places,
        Err(divergence) => {
            let place = divergence.place;
            let text =
                place.map(|place| &files[place.file as usize].text[place.start as usize..place.end as usize]);
            panic!("{dialect}: {divergence:?} at {text:?}");
        }
    };
    assert_eq!(places.len(), program.program().ops.len());
    assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{dialect}");
    let mut places: Vec<_> = statements.iter().map(|statement| statement.place).collect();
    places.sort_unstable();
    assert!(
        places
            .windows(2)
            .all(|pair| pair[0].file < pair[1].file || pair[0].end < pair[1].start)
    );
    let lines_with_statements: usize = files.iter().map(|file| statements_of(&file.text, dialect)).sum();
    assert_eq!(places.len(), lines_with_statements, "{dialect}");
}

/// Lines that are neither blank nor comment: the writer has no comments after statements but that of Fanuc's
/// O word.
fn statements_of(text: &str, dialect: &str) -> usize {
    let comment = match dialect {
        "linuxcnc" | "fanuc" => '(',
        _ => ';',
    };
    let after_number = |line: &str| {
        let line = line.trim_start_matches('N');
        line.trim_start_matches(|c: char| c.is_ascii_digit())
            .trim()
            .to_owned()
    };
    let lines = text.lines().map(after_number);
    lines
        .filter(|line| !line.is_empty() && !line.starts_with(comment))
        .count()
}

fn recipes() -> impl Strategy<Value = Recipe> {
    (
        (0..3_u16, 0..3_u32, 0..4_u32),
        (5.0..60.0_f64, 45.0..90.0_f64, 0.5..20.0_f64),
        (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
        prop::option::of(0.0..3.0_f64),
        (1.0..900.0_f64, 1.0..900.0_f64),
        [-180.0..180.0_f64, -40.0..40.0, -40.0..40.0],
    )
        .prop_map(
            |(counts, (swing, rake, clearance), flags, dwell, feeds, turned)| {
                let plain = recipe();
                let mut cell = plain.cell.clone();
                let [a, b, c] = turned.map(Angle::deg);
                cell.base.frame.orientation = Orientation::from_zyx(Zyx { a, b, c });
                let (by_layer, single, by_axes, waits) = flags;
                if waits {
                    cell.ready = Ready::Input(7);
                }
                Recipe {
                    operations: counts.0,
                    layers: counts.1,
                    cuts: counts.2,
                    swing: Angle::deg(swing),
                    rake: Angle::deg(rake),
                    clearance: Length::mm(clearance),
                    passes: if by_layer { Passes::Layer } else { Passes::Point },
                    edges: if single { Edges::Single } else { Edges::Double },
                    crossing: if by_axes {
                        Crossing::ByAxes
                    } else {
                        Crossing::Straight
                    },
                    dwell: dwell.map(Duration::s),
                    cut_feed: Speed::mm_per_s(feeds.0),
                    travel_feed: Speed::mm_per_s(feeds.1),
                    cell,
                    ..plain
                }
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_programs_are_read_back(
        recipe in recipes(),
        decimals in 3..=6_u32,
        approximation in 0.0..5.0_f64,
        lines_per_part in prop::sample::select(vec![0, 5, 40]),
        numbered in any::<bool>(),
        habits in any::<bool>(),
    ) {
        let program = reachable(recipe.program());
        for dialect in DIALECTS {
            let most = if matches!(dialect, "fanuc" | "heidenhain") { 4 } else { 6 };
            let mut more = vec![
                ("decimals", OptionValue::Integer(decimals.min(most))),
                ("lines_per_part", OptionValue::Integer(lines_per_part)),
            ];
            if rounds(dialect) {
                more.push(("approximation", OptionValue::Length(Length::mm(approximation))));
            }
            if dialect == "fanuc" && matches!(recipe.cell.ready, Ready::Input(_)) {
                more.push(("ready_code", block("M52")));
            }
            let mut profile = Profile::default();
            if numbered && dialect != "heidenhain" {
                profile.line_numbers = Some(LineNumbers { start: 10, step: 10 });
            }
            if habits {
                let more: &[&str] = match dialect {
                    "linuxcnc" => &["S500 M101", "M1"],
                    "fanuc" => &["G05.1 Q1", "S500 M61", "M0", "(cell 2)"],
                    "sinumerik" => &["MSG(\"cell 2; wait\")", "SOFT", "M61 S5"],
                    _ => &["M61 M22", "; cell 2"],
                };
                let header = ["M8"].iter().chain(more);
                profile.header = header.map(|&line| line.to_owned()).collect();
                profile.footer = vec!["M9".to_owned(), "M8".to_owned()];
            }
            is_read_back(&program, dialect, &more, &profile);
        }
    }
}
