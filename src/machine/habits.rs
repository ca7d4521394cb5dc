//! The habits of a machine: profiles as TOML, with every flaw at its place.
//!
//! A profile is data only. What it may ask for is bounded here, so that whatever a backend does with it stays text of a program;
//! whether a dialect can do it is for the backend to say. `docs/profiles.md` has the form.

use vcutc_backend_api::profile::{LineNumbers, PROFILE_DECIMALS, Profile};
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::document::{self, Wording};
use vcutc_diagnostics::schema::dimension::Dimension;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};
use vcutc_diagnostics::schema::range::Range;
use vcutc_diagnostics::source::{FileId, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

const WORDING: Wording = Wording {
    name: "profile",
    looks: "`extension = \"nc\"`",
    code: Code::BadProfile,
};

const HEADER: &str = "header";
const FOOTER: &str = "footer";
const EXTENSION: &str = "extension";
const DECIMALS: &str = "decimals";
const LINE_NUMBERS: &str = "line_numbers";
const START: &str = "start";
const STEP: &str = "step";
const RESERVED: &str = "reserved";

const FIELDS: &[FieldSpec] = &[
    optional(HEADER),
    optional(FOOTER),
    optional(EXTENSION),
    optional(DECIMALS).within(whole(
        *PROFILE_DECIMALS.start() as u32,
        *PROFILE_DECIMALS.end() as u32,
    )),
    optional(LINE_NUMBERS),
    optional(RESERVED),
];

/// Numbers that a block can have: eight digits.
const START_FIELD: FieldSpec = value(START, "10").required().within(whole(0, 99_999_999));
/// From one number to the next.
const STEP_FIELD: FieldSpec = value(STEP, "10").required().within(whole(1, 10_000));

const fn whole(low: u32, high: u32) -> Range {
    Range::closed(Dimension::PURE, low as f64, high as f64)
}

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
/// Reads a profile.
///
/// # Errors
/// What is wrong with it, in the order of the text.
pub fn parse(file: FileId, text: &str) -> Result<Profile, Vec<Diagnostic>> {
    document::parse(file, text, WORDING, |root, faults| {
        Some(read(&root.with(FIELDS, faults), faults))
    })
}

fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Profile {
    let decimals = root.whole(DECIMALS, faults);
    Profile {
        header: lines(root, HEADER, faults),
        footer: lines(root, FOOTER, faults),
        extension: extension(root, faults),
        decimals: decimals.and_then(|decimals| u8::try_from(decimals).ok()),
        line_numbers: line_numbers(root, faults),
        reserved: reserved(root, faults),
    }
}

fn lines(root: &Table<'_>, key: &str, faults: &mut Vec<Diagnostic>) -> Vec<String> {
    let lines = root.placed_texts(key, faults);
    too_many(root, key, lines.len(), MOST_LINES, faults);
    faults.extend(lines.iter().filter_map(|line| line_fault(root, key, *line)));
    lines.into_iter().map(|line| line.node.to_owned()).collect()
}

fn line_fault(root: &Table<'_>, key: &str, line: Spanned<&str>) -> Option<Diagnostic> {
    let letters = line.node.chars().count();
    let is_taken = |letter: char| letter == ' ' || letter.is_ascii_graphic();
    if let Some(letter) = line.node.chars().find(|&letter| !is_taken(letter)) {
        let letter = match letter {
            '\n' | '\r' => "a line break".to_owned(),
            '\t' => "a tab".to_owned(),
            letter => format!("`{letter}`"),
        };
        let message = format!("a line of `{key}` has {letter}, which some controllers cannot read");
        let fault = root.fault(line.span, message, "not plain ASCII");
        return Some(fault.help("write every line as a separate text, in ASCII letters, digits and symbols"));
    }
    (letters > LONGEST_LINE).then(|| {
        let message =
            format!("a line of `{key}` has {letters} characters, at most {LONGEST_LINE} are allowed");
        root.fault(line.span, message, format!("{letters} characters"))
            .help("break it into several texts")
    })
}

fn too_many(root: &Table<'_>, key: &str, count: usize, most: usize, faults: &mut Vec<Diagnostic>) {
    if count > most {
        let message = format!("`{key}` has {count} entries, at most {most} are allowed");
        faults.push(root.fault(root.span_of(key), message, "too many"));
    }
}

fn extension(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<String> {
    let given = root.text(EXTENSION, faults)?;
    let is_plain = given.chars().all(|letter| letter.is_ascii_alphanumeric());
    if is_plain && (1..=LONGEST_EXTENSION).contains(&given.len()) {
        return Some(given.to_owned());
    }
    let message = format!("`{EXTENSION}` takes 1 to {LONGEST_EXTENSION} letters or digits");
    let fault = root.fault(root.span_of(EXTENSION), message, "not a valid extension");
    let letters = given.chars().filter(char::is_ascii_alphanumeric);
    let near: String = letters.take(LONGEST_EXTENSION).collect();
    faults.push(if near.is_empty() {
        fault.help("write `extension = \"nc\"`, or omit it for the default")
    } else {
        fault.help(format!("write `extension = \"{near}\"`"))
    });
    None
}

fn line_numbers(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<LineNumbers> {
    let table = root.table(LINE_NUMBERS, &[START_FIELD, STEP_FIELD], faults)?;
    let start = table.whole(START, faults);
    let step = table.whole(STEP, faults);
    Some(LineNumbers {
        start: start?,
        step: step?,
    })
}

fn reserved(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Vec<String> {
    let names = root.placed_texts(RESERVED, faults);
    too_many(root, RESERVED, names.len(), MOST_NAMES, faults);
    for name in &names {
        let known = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let starts_with_digit = name.node.starts_with(|letter: char| letter.is_ascii_digit());
        let is_plain = name.node.chars().all(known) && !starts_with_digit;
        if !is_plain || !(1..=LONGEST_NAME).contains(&name.node.len()) {
            let message = format!(
                "a name of `{RESERVED}` has letters, digits and `_`, at most {LONGEST_NAME}, no digit first"
            );
            let fault = root.fault(name.span, message, "not a name that a program could have");
            faults.push(fault.help("delete it: programs never have such names"));
        }
    }
    names.into_iter().map(|name| name.node.to_owned()).collect()
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

    fn parse(text: &str) -> Result<Profile, Vec<Diagnostic>> {
        super::parse(FileId::ALONE, text)
    }

    /// What the only fault of a text points at, and what it says.
    fn fault(text: &str) -> (String, String) {
        let faults = parse(text).unwrap_err();
        let [fault] = faults.as_slice() else {
            panic!("{faults:?}");
        };
        (text[fault.primary.span.bytes()].to_owned(), fault.message.clone())
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
    fn every_fault_is_reported_at_its_place() {
        let long = format!("header = [\"{}\"]", "x".repeat(121));
        for (text, place, says) in [
            ("decimal = 4", "decimal", "a profile has no field `decimal`"),
            (
                "decimals = 7",
                "7",
                "`decimals` must be at least 3 and at most 6, but is 7",
            ),
            ("decimals = 3.5", "3.5", "`decimals` is a whole number, not 3.5"),
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
                "`step` must be at least 1 and at most 10000, but is 0",
            ),
            (
                "line_numbers = { start = 1 }",
                "{ start = 1 }",
                "`[line_numbers]` needs `step`",
            ),
            (
                "reserved = [\"A B\"]",
                "\"A B\"",
                "a name of `reserved` has letters, digits and `_`, at most 64, no digit first",
            ),
            ("footer = 5", "5", "`footer` takes a list of texts, not a number"),
        ] {
            assert_eq!(fault(text), (place.to_owned(), says.to_owned()), "{text}");
        }
    }

    proptest! {
        /// Whatever one byte of a profile becomes: a profile within the bounds, or faults with a place in the text.
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
                Err(faults) => prop_assert!(faults.iter().all(|fault| text.get(fault.primary.span.bytes()).is_some())),
            }
        }
    }
}
