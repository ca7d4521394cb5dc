//! What parameters that were found by simulation came up against.
//!
//! A limit on scallop, time or cuts is one of these where a plan that was simulated is better by the objective and breaks
//! it, and the limit on scallop also where one that is faster by the model must leave too much, whatever its plan; a limit on a
//! parameter where that lies at it; the blade's edge where it does not reach what the least change of the
//! layer asks for.

use super::around::FACTORS;
use super::{Figures, Sound};
use crate::asked::{Lattice, RoughVcut};
use crate::plan::decision::{Excess, Standing};
use crate::plan::optimum::Bound;
use crate::plan::parameters::{Swung, VcutParameters};
use vcutc_backend_api::units::Length;
use vcutc_job::{Auto, Bounds};

/// The share of its limit from which on a scallop of fitted tips has reached it.
const REACHED: f64 = 0.99;

/// A plan that broke a limit.
pub(in crate::choice) struct TurnedDown {
    pub(in crate::choice) bound: Bound,
    figures: Figures,
}

impl TurnedDown {
    /// The limit that a plan broke, if it broke one.
    pub(in crate::choice) const fn of(standing: Standing, figures: Figures) -> Option<Self> {
        let bound = match standing {
            Standing::Leaves { .. } => Bound::Scallop,
            Standing::Exceeds(Excess::Time { .. }) => Bound::Time,
            Standing::Exceeds(Excess::Cuts { .. }) => Bound::Cuts,
            Standing::Takes(_)
            | Standing::Fails(_)
            | Standing::Impossible
            | Standing::ByModel(_)
            | Standing::NotCompared
            | Standing::Last
            | Standing::Narrowed
            | Standing::OnMachine
            | Standing::NotFollowed
            | Standing::LeftOut => return None,
        };
        Some(Self { bound, figures })
    }
}

/// The bounds on what is open that a sound plan came up against, in their order.
pub(super) fn binding(asked: &RoughVcut, sound: &Sound, turned_down: &[TurnedDown]) -> Vec<Bound> {
    let found = &sound.parameters;
    let limits = &asked.limits;
    let merit = |figures: &Figures| figures.merit(asked.objective.value);
    let mut met = Vec::new();
    if asked.swing.value == Auto::Auto {
        met.extend(touched(
            limits.swing,
            found.swing,
            [Bound::SwingLeast, Bound::SwingMost],
        ));
    }
    if asked.layer.value == Auto::Auto {
        met.extend(touched(
            limits.layer,
            found.layer,
            [Bound::LayerLeast, Bound::LayerMost],
        ));
        met.extend(is_at_the_edge(asked, found).then_some(Bound::Edge));
    }
    if asked.step.value == Auto::Auto {
        met.extend(touched(
            limits.step,
            found.step,
            [Bound::StepLeast, Bound::StepMost],
        ));
        if asked.overlap.value == Auto::Auto && found.overlap <= 0.0 && found.lattice != Lattice::Fitted {
            met.push(Bound::OverlapLeast);
        }
    }
    // The last row is as wide apart as the limit on the scallop allows.
    let is_reached = |limit: Length| sound.figures.height > limit * REACHED;
    let is_fitted = found.lattice == Lattice::Fitted;
    if is_fitted && asked.limits.scallop.is_some_and(|limit| is_reached(limit.value)) {
        met.push(Bound::Scallop);
    }
    let broken = turned_down
        .iter()
        .filter(|other| merit(&other.figures) < merit(&sound.figures));
    met.extend(broken.map(|other| other.bound));
    met.sort_unstable();
    met.dedup();
    met
}

/// The ends of a range that a value lies at.
fn touched<T: Copy + PartialOrd>(bounds: Bounds<T>, value: T, [least, most]: [Bound; 2]) -> Vec<Bound> {
    let at_least = bounds.least.filter(|end| value <= end.value).map(|_| least);
    let at_most = bounds.most.filter(|end| value >= end.value).map(|_| most);
    at_least.into_iter().chain(at_most).collect()
}

/// Whether the blade does not reach a layer that is thicker by the least change that is tried.
fn is_at_the_edge(asked: &RoughVcut, found: &VcutParameters) -> bool {
    let Some(swung) = Swung::new(asked, found.lattice, found.swing) else {
        return false;
    };
    let least_change = FACTORS.into_iter().fold(f64::INFINITY, f64::min);
    let most = match asked.step.value {
        Auto::Given(step) => swung.layer_at_step(step).unwrap_or(found.layer),
        Auto::Auto => swung.layer_at_overlap(found.overlap),
    };
    found.layer * least_change > most
}
