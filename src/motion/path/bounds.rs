//! What the axes do on a span, and whether that keeps the bounds.

use super::march::{Effort, Tried};
use super::types::{Clearance, Proof, Singularity, Violation};
use core::f64::consts::{PI, TAU};
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES};
use vcutc_geometry::number::Interval;
use vcutc_machine::kinematics::Joints;

/// What an axis may be beyond its range (rad, mm), and a pose nearer to a singular one: rounding.
const SLACK: f64 = 1e-9;
/// By what part an axis may be too fast: rounding.
const RATE_SLACK: f64 = 1e-9;
/// By how much ranges may be too wide, in rad or mm, where an axis is at its limit.
const TIGHT: (f64, f64) = (0.1 * PI / 180.0, 0.1);
/// By how much rates may be too wide, in parts of the axis' highest, where an axis is as fast as it can be.
const TIGHT_RATE: f64 = 0.01;
/// Rates below this (rad/s, mm/s) are slow for an axis whose highest is not known.
const UNKNOWN_RATE: f64 = 1.0;
/// By what part of the room to its limit or to a singular pose, or of the rate that is left to it, a bound may be worse than the true one.
const ROOM: (f64, f64) = (0.02, 0.1);

/// Bounds that are off by no more than this, in rad or mm (a second), are as good as they can be.
const NO_EXCESS: f64 = 1e-12;

/// What the axes do on a span, proven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// At its beginning; rotary axes up to whole turns.
    pub(super) begin: [Interval; MOST_AXES],
    /// On all of it, on the same turns.
    pub(super) value: [Interval; MOST_AXES],
    /// At its end, on the same turns.
    pub(super) end: [Interval; MOST_AXES],
    /// How fast they move on it, a course.
    pub(super) rate: [Interval; MOST_AXES],
    /// By how much `value` may exceed the true range.
    pub(super) excess: Joints,
    /// By how much `rate` may exceed the true range.
    pub(super) rate_excess: Joints,
    /// How near singular poses the machine comes.
    pub(super) clearance: Clearance,
}

impl Stretch {
    /// The same on the turns on which it continues `from`.
    fn continued(mut self, from: &[Interval; MOST_AXES], axes: &[Axis]) -> Result<Self, Violation> {
        for (i, axis) in axes.iter().enumerate().take(MOST_AXES) {
            let (begin, from) = (self.begin[i], from[i]);
            // Two enclosures of one angle up to turns: narrow enough to tell one turn from the next?
            let is_narrow = begin.width() + from.width() < PI;
            if !is_narrow {
                return Err(Violation::OutOfReach);
            }
            let turns = match axis.kind {
                AxisKind::Rotary => ((from.middle() - begin.middle()) / TAU).round(),
                AxisKind::Linear => 0.0,
            };
            for interval in [&mut self.begin[i], &mut self.value[i], &mut self.end[i]] {
                *interval = *interval + Interval::exactly(TAU) * turns;
            }
        }
        Ok(self)
    }
}

/// Bounds that the axes have to keep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<'a> {
    pub(super) axes: &'a [Axis],
    pub(super) least: Clearance,
    /// In s.
    pub(super) duration: f64,
}

impl Bounds<'_> {
    /// Whether the ranges hold on a stretch; if not, which axis leaves its own.
    pub(super) fn hold_values(&self, values: &[Interval; MOST_AXES]) -> Result<(), Violation> {
        limits(self.axes, values).map_or(Ok(()), |(axis, value)| Err(Violation::Limit { axis, value }))
    }

    /// Whether all bounds are kept on a stretch; if not, which is not.
    pub(super) fn hold(&self, found: &Stretch) -> Result<(), Violation> {
        self.keep_clear(&found.clearance)?;
        self.hold_values(&found.value)?;
        self.hold_rates(&found.rate)
    }

    /// Whether the axes are slow enough at rates a course; if not, which is not.
    pub(super) fn hold_rates(&self, rates: &[Interval; MOST_AXES]) -> Result<(), Violation> {
        for (i, axis) in self.axes.iter().enumerate().take(MOST_AXES) {
            let rate = rates[i].magnitude() / self.duration;
            // What is not a number is not slow enough.
            let is_slow_enough = rate <= axis.rate.map_or(f64::MAX, |most| most * (1.0 + RATE_SLACK));
            if !is_slow_enough {
                return Err(Violation::Rate { axis: i, rate });
            }
        }
        Ok(())
    }

    pub(super) fn keep_clear(&self, clearance: &Clearance) -> Result<(), Violation> {
        let least = &self.least;
        let broken = if clearance.shoulder < least.shoulder - SLACK {
            Singularity::Shoulder(clearance.shoulder)
        } else if clearance.elbow < least.elbow - SLACK {
            Singularity::Elbow(clearance.elbow)
        } else if clearance.wrist < least.wrist - SLACK {
            Singularity::Wrist(clearance.wrist)
        } else {
            return Ok(());
        };
        Err(Violation::Singular(broken))
    }

    /// How many times better the bounds are than they have to be, for the axis for which they are worst. Far from limits they
    /// may be worse: what is asked for is a margin, and that it is proven, not its last digit.
    fn quality(&self, found: &Stretch) -> f64 {
        let to_singular = found.clearance.wrist.min(found.clearance.elbow);
        let qualities = self.axes.iter().enumerate().take(MOST_AXES).map(|(i, axis)| {
            let value = found.value[i];
            let tight = match axis.kind {
                AxisKind::Rotary => TIGHT.0,
                AxisKind::Linear => TIGHT.1,
            };
            let room = (value.low - axis.min).min(axis.max - value.high);
            let room = match axis.kind {
                // Which turn of such an axis is used may be settled later, and with it the room.
                AxisKind::Rotary if axis.max - axis.min >= TAU => 0.0,
                AxisKind::Rotary => room.min(to_singular),
                AxisKind::Linear => room,
            };
            let of_range = tight.max(room * ROOM.0) / found.excess[i].max(NO_EXCESS);
            let rate = found.rate[i].magnitude() / self.duration;
            let may_exceed = match axis.rate {
                Some(most) => (TIGHT_RATE * most).max((most - rate) * ROOM.1),
                None => TIGHT_RATE * rate.max(UNKNOWN_RATE),
            };
            let of_rate = may_exceed / (found.rate_excess[i] / self.duration).max(NO_EXCESS);
            of_range.min(of_rate)
        });
        qualities.fold(f64::INFINITY, f64::min)
    }
}

