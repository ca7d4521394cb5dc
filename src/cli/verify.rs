//! `vcutc verify JOB PROGRAM...`: a program compared with the job that it was made from.

use super::args::VerifyArgs;
use super::console::{Console, Failure};
use super::files::{Disk, load_program};
use super::meant::{self, Driven};
use super::progress::Progress;
use super::summary::Summary;
use super::{Exit, Targets, failures, snapshot, targets};
use std::path::Path;
use std::slice;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::readback::{ProgramFile, Reader, decoded};
use vcutc_diagnostics::has_errors;
use vcutc_diff::family;
use vcutc_driver::{self as driver, EmitFailure, Outcome, Request, RequestError, Stage, Typed};
use vcutc_readback::{Fresh, Reference, Verdict, Written};

/// Compares, and reports the result.
///
/// Of the targets those that are linked in are asked whether they know the files. One that is a program of its own has to be named:
/// it would be run to find out.
pub(super) fn verify(args: &VerifyArgs, linked: &Targets, targets: &Targets, console: &Console) -> Exit {
    let ready = given(args, linked, targets).and_then(|(paths, found)| {
        let files = program(&paths)?;
        let readable = target(args, &files, linked, targets)?;
        Ok((readable, files, paths, found))
    });
    let ((backend, reader), mut files, mut paths, found) = match ready {
        Ok(ready) => ready,
        Err(failure) => return console.failure(&failure),
    };
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = Request {
        options: Typed {
            target: backend.id(),
            given: &args.options.option,
            beside: "",
        },
        ..args.overrides.request(&disk, targets)
    };
    let mut outcome = match driver::compile(request, &mut |stage| progress.enter(stage)) {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => {
            drop(progress);
            return console.failure(&failures::unreadable(&args.job, &reason));
        }
    };
    if let Some(height) = args.air.air_cut {
        driver::into_air_cut(&mut outcome, height, &mut |stage| progress.enter(stage));
    }
    progress.enter(Stage::Verifying);
    let verdict = compared(&mut outcome, backend, reader, (&mut files, &mut paths), found);
    let timings = progress.finish();
    let verdict = match verdict {
        Ok(verdict) => verdict,
        Err(failure) => {
            console.diagnostics(&outcome.diagnostics, &outcome.sources);
            return console.failure(&failure);
        }
    };
    outcome.diagnostics.extend(verdict.diagnostics);
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    let exit = if has_errors(&outcome.diagnostics) {
        Exit::JobHasErrors
    } else {
        Exit::Success
    };
    console.summary(&Summary {
        job: disk.job(),
        diagnostics: &outcome.diagnostics,
        lines: &verdict.lines,
        timings: &timings,
        ..Summary::default()
    });
    exit
}

/// Compares the files with the outcome's program. A job with errors has none; its errors are the verdict.
fn compared(
    outcome: &mut Outcome,
    backend: &dyn Backend,
    reader: &dyn Reader,
    (files, shown): (&mut Vec<ProgramFile>, &mut Vec<String>),
    found: Found,
) -> Result<Verdict, Failure> {
    let written = match driver::write(outcome, backend) {
        Ok(Some(written)) => written,
        Ok(None) => return Ok(Verdict::default()),
        Err(EmitFailure::Diagnostics(diagnostics)) => {
            return Ok(Verdict {
                diagnostics,
                ..Verdict::default()
            });
        }
        Err(EmitFailure::Sink(reason)) => return Err(Failure::new(reason)),
    };
    if let Found::InFolder = found {
        keep_own(&written, files, shown)?;
    }
    let reached = outcome
        .compiled
        .as_ref()
        .and_then(|compiled| compiled.program.reached());
    let fresh = Fresh::of(
        outcome.job.as_ref(),
        outcome.plan.as_ref(),
        reached,
        &written,
        reader,
    );
    let fresh = fresh.ok_or_else(|| Failure::new("the job has no program to compare with"))?;
    Ok(Reference::new(fresh).verify(files, shown.as_slice(), &mut outcome.sources))
}

/// How the files of a program came to be known.
#[derive(Clone, Copy)]
enum Found {
    /// Each was named.
    ByName,
    /// A folder was named, which may hold programs of other jobs too.
    InFolder,
}

