//! The survey: what a branch makes of a run.
//!
//! Every course of a run is proven on its own, so that they can be proven at the same time, and joined afterwards. A course
//! is begun with each axis within half a turn of the middle of its range; where a course ends a whole number of turns away
//! from where the next begins, all that follows is moved on by those turns. Axes that can make a full turn have their
//! limits left open meanwhile: which turn they are best on is decided when the sweep of the whole run is known, and it is
//! known exactly, for turns move it as a whole.

use super::demand::Demand;
use super::moves::numbered;
use super::path::{
    Breach, Clearance, Course, Proof, Refuted, Through, Violation, prove, prove_all, prove_through, refuted,
};
use super::rig::Rig;
use super::runs::Station;
use super::stands::Stands;
use core::f64::consts::TAU;
use rayon::prelude::*;
use vcutc_backend_api::ir::{Action, Axis, AxisKind, Joint, MOST_AXES, OpId, Program, ToolId};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::units::Length;
use vcutc_cancellation::{Needless, Wanted};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Solutions};

/// A program on a machine, ready to be surveyed.
pub(super) struct Survey<'s> {
    pub(super) program: &'s Program,
    pub(super) paths: &'s [Path],
    /// The blade at hand.
    pub(super) tool: ToolId,
    /// The machine as it is.
    pub(super) rig: Rig<'s>,
    /// The machine with the limits of axes that can make a full turn left open.
    pub(super) open: Rig<'s>,
    /// The middle of each axis' range.
    pub(super) middle: Joints,
    /// Where the branches stand, if they mean nothing but what they are followed from.
    pub(super) followed: Option<Stands>,
    pub(super) least: Clearance,
    /// Nothing is carried any more once the answer is needless.
    pub(super) wanted: &'s Wanted,
}

/// A run that a branch carries.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Carried {
    /// The axes at the end of each of its ops; the first op leads to its beginning.
    pub(super) ends: Vec<Joints>,
    /// What it asks of the machine, up to turns of its axes.
    pub(super) demand: Demand,
    /// How far the axes go, each measured by its range.
    pub(super) travel: f64,
}

/// A motion that a branch does not carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Failure {
    pub(super) op: OpId,
    pub(super) breach: Breach,
}

/// How much of a run is surveyed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Up to a motion that is not carried.
    FirstFailure,
    /// Up to a motion that is not carried for another reason than the rates of axes, or [`ENOUGH_TOO_FAST`] that are not for
    /// this one.
    OtherThanRates,
    Whole,
}

/// Courses that are proven at once, side by side: enough to keep all lanes in use, few enough for all processors to have some.
const AT_ONCE: usize = 48;

/// A course that cannot even be begun.
const NOWHERE: Breach = Breach {
    at: 0.0,
    what: Violation::OutOfReach,
};

/// How many motions that are too fast say that speeds are too high: to find more of them in a long program only takes time.
pub(super) const ENOUGH_TOO_FAST: usize = 2000;

impl Extent {
    /// Courses that are proven before they are joined: enough to keep processors busy, few enough to be held at once, and not
    /// many more than are needed to find a failure.
    const fn batch(self) -> usize {
        match self {
            Self::FirstFailure | Self::OtherThanRates => 512,
            Self::Whole => 4096,
        }
    }

    /// Whether these failures answer the question.
    fn is_settled_by(self, failures: &[Failure]) -> bool {
        let is_too_fast = |failure: &Failure| matches!(failure.breach.what, Violation::Rate { .. });
        match self {
            Self::FirstFailure => !failures.is_empty(),
            Self::OtherThanRates => {
                failures.len() >= ENOUGH_TOO_FAST || failures.iter().any(|failure| !is_too_fast(failure))
            }
            Self::Whole => false,
        }
    }
}

/// The axes with the limits of those that can make a full turn moved out by a turn either way, which no single motion uses up.
pub(super) fn opened(axes: &[Axis]) -> Vec<Axis> {
    axes.iter()
        .map(|axis| {
            let room = match axis.kind {
                AxisKind::Rotary if axis.max - axis.min >= TAU => TAU,
                AxisKind::Rotary | AxisKind::Linear => 0.0,
            };
            Axis {
                min: axis.min - room,
                max: axis.max + room,
                ..axis.clone()
            }
        })
        .collect()
}

