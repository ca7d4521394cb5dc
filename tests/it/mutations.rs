//! Whatever is changed in a program is found: mutants of the programs of all examples, for all targets that take them.
//!
//! A mutant differs from its program in one place: a digit, a line that is gone, two neighbouring lines swapped, a speed, a word that
//! is gone or has another number.
//! Which mutants are made follows from the text alone, so that every run makes the same ones. What stands in comments is
//! left alone, and so are mutants that read the same, such as two equal lines swapped.

use crate::pipeline::compile_on;
use crate::repository::read;
use crate::shop::{self, Pairing, compiled, compiled_for, compiling, has_words_for};
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use vcutc::driver::{self, Outcome};
use vcutc::readback::{Fresh, Reference};
use vcutc::registry;
use vcutc_backend_api::readback::{ProgramFile, normalized};

/// Mutants of each kind and program, at most.
const MOST_OF_A_KIND: usize = 40;

/// Mutants that are made, and found, of the programs of each dialect. `docs/verify.md` says so too.
const MUTANTS: &[(&str, usize)] = &[
    ("krl", 7113),
    ("rapid", 4770),
    ("linuxcnc", 7895),
    ("fanuc", 6591),
    ("sinumerik", 7364),
    ("heidenhain", 7028),
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
    Word,
}

const KINDS: [Mutation; 5] = [
    Mutation::Digit,
    Mutation::Dropped,
    Mutation::Swapped,
    Mutation::Speed,
    Mutation::Word,
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
    /// How much of a line, after its number, is not a comment.
    fn code<'l>(&self, line: &'l str) -> &'l str {
        let line = if self.numbered {
            let line = line.trim_start();
            let after = line.strip_prefix('N').unwrap_or(line);
            after.trim_start_matches(|c: char| c.is_ascii_digit())
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

/// A line with the first number after a word for a speed half as large again.
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

/// The words of a line of code, each with what it is one of: its letters, of words such as `G2` and `M6` with their number.
fn words(code: &str) -> Vec<(Range<usize>, String)> {
    let mut words = Vec::new();
    let mut rest = 0;
    while let Some(start) = code[rest..].find(|c: char| c.is_ascii_alphabetic() || c == '$') {
        let start = rest + start;
        let is_of_word = |c: char| c.is_ascii_alphanumeric() || "_$".contains(c);
        let end = code[start..].find(|c| !is_of_word(c));
        let end = end.map_or(code.len(), |end| start + end);
        let word = &code[start..end];
        let is_code = word[1..].bytes().all(|byte| byte.is_ascii_digit()) && word.starts_with(['G', 'M']);
        let kind = if is_code {
            word
        } else {
            word.trim_end_matches(|c: char| c.is_ascii_digit())
        };
        words.push((start..end, kind.to_owned()));
        rest = end;
    }
    words
}

/// Where words of each kind stand first, in the order of the program.
fn first_words<'f>(lines: &[(Line, &'f str)], dialect: &Dialect) -> Vec<(Line, &'f str, Range<usize>)> {
    let mut known = BTreeSet::new();
    let all = lines.iter().flat_map(|&(at, text)| {
        let code = dialect.code(text);
        let start = text.find(code).unwrap_or_default();
        let words = words(code).into_iter();
        words.map(move |(word, kind)| (at, text, start + word.start..start + word.end, kind))
    });
    all.filter(|(.., kind)| known.insert(kind.clone()))
        .map(|(at, text, word, _)| (at, text, word))
        .collect()
}

/// A line without one of its words, and, where the word ends with a digit, with the next one in its place.
fn other_words(text: &str, word: Range<usize>) -> Vec<String> {
    let gone = format!("{}{}", &text[..word.start], &text[word.end..]);
    let last = text[..word.end]
        .chars()
        .next_back()
        .and_then(|last| last.to_digit(10));
    let next = last.map(|digit| {
        let number = (digit + 1) % 10;
        format!("{}{number}{}", &text[..word.end - 1], &text[word.end..])
    });
    [gone].into_iter().chain(next).collect()
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
        Mutation::Word => first_words(&lines, dialect)
            .into_iter()
            .flat_map(|(at, text, word)| {
                other_words(text, word)
                    .into_iter()
                    .map(move |other| (at, text, other))
            })
            .filter_map(|(at, text, other)| changed((at, text), other))
            .collect(),
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
    /// Other words in the file of its machine.
    changed: Option<Changed>,
}

/// A file of the shop with other words in it, each in the place of the one before.
#[derive(Clone, Copy)]
struct Changed {
    file: &'static str,
    words: &'static [(&'static str, &'static str)],
}

/// By hand where the shop's cells change blades by a routine, and the other way round.
const CHANGED_OTHERWISE: Changed = Changed {
    file: "shop/changing_cells.vcut",
    words: &[
        ("by = hand", "by = someone"),
        ("by = program", "by = hand"),
        ("by = someone", "by = program"),
        ("change_routine = \"CHANGE_TOOL\"", ""),
        ("rapid {", "rapid { change_routine = \"CHANGE_TOOL\""),
    ],
};

/// The other kind of motions of a KUKA.
const BY_SPLINES: Changed = Changed {
    file: "shop/pocket_cells.vcut",
    words: &[("krl {", "krl { motion = spline")],
};

/// Programs with words that no example has: job, machine and dialect.
const OTHERS: [(&str, &str, &str, Changed); 5] = [
    ("two_blades.vcut", "changing_cell", "krl", CHANGED_OTHERWISE),
    ("hill_rect.vcut", "abb_changing_cell", "rapid", CHANGED_OTHERWISE),
    (
        "two_blades.vcut",
        "changing_gantry",
        "linuxcnc",
        CHANGED_OTHERWISE,
    ),
    ("seat.vcut", "pocket_cell", "krl", BY_SPLINES),
    ("tray.vcut", "pocket_cell", "krl", BY_SPLINES),
];

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
                    changed: None,
                });
            }
        }
        for &(job, machine, _, changed) in OTHERS.iter().filter(|(_, _, name, _)| *name == dialect.name) {
            examples.push(Example {
                job: job.to_owned(),
                machine: Some(machine),
                target: if dialect.numbered { "gcode" } else { dialect.name },
                dialect,
                changed: Some(changed),
            });
        }
    }
    examples.retain(|example| registry::backend(example.target).is_some());
    examples
}

impl Changed {
    fn compiled(self, machine: Option<&str>, job: &str) -> Outcome {
        let text = read(&format!("examples/{}", self.file));
        let changed = self.words.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        });
        compile_on(machine, job, &shop::folder().with(self.file, changed))
    }
}

impl Example {
    /// Runs all mutants; returns how many there were, and those that were not found.
    fn tried(&self) -> (usize, Vec<String>) {
        let otherwise = self
            .changed
            .map(|changed| changed.compiled(self.machine, &self.job));
        let outcome = match (&otherwise, self.target) {
            (Some(otherwise), _) => otherwise,
            (None, "gcode") => compiled_for(self.dialect.name, self.machine, &self.job),
            (None, _) => compiled(self.machine, &self.job),
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
