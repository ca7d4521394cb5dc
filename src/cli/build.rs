//! `vcutc build`: all programs that `vcut.toml` lists, written or compared in one run.

use super::args::BuildArgs;
use super::baseline::Keeper;
use super::batch::{self, Asking, Unit};
use super::console::{Console, Failure};
use super::files::{Disk, load_file};
use super::meant::{self, Driven};
use super::snapshot::Fate;
use super::{Exit, Targets, targets};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use vcutc_backend_api::backend::Backend;
use vcutc_diagnostics::source::{FileId, LoadError, SourceMap, Span, Spanned, join_path, text_from_bytes};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_driver::manifest::pattern::Pattern;
use vcutc_driver::manifest::{self, Entry, FILE_NAME, Manifest};
use vcutc_driver::numbers::baseline::Name;

/// Most names that are looked at for one pattern. A pattern that begins high up in a disk would never end.
const MOST_NAMES: usize = 100_000;
/// Deepest folder below the beginning of a pattern that is looked at.
const DEEPEST: usize = 32;
/// Most programs of one run.
const MOST_PROGRAMS: usize = 10_000;
/// Most folders above the current one in which the list is looked for.
const MOST_ABOVE: usize = 64;

/// Builds, or compares.
pub(super) fn build(args: &BuildArgs, targets: &Targets, console: &Console) -> Exit {
    let (path, text) = match list(args.manifest.as_deref()) {
        Ok(list) => list,
        Err(failure) => return console.failure(&failure),
    };
    let mut sources = SourceMap::default();
    let file = sources.add(path.clone(), text.clone());
    let manifest = match manifest::parse(file, &text) {
        Ok(manifest) => manifest,
        Err(faults) => {
            console.diagnostics(&faults, &sources);
            return Exit::JobHasErrors;
        }
    };
    let list = List { path, file, targets };
    let keeper = match Keeper::new(&manifest, &list.path, file, args, &mut sources) {
        Ok(keeper) => keeper,
        Err(diagnostics) => {
            console.diagnostics(&diagnostics, &sources);
            return Exit::JobHasErrors;
        }
    };
    let units = match list.units(&manifest) {
        Ok(units) => units,
        Err(diagnostics) => {
            console.diagnostics(&diagnostics, &sources);
            return Exit::JobHasErrors;
        }
    };
    let fate = if args.check { Fate::Compare } else { Fate::Write };
    let listed: Vec<Name> = units
        .iter()
        .filter_map(|(unit, _)| unit.recorded_as.clone())
        .collect();
    let units = match chosen(units, &args.programs, &list.path) {
        Ok(units) => units,
        Err(failure) => return console.failure(&failure),
    };
    let asking = Asking {
        sources: &sources,
        keeper: keeper.as_ref(),
    };
    let ran = batch::run(&units, fate, targets, Some(&asking), console);
    match keeper {
        Some(keeper) if args.accept => ran.exit.max(keeper.accept(ran.records, &listed, console)),
        Some(_) | None => ran.exit,
    }
}

/// The list's path and text: the file that was given, or the nearest one from the current folder upwards.
fn list(given: Option<&str>) -> Result<(String, String), Failure> {
    let (path, bytes) = match given {
        Some(path) => {
            let path = Disk::around(path).job().to_owned();
            let bytes = load_file(Path::new(&path)).map_err(|reason| {
                Failure::new(format!("cannot read the list of programs {path}: {reason}"))
            })?;
            (path, bytes)
        }
        None => nearest_list()?,
    };
    match text_from_bytes(bytes) {
        Ok(text) => Ok((path, text)),
        Err(_) => Err(Failure::new(format!("{path} is not UTF-8 text"))),
    }
}

fn nearest_list() -> Result<(String, Vec<u8>), Failure> {
    let mut path = FILE_NAME.to_owned();
    for _ in 0..MOST_ABOVE {
        match load_file(Path::new(&path)) {
            Ok(bytes) => return Ok((path, bytes)),
            Err(LoadError::NotFound) => path.insert_str(0, "../"),
            Err(reason) => return Err(Failure::new(format!("cannot read {path}: {reason}"))),
        }
    }
    Err(
        Failure::new(format!("there is no {FILE_NAME} in this folder or above it"))
            .help("write one (see docs/ci.md), or name it with --manifest FILE"),
    )
}

/// What is asked for, with the job as the list names it.
type Asked = (Unit, Option<String>);

/// The units that were named on the command line; all of them when none was.
fn chosen(units: Vec<Asked>, wanted: &[String], list: &str) -> Result<Vec<Unit>, Failure> {
    let is_meant = |(unit, name): &Asked, word: &str| {
        name.as_deref() == Some(word) || unit.job == join_path("", word) || stem(&unit.job) == word
    };
    let missing = wanted
        .iter()
        .find(|word| !units.iter().any(|unit| is_meant(unit, word)));
    if let Some(word) = missing {
        let names = units.iter().filter_map(|(_, name)| name.as_deref());
        let jobs = units.iter().map(|(unit, _)| stem(&unit.job));
        let known: BTreeSet<&str> = names.chain(jobs).collect();
        let failure = Failure::new(format!("{list} has no program called `{word}`"));
        return Err(match nearest(word, known.iter().copied()).first() {
            Some(near) => failure.help(format!("did you mean `{near}`?")),
            None => failure.help("give the name of a section, of a job, or the path of a job's file"),
        });
    }
    let is_wanted = |unit: &Asked| wanted.is_empty() || wanted.iter().any(|word| is_meant(unit, word));
    let chosen = units.into_iter().filter(is_wanted);
    Ok(chosen.map(|(unit, _)| unit).collect())
}

