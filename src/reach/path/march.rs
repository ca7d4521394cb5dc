//! Goes along a course span by span, each as long as its proof allows.

use super::course::Span;
use super::interval::Interval;
use super::{Breach, Clearance, Proof, Singularity, Violation};
use crate::kinematics::Joints;
use core::f64::consts::{PI, TAU};
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES};

/// Spans begin and end at multiples of this part of a course: of a cut of 1 m, 0.06 um.
const TICKS: u32 = 1 << 24;
/// Spans this short are not made shorter for the sake of tighter bounds.
const FINE: u32 = TICKS / 256;
/// Most spans that are tried on one course.
const MOST_SOLVES: u32 = 4096;
/// What an axis may be beyond its range (rad, mm), and a pose nearer to a singular one: rounding.
const SLACK: f64 = 1e-9;
/// By what part an axis may be too fast: rounding.
const RATE_SLACK: f64 = 1e-9;

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

/// Bounds that the axes have to keep, and how well to show it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<'a> {
    pub(super) axes: &'a [Axis],
    pub(super) least: Clearance,
    /// In s.
    pub(super) duration: f64,
}

/// Joins the stretches of a course, from the first to the last.
///
/// `stretch` proves one span; it is given the axes at the span's beginning. A span that it refuses, or on which bounds are
/// not kept by its enclosures, is halved. So the spans before the one that can be made no shorter are proven, and what
/// breaks there is the first thing that breaks.
pub(super) fn march(
    bounds: &Bounds<'_>,
    start: &Joints,
    mut stretch: impl FnMut(Span, &Joints) -> Result<Stretch, Violation>,
) -> Result<Proof, Breach> {
    let mut proof = Proof {
        start: *start,
        end: *start,
        low: [f64::INFINITY; MOST_AXES],
        high: [f64::NEG_INFINITY; MOST_AXES],
        rate: [0.0; MOST_AXES],
        clearance: Clearance::UNLIMITED,
        solves: 0,
    };
    let mut end = start.map(Interval::exactly);
    let (mut at, mut length) = (0, TICKS);
    // After a refusal the next span is not tried longer: it would most often be refused again.
    let mut grows = true;
    while at < TICKS {
        length = length.min(TICKS - at);
        let span = span(at, length);
        proof.solves += 1;
        let tried = stretch(span, &proof.end)
            .and_then(|found| found.continued(&end, bounds.axes))
            .and_then(|found| bounds.hold(&found).map(|()| found));
        match tried {
            Ok(found) if length <= FINE || bounds.is_tight(&found) => {
                proof.extend(&found, bounds.duration);
                end = found.end;
                at += length;
                length = if grows { length * 2 } else { length };
                grows = true;
            }
            Err(what) if length == 1 || proof.solves >= MOST_SOLVES => {
                return Err(Breach {
                    at: span.middle,
                    what: what.finite(),
                });
            }
            Ok(_) | Err(_) => {
                length = (length / 2).max(1);
                grows = false;
            }
        }
    }
    Ok(proof)
}

/// Exact, since ticks are powers of two.
fn span(at: u32, length: u32) -> Span {
    let tick = 1.0 / f64::from(TICKS);
    let half = 0.5 * f64::from(length);
    Span {
        middle: (f64::from(at) + half) * tick,
        half: half * tick,
    }
}

impl Stretch {
    /// The same on the turns on which it continues `from`.
    fn continued(mut self, from: &[Interval; MOST_AXES], axes: &[Axis]) -> Result<Self, Violation> {
        for (i, axis) in axes.iter().enumerate().take(MOST_AXES) {
            let (begin, from) = (self.begin[i], from[i]);
            // Two enclosures of one angle up to turns: narrow enough to tell one turn from the next?
            if !(begin.width() + from.width() < PI) {
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

impl Bounds<'_> {
    /// Whether all bounds are kept on a stretch; if not, which is not.
    fn hold(&self, found: &Stretch) -> Result<(), Violation> {
        self.keeps_clear(&found.clearance)?;
        for (i, axis) in self.axes.iter().enumerate().take(MOST_AXES) {
            let value = found.value[i];
            if !value.within(axis.min - SLACK, axis.max + SLACK) {
                let beyond = if value.low < axis.min - SLACK {
                    value.low
                } else {
                    value.high
                };
                return Err(Violation::Limit {
                    axis: i,
                    value: beyond,
                });
            }
            let rate = found.rate[i].magnitude() / self.duration;
            // Written so that what is no number does not pass.
            if axis.rate.is_some_and(|most| !(rate <= most * (1.0 + RATE_SLACK))) || !rate.is_finite() {
                return Err(Violation::Rate { axis: i, rate });
            }
        }
        Ok(())
    }

    fn keeps_clear(&self, clearance: &Clearance) -> Result<(), Violation> {
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

    /// Whether the bounds found are near the true ones: within 0.1 deg or mm, and a hundredth of the axis' highest rate.
    fn is_tight(&self, found: &Stretch) -> bool {
        const EXCESS: (f64, f64) = (0.1 * core::f64::consts::PI / 180.0, 0.1);
        const RATE_EXCESS: f64 = 0.01;
        self.axes.iter().enumerate().take(MOST_AXES).all(|(i, axis)| {
            let excess = match axis.kind {
                AxisKind::Rotary => EXCESS.0,
                AxisKind::Linear => EXCESS.1,
            };
            let in_rate = axis
                .rate
                .is_none_or(|most| found.rate_excess[i] / self.duration <= RATE_EXCESS * most);
            found.excess[i] <= excess && in_rate
        })
    }
}

impl Proof {
    fn extend(&mut self, by: &Stretch, duration: f64) {
        for i in 0..MOST_AXES {
            self.low[i] = self.low[i].min(by.value[i].low);
            self.high[i] = self.high[i].max(by.value[i].high);
            self.rate[i] = self.rate[i].max(by.rate[i].magnitude() / duration);
        }
        self.end = by.end.map(Interval::middle);
        self.clearance = self.clearance.least(&by.clearance);
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
    fn finite(self) -> Self {
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
