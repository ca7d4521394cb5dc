//! Inverse kinematics of many poses at once.
//!
//! Poses and answers are stored in blocks of eight, each number of the eight side by side. The loops over the eight are
//! plain; what they call is free of branches, so the compiler turns them into vector instructions, for the instruction set
//! that the processor is found to have when the program runs (AVX-512, AVX2, or what every processor of the platform has).
//! Which one it is does not show in the answers: nothing is reordered or fused, so every lane has the bits that
//! [`super::opw::Opw::inverse`] and [`super::opw::Opw::on_branch`] return.
//!
//! Buffers belong to the caller and are used again.

use super::Joints;
use super::closed_form::{Answer, Arm, Rest, Sides};
use super::pose::Pose;
use pulp::Arch;

/// Poses or branches side by side.
pub const LANES: usize = 8;

/// One number of each lane, in cache lines of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
struct Lane([f64; LANES]);

impl Lane {
    const ZERO: Self = Self([0.0; LANES]);
}

/// Joints of each lane, and whether they are an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointLanes {
    joints: [Lane; 6],
    reaches: [bool; LANES],
}

impl JointLanes {
    const NONE: Self = Self {
        joints: [Lane::ZERO; 6],
        reaches: [false; LANES],
    };

    /// The joints of a lane, if they are an answer.
    #[inline]
    pub(super) fn joints(&self, lane: usize) -> Option<Joints> {
        if !*self.reaches.get(lane)? {
            return None;
        }
        let mut joints = [0.0; 6];
        for (joint, lanes) in joints.iter_mut().zip(&self.joints) {
            *joint = *lanes.0.get(lane)?;
        }
        Some(joints)
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, joints: &Joints, reaches: bool) {
        for (lanes, joint) in self.joints.iter_mut().zip(joints) {
            lanes.0[lane] = *joint;
        }
        self.reaches[lane] = reaches;
    }
}

/// All branches of one pose: the branches are the lanes, in the order of [`super::opw::BRANCHES`].
pub(super) fn all_branches(arm: &Arm, flange_in_root: &Pose) -> JointLanes {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            let mut found = JointLanes::NONE;
            for lane in 0..LANES {
                let side = |bit: usize| if lane & bit == 0 { 1.0 } else { -1.0 };
                let sides = Sides {
                    shoulder: side(4),
                    elbow: side(2),
                    wrist: side(1),
                };
                let Answer { joints, .. } = arm.solve(flange_in_root, sides, Rest::ZERO);
                found.set(lane, &joints, arm.reaches(&joints, flange_in_root));
            }
            found
        },
    )
}
