//! The most torque that each axis needs, proven everywhere along a program.
//!
//! Of each part of a motion the weight of the arm is enclosed with its derivatives, as the axes are. What
//! else the axes need to move is linear in their accelerations and quadratic in their rates, and is enclosed
//! by intervals of both. It counts where the motion has a constant rate: on arcs the control slows down, and
//! moves of all axes go by a course that only it knows. Where forces of the blade are known, whatever they
//! may be at any stretch of its edge is added.

use crate::arm::{JOINTS, State};
use crate::arms::Arms;
use crate::cuts::{Cut, Cuts};
use crate::drives::{Most, Torques};
use crate::peaks::{Held, Peak, Sought, Whole, peaks};
use crate::turn::Turn;
use core::array;
use vcutc_backend_api::ir::OpId;
use vcutc_geometry::number::{Along, Interval};
use vcutc_motion::parts::{Motions, Moving};
use vcutc_motion::path::Part;
use vcutc_motion::rigs::Rigs;

/// Torques do not matter below this share of the limit of their axis, or where that is not known of what any axis needs to stand still.
const LEAST: f64 = 2e-2;
/// Half the length of a part that shows what one place needs, in parts of a motion.
const SHORT: f64 = 1e-4;
/// What is below this is noise of the arithmetic, in Nm.
const NOISE: f64 = 1e-6;

/// What the torques along a program are computed from.
pub(crate) struct Demand<'p> {
    pub(crate) motions: Motions<'p>,
    pub(crate) rigs: &'p Rigs<'p>,
    pub(crate) arms: &'p Arms,
    /// The arms where nothing weighs.
    pub(crate) weightless: Arms,
    pub(crate) pushing: Pushing<'p>,
}

/// What pushes the blades of a program.
#[derive(Clone, Copy)]
pub enum Pushing<'p> {
    /// Known forces in these cuts.
    By(&'p Cuts<'p>),
    /// Nothing: it cuts in the air.
    Nothing,
    NotKnown,
}

/// Torques of all axes on a part, in Nm: whatever they may be.
#[derive(Clone, Copy)]
struct Enclosed {
    weight: [Interval; JOINTS],
    motion: [Interval; JOINTS],
    cutting: [Interval; JOINTS],
}

impl Enclosed {
    fn of(&self, axis: usize) -> Interval {
        self.weight[axis] + self.motion[axis] + self.cutting[axis]
    }

    /// What is surely needed at some time, either way: the motion is not known closer, but any of the forces may come.
    fn reached(&self, axis: usize) -> [f64; 2] {
        let (weight, motion, cutting) = (self.weight[axis], self.motion[axis], self.cutting[axis]);
        [
            weight.low + motion.low + cutting.high,
            -(weight.high + motion.high + cutting.low),
        ]
    }

    fn met(&self, axis: usize) -> f64 {
        let [one, other] = self.reached(axis);
        one.max(other)
    }
}

/// How many places of a part are looked at.
const PLACES: usize = 3;
/// They are its beginning, its middle and its end.
const AT_PLACES: [fn(Along) -> Interval; PLACES] = [Along::begin, Along::middle, Along::end];

/// Torques on a part of a motion.
struct OnPart {
    everywhere: Enclosed,
    /// At its beginning, in the middle and at its end.
    places: [Enclosed; PLACES],
}

impl OnPart {
    /// The number of the place where an axis needs the most.
    fn worst(&self, axis: usize) -> usize {
        let larger = |one: usize, other: usize| {
            let is_larger = self.places[other].met(axis) > self.places[one].met(axis);
            if is_larger { other } else { one }
        };
        (1..PLACES).fold(0, larger)
    }

    fn held(&self, axis: usize) -> Held {
        let met = self.places[self.worst(axis)].met(axis);
        Held {
            met: if met > NOISE { met } else { 0.0 },
            most: self.everywhere.of(axis).magnitude(),
        }
    }
}

