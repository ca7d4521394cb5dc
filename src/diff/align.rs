//! Two sequences side by side: which of their elements are the same, in order.
//!
//! Wanted is what a person would point at after an edit, in time that does not explode on texts that have nothing in
//! common. Three means, from the surest to the roughest:
//!
//! 1. What is equal at both ends of a stretch is paired off.
//! 2. Elements that stand once on either side are landmarks (the patience diff of B. Cohen): the longest sequence of them
//!    that is in the same order on both sides cuts the stretch into smaller ones.
//! 3. Stretches without landmarks are compared exactly when they are small (longest common subsequence), otherwise by
//!    looking a little ahead on either side.
//!
//! Time is bounded by the lengths times constants, memory by the lengths.

use core::ops::Range;

/// Places of an element in the first sequence and of its partner in the second.
pub type Pair = (usize, usize);

/// Stretches of at most so many combinations of elements are compared exactly.
const COMPARED_EXACTLY: usize = 1 << 14;

/// How often a stretch is cut at landmarks, at most.
const ROUNDS: u32 = 12;

/// How far ahead the rough comparison looks.
const LOOKAHEAD: usize = 48;

/// Pairs of equal elements, ascending on both sides.
pub fn common(first: &[u32], second: &[u32]) -> Vec<Pair> {
    let most = first.iter().chain(second).copied().max().unwrap_or(0);
    let mut aligner = Aligner {
        first,
        second,
        seen: vec![Seen::default(); most as usize + 1],
        pairs: Vec::new(),
    };
    let whole = Stretch {
        first: 0..first.len(),
        second: 0..second.len(),
    };
    let mut open = vec![(whole, ROUNDS)];
    while let Some((stretch, rounds)) = open.pop() {
        aligner.stretch(stretch, rounds, &mut open);
    }
    aligner.pairs.sort_unstable();
    aligner.pairs
}

/// A stretch of either sequence.
#[derive(Clone, Debug)]
struct Stretch {
    first: Range<usize>,
    second: Range<usize>,
}

/// Where and how often an element stands in the stretch at hand.
#[derive(Clone, Copy, Default)]
struct Seen {
    in_first: u32,
    in_second: u32,
    at: usize,
}

struct Aligner<'s> {
    first: &'s [u32],
    second: &'s [u32],
    /// By element; all at their defaults between two stretches.
    seen: Vec<Seen>,
    pairs: Vec<Pair>,
}

