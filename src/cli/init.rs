//! `vcutc init [NAME] [--robot MODEL]`: the file of a first job.

use super::args::InitArgs;
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::one_file;
use super::progress::Progress;
use super::{Exit, Targets, machines};
use std::fs;
use std::path::{Path, PathBuf};
use vcutc_backend_api::ir::{MachineKind, Maker};
use vcutc_driver::Stage;
use vcutc_driver::starter::{self, Asked, Refusal};
use vcutc_machine::{Model, Origin};
use vcutc_registry::OPERATIONS;

/// The name of a job that is given none.
const NAME: &str = "first";

/// Writes the file of a first job, unless there is one of that name.
pub(super) fn init(args: &InitArgs, targets: &Targets, console: &Console) -> Exit {
    let file = match file(args) {
        Ok(file) => file,
        Err(failure) => return console.failure(&failure),
    };
    let model = match args
        .robot
        .as_deref()
        .map(|name| machines::load(name, console))
        .transpose()
    {
        Ok(model) => model,
        Err(exit) => return exit,
    };
    let path = file.display().to_string();
    let disk = Disk::around(&path);
    let name = file
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let mut progress = Progress::start(console.shows_progress());
    progress.enter(Stage::Placing);
    let job = starter::job(&Asked {
        name: &name,
        path: disk.job(),
        model: model.as_ref(),
        loader: &disk,
        operations: OPERATIONS,
        targets,
    });
    progress.finish();
    match job {
        Ok(text) => match one_file(&file, text.as_bytes()) {
            Ok(_) => report_written(disk.job(), model.as_ref(), console),
            Err(reason) => console.failure(&Failure::new(reason)),
        },
        Err(Refusal::Name(diagnostics, sources)) => {
            console.diagnostics(&diagnostics, &sources);
            console.failure(&Failure::new(format!("`{name}` cannot be the name of a job")))
        }
        Err(Refusal::NoPlace) => console.failure(&no_place(args.robot.as_deref().unwrap_or_default())),
    }
}

/// The file to write; it must not be there.
fn file(args: &InitArgs) -> Result<PathBuf, Failure> {
    let given = args.name.as_deref().unwrap_or(NAME);
    let file = PathBuf::from(match given.strip_suffix(".vcut") {
        Some(_) => given.to_owned(),
        None => format!("{given}.vcut"),
    });
    if fs::symlink_metadata(&file).is_ok() {
        return Err(Failure::new(format!("{} is already there", file.display()))
            .help("give the job another name: `vcutc init NAME`"));
    }
    let has_folder = file.parent().is_some_and(|folder| folder != Path::new(""));
    match args.robot.as_deref().map(Origin::of) {
        Some(Origin::File(_)) if has_folder => Err(Failure::new(
            "a job names the file of its machine relative to its own folder",
        )
        .help("change to that folder, and give both names from there")),
        Some(Origin::File(_) | Origin::Catalogue) | None => Ok(file),
    }
}

fn no_place(machine: &str) -> Failure {
    Failure::new(format!(
        "`{machine}` cannot cut the first job in any of the places that were tried"
    ))
    .help("write the job without --robot, add your machine by hand (docs/language.md), and use `vcutc place`")
}

/// Says what was written, and how to go on.
fn report_written(path: &str, model: Option<&Model>, console: &Console) -> Exit {
    let next = match model {
        None => format!("vcutc check {path}"),
        Some(model) => match (model.kind(), model.maker) {
            (MachineKind::FiveAxis, _) => format!("vcutc {path} --target gcode -o out"),
            (MachineKind::Robot, Maker::Abb) => format!("vcutc {path} --target rapid -o out"),
            (MachineKind::Robot, Maker::Kuka | Maker::Other) => format!("vcutc {path} --target krl -o out"),
        },
    };
    let body = serde_json::json!({ "file": path, "next": next });
    console.note("initialised", &format!("wrote {path}\nnext: {next}\n"), body);
    Exit::Success
}
