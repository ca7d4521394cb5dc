//! `vcutc convert FILE.src ...`: a milling program as V-cuts.

use super::args::ConvertArgs;
use super::compile::{self, Amended, Carried, Product};
use super::console::{Console, Failure};
use super::files::{Disk, load_program};
use super::meant::Driven;
use super::output::one_file;
use super::{Exit, Targets};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use vcutc_backend_api::readback::{ProgramFile, decoded};
use vcutc_convert::write::{ProfileFile, ProfileForm};
use vcutc_convert::{self as convert, Conversion, Refused};
use vcutc_diagnostics::has_errors;
use vcutc_diagnostics::overlay::Overlay;
use vcutc_driver::memory::Memory;
use vcutc_driver::{Outcome, Request, SearchEffort};
use vcutc_picture::Prefix;
use vcutc_registry::OPERATIONS;
use vcutc_report::{Material, pictures};

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
    let folder = JobFile::of(args).folder;
    let cell = args
        .cell
        .as_deref()
        .map(|path| seen_from(path, folder))
        .transpose()?;
    let profile = args
        .profile
        .as_deref()
        .map(|path| profile(path, args.profile_fields.as_deref(), folder))
        .transpose()?;
    let request = convert::Request {
        files: &files,
        asked: &asked,
        name: name(args),
        cell: cell.as_deref(),
        machine: args.machine.as_deref(),
        blade: args.blade.as_deref(),
        profile: profile.as_ref(),
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
            console.made(first(args), &diagnostics, &[], Some("nothing was converted"));
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
    let path = JobFile::of(args).path();
    let shown = path.to_string_lossy().into_owned();
    let disk = Disk::around(&shown);
    for file in sources(args) {
        disk.is_made_from(&file);
    }
    let texts = BTreeMap::from([(shown.clone(), conversion.job.text.as_str())]);
    let overlay = Overlay {
        texts: &texts,
        below: &disk,
    };
    let request = Request {
        path: &shown,
        loader: &overlay,
        overrides: &[],
        machine: None,
        options: product.typed(),
        effort: SearchEffort::Normal,
        operations: OPERATIONS,
        targets,
    };
    let mut amend = |outcome: &mut Outcome| {
        convert::point_back(
            &conversion,
            &shown,
            &mut outcome.sources,
            &mut outcome.diagnostics,
        );
        let job = job_written(args, &path, &conversion, outcome, &disk, console)?;
        let drawn = picture(args, &conversion, outcome, &disk)?;
        Ok(Amended {
            placed: [job.placed, drawn.placed].concat(),
            remarks: [job.remarks, drawn.remarks].concat(),
        })
    };
    let carried = Carried {
        memory: &mut Memory::none(),
        disk: &disk,
        amend: &mut amend,
    };
    compile::carried_out(request, &product, carried, console)
}

/// The job as a file, or on standard output, where it is asked for. One with errors is written too, because
/// the errors are fixed in it and point at it.
fn job_written(
    args: &ConvertArgs,
    path: &Path,
    conversion: &Conversion,
    outcome: &Outcome,
    disk: &Disk,
    console: &Console,
) -> Result<Amended, Failure> {
    if !args.as_job {
        return Ok(Amended::default());
    }
    let text = &conversion.job.text;
    let (placed, name) = if args.output.as_deref() == Some("-") {
        if console.document(text) != Exit::Success {
            return Err(Failure::new("the job could not be written to standard output"));
        }
        (Vec::new(), "the job".to_owned())
    } else {
        let placed = disk
            .spares(path)
            .and_then(|()| one_file(path, text.as_bytes()))
            .map_err(Failure::new)?;
        (placed, path.to_string_lossy().into_owned())
    };
    let remark = has_errors(&outcome.diagnostics)
        .then(|| format!("{name} is written with its errors, to be fixed there; it does not compile yet"));
    Ok(Amended {
        placed,
        remarks: remark.into_iter().collect(),
    })
}

fn product(args: &ConvertArgs, targets: &Targets) -> Result<Product, Failure> {
    match &args.target {
        Some(target) => {
            let output = args.output.as_deref();
            // There is no job yet that could say its machine.
            compile::program_of(target, output, &args.options.option, targets, &|| Driven::Unknown)
        }
        None if args.as_job => Ok(Product::Verdict { remark: None }),
        None => Ok(Product::Verdict {
            remark: Some("neither --target nor --as-job was given, so nothing was written".to_owned()),
        }),
    }
}

/// The two paths as a picture, where it is asked for; a job that was not planned has only one.
fn picture(
    args: &ConvertArgs,
    conversion: &Conversion,
    outcome: &Outcome,
    disk: &Disk,
) -> Result<Amended, Failure> {
    let Some(path) = args.picture.as_deref() else {
        return Ok(Amended::default());
    };
    let Some(material) = Material::of(outcome) else {
        return Ok(Amended {
            placed: Vec::new(),
            remarks: vec![format!("{path} was not drawn: there is no path of the blade yet")],
        });
    };
    let svg = pictures::paths(&material, &conversion.raster.path, Prefix::NONE);
    let placed = disk
        .spares(Path::new(path))
        .and_then(|()| one_file(Path::new(path), svg.as_bytes()))
        .map_err(Failure::new)?;
    Ok(Amended {
        placed,
        remarks: Vec::new(),
    })
}

/// Where the job lies, or would lie if it were written.
struct JobFile<'a> {
    /// None for the current folder, where a job that is not written is taken to lie.
    folder: Option<&'a Path>,
    name: String,
}

