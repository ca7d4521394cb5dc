//! The command line from outside: what it prints where, how it ends, and what it leaves on the disk.

mod baseline;
mod build;
mod ci;
#[cfg(all(feature = "gcode", feature = "rapid"))]
mod convert;
#[cfg(feature = "gcode")]
mod dialects;
mod fmt;
mod gallery;
#[cfg(all(feature = "gcode", feature = "rapid"))]
mod init;
mod jobs;
mod kinematics;
mod machines;
mod optimize;
#[cfg(unix)]
mod outside;
mod place;
mod plot;
mod profiles;
mod refusals;
pub(crate) mod report;
mod snapshot;
#[cfg(unix)]
mod tools;
mod tour;
#[cfg(all(feature = "gcode", feature = "rapid"))]
mod usage;
mod verify;
mod warnings;
#[cfg(unix)]
pub(crate) mod watch;

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// What a run left.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// An empty folder to work in.
fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Copies a folder with all that is in it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// The compiler, to be started in a folder, undisturbed by the environment of the tests.
fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vcutc"));
    // What is found in a second depends on the machine that runs the tests.
    let says_so = args.iter().any(|arg| arg.starts_with("--help-budget"));
    if !args.is_empty() && !says_so {
        command.arg("--help-budget=none");
    }
    command.args(args).current_dir(folder).stdin(Stdio::null());
    for variable in ["COLUMNS", "NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(variable);
    }
    command
}

fn run(mut command: Command) -> Run {
    let output = command.output().unwrap();
    Run {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs the compiler in a folder.
pub(crate) fn vcutc(folder: &Path, args: &[&str]) -> Run {
    run(command(folder, args))
}

/// Runs the compiler with a text on its standard input.
fn vcutc_reading(folder: &Path, args: &[&str], input: &str) -> Run {
    let mut command = command(folder, args);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    Run {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

/// The names in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The JSON objects of a stream, a line each.
fn json_lines(text: &str) -> Vec<serde_json::Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error} in {line}")))
        .collect()
}
