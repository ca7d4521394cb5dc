//! Programs as other people and other software write them.

use crate::read_back::{replayed, statements, text};
use crate::support::{options, reachable};
use proptest::prelude::*;
use vcutc_backend_api::backend::{OptionValue, Options};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{DivergenceKind, Effect, ProgramFile, decoded};
use vcutc_backend_api::testkit::Recipe;
use vcutc_backend_api::units::Length;

/// A program of two cuts.
fn two_cuts() -> (ReachableProgram, Options) {
    let recipe = Recipe {
        name: "odd".to_owned(),
        layers: 1,
        cuts: 2,
        ..Recipe::default()
    };
    let approximation = OptionValue::Length(Length::mm(2.5));
    (
        reachable(recipe.program()),
        options(&[("approximation", approximation)]),
    )
}

fn file(name: &str, bytes: &[u8]) -> ProgramFile {
    ProgramFile {
        name: name.to_owned(),
        text: decoded(bytes),
    }
}

/// The same program, written by hand: subprograms, positions with names in data lists and routines, components left out,
/// types in front of literals, every kind of layout, Latin-1.
fn by_hand() -> Vec<ProgramFile> {
    vec![
        file("odd_setup.src", include_bytes!("../data/odd/odd_setup.src")),
        file("ODD.SRC", include_bytes!("../data/odd/odd.src")),
        file("odd.dat", include_bytes!("../data/odd/odd.dat")),
        file("Odd_Points.dat", include_bytes!("../data/odd/odd_points.dat")),
    ]
}

#[test]
fn a_program_written_by_hand_is_the_same_program() {
    let (program, options) = two_cuts();
    let files = by_hand();
    let odd = &files[1].text;
    assert!(
        odd.contains("\r\n") && odd.contains("\u{fc}r"),
        "the file lost its bytes"
    );
    let statements = statements(&files, &program, &options);
    if let Err(divergence) = replayed(&statements, &program, &options) {
        let at = divergence.place.map(|place| {
            let statement = statements.iter().find(|statement| statement.place == place);
            text(&files, statement.unwrap())
        });
        panic!("{divergence:?} at {at:?}");
    }
}

/// The program by hand with a line put before its first `$OUT`, and how that line is reported.
fn with_line(line: &str) -> (Effect, bool) {
    let (program, options) = two_cuts();
    let mut files = by_hand();
    files[1].text = files[1].text.replacen("$out [", &format!("{line}\r\n$out ["), 1);
    let statements = statements(&files, &program, &options);
    let statement = statements
        .iter()
        .find(|statement| text(&files, statement) == line);
    let is_followed = replayed(&statements, &program, &options).is_ok();
    (statement.unwrap().effect.clone(), is_followed)
}

#[test]
fn what_is_krl_but_not_understood_is_said_to_be_so() {
    for line in [
        "IF $IN[3] THEN",
        "FOR I=1 TO 3",
        "LOOP",
        "GOTO AGAIN",
        "AGAIN:",
        "SWITCH COUNT",
        "INTERRUPT DECL 3 WHEN $IN[2] DO STOPIT( )",
        "TRIGGER WHEN DISTANCE=0 DELAY=0 DO $OUT[12]=FALSE",
        "CONTINUE",
        "HALT",
        "RETURN",
        "PTP_REL {A1 5}",
        "LIN_REL {X 5}",
        "CIRC {X 1,Y 2,Z 3},{X 4}, CA 90",
        "SCIRC_REL {X 1,Y 2,Z 3},{X 4}",
        "LIN {X 1} C_ORI",
        "LIN {X 1} C_VEL",
        "PTP {A1 0} C_PTP",
        "PTP {A1 0} C_PTP C_DIS",
        "SLIN {X 1} C_DIS",
        "SLIN {X 1} WITH $VEL.CP=0.1",
        "LIN XP_BACK:XP9",
        "LIN {X 1,E1 5.0}",
        "XP9.X=XP9.X+1",
        "XP9.X=COUNT",
        "XP9.R=1",
        "XP9={X 1}:XP9",
        "UNHEARD={X 1}",
        "$VEL.CP=FEED*2",
        "$ACC.CP=1.0",
        "$VEL_AXIS[1]=50",
        "$ORI_TYPE=#CONSTANT",
        "$ORI_TYPE=#JOINT",
        "$IPO_MODE=#TCP",
        "$ADVANCE=1",
        "$APO.CDIS=0",
        "$APO.CDIS=COUNT",
        "$CIRC_TYPE=#BASE",
        "$APO={CDIS 2.5}",
        "$LOAD=LOAD_DATA[3]",
        "$TOOL=UNHEARD",
        "$TOOL={X 1}",
        "BAS (#VEL_PTP,50)",
        "BAS (#INITMOV,0)",
        "BAS (#FRAMES)",
        "BAS (#TOOL,N)",
        "WAIT FOR $IN[3]==FALSE",
        "WAIT FOR NOT $IN[3]",
        "WAIT FOR $FLAG[3]",
        "WAIT SEC T",
        "$OUT[N]=TRUE",
        "$OUT[3]=$IN[4]",
        "UNHEARD( )",
        "ODD( )",
        "ODD_SETUP( )",
        "PULSE($OUT[3],TRUE,0.5)",
    ] {
        assert_eq!(with_line(line), (Effect::Unknown, false), "{line}");
    }
}

