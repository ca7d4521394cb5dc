//! What cannot be converted, what is left out, and what is said of it.

use super::posts::{PASSES, Post, Raster, Style, Zero};
use super::{WORDS, paper, request};
use vcutc::convert::asked::Words;
use vcutc::convert::convert;
use vcutc::diagnostics::source::SourceMap;
use vcutc::diagnostics::{Code, Diagnostic, has_errors, render};
use vcutc_backend_api::readback::ProgramFile;

fn program() -> String {
    written(&paper())
}

fn written(raster: &Raster) -> String {
    let post = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    };
    let files = post.write(raster);
    files[0].text.replace("\r\n", "\n").replace(" C_DIS ; cut", "")
}

fn refused(text: &str, words: Words<'_>) -> (Vec<Diagnostic>, SourceMap) {
    let files = [ProgramFile {
        name: "raster.src".to_owned(),
        text: text.to_owned(),
    }];
    let asked = words.asked().unwrap();
    match convert(request(&files, &asked)) {
        Ok(conversion) => (conversion.warnings, conversion.sources),
        Err(refused) => (refused.diagnostics, refused.sources),
    }
}

/// A pass in the middle of the first row.
const PASS: &str = "LIN {X 30.560,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0}\n";

/// A program with the numbers after a word, such as `,Z `, so much larger.
fn moved(program: &str, word: &str, by: f64) -> String {
    let mut parts = program.split(word);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (number, rest) = part.split_at(part.find([',', '}']).unwrap());
        out += &format!("{word}{:.3}{rest}", number.parse::<f64>().unwrap() + by);
    }
    out
}

/// The program with its zero so much higher, in mm.
fn lowered(by: f64) -> String {
    moved(&program(), ",Z ", -by)
}

/// The program over the left half of a blank, which may have its zero at its edge, or in the middle of a blank twice as wide.
fn on_one_half() -> String {
    let mut raster = paper();
    for (_, columns) in &mut raster.rows {
        columns.retain(|&x| x < 40.0);
    }
    written(&raster)
}

/// The upper half of the program, with the zero at half the height of the blank.
fn half_way() -> String {
    let mut raster = paper();
    raster.rows.retain(|(z, _)| *z > 26.0);
    moved(&written(&raster), ",Z ", -25.0)
}

