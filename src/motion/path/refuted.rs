//! Courses that an arm cannot follow, seen from samples.
//!
//! The proof of a course that breaks a bound continues until it has found the first place where it does, in ever shorter spans.
//! Who only asks whether a branch carries a program needs no such place, and a few samples refute most of what it does not
//! carry. What they refute is refuted for certain: a pose without axis values, an axis that is out of its range on every turn,
//! or one that is farther from where it was at the sample before than its rate allows. The last holds by the mean value
//! theorem: somewhere between two samples the axis is at least as fast as from one to the other. That it may have made whole
//! turns meanwhile changes nothing, for then it went farther still.

use super::arm_course::{ArmCourse, Solver};
use super::types::Course;
use crate::axis_range::{axis_margin, turn_to_middle};
use crate::rig::Rig;
use vcutc_backend_api::ir::Axis;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// Parts of a course at whose ends samples are taken.
const PARTS: u32 = 16;

/// What a bound must be exceeded by to be broken for certain, as a share: far more than proofs allow for rounding.
const SURE: f64 = 1e-6;

/// What samples show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refuted {
    /// The arm does not reach a pose, or only with an axis out of its range.
    Pose,
    /// An axis is too slow; the highest rate it needs between two samples is so many times its own.
    TooFast(f64),
}

/// What keeps an arm with a closed form from a course that it begins at `start`, as far as samples show. None says nothing.
#[must_use]
pub fn refuted(rig: &Rig<'_>, course: &Course, branch: Branch, start: &Joints) -> Option<Refuted> {
    match rig.mechanism {
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) => {}
        // Whether axis values exist is not decided by an iteration; five-axis machines go along other courses.
        Mechanism::Serial(_) | Mechanism::FiveAxis(_) => return None,
    }
    let Some(way) = ArmCourse::new(rig, course, branch) else {
        return Some(Refuted::Pose);
    };
    match way.solver {
        Solver::ClosedForm(..) => {}
        Solver::Numeric(_) => return None,
    }
    let (mut before, mut fastest) = (*start, 0.0_f64);
    for place in (1..=PARTS).map(|part| f64::from(part) / f64::from(PARTS)) {
        let Some(here) = way
            .joints_at(place, &before)
            .filter(|here| is_in_range(rig.axes, here))
        else {
            return Some(Refuted::Pose);
        };
        let time = course.duration / f64::from(PARTS);
        fastest = fastest.max(times_too_fast(rig.axes, &before, &here, time));
        before = here;
    }
    (fastest > 1.0 + SURE).then_some(Refuted::TooFast(fastest))
}

/// Whether every axis has a turn on which it is in its range.
fn is_in_range(axes: &[Axis], joints: &Joints) -> bool {
    axes.iter().zip(joints).all(|(axis, &value)| {
        let value = value + turn_to_middle(axis, value, value);
        axis_margin(axis, value, value) >= -SURE
    })
}

/// How many times the rate of an axis it takes to go from one sample to the next, for the axis that needs the most of its own.
fn times_too_fast(axes: &[Axis], from: &Joints, to: &Joints, time: f64) -> f64 {
    let times = axes
        .iter()
        .zip(from.iter().zip(to))
        .filter_map(|(axis, (from, to))| {
            let most = axis.rate.filter(|&most| most > 0.0)?;
            Some((to - from).abs() / time / most)
        });
    times.fold(0.0, f64::max)
}