#[test]
fn what_is_not_krl_is_reported_with_what_was_expected() {
    for (line, expected) in [
        ("LIN {X 1,2}", "the name of a component"),
        ("LIN {X 1.2.3}", "a number"),
        ("LIN {X 1e999}", "a number"),
        ("LIN {X 1 Y 2}", "`,` or `}`"),
        ("LIN {X 1,X 2}", "each component once"),
        ("LIN {X}", "a number"),
        ("LIN {X 1", "`,` or `}`"),
        ("LIN {}", "the name of a component"),
        ("LIN {Q 1}", "X, Y, Z, A, B, C, S, T, or axes A1 to A6, E1 to E6"),
        ("LIN {A1 1}", "a pose: X, Y, Z, A, B, C"),
        ("LIN", "a target"),
        ("LIN {X 1} C_DOS", "`C_DIS` or its like, or the end of the line"),
        ("LIN UNHEARD", "a position that is declared"),
        ("PTP {A1 0,X 1}", "either a pose or axes"),
        ("PTP {A1 0}", "all components, where no target before it has them"),
        ("LINN {X 1}", "`(` or `=` after a name"),
        ("PTQ XVC_HOME", "a statement of KRL"),
        ("DECL INT N", "declarations in front of the first instruction"),
        ("EXT PART( )", "declarations in front of the first instruction"),
        ("&REL 3", "an instruction, or `END`"),
        ("DEFDAT ODD", "an instruction, or `END`"),
        ("$OUT[3]", "`=`"),
        ("$OUT[3]=", "a value"),
        ("$OUT[3]=1", "`TRUE` or `FALSE`"),
        ("WAIT", "`SEC` or `FOR` after `WAIT`"),
        ("WAIT SEC -1", "a time that is not negative"),
        ("ODD(", "`)` at the end of the line"),
        ("{X 1}", "a statement of KRL"),
        ("42", "a statement of KRL"),
        ("\u{fc}ber", "a statement of KRL"),
    ] {
        let expected = expected.to_owned();
        assert_eq!(
            with_line(line),
            (Effect::Unreadable { expected }, false),
            "{line}"
        );
    }
}

/// Replaces text that must be there.
fn changed(file: &mut ProgramFile, from: &str, to: &str) {
    assert!(file.text.contains(from), "{from}");
    file.text = file.text.replacen(from, to, 1);
}

