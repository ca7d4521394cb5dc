//! Programs with a blade that spins.

use crate::read_back::{replayed, statements};
use crate::support::{emit, lines, options, reachable};
use vcutc_backend_api::backend::{Backend, OptionValue};
use vcutc_backend_api::ir::{Changer, Program, Spindle};
use vcutc_backend_api::readback::program_files;
use vcutc_backend_api::script::LINES_PER_PART;
use vcutc_backend_api::testkit::{Recipe, with_disc};
use vcutc_backend_api::verify::Capability;
use vcutc_backend_krl::Krl;

fn program(spindle: Spindle) -> Program {
    let recipe = Recipe {
        name: "disc".to_owned(),
        layers: 1,
        cuts: 1,
        ..Recipe::default()
    };
    with_disc(recipe.program(), Changer::Hand, spindle)
}

#[test]
fn an_output_runs_the_spindle() {
    let bundle = emit(&reachable(program(Spindle::Output(13))), &[]);
    let lines = lines(&bundle, "disc.src");
    let place = |wanted: &str| lines.iter().rposition(|line| line == wanted).unwrap();
    let (on, off) = (place("$OUT[13]=TRUE"), place("$OUT[13]=FALSE"));
    assert!(place("HALT") < on && on < off);
    assert_eq!(
        lines[on + 1..on + 3],
        ["$OUT[12]=TRUE".to_owned(), "WAIT SEC 0.5".to_owned()]
    );
    assert!(
        lines
            .iter()
            .any(|line| line == "; disc of radius 25 mm, 3000 rev/min: wheel")
    );
}

#[test]
fn it_is_read_back_however_it_is_split_and_every_change_is_found() {
    let program = reachable(program(Spindle::Output(13)));
    for limit in [0, 1, 20] {
        let given = [(LINES_PER_PART, OptionValue::Integer(limit))];
        let files = program_files(&emit(&program, &given));
        let options = options(&given);
        assert!(replayed(&statements(&files, &program, &options), &program, &options).is_ok());
    }
    for (from, to) in [
        ("$OUT[13]=TRUE", ""),
        ("$OUT[13]=TRUE", "$OUT[14]=TRUE"),
        ("$OUT[13]=TRUE", "$OUT[13]=FALSE"),
        ("$OUT[13]=FALSE", ""),
    ] {
        let mut files = program_files(&emit(&program, &[]));
        files[0].text = files[0].text.replace(from, to);
        let options = options(&[]);
        assert!(
            replayed(&statements(&files, &program, &options), &program, &options).is_err(),
            "{from} {to}"
        );
    }
}

/// A program that needs one is refused by name before the backend is asked.
#[test]
fn a_robot_has_no_spindle_of_its_own() {
    let needs = reachable(program(Spindle::Own)).verified().needs();
    let missing: Vec<Capability> = needs.missing_from(Krl.capabilities()).collect();
    assert_eq!(missing, [Capability::Spindle]);
}
