//! Whatever stands in a file, reading it ends, reports every line at most once, and says what it does not
//! understand.

use crate::read_back::replayed;
use crate::support::{DIALECTS, emit, needed, options, reachable, recipe};
use proptest::prelude::*;
use vcutc_backend_api::backend::OptionValue;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Effect, ProgramFile, program_files};
use vcutc_backend_api::testkit::Recipe;

fn sample() -> ReachableProgram {
    let one_cut = Recipe {
        layers: 1,
        cuts: 2,
        ..recipe()
    };
    reachable(one_cut.program())
}

/// Text made of what the dialects are made of.
fn scraps() -> impl Strategy<Value = String> {
    let scrap = prop_oneof![
        prop::sample::select(vec![
            "G",
            "M",
            "X",
            "N",
            "O",
            "o<",
            ">",
            " sub",
            " call",
            " endsub",
            "%",
            "(",
            ")",
            ";",
            "\n",
            "\r\n",
            " ",
            "=",
            "[",
            "]",
            "$A_OUT",
            "IF",
            "GOTOB",
            ":",
            "FUNCTION ",
            "TCPM ",
            "CALL PGM ",
            "BEGIN PGM ",
            " MM",
            "L ",
            "R0",
            "F",
            "FMAX",
            "M98 P",
            "CYCL DEF ",
            "9.0",
            "TRAORI",
            "SUPA",
            "ADIS",
            "FGROUP(",
            "X=AC(",
            "CIP ",
            "I1=",
            "G2",
            "CC ",
            "C ",
            "DR",
            "32.1 T",
            "A3",
            "-",
            "+",
            ".",
            "1",
            "99",
            "43.4",
            "999999999999999999999999999999999999999999",
            "sample",
            "SAMPLE_P001",
            "\u{e4}",
            "\u{0}",
        ])
        .prop_map(str::to_owned),
        any::<char>().prop_map(String::from),
    ];
    prop::collection::vec(scrap, 0..120).prop_map(|scraps| scraps.concat())
}

fn is_bounded(program: &ReachableProgram, dialect: &'static str, files: &[ProgramFile]) {
    let (_, statements) = replayed(program, files, &options(&needed(dialect)));
    let lines: usize = files
        .iter()
        .map(|file| file.text.split(['\n', '\r']).count())
        .sum();
    // One more at the end of each file that is not ended.
    assert!(statements.len() <= lines + files.len(), "{dialect}");
    for statement in &statements {
        let place = statement.place;
        let text = files[place.file as usize]
            .text
            .get(place.start as usize..place.end as usize);
        assert!(text.is_some(), "{dialect} {statement:?}");
        if let Effect::Unreadable { expected } = &statement.effect {
            assert!(!expected.is_empty());
        }
    }
}

proptest! {
    #[test]
    fn scraps_of_programs(texts in prop::collection::vec(scraps(), 0..4)) {
        let program = sample();
        let names = ["sample.ngc", "sample_p001.ngc", "sample_p002.H", "x"];
        let files: Vec<ProgramFile> = texts
            .into_iter()
            .zip(names)
            .map(|(text, name)| ProgramFile { name: name.to_owned(), text })
            .collect();
        for dialect in DIALECTS {
            is_bounded(&program, dialect, &files);
        }
    }

    #[test]
    fn programs_with_scraps_in_them(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0..40_usize, scraps()), 1..4),
        order in any::<bool>(),
    ) {
        let program = sample();
        for dialect in DIALECTS {
            let mut files = program_files(&emit(&program, dialect, &[("lines_per_part", OptionValue::Integer(10))]));
            for (at, length, scrap) in &cuts {
                let file = at.index(files.len());
                let text = &mut files[file].text;
                let from = at.index(text.len());
                let to = (from + length).min(text.len());
                if text.is_char_boundary(from) && text.is_char_boundary(to) {
                    text.replace_range(from..to, scrap);
                }
            }
            if order {
                files.reverse();
            }
            is_bounded(&program, dialect, &files);
        }
    }
}

/// Parts that call each other in a circle, and one that calls itself, are each carried out once.
#[test]
fn circles_of_parts_end() {
    let program = sample();
    let file = |name: &str, text: &str| ProgramFile {
        name: name.to_owned(),
        text: text.to_owned(),
    };
    for (dialect, files) in [
        (
            "linuxcnc",
            vec![
                file("a.ngc", "o<b> call\nM2\n"),
                file("b.ngc", "o<b> sub\no<a> call\no<b> call\no<b> endsub\n"),
            ],
        ),
        (
            "fanuc",
            vec![
                file("a.nc", "%\nO1\nM98 P2\nM30\n%"),
                file("b.nc", "%\nO2\nM98 P1\nM99\n%"),
            ],
        ),
        (
            "sinumerik",
            vec![file("AA.MPF", "BB\nM30"), file("BB.SPF", "AA\nBB\nM17")],
        ),
        (
            "heidenhain",
            vec![
                file("A.H", "0 BEGIN PGM A MM\n1 CALL PGM B\n2 END PGM A MM"),
                file("B.H", "0 BEGIN PGM B MM\n1 CALL PGM A\n2 END PGM B MM"),
            ],
        ),
    ] {
        is_bounded(&program, dialect, &files);
        let (result, statements) = replayed(&program, &files, &options(&needed(dialect)));
        assert!(result.is_err(), "{dialect}");
        let calls = statements
            .iter()
            .filter(|statement| statement.effect == Effect::PartBegins);
        assert_eq!(calls.count(), 1, "{dialect}");
    }
}
