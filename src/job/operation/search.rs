//! Which part of what a job leaves open is searched: all of it, or less where the machine does not follow.

use crate::{Machine, Order};
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::units::Angle;

/// How hard the best of what a job leaves open is searched for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SearchEffort {
    #[default]
    Normal,
    /// Up to ten times as many plans.
    High,
}

impl SearchEffort {
    /// How many times as many plans as usual may be made.
    #[must_use]
    pub const fn times(self) -> usize {
        match self {
            Self::Normal => 1,
            Self::High => 10,
        }
    }
}

/// Which routes are considered where the job leaves them open. Fast ones turn the blade more at the work and retract it less,
/// which not every machine can follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouteSet {
    Full,
    /// Those that cut V by V.
    ByPoint,
    /// Rows, V by V: what leaves an arm the most freedom to hold the blade otherwise.
    RowsByPoint,
    /// Those that cut a layer's left flanks and then its right ones: the blade never turns in the work.
    ByLayer,
    RowsByLayer,
}

impl RouteSet {
    /// What is considered next where the machine cannot carry out this result.
    #[must_use]
    pub const fn narrower(self) -> Option<Self> {
        match self {
            Self::Full => Some(Self::ByPoint),
            Self::ByPoint => Some(Self::RowsByPoint),
            Self::RowsByPoint => Some(Self::ByLayer),
            Self::ByLayer => Some(Self::RowsByLayer),
            Self::RowsByLayer => None,
        }
    }

    /// The only order of flanks that it leaves, if it leaves one.
    #[must_use]
    pub const fn order(self) -> Option<Order> {
        match self {
            Self::Full => None,
            Self::ByPoint | Self::RowsByPoint => Some(Order::Point),
            Self::ByLayer | Self::RowsByLayer => Some(Order::Layer),
        }
    }
}

/// The widest swing that is considered where the job leaves the swing open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrowed {
    /// The swing.
    pub widest: Angle,
    /// The swing that the machine did not follow.
    pub refused: Angle,
    /// What it lacked for that.
    pub lack: Lack,
}

/// What a machine lacked for a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lack {
    /// It does not reach that far.
    Reach,
    /// An axis, by its number from 0, has too little range.
    Range { axis: usize },
    /// An axis, by its number from 0, is too slow.
    Rate {
        axis: usize,
        /// How fast it would have to move, in rad/s or mm/s.
        needed: f64,
    },
    /// Room around its singular poses.
    Clearance,
}

/// What a machine makes of a program, as far as a few of its motions show: the program with turns that the axes follow, or nothing
/// where they do not follow it however slowly the blade turns.
#[derive(Clone, Copy, Debug)]
pub struct OnMachine(pub fn(&Machine, &Program) -> Option<Program>);

impl PartialEq for OnMachine {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::fn_addr_eq(self.0, other.0)
    }
}

/// Plans are compared as a machine carries them out, because it does not follow the best one exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    pub by: OnMachine,
    /// The widest of the swings of that plan that are open, if any is.
    pub refused: Option<Angle>,
    /// What the machine lacked for it.
    pub lack: Lack,
}

/// What is considered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchSpace {
    pub routes: RouteSet,
    /// The swings; none where all that the job allows are considered.
    pub swing: Option<Narrowed>,
    /// What the machine follows; none where the plan does not depend on it.
    pub machine: Option<Followed>,
}

impl SearchSpace {
    /// All routes of a kind, and all swings.
    #[must_use]
    pub const fn along(routes: RouteSet) -> Self {
        Self {
            routes,
            swing: None,
            machine: None,
        }
    }
}
