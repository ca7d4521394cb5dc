//! The motions of a program that show whether the axes are fast enough.
//!
//! A margin says nothing of rates, and a place with a large margin may ask more of an axis than it can give: near singular
//! poses, or where the work lies close to axis 1. Before a place is believed in, a few motions of every kind are therefore
//! proven there: those between the same two ways to hold the blade, at the same speed, with their ends farthest out.

use super::poses::outermost;
use crate::ceiling;
use crate::moves::path_of;
use crate::path::{Course, Refuted, prove, refuted};
use crate::rig::Rig;
use crate::solve::LEAST_CLEARANCE;
use crate::survey::middles;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{FeedId, OpId, OrientationId, Program, RateId};
use vcutc_backend_api::segments::{LimitedBy, LinearSegment, Path, Segment};
use vcutc_machine::kinematics::{Joints, Mechanism, Solution, newton};

/// Critical motions of a program: of every kind those that lie farthest out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CriticalMotions {
    courses: Vec<Course>,
}

/// By how much an axis may be faster at its fastest than on average between two samples, as a factor.
const BETWEEN_SAMPLES: f64 = 1.02;

/// Most motions that are proven at a place.
const MOST: usize = 96;
/// Motions are of one kind if they lead from the same posture to the same posture at the same speed: that of the blade's turn, or
/// of the tip.
type Kind = (OrientationId, OrientationId, Option<RateId>, Option<FeedId>);

/// The kind of a straight motion that takes time.
fn kind(segment: &Segment<'_>, line: &LinearSegment) -> Option<Kind> {
    let (from, to) = (line.from.orientation, line.to.orientation);
    let action = &segment.op.action;
    Some(match line.limited_by()? {
        LimitedBy::Feed(_) => (from, to, None, action.feed()),
        LimitedBy::Rate(_) => (from, to, action.rate(), None),
    })
}

/// The motions of a program that take time, kind by kind.
fn kinds(program: &Program) -> Vec<Vec<(OpId, LinearSegment)>> {
    let mut kinds: BTreeMap<Kind, Vec<(OpId, LinearSegment)>> = BTreeMap::new();
    for segment in program.segments() {
        if let Path::Linear(line) = segment.path()
            && let Some(kind) = kind(&segment, &line)
        {
            kinds.entry(kind).or_default().push((segment.id, line));
        }
    }
    kinds.into_values().collect()
}

/// Those of some motions whose ends lie farthest out.
fn farthest_out(motions: &[(OpId, LinearSegment)]) -> Vec<&(OpId, LinearSegment)> {
    let tips: Vec<DVec3> = motions
        .iter()
        .map(|(_, line)| DVec3::new(line.to.tip.x, line.to.tip.y, line.to.tip.z))
        .collect();
    let chosen = outermost(&tips).into_iter();
    chosen.filter_map(|index| motions.get(index)).collect()
}

/// A program with its turns as fast as the axes follow the critical motions, on the branch where they take the least time. None where
/// the axes follow all of them on no single branch, however slowly the blade turns.
#[must_use]
pub fn as_followed(rig: &Rig<'_>, program: &Program) -> Option<Program> {
    let kinds = kinds(program);
    let first = kinds.first().and_then(|motions| motions.first());
    let Some(course) = first.and_then(|(_, line)| Course::of(program, line)) else {
        return Some(program.clone());
    };
    let branches = rig.mechanism.all(&rig.flange_in_root(&course.from));
    let paced = branches.iter().filter_map(|begin| {
        let shares: Option<Vec<f64>> = kinds
            .iter()
            .map(|motions| highest_share(rig, program, motions, begin))
            .collect();
        let shares = shares?;
        let longer = kinds
            .iter()
            .zip(&shares)
            .map(|(motions, &share)| longer(motions, share));
        Some((longer.sum::<f64>(), shares))
    });
    let (_, shares) = paced.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
    let mut slower = program.clone();
    for (motions, share) in kinds.iter().zip(shares) {
        for &(op, line) in motions {
            if share < 1.0 {
                ceiling::set(&mut slower, op, ceiling::at(&line, share)?)?;
            }
        }
    }
    Some(slower)
}

