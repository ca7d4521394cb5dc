//! What is asked of a machine's axes, and what comes of it: a course, its proof, or the first breach.

use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;

/// A motion as controllers interpolate it: the tip on a straight line or an arc, the orientation on one rotation axis (of a robot) or
/// the rotary axes each at a constant rate (of a five-axis machine), both at a constant rate and finishing together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// Blade frame T in W at the start.
    pub from: Pose,
    /// Blade frame T in W at the end.
    pub to: Pose,
    /// The arc of the tip in W, from where it is at the start to where it is at the end; none on a straight line.
    pub arc: Option<CircularArc>,
    /// How long it takes, in s; positive.
    pub duration: f64,
}

impl Course {
    /// That of a motion of a program.
    #[must_use]
    pub fn of(program: &Program, line: &LinearSegment) -> Option<Self> {
        Some(Self {
            from: Pose::from(program.frame(line.from)?),
            to: Pose::from(program.frame(line.to)?),
            arc: line.arc(),
            duration: line.duration().to_s(),
        })
    }
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
    /// The arm comes too close to a singularity.
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
