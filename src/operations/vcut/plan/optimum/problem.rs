//! The problem and its answer.

use crate::asked::{Formulas, Lattice, Objective};
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Duration, Length, Speed};

/// A closed range of values; a value that is given is a range of one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range<T> {
    pub least: T,
    /// The largest value.
    pub most: T,
}

/// What is to be optimised.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What is to become least.
    pub objective: Objective,
    pub formulas: Formulas,
    /// Lattices to choose from; at least one.
    pub lattices: Vec<Lattice>,
    /// The work and how it is done.
    pub work: Work,
    /// Swing; above 0 and below 90 degrees.
    pub swing: Range<Angle>,
    /// Layer; positive. Without a limit, `most` is the depth of the stock above the part's lowest point.
    pub layer: Range<Length>,
    /// Step; positive. Without a limit, `most` is the stock's width.
    pub step: Range<Length>,
    /// Overlap; below 1. Negative values leave gaps, which only a given step and layer can ask for.
    pub overlap: Range<f64>,
    /// Largest scallop bound of the lattice, allowance and standoff included; none without a limit.
    pub scallop: Option<Length>,
    /// Longest edge in use; none without a limit below the blade's cutting length.
    pub edge: Option<Length>,
    /// Longest time by the model.
    pub time: Option<Duration>,
    /// Most V-cuts by the model.
    pub cuts: Option<f64>,
}

/// The work and how it is done: what the time model needs beside the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// Stock across the cuts (W).
    pub width: Length,
    /// Stock along the cuts (D).
    pub depth: Length,
    /// Area to remove in the x-z plane (A_C).
    pub area: Area,
    /// Safe plane above the stock (h0).
    pub clearance: Length,
    /// Edge length of the blade (L).
    pub cutting_length: Length,
    /// Half apex angle of the blade (beta).
    pub half_apex: Angle,
    /// Rake (theta); above the half apex angle.
    pub rake: Angle,
    /// What stays on the part whatever the lattice: the allowance.
    pub allowance: Length,
    /// Distance of the blade's middle plane from the material that stays (e); it raises the tip by `e / sin(swing)`.
    pub standoff: Length,
    /// How far a cut runs out beyond the stock (b).
    pub extension: Extension,
    /// Cutting speed (v1).
    pub cut_feed: Speed,
    /// Speed through the air (v2).
    pub travel_feed: Speed,
    /// Rate of turning (omega).
    pub reorient_rate: AngularSpeed,
}

/// How far a cut runs out beyond the stock, and how that depends on the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extension {
    /// So far, whatever the parameters.
    Fixed(Length),
    /// As far as the edge in use lies along y [Cui 5].
    EdgeInUse,
    /// As far as the edge or the leaning body lies over the work, and this much air: what the planner makes of `auto`
    /// (`docs/process.md`, "Extension and the leaning blade").
    Leaning {
        /// How far the edge lies over the work while it cuts and turns.
        edge: Length,
        /// Air between the blade and the stock.
        run_out: Length,
    },
}

/// A bound that can bind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bound {
    SwingLeast,
    /// The largest swing.
    SwingMost,
    LayerLeast,
    /// The largest layer.
    LayerMost,
    StepLeast,
    /// The largest step.
    StepMost,
    /// The least overlap: neighbouring Vs may not leave a gap.
    OverlapLeast,
    /// The largest overlap.
    OverlapMost,
    /// The largest scallop.
    Scallop,
    /// The longest edge in use, by a limit or by the blade.
    Edge,
    /// The longest time.
    Time,
    Cuts,
}

/// An end of what is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Least,
    /// The largest value.
    Most,
}

/// The best parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    pub lattice: Lattice,
    pub swing: Angle,
    pub layer: Length,
    pub step: Length,
    /// The overlap: `1 - step / (2 layer tan(swing))`.
    pub overlap: f64,
    /// Time by the model.
    pub time: Duration,
    /// Scallop bound, allowance and standoff included.
    pub scallop: Length,
    /// Edge in use.
    pub edge: Length,
    /// V-cuts by the model.
    pub cuts: f64,
    /// Bounds that the parameters touch, in the order of [`Bound`]; both ends of a value that is given.
    pub binding: Vec<Bound>,
    /// No parameters make the objective smaller than this one's by more than this share of it: what was proven.
    pub gap: f64,
}

impl Optimum {
    /// What an objective comes to, in s, mm or cuts.
    #[must_use]
    pub const fn value(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Time => self.time.to_s(),
            Objective::Scallop => self.scallop.to_mm(),
            Objective::Cuts => self.cuts,
            Objective::BladeLoad => self.edge.to_mm(),
        }
    }
}

/// What relaxing a bound would buy.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    pub bound: Bound,
    /// Its value in mm, rad, s or 1.
    pub now: f64,
    /// Its value relaxed by 1 %.
    pub relaxed: f64,
    /// The best parameters then.
    pub then: Optimum,
}

/// That there are no parameters, before anybody asks why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// Some bounds cannot be kept together.
    Conflict,
    /// As [`Infeasible::Unbounded`].
    Unbounded,
}

/// Why there are no parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Infeasible {
    /// Bounds that cannot be kept together.
    Conflict {
        /// The bounds: without any one of them the others can be kept. Usually two.
        bounds: Vec<Bound>,
        /// For each of the bounds the nearest value, in mm, rad, s or 1, that all other bounds of the problem allow, when
        /// there is one.
        nearest: Vec<Option<f64>>,
    },
    /// Nothing stops the objective from falling: a scallop or an edge in use becomes the smaller the thinner
    /// the layer, and no time, cuts, least layer or least step is asked for.
    Unbounded,
}