/// Every line of the setup that is left out is missed by the first motion that needs it.
#[test]
fn what_was_not_said_is_missing() {
    let lines = [
        ("$IPO_MODE=#base", "`$IPO_MODE=#BASE` before the first motion"),
        ("$ORI_TYPE = #VAR", "`$ORI_TYPE=#VAR` before the first motion"),
        ("$ADVANCE=3", "`$ADVANCE=3` before the first motion"),
        (
            "$APO.CDIS=2.5",
            "`$APO.CDIS` before the first rounded corner, with the job's approximation",
        ),
        (
            "BAS(#VEL_PTP,10)",
            "`BAS (#VEL_PTP,n )` before the first axis move, with the job's home speed",
        ),
    ];
    let (program, options) = two_cuts();
    for (line, missing) in lines {
        let mut files = by_hand();
        changed(&mut files[0], line, "");
        let statements = statements(&files, &program, &options);
        let first = statements.iter().find_map(|statement| match &statement.effect {
            Effect::Unreadable { expected } => Some(expected.as_str()),
            _ => None,
        });
        assert_eq!(first, Some(missing));
        let divergence = replayed(&statements, &program, &options).unwrap_err();
        assert_eq!(divergence.what, DivergenceKind::NotUnderstood);
    }
}

#[test]
fn rates_of_swivel_and_twist_must_be_those_of_the_turn() {
    let (program, options) = two_cuts();
    let mut files = by_hand();
    changed(&mut files[0], "$VEL.ORI2=77.4968", "$VEL.ORI2=90");
    let statements = statements(&files, &program, &options);
    let divergence = replayed(&statements, &program, &options).unwrap_err();
    assert!(
        matches!(divergence.what, DivergenceKind::Differs(_)),
        "{divergence:?}"
    );
}

/// What is reported of a changed file, for those statements that are not KRL.
fn complaints(file: usize, change: impl Fn(&mut ProgramFile)) -> Vec<(String, String)> {
    let (program, options) = two_cuts();
    let mut files = by_hand();
    change(&mut files[file]);
    let statements = statements(&files, &program, &options);
    assert!(replayed(&statements, &program, &options).is_err());
    let complaints = statements.iter().filter_map(|statement| match &statement.effect {
        Effect::Unreadable { expected } => Some((text(&files, statement).to_owned(), expected.clone())),
        _ => None,
    });
    complaints.collect()
}

#[test]
fn modules_have_a_head_an_end_and_the_name_of_their_file() {
    let one = |text: &str, expected: &str| vec![(text.to_owned(), expected.to_owned())];
    assert_eq!(
        complaints(0, |file| changed(file, "DEF odd_setup", "DEF other")).first(),
        one("DEF other ( )", "`odd_setup`, the name of the file").first()
    );
    assert_eq!(
        complaints(2, |file| changed(file, "DEFDAT  ODD", "DEFDAT  EVEN")),
        one("DEFDAT  EVEN", "`odd`, the name of the file")
    );
    assert_eq!(
        complaints(2, |file| changed(file, "ENDDAT", "")),
        one("", "`ENDDAT`")
    );
    assert_eq!(
        complaints(1, |file| changed(file, "Wait   Sec .5", "END\nWait   Sec .5")).first(),
        one("Wait   Sec .5", "`DEF` of a routine").first()
    );
    assert_eq!(
        complaints(1, |file| changed(file, "End\r\n", "")),
        one("", "`END`")
    );
    assert_eq!(
        complaints(2, |file| file.text.push_str("DECL INT LATE")),
        one("DECL INT LATE", "nothing after `ENDDAT`")
    );
}

#[test]
fn a_routine_that_is_never_called_is_not_understood() {
    let (program, options) = two_cuts();
    let mut files = by_hand();
    files[1].text.push_str("DEF spare( )\nHALT\nEND\n");
    let statements = statements(&files, &program, &options);
    let spare: Vec<_> = statements
        .iter()
        .rev()
        .take(3)
        .map(|statement| (text(&files, statement), &statement.effect))
        .collect();
    assert_eq!(
        spare,
        [
            ("END", &Effect::Setting),
            ("HALT", &Effect::Setting),
            ("DEF spare( )", &Effect::Unknown),
        ]
    );
    assert!(replayed(&statements, &program, &options).is_err());
}

/// A variable of a routine hides that of its module, and one of the module that of all.
#[test]
fn the_nearest_variable_counts() {
    let (program, options) = two_cuts();
    let mut files = by_hand();
    changed(
        &mut files[3],
        "ENDDAT",
        "DECL GLOBAL E6POS XP_BACK={X 0}\nDECL GLOBAL E6AXIS XVC_HOME={A1 5}\nENDDAT",
    );
    let statements = statements(&files, &program, &options);
    assert!(replayed(&statements, &program, &options).is_ok());
}

