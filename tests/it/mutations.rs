//! Whatever is changed in a program is found: mutants of the programs of all examples, for all targets that take them.
//!
//! A mutant differs from its program in one place: a digit, a line that is gone, two neighbouring lines swapped, a speed.
//! Which mutants are made follows from the text alone, so that every run makes the same ones. What stands in comments is
//! left alone, and so are mutants that read the same, such as two equal lines swapped.

use crate::pipeline::{Files, compile};
use crate::repository::{files, root};
use std::collections::BTreeMap;
use vcutc::driver;
use vcutc::readback::{Fresh, Reference};
use vcutc::registry;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::readback::{ProgramFile, essence};

/// Mutants of each kind and program, at most.
const MOST_OF_A_KIND: usize = 60;

/// Mutants that are made, and found, in all. docs/verify.md says so too.
const MUTANTS: usize = 1864;

/// One change of a text.
#[derive(Clone, Copy, Debug)]
enum Mutation {
    Digit,
    Dropped,
    Swapped,
    Speed,
}

const KINDS: [Mutation; 4] = [
    Mutation::Digit,
    Mutation::Dropped,
    Mutation::Swapped,
    Mutation::Speed,
];

/// What is a comment, and which lines say speeds.
struct Dialect {
    /// A comment goes from here to the end of its line.
    to_line_end: &'static str,
    /// A comment goes from the first to the second.
    enclosed: Option<(char, char)>,
    /// What begins a line that the controller passes over.
    passed_over: &'static str,
    /// Words in front of a speed.
    speeds: &'static [&'static str],
}

fn dialect(target: &str) -> Dialect {
    match target {
        "krl" => Dialect {
            to_line_end: ";",
            enclosed: None,
            passed_over: "&",
            speeds: &["$VEL", "#VEL_PTP,"],
        },
        "rapid" => Dialect {
            to_line_end: "!",
            enclosed: None,
            passed_over: "<",
            speeds: &["speeddata"],
        },
        _ => Dialect {
            to_line_end: ";",
            enclosed: Some(('(', ')')),
            passed_over: "<",
            speeds: &[" F", "FROT"],
        },
    }
}

impl Dialect {
    /// How much of a line, from its beginning, is no comment.
    fn code<'l>(&self, line: &'l str) -> &'l str {
        let end = line.find(self.to_line_end).unwrap_or(line.len());
        let enclosed = self.enclosed.and_then(|(open, _)| line.find(open));
        let code = line[..end.min(enclosed.unwrap_or(end))].trim();
        if code.starts_with(self.passed_over) {
            ""
        } else {
            code
        }
    }
}

/// A place of a program: a file and a line of it.
type Line = (usize, usize);

/// All lines that hold more than comments.
fn lines_of_code(files: &[ProgramFile], dialect: &Dialect) -> Vec<Line> {
    let all = files.iter().enumerate().flat_map(|(file, program)| {
        let lines = program.text.lines().enumerate();
        lines.map(move |(line, text)| ((file, line), text))
    });
    all.filter(|(_, text)| !dialect.code(text).is_empty())
        .map(|(line, _)| line)
        .collect()
}

fn line(files: &[ProgramFile], (file, line): Line) -> &str {
    files[file].text.lines().nth(line).unwrap()
}

fn with_line(files: &[ProgramFile], (file, number): Line, replaced: Option<&str>) -> Vec<ProgramFile> {
    let mut mutant = files.to_vec();
    let lines = files[file].text.split_inclusive('\n').enumerate();
    mutant[file].text = lines
        .filter_map(|(index, text)| match (index == number, replaced) {
            (true, None) => None,
            (true, Some(replaced)) => {
                let end = &text[text.trim_end_matches(['\r', '\n']).len()..];
                Some(format!("{replaced}{end}"))
            }
            (false, _) => Some(text.to_owned()),
        })
        .collect();
    mutant
}

/// Elements spread evenly, at most so many.
fn spread<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    let count = all.len().min(most);
    (0..count).map(|i| all[i * all.len() / count]).collect()
}

/// A line with one of its digits replaced by the next one; which of them depends on the number of the line.
fn other_digit(text: &str, code: &str, salt: usize) -> Option<String> {
    let start = text.find(code)?;
    let digits: Vec<usize> = code
        .bytes()
        .enumerate()
        .filter(|(_, byte)| byte.is_ascii_digit())
        .map(|(at, _)| start + at)
        .collect();
    let at = *digits.get(salt.checked_rem(digits.len())?)?;
    let digit = text.as_bytes()[at] - b'0';
    Some(format!("{}{}{}", &text[..at], (digit + 1) % 10, &text[at + 1..]))
}

