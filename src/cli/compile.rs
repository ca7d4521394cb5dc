//! `vcutc JOB` and `vcutc check JOB...`: jobs through the pipeline.

use super::args::{Arguments, CheckArgs, CompileArgs, InnerForm, Overrides};
use super::batch::{self, Unit};
use super::console::{Console, Failure};
use super::failures::{unreadable, without_machine, without_masses, without_surface};
use super::files::Disk;
use super::hints;
use super::inner::{self, Progressed};
use super::meant::{self, Driven, pointless_output};
use super::output::{Destination, Headings, Output, Placed};
use super::patience;
use super::progress::Progress;
use super::snapshot::{self, Differences, Fate, Made, NotReady};
use super::summary::Summary;
use super::targets;
use super::warnings::Warnings;
use super::{Exit, Targets};
use std::path::{Path, PathBuf};
use std::time::Duration;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::ir::AIR_ENDING;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::has_errors;
use vcutc_driver::memory::Memory;
use vcutc_driver::{self as driver, Compiled, Outcome, Request, RequestError, Stage, Typed};

/// What is made of a job.
pub(super) enum Product {
    Program(Program),
    /// One of its inner forms.
    Inner(InnerForm, Destination),
    /// Nothing: the job is only judged. The remark says why, where that needs saying.
    Verdict {
        /// Why nothing is made of it.
        remark: Option<String>,
    },
}

pub(super) struct Program {
    backend: &'static dyn Backend,
    to: Destination,
    fate: Fate,
    options: Vec<String>,
}

/// Compiles jobs: one as a whole, several side by side.
pub(super) fn compile(args: &CompileArgs, targets: &Targets, console: &Console) -> Exit {
    let product = match product(args, targets) {
        Ok(product) => product,
        Err(failure) => return console.failure(&failure),
    };
    match args.jobs.as_slice() {
        [job] => judge(job, args.air.air_cut, &args.overrides, targets, &product, console),
        several => match units(several, args.air.air_cut, &args.overrides, product) {
            Ok((units, fate)) => batch::run(&units, fate, targets, None, console).exit,
            Err(failure) => console.failure(&failure),
        },
    }
}

/// Several jobs as programs for one folder.
fn units(
    jobs: &[String],
    air_cut: Option<Length>,
    overrides: &Overrides,
    product: Product,
) -> Result<(Vec<Unit>, Fate), Failure> {
    let program = match product {
        Product::Program(program) => program,
        Product::Inner(..) => return Err(Failure::new("`--emit` shows one job at a time")),
        Product::Verdict { .. } => {
            let word = jobs.first().filter(|word| !Path::new(word).exists());
            let meant = word.and_then(|word| Some((word, Arguments::command_near(word)?)));
            return Err(match meant {
                Some((word, command)) => Failure::new(format!("there is no command `{word}`"))
                    .help(format!("did you mean `vcutc {command}`?")),
                None => Failure::new("several jobs were given without `--target`")
                    .help("use `vcutc check JOB...` to check them all for errors"),
            });
        }
    };
    let Destination::Folder(folder) = &program.to else {
        return Err(Failure::new("standard output takes one program")
            .help("give a folder with `-o`, or compile one job at a time"));
    };
    if jobs.iter().any(|job| job == "-") {
        return Err(Failure::new("a job from standard input must be compiled alone"));
    }
    let unit = |job: &String| Unit {
        job: job.clone(),
        backend: program.backend,
        folder: folder.clone(),
        air_cut,
        set: overrides.set.clone(),
        machine: overrides.machine.clone(),
        options: program.options.clone(),
        beside: String::new(),
        asked_at: None,
        recorded_as: None,
    };
    Ok((jobs.iter().map(unit).collect(), program.fate))
}

/// Checks jobs, each on its own. The worst of them decides how the run ends.
pub(super) fn check(args: &CheckArgs, targets: &Targets, console: &Console) -> Exit {
    let product = Product::Verdict { remark: None };
    args.jobs
        .iter()
        .map(|job| judge(job, args.air.air_cut, &args.overrides, targets, &product, console))
        .max()
        .unwrap_or(Exit::Success)
}

