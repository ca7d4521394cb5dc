//! Programs as people write and edit them: another layout is the same program, and another meaning never is.

use crate::read_back::replayed;
use crate::support::{DIALECTS, Given, emit, needed, options, reachable, recipe, rounds};
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Divergence, DivergenceKind, Mismatch, Place, ProgramFile, program_files};
use vcutc_backend_api::testkit::{CellRecipe, Recipe, five_axis_samples};
use vcutc_backend_api::units::{Duration, Length};

/// The program of the snapshots.
pub(crate) fn one_cut() -> ReachableProgram {
    let recipe = Recipe {
        name: "Rib 12".to_owned(),
        layers: 1,
        cuts: 1,
        dwell: Some(Duration::s(0.25)),
        ..recipe()
    };
    reachable(recipe.program())
}

fn read(dialect: &'static str, name: &str, text: &str) -> Result<Vec<Place>, Divergence> {
    let files = [ProgramFile {
        name: name.to_owned(),
        text: text.to_owned(),
    }];
    replayed(&one_cut(), &files, &options(&needed(dialect))).0
}

#[test]
fn linuxcnc_in_small_letters_without_blanks_and_words_that_stay() {
    let text = "%\nn5 m428 (identity)\ng49\ng90g21 g17\tg54 g61.1\n/\n".replace("/\n", "")
        + "g93 g53 g1 x0y0z900a0b0f.006\n\
           g4p.25 ; a moment\n\
           g53 f5.470745 b-34.16 a-30 x-272.316 y263.964 z461.303\n\
           m64p12\n\
           g4 p0.50\n\
           g43 h1\n\
           m429\n\
           g94\n\
           x3.82 (over ; here) y-15.858 z60 f30000\n\
           z45.6\n\
           x-.475 y66.102 f12000\n\
           g93\n\
           b34.16 a30 f61.052133\n\
           g94 x3.820 y-15.858 f12000.\n\
           z60 f30000\n\
           m65 p12\n\
           m428\n\
           g93 g53 x0y0z900a0b0f5.470745\n\
           m30\n\
           %\n";
    assert_eq!(
        read("linuxcnc", "rib_12.ngc", &text).map(|found| found.len()),
        Ok(13)
    );
}

#[test]
fn fanuc_with_numbers_and_shorter_words() {
    let text = "%\r\nO1\r\nN10G21G90G17G94\r\nN20G61G54\r\nN30G49\r\n\
        N40G53G0X0.Y0.Z900.B0.A0.\r\nN50G04P250\r\n\
        N60G0G53X-272.316Y263.964Z461.303B-34.16A-30.\r\nN70M50(ON)\r\nN80G4X.5\r\n\
        N90G43.4H01\r\nN100G01X3.82Y-15.858Z60.F30000\r\nN110G1Z45.6\r\nN120X-.475Y66.102F12000\r\n\
        N130G93\r\nN140B34.16A30.F61.052\r\nN150G94X3.82Y-15.858F12000\r\nN160Z60.F30000\r\n\
        N170M51\r\nN180G49\r\nN190G53G0X0.Y0.Z900.B0.A0.\r\nN200M2\r\n%";
    assert_eq!(
        read("fanuc", "anything.nc", text).map(|found| found.len()),
        Ok(13)
    );
}

#[test]
fn sinumerik_with_equals_signs_and_small_letters() {
    let text = "N1 trafoof g90 g710\nN2 g60 g54\nN3 g93\n\
        supa g1 x=0 y=0 z=900 a=0 b=AC(0) f=0.006 d0\n\
        g4 f=.25\n\
        supa x-272.316 y=263.964 z461.303 b-34.16 a-30 f5.470745 d0\n\
        stopre ; now\n$a_out[12] = 1\ng4 f0.5\n\
        traori\nfgroup(z, x, y) oriaxes\norimks d1 g94\n\
        x3.82 y-15.858 z60 f30000\nz45.6\ng1 x-0.475 y66.102 f12000\n\
        g93\nb34.16 a30 f61.052133\ng94 x3.82 y-15.858 f12000\nz60 f30000\n\
        stopre\n$A_OUT[12]=0\ntrafoof\ng93\nsupa x0 y0 z900 a0 b0 f5.470745 d0\nm2\n";
    assert_eq!(
        read("sinumerik", "RIB_12.MPF", text).map(|found| found.len()),
        Ok(13)
    );
}

