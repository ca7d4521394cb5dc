//! Where the axes are all along a program: at the end of every op, and close enough between.

use super::legs::{Leg, Poses, Stroke, legs};
use super::path::joints_on;
use super::rig::Rig;
use crate::kinematics::Joints;
use vcutc_backend_api::ir::{Axis, AxisKind, OpId, Program};
use vcutc_backend_api::motion::ReachableProgram;

/// Farthest that the tip moves from one sample to the next, in mm.
pub const CLOSE: f64 = 5.0;
/// Farthest that the blade, or an axis that moves by itself, turns from one sample to the next, in rad: 2 deg.
pub const CLOSE_TURN: f64 = core::f64::consts::PI / 90.0;
/// Most samples of one motion.
const MOST_SAMPLES: f64 = 100_000.0;

/// How close samples are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing {
    /// Farthest that the tip, or a linear axis that moves by itself, moves from one to the next, in mm.
    pub way: f64,
    /// Farthest that the blade, or a rotary axis that moves by itself, turns from one to the next, in rad.
    pub turn: f64,
}

impl Spacing {
    /// Close enough to see all that the axes do.
    pub const CLOSE: Self = Self {
        way: CLOSE,
        turn: CLOSE_TURN,
    };
}

/// The axes at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The op.
    pub op: OpId,
    /// How much of its motion is done, from 0 (exclusive) to 1.
    pub done: f64,
    /// The axes.
    pub joints: Joints,
}

/// The samples of every op that moves, in order. One op after the other is sampled, so nothing is held but the legs.
///
/// # Errors
/// What `take` returns.
pub fn trajectory<E>(
    reached: &ReachableProgram,
    rig: &Rig<'_>,
    take: impl FnMut(Sample) -> Result<(), E>,
) -> Result<(), E> {
    trajectory_by(reached, rig, &Spacing::CLOSE, take)
}

/// The same with samples at another distance.
///
/// # Errors
/// What `take` returns.
pub fn trajectory_by<E>(
    reached: &ReachableProgram,
    rig: &Rig<'_>,
    spacing: &Spacing,
    mut take: impl FnMut(Sample) -> Result<(), E>,
) -> Result<(), E> {
    let program = reached.program();
    let mut at: Option<Joints> = program
        .cell
        .as_ref()
        .and_then(|cell| cell.home)
        .map(|home| home.0);
    for (op, leg) in super::legs::numbered(&legs(program)) {
        let Some(end) = reached.axes_after(op).map(|end| end.0) else {
            continue;
        };
        match (leg, at) {
            (Leg::Still, _) => continue,
            (Leg::Home | Leg::ByAxes(_), Some(start)) => {
                let steps = axis_steps(rig.axes, spacing, &start, &end);
                for done in fractions(steps) {
                    let joints = core::array::from_fn(|axis| start[axis] + (end[axis] - start[axis]) * done);
                    take(Sample { op, done, joints })?;
                }
            }
            (Leg::Along(stroke), Some(start)) => {
                let steps = course_steps(program, spacing, stroke);
                along(reached, rig, (op, stroke, steps), [&start, &end], &mut take)?;
            }
            (Leg::Home | Leg::ByAxes(_) | Leg::Along(_), None) => {}
        }
        take(Sample {
            op,
            done: 1.0,
            joints: end,
        })?;
        at = Some(end);
    }
    Ok(())
}

/// The samples of a course, divided into so many steps, but its end.
fn along<E>(
    reached: &ReachableProgram,
    rig: &Rig<'_>,
    (op, stroke, steps): (OpId, &Stroke, f64),
    ends: [&Joints; 2],
    take: &mut impl FnMut(Sample) -> Result<(), E>,
) -> Result<(), E> {
    let program = reached.program();
    let (Some(course), Some(branch)) = (Poses::of(program).course(stroke), reached.branch_after(op)) else {
        return Ok(());
    };
    let mut near = *ends[0];
    for done in fractions(steps) {
        if let Some(joints) = joints_on(rig, &course, branch, ends, done, &near) {
            take(Sample { op, done, joints })?;
            near = joints;
        }
    }
    Ok(())
}

/// `1/n`, `2/n`, ... up to but without 1.
fn fractions(steps: f64) -> impl Iterator<Item = f64> {
    let steps = steps.clamp(1.0, MOST_SAMPLES);
    core::iter::successors(Some(1.0), |step| Some(step + 1.0))
        .take_while(move |&step| step < steps)
        .map(move |step| step / steps)
}

fn course_steps(program: &Program, spacing: &Spacing, stroke: &Stroke) -> f64 {
    let held = |taught: super::legs::Taught| program.orientations.get(taught.held.0 as usize).copied();
    let turn = match (held(stroke.from), held(stroke.to)) {
        (Some(from), Some(to)) => from.angle_to(to).to_rad(),
        (Some(_) | None, _) => 0.0,
    };
    let length = stroke.from.tip.distance(stroke.to.tip).to_mm();
    (length / spacing.way).max(turn / spacing.turn).ceil()
}

fn axis_steps(axes: &[Axis], spacing: &Spacing, from: &Joints, to: &Joints) -> f64 {
    let steps = axes.iter().zip(from.iter().zip(to)).map(|(axis, (from, to))| {
        let close = match axis.kind {
            AxisKind::Rotary => spacing.turn,
            AxisKind::Linear => spacing.way,
        };
        (to - from).abs() / close
    });
    steps.fold(1.0, f64::max).ceil()
}
