//! What the integration tests share.

use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{Maker, PlacedFrame, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::testkit::{self, CellRecipe, Recipe};
use vcutc_backend_api::verify::verify;
use vcutc_backend_rapid::Rapid;

/// The options with these values set.
pub(crate) fn options(values: &[(&str, OptionValue)]) -> Options {
    let mut options = Options::defaults(Rapid.options());
    for (key, value) in values {
        let spec = Rapid.options().iter().find(|spec| spec.key == *key).unwrap();
        options.set(spec, value.clone()).unwrap();
    }
    options
}

/// A cell with an ABB robot.
pub(crate) fn cell() -> CellRecipe {
    CellRecipe {
        maker: Maker::Abb,
        ..CellRecipe::default()
    }
}

/// The usual program on such a cell.
pub(crate) fn recipe() -> Recipe {
    Recipe {
        cell: cell(),
        ..Recipe::default()
    }
}

/// One V-cut.
pub(crate) fn one_cut() -> Recipe {
    Recipe {
        layers: 1,
        cuts: 1,
        ..recipe()
    }
}

/// A program with the motion of the pretend machine.
pub(crate) fn reachable(program: Program) -> ReachableProgram {
    testkit::reachable(verify(program).unwrap()).unwrap()
}

/// A frame that the controller keeps. Its values are beside the point here.
pub(crate) fn numbered(number: u32) -> PlacedFrame {
    PlacedFrame {
        frame: Frame {
            origin: Point3::new(0.0, 0.0, 0.0),
            orientation: Orientation::IDENTITY,
        },
        number: Some(number),
    }
}

pub(crate) fn emit_with(program: &ReachableProgram, options: &Options) -> Bundle {
    let mut bundle = Bundle::default();
    Rapid
        .check(program, options)
        .map_err(|issues| format!("{issues:?}"))
        .unwrap()
        .write(&mut bundle)
        .unwrap();
    bundle
}

pub(crate) fn emit(program: &ReachableProgram, values: &[(&str, OptionValue)]) -> Bundle {
    emit_with(program, &options(values))
}

pub(crate) fn issues_with(program: Program, options: &Options) -> Vec<BackendIssue> {
    Rapid
        .check(&reachable(program), options)
        .err()
        .unwrap_or_default()
}

pub(crate) fn issues(program: Program, values: &[(&str, OptionValue)]) -> Vec<BackendIssue> {
    issues_with(program, &options(values))
}

/// The file as lines, without the line ends that every line must have.
pub(crate) fn lines(bundle: &Bundle, name: &str) -> Vec<String> {
    let text = String::from_utf8(bundle.get(name).unwrap().to_vec()).unwrap();
    let mut lines: Vec<&str> = text.split("\r\n").collect();
    assert_eq!(lines.pop(), Some(""), "{name} ends with a line end");
    assert!(lines.iter().all(|line| !line.contains(['\r', '\n'])), "{name}");
    lines.into_iter().map(str::to_owned).collect()
}