/// A program for a target, to be written.
pub(super) fn program_of<'d>(
    target: &str,
    output: Option<&str>,
    options: &[String],
    targets: &Targets,
    asking: &dyn Fn() -> Driven<'d>,
) -> Result<Product, Failure> {
    Ok(Product::Program(Program {
        backend: targets::find(targets, target, asking)?,
        to: program_destination(output),
        fate: Fate::Write,
        options: options.to_vec(),
    }))
}

fn product(args: &CompileArgs, targets: &Targets) -> Result<Product, Failure> {
    let output = args.output.as_deref();
    let asking = || Driven::of(&args.jobs, &args.overrides, targets);
    match (&args.target, args.emit) {
        (Some(target), _) => Ok(Product::Program(Program {
            backend: targets::find(targets, target, &asking)?,
            to: program_destination(output),
            fate: fate(args.check, output)?,
            options: args.options.option.clone(),
        })),
        (None, Some(form)) => Ok(Product::Inner(form, inner_destination(output))),
        (None, None) => match output {
            Some(output) => Err(pointless_output(output, targets, &asking())),
            None => Ok(nothing(targets)),
        },
    }
}

/// A verdict alone, and how to get more.
pub(super) fn nothing(targets: &Targets) -> Product {
    Product::Verdict {
        remark: Some(format!(
            "no --target was given (targets: {}), so nothing was written",
            meant::names(targets)
        )),
    }
}

fn fate(check: bool, output: Option<&str>) -> Result<Fate, Failure> {
    match (check, output) {
        (true, Some("-")) => Err(Failure::new("`--check` compares with the files of a folder")
            .help("give the folder with `-o`, or leave `-o` out for the current one")),
        (true, _) => Ok(Fate::Compare),
        (false, _) => Ok(Fate::Write),
    }
}

fn program_destination(output: Option<&str>) -> Destination {
    match output {
        None => Destination::Folder(PathBuf::from(".")),
        Some("-") => Destination::Stdout(Headings::Shown),
        Some(folder) => Destination::Folder(PathBuf::from(folder)),
    }
}

fn inner_destination(output: Option<&str>) -> Destination {
    match output {
        None | Some("-") => Destination::Stdout(Headings::Omitted),
        Some(folder) => Destination::Folder(PathBuf::from(folder)),
    }
}

/// Takes one job through the pipeline and reports the result.
fn judge(
    job: &str,
    air_cut: Option<Length>,
    overrides: &Overrides,
    targets: &Targets,
    product: &Product,
    console: &Console,
) -> Exit {
    let disk = Disk::around(job);
    let mut lift = |outcome: &mut Outcome| {
        if let Some(height) = air_cut {
            driver::into_air_cut(outcome, height, &mut |_| {});
        }
        Ok(Amended::default())
    };
    let carried = Carried {
        memory: &mut Memory::none(),
        disk: &disk,
        amend: &mut lift,
    };
    carried_out(overrides.request(&disk, targets), product, carried, console)
}

/// What a run brings along.
pub(super) struct Carried<'a> {
    /// What is kept of runs before.
    pub(super) memory: &'a mut Memory,
    /// The files that nothing is written over.
    pub(super) disk: &'a Disk,
    /// Changes what is reported of the outcome before anything is made of it, and may write files of its own.
    pub(super) amend: &'a mut dyn FnMut(&mut Outcome) -> Result<Amended, Failure>,
}

/// What is made of an outcome in addition to the product.
#[derive(Default)]
pub(super) struct Amended {
    /// Files that have been written.
    pub(super) placed: Vec<Placed>,
    /// What needs saying of them.
    pub(super) remarks: Vec<String>,
}