/// The name of a job's file without folders and extension.
fn stem(job: &str) -> &str {
    let name = job.rsplit_once('/').map_or(job, |(_, name)| name);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// The list at hand.
struct List<'t> {
    path: String,
    file: FileId,
    targets: &'t Targets,
}

impl List<'_> {
    /// All programs, in the order of the list; jobs of a pattern in the order of their paths.
    fn units(&self, manifest: &Manifest) -> Result<Vec<Asked>, Vec<Diagnostic>> {
        let mut units = Vec::new();
        let mut diagnostics = Vec::new();
        for entry in &manifest.entries {
            let backends: Vec<_> = entry.targets.iter().map(|target| self.backend(target)).collect();
            for pattern in &entry.jobs {
                let jobs = match self.jobs(pattern) {
                    Ok(jobs) => jobs,
                    Err(diagnostic) => {
                        diagnostics.push(*diagnostic);
                        continue;
                    }
                };
                for job in &jobs {
                    for backend in backends.iter().flatten() {
                        units.push((self.unit(entry, pattern, job, *backend), entry.name.clone()));
                    }
                }
            }
            diagnostics.extend(
                backends
                    .into_iter()
                    .filter_map(Result::err)
                    .map(|diagnostic| *diagnostic),
            );
        }
        if units.len() > MOST_PROGRAMS {
            let first = manifest.entries.first().and_then(|entry| entry.jobs.first());
            let place = first.map_or(Span::of_bytes(self.file, 0..0), |pattern| pattern.span);
            let message = format!(
                "the list has {} programs, at most {MOST_PROGRAMS} are built in one run",
                units.len()
            );
            diagnostics.push(
                Diagnostic::new(Code::BadManifest, message, place, "from here on")
                    .help("split it into several lists, and give each with --manifest"),
            );
        }
        if diagnostics.is_empty() {
            Ok(units)
        } else {
            Err(diagnostics)
        }
    }

    fn unit(
        &self,
        entry: &Entry,
        pattern: &Spanned<Pattern>,
        job: &str,
        backend: &'static dyn Backend,
    ) -> Unit {
        let output = entry.folder(stem(job), backend.id());
        let folder = join_path(&self.path, &output);
        Unit {
            recorded_as: Some(Name {
                job: job.to_owned(),
                target: backend.id().to_owned(),
                output,
            }),
            job: join_path(&self.path, job),
            backend,
            air_cut: None,
            folder: PathBuf::from(if folder.is_empty() { "." } else { &folder }),
            set: entry.set.clone(),
            machine: entry.machine.clone(),
            options: entry.options.clone(),
            beside: self.path.clone(),
            asked_at: Some(pattern.span),
        }
    }

    fn backend(&self, target: &Spanned<String>) -> Result<&'static dyn Backend, Box<Diagnostic>> {
        let id = &target.node;
        if let Ok(backend) = targets::find(self.targets, id, &|| Driven::Unknown) {
            return Ok(backend);
        }
        let diagnostic = Diagnostic::new(
            Code::NoSuchTarget,
            format!("there is no target `{id}`, or it does not answer"),
            target.span,
            "not a target",
        );
        let near = nearest(id, self.targets.iter().map(|backend| backend.id()));
        Err(Box::new(match near.first() {
            Some(near) => diagnostic.help(format!("did you mean \"{near}\"?")),
            None => diagnostic.help(format!("targets are: {}", meant::names(self.targets))),
        }))
    }

    /// The files of a pattern, by their paths from the folder of the list, in order.
    fn jobs(&self, pattern: &Spanned<Pattern>) -> Result<Vec<String>, Box<Diagnostic>> {
        let text = pattern.node.text();
        let from_here = |path: &str| join_path(&self.path, path);
        let found = if pattern.node.is_plain() {
            let is_there = Path::new(&from_here(text)).is_file();
            is_there.then(|| text.to_owned()).into_iter().collect()
        } else {
            walk(&pattern.node, &from_here).map_err(|reason| {
                Box::new(
                    Diagnostic::new(Code::NoSuchJob, reason, pattern.span, "this pattern")
                        .help("begin it with the folder that holds the jobs, such as `jobs/**/*.vcut`"),
                )
            })?
        };
        match found {
            found if !found.is_empty() => Ok(found),
            _ => {
                let (message, label) = if pattern.node.is_plain() {
                    (format!("there is no file {}", from_here(text)), "no such file")
                } else {
                    (format!("no file matches {}", from_here(text)), "matches nothing")
                };
                let diagnostic = Diagnostic::new(Code::NoSuchJob, message, pattern.span, label);
                Err(Box::new(
                    diagnostic.help(format!("paths are relative to the folder of {FILE_NAME}")),
                ))
            }
        }
    }
}

/// Files below the root of a pattern that match it, sorted; links to folders are not followed, as they can lead in a circle.
fn walk(pattern: &Pattern, from_here: &dyn Fn(&str) -> String) -> Result<Vec<String>, String> {
    let mut found = Vec::new();
    let mut open = vec![(pattern.root(), 0)];
    let mut seen = 0_usize;
    while let Some((folder, depth)) = open.pop() {
        let path = from_here(&folder);
        let Ok(entries) = fs::read_dir(if path.is_empty() { "." } else { &path }) else {
            continue;
        };
        for entry in entries.flatten() {
            seen += 1;
            if seen > MOST_NAMES {
                return Err(format!(
                    "there are more than {MOST_NAMES} files and folders to look at for this pattern"
                ));
            }
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            let path = if folder.is_empty() {
                name
            } else {
                format!("{folder}/{name}")
            };
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if is_folder && depth < DEEPEST && pattern.reaches_below(depth) {
                open.push((path, depth + 1));
            } else if !is_folder && pattern.matches(&path) {
                found.push(path);
            }
        }
    }
    found.sort_unstable();
    Ok(found)
}