/// The highest share of its rate at which the axes follow the critical motions of a kind on the branch of a solution.
fn highest_share(
    rig: &Rig<'_>,
    program: &Program,
    motions: &[(OpId, LinearSegment)],
    begin: &Solution,
) -> Option<f64> {
    let mut highest = 1.0;
    for (_, line) in farthest_out(motions) {
        let course = Course::of(program, line)?;
        let start = start_of(rig, &course, begin)?;
        // What samples show is enough here, and found far sooner.
        let refuted = refuted(rig, &course, begin.branch, &start);
        let slow_enough = |line: &LinearSegment| match (rig.mechanism, refuted) {
            (_, Some(Refuted::Pose)) => false,
            (_, Some(Refuted::TooFast(times))) => {
                line.duration().to_s() >= course.duration * times * BETWEEN_SAMPLES
            }
            (Mechanism::OrthoParallel(_) | Mechanism::Mounted(_), None) => true,
            (Mechanism::Serial(_) | Mechanism::FiveAxis(_), None) => {
                Course::of(program, line).is_some_and(|course| follows(rig, &course, begin))
            }
        };
        highest = ceiling::highest(line, highest, slow_enough)?;
    }
    Some(highest)
}

/// How much longer motions take at a share of their rates, in s.
fn longer(motions: &[(OpId, LinearSegment)], share: f64) -> f64 {
    let each = motions
        .iter()
        .map(|(_, line)| ceiling::lengthened(line, share).to_s());
    each.sum()
}

impl CriticalMotions {
    /// The critical motions of a program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let kinds = kinds(program);
        let critical = kinds.iter().flat_map(|motions| farthest_out(motions));
        let courses: Vec<Course> = critical
            .filter_map(|(_, line)| Course::of(program, line))
            .collect();
        let step = courses.len().div_ceil(MOST).max(1);
        Self {
            courses: courses.into_iter().step_by(step).collect(),
        }
    }

    /// The motion of one op alone, if it has one along a course.
    #[must_use]
    pub fn only(program: &Program, op: OpId) -> Self {
        let course = path_of(program, op).and_then(|path| Course::of(program, path.line()?));
        Self {
            courses: course.into_iter().collect(),
        }
    }

    /// Whether each of them is followed on some branch, which no program can do without.
    #[must_use]
    pub fn are_each_followed(&self, rig: &Rig<'_>) -> bool {
        self.courses.iter().all(|course| {
            let begin = rig.mechanism.all(&rig.flange_in_root(&course.from));
            begin.iter().any(|solution| follows(rig, course, solution))
        })
    }

    /// Whether there is one branch on which the axes follow all of them.
    #[must_use]
    pub fn are_followed(&self, rig: &Rig<'_>) -> bool {
        let Some(first) = self.courses.first() else {
            return true;
        };
        let begin = rig.mechanism.all(&rig.flange_in_root(&first.from));
        begin
            .iter()
            .any(|solution| self.courses.iter().all(|course| follows(rig, course, solution)))
    }
}

/// Whether the axes follow a course on the branch of a solution, begun with each of them nearest to the middle of its range.
fn follows(rig: &Rig<'_>, course: &Course, solution: &Solution) -> bool {
    start_of(rig, course, solution)
        .is_some_and(|start| prove(rig, course, solution.branch, &start, &LEAST_CLEARANCE).is_ok())
}

/// The axes at the start of a course on the branch of a solution, each of them nearest to the middle of its range.
fn start_of(rig: &Rig<'_>, course: &Course, solution: &Solution) -> Option<Joints> {
    let flange_in_root = rig.flange_in_root(&course.from);
    let middles = middles(rig.axes);
    let near = match rig.mechanism {
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::FiveAxis(_) => middles,
        // Its branches are those of the axes that it is followed from.
        Mechanism::Serial(_) => newton::within_half_a_turn(&solution.joints, &middles),
    };
    rig.mechanism.on_branch(&flange_in_root, solution.branch, &near)
}
