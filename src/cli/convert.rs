//! `vcutc convert FILE.src ...`: a milling program as V-cuts.

use super::args::ConvertArgs;
use super::compile::{self, Carried, Product};
use super::console::{Console, Failure, Summary};
use super::files::{Disk, load_program};
use super::output::{Placed, one_file};
use super::{Exit, Targets};
use crate::convert::{self, Conversion, Refused};
use crate::driver::{Outcome, Request};
use crate::memory::Memory;
use crate::picture::Prefix;
use crate::report::{Material, pictures};
use crate::source::{LoadError, Loader};
use std::path::{Path, PathBuf};
use vcutc_backend_api::readback::{ProgramFile, decoded};

/// Converts one program.
pub(super) fn convert(args: &ConvertArgs, targets: &Targets, console: &Console) -> Exit {
    match converted(args, console) {
        Ok(Ok(conversion)) => carried_on(args, conversion, targets, console),
        Ok(Err(exit)) => exit,
        Err(failure) => console.failure(&failure),
    }
}

/// The program as a job; or how the run ends.
fn converted(args: &ConvertArgs, console: &Console) -> Result<Result<Conversion, Exit>, Failure> {
    let asked = args
        .words()
        .asked()
        .map_err(|bad| Failure::new(bad.to_string()))?;
    if let Some(path) = args.picture.as_deref()
        && !path.to_ascii_lowercase().ends_with(".svg")
    {
        return Err(Failure::new(format!(
            "pictures are in SVG: give `--picture` the name of a file that ends in .svg, not {path}"
        )));
    }
    let files = program(&args.files)?;
    let folder = folder_of_the_job(args);
    let (cell, profile) = (
        beside(args.cell.as_deref(), folder)?,
        beside(args.profile.as_deref(), folder)?,
    );
    let request = convert::Request {
        files: &files,
        asked: &asked,
        name: name(args),
        cell: cell.as_deref(),
        machine: args.machine.as_deref(),
        blade: args.blade.as_deref(),
        profile: profile.as_deref(),
    };
    match convert::convert(request) {
        Ok(conversion) => {
            let lines: String = conversion
                .inferences
                .iter()
                .map(|inference| format!("{inference}\n"))
                .collect();
            console.inferences(&lines, &conversion.inferences);
            console.diagnostics(&conversion.warnings, &conversion.sources);
            Ok(Ok(conversion))
        }
        Err(Refused { diagnostics, sources }) => {
            console.diagnostics(&diagnostics, &sources);
            console.summary(&Summary {
                job: first(args),
                diagnostics: &diagnostics,
                lines: &[],
                numbers: None,
                times: None,
                reach: None,
                placed: &[],
                remark: Some("nothing was converted"),
                timings: &[],
            });
            Ok(Err(Exit::JobHasErrors))
        }
    }
}

/// Takes the job of a conversion through the compiler.
fn carried_on(args: &ConvertArgs, conversion: Conversion, targets: &Targets, console: &Console) -> Exit {
    let product = match product(args, targets) {
        Ok(product) => product,
        Err(failure) => return console.failure(&failure),
    };
    let file = format!("{}.vcut", name(args));
    let path = match folder_of_the_job(args) {
        Some(folder) => folder.join(&file),
        None => PathBuf::from(&file),
    };
    let mut placed = Vec::new();
    if args.as_job {
        match job_written(args, &path, &conversion, console) {
            Ok(written) => placed.extend(written),
            Err(exit) => return exit,
        }
    }
    let shown = path.to_string_lossy().into_owned();
    let overlaid = Overlaid {
        path: shown.clone(),
        text: conversion.job.text.clone(),
        disk: Disk::around(&shown),
    };
    let request = Request {
        path: &overlaid.path,
        loader: &overlaid,
        overrides: &[],
        machine: None,
        options: product.typed(),
        targets,
    };
    let mut drawn = Ok(Vec::new());
    let mut amend = |outcome: &mut Outcome| {
        convert::point_back(
            &conversion,
            &overlaid.path,
            &mut outcome.sources,
            &mut outcome.diagnostics,
        );
        drawn = picture(args, &conversion, outcome);
    };
    let exit = compile::carried_out(
        request,
        &product,
        Carried {
            memory: &mut Memory::none(),
            placed,
            amend: &mut amend,
        },
        console,
    );
    match drawn {
        Ok(files) => {
            console.placed(&files);
            exit
        }
        Err(reason) => console.failure(&Failure::new(reason)),
    }
}

