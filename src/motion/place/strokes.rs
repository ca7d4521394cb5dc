//! The motions of a program that tell whether the axes are fast enough.
//!
//! A margin says nothing of rates, and a place with a large margin may ask more of an axis than it can give: near singular
//! poses, or where the work lies close to axis 1. Before a place is believed in, a few motions of every kind are therefore
//! proven there: those between the same two ways to hold the blade, at the same speed, with their ends farthest out.

use super::taught::outermost;
use crate::legs::{Leg, Pace, Poses, Stroke, legs};
use crate::path::{Course, prove};
use crate::rig::Rig;
use crate::solve::LEAST_CLEARANCE;
use crate::survey::middles;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OpId, OrientationId, Program};
use vcutc_machine::kinematics::{Mechanism, Solution, newton};

/// Telling motions of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strokes {
    courses: Vec<Course>,
}

/// Most motions that are proven at a place.
const MOST: usize = 96;
/// Motions are of one kind if they lead from the same posture to the same posture at the same speed.
type Kind = (OrientationId, OrientationId, Pace);

impl Strokes {
    /// The telling motions of a program.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let mut kinds: BTreeMap<Kind, Vec<Stroke>> = BTreeMap::new();
        for leg in legs(program) {
            if let Leg::Along(stroke) = leg {
                let kind = (stroke.from.held, stroke.to.held, stroke.pace);
                kinds.entry(kind).or_default().push(stroke);
            }
        }
        let poses = Poses::of(program);
        let telling = kinds.values().flat_map(|strokes| {
            let tips: Vec<DVec3> = strokes
                .iter()
                .map(|stroke| DVec3::new(stroke.to.tip.x, stroke.to.tip.y, stroke.to.tip.z))
                .collect();
            let chosen = outermost(&tips);
            chosen.into_iter().filter_map(|index| strokes.get(index))
        });
        let courses: Vec<Course> = telling.filter_map(|stroke| poses.course(stroke)).collect();
        let step = courses.len().div_ceil(MOST).max(1);
        Self {
            courses: courses.into_iter().step_by(step).collect(),
        }
    }

    /// The motion of one op alone, if it has one along a course.
    #[must_use]
    pub fn only(program: &Program, op: OpId) -> Self {
        let course = match legs(program).get(op.0 as usize) {
            Some(Leg::Along(stroke)) => Poses::of(program).course(stroke),
            Some(Leg::Still | Leg::Home | Leg::ByAxes(_)) | None => None,
        };
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