impl Aligner<'_> {
    fn is_same(&self, (first, second): Pair) -> bool {
        match (self.first.get(first), self.second.get(second)) {
            (Some(first), Some(second)) => first == second,
            (_, _) => false,
        }
    }

    fn stretch(&mut self, stretch: Stretch, rounds: u32, open: &mut Vec<(Stretch, u32)>) {
        let stretch = self.trimmed(stretch);
        let combinations = stretch.first.len().saturating_mul(stretch.second.len());
        if combinations == 0 {
            return;
        }
        if combinations <= COMPARED_EXACTLY {
            return self.exactly(&stretch);
        }
        let landmarks = match rounds {
            0 => Vec::new(),
            _ => self.landmarks(&stretch),
        };
        if landmarks.is_empty() {
            return self.roughly(&stretch);
        }
        let mut from = (stretch.first.start, stretch.second.start);
        let end = (stretch.first.end, stretch.second.end);
        for &(first, second) in landmarks.iter().chain([&end]) {
            let between = Stretch {
                first: from.0..first,
                second: from.1..second,
            };
            open.push((between, rounds - 1));
            from = (first + 1, second + 1);
        }
        self.pairs.extend(landmarks);
    }

    /// Pairs off what is equal at both ends; returns what is left.
    fn trimmed(&mut self, stretch: Stretch) -> Stretch {
        let Stretch {
            mut first,
            mut second,
        } = stretch;
        while !first.is_empty() && !second.is_empty() && self.is_same((first.start, second.start)) {
            self.pairs.push((first.start, second.start));
            first.start += 1;
            second.start += 1;
        }
        while !first.is_empty() && !second.is_empty() && self.is_same((first.end - 1, second.end - 1)) {
            first.end -= 1;
            second.end -= 1;
            self.pairs.push((first.end, second.end));
        }
        Stretch { first, second }
    }

    /// Elements that stand once on either side, as far as they are in the same order.
    fn landmarks(&mut self, stretch: &Stretch) -> Vec<Pair> {
        let (first, second) = (self.first, self.second);
        let [first, second] = [(first, &stretch.first), (second, &stretch.second)]
            .map(|(all, range)| all.get(range.clone()).unwrap_or_default());
        for element in first {
            if let Some(seen) = self.seen.get_mut(*element as usize) {
                seen.in_first += 1;
            }
        }
        for (at, element) in (stretch.second.start..).zip(second) {
            if let Some(seen) = self.seen.get_mut(*element as usize) {
                seen.in_second += 1;
                seen.at = at;
            }
        }
        let once: Vec<Pair> = (stretch.first.start..)
            .zip(first)
            .filter_map(|(at, element)| {
                let seen = self.seen.get(*element as usize)?;
                (seen.in_first == 1 && seen.in_second == 1).then_some((at, seen.at))
            })
            .collect();
        for element in first.iter().chain(second) {
            if let Some(seen) = self.seen.get_mut(*element as usize) {
                *seen = Seen::default();
            }
        }
        longest_ascending(&once)
    }

    /// The longest common subsequence, by its table.
    fn exactly(&mut self, stretch: &Stretch) {
        let (rows, columns) = (stretch.first.len(), stretch.second.len());
        let width = columns + 1;
        // At (row, column): the length for what follows these.
        let mut table = vec![0_u32; (rows + 1) * width];
        let at = |table: &[u32], row: usize, column: usize| table.get(row * width + column).copied();
        let place = |row: usize, column: usize| (stretch.first.start + row, stretch.second.start + column);
        for row in (0..rows).rev() {
            for column in (0..columns).rev() {
                let longest = if self.is_same(place(row, column)) {
                    at(&table, row + 1, column + 1).map(|length| length + 1)
                } else {
                    at(&table, row + 1, column).max(at(&table, row, column + 1))
                };
                if let Some(entry) = table.get_mut(row * width + column) {
                    *entry = longest.unwrap_or_default();
                }
            }
        }
        let (mut row, mut column) = (0, 0);
        while row < rows && column < columns {
            if self.is_same(place(row, column)) {
                self.pairs.push(place(row, column));
                row += 1;
                column += 1;
            } else if at(&table, row + 1, column) >= at(&table, row, column + 1) {
                row += 1;
            } else {
                column += 1;
            }
        }
    }

    /// Goes along both sides at once; where they differ, to the nearest place ahead from where they go on alike.
    fn roughly(&mut self, stretch: &Stretch) {
        let (mut first, mut second) = (stretch.first.start, stretch.second.start);
        while first < stretch.first.end && second < stretch.second.end {
            if self.is_same((first, second)) {
                self.pairs.push((first, second));
                first += 1;
                second += 1;
                continue;
            }
            let ahead = (1..=LOOKAHEAD).find_map(|by| {
                let later = [
                    (first + by, second + by),
                    (first + by, second),
                    (first, second + by),
                ];
                later.into_iter().find(|&place| self.goes_on(stretch, place))
            });
            (first, second) = ahead.unwrap_or((first + 1, second + 1));
        }
    }
}

impl Aligner<'_> {
    /// Whether two elements in a row are the same, so that one by chance is not taken for the way on.
    fn goes_on(&self, stretch: &Stretch, (first, second): Pair) -> bool {
        let is_within = first < stretch.first.end && second < stretch.second.end;
        let is_last = first + 1 == stretch.first.end || second + 1 == stretch.second.end;
        is_within && self.is_same((first, second)) && (is_last || self.is_same((first + 1, second + 1)))
    }
}

