//! Branches, places and axis values in words.

use vcutc_backend_api::ir::{Axis, AxisKind, OperationId, Program, Site};
pub use vcutc_machine::kinematics::configuration::branch_words;

/// A place of a program in words: `layer 7, cut 12`, where there are several operations `layer 7, cut 12 of operation 2`.
#[must_use]
pub fn site_words(program: &Program, site: Site) -> String {
    let number = |operation: OperationId| u32::from(operation.0) + 1;
    let of = |operation| match program.operations.as_slice() {
        [] | [_] => String::new(),
        [_, _, ..] => format!(" of operation {}", number(operation)),
    };
    match site {
        Site::Program => "the program's ends".to_owned(),
        Site::Operation(operation) => format!("operation {}", number(operation)),
        Site::Layer { operation, layer } => format!("layer {layer}{}", of(operation)),
        Site::Cut {
            operation,
            layer,
            cut,
        } => {
            let kind = program.cut_kind_at(site).noun();
            format!("layer {layer}, {kind} {cut}{}", of(operation))
        }
    }
}

/// The value of an axis with its unit, in degrees or millimetres, with decimals enough to tell it from its limit.
#[must_use]
pub fn value_words(axis: &Axis, value: f64) -> String {
    match axis.kind {
        AxisKind::Rotary => format!("{:.2} deg", value.to_degrees()),
        AxisKind::Linear => format!("{value:.2} mm"),
    }
}
