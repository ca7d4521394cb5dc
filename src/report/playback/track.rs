//! Where the axes are all along a program, thinned out.
//!
//! The axes at the end of every op are kept, and between them the fewest places (knots) from which the way of the axes can
//! be reproduced. Between knots axes follow the cubic through the four nearest ones of the same op, its start among them; a
//! motion of all axes needs no knots of its own, a straight cut one or two. Knots are added until every sample of
//! [`motions`] at [`SPACING`] is reproduced well within [`TURN_ERROR`] and [`WAY_ERROR`], so that closer samples are
//! within them.
//!
//! Values are kept in 16 bits over the range that the axis uses, which the errors take into account.

use super::timeline::place;
use core::convert::Infallible;
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_machine::kinematics::Joints;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::trajectory::{Motion, Spacing, motions};

/// Largest error of a rotary axis, in rad: 0.05 deg.
pub const TURN_ERROR: f64 = core::f64::consts::PI / 3600.0;
/// Largest error of a linear axis, in mm.
pub const WAY_ERROR: f64 = 0.2;
/// How close the samples are that are reproduced: 10 mm of the tip's way, 2.5 deg of turning.
pub const SPACING: Spacing = Spacing {
    way: 10.0,
    turn: core::f64::consts::PI / 72.0,
};
/// Share of the errors that thinning may use up; the rest is for what happens between samples, and for 16 bits. These are
/// half of a hundredth of a degree over two whole turns, and less than 0.08 mm over 10 m.
const FOR_THINNING: f64 = 0.4;
/// Steps of 16 bits.
const STEPS: f64 = 65_535.0;

/// The axes all along a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The axes before the first op.
    pub start: Joints,
    /// How many knots each op has, its end included; none where it moves nothing.
    pub counts: Vec<u32>,
    /// How much of its op's motion is done at each knot, in 65535ths.
    pub done: Vec<u16>,
    /// Each axis at each knot, in steps above its lowest value.
    pub values: Vec<u16>,
    /// The lowest value of each axis, in rad or mm.
    pub low: Vec<f64>,
    /// The step of each axis, in rad or mm.
    pub step: Vec<f64>,
}

/// The axes at a place of an op's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// How much of the way is done, from 0 to 1.
    pub done: f64,
    /// The axes.
    pub joints: Joints,
}

impl Track {
    /// Of a program and the machine that carries it out.
    #[must_use]
    pub fn of(reached: &ReachableProgram, rigs: &Rigs<'_>) -> Self {
        let axes = rigs.first().axes;
        let mut thinned = Thinned::new(reached);
        let made = |motion: Motion| KnotsOfOp::of(axes, &motion);
        let taken: Result<(), Infallible> = motions(reached, rigs, &SPACING, made, |of_op| {
            thinned.take(of_op);
            Ok(())
        });
        match taken {
            Ok(()) => thinned.packed(axes),
            Err(never) => match never {},
        }
    }
}

/// The axes at a place of the way through these knots, the first at its start. Fewer than four give what they can: two a
/// straight way.
#[must_use]
pub fn between(knots: &[Knot], done: f64) -> Joints {
    let after = knots.partition_point(|knot| knot.done < done);
    let first = after.saturating_sub(2).min(knots.len().saturating_sub(4));
    let near = knots.get(first..knots.len().min(first + 4)).unwrap_or_default();
    let mut joints = Joints::default();
    for (i, knot) in near.iter().enumerate() {
        let others = near.iter().enumerate().filter(|&(j, _)| j != i);
        let weight: f64 = others
            .map(|(_, other)| (done - other.done) / (knot.done - other.done))
            .product();
        for (joint, value) in joints.iter_mut().zip(knot.joints) {
            *joint += weight * value;
        }
    }
    joints
}

/// The knots of an op.
struct KnotsOfOp {
    op: Option<OpId>,
    /// Where its axes begin.
    from: Joints,
    knots: Vec<Knot>,
}