/// The middle of each axis' range.
pub(super) fn middles(axes: &[Axis]) -> Joints {
    let mut middle = [0.0; MOST_AXES];
    for (middle, axis) in middle.iter_mut().zip(axes) {
        *middle = f64::midpoint(axis.min, axis.max);
    }
    middle
}

/// How far axes go, each measured by its range.
pub(super) fn travel(axes: &[Axis], from: &Joints, to: &Joints) -> f64 {
    let ways = axes.iter().zip(from.iter().zip(to)).map(|(axis, (from, to))| {
        let range = axis.max - axis.min;
        if range > 0.0 {
            (to - from).abs() / range
        } else {
            0.0
        }
    });
    ways.sum()
}

impl Survey<'_> {
    /// The axes on a branch at a taught pose, each within half a turn of the middle of its range.
    pub(super) fn stand(&self, taught: TipPose, branch: Branch) -> Option<Joints> {
        if let Some(followed) = &self.followed {
            return followed.on(taught, branch);
        }
        let blade_in_work = Pose::from(self.program.frame(taught)?);
        let flange_in_root = self.rig.flange_in_root(&blade_in_work);
        self.rig
            .mechanism
            .on_branch(&flange_in_root, branch, &self.middle)
    }

    /// All ways to stand at a taught pose.
    pub(super) fn stands(&self, taught: TipPose) -> Solutions {
        if let Some(followed) = &self.followed {
            return followed.at(taught);
        }
        match self.program.frame(taught) {
            Some(blade) => self
                .rig
                .mechanism
                .all(&self.rig.flange_in_root(&Pose::from(blade))),
            None => Solutions::NONE,
        }
    }

    /// Proves one course on a branch.
    pub(super) fn line(&self, line: &LinearSegment, branch: Branch) -> Result<Proof, Breach> {
        self.wanted.go_on().map_err(|Needless| NOWHERE)?;
        let (course, start) = self.begun(line, branch).ok_or(NOWHERE)?;
        prove(&self.open, &course, branch, &start, &self.least)
    }

    /// Proves the courses of paths on a branch; nothing for paths that are none.
    fn lines(&self, paths: &[(OpId, &Path)], branch: Branch) -> Vec<Option<Result<Proof, Breach>>> {
        let is_needless = self.wanted.is_needless();
        let begun: Vec<Option<(Course, Joints)>> = paths
            .iter()
            .map(|(_, path)| self.begun(path.line()?, branch).filter(|_| !is_needless))
            .collect();
        let courses: Vec<(Course, Joints)> = begun.iter().flatten().copied().collect();
        let mut proofs = prove_all(&self.open, &courses, branch, &self.least).into_iter();
        let each = paths.iter().zip(&begun).map(|((op, path), begun)| {
            path.line()?;
            let Some((course, _)) = begun else {
                return Some(Err(NOWHERE));
            };
            let proof = proofs.next().unwrap_or(Err(NOWHERE));
            Some(proof.and_then(|proof| self.through(*op, course, branch, proof)))
        });
        each.collect()
    }

    /// The proof of a course with what the axes do at its end, where it continues into another one without a stop.
    fn through(&self, op: OpId, before: &Course, branch: Branch, proof: Proof) -> Result<Proof, Breach> {
        let Some(after) = self.goes_on(op) else {
            return Ok(proof);
        };
        let through = Through {
            before,
            after: &after,
            blend: self.program.blend.to_mm(),
        };
        prove_through(&self.open, &through, branch, &proof, &self.least)
    }

    /// The course into which an op continues, where the controller may round what is between them.
    fn goes_on(&self, op: OpId) -> Option<Course> {
        let Action::Follow {
            joint: Joint::Through,
            ..
        } = self.program.op(op)?.action
        else {
            return None;
        };
        if self.program.blend <= Length::ZERO {
            return None;
        }
        let next = self.paths.get(op.0 as usize + 1)?.line()?;
        Course::of(self.program, next)
    }

    /// The course of a line, and the axes at its beginning.
    fn begun(&self, line: &LinearSegment, branch: Branch) -> Option<(Course, Joints)> {
        let start = self.stand(line.from, branch)?;
        Some((Course::of(self.program, line)?, start))
    }

    /// What a branch makes of a run that it carries: as [`Survey::run`], which says why it does not, but sooner where it does not.
    pub(super) fn carried(&self, station: &Station, branch: Branch) -> Option<Carried> {
        if self.is_refuted(station, branch, |_| true) {
            return None;
        }
        self.run(station, branch, Extent::FirstFailure).ok()
    }

    /// Whether samples show for some motion of a run that a branch does not carry it, for a reason that counts.
    pub(super) fn is_refuted(
        &self,
        station: &Station,
        branch: Branch,
        counts: impl Fn(Refuted) -> bool + Sync,
    ) -> bool {
        let paths = self.paths.get(station.ops.clone()).unwrap_or_default();
        let after_entry = paths.get(1..).unwrap_or_default();
        after_entry
            .par_iter()
            .with_min_len(AT_ONCE)
            .filter_map(Path::line)
            .any(|line| match self.begun(line, branch) {
                Some((course, start)) => refuted(&self.open, &course, branch, &start).is_some_and(&counts),
                None => counts(Refuted::Pose),
            })
    }

    /// What a branch makes of a run.
    pub(super) fn run(
        &self,
        station: &Station,
        branch: Branch,
        extent: Extent,
    ) -> Result<Carried, Vec<Failure>> {
        let entry = station.entry();
        let start = station.begins().and_then(|taught| self.stand(taught, branch));
        let mut failures = Vec::new();
        let mut chain = start.map(|start| Chain {
            at: start,
            axes: self.rig.axes,
            carried: Carried {
                ends: vec![start],
                demand: Demand::standing(entry, &start),
                travel: 0.0,
            },
        });
        if chain.is_none() {
            failures.push(Failure {
                op: entry,
                breach: Breach {
                    at: 1.0,
                    what: Violation::OutOfReach,
                },
            });
        }
        let paths = self.paths.get(station.ops.clone()).unwrap_or_default();
        let after_entry: Vec<(OpId, &Path)> = numbered(paths)
            .skip(1)
            .map(|(op, path)| (OpId(op.0.saturating_add(entry.0)), path))
            .collect();
        for batch in after_entry.chunks(extent.batch()) {
            if extent.is_settled_by(&failures) {
                break;
            }
            let proofs: Vec<Option<Result<Proof, Breach>>> = batch
                .par_chunks(AT_ONCE)
                .flat_map_iter(|paths| self.lines(paths, branch))
                .collect();
            for (&(op, _), proof) in batch.iter().zip(&proofs) {
                let breach = match (proof, &mut chain) {
                    (Some(Err(breach)), _) => Some(*breach),
                    (Some(Ok(proof)), Some(chain)) if failures.is_empty() => chain.append(op, proof).err(),
                    (None, Some(chain)) => {
                        chain.rest();
                        None
                    }
                    (Some(Ok(_)) | None, _) => None,
                };
                failures.extend(breach.map(|breach| Failure { op, breach }));
            }
        }
        match chain {
            Some(chain) if failures.is_empty() => Ok(chain.carried),
            Some(_) | None => Err(failures),
        }
    }
}

