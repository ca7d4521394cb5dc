//! The most that quantities come to along the motions of a program: proven everywhere on them, and nearly reached.
//!
//! A motion is looked at in parts. Of each part every quantity has a bound, which it stays below everywhere on it, and what it comes to
//! in the middle. Parts whose bounds do not matter are put aside, all others are halved (branch and bound), until no bound is above the
//! most that was met by more than [`CLOSE`] of it: then the answer exceeds the truth by no more than that. Where a round would have more
//! than [`MOST_PARTS`] parts, or parts would be shorter than [`SHORTEST`], the bounds that there are stand.

use core::array;
use rayon::prelude::*;
use vcutc_backend_api::ir::OpId;
use vcutc_motion::path::Part;

/// By which share of itself the most may be stated too high.
const CLOSE: f64 = 0.005;

/// A part this short of its motion is not halved again: where a limit is still in doubt there, it counts as broken.
const SHORTEST: f64 = 1.0 / 65_536.0;

/// Most parts that are looked at in a round: a bound is stated too high rather than searched for without end.
const MOST_PARTS: usize = 20_000;

/// A quantity on a part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    /// What it comes to in the middle.
    pub(crate) middle: f64,
    /// It is nowhere greater.
    pub(crate) most: f64,
}

impl Held {
    /// A part of which nothing is known.
    const UNKNOWN: Self = Self {
        middle: f64::NEG_INFINITY,
        most: f64::INFINITY,
    };
}

/// What is looked for of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sought {
    /// What is smaller does not matter.
    pub(crate) least: f64,
    /// Whether it is kept is to be settled, if that can be.
    pub(crate) limit: Option<f64>,
}

/// The most that a quantity comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    /// It is nowhere greater.
    pub(crate) most: f64,
    /// The largest that was met.
    pub(crate) met: f64,
    /// Where.
    pub(crate) op: OpId,
    pub(crate) part: Part,
}

/// A motion, and into how many parts it is divided at first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole {
    pub(crate) op: OpId,
    pub(crate) parts: u32,
}

/// The most of each quantity, along these motions; none where there are none. `bounds` of a part are none where it is too long to say.
pub(crate) fn peaks<const Q: usize>(
    motions: &[Whole],
    sought: &[Sought; Q],
    bounds: impl Fn(OpId, Part) -> Option<[Held; Q]> + Sync,
) -> Option<[Peak; Q]> {
    let all = motions.iter().flat_map(|motion| {
        let parts = (0..motion.parts).map(|number| Part::one_of(motion.parts, number));
        parts.map(|part| (motion.op, part))
    });
    let mut live: Vec<(OpId, Part)> = all.collect();
    let &(op, part) = live.first()?;
    let mut search = Search {
        sought,
        peaks: [Peak {
            most: f64::NEG_INFINITY,
            met: f64::NEG_INFINITY,
            op,
            part,
        }; Q],
    };
    while !live.is_empty() {
        let looked_at: Vec<Looked<Q>> = live
            .par_iter()
            .map(|&(op, part)| Looked {
                op,
                part,
                held: bounds(op, part).unwrap_or([Held::UNKNOWN; Q]),
            })
            .collect();
        live = search.settle(&looked_at);
    }
    Some(search.peaks)
}

struct Looked<const Q: usize> {
    op: OpId,
    part: Part,
    held: [Held; Q],
}

struct Search<'s, const Q: usize> {
    sought: &'s [Sought; Q],
    peaks: [Peak; Q],
}

impl<const Q: usize> Search<'_, Q> {
    /// Takes what was looked at into account. Returns what is to be looked at more closely.
    fn settle(&mut self, parts: &[Looked<Q>]) -> Vec<(OpId, Part)> {
        for looked in parts {
            self.meet(looked);
        }
        let (open, settled): (Vec<_>, Vec<_>) = parts.iter().partition(|looked| self.is_open(looked));
        let is_too_much = open.len() > MOST_PARTS;
        let ends = settled
            .into_iter()
            .chain(open.iter().copied().filter(|_| is_too_much));
        for looked in ends {
            for (peak, held) in self.peaks.iter_mut().zip(looked.held) {
                peak.most = peak.most.max(held.most);
            }
        }
        let halves = open.into_iter().filter(|_| !is_too_much);
        halves
            .flat_map(|looked| looked.part.halves().map(|half| (looked.op, half)))
            .collect()
    }

    fn meet(&mut self, looked: &Looked<Q>) {
        for (peak, held) in self.peaks.iter_mut().zip(looked.held) {
            if held.middle > peak.met {
                (peak.met, peak.op, peak.part) = (held.middle, looked.op, looked.part);
            }
        }
    }

    /// Whether a shorter part may say more that matters.
    fn is_open(&self, looked: &Looked<Q>) -> bool {
        let is_open = |quantity: usize| {
            let (held, peak, sought) = (looked.held[quantity], self.peaks[quantity], self.sought[quantity]);
            let is_near = held.most <= (peak.met + CLOSE * peak.met.abs()).max(sought.least);
            // A limit that is passed is passed: by how much, the part with the most says.
            let is_in_doubt = sought
                .limit
                .is_some_and(|limit| peak.met <= limit && limit < held.most);
            !is_near || is_in_doubt
        };
        let known: [bool; Q] = array::from_fn(is_open);
        looked.part.half > SHORTEST && known.into_iter().any(|open| open)
    }
}

#[cfg(test)]
mod tests;