/// A line with the first number behind a word for a speed half as large again.
fn other_speed(text: &str, words: &[&str]) -> Option<String> {
    let word = words
        .iter()
        .find_map(|word| Some(text.find(word)? + word.len()))?;
    let start = word + text[word..].find(|c: char| c.is_ascii_digit())?;
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    let end = text[start..]
        .find(|c| !is_of_number(c))
        .map_or(text.len(), |end| start + end);
    let speed: f64 = text[start..end].parse().ok()?;
    Some(format!("{}{}{}", &text[..start], speed * 1.5, &text[end..]))
}

/// The mutants of a kind.
fn mutants(files: &[ProgramFile], dialect: &Dialect, kind: Mutation) -> Vec<(Line, Vec<ProgramFile>)> {
    let lines = lines_of_code(files, dialect);
    let changed = |at: Line, text: Option<String>| {
        let text = text.filter(|text| essence(dialect.code(text)) != essence(dialect.code(line(files, at))));
        text.map(|text| (at, with_line(files, at, Some(&text))))
    };
    match kind {
        Mutation::Digit => {
            let with_digits: Vec<Line> = lines
                .into_iter()
                .filter(|&at| {
                    dialect
                        .code(line(files, at))
                        .contains(|c: char| c.is_ascii_digit())
                })
                .collect();
            let chosen = spread(&with_digits, MOST_OF_A_KIND).into_iter().enumerate();
            chosen
                .filter_map(|(salt, at)| {
                    let text = line(files, at);
                    changed(at, other_digit(text, dialect.code(text), salt * 7))
                })
                .collect()
        }
        Mutation::Dropped => spread(&lines, MOST_OF_A_KIND)
            .into_iter()
            .map(|at| (at, with_line(files, at, None)))
            .collect(),
        Mutation::Swapped => {
            let pairs: Vec<(Line, Line)> = lines
                .windows(2)
                .map(|pair| (pair[0], pair[1]))
                .filter(|(one, other)| one.0 == other.0 && one.1 + 1 == other.1)
                .filter(|&(one, other)| {
                    let read = |at| essence(dialect.code(line(files, at)));
                    read(one) != read(other)
                })
                .collect();
            spread(&pairs, MOST_OF_A_KIND)
                .into_iter()
                .map(|(one, other)| {
                    let mutant = with_line(files, one, Some(line(files, other)));
                    (one, with_line(&mutant, other, Some(line(files, one))))
                })
                .collect()
        }
        Mutation::Speed => {
            let with_speeds: Vec<Line> = lines
                .into_iter()
                .filter(|&at| other_speed(dialect.code(line(files, at)), dialect.speeds).is_some())
                .collect();
            spread(&with_speeds, MOST_OF_A_KIND)
                .into_iter()
                .filter_map(|at| changed(at, other_speed(line(files, at), dialect.speeds)))
                .collect()
        }
    }
}

/// Runs the mutants of one program; returns how many there were, and those that were not found.
fn tried(
    job: &str,
    backend: &dyn Backend,
    reference: &Reference<'_>,
    files: &[ProgramFile],
) -> (usize, Vec<String>) {
    assert_eq!(reference.differences(files), 0, "{job} for {}", backend.id());
    let dialect = dialect(backend.id());
    let (mut count, mut missed) = (0, Vec::new());
    for kind in KINDS {
        for (at, mutant) in mutants(files, &dialect, kind) {
            count += 1;
            if reference.differences(&mutant) == 0 {
                let (name, text) = (&files[at.0].name, line(files, at));
                missed.push(format!(
                    "{job} for {}: {kind:?} in {name}:{}: {text}",
                    backend.id(),
                    at.1 + 1
                ));
            }
        }
    }
    (count, missed)
}

fn jobs() -> Vec<String> {
    let names = files("examples", ".vcut").into_iter().filter_map(|file| {
        let name = file.path.strip_prefix("examples/")?.to_owned();
        (!name.contains('/')).then_some(name)
    });
    names.collect()
}

#[test]
fn every_mutant_of_every_example_is_found() {
    let folder = Files::of(root().join("examples"));
    let mut missed = Vec::new();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for job in jobs() {
        let outcome = compile(&job, &folder);
        for backend in registry::backends() {
            // Jobs that are meant to fail have no program, and not every target drives the job's machine.
            let Ok(Some(written)) = driver::write(&outcome, backend) else {
                continue;
            };
            let reached = outcome
                .compiled
                .as_ref()
                .and_then(|compiled| compiled.program.reached());
            let reader = backend.reader().unwrap();
            let fresh = Fresh::of(
                outcome.job.as_ref(),
                outcome.plan.as_ref(),
                reached,
                &written,
                reader,
            );
            let (count, more) = tried(&job, backend, &Reference::new(fresh.unwrap()), &written.files);
            *counts.entry(backend.id()).or_default() += count;
            missed.extend(more);
        }
    }
    println!("mutants: {counts:?}");
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    assert_eq!(counts.values().sum::<usize>(), MUTANTS);
}
