//! The closed form run side by side: the branches of one pose, or the axes of one branch, as lanes of a vector.
//!
//! The loops over eight lanes are plain; what they call is free of branches, so the compiler turns them into vector
//! instructions, for the instruction set that the processor is found to have when the program runs (AVX-512, AVX2, or what
//! every processor of the platform has). Which one it is does not show in the answers: nothing is reordered or fused.

use super::Joints;
use super::closed_form::{Aim, Arm, Inclinations, Rest, Sides, each, is_same};
use super::pose::Pose;
use super::trig::{Turn, nearest, turn_of_any};
use pulp::{Arch, NullaryFnOnce};

/// How many are computed together.
pub(super) const LANES: usize = 8;

/// One number of each lane, in cache lines of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Lane(pub(super) [f64; LANES]);

impl Lane {
    pub(super) const ZERO: Self = Self([0.0; LANES]);
}

/// Joints of each lane, and whether they are an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointLanes {
    joints: [Lane; 6],
    reaches: [bool; LANES],
}

impl JointLanes {
    pub(super) const NONE: Self = Self {
        joints: [Lane::ZERO; 6],
        reaches: [false; LANES],
    };

    /// The joints of a lane, if they are an answer.
    #[inline]
    pub(super) fn get(&self, lane: usize) -> Option<Joints> {
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
    pub(super) fn set(&mut self, lane: usize, joints: &Joints, reaches: bool) {
        for (lanes, joint) in self.joints.iter_mut().zip(joints) {
            lanes.0[lane] = *joint;
        }
        self.reaches[lane] = reaches;
    }
}

/// All branches of one pose: the branches are the lanes, in the order of [`super::opw::BRANCHES`].
pub(super) struct AllBranches<'a> {
    pub(super) arm: &'a Arm,
    pub(super) flange_in_root: &'a Pose,
}

impl AllBranches<'_> {
    pub(super) fn solve(self) -> JointLanes {
        Arch::new().dispatch(self)
    }
}

impl NullaryFnOnce for AllBranches<'_> {
    type Output = JointLanes;

    #[inline(always)]
    fn call(self) -> JointLanes {
        let Self { arm, flange_in_root } = self;
        let mut found = JointLanes::NONE;
        for lane in 0..LANES {
            let side = |bit: usize| if lane & bit == 0 { 1.0 } else { -1.0 };
            let sides = Sides {
                shoulder: side(4),
                elbow: side(2),
                wrist: side(1),
            };
            let aim = arm.aim(flange_in_root, sides, Rest::ZERO);
            let joints = arm.joints(each(aim.turns, Turn::angle), aim.is_hand_free, sides.wrist);
            found.set(lane, &joints, arm.reaches(&joints, flange_in_root));
        }
        found
    }
}

/// One branch of one pose: the axes are the lanes.
pub(super) struct OneBranch<'a> {
    pub(super) arm: &'a Arm,
    pub(super) flange_in_root: &'a Pose,
    pub(super) sides: Sides,
    pub(super) near: &'a Joints,
}

impl OneBranch<'_> {
    pub(super) fn solve(self) -> Option<Joints> {
        Arch::new().dispatch(self)
    }
}

impl NullaryFnOnce for OneBranch<'_> {
    type Output = Option<Joints>;

    #[inline(always)]
    fn call(self) -> Option<Joints> {
        let Self {
            arm,
            flange_in_root,
            sides,
            near,
        } = self;
        let mut aim = arm.aim(flange_in_root, sides, Rest::ZERO);
        if aim.is_base_free | aim.is_hand_free {
            aim = arm.aim(flange_in_root, sides, rest_at(arm, near));
        }
        let joints = arm.joints(angles(&aim), aim.is_hand_free, sides.wrist);
        let joints = core::array::from_fn(|axis| nearest(joints[axis], near[axis]));
        let inclinations = arm.inclinations(&joints);
        let is_there = is_same(&arm.flange(turns(&inclinations)), flange_in_root);
        (inclinations.are_exact() & is_there).then_some(joints)
    }
}

/// Free axes stay where they are. Never in line: singular poses are rare, and this must not slow the others down.
#[inline(never)]
fn rest_at(arm: &Arm, near: &Joints) -> Rest {
    let Inclinations([base, _, _, hand, _, _]) = arm.inclinations(near);
    Rest {
        base: turn_of_any(base),
        hand: turn_of_any(hand),
    }
}

/// Forward kinematics: the axes are the lanes.
pub(super) struct Forward<'a> {
    pub(super) arm: &'a Arm,
    pub(super) joints: &'a Joints,
}

impl Forward<'_> {
    pub(super) fn solve(self) -> Pose {
        Arch::new().dispatch(self)
    }
}

impl NullaryFnOnce for Forward<'_> {
    type Output = Pose;

    #[inline(always)]
    fn call(self) -> Pose {
        let inclinations = self.arm.inclinations(self.joints);
        if inclinations.are_exact() {
            self.arm.flange(turns(&inclinations))
        } else {
            self.arm.flange(each(inclinations.0, turn_of_any))
        }
    }
}

/// Model angles of an aim.
#[inline(always)]
fn angles(aim: &Aim) -> [f64; 6] {
    let (mut sin, mut cos, mut angle) = (Lane::ZERO, Lane::ZERO, Lane::ZERO);
    for (lane, turn) in aim.turns.iter().enumerate() {
        sin.0[lane] = turn.sin;
        cos.0[lane] = turn.cos;
    }
    for lane in 0..LANES {
        angle.0[lane] = super::trig::atan2(sin.0[lane], cos.0[lane]);
    }
    let [q1, q2, q3, q4, q5, q6, _, _] = angle.0;
    [q1, q2, q3, q4, q5, q6]
}

/// Sines and cosines of model angles.
#[inline(always)]
fn turns(inclinations: &Inclinations) -> [Turn; 6] {
    let (mut angle, mut sin, mut cos) = (Lane::ZERO, Lane::ZERO, Lane::ZERO);
    for (lane, inclination) in inclinations.0.iter().enumerate() {
        angle.0[lane] = *inclination;
    }
    for lane in 0..LANES {
        let turn = Turn::of(angle.0[lane]);
        sin.0[lane] = turn.sin;
        cos.0[lane] = turn.cos;
    }
    core::array::from_fn(|lane| Turn {
        sin: sin.0[lane],
        cos: cos.0[lane],
    })
}
