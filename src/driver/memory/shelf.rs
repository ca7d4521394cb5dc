//! A few answers with the questions that they belong to, the latest used last.
//!
//! Questions are compared by value, not by a hash of it: an answer that belongs to another question cannot be found.

/// A question, its answer, and how much room the two take.
#[derive(Debug)]
struct Kept<Q, A> {
    question: Q,
    answer: A,
    size: usize,
}

/// Answers up to a size in all.
#[derive(Debug)]
pub(super) struct Shelf<Q, A> {
    kept: Vec<Kept<Q, A>>,
    room: usize,
}

impl<Q: PartialEq, A> Shelf<Q, A> {
    /// Most answers, however small: every question is compared with all of them.
    const MOST: usize = 16;

    pub(super) const fn with_room(room: usize) -> Self {
        Self {
            kept: Vec::new(),
            room,
        }
    }

    /// Whether something of that size is kept at all.
    pub(super) const fn takes(&self, size: usize) -> bool {
        size < self.room
    }

    /// How many answers are kept.
    #[cfg(test)]
    pub(super) const fn count(&self) -> usize {
        self.kept.len()
    }

    /// The answer to a question, if it is kept.
    pub(super) fn find(&mut self, question: &Q) -> Option<&A> {
        let place = self.kept.iter().position(|kept| kept.question == *question)?;
        if let Some(used) = self.kept.get_mut(place..) {
            used.rotate_left(1);
        }
        self.kept.last().map(|kept| &kept.answer)
    }

    /// Keeps an answer, and lets go of those that were used longest ago as far as it needs their room.
    pub(super) fn keep(&mut self, question: Q, answer: A, size: usize) {
        if !self.takes(size) {
            return;
        }
        self.kept.push(Kept {
            question,
            answer,
            size,
        });
        let mut all: usize = self.kept.iter().map(|kept| kept.size).sum();
        let mut gone = 0;
        while let Some(oldest) = self.kept.get(gone)
            && (all >= self.room || self.kept.len() - gone > Self::MOST)
        {
            all -= oldest.size;
            gone += 1;
        }
        self.kept.drain(..gone);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn holds_what_was_used_last_within_its_room(
            room in 0_usize..40, asked in prop::collection::vec((0_u8..24, 1_usize..12), 0..120),
        ) {
            let mut shelf = Shelf::with_room(room);
            // The same in the plainest way: all that was ever used, the latest last.
            let mut used: Vec<(u8, usize)> = Vec::new();
            for (question, size) in asked {
                let held: Vec<(u8, usize)> = {
                    let mut all = 0;
                    let mut held: Vec<(u8, usize)> = used.iter().rev().copied().take(Shelf::<u8, usize>::MOST)
                        .take_while(|(_, size)| { all += size; all < room })
                        .collect();
                    held.reverse();
                    held
                };
                let known = held.iter().find(|(known, _)| *known == question).copied();
                prop_assert_eq!(shelf.find(&question).copied(), known.map(|(_, size)| size));
                used = held;
                match known {
                    Some(known) => { used.retain(|other| *other != known); used.push(known); }
                    None => {
                        shelf.keep(question, size, size);
                        if size < room { used.push((question, size)); }
                    }
                }
            }
        }
    }
}