/// What is written in the place of that pass, or how the whole program changes, and what is then wrong.
fn cases() -> Vec<(&'static str, String, Words<'static>, Code)> {
    let instead = |line: &str| program().replacen(PASS, &format!("{line}\n"), 1);
    vec![
        (
            "an arc",
            instead("CIRC {X 30,Y 20,Z 45},{X 30.560,Y -3.000,Z 45.600}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a lean",
            instead("LIN {X 30.560,Y -3.000,Z 45.600,A 0.0,B 80.0,C 0.0}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a speed on one of two ways through the program",
            instead(&format!("IF $IN[1] THEN\n$VEL.CP=0.1\nENDIF\n{PASS}")),
            WORDS,
            Code::Unclear,
        ),
        (
            "another tool axis",
            instead("LIN {X 30.560,Y -3.000,Z 45.600,A 0.0,B 0.0,C 0.0}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a diagonal",
            instead("LIN {X 36.530,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a slope",
            instead("LIN {X 30.560,Y -3.000,Z 41.600,A 0.0,B 90.0,C 0.0}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a cut across",
            instead("LIN {X 30.560,Y 25.0,Z 45.600}\nLIN {X 32.560,Y 25.0}\nLIN {Y -3.0}\nLIN {X 30.560}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a pass that ends early",
            instead("LIN {X 30.560,Y 25.000,Z 45.600}\nLIN {Z 60}\nLIN {Y -3}\nLIN {Z 45.6}"),
            WORDS,
            Code::NoPass,
        ),
        (
            "a blank that is deeper than the passes are long",
            program(),
            Words {
                stock: "85x60x50",
                ..WORDS
            },
            Code::NoPass,
        ),
        (
            "a name that is nowhere",
            instead("LIN XP_CORNER"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a loop",
            instead(&format!("FOR I=1 TO 3\n{PASS}ENDFOR")),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "another base between passes",
            instead(&format!("$BASE={{X 0,Y 0,Z -10,A 0,B 0,C 0}}\n{PASS}")),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "another tool between passes",
            instead(&format!("BAS(#TOOL,2)\n{PASS}")),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a point that was changed where it may not have been",
            instead("IF $IN[1] THEN\nXP1.Z=42.0\nENDIF\nLIN XP1").replacen(
                "\nLIN {X 6",
                "\nDECL E6POS XP1={X 30.560,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0}\nLIN {X 6",
                1,
            ),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a routine with arguments",
            instead(&format!("ROW(3.0)\n{PASS}")) + "\nDEF ROW(Q:IN)\nLIN {Z 20.0}\nEND\n",
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a jump",
            instead(&format!("GOTO AWAY\n{PASS}")),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a motion with a speed of its own",
            instead(
                "SLIN {X 30.560,Y -3.000,Z 45.600} WITH $VEL=SVEL_CP(0.1, , LCPDAT1), $ACC=SACC_CP(LCPDAT1) C_SPL",
            ),
            WORDS,
            Code::Unclear,
        ),
        (
            "a speed for the segments of a spline block",
            instead(&format!("SPLINE WITH $VEL=SVEL_CP(0.1)\nS{PASS}ENDSPLINE\n")),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a motion with an output of its own",
            instead("SLIN {X 30.560,Y -3.000,Z 45.600} WITH $OUT[1]=TRUE"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a motion with a base of its own",
            instead("SLIN {X 30.560,Y -3.000,Z 45.600} WITH $BASE=SBASE(FP7.BASE_NO)"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a base by the data of a point",
            instead(&format!(
                "FDAT_ACT={{TOOL_NO 2,BASE_NO 1,IPO_FRAME #BASE}}\nBAS(#FRAMES)\n{PASS}"
            )),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a relative motion from nowhere",
            program().replacen(
                "$VEL.CP=1.0\n",
                "$VEL.CP=1.0\nLIN_REL {X 0.0,Y 0.0,Z -100.0} #BASE\n",
                1,
            ),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "frames that are joined",
            instead("LIN OFFSET:XP1"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "an arc that goes round by an angle from nowhere",
            program().replacen(
                "$VEL.CP=1.0\n",
                "$VEL.CP=1.0\nCIRC {X 1,Y 0,Z 70},{X 2,Y 0,Z 60}, CA 180\n",
                1,
            ),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a turntable that turns",
            instead(&PASS.replace("C 0.0}", "C 0.0,E1 250.0}")),
            WORDS,
            Code::ExternalAxis,
        ),
        (
            "a routine whose file is missing",
            instead(&format!("SPINDLE_ON(12000)\n{PASS}")),
            WORDS,
            Code::MissingRoutine,
        ),
        (
            "a routine that nobody calls",
            program() + "DEF SPARE( )\nLIN {Z 20.0}\nEND\n",
            WORDS,
            Code::LeftOut,
        ),
        (
            "motions behind the end",
            program() + "LIN {Z 20.0}\n",
            WORDS,
            Code::UnreadableStatement,
        ),
        ("no end", program().replace("END\n", ""), WORDS, Code::NotWhole),
        (
            "an end in the middle of a statement",
            program().split_inclusive(',').take(200).collect(),
            WORDS,
            Code::UnreadableStatement,
        ),
        (
            "passes on both sides of zero",
            lowered(15.3),
            WORDS,
            Code::Unclear,
        ),
        (
            "a pass below the blank",
            lowered(15.3),
            Words {
                origin: Some("0,0,0"),
                ..WORDS
            },
            Code::NoPass,
        ),
        (
            "a pass that only skims the blank",
            program().replacen(
                "$VEL.CP=0.2\n",
                "$VEL.CP=0.2\nLIN {Z 50.0}\nLIN {Y 53.0}\nLIN {Y -3.0}\n",
                1,
            ),
            WORDS,
            Code::AboveBlank,
        ),
        (
            "a speed that changes within a pass",
            program().replacen(
                PASS,
                &format!("LIN {{X 30.560,Y 25.0,Z 45.600}}\n$VEL.CP=0.1\n{PASS}"),
                1,
            ),
            WORDS,
            Code::Unclear,
        ),
        (
            "noise",
            program().replacen(PASS, &format!("LIN {{X 30.590,Y 25.0,Z 45.590}}\n{PASS}"), 1),
            WORDS,
            Code::NoPass,
        ),
        (
            "interrupts",
            program().replacen(
                "$VEL.CP=1.0\n",
                "GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM ( )\nINTERRUPT ON 3\n$VEL.CP=1.0\n",
                1,
            ),
            WORDS,
            Code::LeftOut,
        ),
        (
            "no motion before the first",
            "DEF a( )\nLIN {Y 5}\nEND\n".to_owned(),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a routine that calls itself",
            "DEF a( )\na( )\nEND\n".to_owned(),
            WORDS,
            Code::NotFollowed,
        ),
        ("no text", String::new(), WORDS, Code::NothingToConvert),
        (
            "nothing in it",
            "DEF a( )\nEND\n".to_owned(),
            WORDS,
            Code::NothingToConvert,
        ),
        (
            "passes above the blank",
            program(),
            Words {
                stock: "85x50x10",
                ..WORDS
            },
            Code::NothingToConvert,
        ),
        (
            "a zero that is nowhere",
            moved(&program(), "{X ", 300.0),
            WORDS,
            Code::Unclear,
        ),
        (
            "a zero far above",
            program().replace("Z 4", "Z -9").replace("Z 3", "Z -8"),
            WORDS,
            Code::Unclear,
        ),
        (
            "no speed",
            program()
                .replace("$VEL.CP=0.2\n", "")
                .replace("$VEL.CP=1.0\n", ""),
            WORDS,
            Code::Unclear,
        ),
        (
            "two speeds",
            instead(&format!("$VEL.CP=0.1\n{PASS}")),
            WORDS,
            Code::Unclear,
        ),
        (
            "a speed of an unknown unit",
            program().replace("CP=0.2", "CP=200"),
            WORDS,
            Code::Unclear,
        ),
        (
            "a speed in no unit",
            program().replace("CP=0.2", "CP=1e300"),
            WORDS,
            Code::Unclear,
        ),
        (
            "a speed that is worked out",
            instead(&format!("$VEL.CP=CUTTING\n{PASS}")),
            WORDS,
            Code::Unclear,
        ),
        (
            "no safe plane",
            program().replace("Z 60.000", "Z 50.000"),
            WORDS,
            Code::Unclear,
        ),
        (
            "text that is no program",
            instead("LIN {X 30.560,Y"),
            WORDS,
            Code::UnreadableStatement,
        ),
        (
            "a hole beside the passes",
            instead(&format!(
                "LIN {{Z 60.0}}\nLIN {{X 33.5,Y 25.0,Z 60.0}}\nLIN {{Z 5.0}}\nLIN {{Z 60.0}}\nLIN {{X 30.560,Y 53.0,Z 60.0}}\nLIN {{Z 45.600}}\n{PASS}"
            )),
            WORDS,
            Code::NoPass,
        ),
        (
            "a hole after the passes",
            program().replace(
                "END\n",
                "LIN {X 33.5,Y 25.0,Z 60.0}\nLIN {Z 14.9}\nLIN {Z 60.0}\nEND\n",
            ),
            WORDS,
            Code::NoPass,
        ),
        (
            "plunges where passes cut later",
            instead(&format!(
                "LIN {{Z 60.0}}\nLIN {{X 33.5,Y 25.0,Z 60.0}}\nLIN {{Z 45.0}}\nLIN {{Z 60.0}}\nLIN {{X 30.560,Y 53.0,Z 60.0}}\nLIN {{Z 45.600}}\n{PASS}"
            )),
            WORDS,
            Code::Plunge,
        ),
        (
            "a motion from an unknown place into the blank",
            instead(&format!(
                "PTP HOME\nPTP {{X 30.560,Y 25.0,Z 10.0}}\nLIN {{Z 60.0}}\nLIN {{Y 53.0}}\nLIN {{Z 45.6}}\n{PASS}"
            )),
            WORDS,
            Code::NoPass,
        ),
        ("passes on one half only", on_one_half(), WORDS, Code::Unclear),
        ("a zero at half the height", half_way(), WORDS, Code::Unclear),
        (
            "width and depth exchanged",
            program(),
            Words {
                stock: "50x85x50",
                along: Some("y"),
                ..WORDS
            },
            Code::NoPass,
        ),
        (
            "as far along as across",
            program().replacen(
                "$VEL.CP=1.0\n",
                &format!(
                    "$VEL.CP=1.0\nLIN {{X 0.0,Y -10.0,Z 70.0}}\n{}",
                    "LIN {X 90.0}\nLIN {X 0.0}\n".repeat(30)
                ),
                1,
            ),
            WORDS,
            Code::Unclear,
        ),
        (
            "a coordinate beyond every cell",
            instead("LIN {X 30.560,Y -3.000,Z 1e300}"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "an arc through a point beyond every cell",
            instead("CIRC {X 1e200,Y -3.000,Z 60.0},{X 30.560,Y -3.000,Z 60.0}, CA 90"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "a coordinate that is not a number",
            instead("LIN {X NaN,Y -3.000,Z 45.600}"),
            WORDS,
            Code::NotFollowed,
        ),
        (
            "outputs and waits",
            instead(&format!(
                "$OUT[3]=TRUE\nWAIT SEC 1\n{PASS}$ANOUT[1]=0.5\nHALT\nP00(#EXT_PGNO,#PGNO_ACKN,DMY[],0)\n$OUT[4]=FALSE"
            )),
            WORDS,
            Code::LeftOut,
        ),
        (
            "passes beside the blank",
            program()
                .replace("X 84.290", "X 85.900")
                .replace("X 0.710", "X -0.800"),
            WORDS,
            Code::BesideBlank,
        ),
    ]
}

#[test]
fn what_is_not_a_raster_is_reported_at_its_line() {
    let mut shown = String::new();
    for (what, text, words, code) in cases() {
        let (diagnostics, sources) = refused(&text, words);
        let codes: Vec<Code> = diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
        assert!(codes.contains(&code), "{what}: {diagnostics:#?}");
        assert!(codes.iter().all(|&found| found == code), "{what}: {codes:?}");
        for diagnostic in &diagnostics {
            assert!(!diagnostic.help.is_empty(), "{what}");
        }
        shown += &format!("# {what}\n\n");
        shown += &render::render(&diagnostics, &sources, render::ColorChoice::Plain);
        shown += "\n";
    }
    insta::assert_snapshot!("refusals", shown);
}

/// Options that a help line says to write, with their values; placeholders are in capitals.
fn offered(help: &str) -> Vec<(&str, &str)> {
    let quoted = help.split('`').skip(1).step_by(2);
    let options = quoted.filter_map(|text| text.strip_prefix("--")?.split_once(' '));
    options
        .filter(|(_, value)| !value.contains(char::is_uppercase))
        .collect()
}

fn with_offered<'a>(words: Words<'a>, options: &[(&'a str, &'a str)]) -> Words<'a> {
    let mut words = words;
    for &(option, value) in options {
        match option {
            "origin" => words.origin = Some(value),
            "along" => words.along = Some(value),
            "up" => words.up = Some(value),
            "stock" => words.stock = value,
            "clearance" => words.clearance = Some(value),
            "tolerance" => words.tolerance = Some(value),
            "feed" => words.feed = Some(value),
            "travel" => words.travel = Some(value),
            "feed-unit" => words.feed_unit = Some(value),
            other => panic!("--{other} is offered, and nothing here tries it"),
        }
    }
    words
}

/// A job has no error left when everything is written that the messages say.
#[test]
fn options_that_messages_offer_work() {
    let mut counted = 0;
    for (what, text, words, _) in cases() {
        let (diagnostics, _) = refused(&text, words);
        for help in diagnostics.iter().flat_map(|diagnostic| &diagnostic.help) {
            let options = offered(help);
            if options.is_empty() {
                continue;
            }
            counted += 1;
            let (left, _) = refused(&text, with_offered(words, &options));
            let messages: Vec<&str> = left.iter().map(|one| one.message.as_str()).collect();
            assert!(!has_errors(&left), "{what}: {help}: {messages:?}");
        }
    }
    assert!(counted >= 15, "{counted}");
}

/// Where the program leaves the place of its blank open, there is an option to say it.
#[test]
fn unclear_places_have_an_offer() {
    let unclear = cases().into_iter().filter(|(.., code)| *code == Code::Unclear);
    for (what, text, words, _) in unclear {
        let (diagnostics, _) = refused(&text, words);
        let helps = diagnostics.iter().flat_map(|diagnostic| &diagnostic.help);
        assert!(
            helps.flat_map(|help| offered(help)).next().is_some(),
            "{what}: {diagnostics:#?}"
        );
    }
}

#[test]
fn options_that_cannot_be_understood_say_what_would_be() {
    let bad = [
        Words { rake: "60", ..WORDS },
        Words {
            rake: "60mm",
            ..WORDS
        },
        Words {
            rake: "91deg",
            ..WORDS
        },
        Words {
            swing: "90deg",
            ..WORDS
        },
        Words {
            swing: "-3deg",
            ..WORDS
        },
        Words {
            extension: "far",
            ..WORDS
        },
        Words {
            stock: "85x50",
            ..WORDS
        },
        Words {
            stock: "85x50x0",
            ..WORDS
        },
        Words {
            stock: "85x50xNaN",
            ..WORDS
        },
        Words {
            origin: Some("1,2"),
            ..WORDS
        },
        Words {
            along: Some("w"),
            ..WORDS
        },
        Words {
            along: Some("z"),
            ..WORDS
        },
        Words {
            up: Some("+z"),
            ..WORDS
        },
        Words {
            feed_unit: Some("m/min"),
            ..WORDS
        },
        Words {
            feed: Some("200"),
            ..WORDS
        },
        Words {
            reorient: Some("90mm/s"),
            ..WORDS
        },
        Words {
            half_apex: Some("60deg"),
            ..WORDS
        },
        Words {
            thickness: Some("-1"),
            ..WORDS
        },
        Words {
            stock: "85,5x50x50",
            ..WORDS
        },
        Words {
            tolerance: Some("2mm"),
            ..WORDS
        },
    ];
    let shown: String = bad
        .iter()
        .map(|words| format!("{}\n", words.asked().unwrap_err()))
        .collect();
    insta::assert_snapshot!("options", shown);
}

#[test]
fn lengths_are_in_mm_unless_a_unit_follows() {
    let words = Words {
        stock: "8.5x5x5cm",
        extension: "0.8 cm",
        ..WORDS
    };
    let asked = words.asked().unwrap();
    assert_eq!(asked.stock, [85.0, 50.0, 50.0]);
    assert!((asked.extension.to_mm() - 8.0).abs() < 1e-12);
    for stock in [
        "85x50x50",
        "85X50X50",
        "85 x 50 x 50",
        "85mm x 50mm x 50mm",
        "85 * 50 * 50 mm",
        "85\u{d7}50\u{d7}50",
    ] {
        assert_eq!(
            Words { stock, ..WORDS }.asked().unwrap().stock,
            [85.0, 50.0, 50.0],
            "{stock}"
        );
    }
}
