//! How axes move the hand of a machine: forward and inverse kinematics.
//!
//! A mechanism maps axis values, as the machine's controller counts them, to the pose of its **flange in its root**: for a
//! robot the flange in the frame of its foot, for a five-axis machine the spindle nose in the frame in which work is
//! mounted. Lengths are in mm, angles in rad.

pub mod opw;
pub mod pose;

use opw::Opw;
use pose::Pose;
use vcutc_backend_api::ir::{MOST_AXES, MachineKind};
use vcutc_backend_api::motion::Branch;

/// Positions of the axes in order, as the controller counts them: rad for rotary, mm for linear axes.
pub type Joints = [f64; MOST_AXES];

/// How a machine's axes carry its flange.
#[derive(Clone, Debug, PartialEq)]
pub enum Mechanism {
    /// An arm with an ortho-parallel basis and a spherical wrist.
    OrthoParallel(Opw),
}

/// One way to reach a pose. Angles of rotary axes are within half a turn either way; other turns of the same axis are for
/// the caller to add.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// The branch.
    pub branch: Branch,
    /// The axes.
    pub joints: Joints,
}

/// Most branches that a mechanism has.
pub const MOST_BRANCHES: usize = 16;

/// All ways to reach a pose, in the order of their branches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solutions {
    found: [Option<Solution>; MOST_BRANCHES],
}

impl Solutions {
    /// No way.
    pub const NONE: Self = Self {
        found: [None; MOST_BRANCHES],
    };

    /// Adds a way; one beyond the last place is dropped.
    pub fn push(&mut self, solution: Solution) {
        if let Some(place) = self.found.iter_mut().find(|place| place.is_none()) {
            *place = Some(solution);
        }
    }

    /// The ways.
    pub fn iter(&self) -> impl Iterator<Item = &Solution> {
        self.found.iter().flatten()
    }
}

impl Mechanism {
    /// What kind of machine it carries.
    #[must_use]
    pub const fn kind(&self) -> MachineKind {
        match self {
            Self::OrthoParallel(_) => MachineKind::Robot,
        }
    }

    /// The flange in the root at these axis values.
    #[must_use]
    pub fn flange_in_root(&self, joints: &Joints) -> Pose {
        match self {
            Self::OrthoParallel(arm) => arm.forward(joints),
        }
    }

    /// All ways to bring the flange there, each checked by forward kinematics.
    #[must_use]
    pub fn all(&self, flange_in_root: &Pose) -> Solutions {
        match self {
            Self::OrthoParallel(arm) => arm.inverse(flange_in_root),
        }
    }

    /// The way on a branch, checked by forward kinematics. Angles of rotary axes are within half a turn of those of `near`.
    #[must_use]
    pub fn on_branch(&self, flange_in_root: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        match self {
            Self::OrthoParallel(arm) => arm.on_branch(flange_in_root, branch, near),
        }
    }
}
