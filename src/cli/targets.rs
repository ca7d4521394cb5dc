//! `vcutc targets`: what programs can be written, and with which options.

use super::console::{Console, Failure};
use super::external::External;
use super::meant::{Driven, unknown};
use super::{Exit, Targets};
use std::fmt::Write;
use vcutc_backend_api::backend::{Backend, Fault, OptionKind, OptionSpec};
use vcutc_backend_api::protocol::PROGRAM_PREFIX;

/// The targets that are linked in, then those that are programs of their own. What is linked in keeps its name.
pub(super) fn all(linked: &Targets, outside: &[&'static External]) -> Vec<&'static dyn Backend> {
    let mut all = linked.to_vec();
    let used = outside.iter().filter(|external| !is_linked(linked, external));
    all.extend(used.map(|&external| external as &'static dyn Backend));
    all
}

fn is_linked(linked: &Targets, external: &External) -> bool {
    linked.iter().any(|backend| backend.id() == external.id())
}

/// Prints the list: what is linked in with its options, what is found outside by name and place.
pub(super) fn list(linked: &Targets, outside: &[&'static External], console: &Console) -> Exit {
    let mut text: String = linked.iter().map(|backend| description(*backend)).collect();
    if linked.is_empty() {
        text.push_str("This build has no targets.\n");
    }
    if !outside.is_empty() {
        text.push_str("Programs outside of the compiler (`vcutc targets NAME` describes one):\n\n");
    }
    for external in outside {
        let remark = if is_linked(linked, external) {
            "  (not used: the compiler has a target of this name)"
        } else {
            ""
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {}  {}{remark}", external.id(), external.path().display());
    }
    console.document(&text)
}

/// Prints the description of one.
pub(super) fn describe(targets: &Targets, id: &str, console: &Console) -> Exit {
    match find(targets, id, &|| Driven::Unknown) {
        Ok(backend) => console.document(&description(backend)),
        Err(failure) => console.failure(&failure),
    }
}

/// The backend that `--target` names, which can be asked. `asking` says what machine it is for; it is looked at only when there
/// is no such target.
pub(super) fn find<'d>(
    targets: &Targets,
    id: &str,
    asking: &dyn Fn() -> Driven<'d>,
) -> Result<&'static dyn Backend, Failure> {
    let known = targets.iter().copied().find(|backend| backend.id() == id);
    let backend = known.ok_or_else(|| unknown(targets, id, &asking()))?;
    match backend.ready() {
        Ok(()) => Ok(backend),
        Err(fault) => Err(broken(id, &fault)),
    }
}

fn broken(id: &str, fault: &Fault) -> Failure {
    let failure = Failure::new(format!("the program of target `{id}` {}", fault.what));
    let failure = fault
        .said
        .iter()
        .fold(failure, |failure, line| failure.help(format!("it says: {line}")));
    failure.help(format!(
        "docs/backends.md explains what `{PROGRAM_PREFIX}{id}` has to answer"
    ))
}

/// What has to be said of a program that has not been read back.
pub(super) fn not_read_back(backend: &dyn Backend) -> Option<String> {
    let has_no_reader = backend.reader().is_none();
    has_no_reader.then(|| format!("not read back: target {} has no reader", backend.id()))
}

fn description(backend: &dyn Backend) -> String {
    let mut text = format!("{}  {}\n", backend.id(), backend.summary());
    match backend.options() {
        [] => text.push_str("\n  No options.\n"),
        options => {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "\n  Options, in a block `{} {{ ... }}` of the machine:\n",
                backend.id()
            );
            options.iter().for_each(|spec| describe_option(&mut text, spec));
        }
    }
    if backend.reader().is_none() {
        text.push_str("\n  Its programs are not read back: there is no reader for them.\n");
    }
    text.push('\n');
    text
}

fn describe_option(text: &mut String, spec: &OptionSpec) {
    let values = match spec.kind {
        OptionKind::Integer { min, max, default } => {
            format!("a whole number from {min} to {max}, {default} when not given")
        }
        OptionKind::Length { min, max, default } => format!(
            "a length from {} mm to {} mm, {} mm when not given",
            min.to_mm(),
            max.to_mm(),
            default.to_mm()
        ),
        OptionKind::Text => "text in quotes, none when not given".to_owned(),
        OptionKind::Lines => "lines of text in quotes, none when not given".to_owned(),
        OptionKind::Choice { of } => match of.split_first() {
            Some((default, _)) => format!("one of {}; {default} when not given", of.join(", ")),
            None => "no value".to_owned(),
        },
    };
    let _ = writeln!(
        text,
        "    {}\n        {}\n        Takes {values}.",
        spec.key, spec.help
    );
}