/// Takes a job through the pipeline, makes the product and reports the result.
pub(super) fn carried_out(
    request: Request<'_>,
    product: &Product,
    carried: Carried<'_>,
    console: &Console,
) -> Exit {
    let job = request.path;
    let request = Request {
        options: product.typed(),
        ..request
    };
    let mut progress = Progress::start(console.shows_progress());
    let mut outcome = match patience::compile(request, carried.memory, console.help_budget(), &mut progress) {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => {
            drop(progress);
            return console.failure(&unreadable(job, &reason));
        }
    };
    let made = (carried.amend)(&mut outcome).and_then(|amended| {
        let mut made = make(product, &outcome, carried.disk, console.warnings(), &mut progress)?;
        made.placed.splice(0..0, amended.placed);
        made.remarks = amended.remarks;
        made.remarks.extend(shortened(&outcome, &made.placed));
        Ok(made)
    });
    let timings = progress.finish();

    match made {
        Ok(made) => {
            // A summary as a line of JSON ends the report; people want to have the summary at once.
            if console.speaks_json() {
                hints::report(&outcome, &made, &timings, console);
                return report_outcome(job, &outcome, &made, &timings, product, console);
            }
            let exit = report_outcome(job, &outcome, &made, &timings, product, console);
            hints::report(&outcome, &made, &timings, console);
            exit
        }
        Err(failure) => {
            console.diagnostics(&outcome.diagnostics, &outcome.sources);
            console.failure(&failure)
        }
    }
}

impl Product {
    /// The options of the command line for its target.
    pub(super) fn typed(&self) -> Typed<'_> {
        match self {
            Self::Program(program) => Typed {
                target: program.backend.id(),
                given: &program.options,
                beside: "",
            },
            Self::Inner(..) | Self::Verdict { .. } => Typed::default(),
        }
    }
}

