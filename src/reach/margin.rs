//! Margins: how much room is left, from 1 (every axis in the middle of its range, far from singular poses) to 0.

use super::path::Clearance;
use crate::kinematics::Joints;
use crate::kinematics::Mechanism;
use crate::kinematics::opw::{Coupling, Opw};
use core::f64::consts::{FRAC_PI_2, PI};
use vcutc_backend_api::ir::Axis;

/// The margin of an axis that goes from `low` to `high`: what is left to the nearer limit, as a share of half the range.
#[must_use]
pub fn of_axis(axis: &Axis, low: f64, high: f64) -> f64 {
    (low - axis.min).min(axis.max - high) / ((axis.max - axis.min) / 2.0)
}

/// The margin of an arm that keeps this far from its singular poses.
#[must_use]
pub fn of_clearance(clearance: &Clearance) -> f64 {
    (clearance.wrist / FRAC_PI_2)
        .min(clearance.elbow / FRAC_PI_2)
        .min(clearance.shoulder / 1000.0)
        .min(1.0)
}

/// How far an arm is from its singular poses.
#[must_use]
pub fn clearance(mechanism: &Mechanism, joints: &Joints) -> Clearance {
    match mechanism {
        Mechanism::OrthoParallel(arm) => arm_clearance(arm, joints),
    }
}

fn arm_clearance(arm: &Opw, joints: &Joints) -> Clearance {
    let elbow_joint = match arm.coupling {
        Coupling::Serial => joints[2],
        Coupling::Parallelogram => joints[2] - joints[1],
    };
    let q = |i: usize, joint: f64| arm.signs[i] * joint - arm.offsets[i];
    let psi = q(2, elbow_joint) + libm::atan2(arm.a2, arm.c3);
    let folded = |angle: f64| {
        let rest = libm::fabs(libm::remainder(angle, 2.0 * PI));
        rest.min(PI - rest)
    };
    let (q2, q3) = (q(1, joints[1]), q(2, elbow_joint));
    let along = arm.a1 + arm.c2 * libm::sin(q2) + arm.a2 * libm::cos(q2 + q3) + arm.c3 * libm::sin(q2 + q3);
    Clearance {
        wrist: folded(q(4, joints[4])),
        elbow: folded(psi),
        shoulder: libm::fabs(along),
    }
}
