//! How a machine's axes carry out a program: the [`Motion`], and the [`ReachableProgram`] that has one.
//!
//! The kinematics of the machine are solved once, before any backend is asked. What a backend needs of the result travels
//! with the program: for every op where the axes are when it ends, and on which branch of the inverse kinematics the arm is.
//! A backend that says a pose in a controller's terms (KUKA's status and turn, ABB's configuration) reads both from here and
//! computes no kinematics itself.

#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests;

use crate::geometry::Frame;
use crate::ir::{Action, AxisValues, Cell, Head, OpId, Program, ToolId};
use crate::state::TipPose;
use crate::verify::VerifiedProgram;
use core::fmt;
use serde::{Deserialize, Serialize};

/// Where the axes are when each op ends, and on which branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Motion {
    /// For every op, in order, the axes at its end. An op that moves nothing repeats those of the op before it.
    pub ends: Vec<AxisValues>,
    /// The branches, in order of the ops; the first begins with the first motion to a pose.
    pub stretches: Vec<Stretch>,
    /// Where the axes are on the way of ops in which one of the last three axes of an arm turns far, in order of ops and of the
    /// way. Controllers that choose the way to stand anew at every point (ABB's) are given these points as well.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waypoints: Vec<Waypoint>,
}

/// Where a machine is on the way of an op.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Waypoint {
    /// The op, a straight motion or a turn.
    pub op: OpId,
    /// How much of the way is done, above 0 and below 1.
    pub done: f64,
    /// The blade frame T there, seen from the workpiece frame W.
    pub frame: Frame,
    /// The axes there.
    pub axes: AxisValues,
}

/// A stretch of ops on one branch. It lasts until the next one begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Stretch {
    /// The op that ends on this branch first.
    pub from: OpId,
    /// The branch.
    pub branch: Branch,
}

/// One of the ways in which a machine can stand so that its tool has a given pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Branch {
    /// Of an arm with a shoulder, an elbow and a spherical wrist.
    Arm {
        /// On which side of axis 1 the wrist is.
        shoulder: Shoulder,
        /// On which side of the upper arm the wrist is.
        elbow: Elbow,
        /// To which side the hand is bent.
        wrist: Wrist,
    },
    /// Of a machine whose branches have no names of their own, in the order in which its kinematics lists them.
    Numbered(u8),
}

/// On which side of axis 1 the wrist centre is, seen in the frame that turns with axis 1 (x to the front of the arm).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Shoulder {
    /// Before it: positive x.
    Front,
    /// Behind it or overhead: negative x.
    Back,
}

/// On which side of the line from axis 2 to axis 3 the wrist centre is.
///
/// With `psi` the angle by which the line from axis 3 to the wrist centre is turned, about the axis of joint 3, against the
/// prolonged line from axis 2 to axis 3 (0 when the arm is stretched).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Elbow {
    /// `sin psi > 0`: the forearm is folded forward; with the shoulder in front the elbow is up.
    Forward,
    /// `sin psi < 0`.
    Backward,
}

/// The sign of axis 5 as the controller counts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Wrist {
    /// Zero or more.
    Positive,
    /// Less than zero.
    Negative,
}

/// A verified program together with the motion of a machine that carries it out.
///
/// Only [`ReachableProgram::assemble`] makes one, and it checks the motion against the program again.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachableProgram {
    verified: VerifiedProgram,
    motion: Motion,
}

/// What is wrong with a motion. All of it is the compiler's fault, not the job's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionFault {
    /// The op, where the fault is about one.
    pub op: Option<OpId>,
    /// The broken promise.
    pub what: MotionRule,
}

/// What a motion promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionRule {
    /// The program has a machine.
    Machine,
    /// Every op has axis values; they are finite, and 0 in the places beyond the machine's axes.
    Complete,
    /// Axis values lie within the axes' limits.
    Limits,
    /// At the axis values the blade is where the op says.
    Pose,
    /// The first stretch begins with the first motion to a pose; the others come in order and begin with moves of all axes.
    Stretches,
    /// An op that moves nothing leaves the axes where they are.
    Still,
    /// Waypoints come in order and lie on the way of an op that moves the blade; the axes hold the blade there within their
    /// limits.
    Waypoints,
}