/// The job as a file, or on standard output.
fn job_written(
    args: &ConvertArgs,
    path: &Path,
    conversion: &Conversion,
    console: &Console,
) -> Result<Vec<Placed>, Exit> {
    if args.output.as_deref() == Some("-") {
        return match console.document(&conversion.job.text) {
            Exit::Success => Ok(Vec::new()),
            exit => Err(exit),
        };
    }
    one_file(path, conversion.job.text.as_bytes()).map_err(|reason| console.failure(&Failure::new(reason)))
}

fn product(args: &ConvertArgs, targets: &Targets) -> Result<Product, Failure> {
    match &args.target {
        Some(target) => compile::program_of(target, args.output.as_deref(), &args.options.option, targets),
        None if args.as_job => Ok(Product::Verdict { remark: None }),
        None => Ok(Product::Verdict {
            remark: Some("neither --target nor --as-job was given, so nothing was written".to_owned()),
        }),
    }
}

/// The two paths as a picture, where it is asked for and there is a program.
fn picture(args: &ConvertArgs, conversion: &Conversion, outcome: &Outcome) -> Result<Vec<Placed>, String> {
    let (Some(path), Some(material)) = (args.picture.as_deref(), Material::of(outcome)) else {
        return Ok(Vec::new());
    };
    let svg = pictures::paths(&material, &conversion.raster.path, Prefix::NONE);
    one_file(Path::new(path), svg.as_bytes())
}

/// The folder that the job lies in; none for the current one, where a job that is not written is taken to lie.
fn folder_of_the_job(args: &ConvertArgs) -> Option<&Path> {
    match args.output.as_deref() {
        Some(folder) if args.as_job && folder != "-" => Some(Path::new(folder)),
        Some(_) | None => None,
    }
}

/// A path of the command line, as the job says it: seen from its folder.
fn beside(path: Option<&str>, folder: Option<&Path>) -> Result<Option<String>, Failure> {
    let (Some(path), Some(_)) = (path, folder) else {
        return Ok(path.map(str::to_owned));
    };
    // From another folder, the whole path is the one that surely leads there.
    let whole =
        std::fs::canonicalize(path).map_err(|error| Failure::new(format!("cannot read {path}: {error}")))?;
    Ok(Some(whole.to_string_lossy().into_owned()))
}

fn first(args: &ConvertArgs) -> &str {
    args.files.first().map_or("", String::as_str)
}

/// The job's name: that of the first file.
fn name(args: &ConvertArgs) -> &str {
    let stem = Path::new(first(args)).file_stem().and_then(|stem| stem.to_str());
    stem.unwrap_or("converted")
}

/// The files of the program, with those `.dat` files that belong to its `.src` files.
fn program(paths: &[String]) -> Result<Vec<ProgramFile>, Failure> {
    let mut all: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
    for path in paths {
        let data = Path::new(path).with_extension("dat");
        if data.is_file() && !all.contains(&data) {
            all.push(data);
        }
    }
    let mut files: Vec<ProgramFile> = Vec::with_capacity(all.len());
    for path in &all {
        let shown = path.display();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if files.iter().any(|file| file.name.eq_ignore_ascii_case(&name)) {
            return Err(Failure::new(format!("two files are called {name}"))
                .help("give the files of one program, each once"));
        }
        let bytes = load_program(path)
            .map_err(|reason| Failure::new(format!("cannot read the program {shown}: {reason}")))?;
        files.push(ProgramFile {
            name,
            text: decoded(&bytes),
        });
    }
    Ok(files)
}

/// The job of a conversion over the files that are there.
struct Overlaid {
    path: String,
    text: String,
    disk: Disk,
}

impl Loader for Overlaid {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        if path == self.path {
            Ok(self.text.clone().into_bytes())
        } else {
            self.disk.load(path)
        }
    }
}
