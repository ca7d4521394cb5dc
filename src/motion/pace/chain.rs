//! Chains: pieces of a way that are gone as one course, from rest at its beginning to rest at its end.
//!
//! The way is measured in mm of the tip, so that its rate continues without a jump where one piece passes into the next. Beside the
//! axes, other things that have bounds are followed along it as if they were axes ([`TRACKS`]):
//!
//! - the parts of the programmed feed and of the programmed rate of turning that are used, of which the most is 1;
//! - the tip. On a way with the curvature `k` its acceleration is `u''` along the way and `k u'^2` across it. Both are bounded
//!   together by the sides of an octagon in the circle of the path's acceleration, `|u''| + t k u'^2 <= a` and
//!   `t |u''| + k u'^2 <= a` with `t = tan(22.5 deg)`, which leaves 92 % of the circle at least. Its jerk is at most
//!   `|u'''| + 3 k u' |u''| + (k^2 + |k'|) u'^3`;
//! - the blade, which turns by a vector `w` a mm: `|w| |u''| + |w'| u'^2` is at most its acceleration.
//!
//! **Joints.** The directions of two pieces agree where they meet, but the rates of axes need not: an arc may begin to turn the blade
//! at once. The controller rounds this off within the program's blend. From so far before the joint until so far after it,
//! though not beyond the middle of a piece, rates change like a cubic with the values and slopes of both pieces at its ends.
//! In a program without a blend the machine comes to rest where a rate jumps ([`JUMP`]).
//!
//! **Bounds of jerk.** Each piece, and each joint, has ramps at its ends and a constant rate between them, as in
//! [`super::smooth`], and no acceleration where it ends. A pass forwards finds how fast the end of each can be reached, one
//! backwards how fast its beginning may be. A rest at a joint that takes less time is used.

use super::profile::Bounds;
use super::smooth::{End, Way};
use super::track::{Part, Slopes};
use super::{Kept, phase};
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES};
use vcutc_backend_api::vector::{length, minus};
use vcutc_machine::path_limits::PathLimits;

/// The axes, and after them what else has bounds.
pub(super) const TRACKS: usize = MOST_AXES + 9;

/// Parts into which a joint is divided; even.
const JOINT_PARTS: u32 = 8;
/// By what share of the largest rate a rate may jump without a rest: that of the largest kink of a chain, half a degree.
const JUMP: f64 = 0.009;
/// `tan(22.5 deg)`.
const SIDE: f64 = 0.414_213_562_373_095_1;
/// Blends below this, in mm, are none.
const NO_BLEND: f64 = 1e-6;
/// Rates that are tried between two ramps.
const TRIED: u32 = 48;
/// Halvings until a rate is found closely.
const HALVINGS: u32 = 40;

/// A piece of a chain.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// In mm.
    pub(super) length: f64,
    /// As programmed, in mm/s.
    pub(super) feed: f64,
    /// How fast the blade turns at most, as programmed, in rad/s.
    pub(super) rate: Option<f64>,
    /// How much the way bends, in rad/mm.
    pub(super) bend: f64,
    /// How the blade turns, as a vector in rad/mm.
    pub(super) spin: [f64; 3],
    /// The axes, by mm.
    pub(super) parts: Vec<Part>,
}

/// What bounds a chain.
#[derive(Clone, Debug)]
pub(super) struct Limits<'a> {
    pub(super) axes: &'a [Axis],
    /// Of axes and of what else is followed.
    pub(super) tracks: [Bounds; TRACKS],
    /// How far before and after a joint rates change at most, in mm.
    pub(super) blend: f64,
    pub(super) kept: Kept,
}

/// The bounds of all that is followed.
pub(super) fn tracks(axes: &[Bounds; MOST_AXES], path: &PathLimits) -> [Bounds; TRACKS] {
    let programmed = Bounds {
        rate: Some(1.0),
        ..Bounds::default()
    };
    let tip = Bounds {
        rate: None,
        acceleration: path.acceleration,
        jerk: path.jerk,
    };
    let across = Bounds {
        rate: None,
        acceleration: path.acceleration.map(|most| most / SIDE),
        jerk: None,
    };
    let blade = Bounds {
        rate: None,
        acceleration: path.turning_acceleration,
        jerk: path.turning_jerk,
    };
    let along = Bounds { jerk: None, ..tip };
    let jerk = Bounds {
        acceleration: None,
        ..tip
    };
    let others = [
        programmed, programmed, jerk, along, along, across, across, blade, blade,
    ];
    core::array::from_fn(|track| match track.checked_sub(MOST_AXES) {
        None => axes[track],
        Some(other) => others[other],
    })
}

/// What moves beside the axes, at a place; by mm.
#[derive(Clone, Copy, Debug)]
struct Beside {
    feed: f64,
    rate: Option<f64>,
    bend: f64,
    /// How the bend changes.
    bends: f64,
    /// How the blade turns.
    spin: Slopes,
}

