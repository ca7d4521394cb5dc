//! The most that quantities come to along the motions of a program: proven everywhere on them, and nearly reached.
//!
//! A motion is looked at in parts. Of each part every quantity has a bound, which it stays below everywhere on it, and what it comes to
//! somewhere on it. Parts whose bounds do not matter are put aside; of the others those with the largest bounds are halved, some at a time
//! (branch and bound), until no bound is above the most that was met by more than [`CLOSE`] of it: then the answer exceeds the truth by
//! no more than that. Where [`MOST_LOOKS`] do not suffice, or parts would be shorter than [`SHORTEST`], the bounds that there are stand.

use core::array;
use rayon::prelude::*;
use std::collections::BTreeSet;
use vcutc_backend_api::ir::OpId;
use vcutc_motion::path::Part;

/// By which share of itself the most may be stated too high.
const CLOSE: f64 = 0.005;

/// A part this short of its motion is not halved again: where a limit is still in doubt there, it counts as broken.
const SHORTEST: f64 = 1.0 / 65_536.0;

/// Most parts that are halved: a bound is stated too high rather than searched for without end.
const MOST_LOOKS: usize = 100_000;

/// How many parts are halved at a time for each quantity, at least. Fewer means to look at fewer parts, more keeps all threads at work.
const AT_A_TIME: usize = 128;

/// Of many parts, this share is halved at a time: each round goes through all of them.
const SHARE_AT_A_TIME: usize = 16;

/// A quantity on a part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    /// What it comes to somewhere on it.
    pub(crate) met: f64,
    /// It is nowhere greater.
    pub(crate) most: f64,
}

impl Held {
    /// A part of which nothing is known.
    const UNKNOWN: Self = Self {
        met: f64::NEG_INFINITY,
        most: f64::INFINITY,
    };

    /// Without what is not a number: it would pass every comparison.
    fn known(self) -> Self {
        if self.met.is_nan() || self.most.is_nan() {
            Self::UNKNOWN
        } else {
            self
        }
    }
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
    let look = |parts: Vec<(OpId, Part)>| -> Vec<Looked<Q>> {
        let each = parts.into_par_iter().map(|(op, part)| Looked {
            op,
            part,
            held: bounds(op, part).map_or([Held::UNKNOWN; Q], |held| held.map(Held::known)),
        });
        each.collect()
    };
    let mut open = Vec::new();
    let mut looks = 0;
    while !live.is_empty() {
        let found = look(live);
        found.iter().for_each(|looked| search.meet(looked));
        open.extend(found);
        open = search.settle(open);
        let next = largest(&open, AT_A_TIME.max(open.len() / SHARE_AT_A_TIME));
        looks += next.len();
        live = Vec::new();
        if looks > MOST_LOOKS {
            break;
        }
        for place in next.into_iter().rev() {
            let looked = open.swap_remove(place);
            live.extend(looked.part.halves().map(|half| (looked.op, half)));
        }
    }
    open.iter().for_each(|looked| search.stand(looked));
    Some(search.peaks)
}

/// The places of those with the largest bounds: so many of each quantity, in order.
fn largest<const Q: usize>(open: &[Looked<Q>], count: usize) -> Vec<usize> {
    let mut chosen = BTreeSet::new();
    for quantity in 0..Q {
        let mut places: Vec<usize> = (0..open.len()).collect();
        let most = |place: &usize| open[*place].held[quantity].most;
        // Of equal ones the first counts, so that the order is always the same.
        let order = |a: &usize, b: &usize| most(b).total_cmp(&most(a)).then(a.cmp(b));
        if count < places.len() {
            places.select_nth_unstable_by(count, order);
            places.truncate(count);
        }
        chosen.extend(places);
    }
    chosen.into_iter().collect()
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
    /// Puts aside what does not matter. Returns what is to be looked at more closely.
    fn settle(&mut self, parts: Vec<Looked<Q>>) -> Vec<Looked<Q>> {
        let (open, settled): (Vec<_>, Vec<_>) = parts.into_iter().partition(|looked| self.is_open(looked));
        settled.iter().for_each(|looked| self.stand(looked));
        open
    }

    /// The bounds of a part count as they are.
    fn stand(&mut self, looked: &Looked<Q>) {
        for (peak, held) in self.peaks.iter_mut().zip(looked.held) {
            peak.most = peak.most.max(held.most);
        }
    }

    fn meet(&mut self, looked: &Looked<Q>) {
        for (peak, held) in self.peaks.iter_mut().zip(looked.held) {
            if held.met > peak.met {
                (peak.met, peak.op, peak.part) = (held.met, looked.op, looked.part);
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
