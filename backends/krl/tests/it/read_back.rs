//! Written programs are read back as what they were made from, and nothing can be changed in them unnoticed.

use crate::round_trip::{recipe, values};
use crate::support::{emit, options, reachable};
use proptest::prelude::*;
use vcutc_backend_api::backend::{Backend, OptionValue, Options};
use vcutc_backend_api::ir::Cell;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::readback::{
    Comparator, Divergence, Effect, Place, ProgramFile, Reader, Replay, Sources, Statement, normalized,
    program_files,
};
use vcutc_backend_api::testkit::{Recipe, samples};
use vcutc_backend_api::units::Length;
use vcutc_backend_krl::Krl;
use vcutc_backend_krl::read::KrlReader;

pub(crate) fn cell(program: &ReachableProgram) -> &Cell {
    program.program().cell.as_ref().unwrap()
}

/// All statements that are reported of a program's files.
pub(crate) fn statements(
    files: &[ProgramFile],
    program: &ReachableProgram,
    options: &Options,
) -> Vec<Statement> {
    let mut statements = Vec::new();
    let sources = Sources {
        files,
        cell: cell(program),
        options,
    };
    KrlReader.read(sources, &mut |statement| statements.push(statement));
    statements
}

pub(crate) fn replayed(
    statements: &[Statement],
    program: &ReachableProgram,
    options: &Options,
) -> Result<Vec<Place>, Divergence> {
    let reader = Krl.reader().unwrap();
    let mut replay = Replay::new(
        Comparator::new(program, reader, reader.resolution(options)),
        reader.frames(),
    );
    for statement in statements {
        replay.take(statement);
    }
    replay.finish()
}

pub(crate) fn text<'f>(files: &'f [ProgramFile], statement: &Statement) -> &'f str {
    let place = statement.place;
    &files[place.file as usize].text[place.start as usize..place.end as usize]
}

fn normalized_texts(files: &[ProgramFile], statements: &[Statement]) -> Vec<String> {
    statements
        .iter()
        .map(|statement| normalized(text(files, statement)))
        .collect()
}

fn emitted(program: &ReachableProgram, options: &Options) -> Vec<ProgramFile> {
    let mut bundle = vcutc_backend_api::bundle::Bundle::default();
    let emission = Krl.check(program, options);
    emission
        .map_err(|issues| format!("{issues:?}"))
        .unwrap()
        .write(&mut bundle)
        .unwrap();
    program_files(&bundle)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn what_is_written_is_read_back(recipe in recipe(), values in values()) {
        let program = reachable(recipe.program());
        let files = program_files(&emit(&program, &values));
        let options = options(&values);
        let statements = statements(&files, &program, &options);
        let replayed = replayed(&statements, &program, &options);
        prop_assert!(replayed.is_ok(), "{:?}", replayed);
        prop_assert_eq!(replayed.unwrap().len(), program.program().ops.len());
    }

    /// Compared with a list of the lines that are not comments, made without the reader.
    #[test]
    fn every_statement_is_reported_once(recipe in recipe(), values in values()) {
        let program = reachable(recipe.program());
        let files = program_files(&emit(&program, &values));
        let statements = statements(&files, &program, &options(&values));
        let got = statements.iter().map(|statement| (statement.place.file, text(&files, statement)));
        let mut got: Vec<_> = got.collect();
        let mut lines: Vec<_> = (0_u32..).zip(&files).flat_map(|(place, file)| {
            let lines = file.text.lines().map(|line| line.split(';').next().unwrap().trim());
            lines.filter(|line| !line.is_empty() && !line.starts_with('&')).map(move |line| (place, line))
        }).collect();
        got.sort_unstable();
        lines.sort_unstable();
        prop_assert_eq!(got, lines);
    }

    #[test]
    fn lines_of_the_profile_are_passed_over(
        recipe in recipe(),
        values in values(),
        header in proptest::collection::vec(0..LINES.len(), 0..4),
        footer in proptest::collection::vec(0..LINES.len(), 0..4),
    ) {
        let program = reachable(recipe.program());
        let lines = |places: &[usize]| places.iter().map(|&place| LINES[place].to_owned()).collect();
        let options = options(&values).with_profile(Profile {
            header: lines(&header),
            footer: lines(&footer),
            ..Profile::default()
        });
        let files = emitted(&program, &options);
        let statements = statements(&files, &program, &options);
        let replayed = replayed(&statements, &program, &options);
        prop_assert!(replayed.is_ok(), "{:?}", replayed);
    }
}

