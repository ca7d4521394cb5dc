//! Programs with a blade that spins.

use crate::round_trip::replayed;
use crate::support::{emit_with, lines, one_cut, options, reachable};
use vcutc_backend_api::backend::{Backend, OptionValue};
use vcutc_backend_api::ir::{Changer, Program, Spindle};
use vcutc_backend_api::readback::program_files;
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{Recipe, with_disc};
use vcutc_backend_api::verify::Capability;
use vcutc_backend_rapid::Rapid;

fn program(spindle: Spindle) -> Program {
    let recipe = Recipe {
        name: "disc".to_owned(),
        ..one_cut()
    };
    with_disc(recipe.program(), Changer::Hand, spindle)
}

#[test]
fn an_output_runs_the_spindle() {
    let program = reachable(program(Spindle::Output(13)));
    let named = [("spindle_signal", OptionValue::Text("doDisc".to_owned()))];
    for (given, on) in [
        (&[][..], "    SetDO do13,1;"),
        (&named[..], "    SetDO doDisc,1;"),
    ] {
        let options = options(given);
        let bundle = emit_with(&program, &options);
        let lines = lines(&bundle, "disc.mod");
        assert!(lines.iter().any(|line| line == on), "{lines:#?}");
        // The generator keeps its own name.
        assert!(lines.iter().any(|line| line == "    SetDO do12,1;"));
        assert!(replayed(&program, &options, &program_files(&bundle)).is_ok());
    }
}

#[test]
fn it_is_read_back_however_it_is_split_and_every_change_is_found() {
    let program = reachable(program(Spindle::Output(13)));
    for limit in [0, 1, 20] {
        let options = options(&[(LINES_PER_PART, OptionValue::Integer(limit))]);
        let files = program_files(&emit_with(&program, &options));
        assert!(replayed(&program, &options, &files).is_ok());
    }
    let options = options(&[]);
    for (from, to) in [
        ("SetDO do13,1;", ""),
        ("SetDO do13,1;", "SetDO do14,1;"),
        ("SetDO do13,1;", "SetDO do13,0;"),
        ("SetDO do13,0;", ""),
    ] {
        let mut files = program_files(&emit_with(&program, &options));
        for file in &mut files {
            file.text = file.text.replace(from, to);
        }
        assert!(replayed(&program, &options, &files).is_err(), "{from} {to}");
    }
}

/// A program that needs one is refused by name before the backend is asked.
#[test]
fn a_robot_has_no_spindle_of_its_own() {
    let needs = reachable(program(Spindle::Own)).verified().needs();
    let missing: Vec<Capability> = needs.missing_from(Rapid.capabilities()).collect();
    assert_eq!(missing, [Capability::Spindle]);
}
