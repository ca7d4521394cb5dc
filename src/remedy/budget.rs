//! How much is tried for one question, counted in tries and in cuts, since a try takes as long as its cuts are many.

use vcutc_cancellation::Wanted;

/// The size of a budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Tries that are made however many cuts they have.
    pub least_tries: usize,
    pub most_tries: usize,
    /// Most cuts of all tries together, beyond the least tries.
    pub cuts: usize,
}

impl Size {
    /// Changes for a plan that its machine does not carry out: a few seconds on one processor.
    pub const REMEDIES: Self = Self {
        least_tries: 2,
        most_tries: 20,
        cuts: 4_000,
    };

    /// Changed texts, compiled as far as the target. The budget is larger than that of remedies since it serves offers of the
    /// planner as well, and the tries are fewer since each plans along all routes.
    pub const TEXTS: Self = Self {
        least_tries: 2,
        most_tries: 12,
        cuts: 6_000,
    };

    /// Changes that save time. The job compiles without them, so a job of many cuts goes without.
    pub const HINTS: Self = Self {
        least_tries: 0,
        most_tries: 6,
        cuts: 6_000,
    };

    /// Plans with other routes or narrower swings. They are part of every compilation, so they cost least; but every kind of
    /// route and a narrower swing are tried in any case.
    pub const FALLBACKS: Self = Self {
        least_tries: 4,
        most_tries: 10,
        cuts: 1_500,
    };
}

/// What is left to try for one question, and whether its answer is still wanted.
#[derive(Clone, Debug)]
pub struct Budget {
    size: Size,
    tries: usize,
    cuts: usize,
    pub wanted: Wanted,
}

impl Budget {
    #[must_use]
    pub fn new(size: Size, wanted: &Wanted) -> Self {
        Self {
            size,
            tries: 0,
            cuts: 0,
            wanted: wanted.clone(),
        }
    }

    /// How many tries were made.
    #[must_use]
    pub const fn tries(&self) -> usize {
        self.tries
    }

    /// Whether all cuts of the budget were tried, however many tries are left.
    #[must_use]
    pub const fn is_out_of_cuts(&self) -> bool {
        self.cuts >= self.size.cuts
    }

    /// Whether nothing more may be tried.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        !self.affords(1)
    }

    /// Counts a try that had so many cuts.
    pub const fn spend(&mut self, cuts: usize) {
        self.tries += 1;
        self.cuts = self.cuts.saturating_add(cuts);
    }

    /// Takes a try of so many cuts, if it is affordable.
    pub fn take(&mut self, cuts: usize) -> bool {
        let affords = self.affords(cuts);
        if affords {
            self.spend(cuts);
        }
        affords
    }

    fn affords(&self, cuts: usize) -> bool {
        let Size {
            least_tries,
            most_tries,
            cuts: most_cuts,
        } = self.size;
        let has_room = self.tries < most_tries && self.cuts.saturating_add(cuts) <= most_cuts;
        (self.tries < least_tries || has_room) && !self.wanted.is_needless()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How often a job of so many cuts is tried.
    fn tries(size: Size, cuts: usize) -> usize {
        let mut budget = Budget::new(size, &Wanted::ALWAYS);
        while budget.take(cuts) {}
        budget.tries()
    }

    #[test]
    fn large_jobs_are_tried_less_often() {
        for (cuts, remedies, hints) in [
            (0, 20, 6),
            (14, 20, 6),
            (400, 10, 6),
            (2_000, 2, 3),
            (6_001, 2, 0),
        ] {
            assert_eq!(tries(Size::REMEDIES, cuts), remedies, "{cuts}");
            assert_eq!(tries(Size::HINTS, cuts), hints, "{cuts}");
        }
    }

    #[test]
    fn cuts_that_are_known_afterwards_end_a_budget_when_they_are_spent() {
        let mut budget = Budget::new(Size::FALLBACKS, &Wanted::ALWAYS);
        for _ in 0..4 {
            assert!(!budget.is_spent());
            budget.spend(1_000);
        }
        assert!(budget.is_spent() && budget.is_out_of_cuts());
    }

    #[test]
    fn nothing_is_tried_for_an_answer_that_is_not_wanted() {
        assert!(!Budget::new(Size::REMEDIES, &Wanted::never()).take(1));
    }
}
