//! How much may be planned for answers that are not plans: for remedies, and for steps on the way to a plan.

/// What a plan costs whatever its size, in cuts.
const EACH: usize = 20;

/// How many cuts may still be laid out and replayed.
#[derive(Debug)]
pub struct Effort {
    cuts: usize,
}

impl Effort {
    /// All remedies that are tried for one job that is refused.
    pub const OF_A_REFUSAL: Self = Self { cuts: 60_000 };

    /// One question whether there is any sound plan.
    pub const OF_A_PROBE: Self = Self { cuts: 40_000 };

    pub const UNBOUNDED: Self = Self { cuts: usize::MAX };

    /// Counts a plan of so many cuts.
    pub const fn spend(&mut self, cuts: usize) {
        self.cuts = self.cuts.saturating_sub(cuts.saturating_add(EACH));
    }

    /// Whether it is too little for a plan of about so many cuts.
    pub fn is_less_than(&self, cuts: f64) -> bool {
        (self.cuts as f64) < cuts
    }

    /// Whether nothing may be planned any more.
    pub const fn is_spent(&self) -> bool {
        self.cuts == 0
    }

    /// One of so many equal parts, for someone else to spend.
    pub fn part(&mut self, of: usize) -> Self {
        let cuts = self.cuts.div_ceil(of.max(1));
        self.cuts -= cuts;
        Self { cuts }
    }

    /// Takes back what is left of a part.
    pub const fn give_back(&mut self, part: &Self) {
        self.cuts = self.cuts.saturating_add(part.cuts);
    }
}
