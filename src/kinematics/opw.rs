//! Arms with an ortho-parallel basis and a spherical wrist (Brandstötter, Angerer, Hofbaur: An analytical solution of the
//! inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis and a spherical wrist, 2014).
//!
//! Axis 1 stands upright, axes 2 and 3 are square to it and parallel to one another, axes 4, 5 and 6 meet in the wrist
//! centre. With model angles `q` the flange is at
//!
//! `T = Tz(c1) Rz(q1) Tx(a1) Ty(b) Ry(q2) Tz(c2) Ry(q3) T(a2, 0, c3) Rz(q4) Ry(q5) Rz(q6) Tz(c4)`
//!
//! and at `q = 0` the arm is stretched upwards. The controller's angles `J` give `q_i = sign_i J_i - offset_i`; on arms with
//! a parallelogram J3 counts the inclination of the upper arm, and `J3 - J2` takes its place.

use super::pose::Pose;
use super::{Joints, Solution, Solutions};
use core::f64::consts::{PI, TAU};
use glam::{DMat3, DVec3};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

/// Lengths (mm), zero offsets (rad) and senses of an ortho-parallel arm with a spherical wrist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opw {
    /// From axis 1 to axis 2, forward.
    pub a1: f64,
    /// From axis 3 to the line of axis 4, forward when the forearm points up.
    pub a2: f64,
    /// From the arm's plane to axis 1, sideways.
    pub b: f64,
    /// Height of axis 2.
    pub c1: f64,
    /// Length of the upper arm, from axis 2 to axis 3.
    pub c2: f64,
    /// From axis 3 to the wrist centre, along axis 4.
    pub c3: f64,
    /// From the wrist centre to the flange.
    pub c4: f64,
    /// `offset_i`.
    pub offsets: Joints,
    /// `sign_i`, 1 or -1.
    pub signs: Joints,
    /// Whether J3 counts the elbow's angle or the upper arm's inclination.
    pub coupling: Coupling,
}

/// What J3 counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// The angle at the elbow.
    Serial,
    /// The inclination of the upper arm, which a rod keeps while only axis 2 moves: the elbow's angle is `J3 - J2`.
    Parallelogram,
}

/// How far the flange may be from where an answer should bring it, in mm and as Frobenius norm.
const RESIDUAL: (f64, f64) = (1e-6, 1e-9);

impl Opw {
    /// The flange in the root.
    #[must_use]
    pub fn forward(&self, joints: &Joints) -> Pose {
        let q = self.model_angles(joints);
        let upright = DMat3::from_rotation_z(q[0]);
        let upper = upright * DMat3::from_rotation_y(q[1]);
        let fore = upper * DMat3::from_rotation_y(q[2]);
        let hand =
            fore * DMat3::from_rotation_z(q[3]) * DMat3::from_rotation_y(q[4]) * DMat3::from_rotation_z(q[5]);
        let position = DVec3::new(0.0, 0.0, self.c1)
            + upright * DVec3::new(self.a1, self.b, 0.0)
            + upper * DVec3::new(0.0, 0.0, self.c2)
            + fore * DVec3::new(self.a2, 0.0, self.c3)
            + hand * DVec3::new(0.0, 0.0, self.c4);
        Pose {
            rotation: hand,
            position,
        }
    }

    /// All ways to bring the flange there.
    #[must_use]
    pub fn inverse(&self, flange_in_root: &Pose) -> Solutions {
        let mut solutions = Solutions::NONE;
        for shoulder in [Shoulder::Front, Shoulder::Back] {
            for elbow in [Elbow::Forward, Elbow::Backward] {
                for wrist in [Wrist::Positive, Wrist::Negative] {
                    if let Some(joints) = self.solve(flange_in_root, shoulder, elbow, wrist) {
                        let branch = Branch::Arm {
                            shoulder,
                            elbow,
                            wrist,
                        };
                        solutions.push(Solution { branch, joints });
                    }
                }
            }
        }
        solutions
    }