/// The first axis that leaves its range, and how far out it goes.
pub(super) fn limits(axes: &[Axis], values: &[Interval; MOST_AXES]) -> Option<(usize, f64)> {
    axes.iter()
        .zip(values)
        .enumerate()
        .find_map(|(i, (axis, value))| {
            let (min, max) = (axis.min - SLACK, axis.max + SLACK);
            if value.within(min, max) {
                None
            } else if value.low < min {
                Some((i, value.low))
            } else {
                Some((i, value.high))
            }
        })
}

/// A proof under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<'a> {
    bounds: Bounds<'a>,
    proof: Proof,
    end: [Interval; MOST_AXES],
}

impl<'a> Progress<'a> {
    pub(super) fn new(bounds: Bounds<'a>, start: &Joints) -> Self {
        let unused = |i: usize| i >= bounds.axes.len();
        Self {
            bounds,
            proof: Proof {
                start: *start,
                end: *start,
                low: *start,
                high: *start,
                rate: [0.0; MOST_AXES],
                clearance: Clearance::UNLIMITED,
                solves: 0,
            },
            end: core::array::from_fn(|i| {
                if unused(i) {
                    Interval::ZERO
                } else {
                    Interval::exactly(start[i])
                }
            }),
        }
    }

    /// Where the proven part ends.
    pub(super) fn end(&self) -> Joints {
        self.end.map(Interval::middle)
    }

    /// Adds a stretch if it keeps the bounds.
    pub(super) fn add(&mut self, found: Result<Stretch, Violation>, effort: Effort) -> Tried<Violation> {
        let found = found.and_then(|found| found.continued(&self.end, self.bounds.axes));
        match found.and_then(|found| self.bounds.hold(&found).map(|()| found)) {
            Err(why) => Tried::Refused(why),
            Ok(found) => {
                let quality = self.bounds.quality(&found);
                if effort == Effort::Tight && quality < 1.0 {
                    return Tried::Loose(quality);
                }
                self.extend(&found);
                Tried::Proven(quality)
            }
        }
    }

    fn extend(&mut self, by: &Stretch) {
        for i in 0..self.bounds.axes.len().min(MOST_AXES) {
            self.proof.low[i] = self.proof.low[i].min(by.value[i].low);
            self.proof.high[i] = self.proof.high[i].max(by.value[i].high);
            let rate = by.rate[i].magnitude() / self.bounds.duration;
            self.proof.rate[i] = self.proof.rate[i].max(rate);
        }
        self.end = by.end;
        self.proof.clearance = self.proof.clearance.least(&by.clearance);
    }

    /// The proof of a course that ends at `end`.
    pub(super) const fn done(self, end: Joints, solves: u32) -> Proof {
        Proof {
            end,
            solves,
            ..self.proof
        }
    }
}

impl Clearance {
    /// Infinitely far from all singular poses.
    pub const UNLIMITED: Self = Self {
        wrist: f64::INFINITY,
        elbow: f64::INFINITY,
        shoulder: f64::INFINITY,
    };

    /// The lesser of both.
    #[must_use]
    pub const fn least(&self, other: &Self) -> Self {
        Self {
            wrist: self.wrist.min(other.wrist),
            elbow: self.elbow.min(other.elbow),
            shoulder: self.shoulder.min(other.shoulder),
        }
    }
}

impl Violation {
    /// Itself if its number is one.
    pub(super) const fn finite(self) -> Self {
        let number = match self {
            Self::OutOfReach => return self,
            Self::Limit { value, .. } => value,
            Self::Rate { rate, .. } => rate,
            Self::Singular(
                Singularity::Wrist(left) | Singularity::Elbow(left) | Singularity::Shoulder(left),
            ) => left,
        };
        if number.is_finite() {
            self
        } else {
            Self::OutOfReach
        }
    }
}
