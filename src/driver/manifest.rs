//! The list of a repository's programs, `vcut.toml`, read with every flaw at its place.
//!
//! It says which jobs are compiled for which targets into which folders, so that one command does, or checks, all of them.
//! Nothing is looked up here: which files a pattern names is for who holds the files, which targets exist for who has them.

pub mod pattern;

use crate::numbers::Figure;
use core::ops::Range;
use pattern::Pattern;
use vcutc_diagnostics::document::flaw::Flaw;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::document::{self, Wording};

/// The name of the file, looked for in the current folder and those above it.
pub const FILE_NAME: &str = "vcut.toml";

const WORDING: Wording = Wording {
    name: "list of programs",
    looks: "`jobs = \"jobs/*.vcut\"` below headings `[[program]]`",
};

const PROGRAM: &str = "program";
const NAME: &str = "name";
const JOBS: &str = "jobs";
const TARGET: &str = "target";
const TARGETS: &str = "targets";
const OUTPUT: &str = "output";
const MACHINE: &str = "machine";
const SET: &str = "set";
const OPTIONS: &str = "options";
const BASELINE: &str = "baseline";
const FILE: &str = "file";

const KEYS: &[&str] = &[NAME, JOBS, TARGET, TARGETS, OUTPUT, MACHINE, SET, OPTIONS];

/// Largest tolerance.
const MOST_PERCENT: f64 = 1000.0;

/// Places in a folder's name that are filled in for each program.
const BLANKS: [&str; 2] = ["{job}", "{target}"];

/// A value with where it stands, in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed<T> {
    pub value: T,
    pub span: Range<usize>,
}

/// The programs of a repository.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Manifest {
    /// Its sections, in order.
    pub entries: Vec<Entry>,
    /// The figures that programs are held to.
    pub baseline: Option<Baseline>,
}

/// The figures that programs are held to.
#[derive(Clone, Debug, PartialEq)]
pub struct Baseline {
    /// The file with the figures, relative to the folder of the list.
    pub file: Placed<String>,
    /// By how much each may become worse; at least one.
    pub tolerances: Vec<Tolerance>,
}

/// By how much a figure may become worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    pub figure: Figure,
    /// By how many percent; zero or more.
    pub percent: Placed<f64>,
}

/// One section: some jobs, some targets, and what goes for all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// A name by which `vcutc build NAME` chooses it.
    pub name: Option<String>,
    pub jobs: Vec<Placed<Pattern>>,
    pub targets: Vec<Placed<String>>,
    /// Where programs go, relative to the folder of the list; may hold `{job}` and `{target}`.
    pub output: String,
    /// As `--machine`.
    pub machine: Option<String>,
    /// As `--set`.
    pub set: Vec<String>,
    /// As `--option`.
    pub options: Vec<String>,
}

impl Entry {
    /// The folder for the program of a job (by the name of its file without folders and extension) and a target.
    #[must_use]
    pub fn folder(&self, job: &str, target: &str) -> String {
        // One pass, so that a job called `{target}` is left as it is.
        let mut folder = String::new();
        let mut rest = self.output.as_str();
        while let Some(open) = rest.find('{') {
            let (before, blank) = rest.split_at(open);
            folder.push_str(before);
            let (value, length) = match BLANKS.map(|name| blank.starts_with(name)) {
                [true, _] => (job, BLANKS[0].len()),
                [_, true] => (target, BLANKS[1].len()),
                [false, false] => ("{", 1),
            };
            folder.push_str(value);
            rest = blank.get(length..).unwrap_or_default();
        }
        folder + rest
    }
}

/// Reads a list of programs.
///
/// # Errors
/// What is wrong with it, in the order of the text.
pub fn parse(text: &str) -> Result<Manifest, Vec<Flaw>> {
    document::parse(text, WORDING, read)
}

