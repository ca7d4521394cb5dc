//! Where the axes are all along a program: at the end of every op, and close enough between.

use super::moves::{numbered, paths};
use super::path::{Course, Followed};
use super::rig::Rig;
use super::rigs::Rigs;
use rayon::prelude::*;
use vcutc_backend_api::ir::{Axis, AxisKind, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_machine::kinematics::Joints;

/// Farthest that the tip moves from one sample to the next, in mm.
pub const CLOSE: f64 = 5.0;
/// Farthest that the blade, or an axis that moves by itself, turns from one sample to the next, in rad: 2 deg.
pub const CLOSE_TURN: f64 = core::f64::consts::PI / 90.0;
/// Most samples of one motion.
const MOST_SAMPLES: f64 = 100_000.0;
/// About how many samples are held at once.
const HELD: f64 = 65_536.0;

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

    /// Close enough where an op is narrower than what can be seen of it: on 25 mm of a robot's way an axis is within a few
    /// thousandths of a degree of a straight line between samples.
    pub const APART: Self = Self {
        way: 5.0 * CLOSE,
        turn: 2.5 * CLOSE_TURN,
    };
}

/// The axes at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub op: OpId,
    /// How much of its motion is done, from 0 (exclusive) to 1.
    pub done: f64,
    /// The axes.
    pub joints: Joints,
}

/// What an op moves, sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The axes when it begins; not known of the first motion of a machine without a home.
    pub start: Option<Joints>,
    /// The samples, the last one at its end.
    pub samples: Vec<Sample>,
}

/// The samples of every op that moves, in order.
///
/// # Errors
/// What `take` returns.
pub fn trajectory<E>(
    reached: &ReachableProgram,
    rigs: &Rigs<'_>,
    spacing: &Spacing,
    mut take: impl FnMut(Sample) -> Result<(), E>,
) -> Result<(), E> {
    let samples = |motion: Motion| motion.samples;
    motions(reached, rigs, spacing, samples, |samples| {
        samples.into_iter().try_for_each(&mut take)
    })
}

/// What is made of every op that moves, in order. So many ops are sampled at once as have [`HELD`] samples, on all processors.
///
/// # Errors
/// What `take` returns.
pub fn motions<T: Send, E>(
    reached: &ReachableProgram,
    rigs: &Rigs<'_>,
    spacing: &Spacing,
    make: impl Fn(Motion) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let paths = paths(reached.program());
    let mut held = 0.0;
    let mut batch: Vec<Moved<'_>> = Vec::new();
    let mut flush = |batch: &mut Vec<Moved<'_>>| -> Result<(), E> {
        let made: Vec<T> = batch
            .par_drain(..)
            .map(|moved| make(moved.sampled(reached, rigs.during(moved.op))))
            .collect();
        made.into_iter().try_for_each(&mut take)
    };
    for (op, path) in numbered(&paths) {
        let Some(end) = reached.axes_after(op).map(|end| end.0) else {
            continue;
        };
        if *path == Path::Still {
            continue;
        }
        let start = reached.axes_before(op).map(|start| start.0);
        let moved = Moved::of(rigs.during(op), spacing, (op, path), start, end);
        held += moved.steps;
        batch.push(moved);
        if held >= HELD {
            flush(&mut batch)?;
            held = 0.0;
        }
    }
    flush(&mut batch)
}

/// An op that moves, before it is sampled.
struct Moved<'l> {
    op: OpId,
    path: &'l Path,
    start: Option<Joints>,
    end: Joints,
    /// Into how many steps it is divided.
    steps: f64,
}

impl<'l> Moved<'l> {
    fn of(
        rig: &Rig<'_>,
        spacing: &Spacing,
        (op, path): (OpId, &'l Path),
        start: Option<Joints>,
        end: Joints,
    ) -> Self {
        let steps = match (path, start) {
            (Path::Home | Path::Change | Path::Axes(_), Some(start)) => {
                axis_steps(rig.axes, spacing, &start, &end)
            }
            (Path::Linear(line), Some(_)) => course_steps(spacing, line),
            (Path::Still, _) | (_, None) => 1.0,
        };
        Self {
            op,
            path,
            start,
            end,
            steps: steps.clamp(1.0, MOST_SAMPLES),
        }
    }

    fn sampled(&self, reached: &ReachableProgram, rig: &Rig<'_>) -> Motion {
        let &Self { op, start, end, .. } = self;
        let mut samples = match (self.path, start) {
            (Path::Home | Path::Change | Path::Axes(_), Some(start)) => fractions(self.steps)
                .map(|done| Sample {
                    op,
                    done,
                    joints: core::array::from_fn(|axis| start[axis] + (end[axis] - start[axis]) * done),
                })
                .collect(),
            (Path::Linear(line), Some(start)) => self.along(reached, rig, line, &start),
            (Path::Still, _) | (_, None) => Vec::new(),
        };
        samples.push(Sample {
            op,
            done: 1.0,
            joints: end,
        });
        Motion { start, samples }
    }

    /// The samples of a course, but its end.
    fn along(
        &self,
        reached: &ReachableProgram,
        rig: &Rig<'_>,
        line: &LinearSegment,
        start: &Joints,
    ) -> Vec<Sample> {
        let op = self.op;
        let course = Course::of(reached.program(), line);
        let (Some(course), Some(branch)) = (course, reached.branch_after(op)) else {
            return Vec::new();
        };
        let Some(followed) = Followed::new(rig, &course, branch, [start, &self.end]) else {
            return Vec::new();
        };
        let mut near = *start;
        fractions(self.steps)
            .filter_map(|done| {
                let joints = followed.joints_at(done, &near)?;
                near = joints;
                Some(Sample { op, done, joints })
            })
            .collect()
    }
}

/// `1/n`, `2/n`, ... up to but without 1.
fn fractions(steps: f64) -> impl Iterator<Item = f64> {
    core::iter::successors(Some(1.0), |step| Some(step + 1.0))
        .take_while(move |&step| step < steps)
        .map(move |step| step / steps)
}

fn course_steps(spacing: &Spacing, line: &LinearSegment) -> f64 {
    let (length, turn) = (line.length().to_mm(), line.turn.to_rad());
    // On a small arc the tip goes far aside between two places that are near to each other.
    let sweep = line.arc().map_or(0.0, |arc| arc.sweep().to_rad());
    (length / spacing.way)
        .max(turn / spacing.turn)
        .max(sweep / ARC)
        .ceil()
}

/// Farthest that the way of the tip turns on an arc from one sample to the next, in rad.
const ARC: f64 = core::f64::consts::PI / 12.0;

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
