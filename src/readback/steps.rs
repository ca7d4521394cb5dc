//! What it takes to get from one program's statements to another's.

use core::ops::Range;
use std::collections::{BTreeMap, VecDeque};
use vcutc_diff::align::{Pair, common};

/// What became of a statement. Numbers are places among the statements of the fresh program, and of the given one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// It is there, and reads the same.
    Same {
        fresh: usize,
        given: usize,
    },
    /// Another one of its kind is there instead.
    Changed {
        fresh: usize,
        given: usize,
    },
    Moved {
        fresh: usize,
        given: usize,
    },
    /// It is not there; `given` is the statement in front of which it was.
    Missing {
        fresh: usize,
        given: usize,
    },
    /// It is in the given program only; `fresh` is the statement in front of which it stands.
    Added {
        fresh: usize,
        given: usize,
    },
    /// It belongs to the head or the end of a part, and says nothing new.
    OfPart {
        given: usize,
    },
}

impl Step {
    /// The place of the given program at which it is reported.
    pub(super) const fn given(self) -> usize {
        match self {
            Self::Same { given, .. }
            | Self::Changed { given, .. }
            | Self::Moved { given, .. }
            | Self::Missing { given, .. }
            | Self::Added { given, .. }
            | Self::OfPart { given } => given,
        }
    }

    /// By this the steps ascend: what is missing in front of a statement is reported before it; otherwise the
    /// order of the given program.
    pub(super) const fn order(&self) -> (usize, bool) {
        (self.given(), !matches!(self, Self::Missing { .. }))
    }

    /// The same step where statements have other numbers.
    pub(super) fn at(self, fresh_at: impl Fn(usize) -> usize, given_at: impl Fn(usize) -> usize) -> Self {
        let given = given_at(self.given());
        match self {
            Self::Same { fresh, .. } => Self::Same {
                fresh: fresh_at(fresh),
                given,
            },
            Self::Changed { fresh, .. } => Self::Changed {
                fresh: fresh_at(fresh),
                given,
            },
            Self::Moved { fresh, .. } => Self::Moved {
                fresh: fresh_at(fresh),
                given,
            },
            Self::Missing { fresh, .. } => Self::Missing {
                fresh: fresh_at(fresh),
                given,
            },
            Self::Added { fresh, .. } => Self::Added {
                fresh: fresh_at(fresh),
                given,
            },
            Self::OfPart { .. } => Self::OfPart { given },
        }
    }
}

/// The steps between two sequences of statements, by names of their texts and of their kinds.
pub(super) fn steps_between(normalized_texts: &[Vec<u32>; 2], skeletons: &[Vec<u32>; 2]) -> Vec<Step> {
    let [fresh, given] = normalized_texts;
    let pairs = common(fresh, given);
    let moved = moved(normalized_texts, &pairs);
    let mut steps: Vec<Step> = pairs
        .iter()
        .map(|&(fresh, given)| Step::Same { fresh, given })
        .collect();
    let mut from = (0, 0);
    for &(end_fresh, end_given) in pairs.iter().chain([&(fresh.len(), given.len())]) {
        if (end_fresh, end_given) != from {
            gap(
                &mut steps,
                skeletons,
                &moved,
                [from.0..end_fresh, from.1..end_given],
            );
        }
        from = (end_fresh + 1, end_given + 1);
    }
    steps.sort_by_key(Step::order);
    steps
}

/// Statements that stand elsewhere.
#[derive(Default)]
struct Moved {
    from: BTreeMap<usize, usize>,
    to: BTreeMap<usize, usize>,
}

/// Pairs off what is left over on both sides and reads the same, in order.
fn moved(normalized_texts: &[Vec<u32>; 2], pairs: &[Pair]) -> Moved {
    let [fresh, given] = normalized_texts;
    let mut left: BTreeMap<u32, VecDeque<usize>> = BTreeMap::new();
    for (index, &normalized) in left_over(fresh, pairs.iter().map(|pair| pair.0)) {
        left.entry(normalized).or_default().push_back(index);
    }
    let mut moved = Moved::default();
    for (given, normalized) in left_over(given, pairs.iter().map(|pair| pair.1)) {
        if let Some(fresh) = left.get_mut(normalized).and_then(VecDeque::pop_front) {
            moved.from.insert(fresh, given);
            moved.to.insert(given, fresh);
        }
    }
    moved
}

/// The elements whose places are not among those taken, which ascend.
fn left_over(elements: &[u32], taken: impl Iterator<Item = usize>) -> impl Iterator<Item = (usize, &u32)> {
    let mut taken = taken.peekable();
    let is_free = move |&(index, _): &(usize, &u32)| taken.next_if_eq(&index).is_none();
    elements.iter().enumerate().filter(is_free)
}

