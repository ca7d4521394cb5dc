//! How far a search for parameters went.

use vcutc_backend_api::words::counted;
use vcutc_job::search::SearchEffort;

/// The plans that were made to find parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Searched {
    /// How many.
    pub plans: usize,
    /// On how many lattices.
    pub lattices: usize,
    pub end: End,
    pub effort: SearchEffort,
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// No better plan came for a while.
    NoneBetter,
    /// As many plans were made as may be.
    Budget,
}

impl Searched {
    /// This search, and one on other lattices.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            plans: self.plans + other.plans,
            lattices: self.lattices + other.lattices,
            end: self.end.max(other.end),
            effort: self.effort,
        }
    }

    /// This search, after another one on the same lattices.
    #[must_use]
    pub const fn after(self, other: Self) -> Self {
        Self {
            plans: self.plans + other.plans,
            ..self
        }
    }

    /// `96 plans on 3 lattices, until none was better for a while`.
    #[must_use]
    pub fn words(self) -> String {
        let plans = counted(self.plans, "plan");
        let on = match self.lattices {
            1 => String::new(),
            lattices => format!(" on {lattices} lattices"),
        };
        let end = match (self.end, self.effort) {
            (End::NoneBetter, _) => "until none was better for a while",
            (End::Budget, SearchEffort::Normal) => "the most that are made without `--effort high`",
            (End::Budget, SearchEffort::High) => "the most that are made",
        };
        format!("{plans}{on}, {end}")
    }
}
