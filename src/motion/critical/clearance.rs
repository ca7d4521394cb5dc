//! How far a machine stands from its singular poses at given axis values.

use crate::path::Clearance;
use core::f64::consts::PI;
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::{Joints, Mechanism};

/// How far an arm is from its singular poses.
#[must_use]
pub fn clearance(mechanism: &Mechanism, joints: &Joints) -> Clearance {
    match mechanism {
        Mechanism::OrthoParallel(arm) => arm_clearance(arm, joints),
        Mechanism::Mounted(mounted) => arm_clearance(&mounted.arm, joints),
        // A five-axis machine has no such poses; of a general arm the proof alone says.
        Mechanism::FiveAxis(_) | Mechanism::Serial(_) => Clearance::UNLIMITED,
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
