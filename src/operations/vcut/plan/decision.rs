//! Why a choice that the job leaves open came out as it did: what was compared, as data.

use core::cmp::Ordering;
use vcutc_backend_api::units::{Duration, Length};

/// A choice that was made by comparing plans.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// The field of the language that was left open; where `order` is decided with it, that one is part of the words.
    pub field: &'static str,
    pub taken: Candidate,
    /// What was not, the best first.
    pub others: Vec<Candidate>,
}

/// One way to cut the operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// As a person would write it: `boustrophedon by point`.
    pub what: String,
    /// Its result.
    pub standing: Standing,
}

/// The result of a way to cut an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// It takes this time, and nothing is wrong with it.
    Takes(Duration),
    /// It takes longer, or has more cuts, than it may.
    Exceeds(Excess),
    /// More stays on the part than may.
    Leaves {
        /// How much: the machined contour's largest distance from the part.
        height: Length,
        /// How much may stay.
        limit: Length,
    },
    /// So many cuts do not come free or are blocked.
    Fails(usize),
    /// It cannot be planned, or cuts nothing.
    Impossible,
    /// It was not planned: this is its time by the mean-value model, far above that of another one.
    ByModel(Duration),
    /// The operation is too large to compare what could be had.
    NotCompared,
    /// The machine does not follow the faster ones.
    Last,
    /// It is the widest of those tried that the machine follows.
    Narrowed,
    /// It is the best of those that were compared on the machine, which does not follow what is better without it.
    OnMachine,
    /// The machine does not follow it.
    NotFollowed,
    /// It was left out, because the machine did not follow the best plan of its kind.
    LeftOut,
}

/// A limit of a plan that is exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Excess {
    /// It takes longer than it may.
    Time {
        /// How long it takes.
        time: Duration,
        /// How long it may take.
        limit: Duration,
    },
    /// It has more cuts than it may.
    Cuts {
        cuts: usize,
        /// How many it may have.
        limit: f64,
    },
}

impl Excess {
    /// What there is as a share of what may be: above 1.
    #[must_use]
    pub fn share(self) -> f64 {
        match self {
            Self::Time { time, limit } => time / limit,
            Self::Cuts { cuts, limit } => cuts as f64 / limit,
        }
    }
}

impl Standing {
    /// How long it takes, if nothing is wrong with it.
    #[must_use]
    pub const fn time(&self) -> Option<Duration> {
        match self {
            Self::Takes(time) => Some(*time),
            Self::Exceeds(_)
            | Self::Leaves { .. }
            | Self::Fails(_)
            | Self::Impossible
            | Self::ByModel(_)
            | Self::NotCompared
            | Self::Last
            | Self::Narrowed
            | Self::OnMachine
            | Self::NotFollowed
            | Self::LeftOut => None,
        }
    }

    /// The better one first. Ways that fail are all alike: none of them can be taken as it is.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Takes(time), Self::Takes(than)) | (Self::ByModel(time), Self::ByModel(than)) => {
                time.total_cmp(than)
            }
            (Self::Leaves { height, .. }, Self::Leaves { height: than, .. }) => height.total_cmp(than),
            (Self::Exceeds(excess), Self::Exceeds(than)) => excess.share().total_cmp(&than.share()),
            (one, other) => one.kind().cmp(&other.kind()),
        }
    }

    const fn kind(&self) -> u8 {
        match self {
            Self::Takes(_) => 0,
            Self::Exceeds(_) => 1,
            Self::Leaves { .. } => 2,
            Self::NotFollowed => 3,
            Self::Fails(_) => 4,
            Self::ByModel(_) => 5,
            Self::NotCompared => 6,
            Self::Last => 7,
            Self::Narrowed | Self::OnMachine => 8,
            Self::LeftOut => 9,
            Self::Impossible => 10,
        }
    }
}
