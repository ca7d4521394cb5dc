//! What the integration tests share.

pub(crate) mod expected;
pub(crate) mod reader;

use vcutc_backend_api::backend::{Backend, BackendIssue, OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{AxisValues, PlacedFrame, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::testkit;
use vcutc_backend_api::verify::verify;
use vcutc_backend_krl::Krl;

/// The options with these values set.
pub(crate) fn options(values: &[(&str, OptionValue)]) -> Options {
    let mut options = Options::defaults(Krl.options());
    for (key, value) in values {
        let spec = Krl.options().iter().find(|spec| spec.key == *key).unwrap();
        options.set(spec, value.clone()).unwrap();
    }
    options
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

/// `S` of the pretend machine, whose shoulder is in front and whose elbow is forward.
pub(crate) fn status(axes: &AxisValues) -> u32 {
    if axes.0[4] < 0.0 { 6 } else { 2 }
}

pub(crate) fn emit(program: &ReachableProgram, values: &[(&str, OptionValue)]) -> Bundle {
    let mut bundle = Bundle::default();
    let options = options(values);
    Krl.check(program, &options)
        .map_err(|issues| format!("{issues:?}"))
        .unwrap()
        .write(&mut bundle)
        .unwrap();
    bundle
}

pub(crate) fn issues(program: Program, values: &[(&str, OptionValue)]) -> Vec<BackendIssue> {
    Krl.check(&reachable(program), &options(values))
        .err()
        .unwrap_or_default()
}

/// The file as lines, without the line ends that every line must have.
pub(crate) fn lines(bundle: &Bundle, name: &str) -> Vec<String> {
    let text = String::from_utf8(bundle.get(name).unwrap().to_vec()).unwrap();
    let mut lines: Vec<&str> = text.split("\r\n").collect();
    assert_eq!(lines.pop(), Some(""), "{name} ends with a line end");
    assert!(lines.iter().all(|line| !line.contains(['\r', '\n'])), "{name}");
    lines.into_iter().map(str::to_owned).collect()
}
