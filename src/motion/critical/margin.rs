//! How good a base is, by the poses that the program teaches.
//!
//! For every branch the axes' angles at all poses are put on the same turn (each within half a turn of the middle of those
//! before it) and the whole lot on the turn with the most room. The branch's margin is the smallest of what is left to the
//! limits and to singular poses; the base's margin is that of its best branch. Where no branch reaches all poses, the
//! branch that misses fewest stands for the base, so that a search can tell better from worse out there too.

use super::clearance::clearance;
use crate::axis_range::axis_margin;
use crate::demand::FULL;
use crate::path::Clearance;
use crate::rig::Rig;
use core::cmp::Ordering;
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, MOST_BRANCHES, Mechanism, Solution, Solutions, trig};

/// How good a base is. More is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// How many poses the best branch misses altogether.
    pub missed: u32,
    /// Its smallest margin at the others: 1 with every axis in the middle of its range and far from singular poses, 0 at a
    /// limit or in a singular pose, negative beyond a limit.
    pub margin: f64,
}

impl Score {
    /// Of a base from which nothing is reached.
    pub const WORST: Self = Self {
        missed: u32::MAX,
        margin: f64::NEG_INFINITY,
    };

    /// The margin where all poses are reached within the limits.
    #[must_use]
    pub fn reached(self) -> Option<f64> {
        (self.missed == 0 && self.margin >= 0.0).then_some(self.margin)
    }

    /// Orders scores: the better is the greater.
    #[must_use]
    pub fn better(&self, other: &Self) -> Ordering {
        other
            .missed
            .cmp(&self.missed)
            .then(self.margin.total_cmp(&other.margin))
    }
}

/// What a base is judged by.
#[derive(Clone, Debug)]
pub struct Judge<'m> {
    mechanism: &'m Mechanism,
    axes: &'m [Axis],
    flange_in_work: Vec<Pose>,
}

impl<'m> Judge<'m> {
    /// Judges by poses of the blade in the work.
    #[must_use]
    pub fn new(rig: &Rig<'m>, blade_in_work: impl IntoIterator<Item = Pose>) -> Self {
        let blade_in_work = blade_in_work.into_iter();
        let flange_in_work = blade_in_work.map(|blade_in_work| blade_in_work * rig.flange_in_blade);
        let mut judge = Self {
            mechanism: rig.mechanism,
            axes: rig.axes,
            flange_in_work: flange_in_work.collect(),
        };
        if judge.effort() == Effort::Sparing {
            let step = judge.flange_in_work.len().div_ceil(FEW_POSES).max(1);
            judge.flange_in_work = judge.flange_in_work.into_iter().step_by(step).collect();
        }
        judge
    }

    /// How good a base is.
    #[must_use]
    pub fn score(&self, work_in_root: &Pose) -> Score {
        self.best(work_in_root).map_or(Score::WORST, |(score, _)| score)
    }

    /// How good a base is, and on which branch; none from which nothing is reached.
    #[must_use]
    pub fn best(&self, work_in_root: &Pose) -> Option<(Score, Branch)> {
        let mut tallies: [Option<Tally>; MOST_BRANCHES] = [None; MOST_BRANCHES];
        for flange_in_work in &self.flange_in_work {
            let flange_in_root = *work_in_root * *flange_in_work;
            for &Solution { branch, joints } in self.ways(&flange_in_root).iter() {
                let place = tallies
                    .iter_mut()
                    .find(|tally| tally.is_none_or(|tally| tally.branch == branch));
                if let Some(place) = place {
                    let singular = singular_share(&clearance(self.mechanism, &joints));
                    match place {
                        Some(tally) => tally.add(self.axes, &joints, singular),
                        None => *place = Some(Tally::new(branch, &joints, singular)),
                    }
                }
            }
        }
        let asked = u32::try_from(self.flange_in_work.len()).unwrap_or(u32::MAX);
        tallies
            .iter()
            .flatten()
            .map(|tally| (tally.score(self.axes, asked), tally.branch))
            .max_by(|(one, _), (other, _)| one.better(other))
    }
}

impl Judge<'_> {
    /// How much a search may ask of this judge.
    #[must_use]
    pub const fn effort(&self) -> Effort {
        match self.mechanism {
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::FiveAxis(_) => Effort::Full,
            Mechanism::Serial(_) => Effort::Sparing,
        }
    }

    /// The ways to reach a pose. The solutions of a general arm have no branches that could be compared from pose to pose,
    /// so that its best one stands for all.
    fn ways(&self, flange_in_root: &Pose) -> Solutions {
        let all = self.mechanism.all(flange_in_root);
        match self.effort() {
            Effort::Full => all,
            Effort::Sparing => {
                let alone = |way: &Solution| Tally::new(way.branch, &way.joints, 1.0).score(self.axes, 1);
                let mut best = Solutions::NONE;
                if let Some(way) = all.iter().max_by(|a, b| alone(a).better(&alone(b))) {
                    best.push(Solution {
                        branch: Branch::Numbered(0),
                        joints: way.joints,
                    });
                }
                best
            }
        }
    }
}

/// Most poses that are asked where each is searched for numerically.
const FEW_POSES: usize = 24;

/// How much a search may ask of a judge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// The closed form answers at once.
    Full,
    /// Every pose is searched for numerically.
    Sparing,
}

/// What is known of a branch so far.
#[derive(Clone, Copy, Debug)]
struct Tally {
    branch: Branch,
    reached: u32,
    low: Joints,
    high: Joints,
    singular: f64,
}

impl Tally {
    const fn new(branch: Branch, joints: &Joints, singular: f64) -> Self {
        Self {
            branch,
            reached: 1,
            low: *joints,
            high: *joints,
            singular,
        }
    }

    fn add(&mut self, axes: &[Axis], joints: &Joints, singular: f64) {
        self.reached += 1;
        self.singular = self.singular.min(singular);
        let sweeps = self.low.iter_mut().zip(&mut self.high).zip(joints);
        for (index, ((low, high), &value)) in sweeps.enumerate() {
            let turned = match axes.get(index).map(|axis| axis.kind) {
                Some(AxisKind::Rotary) => trig::nearest(value, f64::midpoint(*low, *high)),
                Some(AxisKind::Linear) | None => value,
            };
            *low = low.min(turned);
            *high = high.max(turned);
        }
    }

    fn score(&self, axes: &[Axis], asked: u32) -> Score {
        let limits = axes
            .iter()
            .zip(self.low.iter().zip(&self.high))
            .map(|(axis, (&low, &high))| best_turn(axis, low, high));
        Score {
            missed: asked.saturating_sub(self.reached),
            margin: limits.fold(self.singular, f64::min),
        }
    }
}

/// The margin of an axis that goes from `low` to `high`, on the turn where it is largest.
fn best_turn(axis: &Axis, low: f64, high: f64) -> f64 {
    let turn = match axis.kind {
        // On the turn whose middle is nearest to the middle of the range, most is left at the nearer end.
        AxisKind::Rotary => {
            let middle = (low + high) / 2.0;
            trig::nearest(middle, (axis.min + axis.max) / 2.0) - middle
        }
        AxisKind::Linear => 0.0,
    };
    axis_margin(axis, low + turn, high + turn)
}

/// The smallest distance from a singular pose, as a share of [`FULL`].
#[must_use]
pub fn singular_share(clearance: &Clearance) -> f64 {
    (clearance.wrist / FULL.wrist)
        .min(clearance.elbow / FULL.elbow)
        .min(clearance.shoulder / FULL.shoulder)
        .min(1.0)
}
