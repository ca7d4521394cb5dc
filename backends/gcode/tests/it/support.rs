//! What the integration tests share.

use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::testkit::{self, CellRecipe, Recipe};
use vcutc_backend_api::verify::verify;
use vcutc_backend_gcode::Gcode;

/// A value given to an option.
pub(crate) type Given = (&'static str, OptionValue);

/// The dialects by the words of their option.
pub(crate) const DIALECTS: [&str; 4] = ["linuxcnc", "fanuc", "sinumerik", "heidenhain"];

/// A block as an option takes it.
pub(crate) fn block(text: &str) -> OptionValue {
    OptionValue::Lines(vec![text.to_owned()])
}

/// What a dialect needs to be given before it can say a program that waits for no input.
pub(crate) fn needed(dialect: &'static str) -> Vec<Given> {
    let mut given = vec![("dialect", OptionValue::Choice(dialect))];
    match dialect {
        "linuxcnc" => given.extend([("tcp_on", block("M429")), ("tcp_off", block("M428"))]),
        "sinumerik" => {}
        _ => given.extend([("on_code", block("M50")), ("off_code", block("M51"))]),
    }
    given
}

/// Whether a dialect has a word for rounding corners.
pub(crate) fn rounds(dialect: &str) -> bool {
    matches!(dialect, "linuxcnc" | "sinumerik")
}

/// The options with these values set.
pub(crate) fn options(given: &[Given]) -> Options {
    let mut options = Options::defaults(Gcode.options());
    for (key, value) in given {
        let spec = Gcode.options().iter().find(|spec| spec.key == *key).unwrap();
        options.set(spec, value.clone()).unwrap();
    }
    options
}

/// A recipe for the pretend five-axis machine.
pub(crate) fn recipe() -> Recipe {
    Recipe {
        cell: CellRecipe::five_axis(),
        ..Recipe::default()
    }
}

/// A program with the motion of the pretend machine.
pub(crate) fn reachable(program: Program) -> ReachableProgram {
    testkit::reachable(verify(program).unwrap()).unwrap()
}

/// What is emitted for a dialect, with more options than those that it needs.
pub(crate) fn emit(program: &ReachableProgram, dialect: &'static str, more: &[Given]) -> Bundle {
    emit_with(program, dialect, more, Profile::default())
}

/// The same for a machine with habits.
pub(crate) fn emit_with(
    program: &ReachableProgram,
    dialect: &'static str,
    more: &[Given],
    profile: Profile,
) -> Bundle {
    let mut given = needed(dialect);
    given.extend_from_slice(more);
    let options = options(&given).with_profile(profile);
    let mut bundle = Bundle::default();
    Gcode
        .check(program, &options)
        .map_err(|issues| format!("{dialect}: {issues:?}"))
        .unwrap()
        .write(&mut bundle)
        .unwrap();
    bundle
}

/// What stands in the way of a program.
pub(crate) fn issues(program: Program, given: &[Given]) -> Vec<BackendIssue> {
    issues_with(program, given, Profile::default())
}

/// The same for a machine with habits.
pub(crate) fn issues_with(program: Program, given: &[Given], profile: Profile) -> Vec<BackendIssue> {
    let options = options(given).with_profile(profile);
    Gcode
        .check(&reachable(program), &options)
        .err()
        .unwrap_or_default()
}

/// All files with their names, as one text.
pub(crate) fn text(bundle: &Bundle) -> String {
    let files = bundle.files().iter();
    files
        .map(|(name, bytes)| format!("=== {name}\n{}", core::str::from_utf8(bytes).unwrap()))
        .collect()
}