/// The paths of the program's files. Of a folder: of all files in it that the target may have written.
fn given(args: &VerifyArgs, linked: &Targets, targets: &Targets) -> Result<(Vec<String>, Found), Failure> {
    let [folder] = args.programs.as_slice() else {
        return Ok((args.programs.clone(), Found::ByName));
    };
    if !Path::new(folder).is_dir() {
        return Ok((args.programs.clone(), Found::ByName));
    }
    let readers: Vec<&dyn Reader> = match args.target.as_deref() {
        Some(id) => targets::find(targets, id, &|| asking(args, targets))?
            .reader()
            .into_iter()
            .collect(),
        None => linked.iter().filter_map(|backend| backend.reader()).collect(),
    };
    let is_program = |name: &String| readers.iter().any(|reader| reader.recognises(name));
    let mut names: Vec<String> = snapshot::names_in(Path::new(folder));
    names.retain(is_program);
    names.sort();
    if names.is_empty() {
        return Err(Failure::new(format!("the folder {folder} holds no programs"))
            .help("give the folder that the program was written into, or its files"));
    }
    let paths = names
        .iter()
        .map(|name| Path::new(folder).join(name).display().to_string());
    Ok((paths.collect(), Found::InFolder))
}

fn asking<'a>(args: &'a VerifyArgs, targets: &'a Targets) -> Driven<'a> {
    Driven::of(slice::from_ref(&args.job), &args.overrides, targets)
}

/// Leaves the files of a folder that belong to the job: those of its program, and parts of an earlier one.
fn keep_own(written: &Written, files: &mut Vec<ProgramFile>, shown: &mut Vec<String>) -> Result<(), Failure> {
    let own: Vec<String> = written
        .bundle
        .files()
        .iter()
        .map(|(name, _)| name.clone())
        .collect();
    let there: Vec<String> = files.iter().map(|file| file.name.clone()).collect();
    let stale = family::stale(&own, &there);
    let is_own = |name: &str| {
        let mut names = own.iter().chain(&stale);
        names.any(|own| own.eq_ignore_ascii_case(name))
    };
    let kept: Vec<bool> = there.iter().map(|name| is_own(name)).collect();
    let mut keeps = kept.iter().copied();
    files.retain(|_| keeps.next().unwrap_or(false));
    let mut keeps = kept.iter().copied();
    shown.retain(|_| keeps.next().unwrap_or(false));
    if files.is_empty() {
        return Err(Failure::new("the folder holds no program of this job")
            .help(format!("its program would be {}", own.join(", "))));
    }
    Ok(())
}

/// The files of the program.
fn program(paths: &[String]) -> Result<Vec<ProgramFile>, Failure> {
    let mut files: Vec<ProgramFile> = Vec::with_capacity(paths.len());
    for path in paths {
        let name = Path::new(path).file_name().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        if files.iter().any(|file| file.name.eq_ignore_ascii_case(&name)) {
            return Err(Failure::new(format!("two files are called {name}"))
                .help("give the files of one program, each once"));
        }
        let bytes = load_program(Path::new(path))
            .map_err(|reason| Failure::new(format!("cannot read the program {path}: {reason}")))?;
        files.push(ProgramFile {
            name,
            text: decoded(&bytes),
        });
    }
    Ok(files)
}

type Readable = (&'static dyn Backend, &'static dyn Reader);

/// The target that wrote the files: the one that was given, or the only one that knows their names.
fn target(
    args: &VerifyArgs,
    files: &[ProgramFile],
    linked: &Targets,
    targets: &Targets,
) -> Result<Readable, Failure> {
    let readable = |backend: &'static dyn Backend| Some((backend, backend.reader()?));
    if let Some(id) = args.target.as_deref() {
        let backend = targets::find(targets, id, &|| asking(args, targets))?;
        return readable(backend)
            .ok_or_else(|| Failure::new(format!("programs of target `{id}` cannot be read back")));
    }
    let knows_all = |(_, reader): &Readable| files.iter().all(|file| reader.recognises(&file.name));
    let known: Vec<_> = linked
        .iter()
        .filter_map(|&backend| readable(backend))
        .filter(knows_all)
        .collect();
    let names: Vec<_> = files.iter().map(|file| file.name.as_str()).collect();
    let names = names.join(", ");
    match known.as_slice() {
        [only] => Ok(*only),
        [] => Err(
            Failure::new(format!("no target is known by files such as {names}")).help(format!(
                "give the target with --target (targets: {})",
                meant::names(targets)
            )),
        ),
        several => {
            let ids: Vec<_> = several.iter().map(|(backend, _)| backend.id()).collect();
            Err(Failure::new(format!(
                "several targets write files such as {names}: {}",
                ids.join(", ")
            ))
            .help(format!(
                "give one of them, such as --target {}",
                ids.first().unwrap_or(&"krl")
            )))
        }
    }
}