/// Lines that a profile may have. Some of them are in every program as well.
const LINES: [&str; 7] = [
    "CELL_READY( )",
    "; a word",
    "$OUT[4090]=TRUE",
    "BAS (#INITMOV,0 )",
    "COUNT=COUNT+1",
    "$VEL.CP=0.2 ; m/s",
    "",
];

/// The lines of a profile count only where the writer puts them.
#[test]
fn a_line_of_the_profile_elsewhere_is_reported_as_what_it_does() {
    let program = reachable(Recipe::default().program());
    let options = options(&[]).with_profile(Profile {
        footer: vec!["$OUT[5]=TRUE".to_owned()],
        ..Profile::default()
    });
    let mut files = emitted(&program, &options);
    let moved = files[0].text.replace("$OUT[5]=TRUE\r\n", "");
    files[0].text = moved.replacen("PTP XVC_HOME\r\n", "$OUT[5]=TRUE\r\nPTP XVC_HOME\r\n", 1);
    let statements = statements(&files, &program, &options);
    let divergence = replayed(&statements, &program, &options).unwrap_err();
    let place = divergence.place.unwrap();
    assert_eq!(
        &files[place.file as usize].text[place.start as usize..place.end as usize],
        "$OUT[5]=TRUE"
    );
}

#[test]
fn files_are_recognised_by_their_extension() {
    for name in ["a.src", "a.dat", "A.SRC", "a.b.Dat"] {
        assert!(KrlReader.recognises(name), "{name}");
    }
    for name in ["a.mod", "src", "a.src.bak", ""] {
        assert!(!KrlReader.recognises(name), "{name}");
    }
}

/// A program before it is changed.
pub(crate) struct Original<'p> {
    program: &'p ReachableProgram,
    options: Options,
    files: Vec<ProgramFile>,
    normalized_texts: Vec<String>,
}

/// What became of changed programs.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Count {
    /// Left where they were changed.
    pub(crate) departed: u32,
    /// Followed to the end, since nothing that counts was changed, but with another statement.
    pub(crate) other_statement: u32,
    /// Changed in comments and layout.
    layout: u32,
}

impl<'p> Original<'p> {
    pub(crate) fn new(program: &'p ReachableProgram, values: &[(&str, OptionValue)]) -> Self {
        let options = options(values);
        let files = emitted(program, &options);
        let statements = statements(&files, program, &options);
        assert_eq!(replayed(&statements, program, &options).map(|_| ()), Ok(()));
        Self {
            program,
            normalized_texts: normalized_texts(&files, &statements),
            options,
            files,
        }
    }

    fn try_change(&self, file: usize, text: String, count: &mut Count) {
        let mut files = self.files.clone();
        files[file].text = text;
        let statements = statements(&files, self.program, &self.options);
        if replayed(&statements, self.program, &self.options).is_err() {
            count.departed += 1;
        } else if normalized_texts(&files, &statements) != self.normalized_texts {
            count.other_statement += 1;
        } else {
            let meaning = |files: &[ProgramFile]| tokens(&files[file].text);
            assert_eq!(meaning(&files), meaning(&self.files), "{}", files[file].text);
            count.layout += 1;
        }
    }

    /// Every character taken out, another put in its place, and one put before it.
    pub(crate) fn change_characters(&self, count: &mut Count) {
        let others = b"0123456789.-,;{}()[]$#&\"'=_ XASETZ\n";
        for (file, ProgramFile { text, .. }) in self.files.iter().enumerate() {
            for at in 0..text.len() {
                let other = char::from(others[(at * 7 + file) % others.len()]);
                let (before, after) = (&text[..at], &text[at + 1..]);
                self.try_change(file, format!("{before}{after}"), count);
                self.try_change(file, format!("{before}{other}{after}"), count);
                self.try_change(file, format!("{before}{other}{}", &text[at..]), count);
            }
        }
    }