/// Courses joined so far.
struct Chain<'a> {
    at: Joints,
    axes: &'a [Axis],
    carried: Carried,
}

/// How far the axes may be from where the course before ended, in rad or mm: rounding.
const JOINT: f64 = 1e-6;

impl Chain<'_> {
    fn append(&mut self, op: OpId, proof: &Proof) -> Result<(), Breach> {
        let by = turns_between(self.axes, &proof.start, &self.at).ok_or(Breach {
            at: 0.0,
            what: Violation::OutOfReach,
        })?;
        let end = moved(&proof.end, &by);
        self.carried.travel += travel(self.axes, &self.at, &end);
        self.carried.demand = self.carried.demand.and(&Demand::of(op, proof).turned(&by));
        self.carried.ends.push(end);
        self.at = end;
        Ok(())
    }

    fn rest(&mut self) {
        self.carried.ends.push(self.at);
    }
}

/// The turns that lead from axis values to others that stand for the same pose; none if they do not.
pub(super) fn turns_between(axes: &[Axis], from: &Joints, to: &Joints) -> Option<Joints> {
    let mut by = [0.0; MOST_AXES];
    for (index, axis) in axes.iter().enumerate().take(MOST_AXES) {
        let apart = to[index] - from[index];
        by[index] = match axis.kind {
            AxisKind::Rotary => (apart / TAU).round() * TAU,
            AxisKind::Linear => 0.0,
        };
        if (apart - by[index]).abs() > JOINT {
            return None;
        }
    }
    Some(by)
}

/// Axis values moved on.
pub(super) fn moved(joints: &Joints, by: &Joints) -> Joints {
    core::array::from_fn(|axis| joints[axis] + by[axis])
}
