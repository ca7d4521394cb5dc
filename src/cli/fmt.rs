//! `vcutc fmt [FILE|FOLDER|-]...`: job files in the one layout.
//!
//! A file with mistakes is reported and left alone, and so is one that has the layout already; every other one is replaced whole
//! or not at all. One file in trouble does not keep the others from being formatted.

use super::Exit;
use super::args::FmtArgs;
use super::console::{Console, Failure};
use super::files::{Disk, load_file};
use super::output::rewrite;
use super::snapshot::{Differences, Fate};
use serde::Serialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{Loader, SourceMap, Span, text_from_bytes};
use vcutc_diff::{FileChange, Sides, compare};
use vcutc_syntax as syntax;
use vcutc_syntax::format::format;

/// How the layout is called where a job is named that gives a file.
const NAME: &str = "vcutc fmt";
/// How deep folders are searched. Links are not followed, so that only a disk that is broken is deeper.
const DEEPEST: usize = 64;

/// Formats files.
pub(super) fn fmt(args: &FmtArgs, console: &Console) -> Exit {
    let fate = if args.check { Fate::Compare } else { Fate::Write };
    if args.paths.iter().any(|path| path == "-") {
        return match args.paths.as_slice() {
            [_] => standard_input(fate, console),
            _ => console.failure(&Failure::new("a job from standard input must be formatted alone")),
        };
    }
    let mut run = Run {
        fate,
        console,
        tally: Tally::default(),
        differences: Differences::default(),
    };
    let exits: Vec<Exit> = args
        .paths
        .iter()
        .map(|path| run.path(Path::new(path), 0))
        .collect();
    run.finish(exits.into_iter().max().unwrap_or(Exit::Success))
}

/// Formats what comes from standard input to standard output.
fn standard_input(fate: Fate, console: &Console) -> Exit {
    let disk = Disk::around("-");
    let bytes = match disk.load(disk.job()) {
        Ok(bytes) => bytes,
        Err(error) => {
            return console.failure(&Failure::new(format!("cannot read standard input: {error}")));
        }
    };
    let formatted = match formatted(disk.job(), bytes.clone(), console) {
        Ok(formatted) => formatted,
        Err(exit) => return exit,
    };
    match fate {
        Fate::Write => console.document(&formatted),
        Fate::Compare => {
            let mut found = Differences::default();
            match hold(disk.job(), &bytes, &formatted, &mut found) {
                Layout::AsItShouldBe => Exit::Success,
                Layout::Other => {
                    console.differences(NAME, &found);
                    Exit::JobHasErrors
                }
            }
        }
    }
}

/// What became of the files of a run.
#[derive(Debug, Default, Serialize)]
struct Tally {
    /// Those that were not in the layout.
    formatted: Vec<String>,
    unchanged: usize,
    /// How many have mistakes, or could not be read or written.
    refused: usize,
    /// How many of those have mistakes.
    #[serde(skip)]
    mistaken: usize,
}

struct Run<'c> {
    fate: Fate,
    console: &'c Console,
    tally: Tally,
    differences: Differences,
}

/// Whether a file has the layout.
enum Layout {
    AsItShouldBe,
    Other,
}

