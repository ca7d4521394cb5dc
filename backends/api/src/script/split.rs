//! Where a long program is split into parts.
//!
//! The rule: a part begins only before a `Travel` or `AxisTravel`, or a `Turn` on the way to one, that leads to another cut
//! or layer than the op before it. There the blade is in the air, and the two flanks of a V stay together when they are cut one after
//! the other. A dialect may allow only those of these places where the tip is above the stock ([`Borders`]). A part takes as many of these stretches as fit into the limit; a stretch longer than the limit is a part of
//! its own.

use super::listing::{Lead, Modal};
use crate::ir::{Action, Op, Stock};
use crate::state::{Place, State};
use core::num::NonZeroU32;
use core::ops::Range;

/// A run of ops that makes one module.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Places in the program's list.
    pub ops: Range<usize>,
    /// State in which it begins.
    pub start: State,
}

/// Which of the places between cuts a part may begin at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Borders {
    /// All of them.
    BetweenCuts,
    /// Those where the tip is not below the top of this stock: what moves when a part repeats its first pose moves in the
    /// open, and not beside the core.
    AboveStock(Stock),
}

impl Borders {
    fn allow(self, place: Place) -> bool {
        match (self, place) {
            (Self::AboveStock(stock), Place::Pose(pose)) => pose.tip.z >= stock.height.to_mm(),
            // Whoever starts a part alone has its blade at hand, and does not begin where it is changed.
            (_, Place::Change) => false,
            (Self::BetweenCuts, _) | (Self::AboveStock(_), Place::Unknown | Place::Home) => true,
        }
    }
}

/// The parts of a program, at least one, with at most `limit` lines in the body of each where that can be had.
///
/// `lines` says how many lines a dialect makes of what stands before the op at a place in the list; every op
/// has one more of its own.
#[must_use]
pub fn split(
    ops: &[Op],
    limit: Option<NonZeroU32>,
    borders: Borders,
    lines: &dyn Fn(usize, Lead) -> u64,
) -> Vec<Part> {
    let limit = limit.map_or(u64::MAX, |limit| u64::from(limit.get()));
    let mut parts = Vec::new();
    let mut part = Tally::start(0, State::START, lines);
    // The last place within the part where the next one could begin.
    let mut border: Option<(usize, State)> = None;
    let mut at = 0;
    while let Some(op) = ops.get(at) {
        if at > part.first && may_begin(ops, at) && borders.allow(part.state.place) {
            border = Some((at, part.state));
        }
        let taken = part.take(at, op);
        match border {
            Some((next, state)) if taken > limit => {
                parts.push(part.until(next));
                part = Tally::start(next, state, lines);
                border = None;
                at = next;
            }
            _ => at += 1,
        }
    }
    parts.push(part.until(ops.len()));
    parts
}

/// Whether a part may begin at this op.
fn may_begin(ops: &[Op], at: usize) -> bool {
    let before = at.checked_sub(1).and_then(|before| ops.get(before));
    match (before, ops.get(at)) {
        (Some(before), Some(op)) => {
            // A blade that is turned half round begins its way to the next cut with a turn.
            let leaves = matches!(
                op.action,
                Action::Travel { .. } | Action::AxisTravel { .. } | Action::Turn { .. }
            );
            leaves && before.site != op.site
        }
        _ => false,
    }
}

/// A part being measured.
struct Tally<'l> {
    first: usize,
    start: State,
    state: State,
    modal: Modal,
    lines_of: &'l dyn Fn(usize, Lead) -> u64,
    lines: u64,
}

impl<'l> Tally<'l> {
    fn start(first: usize, state: State, lines_of: &'l dyn Fn(usize, Lead) -> u64) -> Self {
        Self {
            first,
            start: state,
            state,
            modal: Modal::default(),
            lines_of,
            lines: 0,
        }
    }

    /// Adds the op at this place; the lines so far.
    fn take(&mut self, at: usize, op: &Op) -> u64 {
        let own_line = 1;
        self.lines += (self.lines_of)(at, self.modal.lead(op)) + own_line;
        self.state.advance(&op.action);
        self.lines
    }

