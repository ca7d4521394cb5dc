//! The motions of a program that show whether the axes are fast enough.
//!
//! A margin says nothing of rates, and a place with a large margin may ask more of an axis than it can give: near singular
//! poses, or where the work lies close to axis 1. Before a place is believed in, a few motions of every kind are therefore
//! proven there: those between the same two ways to hold the blade, at the same speed, with their ends farthest out.

use super::poses::outermost;
use crate::moves::path_of;
use crate::path::{Course, prove};
use crate::rig::Rig;
use crate::solve::LEAST_CLEARANCE;
use crate::survey::middles;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{FeedId, OpId, OrientationId, Program, RateId};
use vcutc_backend_api::segments::{LimitedBy, LinearSegment, Path, Segment};
use vcutc_machine::kinematics::{Mechanism, Solution, newton};

/// Critical motions of a program: of every kind those that lie farthest out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CriticalMotions {
    courses: Vec<Course>,
}

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

impl CriticalMotions {
    /// The critical motions of a program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let mut kinds: BTreeMap<Kind, Vec<LinearSegment>> = BTreeMap::new();
        for segment in program.segments() {
            if let Path::Linear(line) = segment.path()
                && let Some(kind) = kind(&segment, &line)
            {
                kinds.entry(kind).or_default().push(line);
            }
        }
        let critical = kinds.values().flat_map(|lines| {
            let tips: Vec<DVec3> = lines
                .iter()
                .map(|line| DVec3::new(line.to.tip.x, line.to.tip.y, line.to.tip.z))
                .collect();
            let chosen = outermost(&tips);
            chosen.into_iter().filter_map(|index| lines.get(index))
        });
        let courses: Vec<Course> = critical.filter_map(|line| Course::of(program, line)).collect();
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
    let flange_in_root = rig.flange_in_root(&course.from);
    let middles = middles(rig.axes);
    let near = match rig.mechanism {
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::FiveAxis(_) => middles,
        // Its branches are those of the axes that it is followed from.
        Mechanism::Serial(_) => newton::within_half_a_turn(&solution.joints, &middles),
    };
    rig.mechanism
        .on_branch(&flange_in_root, solution.branch, &near)
        .is_some_and(|start| prove(rig, course, solution.branch, &start, &LEAST_CLEARANCE).is_ok())
}