/// The longest subsequence that ascends on the second side; the first side ascends already.
fn longest_ascending(pairs: &[Pair]) -> Vec<Pair> {
    // For every length the place of the smallest last element of such a subsequence, and before each element the one that
    // it follows.
    let mut tails: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = Vec::with_capacity(pairs.len());
    let second = |index: usize| pairs.get(index).map(|pair| pair.1);
    for (index, pair) in pairs.iter().enumerate() {
        let length = tails.partition_point(|&tail| second(tail) < Some(pair.1));
        before.push(
            length
                .checked_sub(1)
                .and_then(|shorter| tails.get(shorter).copied()),
        );
        match tails.get_mut(length) {
            Some(tail) => *tail = index,
            None => tails.push(index),
        }
    }
    let mut longest = Vec::with_capacity(tails.len());
    let mut at = tails.last().copied();
    while let Some(index) = at {
        longest.extend(pairs.get(index));
        at = before.get(index).copied().flatten();
    }
    longest.reverse();
    longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn is_alignment(first: &[u32], second: &[u32], pairs: &[Pair]) -> bool {
        let ascends = pairs
            .windows(2)
            .all(|two| two[0].0 < two[1].0 && two[0].1 < two[1].1);
        ascends && pairs.iter().all(|&(a, b)| first[a] == second[b])
    }

    /// The length of the longest common subsequence, row by row.
    fn longest(first: &[u32], second: &[u32]) -> usize {
        let mut above = vec![0; second.len() + 1];
        for a in first {
            let mut row = vec![0; second.len() + 1];
            for (j, b) in second.iter().enumerate() {
                row[j + 1] = if a == b {
                    above[j] + 1
                } else {
                    row[j].max(above[j + 1])
                };
            }
            above = row;
        }
        above[second.len()]
    }

    proptest! {
        #[test]
        fn small_sequences_are_aligned_as_well_as_can_be(
            first in prop::collection::vec(0_u32..6, 0..60),
            second in prop::collection::vec(0_u32..6, 0..60),
        ) {
            let pairs = common(&first, &second);
            prop_assert!(is_alignment(&first, &second, &pairs));
            prop_assert_eq!(pairs.len(), longest(&first, &second));
        }

        #[test]
        fn few_edits_of_a_long_program_stay_few(
            edits in prop::collection::vec((0_usize..4000, 0_u32..3), 0..8),
            kinds in 40_u32..5000,
        ) {
            let first: Vec<u32> = (0..4000_u32).map(|i| i.wrapping_mul(2_654_435_761) % kinds).collect();
            let mut second = first.clone();
            for &(at, edit) in &edits {
                let at = at.min(second.len() - 1);
                match edit {
                    0 => second[at] = kinds + 1,
                    1 => { second.remove(at); }
                    _ => second.insert(at, kinds + 2),
                }
            }
            let pairs = common(&first, &second);
            prop_assert!(is_alignment(&first, &second, &pairs));
            prop_assert!(pairs.len() + 3 * edits.len() >= first.len(), "{} of {}", pairs.len(), first.len());
        }

        #[test]
        fn any_long_sequences_are_aligned(
            seeds in (any::<u32>(), any::<u32>()),
            kinds in (1_u32..2000, 1_u32..2000),
            lengths in (0_u32..3000, 0_u32..3000),
        ) {
            let random = |seed: u32, kinds: u32, length: u32| -> Vec<u32> {
                (0..length).map(|i| (i ^ seed).wrapping_mul(2_654_435_761).rotate_left(13) % kinds).collect()
            };
            let first = random(seeds.0, kinds.0, lengths.0);
            let second = random(seeds.1, kinds.1, lengths.1);
            prop_assert!(is_alignment(&first, &second, &common(&first, &second)));
        }
    }

    #[test]
    fn sequences_without_anything_in_common_come_to_an_end() {
        let first: Vec<u32> = (0..300_000).map(|i| i % 2).collect();
        let second: Vec<u32> = (0..300_000).map(|i| 2 + i % 2).collect();
        assert_eq!(common(&first, &second), []);
    }

    #[test]
    fn a_line_that_moved_far_costs_one_pair() {
        let first: Vec<u32> = (0..1000).collect();
        let mut second = first.clone();
        let moved = second.remove(10);
        second.insert(900, moved);
        assert_eq!(common(&first, &second).len(), 999);
    }
}
