//! The command line: the only part of the compiler that touches disks, terminals, the environment and the clock.
//!
//! What goes where:
//!
//! | What | Where |
//! | --- | --- |
//! | programs | files in the folder of `-o` (the current one without it), or standard output with `-o -` |
//! | `--emit ast`, `plan`, `ir`, `joints` | standard output, or a file in the folder of `-o` |
//! | the picture of `plot --what` | standard output, or the file of `-o` |
//! | all pictures of `plot` | files in the folder of `-o` (the current one without it) |
//! | the table of `tools`, its APT and CSV | standard output, or the file of `-o` |
//! | tool bits and facets of `tools` | files in the folder of `-o` (the current one without it) |
//! | the page of `report` | the file of `-o` (`JOB.html` without it), or standard output with `-o -` |
//! | the job of `init` | a file in the current folder, never over one that is there |
//! | manual pages of `man` | files in the folder of `-o` |
//! | messages of `lsp` | standard output |
//! | pages of `explain`, `machines`, `completions`, answers of `fk` and `ik`, list of `targets`, help | standard output |
//! | diagnostics, summary, timings, progress, what `verify` finds | standard error |
//!
//! A run ends with 0 when all is well, with 1 when a job has errors or a program is not its job's, and with 2 when there was nothing to judge: a
//! wrong command line, or a file that could not be read or written. A run that does not end with 0 leaves no program
//! behind, neither whole nor in part.
//!
//! Someone who brings a backend of their own links it into a binary of a few lines:
//!
//! ```no_run
//! # fn my_backend() -> &'static dyn vcutc_backend_api::backend::Backend { vcutc::registry::backends()[0] }
//! fn main() -> std::process::ExitCode {
//!     let mut targets = vcutc::registry::backends();
//!     targets.push(my_backend());
//!     vcutc::cli::run(&targets)
//! }
//! ```
#![allow(
    clippy::disallowed_methods,
    reason = "the command line is where files, terminal, environment and clock belong"
)]

mod args;
mod baseline;
mod batch;
mod browser;
mod build;
mod compile;
mod console;
#[cfg(feature = "krl")]
mod convert;
mod differences;
mod dynamics;
mod explain;
mod external;
mod failures;
mod files;
mod fmt;
mod hints;
mod init;
mod inner;
mod joints;
mod kinematics;
#[cfg(feature = "lsp")]
mod lsp;
mod machines;
mod meant;
mod optimize;
mod os_words;
mod output;
mod patience;
mod place;
mod plot;
mod progress;
mod report;
mod shell;
mod snapshot;
mod summary;
mod targets;
mod tools;
mod verify;
mod warnings;
mod watch;

use args::{Arguments, Command};
use console::Console;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;
use vcutc_backend_api::backend::Backend;

/// How a run ended. Later ones outrank earlier ones when several jobs are judged in one run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Exit {
    /// All is well.
    Success,
    JobHasErrors,
    /// There was nothing to judge: wrong usage, or a file that cannot be read or written.
    CannotRun,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        match exit {
            Exit::Success => Self::SUCCESS,
            Exit::JobHasErrors => Self::from(1),
            Exit::CannotRun => Self::from(2),
        }
    }
}

/// The targets that a run can write programs for.
type Targets = [&'static dyn Backend];

/// Runs the command line of this process with these targets, and those that are programs of their own.
#[must_use]
pub fn run(linked: &Targets) -> ExitCode {
    let arguments = match Arguments::of_process() {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    let console = Console::new(&arguments.display, arguments.warnings());
    let outside = external::found(&arguments.outside);
    let all = targets::all(linked, &outside);
    let targets = all.as_slice();
    let exit = match &arguments.command {
        Some(Command::Build(args)) => build::build(args, targets, &console),
        Some(Command::Check(check)) => compile::check(check, targets, &console),
        #[cfg(feature = "krl")]
        Some(Command::Convert(args)) => convert::convert(args, targets, &console),
        Some(Command::Completions { shell }) => shell::completions(*shell, &console),
        Some(Command::Man { output }) => shell::manual(Path::new(output), &console),
        Some(Command::Explain { code }) => explain::explain(code.as_deref(), &console),
        Some(Command::Fmt(args)) => fmt::fmt(args, &console),
        Some(Command::Init(args)) => init::init(args, targets, &console),
        Some(Command::Optimize(optimize)) => optimize::optimize(optimize, targets, &console),
        Some(Command::Place(place)) => place::place(place, targets, &console),
        Some(Command::Fk { cell, joints }) => kinematics::forward(cell, joints, &console),
        Some(Command::Ik {
            cell,
            pose,
            quaternion,
        }) => kinematics::inverse(cell, pose, quaternion.as_deref(), &console),
        #[cfg(feature = "lsp")]
        Some(Command::Lsp { stdio: _ }) => return lsp::serve(targets, &console),
        Some(Command::Machines { machine }) => machines::machines(machine.as_deref(), &console),
        Some(Command::Plot(plot)) => plot::plot(plot, targets, &console),
        Some(Command::Report(report)) => report::report(report, targets, &console),
        Some(Command::Targets { target: None }) => targets::list(linked, &outside, &console),
        Some(Command::Targets { target: Some(target) }) => targets::describe(targets, target, &console),
        Some(Command::Tools(args)) => tools::tools(args, targets, &console),
        Some(Command::Verify(verify)) => verify::verify(verify, linked, targets, &console),
        Some(Command::Watch(args)) => watch::watch(args, targets, &console),
        None => compile::compile(&arguments.compile, targets, &console),
    };
    exit.into()
}

/// A refusal of clap with `help:` where it says `tip:`, so that all advice looks the same.
fn in_our_form(error: &clap::Error) -> String {
    let text = error.render();
    let is_plain = !io::stderr().is_terminal() || std::env::var_os("NO_COLOR").is_some();
    let text = if is_plain {
        text.to_string()
    } else {
        text.ansi().to_string()
    };
    let lines = text.split_inclusive('\n');
    lines
        .map(|line| match line.find("tip:") {
            // At the line's begin, but for blanks and the code of a colour.
            Some(at) if at < 12 => line.replacen("tip:", "help:", 1),
            Some(_) | None => line.to_owned(),
        })
        .collect()
}

/// Prints what clap has to say: help and version on standard output, refusals on standard error.
fn refuse(error: &clap::Error) -> ExitCode {
    // The failure cannot be shown when the terminal itself is gone.
    let _ = if error.use_stderr() {
        io::stderr().write_all(in_our_form(error).as_bytes())
    } else {
        error.print()
    };
    match error.exit_code() {
        0 => Exit::Success.into(),
        _ => Exit::CannotRun.into(),
    }
}
