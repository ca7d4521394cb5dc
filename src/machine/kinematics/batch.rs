//! Inverse kinematics of many poses at once: the poses are the lanes.
//!
//! Poses and answers are stored in blocks of eight, each number of the eight side by side, so that the loops over lanes
//! become vector instructions (see [`super::lanes`]). What solutions have in common is found once: two shoulders, four
//! triangles, four hands, of which each serves two sides of the wrist. Every answer is checked by forward kinematics of the
//! finished joints, and has the very bits that [`Opw::inverse`] returns.
//!
//! Buffers belong to the caller and are used again; a call allocates only where there are more poses than ever before. A
//! search is fastest with batches whose answers, 448 bytes for a pose, fit the processor's cache: some hundred poses.

use super::closed_form::{Arm, Base, Rest, Sides, each, hand, is_exact, is_same};
use super::lanes::{JointLanes, LANES, Lane};
use super::opw::{BRANCHES, Opw, sides};
use super::pose::Pose;
use super::trig::Turn;
use super::{Joints, Solution};
use glam::{DMat3, DVec3};
use pulp::{Arch, NullaryFnOnce};
use vcutc_backend_api::motion::Branch;

/// Poses of the flange in the root, to be solved together.
#[derive(Clone, Debug, Default)]
pub struct Poses {
    blocks: Vec<PoseBlock>,
    count: usize,
}

/// Eight poses: the columns of their rotations, then their positions.
type PoseBlock = Numbers<12>;

/// So many numbers of each lane.
#[derive(Clone, Copy, Debug)]
struct Numbers<const N: usize>([Lane; N]);

impl<const N: usize> Numbers<N> {
    const ZERO: Self = Self([Lane::ZERO; N]);

    #[inline(always)]
    fn set(&mut self, lane: usize, numbers: [f64; N]) {
        for (lanes, number) in self.0.iter_mut().zip(numbers) {
            lanes.0[lane] = number;
        }
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> [f64; N] {
        core::array::from_fn(|number| self.0[number].0[lane])
    }
}

impl PoseBlock {
    #[inline(always)]
    fn pose(&self, lane: usize) -> Pose {
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz, x, y, z] = self.get(lane);
        Pose {
            rotation: DMat3::from_cols(
                DVec3::new(xx, xy, xz),
                DVec3::new(yx, yy, yz),
                DVec3::new(zx, zy, zz),
            ),
            position: DVec3::new(x, y, z),
        }
    }
}

impl Poses {
    /// Forgets all poses and keeps their memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.count = 0;
    }

    /// Adds a pose.
    pub fn push(&mut self, flange_in_root: &Pose) {
        let lane = self.count % LANES;
        if lane == 0 {
            self.blocks.push(Numbers::ZERO);
        }
        if let Some(block) = self.blocks.last_mut() {
            let Pose { rotation, position } = flange_in_root;
            let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = rotation.to_cols_array();
            let [x, y, z] = position.to_array();
            block.set(lane, [xx, xy, xz, yx, yy, yz, zx, zy, zz, x, y, z]);
            self.count += 1;
        }
    }

    #[must_use]
    pub const fn len(&self) -> usize {
        self.count
    }

    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// All ways to reach each of a batch of poses.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    /// By branch, in the order of [`BRANCHES`].
    blocks: Vec<[JointLanes; BRANCHES.len()]>,
}

impl Answers {
    /// The joints that reach a pose on a branch, by their numbers: of the pose in its batch, of the branch in [`BRANCHES`].
    #[must_use]
    pub fn joints(&self, pose: usize, branch: usize) -> Option<Joints> {
        self.blocks.get(pose / LANES)?.get(branch)?.get(pose % LANES)
    }

    /// All ways to reach a pose, in the order of [`BRANCHES`].
    pub fn of(&self, pose: usize) -> impl Iterator<Item = Solution> {
        BRANCHES
            .into_iter()
            .enumerate()
            .filter_map(move |(number, branch)| {
                let joints = self.joints(pose, number)?;
                Some(Solution { branch, joints })
            })
    }
}

/// The way to reach each of a batch of poses on one branch.
#[derive(Clone, Debug, Default)]
pub struct BranchAnswers {
    blocks: Vec<JointLanes>,
}