fn read(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<Manifest> {
    root.allow(&[PROGRAM, BASELINE], flaws);
    let sections = root.tables(PROGRAM, KEYS, flaws);
    if !root.has(PROGRAM) {
        flaws.push(
            Flaw::new(0..0, "the list has no programs", "no section `[[program]]`")
                .help("add `[[program]]` with `jobs = \"jobs/*.vcut\"`, `target = \"krl\"` and `output = \"programs\"`"),
        );
    }
    let entries: Vec<_> = sections.iter().map(|section| entry(section, flaws)).collect();
    twice(&sections, flaws);
    let entries: Option<Vec<Entry>> = entries.into_iter().collect();
    let baseline = baseline(root, flaws);
    Some(Manifest {
        entries: entries?,
        baseline,
    })
}

fn entry(section: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<Entry> {
    for (key, line) in [
        (JOBS, "jobs = \"jobs/*.vcut\""),
        (OUTPUT, "output = \"programs\""),
    ] {
        if !section.has(key) {
            flaws.push(lacks(section, key, &format!("add a line such as `{line}`")));
        }
    }
    let jobs = jobs(section, flaws);
    let targets = targets(section, flaws);
    let output = output(section, flaws);
    Some(Entry {
        name: section.text(NAME, flaws).map(str::to_owned),
        machine: section.text(MACHINE, flaws).map(str::to_owned),
        set: section.texts(SET, flaws),
        options: section.texts(OPTIONS, flaws),
        jobs: jobs?,
        targets: targets?,
        output: output?,
    })
}

/// None when there is none, or a faulty one.
fn baseline(root: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<Baseline> {
    let names = Figure::ALL.map(|(name, _)| name);
    let keys: Vec<&str> = core::iter::once(FILE).chain(names).collect();
    let section = root.table(BASELINE, &keys, flaws)?;
    section.require(&[(FILE, "file = \"numbers.json\"")], flaws);
    let tolerances: Vec<Tolerance> = Figure::ALL
        .iter()
        .filter_map(|&(name, figure)| {
            let percent = percent(&section, name, flaws)?;
            Some(Tolerance { figure, percent })
        })
        .collect();
    if !names.iter().any(|name| section.has(name)) {
        let message = format!("`[{BASELINE}]` does not limit any figure");
        let help = format!(
            "add a line such as `time = \"2 %\"`; figures are {}",
            names.join(", ")
        );
        flaws.push(Flaw::new(section.span(), message, "no figure").help(help));
    }
    let value = section.text(FILE, flaws)?.to_owned();
    let span = section.span_of(FILE);
    if value.is_empty() {
        flaws.push(nothing(&section, FILE, "name a file, such as `numbers.json`"));
    }
    Some(Baseline {
        file: Placed { value, span },
        tolerances,
    })
}

/// A tolerance such as `2 %`.
fn percent(section: &Table<'_>, name: &str, flaws: &mut Vec<Flaw>) -> Option<Placed<f64>> {
    let text = section.text(name, flaws)?;
    let span = section.span_of(name);
    let number = text
        .strip_suffix('%')
        .and_then(|number| number.trim().parse::<f64>().ok());
    match number {
        Some(value) if (0.0..=MOST_PERCENT).contains(&value) => Some(Placed { value, span }),
        Some(_) | None => {
            let message = format!("`{name}` takes from 0 to {MOST_PERCENT} percent, not `{text}`");
            flaws.push(Flaw::new(span, message, "not such a share").help("write it like \"2 %\""));
            None
        }
    }
}

fn jobs(section: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<Vec<Placed<Pattern>>> {
    let texts = section.placed_texts(JOBS, flaws);
    if section.has(JOBS) && texts.is_empty() {
        flaws.push(nothing(section, JOBS, "name a job: `jobs = \"jobs/rib.vcut\"`"));
    }
    let jobs: Vec<_> = texts
        .into_iter()
        .map(|(text, span)| match Pattern::new(text) {
            Ok(value) => Some(Placed { value, span }),
            Err(why) => {
                let message = format!("`{JOBS}` takes paths relative to the folder of {FILE_NAME}: {why}");
                flaws.push(Flaw::new(span, message, "not such a path").help("write it like `jobs/*.vcut`"));
                None
            }
        })
        .collect();
    jobs.into_iter().collect()
}

fn targets(section: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<Vec<Placed<String>>> {
    match (section.has(TARGET), section.has(TARGETS)) {
        (false, false) => {
            let help = "add `target = \"krl\"`, or `targets = [\"krl\", \"rapid\"]`";
            flaws.push(lacks(section, TARGET, help));
            None
        }
        (true, true) => {
            flaws.push(
                Flaw::new(
                    section.span_of(TARGETS),
                    format!("`{TARGET}` and `{TARGETS}` say the same thing"),
                    "one of the two is enough",
                )
                .help(format!(
                    "put all of them into `{TARGETS}`, and leave `{TARGET}` out"
                )),
            );
            None
        }
        (true, false) => {
            let value = section.text(TARGET, flaws)?.to_owned();
            let span = section.span_of(TARGET);
            Some(vec![Placed { value, span }])
        }
        (false, true) => {
            let texts = section.placed_texts(TARGETS, flaws);
            if texts.is_empty() {
                flaws.push(nothing(section, TARGETS, "name a target: `targets = [\"krl\"]`"));
            }
            let placed = |(text, span): (&str, Range<usize>)| Placed {
                value: text.to_owned(),
                span,
            };
            Some(texts.into_iter().map(placed).collect())
        }
    }
}

fn lacks(section: &Table<'_>, key: &str, help: &str) -> Flaw {
    let message = format!("`[[{PROGRAM}]]` lacks `{key}`");
    Flaw::new(section.span(), message, format!("missing: `{key}`")).help(help)
}

fn nothing(section: &Table<'_>, key: &str, help: &str) -> Flaw {
    Flaw::new(section.span_of(key), format!("`{key}` is empty"), "nothing here").help(help)
}

fn output(section: &Table<'_>, flaws: &mut Vec<Flaw>) -> Option<String> {
    let output = section.text(OUTPUT, flaws)?;
    let fault = if output.is_empty() {
        Some("is empty".to_owned())
    } else if output.contains(['\n', '\r']) {
        Some("has a line break".to_owned())
    } else {
        unknown_blank(output).map(|blank| format!("has `{blank}`, which nothing fills in"))
    };
    match fault {
        None => Some(output.to_owned()),
        Some(fault) => {
            flaws.push(
                Flaw::new(
                    section.span_of(OUTPUT),
                    format!("`{OUTPUT}` {fault}"),
                    "not a folder's name",
                )
                .help("write it like `programs`, `programs/{target}` or `programs/{job}`"),
            );
            None
        }
    }
}

/// The first word in braces that is none of ours.
fn unknown_blank(output: &str) -> Option<&str> {
    let mut rest = output;
    while let Some(open) = rest.find('{') {
        let blank = rest.get(open..)?;
        let known = BLANKS.iter().find(|name| blank.starts_with(**name));
        let Some(known) = known else {
            let end = blank.find('}').map_or(blank.len(), |end| end + 1);
            return blank.get(..end);
        };
        rest = blank.get(known.len()..)?;
    }
    None
}

/// Reports names that two sections have.
fn twice(sections: &[Table<'_>], flaws: &mut Vec<Flaw>) {
    let mut ignored = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for section in sections {
        let Some(name) = section.text(NAME, &mut ignored) else {
            continue;
        };
        if !seen.insert(name) {
            flaws.push(
                Flaw::new(
                    section.span_of(NAME),
                    format!("two programs are called `{name}`"),
                    "named again here",
                )
                .help("give each a different name, or none"),
            );
        }
    }
}

#[cfg(test)]
mod tests;