    const fn until(&self, end: usize) -> Part {
        Part {
            ops: self.first..end,
            start: self.start,
        }
    }
}

#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests {
    use super::*;
    use crate::ir::Edges;
    use crate::testkit::{Passes, Recipe};
    use proptest::prelude::*;

    /// Every third op takes two lines more, as those with waypoints do.
    fn lines(at: usize, lead: Lead) -> u64 {
        lead.lines(2) + if at.is_multiple_of(3) { 2 } else { 0 }
    }

    fn lines_of(ops: &[Op], range: Range<usize>) -> u64 {
        let mut tally = Tally::start(range.start, State::START, &lines);
        range
            .map(|at| tally.take(at, &ops[at]))
            .last()
            .unwrap_or_default()
    }

    proptest! {
        /// Parts lie end to end, begin only where they may, and no two neighbours fit into the limit together.
        #[test]
        fn parts_tile_the_program_and_are_as_long_as_may_be(
            (layers, cuts, limit) in (0..6_u32, 0..6_u32, 1..200_u32),
            by_layer in any::<bool>(),
            single in any::<bool>(),
            above in any::<bool>(),
        ) {
            let program = Recipe {
                layers,
                cuts,
                passes: if by_layer { Passes::Layer } else { Passes::Point },
                edges: if single { Edges::Single } else { Edges::Double },
                ..Recipe::default()
            }
            .program();
            let ops = &program.ops;
            let borders = if above { Borders::AboveStock(program.stock) } else { Borders::BetweenCuts };
            let parts = split(ops, NonZeroU32::new(limit), borders, &lines);
            let may_begin = |at: usize, state: State| {
                let is_clear = state.place.pose().is_none_or(|pose| pose.tip.z >= program.stock.height.to_mm());
                may_begin(ops, at) && (is_clear || !above)
            };
            let mut state = State::START;
            let mut end = 0;
            for part in &parts {
                prop_assert_eq!(part.ops.start, end);
                prop_assert_eq!(part.start, state);
                prop_assert!(end == 0 || may_begin(end, state));
                state = ops[part.ops.clone()].iter().fold(state, |state, op| state.after(&op.action));
                end = part.ops.end;
            }
            prop_assert_eq!(end, ops.len());
            for pair in parts.windows(2) {
                // The next part is taken whole or not at all, up to its own first border.
                let mut state = pair[1].start;
                let next = pair[1].ops.clone().find(|&at| {
                    let begins = at > pair[1].ops.start && may_begin(at, state);
                    state = state.after(&ops[at].action);
                    begins
                });
                let joined = pair[0].ops.start..next.unwrap_or(pair[1].ops.end);
                prop_assert!(lines_of(ops, joined) > u64::from(limit));
            }
        }
    }

    /// Between the cuts of a layer the tip may stay at cutting depth: only some of the places are above the stock, and they are
    /// used.
    #[test]
    fn parts_that_begin_above_the_stock() {
        let mut program = Recipe::default().program();
        for (at, op) in program.ops.iter_mut().enumerate() {
            if let Action::Retract { to, .. } = &mut op.action
                && !at.is_multiple_of(4)
            {
                to.z = 0.0;
            }
        }
        let begin = |borders| {
            let parts = split(&program.ops, NonZeroU32::new(1), borders, &lines);
            let tips = parts.iter().filter_map(|part| part.start.place.pose());
            tips.map(|pose| pose.tip.z).collect::<Vec<_>>()
        };
        let top = program.stock.height.to_mm();
        let (all, above) = (
            begin(Borders::BetweenCuts),
            begin(Borders::AboveStock(program.stock)),
        );
        assert!(all.iter().any(|z| *z < top), "{all:?}");
        assert!(!above.is_empty() && above.len() < all.len(), "{above:?}");
        assert!(above.iter().all(|z| *z >= top), "{above:?}");
    }
}
