//! Ortho-parallel arms with a spherical wrist: their closed-form inverse kinematics, computed along a span.
//!
//! These are the formulas of [`crate::kinematics::opw`] (Brandstötter, Angerer, Hofbaur 2014), with [`Along`] in the place
//! of numbers. Every root and arc exists on the whole span or the span is refused, so what comes out is one continuous
//! branch.

use super::along::Along;
use super::bounds::Stretch;
use super::course::{Flange, Flight, Span};
use super::{Clearance, Singularity, Violation};
use crate::kinematics::opw::{Coupling, Opw};
use core::f64::consts::PI;
use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

/// The branch of an arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmBranch {
    pub(super) shoulder: Shoulder,
    pub(super) elbow: Elbow,
    pub(super) wrist: Wrist,
}

impl From<ArmBranch> for Branch {
    fn from(branch: ArmBranch) -> Self {
        let ArmBranch {
            shoulder,
            elbow,
            wrist,
        } = branch;
        Self::Arm {
            shoulder,
            elbow,
            wrist,
        }
    }
}

/// An arm along a span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posture {
    /// The controller's angles, each up to whole turns.
    pub(super) axes: [Along; 6],
    /// How near singular poses it comes.
    pub(super) clearance: Clearance,
}

impl Posture {
    /// The same by parts of the course.
    #[inline(always)]
    pub(super) fn stretch(&self, span: Span) -> Stretch {
        let by_course = 1.0 / span.half;
        Stretch {
            begin: self.axes.map(Along::begin),
            value: self.axes.map(Along::value),
            end: self.axes.map(Along::end),
            rate: self.axes.map(|axis| axis.rate() * by_course),
            // A true second derivative lies somewhere in `bend`; the rest of `bend` is excess.
            excess: self.axes.map(|axis| 0.5 * axis.bend().width()),
            rate_excess: self.axes.map(|axis| axis.bend().width() * by_course),
            clearance: self.clearance,
        }
    }
}

/// An arm on a branch that carries the flange along a span, to be computed with what instructions the processor has. Which
/// these are does not show in the answer: nothing is reordered or fused.
pub(super) struct Carrying<'a> {
    pub(super) arm: &'a Opw,
    pub(super) branch: ArmBranch,
    pub(super) flight: &'a Flight,
    pub(super) span: Span,
}

impl Carrying<'_> {
    /// What the arm does on the span.
    pub(super) fn stretch(self) -> Result<Stretch, Violation> {
        Arch::new().dispatch(self)
    }
}

impl NullaryFnOnce for Carrying<'_> {
    type Output = Result<Stretch, Violation>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let flange = self.flight.over(self.span);
        Ok(posture(self.arm, self.branch, &flange)?.stretch(self.span))
    }
}

/// The posture of the arm on a branch that carries the flange along a span.
#[inline(always)]
fn posture(arm: &Opw, branch: ArmBranch, flange: &Flange) -> Result<Posture, Violation> {
    let (q1, wrist_x, wrist_z) = shoulder(arm, branch.shoulder, flange)?;
    let (q2, q3, psi) = elbow(arm, branch.elbow, wrist_x, wrist_z)?;
    let (q4, q5, q6, bent) = wrist(arm, branch.wrist, q1, q2 + q3, flange)?;
    let clearance = Clearance {
        wrist: from_line(bent),
        elbow: from_line(psi),
        shoulder: least_magnitude(wrist_x),
    };
    Ok(Posture {
        axes: controller_angles(arm, [q1, q2, q3, q4, q5, q6]),
        clearance,
    })
}

/// Axis 1, and the wrist centre in the frame that turns with it: forward of axis 1, and upward from the root.
#[inline(always)]
fn shoulder(arm: &Opw, side: Shoulder, flange: &Flange) -> Result<(Along, Along, Along), Violation> {
    let [x, y, z] = flange.point(DVec3::new(0.0, 0.0, -arm.c4));
    let square = (x.squared() + y.squared()).plus(-arm.b * arm.b);
    let near_axis = || singular(square, Singularity::Shoulder(0.0));
    let distance = square.root().ok_or_else(near_axis)?;
    let forward = match side {
        Shoulder::Front => distance,
        Shoulder::Back => -distance,
    };
    let sideways = Along::constant(arm.b);
    let turned = Along::arc(sideways, forward).ok_or_else(near_axis)?;
    let q1 = Along::arc(y, x).ok_or_else(near_axis)? - turned;
    Ok((q1, forward, z))
}