impl fmt::Display for MotionRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Machine => "the program has no machine whose axes could move",
            Self::Complete => "an op has no axis values, or some that its machine cannot have",
            Self::Limits => "an axis value lies outside of its limits",
            Self::Pose => "the axis values do not give the op's pose",
            Self::Stretches => "the branch is not known, or changes without an axis move",
            Self::Still => "the axes move in an op that moves nothing",
            Self::Waypoints => "a waypoint does not lie on the way of its op",
        })
    }
}

/// How far the blade may be from where an op says, in mm: a thousandth of what a controller resolves.
const SAME_PLACE: f64 = 1e-6;
/// How far it may be turned against it, in rad: below a micrometre over a metre of tool.
const SAME_ATTITUDE: f64 = 1e-7;
/// By how much an axis may be beyond its limit, in rad or mm: rounding.
const AT_LIMIT: f64 = 1e-9;

impl ReachableProgram {
    /// Joins a program and its motion. `blade_in_work` gives the pose of the blade frame T in the workpiece frame W for the
    /// blade at hand and axis values; it is asked for every op.
    ///
    /// # Errors
    /// All broken promises, in the order of the ops.
    pub fn assemble(
        verified: VerifiedProgram,
        motion: Motion,
        blade_in_work: &dyn Fn(ToolId, &AxisValues) -> Frame,
    ) -> Result<Self, Vec<MotionFault>> {
        let faults = faults(verified.program(), &motion, blade_in_work);
        if faults.is_empty() {
            Ok(Self { verified, motion })
        } else {
            Err(faults)
        }
    }

    /// The same with another head of the program, on which no motion depends.
    #[must_use]
    pub fn headed(self, head: Option<Head>) -> Self {
        Self {
            verified: self.verified.headed(head),
            ..self
        }
    }

    /// The program with its proof of form.
    #[must_use]
    pub const fn verified(&self) -> &VerifiedProgram {
        &self.verified
    }

    /// The program.
    #[must_use]
    pub const fn program(&self) -> &Program {
        self.verified.program()
    }

    /// The motion.
    #[must_use]
    pub const fn motion(&self) -> &Motion {
        &self.motion
    }

    /// The axes at the end of an op.
    #[must_use]
    pub fn axes_after(&self, op: OpId) -> Option<AxisValues> {
        self.motion.ends.get(op.0 as usize).copied()
    }

    /// The axes when an op begins: at home before the first motion, and not known there without a home.
    #[must_use]
    pub fn axes_before(&self, op: OpId) -> Option<AxisValues> {
        let home = self.program().cell.as_ref().and_then(|cell| cell.home);
        let before = op.0.checked_sub(1).map(OpId);
        let moved = before.filter(|before| home.is_some() || self.branch_after(*before).is_some());
        moved.map_or(home, |before| self.axes_after(before))
    }

    /// The branch that an op ends on; none before the first motion to a pose.
    #[must_use]
    pub fn branch_after(&self, op: OpId) -> Option<Branch> {
        let begun = self
            .motion
            .stretches
            .partition_point(|stretch| stretch.from <= op);
        let stretch = self.motion.stretches.get(begun.checked_sub(1)?)?;
        Some(stretch.branch)
    }
}

