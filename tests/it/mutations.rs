//! Whatever is changed in a program is found: mutants of the programs of all examples, for all targets that take them.
//!
//! A mutant differs from its program in one place: a digit, a line that is gone, two neighbouring lines swapped, a speed.
//! Which mutants are made follows from the text alone, so that every run makes the same ones. What stands in comments is
//! left alone, and so are mutants that read the same, such as two equal lines swapped.

use crate::shop::{self, Pairing, compiled, compiled_for, compiling, has_words_for};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use vcutc::driver;
use vcutc::readback::{Fresh, Reference};
use vcutc::registry;
use vcutc_backend_api::readback::{ProgramFile, normalized};

/// Mutants of each kind and program, at most.
const MOST_OF_A_KIND: usize = 40;

/// Mutants that are made, and found, of the programs of each dialect. `docs/verify.md` says so too.
const MUTANTS: &[(&str, usize)] = &[
    ("krl", 4480),
    ("rapid", 2981),
    ("linuxcnc", 5280),
    ("fanuc", 4640),
    ("sinumerik", 5280),
    ("heidenhain", 5280),
];

/// Programs that are worked on at once.
const WORKERS: usize = 4;

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
    name: &'static str,
    /// A comment goes from the first of these to the end of its line.
    comments: &'static [char],
    /// What begins a line that the controller passes over.
    passed_over: &'static str,
    /// Whether blocks have numbers, which mean nothing.
    numbered: bool,
    /// Words in front of a speed.
    speeds: &'static [&'static str],
}

const DIALECTS: &[Dialect] = &[
    Dialect {
        name: "krl",
        comments: &[';'],
        passed_over: "&",
        numbered: false,
        speeds: &["$VEL", "#VEL_PTP,"],
    },
    Dialect {
        name: "rapid",
        comments: &['!'],
        passed_over: "<",
        numbered: false,
        speeds: &["speeddata"],
    },
    Dialect {
        name: "linuxcnc",
        comments: &['(', ';'],
        passed_over: "<",
        numbered: true,
        speeds: &[" F"],
    },
    Dialect {
        name: "fanuc",
        comments: &['('],
        passed_over: "<",
        numbered: true,
        speeds: &[" F"],
    },
    Dialect {
        name: "sinumerik",
        comments: &[';'],
        passed_over: "<",
        numbered: true,
        speeds: &[" F"],
    },
    Dialect {
        name: "heidenhain",
        comments: &[';'],
        passed_over: "*",
        numbered: true,
        speeds: &[" F"],
    },
];

impl Dialect {
    /// How much of a line, from behind its number, is no comment.
    fn code<'l>(&self, line: &'l str) -> &'l str {
        let line = if self.numbered {
            let line = line.trim_start();
            let behind = line.strip_prefix('N').unwrap_or(line);
            behind.trim_start_matches(|c: char| c.is_ascii_digit())
        } else {
            line
        };
        let code = line.split(self.comments).next().unwrap_or_default().trim();
        if code.starts_with(self.passed_over) {
            ""
        } else {
            code
        }
    }
}

/// A place of a program: a file and a line of it.
type Line = (usize, usize);

/// All lines that hold more than comments, and their texts.
fn lines_of_code<'f>(files: &'f [ProgramFile], dialect: &Dialect) -> Vec<(Line, &'f str)> {
    let all = files.iter().enumerate().flat_map(|(file, program)| {
        let lines = program.text.lines().enumerate();
        lines.map(move |(line, text)| ((file, line), text))
    });
    all.filter(|(_, text)| !dialect.code(text).is_empty()).collect()
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

/// The mutants of a kind, each with the line that was changed.
fn mutants<'f>(
    files: &'f [ProgramFile],
    dialect: &Dialect,
    kind: Mutation,
) -> Vec<(Line, &'f str, Vec<ProgramFile>)> {
    let lines = lines_of_code(files, dialect);
    let read = |text: &str| normalized(dialect.code(text));
    let changed = |(at, text): (Line, &'f str), other: String| {
        (read(text) != read(&other)).then(|| (at, text, with_line(files, at, Some(&other))))
    };
    match kind {
        Mutation::Digit => {
            let has_digits =
                |(_, text): &(Line, &str)| dialect.code(text).contains(|c: char| c.is_ascii_digit());
            let with_digits: Vec<_> = lines.into_iter().filter(has_digits).collect();
            let chosen = spread(&with_digits, MOST_OF_A_KIND).into_iter().enumerate();
            chosen
                .filter_map(|(salt, line)| {
                    changed(line, other_digit(line.1, dialect.code(line.1), salt * 7)?)
                })
                .collect()
        }
        Mutation::Dropped => spread(&lines, MOST_OF_A_KIND)
            .into_iter()
            .map(|(at, text)| (at, text, with_line(files, at, None)))
            .collect(),
        Mutation::Swapped => {
            let is_pair = |((one, first), (other, second)): &((Line, &str), (Line, &str))| {
                one.0 == other.0 && one.1 + 1 == other.1 && read(first) != read(second)
            };
            let pairs: Vec<_> = lines
                .windows(2)
                .map(|pair| (pair[0], pair[1]))
                .filter(is_pair)
                .collect();
            let swapped = spread(&pairs, MOST_OF_A_KIND).into_iter();
            swapped
                .map(|((one, first), (other, second))| {
                    let mutant = with_line(files, one, Some(second));
                    (one, first, with_line(&mutant, other, Some(first)))
                })
                .collect()
        }
        Mutation::Speed => {
            let has_speed =
                |(_, text): &(Line, &str)| other_speed(dialect.code(text), dialect.speeds).is_some();
            let with_speeds: Vec<_> = lines.into_iter().filter(has_speed).collect();
            spread(&with_speeds, MOST_OF_A_KIND)
                .into_iter()
                .filter_map(|line| changed(line, other_speed(line.1, dialect.speeds)?))
                .collect()
        }
    }
}