impl BranchAnswers {
    /// The joints that reach a pose, by its number in its batch.
    #[must_use]
    pub fn joints(&self, pose: usize) -> Option<Joints> {
        self.blocks.get(pose / LANES)?.get(pose % LANES)
    }
}

impl Opw {
    /// All ways to reach each pose: for each what [`Opw::inverse`] finds.
    pub fn inverse_many(&self, poses: &Poses, answers: &mut Answers) {
        answers
            .blocks
            .resize(poses.blocks.len(), [JointLanes::NONE; BRANCHES.len()]);
        Arch::new().dispatch(AllBranches {
            arm: &Arm::new(self),
            poses: &poses.blocks,
            answers: &mut answers.blocks,
        });
    }

    /// The way to reach each pose on a branch, joints within half a turn either way: the answers that [`Opw::inverse_many`]
    /// finds on that branch, none if the arm has no such branch.
    pub fn on_branch_many(&self, poses: &Poses, branch: Branch, answers: &mut BranchAnswers) {
        answers.blocks.clear();
        let Some(sides) = sides(branch) else { return };
        answers.blocks.resize(poses.blocks.len(), JointLanes::NONE);
        Arch::new().dispatch(OneBranch {
            arm: &Arm::new(self),
            poses: &poses.blocks,
            sides,
            answers: &mut answers.blocks,
        });
    }
}

struct OneBranch<'a> {
    arm: &'a Arm,
    poses: &'a [PoseBlock],
    sides: Sides,
    answers: &'a mut [JointLanes],
}

impl NullaryFnOnce for OneBranch<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (arm, sides) = (*self.arm, self.sides);
        for (poses, answers) in self.poses.iter().zip(self.answers) {
            // Working on copies, the compiler sees that lanes do not write what others read.
            let (poses, mut found) = (*poses, JointLanes::NONE);
            for lane in 0..LANES {
                let pose = poses.pose(lane);
                let aim = arm.aim(&pose, sides, Rest::ZERO);
                let joints = arm.joints(each(aim.turns, Turn::angle), aim.is_hand_free, sides.wrist);
                found.set(lane, &joints, arm.reaches(&joints, &pose));
            }
            *answers = found;
        }
    }
}

struct AllBranches<'a> {
    arm: &'a Arm,
    poses: &'a [PoseBlock],
    answers: &'a mut [[JointLanes; BRANCHES.len()]],
}

impl NullaryFnOnce for AllBranches<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let arm = *self.arm;
        for (poses, answers) in self.poses.iter().zip(self.answers) {
            // Working on copies, the compiler sees that lanes do not write what others read.
            let poses = *poses;
            let mut answers = answers.iter_mut();
            for side in [1.0, -1.0] {
                let shoulders = Shoulders::of(&arm, &poses, side);
                for side in [1.0, -1.0] {
                    let triangles = Triangles::of(&arm, &shoulders, side);
                    let hands = Hands::of(&shoulders, &triangles, &poses);
                    for (side, answers) in [1.0, -1.0].into_iter().zip(answers.by_ref()) {
                        *answers = finished(&arm, &poses, (&shoulders, &triangles, &hands), side);
                    }
                }
            }
        }
    }
}

/// Axis 1 of eight poses.
struct Shoulders {
    /// Sine and cosine of its model angle, and the wrist centre, along and up, seen from axis 2.
    aim: Numbers<4>,
    joint: Lane,
    /// Sine and cosine of the finished joint's model angle.
    turn: Numbers<2>,
    is_exact: [bool; LANES],
}

impl Shoulders {
    #[inline(always)]
    fn of(arm: &Arm, poses: &PoseBlock, side: f64) -> Self {
        let mut found = Self {
            aim: Numbers::ZERO,
            joint: Lane::ZERO,
            turn: Numbers::ZERO,
            is_exact: [false; LANES],
        };
        for lane in 0..LANES {
            let base = arm.base(&poses.pose(lane), side, Rest::ZERO.base);
            found
                .aim
                .set(lane, [base.turn.sin, base.turn.cos, base.along, base.up]);
            let joint = arm.base_joint(base.turn.angle());
            found.joint.0[lane] = joint;
            let inclination = arm.base_inclination(joint);
            let turn = Turn::of(inclination);
            found.turn.set(lane, [turn.sin, turn.cos]);
            found.is_exact[lane] = is_exact(inclination);
        }
        found
    }