fn faults(
    program: &Program,
    motion: &Motion,
    blade_in_work: &dyn Fn(ToolId, &AxisValues) -> Frame,
) -> Vec<MotionFault> {
    let whole = |what| vec![MotionFault { op: None, what }];
    let Some(cell) = &program.cell else {
        return whole(MotionRule::Machine);
    };
    if motion.ends.len() != program.ops.len() {
        return whole(MotionRule::Complete);
    }
    let mut faults = stretch_faults(program, motion);
    let mut before: Option<AxisValues> = cell.home;
    for (segment, &values) in program.segments().zip(&motion.ends) {
        let op = Some(segment.id);
        let mut fault = |what| faults.push(MotionFault { op, what });
        let beyond = values.0.iter().skip(cell.axes.len());
        if !(values.0.iter().all(|value| value.is_finite()) && beyond.copied().all(|value| value == 0.0)) {
            fault(MotionRule::Complete);
            continue;
        }
        if !within_limits(cell, &values) {
            fault(MotionRule::Limits);
        }
        let is_there = |pose: TipPose| {
            let should = program.frame(pose);
            should.is_some_and(|should| is_there(&blade_in_work(segment.before.tool, &values), &should))
        };
        let broken = match (segment.op.action, segment.target()) {
            (_, Some(to)) => (!is_there(to)).then_some(MotionRule::Pose),
            (Action::Home, None) => (cell.home != Some(values)).then_some(MotionRule::Pose),
            (Action::ChangePlace, None) => {
                let should = cell.change.map(|change| change.at);
                (should != Some(values)).then_some(MotionRule::Pose)
            }
            (_, None) => before
                .is_some_and(|before| before != values)
                .then_some(MotionRule::Still),
        };
        broken.into_iter().for_each(fault);
        before = Some(values);
    }
    faults.extend(waypoint_faults(program, motion, blade_in_work));
    faults
}

fn waypoint_faults(
    program: &Program,
    motion: &Motion,
    blade_in_work: &dyn Fn(ToolId, &AxisValues) -> Frame,
) -> Vec<MotionFault> {
    let Some(cell) = &program.cell else {
        return Vec::new();
    };
    let mut faults = Vec::new();
    let mut waypoints = motion.waypoints.iter().peekable();
    for segment in program.segments() {
        if waypoints.peek().is_none() {
            break;
        }
        let mut done = 0.0;
        while let Some(waypoint) = waypoints.next_if(|waypoint| waypoint.op == segment.id) {
            let in_order = done < waypoint.done && waypoint.done < 1.0;
            done = waypoint.done;
            let on_the_way = (segment.line())
                .and_then(|line| line.frame_at(program, waypoint.done))
                .is_some_and(|should| is_there(&waypoint.frame, &should));
            let held = waypoint.axes.0.iter().all(|value| value.is_finite())
                && within_limits(cell, &waypoint.axes)
                && is_there(
                    &blade_in_work(segment.before.tool, &waypoint.axes),
                    &waypoint.frame,
                );
            if !(in_order && on_the_way && held) {
                faults.push(MotionFault {
                    op: Some(segment.id),
                    what: MotionRule::Waypoints,
                });
            }
        }
    }
    if waypoints.next().is_some() {
        faults.push(MotionFault {
            op: None,
            what: MotionRule::Waypoints,
        });
    }
    faults
}

/// Whether the blade is where it should be.
fn is_there(is: &Frame, should: &Frame) -> bool {
    is.origin.distance(should.origin).to_mm() <= SAME_PLACE
        && is.orientation.angle_to(should.orientation).to_rad() <= SAME_ATTITUDE
}

fn within_limits(cell: &Cell, values: &AxisValues) -> bool {
    cell.axes
        .iter()
        .zip(values.0)
        .all(|(axis, value)| (axis.min - AT_LIMIT..=axis.max + AT_LIMIT).contains(&value))
}

fn stretch_faults(program: &Program, motion: &Motion) -> Vec<MotionFault> {
    let fault = |op| MotionFault {
        op: Some(op),
        what: MotionRule::Stretches,
    };
    let first = program.segments().find(|segment| segment.end().is_some());
    let first = first.map(|segment| segment.id);
    let begun = motion.stretches.first().map(|stretch| stretch.from);
    let first = (begun != first).then(|| fault(begun.or(first).unwrap_or(OpId(0))));
    let later = motion
        .stretches
        .windows(2)
        .filter_map(|pair| match pair {
            [before, stretch] => Some((before.from, stretch.from)),
            _ => None,
        })
        .filter(|&(before, from)| {
            let action = program.ops.get(from.0 as usize).map(|op| op.action);
            before >= from || !matches!(action, Some(Action::AxisTravel { .. }))
        });
    first
        .into_iter()
        .chain(later.map(|(_, from)| fault(from)))
        .collect()
}
