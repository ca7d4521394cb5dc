//! `vcutc fk` and `vcutc ik`: where axis values bring a machine, and which axis values bring it to a pose. People check a
//! cell with that: what its controller shows must be what is printed here.

mod answer;
mod numbers;

use super::Exit;
use super::args::CellArgs;
use super::console::{Console, Failure};
use super::machines;
use answer::{Found, Reached};
use core::f64::consts::TAU;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Axis, AxisKind, MachineKind};
use vcutc_backend_api::motion::Branch;
use vcutc_machine::Model;
use vcutc_machine::kinematics::configuration::branch_of;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// By how much an axis may be beyond its limit, in rad or mm: rounding.
const AT_LIMIT: f64 = 1e-9;
/// Most sets of axis values of one way to stand that are listed. An arm with three axes of two turns each has 27 at most.
const MOST_TURNS: usize = 64;

/// How many turns either way from the first value of an axis others are looked for.
const FARTHEST_TURN: f64 = 4.0;

/// A machine with its frames.
struct Cell {
    model: Model,
    blade_in_flange: Pose,
    work_in_root: Pose,
    /// What the pose is of and in, in words.
    pose_of: String,
}

/// Prints where axis values bring the flange or the blade.
pub(super) fn forward(cell: &CellArgs, joints: &str, console: &Console) -> Exit {
    let cell = match Cell::new(cell, console) {
        Ok(cell) => cell,
        Err(exit) => return exit,
    };
    let values = match numbers::axis_values("--joints", joints, &cell.model.axes) {
        Ok(values) => values,
        Err(failure) => return console.failure(&failure),
    };
    let mut joints = Joints::default();
    for (joint, value) in joints.iter_mut().zip(values) {
        *joint = value;
    }
    let flange_in_root = cell.model.mechanism.flange_in_root(&joints);
    let blade_in_work = cell.work_in_root.inverse() * flange_in_root * cell.blade_in_flange;
    let arm = cell.model.mechanism.ortho_parallel();
    let branch = arm.map(|arm| branch_of(arm, &joints));
    let reached = Reached {
        model: &cell.model,
        pose_of: &cell.pose_of,
        pose: Frame::from(blade_in_work),
        joints,
        branch,
    };
    if console.speaks_json() {
        console.document(&format!("{}\n", reached.in_json()))
    } else {
        console.document(&reached.text())
    }
}

/// Prints all axis values that bring the flange or the blade to a pose.
pub(super) fn inverse(cell: &CellArgs, pose: &str, quaternion: Option<&str>, console: &Console) -> Exit {
    let cell = match Cell::new(cell, console) {
        Ok(cell) => cell,
        Err(exit) => return exit,
    };
    let frame = match quaternion {
        Some(quaternion) => numbers::frame_with("--pose", pose, quaternion),
        None => numbers::frame("--pose", pose, "1500,0,1200,0,90,0"),
    };
    let frame = match frame {
        Ok(frame) => frame,
        Err(failure) => return console.failure(&failure),
    };
    let flange_in_root = cell.work_in_root * Pose::from(frame) * cell.blade_in_flange.inverse();
    let ways = cell.model.mechanism.all(&flange_in_root);
    let solutions = ways
        .iter()
        .flat_map(|way| with_turns(&cell.model.axes, way.branch, &way.joints))
        .collect();
    let found = Found {
        model: &cell.model,
        pose_of: &cell.pose_of,
        pose: frame,
        solutions,
        blade_turned: match &cell.model.mechanism {
            Mechanism::FiveAxis(machine) => machine.blade_turned(&flange_in_root),
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => None,
        },
    };
    if console.speaks_json() {
        console.document(&format!("{}\n", found.in_json()))
    } else {
        let shown = if console.shows_everything() {
            answer::Shown::All
        } else {
            answer::Shown::WithinLimits
        };
        console.document(&found.text(shown))
    }
}