/// Axes 2 and 3, and the angle between the upper arm and the line from axis 3 to the wrist centre, which is signed.
#[inline(always)]
fn elbow(arm: &Opw, side: Elbow, wrist_x: Along, wrist_z: Along) -> Result<(Along, Along, Along), Violation> {
    let (forward, up) = (wrist_x.plus(-arm.a1), wrist_z.plus(-arm.c1));
    let fore = libm::hypot(arm.a2, arm.c3);
    let scale = 1.0 / (2.0 * arm.c2 * fore);
    if !scale.is_finite() {
        return Err(Violation::OutOfReach);
    }
    // The law of cosines.
    let cosine = (forward.squared() + up.squared()).plus(-arm.c2 * arm.c2 - fore * fore) * scale;
    let square = (-cosine.squared()).plus(1.0);
    let straight = || singular(square, Singularity::Elbow(0.0));
    let folded = square.root().ok_or_else(straight)?;
    let sine = match side {
        Elbow::Forward => folded,
        Elbow::Backward => -folded,
    };
    let psi = Along::arc(sine, cosine).ok_or_else(straight)?;
    let line = Along::arc(forward, up).ok_or_else(straight)?;
    let inner = Along::arc(sine * fore, (cosine * fore).plus(arm.c2)).ok_or_else(straight)?;
    let q3 = psi.plus(-libm::atan2(arm.a2, arm.c3));
    Ok((line - inner, q3, psi))
}

/// Axes 4, 5 and 6, and by how much the hand is bent.
#[inline(always)]
fn wrist(
    arm: &Opw,
    side: Wrist,
    q1: Along,
    q23: Along,
    flange: &Flange,
) -> Result<(Along, Along, Along, Along), Violation> {
    let ((sin1, cos1), (sin23, cos23)) = (q1.sin_cos(), q23.sin_cos());
    let hand_x = flange.direction(DVec3::X);
    let hand_y = flange.direction(DVec3::Y);
    let hand_z = flange.direction(DVec3::Z);
    // In the frame that turns with axis 1, then in the forearm's.
    let forward = |v: [Along; 3]| cos1 * v[0] + sin1 * v[1];
    let along_forearm = |v: [Along; 3]| sin23 * forward(v) + cos23 * v[2];
    let tool_forward = forward(hand_z);
    let x = cos23 * tool_forward - sin23 * hand_z[2];
    let y = cos1 * hand_z[1] - sin1 * hand_z[0];
    let z = sin23 * tool_forward + cos23 * hand_z[2];
    let square = x.squared() + y.squared();
    let stretched = || singular(square, Singularity::Wrist(0.0));
    let off_line = square.root().ok_or_else(stretched)?;
    let bent = Along::arc(off_line, z).ok_or_else(stretched)?;
    let (roll_x, roll_y) = (along_forearm(hand_x), along_forearm(hand_y));
    // `side` is the sign of the controller's axis 5.
    let positive = match side {
        Wrist::Positive => arm.signs[4] > 0.0,
        Wrist::Negative => arm.signs[4] < 0.0,
    };
    let (q4, q5, q6) = if positive {
        (Along::arc(y, x), bent, Along::arc(roll_y, -roll_x))
    } else {
        (Along::arc(-y, -x), -bent, Along::arc(-roll_y, roll_x))
    };
    Ok((q4.ok_or_else(stretched)?, q5, q6.ok_or_else(stretched)?, bent))
}

#[inline(always)]
fn controller_angles(arm: &Opw, q: [Along; 6]) -> [Along; 6] {
    let mut angles: [Along; 6] = core::array::from_fn(|i| q[i].plus(arm.offsets[i]) * arm.signs[i]);
    if arm.coupling == Coupling::Parallelogram {
        angles[2] = angles[2] + angles[1];
    }
    angles
}

/// What it means that a radicand is not positive on a span: nowhere positive is out of reach.
fn singular(square: Along, singularity: Singularity) -> Violation {
    if square.value().high < 0.0 {
        Violation::OutOfReach
    } else {
        Violation::Singular(singularity)
    }
}

/// How far an angle keeps from 0 and from half a turn.
#[inline(always)]
fn from_line(angle: Along) -> f64 {
    let value = angle.value();
    let (low, high) = if value.low >= 0.0 {
        (value.low, value.high)
    } else {
        (-value.high, -value.low)
    };
    low.min(PI - high).max(0.0)
}

#[inline(always)]
fn least_magnitude(quantity: Along) -> f64 {
    let value = quantity.value();
    value.low.max(-value.high).max(0.0)
}