impl Beside {
    fn along(piece: &Piece) -> Self {
        Self {
            feed: piece.feed,
            rate: piece.rate,
            bend: piece.bend,
            bends: 0.0,
            spin: Slopes {
                first: length(piece.spin),
                ..Slopes::default()
            },
        }
    }

    /// At a share of a joint that is so long.
    fn between([before, after]: [&Piece; 2], long: f64, share: f64) -> Self {
        let change = length(minus(after.spin, before.spin));
        let [value, first, second] = eased(share);
        let spin = core::array::from_fn(|i| before.spin[i] + (after.spin[i] - before.spin[i]) * value);
        let own = if share < 0.5 { before } else { after };
        Self {
            feed: own.feed,
            rate: own.rate,
            bend: before.bend.max(after.bend),
            bends: (after.bend - before.bend).abs() / long,
            spin: Slopes {
                first: length(spin),
                second: change * first / long,
                third: change * second.abs() / (long * long),
            },
        }
    }

    fn with(self, part: &Part) -> Part<TRACKS> {
        let tip = |second, third| Slopes {
            first: 1.0,
            second,
            third,
        };
        let used = |first| Slopes {
            first,
            ..Slopes::default()
        };
        let (inner, outer) = (SIDE * self.bend, self.bend / SIDE);
        let back = Slopes {
            second: -self.spin.second,
            ..self.spin
        };
        let others = [
            used(1.0 / self.feed),
            used(self.rate.map_or(0.0, |rate| self.spin.first / rate)),
            tip(self.bend, self.bend * self.bend + self.bends),
            tip(inner, 0.0),
            tip(-inner, 0.0),
            tip(outer, 0.0),
            tip(-outer, 0.0),
            self.spin,
            back,
        ];
        Part {
            length: part.length,
            axes: core::array::from_fn(|track| match track.checked_sub(MOST_AXES) {
                None => part.axes[track],
                Some(other) => others[other],
            }),
        }
    }
}

/// A cubic from 0 to 1 that is level at both ends, with its first two derivatives.
const fn eased(x: f64) -> [f64; 3] {
    [x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x), 6.0 - 12.0 * x]
}

/// A stretch of a chain: what is left of a piece, or half of a joint.
#[derive(Clone, Debug)]
struct Leg {
    /// The piece to which its time belongs.
    of: usize,
    parts: Vec<Part<TRACKS>>,
}

/// How long each piece of a chain takes, in s. None where no ride along it was found.
pub(super) fn times(pieces: &[Piece], limits: &Limits<'_>) -> Option<Vec<f64>> {
    let mut times = vec![0.0; pieces.len()];
    let mut first = 0;
    for next in 1..=pieces.len() {
        let rests = match (pieces.get(next - 1), pieces.get(next)) {
            (Some(before), Some(after)) => {
                limits.half_joint([before, after]).is_none() && limits.jumps([before, after])
            }
            (_, _) => true,
        };
        if rests {
            for (time, found) in times
                .iter_mut()
                .skip(first)
                .zip(limits.without_rest(pieces.get(first..next)?)?)
            {
                *time = found;
            }
            first = next;
        }
    }
    Some(times)
}

