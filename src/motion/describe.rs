//! Branches, places and axis values in words.

use vcutc_backend_api::ir::{Axis, AxisKind, Site};
pub use vcutc_machine::kinematics::configuration::{branch_words, kuka_status};

/// A place in words: `layer 7, cut 12`.
#[must_use]
pub fn site_words(site: Site) -> String {
    match site {
        Site::Program => "the program's ends".to_owned(),
        Site::Operation(operation) => format!("operation {}", u32::from(operation.0) + 1),
        Site::Layer { layer, .. } => format!("layer {layer}"),
        Site::Cut { layer, cut, .. } => format!("layer {layer}, cut {cut}"),
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
