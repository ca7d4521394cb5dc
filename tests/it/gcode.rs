//! Jobs on five-axis machines, all the way to a program in every dialect of G-code.

use crate::pipeline::{Files, compile, numbers, rendered};
use crate::repository::read;
use vcutc::diagnostics::Diagnostic;
use vcutc::driver::{self, EmitFailure, Outcome};
use vcutc::registry;
use vcutc_backend_api::bundle::Bundle;

/// The dialects with what each has to be given.
const DIALECTS: [(&str, &str); 4] = [
    ("linuxcnc", "tcp_on = \"M429\"\n tcp_off = \"M428\""),
    (
        "fanuc",
        "on_code = \"M50\"\n off_code = \"M51\"\n ready_code = \"M52\"",
    ),
    ("sinumerik", ""),
    ("heidenhain", "on_code = \"M50\"\n off_code = \"M51\""),
];

const HOME: &str = "home = axes(x = 0 mm, y = 0 mm, z = 300 mm, b = 0 deg, a = 0 deg)";

/// A job on a machine, with more in its block.
fn outcome(machine: &str, reorient: &str, more: &str) -> Outcome {
    let job = read("tests/process/err/VC0516_no_spindle.vcut")
        .replace("generic/head_head_ac", machine)
        .replace("reorient = 60 deg/s", reorient)
        .replace(
            "c = 0 deg)\n}",
            &format!("c = 0 deg)\n ultrasonic = output(12)\n ready = input(7)\n {more}\n}}"),
        );
    compile("job.vcut", &Files::default().with("job.vcut", job))
}

fn emitted(outcome: &Outcome) -> Result<Bundle, Vec<Diagnostic>> {
    let mut bundle = Bundle::default();
    match driver::emit(outcome, registry::backend("gcode").unwrap(), &mut bundle) {
        Ok(()) => Ok(bundle),
        Err(EmitFailure::Diagnostics(diagnostics)) => Err(diagnostics),
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn a_head_that_swings_and_rakes_gets_a_program_in_every_dialect() {
    for (dialect, codes) in DIALECTS {
        let block = format!("{HOME}\n gcode {{\n dialect = {dialect}\n {codes}\n }}");
        let outcome = outcome("generic/head_head_ba", "reorient = 40 deg/s", &block);
        let bundle = emitted(&outcome).unwrap_or_else(|found| panic!("{}", rendered(&found, &outcome)));
        assert_eq!(bundle.files().len(), 1);
    }
}

#[test]
fn an_orientable_spindle_needs_a_letter() {
    let home = "home = axes(x = 0 mm, y = 0 mm, z = 300 mm, c = 0 deg, a = 0 deg, s = 0 deg)";
    let with = |letter| {
        let block = format!("{home}\n gcode {{ dialect = sinumerik\n spindle_axis = {letter} }}");
        outcome("generic/head_head_ac_spindle", "reorient = 25 deg/s", &block)
    };
    // The block is the machine's own, so the job is refused with it.
    assert_eq!(numbers(&with("none").diagnostics), ["VC0604"]);
    let bundle = emitted(&with("b")).unwrap();
    let text = core::str::from_utf8(&bundle.files()[0].1).unwrap();
    assert!(text.contains(" C224."), "a branch that goes beyond half a turn");
}

#[test]
fn every_option_is_explained() {
    let page = read("docs/backends/gcode.md");
    for option in registry::backend("gcode").unwrap().options() {
        assert!(page.contains(&format!("`{}`", option.key)), "{}", option.key);
    }
}

/// What the help line offers for a home is taken.
#[test]
fn a_home_that_is_missing_is_reported_with_the_machines_own_axes() {
    let with = |home: &str| {
        let block = format!("{home}\n gcode {{ dialect = sinumerik }}");
        outcome("generic/head_head_ba", "reorient = 40 deg/s", &block)
    };
    let refused = emitted(&with("")).unwrap_err();
    assert_eq!(numbers(&refused), ["VC0602"]);
    let help = refused[0].help.join(" ");
    let line = help.split('`').nth(1).unwrap();
    assert_eq!(
        line,
        "home = axes(x = 0 mm, y = 0 mm, z = 400 mm, b = 0 deg, a = 0 deg)"
    );
    assert!(emitted(&with(line)).is_ok());
}