impl KnotsOfOp {
    fn of(axes: &[Axis], motion: &Motion) -> Self {
        let samples: Vec<Knot> = (motion.samples.iter())
            .map(|sample| Knot {
                done: in_steps(sample.done),
                joints: sample.joints,
            })
            .collect();
        // Without a home it is not known where the axes begin: they are where the first motion brings them.
        let ends = samples.last().map(|end| end.joints).unwrap_or_default();
        let from = motion.start.unwrap_or(ends);
        Self {
            op: motion.samples.first().map(|sample| sample.op),
            from,
            knots: fewest(axes, from, &samples),
        }
    }
}

/// Knots as they are found, op by op.
struct Thinned {
    start: Option<Joints>,
    counts: Vec<u32>,
    knots: Vec<Knot>,
}

impl Thinned {
    fn new(reached: &ReachableProgram) -> Self {
        let program = reached.program();
        let home = program.cell.as_ref().and_then(|cell| cell.home);
        Self {
            start: home.map(|home| home.0),
            counts: vec![0; program.ops.len()],
            knots: Vec::new(),
        }
    }

    fn take(&mut self, of_op: KnotsOfOp) {
        self.start.get_or_insert(of_op.from);
        if let Some(count) = of_op.op.and_then(|op| self.counts.get_mut(place(op))) {
            *count = u32::try_from(of_op.knots.len()).unwrap_or(u32::MAX);
        }
        self.knots.extend(of_op.knots);
    }

    fn packed(self, axes: &[Axis]) -> Track {
        let start = self.start.unwrap_or_default();
        let span = |axis: usize| {
            let values = self.knots.iter().map(|knot| knot.joints[axis]);
            values.fold([start[axis]; 2], |[low, high], value| {
                [low.min(value), high.max(value)]
            })
        };
        let spans: Vec<[f64; 2]> = (0..axes.len().min(MOST_AXES)).map(span).collect();
        // One step more than the range has, so that the values before the first op, which most programs come back to, lie on
        // a step exactly.
        let steps = |[low, high]: [f64; 2]| (high - low).max(f64::MIN_POSITIVE) / (STEPS - 1.0);
        let spans: Vec<[f64; 2]> = spans
            .iter()
            .zip(start)
            .map(|(&span, start)| {
                let step = steps(span);
                let low = start - ((start - span[0]) / step).ceil() * step;
                [low, low + (span[1] - span[0])]
            })
            .collect();
        let values = self.knots.iter().flat_map(|knot| {
            let axes = spans.iter().zip(knot.joints);
            axes.map(move |(&span, value)| whole((value - span[0]) / steps(span)))
        });
        Track {
            start,
            done: self.knots.iter().map(|knot| whole(knot.done * STEPS)).collect(),
            values: values.collect(),
            low: spans.iter().map(|span| span[0]).collect(),
            step: spans.iter().map(|&span| steps(span)).collect(),
            counts: self.counts,
        }
    }
}

/// A share that 16 bits say exactly.
fn in_steps(done: f64) -> f64 {
    (done * STEPS).round() / STEPS
}

/// The nearest whole number that 16 bits hold.
fn whole(value: f64) -> u16 {
    // The bounds make the conversion exact.
    value.round().clamp(0.0, STEPS) as u16
}

/// The fewest of an op's samples, of those spread evenly over its way, from which the others can be computed.
fn fewest(axes: &[Axis], from: Joints, samples: &[Knot]) -> Vec<Knot> {
    let start = Knot {
        done: 0.0,
        joints: from,
    };
    let all = samples.len();
    let mut pieces = 1;
    while pieces < all {
        let spread = (1..=pieces).filter_map(|piece| samples.get((piece * all).div_ceil(pieces) - 1));
        let knots: Vec<Knot> = core::iter::once(&start).chain(spread).copied().collect();
        if samples.iter().all(|sample| is_shown(axes, &knots, sample)) {
            return knots.into_iter().skip(1).collect();
        }
        pieces += (pieces / 3).max(1);
    }
    samples.to_vec()
}

fn is_shown(axes: &[Axis], knots: &[Knot], sample: &Knot) -> bool {
    let shown = between(knots, sample.done);
    axes.iter()
        .zip(shown.iter().zip(sample.joints))
        .all(|(axis, (shown, joint))| {
            let most = match axis.kind {
                AxisKind::Rotary => TURN_ERROR,
                AxisKind::Linear => WAY_ERROR,
            };
            (shown - joint).abs() <= most * FOR_THINNING
        })
}
