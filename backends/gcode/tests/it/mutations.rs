//! Programs with one character or one line changed: none passes for what it was.
//!
//! A mutant is caught when its commands are not those of the program, or when its statements have another normalized text, which is
//! what `vcutc verify` reports as an edit without effect. What is neither must be a change of layout,
//! comments or block numbers, by a way of comparing texts that shares no code with the reader.

use crate::chains;
use crate::read_back::replayed;
use crate::support::{DIALECTS, emit, needed, options, rounds};
use vcutc_backend_api::backend::{OptionValue, Options};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{ProgramFile, normalized, program_files};
use vcutc_backend_api::testkit::five_axis_samples;
use vcutc_backend_api::units::Length;

/// What became of mutants.
#[derive(Debug, Default)]
struct Tally {
    /// Another program.
    departed: usize,
    /// The same commands, said in another way.
    edited: usize,
    /// Layout, comments, block numbers.
    layout: usize,
}

/// A sample as a dialect writes it.
struct Written<'p> {
    dialect: &'static str,
    program: &'p ReachableProgram,
    options: Options,
    files: Vec<ProgramFile>,
    normalized_texts: Vec<String>,
    plain: Vec<String>,
}

impl<'p> Written<'p> {
    fn new(dialect: &'static str, program: &'p ReachableProgram) -> Self {
        let mut more = vec![("lines_per_part", OptionValue::Integer(30))];
        if rounds(dialect) {
            more.push(("approximation", OptionValue::Length(Length::mm(2.0))));
        }
        let files = program_files(&emit(program, dialect, &more));
        let mut given = needed(dialect);
        given.extend(more);
        let options = options(&given);
        let (result, statements) = replayed(program, &files, &options);
        assert!(result.is_ok(), "{dialect}");
        let texts = statements
            .iter()
            .map(|statement| normalized(text(&files, statement.place)));
        Self {
            dialect,
            program,
            normalized_texts: texts.collect(),
            plain: plain(&files, dialect),
            files,
            options,
        }
    }

    /// Reads a mutant of one of the files.
    fn comparator(&mut self, file: usize, mutant: String, tally: &mut Tally) {
        let kept = std::mem::replace(&mut self.files[file].text, mutant);
        let (result, statements) = replayed(self.program, &self.files, &self.options);
        let normalized_texts = statements
            .iter()
            .map(|statement| normalized(text(&self.files, statement.place)));
        if result.is_err() {
            tally.departed += 1;
        } else if !normalized_texts.eq(self.normalized_texts.iter().cloned()) {
            tally.edited += 1;
        } else {
            let now = plain(&self.files, self.dialect);
            assert_eq!(now, self.plain, "{}: {:?}", self.dialect, self.files[file].name);
            tally.layout += 1;
        }
        self.files[file].text = kept;
    }
}

fn text(files: &[ProgramFile], place: vcutc_backend_api::readback::Place) -> &str {
    &files[place.file as usize].text[place.start as usize..place.end as usize]
}

/// Programs of a dialect: those of all of them, and chains as it has them.
fn programs(dialect: &str) -> Vec<ReachableProgram> {
    let samples = five_axis_samples().unwrap();
    let samples = samples.into_iter().map(|(_, program)| program);
    samples.chain(chains::of(dialect)).collect()
}

/// Statements without blanks, comments and block numbers, in capitals, numbers as numbers.
fn plain(files: &[ProgramFile], dialect: &str) -> Vec<String> {
    let mut all = Vec::new();
    for file in files {
        for line in file.text.split(['\n', '\r']) {
            let mut code = String::new();
            let mut in_comment = false;
            for c in line.chars() {
                match c {
                    '(' if dialect == "linuxcnc" || dialect == "fanuc" => in_comment = true,
                    ')' if in_comment => in_comment = false,
                    ';' if !in_comment => break,
                    c if in_comment || c.is_whitespace() => {}
                    c => code.push(c.to_ascii_uppercase()),
                }
            }
            if in_comment {
                code.push('(');
            }
            let numbered = dialect == "heidenhain" || code.starts_with('N');
            if numbered {
                code = code
                    .trim_start_matches('N')
                    .trim_start_matches(|c: char| c.is_ascii_digit())
                    .to_owned();
            }
            let code = numbers(&code);
            if !code.is_empty() {
                all.push(code);
            }
        }
    }
    all
}

/// Numbers in one way of writing them.
fn numbers(code: &str) -> String {
    let mut out = String::new();
    let mut rest = code;
    while let Some(c) = rest.chars().next() {
        let is_number = |c: char| c.is_ascii_digit() || c == '.';
        let length = if is_number(c) {
            rest.find(|c| !is_number(c)).unwrap_or(rest.len())
        } else {
            c.len_utf8()
        };
        let (one, after) = rest.split_at(length);
        match one.parse::<f64>() {
            Ok(value) => out.push_str(&format!("{value}")),
            Err(_) => out.push_str(one),
        }
        rest = after;
    }
    out
}

/// What a character is replaced by: other digits, signs and letters with a meaning, or nothing.
const REPLACEMENTS: [&str; 9] = ["", "0", "7", "9", "-", ".", "X", " ", "\n"];

#[test]
fn one_character_more_less_or_other_is_reported() {
    let mut tally = Tally::default();
    for dialect in DIALECTS {
        for (number, program) in programs(dialect).iter().enumerate() {
            let mut written = Written::new(dialect, program);
            for file in 0..written.files.len() {
                let original = written.files[file].text.clone();
                // All places of short programs, some of long ones, which say the same again and again.
                let step = if written.normalized_texts.len() < 60 {
                    1
                } else {
                    29
                };
                for at in (number % step..original.len()).step_by(step) {
                    let replacement = REPLACEMENTS[(at + at / 9) % REPLACEMENTS.len()];
                    for end in [at, at + 1] {
                        let mutant = format!("{}{replacement}{}", &original[..at], &original[end..]);
                        if mutant != original {
                            written.comparator(file, mutant, &mut tally);
                        }
                    }
                }
            }
        }
    }
    assert!(tally.departed > 20 * tally.edited, "{tally:?}");
}

#[test]
fn a_line_dropped_doubled_or_swapped_is_reported() {
    let mut tally = Tally::default();
    for dialect in DIALECTS {
        for (number, program) in programs(dialect).iter().enumerate() {
            let mut written = Written::new(dialect, program);
            for file in 0..written.files.len() {
                let original = written.files[file].text.clone();
                let lines: Vec<&str> = original.lines().collect();
                let step = if written.normalized_texts.len() < 60 { 1 } else { 5 };
                for at in (number % step..lines.len()).step_by(step) {
                    let mut dropped = lines.clone();
                    dropped.remove(at);
                    let mut doubled = lines.clone();
                    doubled.insert(at, lines[at]);
                    let mut swapped = lines.clone();
                    swapped.swap(at, (at + 1).min(lines.len() - 1));
                    for mutant in [dropped, doubled, swapped] {
                        written.comparator(file, mutant.join("\n"), &mut tally);
                    }
                }
            }
        }
    }
    assert!(tally.departed > tally.edited, "{tally:?}");
}