#[test]
fn heidenhain_with_words_that_stay() {
    let text = "0  BEGIN PGM RIB_12 MM\n1  * - the head\n2  M127\n3  TOOL CALL 1 Z\n4 FUNCTION RESET TCPM\n\
        5 L X0 Y0 Z900 B0 A0 R0 F515.662 M91\n\
        6 CYCL DEF 9.0 DWELL TIME\n7 CYCL DEF 9.1 DWELL .25\n\
        8 L X-272.316 Y+263.964 Z+461.303 B-34.16 A-30 F3182.238 M91\n9 M50\n\
        10 CYCL DEF 9.0 DWELL TIME\n11 CYCL DEF 9.1 DWELL 0.50\n\
        12 function tcpm f tcp axis pos pathctrl axis\n\
        13 L X+3.82 Y-15.858 Z+60 F30000\n14 L Z+45.6\n15 L Y+66.102 X-0.475 F12000\n\
        16 FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS\n17 L A+30 B+34.16 F5551.254\n\
        18 FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n19 L X+3.82 Y-15.858 F12000\n20 L Z+60 F30000\n\
        21 M51 ; off\n22 FUNCTION RESET TCPM\n23 L X+0 Y+0 Z+900 B+0 A+0 F3273.088 M91\n24 END PGM RIB_12 MM\n";
    assert_eq!(
        read("heidenhain", "RIB_12.H", text).map(|found| found.len()),
        Ok(13)
    );
}

/// The text of the place where a mutant departs.
pub(crate) fn departs(
    dialect: &'static str,
    more: &[Given],
    edit: impl Fn(&str) -> String,
) -> (String, DivergenceKind) {
    let program = one_cut();
    let mut files = program_files(&emit(&program, dialect, more));
    files[0].text = edit(&files[0].text);
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    let divergence = match replayed(&program, &files, &options(&given)).0 {
        Err(divergence) => divergence,
        Ok(_) => panic!("{dialect} passes:\n{}", files[0].text),
    };
    let place = divergence.place;
    let text = place.map(|place| files[0].text[place.start as usize..place.end as usize].to_owned());
    (text.unwrap_or_default(), divergence.what)
}