    /// Every line taken out, doubled, and swapped with the next.
    pub(crate) fn change_lines(&self, count: &mut Count) {
        for (file, ProgramFile { text, .. }) in self.files.iter().enumerate() {
            let lines: Vec<_> = text.split_inclusive('\n').collect();
            for at in 0..lines.len() {
                let mut without = lines.clone();
                let line = without.remove(at);
                self.try_change(file, without.concat(), count);
                let mut twice = lines.clone();
                twice.insert(at, line);
                self.try_change(file, twice.concat(), count);
                if at + 1 < lines.len() {
                    let mut swapped = lines.clone();
                    swapped.swap(at, at + 1);
                    self.try_change(file, swapped.concat(), count);
                }
            }
        }
    }
}

/// What a text says apart from comments, records of the editor and layout, found without the reader: words in upper
/// case, signs, and numbers by value.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    for line in text.lines() {
        let line = line.split(';').next().unwrap();
        if line.trim_start().starts_with('&') {
            continue;
        }
        let mut rest = line.trim();
        while let Some(c) = rest.chars().next() {
            let is_number = c.is_ascii_digit() || c == '.';
            let is_word = c.is_ascii_alphabetic() || matches!(c, '_' | '$');
            let of = |d: char| {
                if is_number {
                    d.is_ascii_digit() || d == '.'
                } else {
                    is_word && (d.is_ascii_alphanumeric() || matches!(d, '_' | '$'))
                }
            };
            let end = rest.find(|d| !of(d)).unwrap_or(rest.len()).max(c.len_utf8());
            let (token, after) = rest.split_at(end);
            tokens.push(match token.parse::<f64>() {
                Ok(value) if is_number => value.to_string(),
                _ => token.to_uppercase(),
            });
            rest = after.trim_start();
        }
        if tokens.last().is_some_and(|last| last != "\n") {
            tokens.push("\n".to_owned());
        }
    }
    tokens
}

#[test]
fn no_character_can_be_changed_unnoticed() {
    let samples = samples().unwrap();
    let mut count = Count::default();
    for (name, program) in &samples {
        if matches!(*name, "one_cut" | "numbered_cell") {
            Original::new(program, &[]).change_characters(&mut count);
        }
    }
    let recipe = Recipe {
        layers: 1,
        cuts: 2,
        ..Recipe::default()
    };
    Original::new(&reachable(recipe.program()), &everything()).change_characters(&mut count);
    assert!(
        count.departed > 15_000 && count.other_statement > 500,
        "{count:?}"
    );
}

#[test]
fn no_line_can_be_dropped_doubled_or_swapped_unnoticed() {
    let mut count = Count::default();
    for (_, program) in &samples().unwrap() {
        Original::new(program, &[]).change_lines(&mut count);
        Original::new(program, &everything()).change_lines(&mut count);
    }
    assert!(
        count.departed > 5_000 && count.other_statement > 2_500,
        "{count:?}"
    );
}

/// Parts, splines, rounding.
fn everything() -> Vec<(&'static str, OptionValue)> {
    vec![
        ("lines_per_part", OptionValue::Integer(20)),
        ("declare_parts", OptionValue::Choice("yes")),
        ("motion", OptionValue::Choice("spline")),
        ("approximation", OptionValue::Length(Length::mm(2.5))),
        ("decimals", OptionValue::Integer(4)),
    ]
}

/// Nothing that was written is reported as not understood.
#[test]
fn all_that_is_written_is_understood() {
    for (name, program) in &samples().unwrap() {
        let options = options(&everything());
        let files = emitted(program, &options);
        for statement in statements(&files, program, &options) {
            let is_understood = !matches!(statement.effect, Effect::Unknown | Effect::Unreadable { .. });
            assert!(is_understood, "{name}: {}", text(&files, &statement));
        }
    }
}
