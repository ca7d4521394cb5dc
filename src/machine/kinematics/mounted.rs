//! An ortho-parallel arm with another base or another flange than [`Opw`] has.
//!
//! A description by others, such as a URDF, may put the root beside axis 1, hang the arm from a wall, or turn the flange's
//! axes. Two constant poses take that into account; the closed form between them is the same.

use super::opw::Opw;
use super::pose::Pose;
use super::{Joints, Solutions};
use vcutc_backend_api::motion::Branch;

/// An ortho-parallel arm between two constant poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mounted {
    /// The arm's own foot, from which its lengths count, in the root.
    pub foot_in_root: Pose,
    pub arm: Opw,
    /// The flange seen from the arm's own.
    pub flange_in_hand: Pose,
}

impl Mounted {
    /// The flange in the root.
    #[must_use]
    pub fn forward(&self, joints: &Joints) -> Pose {
        self.foot_in_root * self.arm.forward(joints) * self.flange_in_hand
    }

    /// All ways to bring the flange there.
    #[must_use]
    pub fn inverse(&self, flange_in_root: &Pose) -> Solutions {
        self.arm.inverse(&self.hand_in_foot(flange_in_root))
    }

    /// The way on a branch, each angle within half a turn of `near`.
    #[must_use]
    pub fn on_branch(&self, flange_in_root: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        self.arm
            .on_branch(&self.hand_in_foot(flange_in_root), branch, near)
    }

    /// Where the closed form's flange has to be.
    #[must_use]
    pub fn hand_in_foot(&self, flange_in_root: &Pose) -> Pose {
        self.foot_in_root.inverse() * *flange_in_root * self.flange_in_hand.inverse()
    }
}