/// Each block stands before the first cut, and is where the program departs, or the cut is.
#[test]
fn what_no_program_has_is_not_understood() {
    let foreign = [
        (
            "linuxcnc",
            vec![
                "G91",
                "G20",
                "G95",
                "G64",
                "G64 P1",
                "G61",
                "G2 X1 Y1 I1",
                "G90.1",
                "G92 X0",
                "G10 L2 P1 X0",
                "G52 X1",
                "G68 R5",
                "G0 X1 Y1 Z1",
                "G55",
                "G43 H2",
                "G41 D1",
                "M0",
                "M3 S100",
                "M6 T2",
                "M62 P12",
                "M66 P7 L3 Q86400",
                "M66 P7 L3 Q5",
                "M66 P7 L4 Q86400",
                "#1=5",
                "X#1",
                "X[1+1]",
                "o100 while [1]",
                "o<x> call",
                "/G1 X1",
                "G28",
                "G53 G1 X0 F1",
                "(abort, x)",
                "G4 P-1",
                "M2",
                "G1 X1 X2",
                "Q1",
                "G1 Z46 F0",
                "G1 X1 M64 P3",
                "M64 P3 G4 P1",
                "G90 G91",
                "G1.5 X1",
                "F100 M429",
                "M64",
                "G43.4 H1",
                "S1000",
                "é",
                "; on the way\rG1 X8.7 F12000",
                "(on\rthe way)",
                "(on (the) way)",
                "(on the way",
                "G1 X8.7 % F12000",
                "(\u{0})",
                "; \u{c}",
            ],
        ),
        (
            "fanuc",
            vec![
                "G91",
                "G20",
                "G64",
                "G02 X1. Y1. I1.",
                "G92 X0.",
                "G68.2 X0. Y0. Z0. I0. J0. K0.",
                "G43.5 H1",
                "G43 H1",
                "G43.4 H2",
                "G5.1 Q1",
                "G1 X10",
                "G54.1 P1",
                "M98 P9",
                "M99",
                "M6",
                "M50 M51",
                "G0 X1.",
                "G53 G0 X0. Y0. Z0. A0. B0.",
                "%",
                "O2",
                "#100=1",
                "G4 X1",
                "M30",
                "G41 D1",
                "G9",
                "; G0 Z-20.",
                "G1 X8. F100. ; G0 Z-20.",
                "(on; the way)",
                "(on (the) way)",
                "(on\rthe way)",
            ],
        ),
        (
            "sinumerik",
            vec![
                "G91",
                "G70",
                "G71",
                "G64",
                "G641 ADIS=1",
                "G642",
                "ADIS=1",
                "ORIVECT",
                "ORIWKS",
                "FGROUP(X,Y,Z,A,B)",
                "TRANS X1",
                "G2 X1 Y1 I1",
                "CIP X1 Y1 Z1",
                "A3=0",
                "X=IC(1)",
                "B=DC(10)",
                "X=R1",
                "R1=5",
                "$A_OUT[12]=0",
                "CYCLE832(0.1)",
                "SPOS=45",
                "D2",
                "G500",
                "L100",
                "MCALL",
                "STOPRE G1 X1",
                "READY1: IF $A_IN[7]==FALSE GOTOB READY2",
                "GOTOF END",
                "M0",
                "SUPA G1 X0 F1 D0",
                "G4 S1",
                "NO_SUCH_PART",
                "(on the way)",
                "; on the way\rG1 X8.7 F12000",
            ],
        ),
        (
            "heidenhain",
            vec![
                "L IX+1 F100",
                "L X+1 RL F100",
                "L X+1 FMAX",
                "CC X+0",
                "CYCL DEF 32.0 TOLERANCE",
                "CYCL DEF 32.1 T0.1",
                "C X+1 Y+1 DR+",
                "M126",
                "M128",
                "TOOL CALL 2 Z",
                "LBL 1",
                "CALL LBL 1 REP 5",
                "Q1=5",
                "L X+Q1",
                "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS",
                "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR",
                "CYCL DEF 7.0 DATUM",
                "CYCL DEF 9.1 DWELL 1",
                "CALL PGM OTHER",
                "STOP",
                "M91",
                "L X+0 M91",
                "FN 20: WAIT FOR I7==0",
                "END PGM OTHER MM",
                "LN X+0 TX+1",
                "L X+1 M3 M8 M9",
                "M30",
                "(on the way)",
                "* on the way\r17 L X+8.7 F12000",
            ],
        ),
    ];
    for (dialect, blocks) in foreign {
        for block in blocks {
            let before_the_cut = |text: &str| {
                let at = text.find("F12000").unwrap();
                let line = text[..at].rfind('\n').unwrap() + 1;
                format!("{}{block}\n{}", &text[..line], &text[line..])
            };
            let (text, what) = departs(dialect, &[], before_the_cut);
            // An early end shows in what follows it, a state in the first motion that depends on it.
            let ends = matches!(block, "M2" | "M30");
            let shows = block.contains(text.as_str()) || text.contains("12000");
            assert!(
                !text.is_empty() && (shows || ends),
                "{dialect} {block}: {text:?} {what:?}"
            );
        }
    }
}

