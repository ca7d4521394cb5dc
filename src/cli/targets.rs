//! `vcutc targets`: what programs can be written, and with which options.

use super::console::{Console, Failure};
use super::{Exit, Targets};
use crate::diag::suggest::nearest;
use std::fmt::Write;
use vcutc_backend_api::backend::{Backend, OptionKind, OptionSpec};

/// Prints the list.
pub(super) fn list(targets: &Targets, console: &Console) -> Exit {
    console.document(&describe(targets))
}

/// The backend behind `--target`.
pub(super) fn find(targets: &Targets, id: &str) -> Result<&'static dyn Backend, Failure> {
    targets
        .iter()
        .copied()
        .find(|backend| backend.id() == id)
        .ok_or_else(|| {
            let failure = Failure::new(format!("there is no target `{id}`"));
            let failure = match nearest(id, targets.iter().map(|backend| backend.id())).first() {
                Some(near) => failure.help(format!("did you mean `--target {near}`?")),
                None => failure,
            };
            failure.help(format!("targets of this build: {}", names(targets)))
        })
}

/// The names of all targets in one line.
pub(super) fn names(targets: &Targets) -> String {
    let names: Vec<_> = targets.iter().map(|backend| backend.id()).collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

fn describe(targets: &Targets) -> String {
    let mut text = String::new();
    for backend in targets.iter() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}  {}", backend.id(), backend.summary());
        match backend.options() {
            [] => text.push_str("\n  No options.\n"),
            options => {
                let _ = writeln!(
                    text,
                    "\n  Options, in a block `{} {{ ... }}` of the machine:\n",
                    backend.id()
                );
                options.iter().for_each(|spec| describe_option(&mut text, spec));
            }
        }
        text.push('\n');
    }
    if text.is_empty() {
        text.push_str("This build has no targets.\n");
    }
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
