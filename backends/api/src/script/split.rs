//! Where a long program is split into parts.
//!
//! The rule: a part begins only before a `Travel` or `AxisTravel`, or a `Turn` on the way to one, that leads to another cut
//! or layer than the op before it. There the blade is in the air, and the two flanks of a V stay together when they are cut one after
//! the other. A part takes as many of these stretches as fit into the limit; a stretch longer than the limit is a part of
//! its own.

use super::listing::{Lead, Modal};
use super::state::State;
use crate::ir::{Action, Op};
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

/// The parts of a program, at least one, with at most `limit` lines in the body of each where that can be had.
///
/// `lines` tells how many lines a dialect makes of what stands before an op; every op has one more of its own.
#[must_use]
pub fn split(ops: &[Op], limit: Option<NonZeroU32>, lines: fn(Lead) -> u64) -> Vec<Part> {
    let limit = limit.map_or(u64::MAX, |limit| u64::from(limit.get()));
    let mut parts = Vec::new();
    let mut part = Tally::start(0, State::START, lines);
    // The last place within the part where the next one could begin.
    let mut border: Option<(usize, State)> = None;
    let mut at = 0;
    while let Some(op) = ops.get(at) {
        if at > part.first && may_begin(ops, at) {
            border = Some((at, part.state));
        }
        let taken = part.take(op);
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
struct Tally {
    first: usize,
    start: State,
    state: State,
    modal: Modal,
    lines_of: fn(Lead) -> u64,
    lines: u64,
}

impl Tally {
    fn start(first: usize, state: State, lines_of: fn(Lead) -> u64) -> Self {
        Self {
            first,
            start: state,
            state,
            modal: Modal::default(),
            lines_of,
            lines: 0,
        }
    }

    /// Adds an op; the lines so far.
    fn take(&mut self, op: &Op) -> u64 {
        let own_line = 1;
        self.lines += (self.lines_of)(self.modal.lead(op)) + own_line;
        self.state = self.state.after(&op.action);
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

    const LINES: fn(Lead) -> u64 = |lead| lead.lines(2);

    fn lines_of(ops: &[Op]) -> u64 {
        let mut tally = Tally::start(0, State::START, LINES);
        ops.iter().map(|op| tally.take(op)).last().unwrap_or_default()
    }

    proptest! {
        /// Parts lie end to end, begin only where they may, and no two neighbours fit into the limit together.
        #[test]
        fn parts_tile_the_program_and_are_as_long_as_may_be(
            (layers, cuts, limit) in (0..6_u32, 0..6_u32, 1..200_u32),
            by_layer in any::<bool>(),
            single in any::<bool>(),
        ) {
            let ops = Recipe {
                layers,
                cuts,
                passes: if by_layer { Passes::Layer } else { Passes::Point },
                edges: if single { Edges::Single } else { Edges::Double },
                ..Recipe::default()
            }
            .program()
            .ops;
            let parts = split(&ops, NonZeroU32::new(limit), LINES);
            let mut state = State::START;
            let mut end = 0;
            for part in &parts {
                prop_assert_eq!(part.ops.start, end);
                prop_assert_eq!(part.start, state);
                prop_assert!(end == 0 || may_begin(&ops, end));
                state = ops[part.ops.clone()].iter().fold(state, |state, op| state.after(&op.action));
                end = part.ops.end;
            }
            prop_assert_eq!(end, ops.len());
            for pair in parts.windows(2) {
                // The next part is taken whole or not at all, up to its own first border.
                let next = (pair[1].ops.start + 1..pair[1].ops.end).find(|&at| may_begin(&ops, at));
                let joined = pair[0].ops.start..next.unwrap_or(pair[1].ops.end);
                prop_assert!(lines_of(&ops[joined]) > u64::from(limit));
            }
        }
    }
}