/// A state that is missing or wrong shows where it counts.
#[test]
fn a_state_that_was_not_set_shows() {
    for (dialect, gone) in [
        (
            "linuxcnc",
            vec![
                "G90",
                "G21",
                "G61.1\n",
                "G54\n",
                "G43 H1\n",
                "M429\n",
                "M428\n",
                "G94\nG1",
                "G93\n",
                "M64 P12\n",
                "M2\n",
            ],
        ),
        (
            "fanuc",
            vec![
                "G90",
                "G21",
                "G61\n",
                "G54\n",
                "G43.4 H1\n",
                "G49\n",
                "G93\n",
                "M50\n",
                "M30\n",
                "O0001",
            ],
        ),
        (
            "sinumerik",
            vec![
                "G90",
                "G710",
                "G60",
                "G54\n",
                "TRAORI\n",
                "TRAFOOF\n",
                "ORIAXES",
                "ORIMKS",
                "FGROUP(X,Y,Z)\n",
                "D1\n",
                " D0",
                "G93\n",
                "STOPRE\n",
                "M30\n",
            ],
        ),
        (
            "heidenhain",
            vec![
                "BEGIN PGM RIB_12 MM",
                "TOOL CALL 1 Z\n",
                "M127\n",
                "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n",
                "FUNCTION RESET TCPM\n",
                " M91",
                "M50\n",
                "CYCL DEF 9.0 DWELL TIME\n",
            ],
        ),
    ] {
        for gone in gone {
            // Without the words, but not without the line: Heidenhain's number stays.
            let left = if gone.ends_with('\n') { "\n" } else { "" };
            let _ = departs(dialect, &[], |text| {
                assert!(text.contains(gone), "{dialect} {gone}\n{text}");
                text.replacen(gone, left, 1)
            });
        }
    }
}

/// Frames by number are the machine's, also where a block says one and moves at once.
#[test]
fn tools_and_work_offsets_are_those_of_the_machine() {
    let samples = five_axis_samples().unwrap();
    let (_, program) = samples.iter().find(|(name, _)| *name == "numbered_cell").unwrap();
    for (dialect, said, other) in [
        ("linuxcnc", "G55\n", "G54\n"),
        ("linuxcnc", "\nG1 X", "\nG54 G1 X"),
        ("linuxcnc", "G43 H3", "G43 H1"),
        ("fanuc", "G55\n", "G56\n"),
        ("fanuc", "\nG1 X", "\nG54 G1 X"),
        ("fanuc", "G43.4 H3", "G43.4 H1"),
        ("sinumerik", "G55\n", "G505\n"),
        ("sinumerik", "\nG1 X", "\nG54 G1 X"),
        ("sinumerik", "\nD3", "\nD1"),
        ("heidenhain", "TOOL CALL 3 Z", "TOOL CALL 1 Z"),
    ] {
        let options = options(&needed(dialect));
        let mut files = program_files(&emit(program, dialect, &[]));
        assert!(replayed(program, &files, &options).0.is_ok(), "{dialect}");
        assert!(files[0].text.contains(said), "{dialect} {said}");
        files[0].text = files[0].text.replacen(said, other, 1);
        assert!(
            replayed(program, &files, &options).0.is_err(),
            "{dialect} {other}"
        );
    }
}

/// The first move of all axes comes from nowhere, the second from home, the third from behind the cut.
#[test]
fn moves_of_all_axes_keep_to_the_home_speed() {
    for (dialect, said, other) in [
        ("linuxcnc", "F0.006", "F0.06"),
        (
            "linuxcnc",
            "B-34.1600 A-30.0000 F5.470745",
            "B-34.1600 A-30.0000 F5.5",
        ),
        ("linuxcnc", "B0.0000 A0.0000 F5.470745", "B0.0000 A0.0000 F90"),
        ("sinumerik", "F0.006", "F0.06"),
        (
            "sinumerik",
            "B-34.1600 A-30.0000 F5.470745",
            "B-34.1600 A-30.0000 F5.5",
        ),
        ("heidenhain", "F515.662", "F520"),
        ("heidenhain", "F3182.238", "F3200"),
    ] {
        let (_, what) = departs(dialect, &[], |text| {
            assert!(text.contains(said), "{dialect} {said}\n{text}");
            text.replacen(said, other, 1)
        });
        assert_eq!(what, DivergenceKind::NotUnderstood, "{dialect} {other}");
    }
}