impl Limits<'_> {
    /// Half of the length of a joint, in mm; none where the program leaves nothing to round.
    fn half_joint(&self, [before, after]: [&Piece; 2]) -> Option<f64> {
        let half = self.blend.min(before.length / 2.0).min(after.length / 2.0);
        (half > NO_BLEND).then_some(half)
    }

    /// Whether a rate jumps where two pieces meet: of the blade, or of an axis as compared with others of its kind.
    fn jumps(&self, [before, after]: [&Piece; 2]) -> bool {
        let has_bounds = |bounds: &Bounds| bounds.acceleration.is_some() || bounds.jerk.is_some();
        let turn = length(before.spin).max(length(after.spin));
        let of_blade = self.tracks.last().is_some_and(has_bounds);
        if of_blade && length(minus(after.spin, before.spin)) > JUMP * turn {
            return true;
        }
        let (Some(ends), Some(begins)) = (at(&before.parts, before.length), at(&after.parts, 0.0)) else {
            return false;
        };
        [AxisKind::Linear, AxisKind::Rotary].into_iter().any(|kind| {
            let all = self.axes.iter().zip(&self.tracks).zip(ends.iter().zip(&begins));
            let own = all.filter(|((axis, _), _)| axis.kind == kind);
            let (mut most, mut jump) = (0.0_f64, 0.0_f64);
            for ((_, bounds), (ends, begins)) in own {
                most = most.max(ends.first.abs()).max(begins.first.abs());
                if has_bounds(bounds) {
                    jump = jump.max((begins.first - ends.first).abs());
                }
            }
            jump > JUMP * most
        })
    }

    /// How long each of some pieces takes, from rest to rest and without one between, unless rests make it shorter.
    fn without_rest(&self, pieces: &[Piece]) -> Option<Vec<f64>> {
        let legs = self.legs(pieces)?;
        match self.kept {
            Kept::Speeds | Kept::Accelerations => Some(self.fastest(pieces.len(), &legs)),
            Kept::Jerks => {
                let alone: Option<Vec<f64>> = pieces
                    .iter()
                    .map(|piece| {
                        let legs = self.legs(core::slice::from_ref(piece))?;
                        Some(self.smooth(1, &legs)?.iter().sum())
                    })
                    .collect();
                let together = self.smooth(pieces.len(), &legs);
                [together, alone]
                    .into_iter()
                    .flatten()
                    .min_by(|one, other| one.iter().sum::<f64>().total_cmp(&other.iter().sum()))
            }
        }
    }

    /// Pieces and the joints between them.
    fn legs(&self, pieces: &[Piece]) -> Option<Vec<Leg>> {
        let mut legs = Vec::with_capacity(2 * pieces.len());
        let mut begun = 0.0;
        for (index, piece) in pieces.iter().enumerate() {
            let after = pieces.get(index + 1);
            let half = after.and_then(|after| self.half_joint([piece, after]));
            let beside = Beside::along(piece);
            let middle = clipped(&piece.parts, begun, piece.length - half.unwrap_or(0.0));
            if !middle.is_empty() {
                legs.push(Leg {
                    of: index,
                    parts: middle.iter().map(|part| beside.with(part)).collect(),
                });
            }
            if let (Some(half), Some(after)) = (half, after) {
                let (first, second) = joint([piece, after], half)?;
                legs.push(Leg {
                    of: index,
                    parts: first,
                });
                legs.push(Leg {
                    of: index + 1,
                    parts: second,
                });
            }
            begun = half.unwrap_or(0.0);
        }
        Some(legs)
    }

    /// With bounds of acceleration: the fastest way.
    fn fastest(&self, pieces: usize, legs: &[Leg]) -> Vec<f64> {
        let parts: Vec<Part<TRACKS>> = legs.iter().flat_map(|leg| &leg.parts).copied().collect();
        let mut steps = phase::steps_of_pieces(&parts, &self.tracks).into_iter();
        let of_legs = legs.iter().map(|leg| {
            let own = steps.by_ref().take(leg.parts.len());
            own.map(|step| step.time).sum()
        });
        shared(pieces, legs, of_legs.collect())
    }

    /// With bounds of jerk: ramps at the ends of legs.
    fn smooth(&self, pieces: usize, legs: &[Leg]) -> Option<Vec<f64>> {
        let ways: Vec<Ridden<'_>> = legs
            .iter()
            .map(|leg| Ridden::new(leg, &self.tracks))
            .collect::<Option<_>>()?;
        let seams = ways.iter().zip(ways.iter().skip(1));
        let mut rates: Vec<f64> = seams.map(|(one, other)| one.highest.min(other.highest)).collect();
        rates.insert(0, 0.0);
        rates.push(0.0);
        for (index, way) in ways.iter().enumerate() {
            let from = *rates.get(index)?;
            let to = rates.get_mut(index + 1)?;
            *to = way.reached([from, *to], End::Start);
        }
        for (index, way) in ways.iter().enumerate().rev() {
            let from = *rates.get(index + 1)?;
            let to = rates.get_mut(index)?;
            *to = way.reached([from, *to], End::Finish);
        }
        let of_legs = ways.iter().zip(rates.iter().zip(rates.iter().skip(1)));
        let of_legs: Option<Vec<f64>> = of_legs.map(|(way, (from, to))| way.time([*from, *to])).collect();
        Some(shared(pieces, legs, of_legs?))
    }
}

/// The times of legs as those of their pieces.
fn shared(pieces: usize, legs: &[Leg], of_legs: Vec<f64>) -> Vec<f64> {
    let mut times = vec![0.0; pieces];
    for (leg, time) in legs.iter().zip(of_legs) {
        if let Some(of_piece) = times.get_mut(leg.of) {
            *of_piece += time;
        }
    }
    times
}

/// The parts of a piece at its end, and of the next at its beginning.
type Halves = (Vec<Part<TRACKS>>, Vec<Part<TRACKS>>);

/// The parts where one piece passes into the next, from so far before until so far after.
fn joint([before, after]: [&Piece; 2], half: f64) -> Option<Halves> {
    let long = 2.0 * half;
    let begin = at(&before.parts, before.length - half)?;
    let end = at(&after.parts, half)?;
    let count = f64::from(JOINT_PARTS);
    let part = |index: u32| {
        let share = (f64::from(index) + 0.5) / count;
        let part = Part {
            length: long / count,
            axes: core::array::from_fn(|axis| cubic([begin[axis], end[axis]], long, share)),
        };
        Beside::between([before, after], long, share).with(&part)
    };
    let middle = JOINT_PARTS / 2;
    Some((
        (0..middle).map(part).collect(),
        (middle..JOINT_PARTS).map(part).collect(),
    ))
}

