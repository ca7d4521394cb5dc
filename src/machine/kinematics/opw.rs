//! Arms with an ortho-parallel basis and a spherical wrist (Brandstötter, Angerer, Hofbaur: An analytical solution of the
//! inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis and a spherical wrist, 2014).
//!
//! Axis 1 is upright, axes 2 and 3 are square to it and parallel to one another, axes 4, 5 and 6 meet in the wrist
//! centre. With model angles `q` the flange is at
//!
//! `T = Tz(c1) Rz(q1) Tx(a1) Ty(b) Ry(q2) Tz(c2) Ry(q3) T(a2, 0, c3) Rz(q4) Ry(q5) Rz(q6) Tz(c4)`
//!
//! and at `q = 0` the arm is stretched upwards. The controller's angles `J` give `q_i = sign_i J_i - offset_i`; on arms with
//! a parallelogram J3 counts the inclination of the upper arm, and `J3 - J2` takes its place.
//!
//! # Branches
//!
//! A pose has up to eight solutions: the wrist centre in front of axis 1 or behind, the forearm folded forward or backward,
//! the hand bent to one side or the other. Every answer has been checked: forward kinematics of the joints as they are
//! returned gives the pose to 1e-6 mm and 1e-9 rad. (Away from where poses cease to be reachable it gives it to 1e-11 mm.)
//!
//! # Singular poses
//!
//! * **Arm stretched or folded:** both elbows are the same, and both are listed. Poses beyond reach by rounding, that is by
//!   up to 1e-6 mm, count as reached.
//! * **Hand stretched** (J5 at zero, axes 4 and 6 in line, to 1e-13 rad): both wrists are the same. J4 is free;
//!   [`Opw::inverse`] sets its model angle to zero, [`Opw::on_branch`] keeps that of the joints nearby. J6 does the rest.
//! * **Wrist centre on axis 1** (to 1e-12 mm, on arms without `b`): J1 is free, with the same choice. Shoulders in front and
//!   behind then differ by half a turn of the arm, which reach different elbows.
//!
//! Near to these poses answers are as precise as elsewhere: axis 6 is found from the axis 4 that was chosen, not from the
//! pose alone.

pub use super::dimensions::{Coupling, Opw};

use super::closed_form::{Arm, Sides};
use super::lanes::{AllBranches, Forward, OneBranch};
use super::pose::Pose;
use super::{Joints, Solution, Solutions};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};

impl Opw {
    /// The flange in the root. Finite joints give a finite pose.
    #[must_use]
    pub fn forward(&self, joints: &Joints) -> Pose {
        Forward {
            arm: &Arm::new(self),
            joints,
        }
        .solve()
    }

    /// All ways to bring the flange there, in the order of [`BRANCHES`].
    #[must_use]
    pub fn inverse(&self, flange_in_root: &Pose) -> Solutions {
        let lanes = AllBranches {
            arm: &Arm::new(self),
            flange_in_root,
        }
        .solve();
        let mut solutions = Solutions::NONE;
        for (lane, branch) in BRANCHES.into_iter().enumerate() {
            if let Some(joints) = lanes.get(lane) {
                solutions.push(Solution { branch, joints });
            }
        }
        solutions
    }

    /// The way on a branch, each joint within half a turn of `near`. In a singular pose the joint that the pose leaves free
    /// (J1 with the wrist centre on axis 1, J4 with a stretched hand) stays as in `near`.
    #[must_use]
    pub fn on_branch(&self, flange_in_root: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        OneBranch {
            arm: &Arm::new(self),
            flange_in_root,
            sides: sides(branch)?,
            near,
        }
        .solve()
    }
}

/// The branches of an ortho-parallel arm, in the order in which they are listed everywhere.
pub const BRANCHES: [Branch; 8] = {
    const fn branch(shoulder: Shoulder, elbow: Elbow, wrist: Wrist) -> Branch {
        Branch::Arm {
            shoulder,
            elbow,
            wrist,
        }
    }
    use Elbow::{Backward, Forward};
    use Shoulder::{Back, Front};
    use Wrist::{Negative, Positive};
    [
        branch(Front, Forward, Positive),
        branch(Front, Forward, Negative),
        branch(Front, Backward, Positive),
        branch(Front, Backward, Negative),
        branch(Back, Forward, Positive),
        branch(Back, Forward, Negative),
        branch(Back, Backward, Positive),
        branch(Back, Backward, Negative),
    ]
};

/// A branch in factors; none for a branch that such an arm does not have.
pub(super) const fn sides(branch: Branch) -> Option<Sides> {
    let (shoulder, elbow, wrist) = match branch {
        Branch::Arm {
            shoulder,
            elbow,
            wrist,
        } => (shoulder, elbow, wrist),
        Branch::Numbered(_) => return None,
    };
    Some(Sides {
        shoulder: match shoulder {
            Shoulder::Front => 1.0,
            Shoulder::Back => -1.0,
        },
        elbow: match elbow {
            Elbow::Forward => 1.0,
            Elbow::Backward => -1.0,
        },
        wrist: match wrist {
            Wrist::Positive => 1.0,
            Wrist::Negative => -1.0,
        },
    })
}

#[cfg(test)]
mod tests;
