//! The edits that lead from one program to another, whether or not both are split into parts alike.

use super::comparison::Comparison;
use super::listing::Numbering;
use super::split;
use super::steps::{Step, steps_between};
use vcutc_diff::align::common;

/// The edits between two programs.
pub(super) struct Edits {
    /// In the order of the given program.
    pub(super) steps: Vec<Step>,
    pub(super) parts: Parts,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parts {
    /// Where the compiler begins them.
    AsWritten,
    Otherwise,
}

/// From the fresh program of a comparison to the given one.
pub(super) fn edits(comparison: &Comparison<'_>) -> Edits {
    let (fresh, given) = (comparison.fresh, comparison.given);
    let mut names = Numbering::default();
    let normalized_texts = [
        fresh.normalized_texts(&mut names),
        given.normalized_texts(&mut names),
    ];
    let [fresh_essences, given_essences] = &normalized_texts;
    if split::is_split_otherwise(comparison, &common(fresh_essences, given_essences)) {
        return Edits {
            steps: split::steps(comparison),
            parts: Parts::Otherwise,
        };
    }
    let mut names = Numbering::default();
    let skeletons = [fresh.skeletons(&mut names), given.skeletons(&mut names)];
    Edits {
        steps: steps_between(&normalized_texts, &skeletons),
        parts: Parts::AsWritten,
    }
}
