//! The habits of a machine: profiles as TOML, with every flaw at its place.
//!
//! A profile is data only. What it may ask for is bounded here, so that whatever a backend does with it stays text of a program;
//! whether a dialect can do it is for the backend to say. `docs/profiles.md` has the form.

use core::ops::{Range, RangeInclusive};
use vcutc_backend_api::profile::{LineNumbers, PROFILE_DECIMALS, Profile};
use vcutc_diagnostics::document::flaw::Flaw;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::document::{self, Wording};

const WORDING: Wording = Wording {
    name: "profile",
    looks: "`extension = \"nc\"`",
};

const HEADER: &str = "header";
const FOOTER: &str = "footer";
const EXTENSION: &str = "extension";
const DECIMALS: &str = "decimals";
const LINE_NUMBERS: &str = "line_numbers";
const START: &str = "start";
const STEP: &str = "step";
const RESERVED: &str = "reserved";

const KEYS: &[&str] = &[HEADER, FOOTER, EXTENSION, DECIMALS, LINE_NUMBERS, RESERVED];

/// Longest line of a header or footer, in characters: what every controller reads.
const LONGEST_LINE: usize = 120;
/// Most lines of a header or footer.
const MOST_LINES: usize = 1000;
/// Longest extension, in characters.
const LONGEST_EXTENSION: usize = 8;
/// Longest reserved name, in characters.
const LONGEST_NAME: usize = 64;
/// Most reserved names.
const MOST_NAMES: usize = 10_000;
/// Numbers that a block can have: eight digits.
const NUMBERS: RangeInclusive<u32> = 0..=99_999_999;
/// From one number to the next.
const STEPS: RangeInclusive<u32> = 1..=10_000;

/// Reads a profile.
///
/// # Errors
/// What is wrong with it, in the order of the text.
pub fn parse(text: &str) -> Result<Profile, Vec<Flaw>> {
    document::parse(text, WORDING, |root, flaws| Some(read(root, flaws)))
}

