//! Files of a program that were not given: without them nearly every statement would read otherwise.

use super::written::Written;
use vcutc_backend_api::readback::ProgramFile;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_diagnostics::{Code, Diagnostic};

/// The files of a fresh program that the given one needs and that were not given: one whose companion is there (a `.dat`
/// beside its `.src`, a `.pgf` beside its module), or that a given file speaks of.
pub(super) fn absent<'w>(written: &'w Written, given: &[ProgramFile]) -> Vec<&'w str> {
    let names = written.files.iter().map(|file| file.name.as_str());
    let is_given = |name: &str| given.iter().any(|file| file.name.eq_ignore_ascii_case(name));
    // Files of other names say what they are themselves.
    if !names.clone().any(is_given) {
        return Vec::new();
    }
    names
        .filter(|name| !is_given(name) && is_needed(name, given))
        .collect()
}

fn is_needed(name: &str, given: &[ProgramFile]) -> bool {
    let of = stem(name);
    given
        .iter()
        .any(|file| stem(&file.name).eq_ignore_ascii_case(of) || speaks_of(&file.text, of))
}

fn stem(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

fn speaks_of(text: &str, name: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.any(|word| word.eq_ignore_ascii_case(name))
}

/// That files were not given, in one message.
pub(super) fn not_given(names: &[&str], sources: &[FileId]) -> Option<Diagnostic> {
    let first = Span::of_bytes(*sources.first()?, 0..0);
    let listed = names.join(", ");
    let message = match names {
        [] => return None,
        [one] => format!("the program's file {one} was not given"),
        _ => format!("{} of the program's files were not given: {listed}", names.len()),
    };
    let diagnostic = Diagnostic::new(Code::MissingOperation, message, first, "needs it")
        .note("nothing was compared or checked: a program can only be read as a whole")
        .help(format!("give all files of the program; add {listed}"));
    Some(diagnostic)
}