    #[inline(always)]
    fn base(&self, lane: usize) -> Base {
        let [sin, cos, along, up] = self.aim.get(lane);
        Base {
            turn: Turn { sin, cos },
            along,
            up,
            is_free: false,
        }
    }
}

/// Axes 2 and 3 of eight poses.
struct Triangles {
    /// Sine and cosine of the forearm's inclination.
    aim: Numbers<2>,
    joints: Numbers<2>,
    /// Sines and cosines of upper arm's and forearm's inclination with the finished joints.
    turns: Numbers<4>,
    are_exact: [bool; LANES],
}

impl Triangles {
    #[inline(always)]
    fn of(arm: &Arm, shoulders: &Shoulders, side: f64) -> Self {
        let mut found = Self {
            aim: Numbers::ZERO,
            joints: Numbers::ZERO,
            turns: Numbers::ZERO,
            are_exact: [false; LANES],
        };
        for lane in 0..LANES {
            let triangle = arm.triangle(&shoulders.base(lane), side);
            found.aim.set(lane, [triangle.fore.sin, triangle.fore.cos]);
            let joints = arm.triangle_joints([triangle.upper.angle(), triangle.elbow.angle()]);
            found.joints.set(lane, joints);
            let [upper, fore] = arm.triangle_inclinations(joints);
            let (upper_turn, fore_turn) = (Turn::of(upper), Turn::of(fore));
            found.turns.set(
                lane,
                [upper_turn.sin, upper_turn.cos, fore_turn.sin, fore_turn.cos],
            );
            found.are_exact[lane] = is_exact(upper) & is_exact(fore);
        }
        found
    }
}

/// Axes 4, 5 and 6 of eight poses.
struct Hands {
    /// Model angles.
    angles: Numbers<3>,
    is_free: [bool; LANES],
}

impl Hands {
    #[inline(always)]
    fn of(shoulders: &Shoulders, triangles: &Triangles, poses: &PoseBlock) -> Self {
        let mut found = Self {
            angles: Numbers::ZERO,
            is_free: [false; LANES],
        };
        for lane in 0..LANES {
            let [sin, cos] = triangles.aim.get(lane);
            let hand = hand(
                &poses.pose(lane).rotation,
                shoulders.base(lane).turn,
                Turn { sin, cos },
                Rest::ZERO.hand,
            );
            let [q4, q5, q6] = hand.turns;
            found.angles.set(lane, [q4.angle(), q5.angle(), q6.angle()]);
            found.is_free[lane] = hand.is_free;
        }
        found
    }
}

/// The joints on one side of the wrist, checked.
#[inline(always)]
fn finished(
    arm: &Arm,
    poses: &PoseBlock,
    (shoulders, triangles, hands): (&Shoulders, &Triangles, &Hands),
    side: f64,
) -> JointLanes {
    let mut found = JointLanes::NONE;
    for lane in 0..LANES {
        let [j2, j3] = triangles.joints.get(lane);
        let [j4, j5, j6] = arm.hand_joints(hands.angles.get(lane), hands.is_free[lane], side);
        let [q4, q5, q6] = arm.hand_inclinations([j4, j5, j6]);
        let [sin, cos] = shoulders.turn.get(lane);
        let base = Turn { sin, cos };
        let [sin, cos, fore_sin, fore_cos] = triangles.turns.get(lane);
        let (upper, fore) = (
            Turn { sin, cos },
            Turn {
                sin: fore_sin,
                cos: fore_cos,
            },
        );
        let flange = arm.flange([base, upper, fore, Turn::of(q4), Turn::of(q5), Turn::of(q6)]);
        let is_exact =
            shoulders.is_exact[lane] & triangles.are_exact[lane] & is_exact(q4) & is_exact(q5) & is_exact(q6);
        found.set(
            lane,
            &[shoulders.joint.0[lane], j2, j3, j4, j5, j6],
            is_exact & is_same(&flange, &poses.pose(lane)),
        );
    }
    found
}
