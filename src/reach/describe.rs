//! Branches, places and axis values in words.

use vcutc_backend_api::ir::{Axis, AxisKind, Site};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

/// A branch in words: `wrist in front of axis 1, elbow folded forward, axis 5 positive`.
#[must_use]
pub fn branch_words(branch: Branch) -> String {
    match branch {
        Branch::Arm {
            shoulder,
            elbow,
            wrist,
        } => {
            let shoulder = match shoulder {
                Shoulder::Front => "wrist in front of axis 1",
                Shoulder::Back => "wrist behind axis 1",
            };
            let elbow = match elbow {
                Elbow::Forward => "forearm folded forward",
                Elbow::Backward => "forearm folded back",
            };
            let wrist = match wrist {
                Wrist::Positive => "axis 5 positive",
                Wrist::Negative => "axis 5 negative",
            };
            format!("{shoulder}, {elbow}, {wrist}")
        }
        Branch::Numbered(number) => format!("solution {}", number.saturating_add(1)),
    }
}

/// KUKA's status bits of a branch (bit 0: wrist behind axis 1, bit 1: forearm folded forward, bit 2: axis 5 negative).
#[must_use]
pub const fn kuka_status(branch: Branch) -> Option<u8> {
    match branch {
        Branch::Arm {
            shoulder,
            elbow,
            wrist,
        } => {
            let behind = match shoulder {
                Shoulder::Front => 0,
                Shoulder::Back => 1,
            };
            let forward = match elbow {
                Elbow::Forward => 2,
                Elbow::Backward => 0,
            };
            let negative = match wrist {
                Wrist::Positive => 0,
                Wrist::Negative => 4,
            };
            Some(behind | forward | negative)
        }
        Branch::Numbered(_) => None,
    }
}

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
