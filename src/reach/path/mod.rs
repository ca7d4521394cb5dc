//! The path check: whether the axes follow the blade along a whole motion.

mod along;
mod arm;
mod course;
mod interval;
mod march;
#[cfg(test)]
mod tests;

use super::rig::Rig;
use crate::kinematics::pose::Pose;
use crate::kinematics::{Joints, Mechanism};
use arm::ArmBranch;
use course::Flight;
use march::{Bounds, march};
use vcutc_backend_api::motion::Branch;

/// A motion as controllers interpolate it: the tip on a straight line, the orientation on one rotation axis (of a robot) or
/// the rotary axes each at a constant rate (of a five-axis machine), both at a constant rate and finishing together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// Blade frame T in W at the start.
    pub from: Pose,
    /// Blade frame T in W at the end.
    pub to: Pose,
    /// How long it takes, in s; positive.
    pub duration: f64,
}

/// What holds all along a course that the axes follow on one branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// The axes at the start.
    pub start: Joints,
    /// The axes at the end.
    pub end: Joints,
    /// No axis goes below this.
    pub low: Joints,
    /// No axis goes above this.
    pub high: Joints,
    /// No axis moves faster than this either way, in rad or mm a second.
    pub rate: Joints,
    /// How far the arm keeps from its singular poses.
    pub clearance: Clearance,
    /// How many times the inverse kinematics was solved.
    pub solves: u32,
}

/// How far an arm is from its singular poses. A machine without such a pose is infinitely far from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Of the hand from being stretched: the angle of axis 5, in rad.
    pub wrist: f64,
    /// Of the elbow from being stretched or folded: the least angle between upper arm and the line to the wrist, in rad.
    pub elbow: f64,
    /// Of the wrist centre from axis 1, in mm.
    pub shoulder: f64,
}

/// Why the axes do not follow a course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breach {
    /// Where on the course, from 0 to 1.
    pub at: f64,
    /// What breaks there.
    pub what: Violation,
}

/// What breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Violation {
    /// No axis values bring the blade there on this branch.
    OutOfReach,
    /// An axis would have to leave its range.
    Limit {
        /// The axis, from 0.
        axis: usize,
        /// Where it would have to be.
        value: f64,
    },
    /// An axis would have to move too fast.
    Rate {
        /// The axis, from 0.
        axis: usize,
        /// How fast it would have to move.
        rate: f64,
    },
    /// The arm comes too near to a singular pose.
    Singular(Singularity),
}

/// Kinds of singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Singularity {
    /// Axes 4 and 6 in line; the angle of axis 5 in rad.
    Wrist(f64),
    /// Arm stretched or folded; the angle left in rad.
    Elbow(f64),
    /// Wrist centre over axis 1; the distance in mm.
    Shoulder(f64),
}

/// Proves that the axes follow a course on a branch, beginning at `start` (which must bring the blade to `course.from`),
/// within the limits and rates of the rig's axes and no nearer to singular poses than `least`.
///
/// # Errors
/// The first place where they do not, or where that cannot be told apart from rounding.
pub fn prove(
    rig: &Rig<'_>,
    course: &Course,
    branch: Branch,
    start: &Joints,
    least: &Clearance,
) -> Result<Proof, Breach> {
    const BEGINNING: Breach = Breach {
        at: 0.0,
        what: Violation::OutOfReach,
    };
    let flight = Flight::new(rig, course).ok_or(BEGINNING)?;
    if !(course.duration > 0.0 && course.duration.is_finite()) {
        return Err(BEGINNING);
    }
    // Where the closed form finds no way, or another than the given one, there is nothing to continue.
    let begun = rig.mechanism.on_branch(&flight.flange_at(0.0), branch, start);
    if !begun.is_some_and(|begun| is_same(&begun, start)) {
        return Err(BEGINNING);
    }
    let bounds = Bounds {
        axes: rig.axes,
        least: *least,
        duration: course.duration,
    };
    let mut proof = match (rig.mechanism, branch) {
        (
            Mechanism::OrthoParallel(arm),
            Branch::Arm {
                shoulder,
                elbow,
                wrist,
            },
        ) => {
            let branch = ArmBranch {
                shoulder,
                elbow,
                wrist,
            };
            march(&bounds, start, |span, _| {
                Ok(arm::posture(arm, branch, &flight.over(span))?.stretch(span))
            })?
        }
        (Mechanism::OrthoParallel(_), Branch::Numbered(_)) => return Err(BEGINNING),
    };
    // The enclosure of the end tells the turns; this is the end to the last digit.
    if let Some(end) = rig
        .mechanism
        .on_branch(&flight.flange_at(1.0), branch, &proof.end)
    {
        proof.end = end;
    }
    proof.solves += 2;
    Ok(proof)
}

/// How far apart given and computed axis values at the start may be, in rad or mm.
const SAME_START: f64 = 1e-5;

fn is_same(one: &Joints, other: &Joints) -> bool {
    one.iter()
        .zip(other)
        .all(|(one, other)| (one - other).abs() <= SAME_START)
}