/// Slopes of which the first changes like a cubic with the values and slopes at both ends (Hermite).
fn cubic([begin, end]: [Slopes; 2], long: f64, x: f64) -> Slopes {
    let [ease, eases, bends] = eased(x);
    let jump = end.first - begin.first;
    let (m, n) = (begin.second, end.second);
    Slopes {
        first: begin.first + jump * ease + long * (m * x * (1.0 - x) * (1.0 - x) - n * x * x * (1.0 - x)),
        second: jump * eases / long + m * (1.0 - x) * (1.0 - 3.0 * x) - n * x * (2.0 - 3.0 * x),
        third: jump * bends / (long * long) + (m * (6.0 * x - 4.0) + n * (6.0 * x - 2.0)) / long,
    }
}

/// The axes at a place, in mm from the beginning of parts.
fn at(parts: &[Part], place: f64) -> Option<[Slopes; MOST_AXES]> {
    let mut begin = 0.0;
    for part in parts {
        if place <= begin + part.length {
            return Some(
                part.axes
                    .map(|axis| moved(axis, place - begin - part.length / 2.0)),
            );
        }
        begin += part.length;
    }
    // Rounding of lengths.
    parts
        .last()
        .map(|part| part.axes.map(|axis| moved(axis, part.length / 2.0)))
}

/// By Taylor's theorem.
fn moved(slopes: Slopes, by: f64) -> Slopes {
    Slopes {
        first: slopes.first + by * (slopes.second + by * slopes.third / 2.0),
        second: slopes.second + by * slopes.third,
        third: slopes.third,
    }
}

/// What of some parts lies between two places, in mm.
fn clipped(parts: &[Part], from: f64, to: f64) -> Vec<Part> {
    let mut begin = 0.0;
    let mut kept = Vec::with_capacity(parts.len());
    for part in parts {
        let end = begin + part.length;
        let (first, last) = (from.max(begin), to.min(end));
        if last > first {
            let by = f64::midpoint(first, last) - f64::midpoint(begin, end);
            kept.push(Part {
                length: last - first,
                axes: part.axes.map(|axis| moved(axis, by)),
            });
        }
        begin = end;
    }
    kept
}

/// A leg with ramps at its ends and a constant rate between them.
struct Ridden<'a> {
    way: Way<'a, TRACKS>,
    length: f64,
    highest: f64,
}

impl<'a> Ridden<'a> {
    fn new(leg: &Leg, tracks: &'a [Bounds; TRACKS]) -> Option<Self> {
        let way = Way::new(&leg.parts, tracks, Bounds::default());
        Some(Self {
            length: leg.parts.iter().map(|part| part.length).sum(),
            highest: way.highest(f64::INFINITY)?,
            way,
        })
    }

    /// How long a ramp takes; none where it does not fit.
    fn ramp(&self, [from, to]: [f64; 2], end: End) -> Option<f64> {
        if to <= from {
            return Some(0.0);
        }
        let time = self.way.ramp([from, to], end)?.time;
        (time * f64::midpoint(from, to) <= self.length).then_some(time)
    }

    /// The highest rate up to another that is gathered from a lower one on the whole leg, or the other itself where that is lower.
    fn reached(&self, [from, most]: [f64; 2], end: End) -> f64 {
        if self.ramp([from, most], end).is_some() {
            return most;
        }
        let (mut low, mut high) = (from, most);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if self.ramp([from, middle], end).is_some() {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// How long it takes between two rates, in s, with the best of some rates between the ramps.
    fn time(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let least = from.max(to);
        let with = |rate: f64| {
            let rising = self.ramp([from, rate], End::Start)?;
            let falling = self.ramp([to, rate], End::Finish)?;
            let ramps = rising * f64::midpoint(from, rate) + falling * f64::midpoint(to, rate);
            let left = self.length - ramps;
            // Of one ramp that fills the leg rounding may leave less than nothing.
            (left >= -1e-9 * self.length && rate > 0.0).then(|| rising + falling + left.max(0.0) / rate)
        };
        // Between nothing and the highest: evenly by factors down to a thousandth, and from the least that there is.
        let tried = (0..=TRIED).flat_map(|step| {
            let share = f64::from(step) / f64::from(TRIED);
            [
                self.highest * libm::pow(10.0, -3.0 * share),
                least + (self.highest - least) * share,
            ]
        });
        let fitting = tried.filter(|rate| *rate >= least).filter_map(with);
        fitting.min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests;