/// A program of an example.
struct Example {
    job: String,
    machine: Option<&'static str>,
    target: &'static str,
    dialect: &'static Dialect,
}

/// The programs of all examples, for all targets of this build and all dialects of those.
fn examples() -> Vec<Example> {
    let mut examples = Vec::new();
    for dialect in DIALECTS {
        for (job, pairings) in compiling() {
            if !has_words_for(dialect.name, &job) {
                continue;
            }
            let is_of = |pairing: &&Pairing| match pairing.target {
                "gcode" => shop::DIALECTS.iter().any(|(name, _)| *name == dialect.name),
                target => target == dialect.name,
            };
            for pairing in pairings.iter().filter(is_of) {
                examples.push(Example {
                    job: job.clone(),
                    machine: pairing.machine,
                    target: pairing.target,
                    dialect,
                });
            }
        }
    }
    examples.retain(|example| registry::backend(example.target).is_some());
    examples
}

impl Example {
    /// Runs all mutants; returns how many there were, and those that were not found.
    fn tried(&self) -> (usize, Vec<String>) {
        let outcome = match self.target {
            "gcode" => compiled_for(self.dialect.name, self.machine, &self.job),
            _ => compiled(self.machine, &self.job),
        };
        let backend = registry::backend(self.target).unwrap();
        let written = driver::write(outcome, backend).unwrap().unwrap();
        let reached = outcome.compiled.as_ref().unwrap().program.reached();
        let (job, plan) = (outcome.job.as_ref(), outcome.plan.as_ref());
        let reader = backend.reader().unwrap();
        let reference = Reference::new(Fresh::of(job, plan, reached, &written, reader).unwrap());
        assert_eq!(reference.differences(&written.files), 0, "{}", self.job);
        let (mut count, mut missed) = (0, Vec::new());
        for kind in KINDS {
            for (at, text, mutant) in mutants(&written.files, self.dialect, kind) {
                count += 1;
                if reference.differences(&mutant) == 0 {
                    let file = &written.files[at.0].name;
                    let (job, dialect, number) = (&self.job, self.dialect.name, at.1 + 1);
                    missed.push(format!(
                        "{job} for {dialect}: {kind:?} in {file}:{number}: {text}"
                    ));
                }
            }
        }
        (count, missed)
    }
}

#[test]
fn every_mutant_of_every_example_is_found() {
    let examples = examples();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut tried = Vec::new();
        while let Some(example) = examples.get(next.fetch_add(1, Ordering::Relaxed)) {
            tried.push((example.dialect.name, example.tried()));
        }
        tried
    };
    let tried: Vec<_> = thread::scope(|scope| {
        let workers: Vec<_> = (0..WORKERS).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .flat_map(|worker| worker.join().unwrap())
            .collect()
    });
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut missed = Vec::new();
    for (dialect, (count, more)) in tried {
        *counts.entry(dialect).or_default() += count;
        missed.extend(more);
    }
    assert!(
        missed.is_empty(),
        "{} were missed:\n{}",
        missed.len(),
        missed.join("\n")
    );
    let expected: BTreeMap<&str, usize> = MUTANTS
        .iter()
        .copied()
        .filter(|(dialect, _)| counts.contains_key(dialect))
        .collect();
    assert_eq!(counts, expected);
}
