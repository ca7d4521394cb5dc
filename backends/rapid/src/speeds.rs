//! Speeds: every move names a `speeddata`, which holds the speed of the tip and the rate of turning.
//!
//! The program's ops know one or both. What an op leaves open has no effect on it, since it does not move so, but must stand
//! in its speeddata: it is the slowest that the program has. Tip speeds and rates are `num`s of their own, so that each
//! number stands in the program once.

use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, FeedId, Program, RateId};

/// `v_ori` in deg/s where a program has no rate at all, as in ABB's own speeddata; nothing turns in such a program.
pub(crate) const RATE_OF_NOTHING: u32 = 500;
/// `v_leax` in mm/s and `v_reax` in deg/s, as in ABB's own speeddata: the job has no external axes.
pub(crate) const EXTERNAL: [u32; 2] = [5000, 1000];

/// A tip speed and a rate; none where the program has no such speed.
pub(crate) type Pair = (Option<FeedId>, Option<RateId>);

/// All speeddata of a program.
pub(crate) struct Speeds {
    numbers: BTreeMap<Pair, u32>,
    /// The pairs in the order of their numbers, which begin with 1.
    pairs: Vec<Pair>,
    slowest: Pair,
}

impl Speeds {
    /// Of a program, numbered in the order of first use.
    pub(crate) fn of(program: &Program) -> Self {
        let named = || program.ops.iter().filter_map(|op| named(&op.action));
        let feed = |id: &FeedId| program.feed(*id).map_or(0.0, |feed| feed.to_mm_per_s());
        let rate = |id: &RateId| program.rate(*id).map_or(0.0, |rate| rate.to_rad_per_s());
        let mut all = Self {
            numbers: BTreeMap::new(),
            pairs: Vec::new(),
            slowest: (
                named()
                    .filter_map(|pair| pair.0)
                    .min_by(|a, b| feed(a).total_cmp(&feed(b))),
                named()
                    .filter_map(|pair| pair.1)
                    .min_by(|a, b| rate(a).total_cmp(&rate(b))),
            ),
        };
        for pair in named() {
            let pair = all.filled(pair);
            let next = u32::try_from(all.pairs.len())
                .unwrap_or(u32::MAX)
                .saturating_add(1);
            all.numbers.entry(pair).or_insert_with(|| {
                all.pairs.push(pair);
                next
            });
        }
        all
    }

    /// What is left open is the slowest there is.
    fn filled(&self, (feed, rate): Pair) -> Pair {
        (feed.or(self.slowest.0), rate.or(self.slowest.1))
    }

    /// The number of the speeddata of an action; none for one that is not a motion along a line.
    pub(crate) fn number(&self, action: &Action) -> Option<u32> {
        self.numbers.get(&self.filled(named(action)?)).copied()
    }

    /// All speeddata, in the order of their numbers.
    pub(crate) fn all(&self) -> impl Iterator<Item = (u32, Pair)> {
        (1..).zip(self.pairs.iter().copied())
    }

    /// The tip speeds, each once.
    pub(crate) fn feeds(&self) -> Vec<FeedId> {
        sorted(self.pairs.iter().filter_map(|pair| pair.0))
    }

    /// The rates, each once.
    pub(crate) fn rates(&self) -> Vec<RateId> {
        sorted(self.pairs.iter().filter_map(|pair| pair.1))
    }

    pub(crate) const fn slowest_rate(&self) -> Option<RateId> {
        self.slowest.1
    }
}

fn sorted<T: Ord>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = all.collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The speeds that an action names; none for one that is not a motion along a line.
pub(crate) fn named(action: &Action) -> Option<Pair> {
    match (action.feed(), action.rate()) {
        (None, None) => None,
        named => Some(named),
    }
}