/// Something like KRL: lines of words, signs and numbers in any order.
fn like_krl() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        Just("DEF "),
        Just("a"),
        Just("b"),
        Just("( )"),
        Just("END"),
        Just("\n"),
        Just("\r\n"),
        Just("LIN "),
        Just("PTP "),
        Just("{X 1.5,Y 2"),
        Just("}"),
        Just("{"),
        Just(","),
        Just("XP"),
        Just("="),
        Just("DECL E6POS "),
        Just("$OUT[3]"),
        Just("TRUE"),
        Just("BAS (#INITMOV,0 )"),
        Just(";"),
        Just("\""),
        Just("'B1"),
        Just("1e308"),
        Just("99999999999"),
        Just("."),
        Just("GLOBAL "),
        Just("DEFDAT a PUBLIC"),
        Just("ENDDAT"),
        Just("&"),
        Just("WAIT FOR $IN[1]"),
        Just("-"),
        Just("DEFFCT "),
        Just("C_DIS"),
        Just("["),
        Just("]"),
        Just("\u{e4}"),
        Just("\t"),
    ];
    proptest::collection::vec(word, 0..120).prop_map(|words| words.concat())
}

/// Every line gives one statement at most, and every file one more for an end that is missing.
fn is_bounded(files: &[ProgramFile]) -> Result<(), TestCaseError> {
    let (program, options) = two_cuts();
    let statements = statements(files, &program, &options);
    let lines: usize = files.iter().map(|file| file.text.split('\n').count()).sum();
    let heads: usize = files
        .iter()
        .map(|file| file.text.to_uppercase().matches("DEF").count())
        .sum();
    prop_assert!(
        statements.len() <= lines + heads,
        "{} of {lines} lines",
        statements.len()
    );
    for statement in &statements {
        prop_assert!(
            files[statement.place.file as usize]
                .text
                .is_char_boundary(statement.place.end as usize)
        );
        let _ = text(files, statement);
    }
    let mut places: Vec<_> = statements
        .iter()
        .map(|statement| statement.place)
        .filter(|place| place.start < place.end)
        .collect();
    places.sort_unstable();
    prop_assert!(places.windows(2).all(|pair| pair[0] != pair[1]), "reported twice");
    Ok(())
}

proptest! {
    #[test]
    fn any_bytes_come_to_an_end(source in any::<Vec<u8>>(), data in any::<Vec<u8>>()) {
        is_bounded(&[file("a.src", &source), file("a.dat", &data)])?;
    }

    #[test]
    fn anything_like_krl_comes_to_an_end(a in like_krl(), b in like_krl(), data in like_krl()) {
        is_bounded(&[file("a.src", a.as_bytes()), file("b.src", b.as_bytes()), file("a.dat", data.as_bytes())])?;
    }
}

#[test]
fn routines_that_call_themselves_and_long_rows_of_calls_come_to_an_end() {
    let circle = file("a.src", b"DEF a( )\nb( )\nEND\nDEF b( )\na( )\nb( )\nEND\n");
    is_bounded(&[circle]).unwrap();
    let row: String = (0..20_000)
        .map(|n| format!("DEF r{n}( )\nr{}( )\nr{}( )\nEND\n", n + 1, n + 2))
        .collect();
    is_bounded(&[file("r0.src", row.as_bytes())]).unwrap();
}

#[test]
fn long_and_deep_lines_come_to_an_end() {
    for line in [
        "{A ".repeat(100_000),
        format!("X={}", "{CM {Q ".repeat(50_000)),
        format!("LIN {{X {}}}", "9".repeat(200_000)),
        format!("LIN {{X 0.{}}}", "0".repeat(200_000)),
        "[".repeat(100_000),
        "\"".repeat(99_999),
        "-".repeat(100_000),
    ] {
        is_bounded(&[file("a.src", format!("DEF a( )\n{line}\nEND").as_bytes())]).unwrap();
    }
}