fn read(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Profile {
    root.allow(KEYS, flaws);
    let decimals = u32::from(*PROFILE_DECIMALS.start())..=u32::from(*PROFILE_DECIMALS.end());
    let decimals = root.whole(DECIMALS, decimals, flaws);
    Profile {
        header: lines(root, HEADER, flaws),
        footer: lines(root, FOOTER, flaws),
        extension: extension(root, flaws),
        decimals: decimals.and_then(|decimals| u8::try_from(decimals).ok()),
        line_numbers: line_numbers(root, flaws),
        reserved: reserved(root, flaws),
    }
}

fn lines(root: &Table<'_>, key: &str, flaws: &mut Vec<Flaw>) -> Vec<String> {
    let lines = root.placed_texts(key, flaws);
    too_many(root, key, lines.len(), MOST_LINES, flaws);
    flaws.extend(lines.iter().filter_map(|(line, span)| line_flaw(key, line, span)));
    lines.into_iter().map(|(line, _)| line.to_owned()).collect()
}

fn line_flaw(key: &str, line: &str, span: &Range<usize>) -> Option<Flaw> {
    let letters = line.chars().count();
    let is_taken = |letter: char| letter == ' ' || letter.is_ascii_graphic();
    if let Some(letter) = line.chars().find(|&letter| !is_taken(letter)) {
        let letter = match letter {
            '\n' | '\r' => "a line break".to_owned(),
            '\t' => "a tab".to_owned(),
            letter => format!("`{letter}`"),
        };
        let flaw = Flaw::new(
            span.clone(),
            format!("a line of `{key}` has {letter}, which some controllers cannot read"),
            "not plain ASCII",
        );
        return Some(flaw.help("write every line as a separate text, in ASCII letters, digits and symbols"));
    }
    (letters > LONGEST_LINE).then(|| {
        Flaw::new(
            span.clone(),
            format!("a line of `{key}` has {letters} characters, at most {LONGEST_LINE} are allowed"),
            format!("{letters} characters"),
        )
        .help("break it into several texts")
    })
}

fn too_many(root: &Table<'_>, key: &str, count: usize, most: usize, flaws: &mut Vec<Flaw>) {
    if count > most {
        flaws.push(Flaw::new(
            root.span_of(key),
            format!("`{key}` has {count} entries, at most {most} are allowed"),
            "too many",
        ));
    }
}

fn extension(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<String> {
    let given = root.text(EXTENSION, flaws)?;
    let is_plain = given.chars().all(|letter| letter.is_ascii_alphanumeric());
    if is_plain && (1..=LONGEST_EXTENSION).contains(&given.len()) {
        return Some(given.to_owned());
    }
    let flaw = Flaw::new(
        root.span_of(EXTENSION),
        format!("`{EXTENSION}` takes 1 to {LONGEST_EXTENSION} letters or digits"),
        "not a valid extension",
    );
    let letters = given.chars().filter(char::is_ascii_alphanumeric);
    let near: String = letters.take(LONGEST_EXTENSION).collect();
    flaws.push(if near.is_empty() {
        flaw.help("write `extension = \"nc\"`, or omit it for the default")
    } else {
        flaw.help(format!("write `extension = \"{near}\"`"))
    });
    None
}

fn line_numbers(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<LineNumbers> {
    let table = root.table(LINE_NUMBERS, &[START, STEP], flaws)?;
    table.require(&[(START, "start = 10"), (STEP, "step = 10")], flaws);
    let start = table.whole(START, NUMBERS, flaws);
    let step = table.whole(STEP, STEPS, flaws);
    Some(LineNumbers {
        start: start?,
        step: step?,
    })
}

fn reserved(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Vec<String> {
    let names = root.placed_texts(RESERVED, flaws);
    too_many(root, RESERVED, names.len(), MOST_NAMES, flaws);
    for (name, span) in &names {
        let known = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let is_plain = name.chars().all(known) && !name.starts_with(|letter: char| letter.is_ascii_digit());
        if !is_plain || !(1..=LONGEST_NAME).contains(&name.len()) {
            flaws.push(
                Flaw::new(
                    span.clone(),
                    format!("a name of `{RESERVED}` has letters, digits and `_`, at most {LONGEST_NAME}, no digit first"),
                    "not a name that a program could have",
                )
                .help("delete it: programs never have such names"),
            );
        }
    }
    names.into_iter().map(|(name, _)| name.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WHOLE: &str = r#"
header = ["(GANTRY 2)", "G54"]
footer = "M5"
extension = "nc"
decimals = 4
reserved = ["MAIN", "o_1"]

[line_numbers]
start = 10
step = 5
"#;

    /// What the only flaw of a text points at, and what it says.
    fn flaw(text: &str) -> (String, String) {
        let flaws = parse(text).unwrap_err();
        let [flaw] = flaws.as_slice() else {
            panic!("{flaws:?}");
        };
        (text[flaw.span.clone()].to_owned(), flaw.message.clone())
    }

    #[test]
    fn a_whole_profile_is_read() {
        let profile = parse(WHOLE).unwrap();
        assert_eq!(profile.header, ["(GANTRY 2)", "G54"]);
        assert_eq!(profile.footer, ["M5"]);
        assert_eq!(profile.extension.as_deref(), Some("nc"));
        assert_eq!(profile.decimals, Some(4));
        assert_eq!(profile.line_numbers, Some(LineNumbers { start: 10, step: 5 }));
        assert_eq!(profile.reserved, ["MAIN", "o_1"]);
    }

    #[test]
    fn an_empty_profile_leaves_everything_open() {
        assert_eq!(parse("# nothing\n"), Ok(Profile::default()));
    }

    #[test]
    fn every_flaw_is_told_at_its_place() {
        let long = format!("header = [\"{}\"]", "x".repeat(121));
        for (text, place, says) in [
            ("decimal = 4", "decimal", "a profile has no `decimal`"),
            ("decimals = 7", "7", "`decimals` is from 3 to 6, not 7"),
            (
                "decimals = 3.5",
                "3.5",
                "`decimals` takes a whole number, not 3.5",
            ),
            (
                "extension = \".nc\"",
                "\".nc\"",
                "`extension` takes 1 to 8 letters or digits",
            ),
            (
                "extension = \"\"",
                "\"\"",
                "`extension` takes 1 to 8 letters or digits",
            ),
            (
                "header = [\"a\", \"Fräsen\"]",
                "\"Fräsen\"",
                "a line of `header` has `ä`, which some controllers cannot read",
            ),
            (
                "footer = [\"a\\nb\"]",
                "\"a\\nb\"",
                "a line of `footer` has a line break, which some controllers cannot read",
            ),
            (
                &long,
                &long[10..long.len() - 1],
                "a line of `header` has 121 characters, at most 120 are allowed",
            ),
            (
                "line_numbers = { start = 1, step = 0 }",
                "0",
                "`step` is from 1 to 10000, not 0",
            ),
            (
                "line_numbers = { start = 1 }",
                "{ start = 1 }",
                "`[line_numbers]` lacks `step`",
            ),
            (
                "reserved = [\"A B\"]",
                "\"A B\"",
                "a name of `reserved` has letters, digits and `_`, at most 64, no digit first",
            ),
            ("footer = 5", "5", "`footer` takes a list of texts, not a number"),
        ] {
            assert_eq!(flaw(text), (place.to_owned(), says.to_owned()), "{text}");
        }
    }

    proptest! {
        /// Whatever one byte of a profile becomes: a profile within the bounds, or flaws with a place in the text.
        #[test]
        fn no_text_is_read_beyond_the_bounds(at in 0..WHOLE.len(), byte in 0_u8..128) {
            let mut bytes = WHOLE.as_bytes().to_vec();
            bytes[at] = byte;
            let text = String::from_utf8(bytes).unwrap();
            match parse(&text) {
                Ok(profile) => {
                    for line in profile.header.iter().chain(&profile.footer) {
                        prop_assert!(line.len() <= LONGEST_LINE && !line.contains(['\n', '\r']));
                    }
                    prop_assert!(profile.decimals.is_none_or(|decimals| PROFILE_DECIMALS.contains(&decimals)));
                    prop_assert!(profile.line_numbers.is_none_or(|numbers| numbers.step > 0));
                }
                Err(flaws) => prop_assert!(flaws.iter().all(|flaw| text.get(flaw.span.clone()).is_some())),
            }
        }
    }
}