impl Run<'_> {
    /// Formats a file, or the job files of a folder and of those in it.
    fn path(&mut self, path: &Path, depth: usize) -> Exit {
        if !path.is_dir() {
            return self.file(path);
        }
        let inside = match entries(path) {
            Ok(inside) if depth < DEEPEST => inside,
            Ok(_) => return self.refuse(path, "its folders are nested too deeply"),
            Err(error) => return self.refuse(path, &error.to_string()),
        };
        let count = self.count();
        let exit = inside
            .iter()
            .map(|name| self.path(&within(path, name), depth + 1))
            .max()
            .unwrap_or(Exit::Success);
        match (depth, exit) {
            (0, Exit::Success) if self.count() == count => {
                self.refuse(path, "it contains no job files (.vcut)")
            }
            _ => exit,
        }
    }

    fn count(&self) -> usize {
        self.tally.formatted.len() + self.tally.unchanged + self.tally.refused
    }

    fn refuse(&mut self, path: &Path, reason: &str) -> Exit {
        self.tally.refused += 1;
        let message = format!("cannot format {}: {reason}", path.display());
        self.console.failure(&Failure::new(message))
    }

    fn file(&mut self, path: &Path) -> Exit {
        let bytes = match load_file(path) {
            Ok(bytes) => bytes,
            Err(error) => return self.refuse(path, &error.to_string()),
        };
        let name = path.display().to_string();
        let formatted = match formatted(&name, bytes.clone(), self.console) {
            Ok(formatted) => formatted,
            Err(exit) => {
                self.tally.refused += 1;
                self.tally.mistaken += usize::from(core::str::from_utf8(&bytes).is_ok());
                return exit;
            }
        };
        match (hold(&name, &bytes, &formatted, &mut self.differences), self.fate) {
            (Layout::AsItShouldBe, _) => {
                self.tally.unchanged += 1;
                Exit::Success
            }
            (Layout::Other, Fate::Compare) => {
                self.tally.formatted.push(name);
                Exit::JobHasErrors
            }
            (Layout::Other, Fate::Write) => match rewrite(path, formatted.as_bytes()) {
                Ok(()) => {
                    self.tally.formatted.push(name);
                    Exit::Success
                }
                Err(reason) => self.refuse(path, &reason),
            },
        }
    }

    /// Reports the result for all files.
    fn finish(self, exit: Exit) -> Exit {
        let mut text = String::new();
        match self.fate {
            Fate::Compare => self.console.differences(NAME, &self.differences),
            Fate::Write => text.extend(
                self.tally
                    .formatted
                    .iter()
                    .map(|name| format!("formatted {name}\n")),
            ),
        }
        text += &self.tally.in_words(self.fate);
        self.console.note("formatted", &text, &self.tally);
        exit
    }
}

impl Tally {
    fn in_words(&self, fate: Fate) -> String {
        let files = |count: usize| counted(count, "file");
        let changed = match (self.formatted.len(), fate) {
            (0, _) => None,
            (count, Fate::Write) => Some(format!("{} formatted", files(count))),
            (count, Fate::Compare) => Some(format!("{} to format (run again without --check)", files(count))),
        };
        let unchanged = match (self.unchanged, &changed) {
            (0, Some(_)) => None,
            (count, None) => Some(format!("{} already formatted", files(count))),
            (count, Some(_)) => Some(format!("{count} already formatted")),
        };
        let why = match (self.refused, self.mistaken) {
            (1, 1) => "syntax error",
            (refused, mistaken) if refused == mistaken => "syntax errors",
            (_, _) => "see above",
        };
        let skipped = (self.refused > 0).then(|| format!("{} skipped ({why})", self.refused));
        let parts: Vec<String> = [changed, unchanged, skipped].into_iter().flatten().collect();
        format!("{}\n", parts.join(", "))
    }
}

/// A file of a folder, as people call it: those of the folder they are in by their names alone.
fn within(folder: &Path, name: &str) -> PathBuf {
    if folder == Path::new(".") {
        PathBuf::from(name)
    } else {
        folder.join(name)
    }
}

/// The text of a file in the layout, or how the run ends because it has none, which has been reported.
fn formatted(name: &str, bytes: Vec<u8>, console: &Console) -> Result<String, Exit> {
    let mut sources = SourceMap::default();
    let result: Result<String, Vec<Diagnostic>> = match text_from_bytes(bytes) {
        Ok(text) => {
            let file = sources.add(name, text.clone());
            format(file, &text)
        }
        Err(right) => {
            let file = sources.add(name, "");
            Err(vec![syntax::not_utf8(Span::of_bytes(file, 0..0), name, right)])
        }
    };
    result.map_err(|diagnostics| {
        console.diagnostics(&diagnostics, &sources);
        Exit::JobHasErrors
    })
}

/// Compares a text with its layout, and adds what differs to what has been found.
fn hold(name: &str, earlier: &[u8], formatted: &str, found: &mut Differences) -> Layout {
    let sides = Sides {
        earlier: Some(earlier),
        fresh: formatted.as_bytes(),
    };
    match compare(sides, &|_| None) {
        None => {
            found.same += 1;
            Layout::AsItShouldBe
        }
        Some(change) => {
            found.changes.push(FileChange {
                name: name.to_owned(),
                change,
            });
            Layout::Other
        }
    }
}

/// The job files and the folders in a folder, in the order of their names. What is hidden stays so, and links are not followed.
fn entries(folder: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let kind = entry.file_type()?;
        // A name that is not text is not the name of a job file: those are written in jobs.
        let Ok(name) = entry.file_name().into_string() else {
            continue;
        };
        let is_job = kind.is_file() && name.ends_with(".vcut");
        if !name.starts_with('.') && (is_job || kind.is_dir()) {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
