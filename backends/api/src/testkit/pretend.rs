//! A pretend machine that carries out any program.
//!
//! A backend gets programs with the motion of a machine, and its tests need such programs without computing the kinematics
//! of a robot. The pretend machine is easy to compute: its first three axes turn pinions whose racks carry the blade along
//! x, y and z of the workpiece, [`RACK`] mm each radian, and its other three are the angles A, B and C of the blade
//! ([`Zyx`]). Axis 5 is set off so that its sign is that of its wrist: [`Wrist::Positive`] for one of its turns,
//! [`Wrist::Negative`] for the turn below. Shoulder and elbow are always in front and forward.
//!
//! For cells of five-axis machines there is [another one](super::five_axes).

use super::pretend_five_axis;
use crate::geometry::{Frame, Orientation, Point3, Zyx};
use crate::ir::{Action, Axis, AxisKind, AxisValues, MachineKind, Maker, OpId, Program};
use crate::motion::{
    Branch, Elbow, Motion, MotionFault, ReachableProgram, Shoulder, Stretch, Waypoint, Wrist,
};
use crate::segments::{LinearSegment, Path};
use crate::state::TipPose;
use crate::units::Angle;
use crate::verify::VerifiedProgram;
use crate::wrist::spaced;
use core::f64::consts::TAU;

/// How far a rack moves, in mm each radian: far enough that a turn of its axis crosses any workshop.
const RACK: f64 = 1e6;

/// Axis 5 is so much more than the angle B, which lies within 90 deg either way.
const OFFSET: Angle = Angle::deg(100.0);

/// Axes 4 and 6 stay within this, either way.
const FARTHEST_TURN: Angle = Angle::deg(350.0);

/// Limits of all axes: wider than any dialect says.
const LIMIT: Angle = Angle::deg(720.0);

/// The axes of the pretend machine, called A1 to A6.
#[must_use]
pub fn axes() -> Vec<Axis> {
    (1..=6)
        .map(|number| Axis {
            name: format!("A{number}"),
            kind: AxisKind::Rotary,
            min: -LIMIT.to_rad(),
            max: LIMIT.to_rad(),
            rate: Some(2.0),
            acceleration: None,
            jerk: None,
        })
        .collect()
}

/// The program with the motion of the pretend machine of its cell's kind, whose axes the cell must have. Every move of all
/// axes of a robot but the first changes the wrist.
///
/// # Errors
/// When the cell of the program is that of another machine, or there is none.
pub fn reachable(program: VerifiedProgram) -> Result<ReachableProgram, Vec<MotionFault>> {
    let motion = motion(program.program());
    let blade_in_work = match kind(program.program()) {
        MachineKind::Robot => blade_in_work,
        MachineKind::FiveAxis => pretend_five_axis::blade_in_work,
    };
    // Its racks carry the tip, whichever blade is at hand.
    ReachableProgram::assemble(program, motion, &|_, axes| blade_in_work(axes))
}

fn kind(program: &Program) -> MachineKind {
    let cell = program.cell.as_ref();
    cell.map_or(MachineKind::Robot, |cell| cell.kind)
}

