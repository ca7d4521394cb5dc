//! The branch of an arm in the terms of controllers: KUKA's status and turn, ABB's confdata.
//!
//! A pose alone does not determine the branch. Controllers add a few integers to it:
//!
//! - **KUKA** status S: [`vcutc_backend_api::status`] says what it is. Turn T, bits with the weights 1 to 32: A1 to A6
//!   negative. (Beckhoff TF5200 "Status & Turn".)
//! - **ABB** `[cf1, cf4, cf6, cfx]`: [`vcutc_backend_api::confdata`] says what they are.
//!
//! On the border between two ways a controller may decide one way or the other; [`borders`] names the borders that axis
//! values lie on.

use super::Joints;
use super::opw::{Coupling, Opw};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

/// Angles (rad) and sines up to this count as zero.
const ZERO_ANGLE: f64 = 1e-9;
/// Distances (mm) up to this count as zero.
const ZERO_DISTANCE: f64 = 1e-6;

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

/// KUKA's turn T. What is negative by rounding only counts as zero.
#[must_use]
pub fn kuka_turn(joints: &Joints) -> u8 {
    joints
        .iter()
        .enumerate()
        .filter(|(_, joint)| **joint < -ZERO_ANGLE)
        .fold(0, |turn, (axis, _)| turn | 1 << axis)
}

/// A border between two branches, or between two values of a controller's integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// The wrist centre is over axis 1.
    Shoulder,
    /// The arm is stretched or folded.
    Elbow,
    /// Axis 5 is at 0.
    Wrist,
}

/// The branch of an arm at these axis values.
#[must_use]
pub fn branch_of(arm: &Opw, joints: &Joints) -> Branch {
    let stance = Stance::new(arm, joints);
    Branch::Arm {
        shoulder: if stance.wrist_x < 0.0 {
            Shoulder::Back
        } else {
            Shoulder::Front
        },
        elbow: if stance.sin_psi < 0.0 {
            Elbow::Backward
        } else {
            Elbow::Forward
        },
        wrist: if joints[4] < -ZERO_ANGLE {
            Wrist::Negative
        } else {
            Wrist::Positive
        },
    }
}

/// The borders that axis values of an arm lie on.
pub fn borders(arm: &Opw, joints: &Joints) -> impl Iterator<Item = Border> + use<> {
    let stance = Stance::new(arm, joints);
    let shoulder = (stance.wrist_x.abs() <= ZERO_DISTANCE).then_some(Border::Shoulder);
    let elbow = (stance.sin_psi.abs() <= ZERO_ANGLE).then_some(Border::Elbow);
    let wrist = (joints[4].abs() <= ZERO_ANGLE).then_some(Border::Wrist);
    [shoulder, elbow, wrist].into_iter().flatten()
}

/// What distinguishes the branches of an arm.
struct Stance {
    /// The wrist centre in the frame that turns with axis 1, to the front, in mm.
    wrist_x: f64,
    /// Of the angle by which the line from axis 3 to the wrist centre is turned against the upper arm.
    sin_psi: f64,
}

impl Stance {
    fn new(arm: &Opw, joints: &Joints) -> Self {
        let elbow = match arm.coupling {
            Coupling::Serial => joints[2],
            Coupling::Parallelogram => joints[2] - joints[1],
        };
        let upper = arm.signs[1] * joints[1] - arm.offsets[1];
        let bend = arm.signs[2] * elbow - arm.offsets[2];
        let (upper_sin, _) = libm::sincos(upper);
        let (fore_sin, fore_cos) = libm::sincos(upper + bend);
        Self {
            wrist_x: arm.a1 + arm.c2 * upper_sin + arm.a2 * fore_cos + arm.c3 * fore_sin,
            sin_psi: libm::sin(bend + libm::atan2(arm.a2, arm.c3)),
        }
    }
}

#[cfg(test)]
mod tests;