/// Between two pairs: statements with other numbers are changed ones, and so are those in the same place among the rest.
fn gap(steps: &mut Vec<Step>, skeletons: &[Vec<u32>; 2], moved: &Moved, ranges: [Range<usize>; 2]) {
    let [in_fresh, in_given] = ranges;
    let end_fresh = in_fresh.end;
    let end_given = in_given.end;
    let fresh: Vec<usize> = in_fresh.filter(|index| !moved.from.contains_key(index)).collect();
    let given: Vec<usize> = in_given
        .clone()
        .filter(|index| !moved.to.contains_key(index))
        .collect();
    steps.extend(in_given.filter_map(|given| {
        let fresh = *moved.to.get(&given)?;
        Some(Step::Moved { fresh, given })
    }));
    let [fresh_kinds, given_kinds] = [(&fresh, 0), (&given, 1)].map(|(places, side)| {
        let kinds = skeletons.get(side).map_or(&[][..], Vec::as_slice);
        places
            .iter()
            .filter_map(|&place| kinds.get(place).copied())
            .collect::<Vec<_>>()
    });
    let alike = common(&fresh_kinds, &given_kinds);
    let mut from = (0, 0);
    for &(to_fresh, to_given) in alike.iter().chain([&(fresh.len(), given.len())]) {
        let rest_fresh = fresh.get(from.0..to_fresh).unwrap_or_default();
        let rest_given = given.get(from.1..to_given).unwrap_or_default();
        let after = (
            fresh.get(to_fresh).copied().unwrap_or(end_fresh),
            given.get(to_given).copied().unwrap_or(end_given),
        );
        rest(steps, rest_fresh, rest_given, after);
        if let (Some(&fresh), Some(&given)) = (fresh.get(to_fresh), given.get(to_given)) {
            steps.push(Step::Changed { fresh, given });
        }
        from = (to_fresh + 1, to_given + 1);
    }
}

/// Statements of different kinds: one for one as far as they go.
fn rest(steps: &mut Vec<Step>, fresh: &[usize], given: &[usize], after: Pair) {
    let both = fresh.len().min(given.len());
    let changed = fresh.iter().zip(given);
    steps.extend(changed.map(|(&fresh, &given)| Step::Changed { fresh, given }));
    let missing = fresh.get(both..).unwrap_or_default();
    steps.extend(missing.iter().map(|&fresh| Step::Missing {
        fresh,
        given: after.1,
    }));
    let added = given.get(both..).unwrap_or_default();
    steps.extend(added.iter().map(|&given| Step::Added {
        fresh: after.0,
        given,
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Steps between texts of letters and digits: a letter is a kind, a digit its number.
    fn of(fresh: &str, given: &str) -> Vec<Step> {
        let elements = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let number = |word: &String| word.bytes().fold(0, |all, byte| all * 256 + u32::from(byte)) % 60_000;
        let kind = |word: &String| u32::from(word.as_bytes()[0]);
        let (fresh, given) = (elements(fresh), elements(given));
        steps_between(
            &[&fresh, &given].map(|side| side.iter().map(number).collect()),
            &[&fresh, &given].map(|side| side.iter().map(kind).collect()),
        )
    }

    fn differences(fresh: &str, given: &str) -> Vec<Step> {
        let mut steps = of(fresh, given);
        steps.retain(|step| !matches!(step, Step::Same { .. }));
        steps
    }

    #[test]
    fn each_edit_is_one_step() {
        assert_eq!(differences("a1 b1 c1", "a1 b1 c1"), []);
        assert_eq!(
            differences("a1 b1 c1", "a1 b2 c1"),
            [Step::Changed { fresh: 1, given: 1 }]
        );
        assert_eq!(
            differences("a1 b1 c1", "a1 c1"),
            [Step::Missing { fresh: 1, given: 1 }]
        );
        assert_eq!(
            differences("a1 c1", "a1 b1 c1"),
            [Step::Added { fresh: 1, given: 1 }]
        );
        assert_eq!(
            differences("a1 b1 c1", "a1 b1"),
            [Step::Missing { fresh: 2, given: 2 }]
        );
        assert_eq!(
            differences("a1 b1 c1", "a1 x1 c1"),
            [Step::Changed { fresh: 1, given: 1 }]
        );
    }

    #[test]
    fn swapped_statements_are_a_move() {
        assert!(matches!(
            differences("a1 a2 a3 a4", "a1 a3 a2 a4")[..],
            [Step::Moved { .. }]
        ));
    }

    #[test]
    fn a_changed_statement_beside_a_missing_one_of_another_kind_is_distinguished() {
        assert_eq!(
            differences("a1 b1 c1 d1", "a1 c2 d1"),
            [
                Step::Missing { fresh: 1, given: 1 },
                Step::Changed { fresh: 2, given: 1 }
            ]
        );
    }

    proptest! {
        #[test]
        fn every_statement_is_reported_once(
            fresh in prop::collection::vec((0_u32..5, 0_u32..3), 0..40),
            given in prop::collection::vec((0_u32..5, 0_u32..3), 0..40),
        ) {
            let normalized_texts = [&fresh, &given].map(|side| side.iter().map(|(kind, n)| kind * 10 + n).collect::<Vec<_>>());
            let kinds = [&fresh, &given].map(|side| side.iter().map(|(kind, _)| *kind).collect::<Vec<_>>());
            let steps = steps_between(&normalized_texts, &kinds);
            let mut seen = (vec![0; fresh.len()], vec![0; given.len()]);
            for step in steps {
                match step {
                    Step::Same { fresh, given } | Step::Changed { fresh, given } | Step::Moved { fresh, given } => {
                        seen.0[fresh] += 1;
                        seen.1[given] += 1;
                    }
                    Step::Missing { fresh, .. } => seen.0[fresh] += 1,
                    Step::Added { given, .. } | Step::OfPart { given } => seen.1[given] += 1,
                }
            }
            prop_assert!(seen.0.iter().chain(&seen.1).all(|&count| count == 1));
        }
    }
}