/// Reports the result of a job.
pub(super) fn report_outcome(
    job: &str,
    outcome: &Outcome,
    made: &Made,
    timings: &[(&'static str, Duration)],
    product: &Product,
    console: &Console,
) -> Exit {
    let diagnostics = [outcome.diagnostics.as_slice(), &made.diagnostics].concat();
    let is_wrong = console.warnings().refuse(&diagnostics);
    let exit = match &made.differences {
        Some(differences) if !differences.changes.is_empty() => Exit::JobHasErrors,
        Some(_) | None if is_wrong => Exit::JobHasErrors,
        Some(_) | None => Exit::Success,
    };
    console.diagnostics(&diagnostics, &outcome.sources);
    if let Some(found) = &made.differences {
        console.differences(job, found);
    }
    // A comparison reports what differs, not what was planned.
    let compiled = outcome.compiled.as_ref().filter(|_| made.differences.is_none());
    console.summary(&Summary {
        job,
        diagnostics: &diagnostics,
        // What a target refuses must not stand above a page of figures.
        lines: compiled
            .filter(|_| !has_errors(&diagnostics))
            .map_or(&[], |compiled| &compiled.summary),
        numbers: compiled.and_then(Compiled::numbers_of_cuts),
        times: compiled.map(|compiled| &compiled.times),
        reach: compiled.and_then(|compiled| compiled.figures.as_ref()),
        dynamics: compiled.map(|compiled| &compiled.dynamics),
        checks: compiled.map(|compiled| compiled.checks.with(made.read_back)),
        parameters: compiled.map_or(&[], |compiled| &compiled.parameters),
        placed: &made.placed,
        remark: remark(product, is_wrong, made, console.warnings().remark(&diagnostics)).as_deref(),
        timings,
    });
    exit
}

/// That a program has not its job's whole name, where its target takes none as long.
fn shortened(outcome: &Outcome, placed: &[Placed]) -> Option<String> {
    let job = outcome.job.as_ref()?.name.as_str();
    let is_written_in_full = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let main = Path::new(placed.first()?.path()).file_stem()?.to_str()?;
    let own = match job.ends_with(AIR_ENDING) {
        true => main,
        false => main.strip_suffix(AIR_ENDING).unwrap_or(main),
    };
    // Other characters may fall together in one `_`.
    let is_shortened = job.chars().filter(|&c| is_written_in_full(c)).count() > own.len();
    is_shortened.then(|| {
        format!(
            "the program is called `{main}`, because its controller does not accept names as long as the job's"
        )
    })
}

/// What needs saying of files.
fn remark(product: &Product, is_wrong: bool, made: &Made, denied: Option<&str>) -> Option<String> {
    let remarks = denied.map(str::to_owned).into_iter();
    remarks
        .chain(of_the_product(product, is_wrong, made))
        .chain(made.remarks.iter().cloned())
        .reduce(|one, other| format!("{one}; {other}"))
}

fn of_the_product(product: &Product, is_wrong: bool, made: &Made) -> Option<String> {
    match (product, &made.differences) {
        (Product::Program(program), _) if is_wrong => Some(match program.fate {
            Fate::Write => "nothing was written".to_owned(),
            Fate::Compare => "nothing was compared".to_owned(),
        }),
        (Product::Program(program), found) => {
            let compared = found.as_ref().map(Differences::in_words);
            let unread = targets::not_read_back(program.backend);
            let words: Vec<String> = compared.into_iter().chain(unread).collect();
            (!words.is_empty()).then(|| words.join("; "))
        }
        (Product::Verdict { remark }, _) if !is_wrong => remark.clone(),
        (Product::Inner(..) | Product::Verdict { .. }, _) => None,
    }
}

/// Makes the product of a job that got far enough for it.
pub(super) fn make(
    product: &Product,
    outcome: &Outcome,
    disk: &Disk,
    warnings: &Warnings,
    progress: &mut Progress,
) -> Result<Made, Failure> {
    let is_refused = warnings.remark(&outcome.diagnostics).is_some();
    match product {
        Product::Program(_) | Product::Inner(..) if is_refused => Ok(Made::default()),
        Product::Program(program) => {
            if outcome.compiled.is_none() {
                return Ok(Made::default());
            }
            progress.enter(Stage::Emitting);
            make_program(program, outcome, disk, warnings)
        }
        Product::Inner(form, destination) => write_inner(*form, destination, outcome, disk.job()),
        Product::Verdict { .. } => Ok(Made::default()),
    }
}

fn make_program(
    program: &Program,
    outcome: &Outcome,
    disk: &Disk,
    warnings: &Warnings,
) -> Result<Made, Failure> {
    match snapshot::make(outcome, program.backend, &program.to, program.fate) {
        Ok(Some(complete)) if warnings.refuse(complete.ready.warnings()) => Ok(Made {
            diagnostics: complete.ready.warnings().to_vec(),
            ..Made::default()
        }),
        Ok(Some(complete)) => {
            if let (Destination::Folder(folder), Fate::Write) = (&program.to, program.fate) {
                for name in &complete.names {
                    disk.spares(&folder.join(name)).map_err(Failure::new)?;
                }
            }
            complete.settle().map_err(Failure::new)
        }
        Ok(None) => Ok(Made::default()),
        Err(NotReady::Diagnostics(diagnostics)) => Ok(Made {
            diagnostics,
            ..Made::default()
        }),
        Err(NotReady::Trouble(reason)) => Err(Failure::new(reason)),
    }
}

fn write_inner(form: InnerForm, to: &Destination, outcome: &Outcome, job: &str) -> Result<Made, Failure> {
    let mut output = Output::to(to);
    match inner::write(form, outcome, job, &mut output) {
        Ok(Progressed::Written) => published(output),
        Ok(Progressed::NotSoFar) => Ok(Made::default()),
        Ok(Progressed::WithoutMachine) => Err(without_machine()),
        Ok(Progressed::WithoutMasses) => Err(without_masses()),
        Ok(Progressed::WithoutSurface) => Err(without_surface()),
        Err(error) => Err(Failure::new(error.to_string())),
    }
}

fn published(output: Output) -> Result<Made, Failure> {
    let placed = output.publish().map_err(Failure::new)?;
    Ok(Made {
        placed,
        ..Made::default()
    })
}
