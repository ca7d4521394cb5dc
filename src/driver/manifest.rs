//! The list of a repository's programs, `vcut.toml`, read with every fault at its place.
//!
//! It says which jobs are compiled for which targets into which folders, so that one command does, or checks, all of them.
//! Nothing is looked up here: the caller decides which files a pattern names and which targets exist.

pub mod pattern;

use crate::numbers::Figure;
use pattern::Pattern;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::document::{self, Wording};
use vcutc_diagnostics::schema::faults;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};
use vcutc_diagnostics::source::{FileId, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

/// The name of the file, looked for in the current folder and those above it.
pub const FILE_NAME: &str = "vcut.toml";

const WORDING: Wording = Wording {
    name: "list of programs",
    looks: "`jobs = \"jobs/*.vcut\"` below headings `[[program]]`",
    code: Code::BadManifest,
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

const FIELDS: &[FieldSpec] = &[
    optional(NAME),
    value(JOBS, "\"jobs/*.vcut\"").required(),
    optional(TARGET),
    optional(TARGETS),
    value(OUTPUT, "\"programs\"").required(),
    optional(MACHINE),
    optional(SET),
    optional(OPTIONS),
];

/// Largest tolerance.
const MOST_PERCENT: f64 = 1000.0;

/// Places in a folder's name that are filled in for each program.
const BLANKS: [&str; 2] = ["{job}", "{target}"];

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
    pub file: Spanned<String>,
    /// By how much each may become worse; at least one.
    pub tolerances: Vec<Tolerance>,
}

/// By how much a figure may become worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    pub figure: Figure,
    /// By how many percent; zero or more.
    pub percent: Spanned<f64>,
}

/// One section: some jobs, some targets, and what goes for all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// A name by which `vcutc build NAME` chooses it.
    pub name: Option<String>,
    pub jobs: Vec<Spanned<Pattern>>,
    pub targets: Vec<Spanned<String>>,
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
pub fn parse(file: FileId, text: &str) -> Result<Manifest, Vec<Diagnostic>> {
    document::parse(file, text, WORDING, |root, faults| read(&root, faults))
}

fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Manifest> {
    root.allow(&[PROGRAM, BASELINE], faults);
    let sections = root.tables(PROGRAM, FIELDS, faults);
    if !root.has(PROGRAM) {
        faults.push(
            root.fault(root.span(), "the list has no programs", "no section `[[program]]`")
                .help("add `[[program]]` with `jobs = \"jobs/*.vcut\"`, `target = \"krl\"` and `output = \"programs\"`"),
        );
    }
    let entries: Vec<_> = sections.iter().map(|section| entry(section, faults)).collect();
    twice(&sections, faults);
    let entries: Option<Vec<Entry>> = entries.into_iter().collect();
    let baseline = baseline(root, faults);
    Some(Manifest {
        entries: entries?,
        baseline,
    })
}

