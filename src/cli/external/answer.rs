//! What an outside program has written, compared with what a program of a machine may be.

use super::description::{Described, kept};
use super::fault::{fault, fault_at, line};
use std::collections::BTreeSet;
use vcutc_backend_api::backend::{BackendIssue, Fault, OptionSpec};
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::protocol::{Emitted, Problem, Said};
use vcutc_backend_api::readback::ProgramFile;

/// Most problems of a reply that are reported.
const MOST_PROBLEMS: usize = 20;

/// Most files of a program.
const MOST_FILES: usize = 10_000;

/// Longest name of a file, in bytes.
const LONGEST_NAME: usize = 100;

/// Names that Windows takes for devices, whatever their extension.
const DEVICES: [&str; 4] = ["CON", "PRN", "AUX", "NUL"];
/// The same, followed by a digit.
const NUMBERED_DEVICES: [&str; 2] = ["COM", "LPT"];

/// The files of a reply to a program of so many ops.
///
/// # Errors
/// The problems that the program has found, or what is wrong with its reply.
pub(super) fn files(
    emitted: Emitted,
    ops: usize,
    described: &Described,
) -> Result<Vec<ProgramFile>, Vec<BackendIssue>> {
    if !emitted.problems.is_empty() {
        let problems = emitted.problems.iter().take(MOST_PROBLEMS);
        return Err(problems.map(|problem| issue(problem, ops, described)).collect());
    }
    check_names(&emitted.files)
        .and_then(|()| check_ops(&emitted.said, &emitted.files, ops))
        .map_err(|fault| vec![BackendIssue::Failed(fault)])?;
    Ok(emitted.files)
}

fn check_names(files: &[ProgramFile]) -> Result<(), Fault> {
    if files.is_empty() {
        return Err(fault("answers without any file"));
    }
    if files.len() > MOST_FILES {
        return Err(fault(format!("answers more than {MOST_FILES} files")));
    }
    let mut names = BTreeSet::new();
    for ProgramFile { name, .. } in files {
        if !is_plain(name) {
            return Err(fault(format!(
                "calls a file `{}`; a name has letters, digits, `_`, `-` and `.` only, without folders, and is that of no device",
                line(name)
            )));
        }
        // Some file systems take RIB.NC and rib.nc for the same.
        if !names.insert(name.to_ascii_lowercase()) {
            return Err(fault(format!("answers two files called `{name}`")));
        }
    }
    Ok(())
}

/// Whether a name is that of a file, and of nothing else, in any folder of any system.
fn is_plain(name: &str) -> bool {
    let known = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '-' | '.');
    let stem = name.split('.').next().unwrap_or_default().to_ascii_uppercase();
    let numbered = |device: &str| {
        let digit = stem.strip_prefix(device);
        digit.is_some_and(|rest| rest.len() == 1 && rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let is_device =
        DEVICES.contains(&stem.as_str()) || NUMBERED_DEVICES.iter().any(|device| numbered(device));
    (1..=LONGEST_NAME).contains(&name.len())
        && name.chars().all(known)
        && !name.starts_with(['.', '-'])
        && !name.ends_with('.')
        && !is_device
}

/// Every op is named once, at a line that exists.
fn check_ops(said: &[Said], files: &[ProgramFile], ops: usize) -> Result<(), Fault> {
    let lines: Vec<usize> = files.iter().map(|file| file.text.lines().count()).collect();
    let mut seen = vec![false; ops];
    for Said { op, file, line } in said {
        let number = op.0;
        let Some(seen) = seen.get_mut(number as usize) else {
            return Err(fault(format!("says an op {number}; the program has {ops} ops")));
        };
        if *seen {
            return Err(fault_at(*op, format!("says op {number} twice")));
        }
        *seen = true;
        let there = lines.get(*file as usize).copied().unwrap_or_default();
        if !(1..=there).contains(&(*line as usize)) {
            return Err(fault_at(
                *op,
                format!("says op {number} at line {line} of file {file}, which is not there"),
            ));
        }
    }
    let missing: Vec<u32> = (0..)
        .zip(&seen)
        .filter_map(|(op, seen)| (!seen).then_some(op))
        .collect();
    match missing.as_slice() {
        [] => Ok(()),
        [op] => Err(fault_at(OpId(*op), format!("does not say op {op}"))),
        [op, others @ ..] => {
            let others = others.len();
            Err(fault_at(
                OpId(*op),
                format!("does not say op {op}, nor {others} more"),
            ))
        }
    }
}

/// A problem as data of the trait. Ops that there are not make it a fault.
fn issue(problem: &Problem, ops: usize, described: &Described) -> BackendIssue {
    let beyond = |op: OpId| (op.0 as usize) >= ops;
    match problem {
        Problem::Unsupported { op, .. } | Problem::OutOfRange { op: Some(op), .. } if beyond(*op) => {
            let number = op.0;
            BackendIssue::Failed(fault(format!(
                "has a problem with op {number}; the program has {ops} ops"
            )))
        }
        Problem::WrongMachine { mismatch } => BackendIssue::WrongMachine {
            mismatch: *mismatch,
            drives: described.drives,
        },
        Problem::MissingMachineField { field, why } => BackendIssue::MissingMachineField {
            field: kept(field),
            why: kept(why),
        },
        Problem::OptionConflict { key, why } => BackendIssue::OptionConflict {
            key: known_key(key, described.options),
            why: line(why),
        },
        Problem::Profile { key, why } => BackendIssue::Profile {
            key: kept(key),
            why: line(why),
        },
        Problem::Unsupported { op, what } => BackendIssue::Unsupported {
            op: *op,
            what: kept(what),
        },
        Problem::OutOfRange {
            op,
            what,
            value,
            allowed,
            range,
        } => BackendIssue::OutOfRange {
            op: *op,
            what: kept(what),
            value: line(value),
            allowed: line(allowed),
            range: *range,
        },
    }
}

fn known_key(key: &str, options: &'static [OptionSpec]) -> &'static str {
    let known = options.iter().find(|spec| spec.key == key);
    known.map_or_else(|| kept(key), |spec| spec.key)
}