fn motion(program: &Program) -> Motion {
    let home = program.cell.as_ref().and_then(|cell| cell.home);
    let change = program.cell.as_ref().and_then(|cell| cell.change);
    let change = change.map(|change| change.at);
    let mut motion = Motion {
        ends: Vec::with_capacity(program.ops.len()),
        stretches: Vec::new(),
        waypoints: Vec::new(),
    };
    let mut axes = home.unwrap_or(AxisValues([0.0; 6]));
    let mut wrist = Wrist::Negative;
    let kind = kind(program);
    let axes_at = |TipPose { tip, orientation }, wrist, before| {
        let held = program.orientation(orientation).unwrap_or(Orientation::IDENTITY);
        match kind {
            MachineKind::Robot => axes_at(tip, held, wrist, before),
            MachineKind::FiveAxis => pretend_five_axis::axes_at(tip, held),
        }
    };
    for segment in program.segments() {
        let from = segment.id;
        if matches!(segment.op.action, Action::AxisTravel { .. }) {
            wrist = other(wrist);
            let branch = match kind {
                MachineKind::Robot => Branch::Arm {
                    shoulder: Shoulder::Front,
                    elbow: Elbow::Forward,
                    wrist,
                },
                MachineKind::FiveAxis => Branch::Numbered(0),
            };
            motion.stretches.push(Stretch { from, branch });
        }
        let start = axes;
        axes = match segment.path() {
            Path::Home => home.unwrap_or(axes),
            Path::Change => change.unwrap_or(axes),
            Path::Axes(to) => axes_at(to, wrist, axes),
            Path::Linear(line) if line.from != line.to => axes_at(line.to, wrist, axes),
            Path::Linear(_) | Path::Still => axes,
        };
        motion.ends.push(axes);
        if let Some(line) = segment.line() {
            motion
                .waypoints
                .extend(on_the_way(program, from, &line, wrist, [start, axes]));
        }
    }
    motion
}

/// How many samples are taken on the way of an op.
const SAMPLES: u32 = 256;

/// The waypoints of an op, for controllers that need them.
fn on_the_way(
    program: &Program,
    op: OpId,
    line: &LinearSegment,
    wrist: Wrist,
    [start, end]: [AxisValues; 2],
) -> Vec<Waypoint> {
    let maker = program.cell.as_ref().map(|cell| cell.maker);
    if maker != Some(Maker::Abb) {
        return Vec::new();
    }
    let mut near = start;
    let places = (1..SAMPLES).map(|sample| f64::from(sample) / f64::from(SAMPLES));
    let samples: Vec<(f64, AxisValues)> = places
        .filter_map(|done| {
            let frame = line.frame_at(program, done)?;
            near = axes_at(frame.origin, frame.orientation, wrist, near);
            Some((done, near))
        })
        .collect();
    let chosen = spaced(start, &samples, end).into_iter();
    chosen
        .filter_map(|(done, axes)| {
            let frame = line.frame_at(program, done)?;
            Some(Waypoint {
                op,
                done,
                frame,
                axes,
            })
        })
        .collect()
}

const fn other(wrist: Wrist) -> Wrist {
    match wrist {
        Wrist::Positive => Wrist::Negative,
        Wrist::Negative => Wrist::Positive,
    }
}

/// The axes that hold the blade there, those of A and C as near as may be to where they were.
#[must_use]
pub fn axes_at(tip: Point3, held: Orientation, wrist: Wrist, before: AxisValues) -> AxisValues {
    let Zyx { a, b, c } = held.to_zyx();
    let turn = match wrist {
        Wrist::Positive => 0.0,
        Wrist::Negative => -TAU,
    };
    AxisValues([
        tip.x / RACK,
        tip.y / RACK,
        tip.z / RACK,
        nearest_turn(a, before.0[3]),
        (b + OFFSET).to_rad() + turn,
        nearest_turn(c, before.0[5]),
    ])
}

/// Of the turns of an angle that an axis can take, the one nearest to where it is.
fn nearest_turn(angle: Angle, before: f64) -> f64 {
    let turns = [-TAU, 0.0, TAU].map(|turn| angle.to_rad() + turn);
    let far = |value: f64| (value - before).abs();
    turns
        .into_iter()
        .filter(|value| value.abs() <= FARTHEST_TURN.to_rad())
        .min_by(|&a, &b| far(a).total_cmp(&far(b)))
        .unwrap_or(angle.to_rad())
}

/// Where axis values of the pretend machine hold the blade: frame T in the workpiece frame W.
#[must_use]
pub fn blade_in_work(axes: &AxisValues) -> Frame {
    let [x, y, z, a, b, c] = axes.0;
    Frame {
        origin: Point3::new(x * RACK, y * RACK, z * RACK),
        orientation: Orientation::from_zyx(Zyx {
            a: Angle::rad(a),
            b: Angle::rad(b) - OFFSET,
            c: Angle::rad(c),
        }),
    }
}