impl Cell {
    fn new(arguments: &CellArgs, console: &Console) -> Result<Self, Exit> {
        let model = machines::load(&arguments.machine, console)?;
        let frame = |option: &str, text: &Option<String>, example: &str| match text {
            Some(text) => numbers::frame(option, text, example).map(Pose::from),
            None => Ok(Pose::IDENTITY),
        };
        let refuse = |failure: Failure| console.failure(&failure);
        let blade_in_flange = frame("--tool", &arguments.tool, "0,0,310,0,0,0").map_err(refuse)?;
        let work_in_root = frame("--base", &arguments.base, "1800,0,700,0,0,0").map_err(refuse)?;
        let what = match (&arguments.tool, model.kind()) {
            (Some(_), _) => "blade",
            (None, MachineKind::Robot) => "flange",
            (None, MachineKind::FiveAxis) => "spindle nose",
        };
        let seen_from = match (&arguments.base, model.kind()) {
            (Some(_), _) => "work",
            (None, MachineKind::Robot) => "root",
            (None, MachineKind::FiveAxis) => "mount",
        };
        Ok(Self {
            pose_of: format!("{what} in the {seen_from}"),
            blade_in_flange,
            work_in_root,
            model,
        })
    }
}

/// The axis values of one way to stand, with every turn of every axis within its limits. An axis that no turn brings within
/// its limits is left where it is least beyond them.
fn with_turns(axes: &[Axis], branch: Branch, joints: &Joints) -> Vec<(Branch, Joints)> {
    let mut sets = vec![*joints];
    for (place, axis) in axes.iter().enumerate().take(joints.len()) {
        let turns = turns_of(axis, joints[place]);
        sets = sets
            .iter()
            .flat_map(|set| {
                turns.iter().map(|value| {
                    let mut set = *set;
                    set[place] = *value;
                    set
                })
            })
            .take(MOST_TURNS)
            .collect();
    }
    sets.into_iter().map(|set| (branch, set)).collect()
}

/// An axis value with all its turns within the limits, or the one that is least beyond them.
fn turns_of(axis: &Axis, value: f64) -> Vec<f64> {
    match axis.kind {
        AxisKind::Linear => vec![value],
        AxisKind::Rotary => {
            // Limits may be far out or infinite; the turns there are not needed.
            let far = TAU * FARTHEST_TURN;
            let (min, max) = (axis.min.max(value - far), axis.max.min(value + far));
            let within = ((min - AT_LIMIT - value) / TAU).ceil();
            let count = ((max + AT_LIMIT - value) / TAU).floor() - within;
            let first = value + TAU * within;
            if count >= 0.0 {
                (0..MOST_TURNS)
                    .map(|turn| first + TAU * turn as f64)
                    .take_while(|turned| *turned <= max + AT_LIMIT)
                    .collect()
            } else if first - max <= min - (first - TAU) {
                vec![first]
            } else {
                vec![first - TAU]
            }
        }
    }
}

/// How far an axis is within its limits; negative when it is beyond one.
fn margin(axis: &Axis, value: f64) -> f64 {
    (value - axis.min).min(axis.max - value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(min: f64, max: f64) -> Axis {
        Axis {
            name: "A6".to_owned(),
            kind: AxisKind::Rotary,
            min: min.to_radians(),
            max: max.to_radians(),
            rate: None,
            acceleration: None,
            jerk: None,
        }
    }

    fn turns(min: f64, max: f64, value: f64) -> Vec<i32> {
        let turns = turns_of(&axis(min, max), value.to_radians());
        turns
            .iter()
            .map(|turn| turn.to_degrees().round() as i32)
            .collect()
    }

    #[test]
    fn every_turn_within_the_limits_is_listed() {
        assert_eq!(turns(-350.0, 350.0, 20.0), [-340, 20]);
        assert_eq!(turns(-350.0, 350.0, 5.0), [5]);
        assert_eq!(turns(-360.0, 360.0, 0.0), [-360, 0, 360]);
        assert_eq!(turns(-185.0, 185.0, 180.0), [-180, 180]);
        assert_eq!(turns(100.0, 200.0, -170.0), [190]);
        assert_eq!(turns(700.0, 720.0, -10.0), [710]);
        assert_eq!(turns(f64::NEG_INFINITY, f64::INFINITY, 0.0).len(), 9);
    }

    #[test]
    fn outside_of_all_turns_the_nearest_to_the_limits_is_listed() {
        assert_eq!(turns(-140.0, -5.0, 10.0), [10]);
        assert_eq!(turns(-140.0, -5.0, 170.0), [-190]);
        assert_eq!(turns(-140.0, -5.0, -150.0), [-150]);
    }
}
