//! `vcutc tools JOB`: the bodies of revolution that stand for the job's blades in programs for milling.

use super::args::{ToolForm, ToolsArgs};
use super::console::{Console, Failure};
use super::failures::unreadable;
use super::files::Disk;
use super::output::{Destination, Output, Placed, one_file};
use super::patience;
use super::progress::Progress;
use super::{Exit, Targets};
use std::path::Path;
use vcutc_backend_api::bundle::Sink;
use vcutc_diagnostics::has_errors;
use vcutc_driver::RequestError;
use vcutc_driver::memory::Memory;
use vcutc_equivalent::{Equivalents, apt, facets, of, table, tool_bit};

/// What is written, and where.
enum To<'a> {
    /// One text to standard output.
    Stdout(Text),
    /// One text into a file.
    File(Text, &'a Path),
    /// A file for each tool into a folder.
    Folder(Files, &'a Path),
}

/// All tools in one text.
#[derive(Clone, Copy)]
enum Text {
    Table,
    Apt,
    Csv,
}

/// A file for each tool.
#[derive(Clone, Copy)]
enum Files {
    Fctb,
    Stl,
}

/// Prints or writes the equivalent tools of a job.
pub(super) fn tools(args: &ToolsArgs, targets: &Targets, console: &Console) -> Exit {
    let to = match To::of(args) {
        Ok(to) => to,
        Err(failure) => return console.failure(&failure),
    };
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = args.overrides.request(&disk, targets);
    let compiled = patience::compile(request, &mut Memory::none(), console.help_budget(), &mut progress);
    progress.finish();
    let outcome = match compiled {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => return console.failure(&unreadable(&args.job, &reason)),
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    let plan = outcome.plan.as_ref();
    let Some(plan) = plan.filter(|_| !has_errors(&outcome.diagnostics)) else {
        console.made(disk.job(), &outcome.diagnostics, &[], Some("nothing was written"));
        return Exit::JobHasErrors;
    };
    let all = of(plan);
    let placed = match to {
        To::Stdout(text) => return console.document(&text.of(&plan.name, &all)),
        To::File(text, path) => disk
            .spares(path)
            .and_then(|()| one_file(path, text.of(&plan.name, &all).as_bytes())),
        To::Folder(files, folder) => files.write(&all, folder, &disk),
    };
    match placed {
        Ok(placed) => {
            console.made(disk.job(), &outcome.diagnostics, &placed, None);
            Exit::Success
        }
        Err(reason) => console.failure(&Failure::new(reason)),
    }
}

impl<'a> To<'a> {
    fn of(args: &'a ToolsArgs) -> Result<Self, Failure> {
        let output = args.output.as_deref();
        let text = match args.emit {
            None => return Ok(Self::Stdout(Text::Table)),
            Some(ToolForm::Apt) => Text::Apt,
            Some(ToolForm::Csv) => Text::Csv,
            Some(ToolForm::Fctb) => return Self::folder(Files::Fctb, output),
            Some(ToolForm::Stl) => return Self::folder(Files::Stl, output),
        };
        Ok(match output {
            None | Some("-") => Self::Stdout(text),
            Some(path) => Self::File(text, Path::new(path)),
        })
    }

    fn folder(files: Files, output: Option<&'a str>) -> Result<Self, Failure> {
        let ending = files.ending();
        match output {
            None => Ok(Self::Folder(files, Path::new("."))),
            Some("-") => Err(Failure::new(format!(
                "standard output takes one file, and there is a .{ending} for each tool"
            ))
            .help("give a folder with `-o`")),
            Some(path) if path.to_ascii_lowercase().ends_with(&format!(".{ending}")) => Err(Failure::new(
                format!("{path} takes one tool, and there is a .{ending} for each"),
            )
            .help("give a folder with `-o`")),
            Some(folder) => Ok(Self::Folder(files, Path::new(folder))),
        }
    }
}

impl Text {
    fn of(self, job: &str, all: &Equivalents) -> String {
        match self {
            Self::Table => table::table(all),
            Self::Apt => apt::apt(job, &all.tools),
            Self::Csv => table::csv(&all.tools),
        }
    }
}

impl Files {
    const fn ending(self) -> &'static str {
        match self {
            Self::Fctb => "fctb",
            Self::Stl => "stl",
        }
    }

    /// Writes a file for each tool, all or none.
    fn write(self, all: &Equivalents, folder: &Path, disk: &Disk) -> Result<Vec<Placed>, String> {
        let mut output = Output::to(&Destination::Folder(folder.to_owned()));
        for tool in &all.tools {
            let text = match self {
                Self::Fctb => tool_bit::tool_bit(tool).map_err(|error| error.to_string())?,
                Self::Stl => facets::stl(tool),
            };
            let name = format!("{}.{}", tool.name, self.ending());
            disk.spares(&folder.join(&name))?;
            let taken = output.file(&name).and_then(|()| output.write(text.as_bytes()));
            taken.map_err(|error| error.to_string())?;
        }
        output.publish()
    }
}
