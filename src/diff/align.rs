//! Two sequences side by side: which of their elements are the same, in order.
//!
//! Found by Myers' algorithm with the bounds of git: a search that becomes expensive is split where it has come farthest. So the
//! result is one that a person would point at after an edit, and time does not explode on sequences that have nothing in
//! common. The bounds count steps, not time: the same sequences give the same pairs.

use similar::{Algorithm, DiffOp, capture_diff_slices};

/// Places of an element in the first sequence and of its partner in the second.
pub type Pair = (usize, usize);

/// Pairs of equal elements, ascending on both sides.
pub fn common(first: &[u32], second: &[u32]) -> Vec<Pair> {
    // From the second to the first: of two neighbours that changed places the first one is then said to have moved down.
    let ops = capture_diff_slices(Algorithm::Myers, second, first);
    let equal = ops.iter().filter_map(|op| match *op {
        DiffOp::Equal {
            old_index,
            new_index,
            len,
        } => Some((new_index..new_index + len).zip(old_index..)),
        DiffOp::Delete { .. } | DiffOp::Insert { .. } | DiffOp::Replace { .. } => None,
    });
    equal.flatten().collect()
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

    /// Sequences of few kinds in no order share elements everywhere, and never for long.
    #[test]
    fn long_sequences_without_order_come_to_an_end() {
        for kinds in [2_u32, 50, 40_000] {
            let random = |seed: u32| -> Vec<u32> {
                let mut state = seed;
                let next = |_| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (state >> 8) % kinds
                };
                (0..60_000).map(next).collect()
            };
            let (first, second) = (random(1), random(2));
            let pairs = common(&first, &second);
            assert!(!pairs.is_empty() && is_alignment(&first, &second, &pairs));
        }
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
