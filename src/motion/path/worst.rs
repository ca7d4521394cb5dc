//! How badly a course breaks what it breaks, for people: the proof stops where it breaks first.

use super::arm::{Carrying, LANES};
use super::arm_course::{ArmCourse, Solver};
use super::bounds::Stretch;
use super::march::about;
use super::types::{Breach, Course, Singularity, Violation};
use crate::rig::Rig;
use vcutc_backend_api::ir::Axis;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::Joints;

/// How closely a course is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Closely enough for a number that people read.
    Close,
    /// Closely enough to compare courses.
    Rough,
}

impl Look {
    /// Into how many parts the course is divided.
    const fn parts(self) -> u32 {
        match self {
            Self::Close => 256,
            Self::Rough => 16,
        }
    }
}

/// Where on the course the bound of `breach` is broken most, and how much. A place out of reach is worse than all others;
/// the first of these is reported. This comes from samples and proves nothing. `start` is that of the breach.
#[must_use]
pub fn worst(
    rig: &Rig<'_>,
    course: &Course,
    branch: Branch,
    start: &Joints,
    breach: &Breach,
    look: Look,
) -> Breach {
    let Some(way) = ArmCourse::new(rig, course, branch) else {
        return *breach;
    };
    let parts = look.parts();
    let (mut near, mut samples) = (*start, Vec::new());
    for at in (0..=parts).map(|part| f64::from(part) / f64::from(parts)) {
        let Some(joints) = way.joints_at(at, &near) else {
            let what = Violation::OutOfReach;
            return Breach { at, what };
        };
        near = joints;
        samples.push((at, joints));
    }
    let mut worst = *breach;
    for ((at, joints), found) in samples.iter().zip(stretches(&way, &samples)) {
        let Ok(found) = found else { continue };
        let what = like(worst.what, joints, &found, course.duration);
        if severity(&what, rig.axes) > severity(&worst.what, rig.axes) {
            worst = Breach { at: *at, what };
        }
    }
    worst
}

/// What the axes do about each of some places; of an arm with a closed form several at a time, as the lanes of a vector.
fn stretches(way: &ArmCourse<'_>, samples: &[(f64, Joints)]) -> Vec<Result<Stretch, Violation>> {
    match way.solver {
        Solver::ClosedForm(arm, branch) => {
            let mut carrying = Carrying::new(arm, branch, way.flight.shape());
            (0..LANES).for_each(|lane| carrying.take(lane, &way.flight));
            let mut found = Vec::with_capacity(samples.len());
            for some in samples.chunks(LANES) {
                for (lane, (at, _)) in some.iter().enumerate() {
                    carrying.set(lane, about(*at));
                }
                carrying.sweep();
                found.extend((0..some.len()).map(|lane| carrying.stretch(lane)));
            }
            found
        }
        Solver::Numeric(_) => samples
            .iter()
            .map(|(at, joints)| way.stretch(about(*at), joints))
            .collect(),
    }
}

/// The same kind of violation with the number that belongs to a place.
fn like(what: Violation, joints: &Joints, found: &Stretch, duration: f64) -> Violation {
    match what {
        Violation::OutOfReach => what,
        Violation::Limit { axis, value } => Violation::Limit {
            axis,
            value: joints.get(axis).copied().unwrap_or(value),
        },
        Violation::Rate { axis, rate } => Violation::Rate {
            axis,
            rate: found
                .rate
                .get(axis)
                .map_or(rate, |rate| rate.magnitude() / duration),
        },
        Violation::Singular(Singularity::Wrist(_)) => {
            Violation::Singular(Singularity::Wrist(found.clearance.wrist))
        }
        Violation::Singular(Singularity::Elbow(_)) => {
            Violation::Singular(Singularity::Elbow(found.clearance.elbow))
        }
        Violation::Singular(Singularity::Shoulder(_)) => {
            Violation::Singular(Singularity::Shoulder(found.clearance.shoulder))
        }
    }
}

/// Greater is worse, among violations of a kind.
fn severity(what: &Violation, axes: &[Axis]) -> f64 {
    match *what {
        Violation::OutOfReach => 0.0,
        Violation::Limit { axis, value } => axes
            .get(axis)
            .map_or(0.0, |axis| (axis.min - value).max(value - axis.max)),
        Violation::Rate { rate, .. } => rate,
        Violation::Singular(
            Singularity::Wrist(left) | Singularity::Elbow(left) | Singularity::Shoulder(left),
        ) => -left,
    }
}
