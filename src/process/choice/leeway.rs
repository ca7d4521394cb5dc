//! What is considered of what a job leaves open: all of it, or less where the machine does not follow.

use super::route;
use crate::plan::decision::{Candidate, Decision, Standing};
use crate::plan::optimum::Bound;
use crate::plan::parameters::show;
use crate::plan::{PlannedJob, PlannedOperation, PlannedVcut};
use vcutc_backend_api::ir::AxisKind;
use vcutc_backend_api::units::Angle;
use vcutc_job::{Auto, Bounds, Machine, Operation, Order, RoughVcut, Sourced};

/// Which routes are considered where the job leaves them open. Fast ones turn the blade more at the work and retract it less,
/// which not every machine can follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Latitude {
    /// All of them.
    Full,
    /// Those that cut V by V.
    ByPoint,
    /// Rows, V by V: what leaves an arm the most freedom to stand otherwise.
    RowsByPoint,
    /// Those that cut a layer's left flanks and then its right ones: the blade never turns in the work.
    ByLayer,
    /// Rows of them.
    RowsByLayer,
}

impl Latitude {
    /// What is considered next where the machine cannot carry out what came of this.
    const fn narrower(self) -> Option<Self> {
        match self {
            Self::Full => Some(Self::ByPoint),
            Self::ByPoint => Some(Self::RowsByPoint),
            Self::RowsByPoint => Some(Self::ByLayer),
            Self::ByLayer => Some(Self::RowsByLayer),
            Self::RowsByLayer => None,
        }
    }

    /// The next one under which something else would come out than this plan.
    #[must_use]
    pub fn narrower_than(self, plan: &PlannedJob) -> Option<Self> {
        let mut next = self.narrower();
        while let Some(latitude) = next {
            let is_same = plan.operations.iter().all(|PlannedOperation::RoughVcut(vcut)| {
                route::allows(latitude, &vcut.asked, (vcut.sequence, vcut.order))
            });
            if !is_same {
                break;
            }
            next = latitude.narrower();
        }
        next
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
    Range {
        /// The axis.
        axis: usize,
    },
    /// An axis, by its number from 0, is too slow.
    Rate {
        /// The axis.
        axis: usize,
        /// How fast it would have to move, in rad/s or mm/s.
        needed: f64,
    },
    /// Room around its singular poses.
    Clearance,
}

/// What is considered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leeway {
    /// The routes.
    pub routes: Latitude,
    /// The swings; none where all that the job allows are considered.
    pub swing: Option<Narrowed>,
}

impl Leeway {
    /// All routes of a kind, and all swings.
    #[must_use]
    pub const fn along(routes: Latitude) -> Self {
        Self { routes, swing: None }
    }
}

/// Whether a narrower swing is a choice of the compiler's.
#[must_use]
pub fn is_swing_open(operation: &Operation) -> bool {
    let Operation::RoughVcut(asked) = operation;
    asked.swing.value == Auto::Auto
}

/// What the swing of an operation is held within besides the job's limits.
pub(super) fn narrowed(asked: &RoughVcut, swing: Option<Narrowed>) -> Option<Narrowed> {
    let limits = asked.limits.swing;
    swing.filter(|swing| {
        asked.swing.value == Auto::Auto
            && limits.least.is_none_or(|least| least.value <= swing.widest)
            && limits.most.is_none_or(|most| most.value > swing.widest)
    })
}

/// The operation with a narrower limit on its swing.
pub(super) fn within(asked: &RoughVcut, swing: Option<Narrowed>) -> RoughVcut {
    let mut asked = asked.clone();
    if let Some(swing) = narrowed(&asked, swing) {
        asked.limits.swing.most = Some(Sourced {
            value: swing.widest,
            span: None,
        });
    }
    asked
}

/// Gives a planned operation the job's own limits back, and says what narrowed its swing.
pub(super) fn told(
    vcut: &mut PlannedVcut,
    limits: Bounds<Angle>,
    swing: Narrowed,
    machine: Option<&Machine>,
) {
    vcut.asked.limits.swing = limits;
    vcut.parameters.binding.retain(|&bound| bound != Bound::SwingMost);
    let degrees = |swing: Angle| format!("{} deg", show(swing.to_deg()));
    let decision = Decision {
        field: "swing",
        taken: Candidate {
            what: format!("at most {}", degrees(swing.widest)),
            standing: Standing::Narrowed,
        },
        others: vec![Candidate {
            what: format!(
                "{} at {}",
                lack_in_words(swing.lack, machine),
                degrees(swing.refused)
            ),
            standing: Standing::NotFollowed,
        }],
    };
    vcut.decisions.insert(0, decision);
}

/// `A4 too slow`, with how fast it would have to be.
fn lack_in_words(lack: Lack, machine: Option<&Machine>) -> String {
    let axis = |index: usize| machine.and_then(|machine| machine.model.axes.get(index));
    match lack {
        Lack::Reach => "out of reach".to_owned(),
        Lack::Clearance => "too close to a singularity".to_owned(),
        Lack::Range { axis: index } => match axis(index) {
            Some(axis) => format!("{} leaves its range", axis.name),
            None => "an axis leaves its range".to_owned(),
        },
        Lack::Rate { axis: index, needed } => match axis(index) {
            Some(axis) => {
                let shown = |rate: f64| match axis.kind {
                    AxisKind::Rotary => format!("{:.1} deg/s", rate.to_degrees()),
                    AxisKind::Linear => format!("{rate:.1} mm/s"),
                };
                let limit = axis
                    .rate
                    .map_or_else(String::new, |limit| format!(" of {}", shown(limit)));
                format!("{} would need {}{limit}", axis.name, shown(needed))
            }
            None => "an axis is too slow".to_owned(),
        },
    }
}
