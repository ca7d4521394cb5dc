//! How badly a course breaks what it breaks, for people: the proof stops where it breaks first.

use super::bounds::Stretch;
use super::march::about;
use super::{Breach, Course, Singularity, Violation, Way};
use crate::kinematics::Joints;
use crate::reach::rig::Rig;
use vcutc_backend_api::ir::Axis;
use vcutc_backend_api::motion::Branch;

/// Places looked at.
const SAMPLES: u32 = 256;

/// Where on the course what `breach` tells is broken most, and how much. A place out of reach is worse than all others;
/// the first of these is told. This comes from samples and proves nothing. `start` is that of the breach.
#[must_use]
pub fn worst(rig: &Rig<'_>, course: &Course, branch: Branch, start: &Joints, breach: &Breach) -> Breach {
    let Some(way) = Way::new(rig, course, branch) else {
        return *breach;
    };
    let (mut worst, mut near) = (*breach, *start);
    for at in (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES)) {
        let Some(joints) = way.joints_at(at, &near) else {
            let what = Violation::OutOfReach;
            return Breach { at, what };
        };
        near = joints;
        let Ok(found) = way.stretch(about(at), &joints) else {
            continue;
        };
        let what = like(worst.what, &joints, &found, course.duration);
        if severity(&what, rig.axes) > severity(&worst.what, rig.axes) {
            worst = Breach { at, what };
        }
    }
    worst
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
