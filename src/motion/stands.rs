//! The branches of an arm that has only numbers for them, at all poses that a program teaches.
//!
//! The solutions that [`newton::search`] finds are numbered pose by pose, and the numbers of one pose mean nothing at another.
//! Here branch `n` means solution `n` at the **first** pose of the program and whatever it becomes when it is followed from
//! there, pose by pose, as the program goes. So lines that share a pose begin and end with the same axes, and join.
//!
//! Nothing is proven here: [`super::path`] proves every line, beginning with what stands here.

use super::axis_range::best_margin;
use super::path::{Course, joints_on};
use super::rig::Rig;
use rayon::prelude::*;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OrientationId, Program};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::state::TipPose;
use vcutc_cancellation::Wanted;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::kinematics::{Joints, Mechanism, Solution, Solutions, newton};

/// The axes on every branch at every taught pose to which the branch could be followed.
#[derive(Clone, Debug)]
pub(super) struct Stands {
    branches: Vec<(Branch, BTreeMap<Key, Joints>)>,
}

/// A taught pose, to the last digit.
type Key = ([u64; 3], OrientationId);

fn key(taught: TipPose) -> Key {
    // Adding zero makes the negative zero positive.
    let bits = [taught.tip.x, taught.tip.y, taught.tip.z].map(|part| (part + 0.0).to_bits());
    (bits, taught.orientation)
}

/// A branch that so many poses could not be followed to is followed no more: each such pose costs as much as a hundred others.
const MOST_MISSED: u32 = 8;
/// Most that the blade turns, or its tip goes round, in one step while it is followed along a course, in rad: [`newton::follow`] leads the flange
/// straight from step to step, which keeps the tip near its own straight line.
const LONGEST_TURN: f64 = 0.2;
/// More steps than the longest arc takes.
const MOST_STEPS: u32 = 32;
/// A branch that is farther than this from where a course begins, in mm, is not at its beginning.
const JOINED: f64 = 1e-3;

impl Stands {
    /// Follows the branches of a machine whose branches are solutions of one pose only; none for any other machine.
    pub(super) fn of(
        rig: &Rig<'_>,
        program: &Program,
        paths: &[Path],
        middle: &Joints,
        wanted: &Wanted,
    ) -> Option<Self> {
        let arm = match rig.mechanism {
            Mechanism::Serial(arm) => arm,
            // The numbers of a five-axis machine's branches mean the same at all poses.
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::FiveAxis(_) => return None,
        };
        let walk = Walk {
            rig,
            arm,
            program,
            paths,
            middle,
            wanted,
        };
        let branches = walk
            .beginnings()
            .par_iter()
            .map(|begin| (begin.branch, walk.followed(begin)))
            .collect();
        Some(Self { branches })
    }

    /// The axes on a branch at a taught pose, each within half a turn of the middle of its range.
    pub(super) fn on(&self, taught: TipPose, branch: Branch) -> Option<Joints> {
        let (_, stands) = self.branches.iter().find(|(other, _)| *other == branch)?;
        stands.get(&key(taught)).copied()
    }

    /// The axes on all branches that come to a taught pose.
    pub(super) fn at(&self, taught: TipPose) -> Solutions {
        let mut all = Solutions::NONE;
        for (branch, stands) in &self.branches {
            if let Some(&joints) = stands.get(&key(taught)) {
                all.push(Solution {
                    branch: *branch,
                    joints,
                });
            }
        }
        all
    }
}

/// A program that an arm is led through.
struct Walk<'w> {
    rig: &'w Rig<'w>,
    arm: &'w SerialArm,
    program: &'w Program,
    paths: &'w [Path],
    middle: &'w Joints,
    wanted: &'w Wanted,
}

impl Walk<'_> {
    /// The solutions at the first taught pose: those within the ranges of the axes. If there are none, all, so that the axis
    /// that leaves its range can be named.
    fn beginnings(&self) -> Vec<Solution> {
        let first = self.paths.iter().find_map(Path::target);
        let Some(pose) = first.and_then(|taught| self.program.frame(taught)) else {
            return Vec::new();
        };
        let found = newton::search(self.arm, &self.rig.flange_in_root(&Pose::from(pose)));
        let within = |solution: &&Solution| best_margin(self.rig.axes, &solution.joints) >= 0.0;
        let inside: Vec<Solution> = found.iter().filter(within).copied().collect();
        if inside.is_empty() {
            found.iter().copied().collect()
        } else {
            inside
        }
    }

    /// Where a branch stands at the poses of the program.
    fn followed(&self, begin: &Solution) -> BTreeMap<Key, Joints> {
        let mut stands: BTreeMap<Key, Joints> = BTreeMap::new();
        let mut at = begin.joints;
        let mut missed = 0;
        for path in self.paths {
            let Some(taught) = path.target() else { continue };
            if let Some(known) = stands.get(&key(taught)) {
                at = *known;
                continue;
            }
            match self
                .along(path, begin.branch, &at)
                .or_else(|| self.straight(taught, &at))
            {
                Some(joints) => {
                    at = newton::within_half_a_turn(&joints, self.middle);
                    stands.insert(key(taught), at);
                }
                None => missed += 1,
            }
            if missed >= MOST_MISSED || self.wanted.is_needless() {
                break;
            }
        }
        stands
    }

    /// Follows a course that turns the blade or goes round an arc. Any other is as straight for the flange as it is for the tip,
    /// and where the course does not begin at `at`, since the branch missed poses, there is nothing to follow.
    fn along(&self, path: &Path, branch: Branch, at: &Joints) -> Option<Joints> {
        let line = path.line().filter(|line| line.turns() || line.via.is_some())?;
        let course = Course::of(self.program, line)?;
        let (apart, _) = self.rig.blade_in_work(at).apart(&course.from);
        if apart > JOINED {
            return None;
        }
        let round = line.arc().map_or(0.0, |arc| arc.sweep().to_rad());
        let turn = line.turn.to_rad().max(round);
        let steps = (1..MOST_STEPS).find(|steps| turn <= LONGEST_TURN * f64::from(*steps))?;
        (1..=steps).try_fold(*at, |near, step| {
            let place = f64::from(step) / f64::from(steps);
            // Only five-axis machines are led between given ends; an arm is followed.
            joints_on(self.rig, &course, branch, [&near, &near], place, &near)
        })
    }

    fn straight(&self, taught: TipPose, at: &Joints) -> Option<Joints> {
        let pose = Pose::from(self.program.frame(taught)?);
        newton::follow(self.arm, &self.rig.flange_in_root(&pose), at)
    }
}