impl Demand<'_> {
    /// The most that each axis needs; none of a program that moves nothing, and where that cannot be proven. The axes may use
    /// the share `allowed` of their limits.
    pub(crate) fn most(&self, limits: Option<[f64; JOINTS]>, allowed: f64) -> Option<[Most; JOINTS]> {
        let motions: Option<Vec<Whole>> = self
            .motions
            .ops()
            .map(|op| {
                // Most motions are far from what matters, and coarse bounds show it.
                let parts = self.motions.moving(op)?.parts.div_ceil(2);
                Some(Whole { op, parts })
            })
            .collect();
        let largest = self.largest_weight();
        let sought = array::from_fn(|axis| {
            let limit = limits.map(|limits| limits[axis]);
            Sought {
                least: LEAST * limit.unwrap_or(largest),
                limit: limit.map(|limit| limit * allowed),
            }
        });
        let found: [Peak; JOINTS] = peaks(&motions?, &sought, |op, part| {
            let on_part = self.on(op, part)?;
            Some(array::from_fn(|axis| on_part.held(axis)))
        })?;
        let each = found.iter().enumerate();
        let most: Vec<Most> = each
            .map(|(axis, peak)| self.at(axis, peak, sought[axis].least))
            .collect::<Option<_>>()?;
        most.try_into().ok()
    }

    /// The most that any axis needs to stand still where an op ends.
    fn largest_weight(&self) -> f64 {
        let weights = self.motions.ops().filter_map(|op| {
            let arm = self.arms.with(self.rigs.tool_during(op))?;
            Some(arm.weight(&self.motions.end(op)?))
        });
        weights.flatten().fold(0.0, |most, weight| weight.abs().max(most))
    }

    /// The torques where an axis needs the most. Up to `least` that is not looked for.
    fn at(&self, axis: usize, peak: &Peak, least: f64) -> Option<Most> {
        // The motion of a short part is known as closely as its weight.
        let worst = f64::from(u8::try_from(self.on(peak.op, peak.part)?.worst(axis)).ok()?);
        let half = peak.part.half.min(SHORT);
        let place = peak.part.middle + peak.part.half * (worst - 1.0);
        let short = Part {
            middle: place.clamp(half, 1.0 - half),
            half,
        };
        let on_part = self.on(peak.op, short)?;
        let worst = &on_part.places[on_part.worst(axis)];
        let [one, other] = worst.reached(axis);
        let push = |interval: Interval| if one < other { interval.low } else { interval.high };
        let torques = Torques {
            weight: worst.weight.map(Interval::middle),
            motion: worst.motion.map(Interval::middle),
            cutting: worst.cutting.map(push),
        };
        peak.most.is_finite().then_some(Most {
            op: peak.op,
            done: (peak.most > least).then_some(short.middle),
            torques,
            most: peak.most,
        })
    }

    /// The torques on a part. None where it is too long to say.
    fn on(&self, op: OpId, part: Part) -> Option<OnPart> {
        let tool = self.rigs.tool_during(op);
        let moving = self.motions.moving(op)?;
        let axes = moving.axes_on(part)?;
        let arm = self.arms.with(tool)?;
        let turns = arm.turns_along(axes);
        let weight = arm.weight_after(&turns);
        let motion = match speed(&moving, part) {
            None => [Interval::ZERO; JOINTS],
            Some(speed) => self.weightless.with(tool)?.torques(&state(&turns, axes, speed)),
        };
        let parts = |view: fn(Along) -> Interval, cutting| Enclosed {
            weight: weight.map(view),
            motion,
            cutting,
        };
        let Some((cuts, cut)) = self.cut(op) else {
            let none = [Interval::ZERO; JOINTS];
            return Some(OnPart {
                everywhere: parts(Along::value, none),
                places: AT_PLACES.map(|view| parts(view, none)),
            });
        };
        let columns = cuts.columns_on(cut.tool, axes);
        let push = cuts.push_on(cut, part)?;
        let turned = push.turned_on_axes(&columns);
        let [begin, middle, end] = AT_PLACES;
        let pushed = push.on_axes(&columns, [Along::value, begin, middle, end]);
        let [most, places @ ..] = pushed.map(|view| view.map(|torque| -torque));
        Some(OnPart {
            everywhere: parts(Along::value, array::from_fn(|axis| most[axis] + turned[axis])),
            places: array::from_fn(|place| parts(AT_PLACES[place], places[place])),
        })
    }

    /// A cut whose forces count.
    fn cut(&self, op: OpId) -> Option<(&Cuts<'_>, &Cut<'_>)> {
        let Pushing::By(cuts) = self.pushing else {
            return None;
        };
        Some((cuts, cuts.get(op)?))
    }
}

/// How fast a part is gone through, in its own parameter (from -1 to 1) a second, where that is constant.
fn speed(moving: &Moving<'_>, part: Part) -> Option<f64> {
    Some(1.0 / (moving.lasts? * part.half))
}

/// How an arm moves that goes through a part so fast, everywhere on it.
fn state(turns: &[Turn<Along>; JOINTS], axes: [Along; JOINTS], speed: f64) -> State<Interval> {
    State {
        turns: turns.map(|Turn { sine, cosine }| Turn {
            sine: sine.value(),
            cosine: cosine.value(),
        }),
        rates: axes.map(|axis| axis.rate() * speed),
        accelerations: axes.map(|axis| axis.bend() * (speed * speed)),
    }
}