    /// The way on a branch, each angle within half a turn of `near`.
    #[must_use]
    pub fn on_branch(&self, flange_in_root: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        let Branch::Arm {
            shoulder,
            elbow,
            wrist,
        } = branch
        else {
            return None;
        };
        let mut joints = self.solve(flange_in_root, shoulder, elbow, wrist)?;
        for (joint, near) in joints.iter_mut().zip(near) {
            *joint += TAU * ((near - *joint) / TAU).round();
        }
        Some(joints)
    }

    fn solve(&self, flange_in_root: &Pose, shoulder: Shoulder, elbow: Elbow, wrist: Wrist) -> Option<Joints> {
        let rotation = flange_in_root.rotation;
        let centre = flange_in_root.position - rotation.z_axis * self.c4;
        // In the frame that turns with axis 1 the wrist centre lies at (x, b, z - c1).
        let square = centre.x * centre.x + centre.y * centre.y - self.b * self.b;
        let x = match shoulder {
            Shoulder::Front => within(square)?,
            Shoulder::Back => -within(square)?,
        };
        let q1 = libm::atan2(centre.y, centre.x) - libm::atan2(self.b, x);
        let (along, up) = (x - self.a1, centre.z - self.c1);
        let fore = libm::hypot(self.a2, self.c3);
        let cosine = (along * along + up * up - self.c2 * self.c2 - fore * fore) / (2.0 * self.c2 * fore);
        let sine = match elbow {
            Elbow::Forward => within(1.0 - cosine * cosine)?,
            Elbow::Backward => -within(1.0 - cosine * cosine)?,
        };
        let psi = libm::atan2(sine, cosine);
        let q2 = libm::atan2(along, up) - libm::atan2(fore * sine, self.c2 + fore * cosine);
        let q3 = psi - libm::atan2(self.a2, self.c3);
        let forearm = DMat3::from_rotation_z(q1) * DMat3::from_rotation_y(q2 + q3);
        let hand = forearm.transpose() * rotation;
        let bent = libm::hypot(hand.z_axis.x, hand.z_axis.y);
        // `wrist` is the sign of J5, the sense in which the controller counts.
        let side = match wrist {
            Wrist::Positive => self.signs[4],
            Wrist::Negative => -self.signs[4],
        };
        let q5 = libm::atan2(side * bent, hand.z_axis.z);
        let q4 = libm::atan2(side * hand.z_axis.y, side * hand.z_axis.x);
        let q6 = libm::atan2(side * hand.y_axis.z, -side * hand.x_axis.z);
        let joints = self.controller_angles([q1, q2, q3, q4, q5, q6]);
        let (apart, turned) = self.forward(&joints).apart(flange_in_root);
        (apart <= RESIDUAL.0 && turned <= RESIDUAL.1).then_some(joints)
    }

    fn model_angles(&self, joints: &Joints) -> Joints {
        let [j1, j2, j3, j4, j5, j6] = *joints;
        let elbow = match self.coupling {
            Coupling::Serial => j3,
            Coupling::Parallelogram => j3 - j2,
        };
        let j = [j1, j2, elbow, j4, j5, j6];
        core::array::from_fn(|i| self.signs[i] * j[i] - self.offsets[i])
    }

    /// Within half a turn either way.
    fn controller_angles(&self, q: Joints) -> Joints {
        let mut j: Joints = core::array::from_fn(|i| wrapped((q[i] + self.offsets[i]) * self.signs[i]));
        if self.coupling == Coupling::Parallelogram {
            j[2] = wrapped(j[2] + j[1]);
        }
        j
    }
}

/// The root of a number that may be a hair below zero by rounding.
fn within(square: f64) -> Option<f64> {
    (square >= 0.0).then(|| square.sqrt())
}

fn wrapped(angle: f64) -> f64 {
    let turns = (angle / TAU).round();
    let rest = angle - TAU * turns;
    if rest <= -PI { rest + TAU } else { rest }
}