fn entry(section: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Entry> {
    let jobs = jobs(section, faults);
    let targets = targets(section, faults);
    let output = output(section, faults);
    Some(Entry {
        name: section.text(NAME, faults).map(str::to_owned),
        machine: section.text(MACHINE, faults).map(str::to_owned),
        set: section.texts(SET, faults),
        options: section.texts(OPTIONS, faults),
        jobs: jobs?,
        targets: targets?,
        output: output?,
    })
}

/// None when there is none, or a faulty one.
fn baseline(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Baseline> {
    let names = Figure::ALL.map(|(name, _)| name);
    let file = value(FILE, "\"numbers.json\"").required();
    let fields: Vec<FieldSpec> = core::iter::once(file).chain(names.map(optional)).collect();
    let section = root.table(BASELINE, &fields, faults)?;
    let tolerances: Vec<Tolerance> = Figure::ALL
        .iter()
        .filter_map(|&(name, figure)| {
            let percent = percent(&section, name, faults)?;
            Some(Tolerance { figure, percent })
        })
        .collect();
    if !names.iter().any(|name| section.has(name)) {
        let message = format!("`[{BASELINE}]` does not limit any figure");
        let help = format!(
            "add a line such as `time = \"2 %\"`; figures are {}",
            names.join(", ")
        );
        faults.push(section.fault(section.span(), message, "no figure").help(help));
    }
    let file = placed_text(&section, FILE, faults)?;
    if file.node.is_empty() {
        faults.push(nothing(&section, FILE, "name a file, such as `numbers.json`"));
    }
    Some(Baseline { file, tolerances })
}

/// A tolerance such as `2 %`.
fn percent(section: &Table<'_>, name: &str, faults: &mut Vec<Diagnostic>) -> Option<Spanned<f64>> {
    let text = placed_text(section, name, faults)?;
    let number = text
        .node
        .strip_suffix('%')
        .and_then(|number| number.trim().parse::<f64>().ok());
    let legal = number.filter(|number| (0.0..=MOST_PERCENT).contains(number));
    if legal.is_none() {
        let message = format!(
            "`{name}` takes from 0 to {MOST_PERCENT} percent, not `{}`",
            text.node
        );
        faults.push(
            section
                .fault(text.span, message, "not such a share")
                .help("write it like \"2 %\""),
        );
    }
    Some(Spanned::new(legal?, text.span))
}

fn placed_text(section: &Table<'_>, key: &str, faults: &mut Vec<Diagnostic>) -> Option<Spanned<String>> {
    let text = section.text(key, faults)?;
    Some(Spanned::new(text.to_owned(), section.span_of(key)))
}

fn jobs(section: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Vec<Spanned<Pattern>>> {
    let texts = section.placed_texts(JOBS, faults);
    if section.has(JOBS) && texts.is_empty() {
        faults.push(nothing(section, JOBS, "name a job: `jobs = \"jobs/rib.vcut\"`"));
    }
    let jobs: Vec<_> = texts
        .into_iter()
        .map(|text| match Pattern::new(text.node) {
            Ok(pattern) => Some(Spanned::new(pattern, text.span)),
            Err(why) => {
                let message = format!("`{JOBS}` takes paths relative to the folder of {FILE_NAME}: {why}");
                let fault = section.fault(text.span, message, "not such a path");
                faults.push(fault.help("write it like `jobs/*.vcut`"));
                None
            }
        })
        .collect();
    jobs.into_iter().collect()
}

fn targets(section: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Vec<Spanned<String>>> {
    match (section.has(TARGET), section.has(TARGETS)) {
        (false, false) => {
            let missing = faults::missing(Code::BadManifest, "`[[program]]`", &[TARGET], section.span());
            let help = "add `target = \"krl\"`, or `targets = [\"krl\", \"rapid\"]`";
            faults.push(missing.help(help));
            None
        }
        (true, true) => {
            let message = format!("`{TARGET}` and `{TARGETS}` say the same thing");
            let fault = section.fault(section.span_of(TARGETS), message, "one of the two is enough");
            faults.push(fault.help(format!(
                "put all of them into `{TARGETS}`, and leave `{TARGET}` out"
            )));
            None
        }
        (true, false) => Some(vec![placed_text(section, TARGET, faults)?]),
        (false, true) => {
            let texts = section.placed_texts(TARGETS, faults);
            if texts.is_empty() {
                faults.push(nothing(section, TARGETS, "name a target: `targets = [\"krl\"]`"));
            }
            Some(texts.into_iter().map(|text| text.map(str::to_owned)).collect())
        }
    }
}

fn nothing(section: &Table<'_>, key: &str, help: &str) -> Diagnostic {
    let message = format!("`{key}` is empty");
    section
        .fault(section.span_of(key), message, "nothing here")
        .help(help)
}

fn output(section: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<String> {
    let output = section.text(OUTPUT, faults)?;
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
            let message = format!("`{OUTPUT}` {fault}");
            faults.push(
                section
                    .fault(section.span_of(OUTPUT), message, "not a folder's name")
                    .help("write it like `programs`, `programs/{target}` or `programs/{job}`"),
            );
            None
        }
    }
}

/// The first word in braces that is not known.
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
fn twice(sections: &[Table<'_>], faults: &mut Vec<Diagnostic>) {
    let mut ignored = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for section in sections {
        let Some(name) = section.text(NAME, &mut ignored) else {
            continue;
        };
        if !seen.insert(name) {
            faults.push(
                section
                    .fault(
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