impl<'a> JobFile<'a> {
    fn of(args: &'a ConvertArgs) -> Self {
        let own = format!("{}.vcut", name(args));
        let given = args
            .output
            .as_deref()
            .filter(|output| args.as_job && *output != "-");
        let Some(path) = given.map(Path::new) else {
            return Self {
                folder: None,
                name: own,
            };
        };
        let is_job = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("vcut"));
        match path.file_name().and_then(|name| name.to_str()).filter(|_| is_job) {
            Some(name) => Self {
                folder: path.parent().filter(|folder| *folder != Path::new("")),
                name: name.to_owned(),
            },
            None => Self {
                folder: Some(path),
                name: own,
            },
        }
    }

    fn path(&self) -> PathBuf {
        match self.folder {
            Some(folder) => folder.join(&self.name),
            None => PathBuf::from(&self.name),
        }
    }
}

/// The file of a profile, by the ending of its name.
fn profile(path: &str, fields: Option<&str>, folder: Option<&Path>) -> Result<ProfileFile, Failure> {
    let fields = fields.unwrap_or_default();
    if fields.contains(['{', '}']) {
        return Err(Failure::new(format!(
            "`--profile-fields {fields}`: write the fields without braces, such as `side = upper, chord = 300 mm`"
        )));
    }
    let ending = Path::new(path).extension().and_then(|ending| ending.to_str());
    Ok(ProfileFile {
        form: ProfileForm::of_ending(ending.unwrap_or_default()),
        path: seen_from(path, folder)?,
        fields: fields.to_owned(),
    })
}

/// A path of the command line as a job in a folder says it: from there, where one drive holds both.
fn seen_from(path: &str, folder: Option<&Path>) -> Result<String, Failure> {
    let Some(folder) = folder else {
        return Ok(path.to_owned());
    };
    let unreadable = |error| Failure::new(format!("cannot read {path}: {error}"));
    let whole = std::fs::canonicalize(path).map_err(unreadable)?;
    let from = real(folder).map_err(unreadable)?;
    let shared = from
        .components()
        .zip(whole.components())
        .take_while(|(one, other)| one == other)
        .count();
    let words = |path: &Path| path.to_string_lossy().into_owned();
    if shared == 0 {
        return Ok(words(&whole));
    }
    let up = from.components().skip(shared).map(|_| "..".to_owned());
    let down = whole
        .components()
        .skip(shared)
        .map(|part| words(Path::new(part.as_os_str())));
    Ok(up.chain(down).collect::<Vec<_>>().join("/"))
}

/// A folder without links, which need not be there yet.
fn real(folder: &Path) -> std::io::Result<PathBuf> {
    let folder = std::path::absolute(folder)?;
    let there = folder.ancestors().find(|ancestor| ancestor.exists());
    let Some(there) = there else { return Ok(folder) };
    let rest = folder.strip_prefix(there).unwrap_or(Path::new(""));
    Ok(std::fs::canonicalize(there)?.join(rest))
}

fn first(args: &ConvertArgs) -> &str {
    args.files.first().map_or("", String::as_str)
}

/// The job's name: that of the first file.
fn name(args: &ConvertArgs) -> &str {
    let stem = Path::new(first(args)).file_stem().and_then(|stem| stem.to_str());
    stem.unwrap_or("converted")
}

/// All files that a conversion is made from.
fn sources(args: &ConvertArgs) -> Vec<PathBuf> {
    let others = [&args.cell, &args.profile].into_iter().flatten();
    let mut all = program_paths(&args.files);
    all.extend(others.map(PathBuf::from));
    all
}

/// The files of the program, with those `.dat` files that belong to its `.src` files.
fn program_paths(paths: &[String]) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
    for path in paths {
        for ending in ["dat", "DAT"] {
            let data = Path::new(path).with_extension(ending);
            if data.is_file() && !all.contains(&data) {
                all.push(data);
                break;
            }
        }
    }
    all
}

fn program(paths: &[String]) -> Result<Vec<ProgramFile>, Failure> {
    let all = program_paths(paths);
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
            text: text(&bytes, &shown.to_string())?,
        });
    }
    Ok(files)
}

/// The text of a file of a program, which controllers read in one byte a character, line by line.
fn text(bytes: &[u8], shown: &str) -> Result<String, Failure> {
    let is_wide =
        bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) || is_every_other_nul(bytes);
    if is_wide {
        return Err(Failure::new(format!(
            "cannot read the program {shown}: it is in UTF-16, which no controller reads"
        ))
        .help("save it as UTF-8 or ANSI in an editor, or with `iconv -f UTF-16 -t UTF-8`"));
    }
    if bytes.contains(&0) {
        return Err(Failure::new(format!(
            "cannot read the program {shown}: it holds bytes of 0, so it is damaged"
        ))
        .help("get it again from the CAM system or the controller"));
    }
    if bytes.contains(&b'\r') && !bytes.contains(&b'\n') {
        return Err(Failure::new(format!(
            "cannot read the program {shown}: its lines end with CR alone, so all of it is one line"
        ))
        .help("save it with the line ends of Windows (CR LF) or Unix (LF), or with `tr '\\r' '\\n'`"));
    }
    Ok(decoded(bytes))
}

/// Whether it looks like UTF-16 without a mark: Latin letters have a 0 beside them.
fn is_every_other_nul(bytes: &[u8]) -> bool {
    let count = |odd: usize| {
        bytes
            .iter()
            .skip(odd)
            .step_by(2)
            .filter(|&&byte| byte == 0)
            .count()
    };
    !bytes.is_empty() && 2 * count(0).max(count(1)) > bytes.len() / 2
}
