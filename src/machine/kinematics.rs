//! How axes move the hand of a machine: forward and inverse kinematics.
//!
//! A mechanism maps axis values, as the machine's controller counts them, to the pose of its **flange in its root**: for a
//! robot the flange in the frame of its foot, for a five-axis machine the spindle nose in the frame in which work is
//! mounted. Lengths are in mm, angles in rad.

pub mod batch;
mod closed_form;
pub mod configuration;
mod dimensions;
mod extent;
pub mod five_axis;
pub mod jacobian;
pub mod joint_axis;
mod lanes;
pub mod linkage;
pub mod mounted;
pub mod newton;
pub mod opw;
pub mod pose;
pub mod recognise;
#[cfg(any(test, feature = "samples"))]
pub mod samples;
pub mod serial;
pub mod trig;

use five_axis::FiveAxis;
use glam::DVec3;
use jacobian::Jacobian;
use mounted::Mounted;
use opw::Opw;
use pose::Pose;
use serial::SerialArm;
use vcutc_backend_api::ir::{MOST_AXES, MachineKind};
use vcutc_backend_api::motion::Branch;

/// Positions of the axes in order, as the controller counts them: rad for rotary, mm for linear axes.
pub type Joints = [f64; MOST_AXES];

/// How a machine's axes carry its flange.
#[derive(Clone, Debug, PartialEq)]
pub enum Mechanism {
    /// An arm with an ortho-parallel basis and a spherical wrist.
    OrthoParallel(Opw),
    /// The same between a foot and a flange that others have chosen.
    Mounted(Mounted),
    /// Any other arm of six revolute joints.
    Serial(SerialArm),
    /// Three linear axes and two or three rotary ones.
    FiveAxis(FiveAxis),
}

/// One way to reach a pose. Angles of rotary axes are within half a turn either way; other turns of the same axis are for
/// the caller to add.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    pub branch: Branch,
    /// The axes.
    pub joints: Joints,
}

/// Most branches that a mechanism has.
pub const MOST_BRANCHES: usize = 16;

/// All ways to reach a pose, in the order of their branches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solutions {
    found: [Solution; MOST_BRANCHES],
    count: usize,
}

impl Solutions {
    /// No way.
    pub const NONE: Self = Self {
        found: [Solution {
            branch: Branch::Numbered(0),
            joints: [0.0; MOST_AXES],
        }; MOST_BRANCHES],
        count: 0,
    };

    /// Adds a way; one beyond the last place is dropped.
    pub fn push(&mut self, solution: Solution) {
        if let Some(place) = self.found.get_mut(self.count) {
            *place = solution;
            self.count += 1;
        }
    }

    /// The ways.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Solution> {
        self.found.iter().take(self.count)
    }
}

impl Mechanism {
    /// What kind of machine it carries.
    #[must_use]
    pub const fn kind(&self) -> MachineKind {
        match self {
            Self::OrthoParallel(_) | Self::Mounted(_) | Self::Serial(_) => MachineKind::Robot,
            Self::FiveAxis(_) => MachineKind::FiveAxis,
        }
    }

    /// The flange in the root at these axis values.
    #[must_use]
    pub fn flange_in_root(&self, joints: &Joints) -> Pose {
        match self {
            Self::OrthoParallel(arm) => arm.forward(joints),
            Self::Mounted(arm) => arm.forward(joints),
            Self::Serial(arm) => arm.forward(joints),
            Self::FiveAxis(machine) => machine.forward(joints),
        }
    }

    /// All ways to bring the flange there, each checked by forward kinematics. Of a general serial arm: those found (see
    /// [`newton::search`]).
    #[must_use]
    pub fn all(&self, flange_in_root: &Pose) -> Solutions {
        match self {
            Self::OrthoParallel(arm) => arm.inverse(flange_in_root),
            Self::Mounted(arm) => arm.inverse(flange_in_root),
            Self::Serial(arm) => newton::search(arm, flange_in_root),
            Self::FiveAxis(machine) => machine.inverse(flange_in_root),
        }
    }

    /// The way on a branch, checked by forward kinematics. Angles of rotary axes are within half a turn of those of `near`.
    ///
    /// A general serial arm is on the branch on which it is at `near`, and is led from there (see [`newton::follow`]).
    #[must_use]
    pub fn on_branch(&self, flange_in_root: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        match self {
            Self::OrthoParallel(arm) => arm.on_branch(flange_in_root, branch, near),
            Self::Mounted(arm) => arm.on_branch(flange_in_root, branch, near),
            Self::Serial(arm) => match branch {
                Branch::Numbered(_) => newton::follow(arm, flange_in_root, near),
                Branch::Arm { .. } => None,
            },
            Self::FiveAxis(machine) => machine.on_branch(flange_in_root, branch, near),
        }
    }

    /// What each of the controller's joints does to the flange and to a point fixed to it, `point_in_flange` in mm, such as
    /// the tip of the blade.
    #[must_use]
    pub fn jacobian(&self, joints: &Joints, point_in_flange: DVec3) -> Jacobian {
        match self {
            Self::OrthoParallel(arm) => SerialArm::from(arm).jacobian(joints, point_in_flange),
            Self::Mounted(arm) => SerialArm::from(arm).jacobian(joints, point_in_flange),
            Self::Serial(arm) => arm.jacobian(joints, point_in_flange),
            Self::FiveAxis(machine) => machine.jacobian(joints, point_in_flange),
        }
    }

    /// The closed-form arm in it, if there is one: for questions about its singular poses, in which its mounting plays no
    /// part.
    #[must_use]
    pub const fn ortho_parallel(&self) -> Option<&Opw> {
        match self {
            Self::OrthoParallel(arm) | Self::Mounted(Mounted { arm, .. }) => Some(arm),
            Self::Serial(_) | Self::FiveAxis(_) => None,
        }
    }
}