#[test]
fn rounding_is_that_of_the_job() {
    let two = [("approximation", OptionValue::Length(Length::mm(2.0)))];
    for (dialect, said, other) in [
        ("linuxcnc", "G64 P2.0 Q0", "G64 P2.0"),
        ("linuxcnc", "G64 P2.0 Q0", "G64 P0 Q0"),
        ("sinumerik", "G641 ADIS=2.0", "G641 ADIS=0"),
    ] {
        let (text, what) = departs(dialect, &two, |text| text.replacen(said, other, 1));
        assert_eq!((text.as_str(), what), (other, DivergenceKind::NotUnderstood));
    }
    // Another distance belongs to a chain, and these moves are not one.
    for (dialect, said, other) in [
        ("linuxcnc", "G64 P2.0 Q0", "G64 P3.0 Q0"),
        ("linuxcnc", "G64 P2.0 Q0", "G64 P0.2 Q0"),
        ("sinumerik", "G641 ADIS=2.0", "G641 ADIS=20"),
    ] {
        let (_, what) = departs(dialect, &two, |text| text.replacen(said, other, 1));
        assert_eq!(what, DivergenceKind::Differs(vec![Mismatch::NoStop]), "{other}");
    }
    for dialect in DIALECTS.into_iter().filter(|dialect| rounds(dialect)) {
        // Rounding that is not ended before the blade enters.
        let exact = ["\nG61.1\nG1", "\nG60\nG1"];
        let (_, what) = departs(dialect, &two, |text| {
            exact
                .iter()
                .fold(text.to_owned(), |text, exact| text.replacen(exact, "\nG1", 1))
        });
        assert!(matches!(what, DivergenceKind::Differs(_)), "{dialect} {what:?}");
    }
}

/// A preset that the job numbers is activated by the program, in every file, and no other one passes.
#[test]
fn heidenhain_activates_the_preset_of_the_base() {
    let five_axis = CellRecipe::five_axis();
    let base = PlacedFrame {
        number: Some(3),
        ..five_axis.base
    };
    let recipe = Recipe {
        cell: CellRecipe { base, ..five_axis },
        ..recipe()
    };
    let program = reachable(recipe.program());
    let more = [("lines_per_part", OptionValue::Integer(20))];
    let files = program_files(&emit(&program, "heidenhain", &more));
    assert!(files.len() > 1);
    let block = "CYCL DEF 247 DATUM SETTING ~\n  Q339=+3 ;DATUM NUMBER\n";
    for file in &files {
        assert_eq!(file.text.matches(block).count(), 1, "{}", file.text);
    }
    let given = needed("heidenhain").into_iter().chain(more);
    let options = options(&given.collect::<Vec<_>>());
    let read = |edit: &dyn Fn(&str) -> String| {
        let mut files = files.clone();
        files[1].text = edit(&files[1].text);
        replayed(&program, &files, &options).0
    };
    assert_eq!(read(&str::to_owned).map(|_| ()), Ok(()));
    for (from, to) in [
        ("Q339=+3", "Q339=+4"),
        ("Q339=+3", "Q339=-3"),
        ("Q339=+3", "Q339=+3 Q340=+1"),
        ("DATUM SETTING ~", "DATUM SETTING"),
        ("  Q339=+3 ;DATUM NUMBER\n", ""),
        ("247", "248"),
    ] {
        assert!(files[1].text.contains(from));
        assert!(read(&|text| text.replacen(from, to, 1)).is_err(), "{to}");
    }
    let without = |text: &str| {
        let lines = text
            .lines()
            .filter(|line| !line.contains("247") && !line.contains("Q339"));
        lines.map(|line| format!("{line}\n")).collect()
    };
    assert!(read(&without).is_err());
}
