//! What a job asks of V-shaped roughing.

use std::sync::Arc;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::source::Span;
use vcutc_geometry::curve::Point2;
use vcutc_job::follow::{Along, Family, Follow};
use vcutc_job::{Auto, Bounds, Order, Setup, Sourced, StraightBlade, words};

/// V-shaped roughing. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughVcut {
    /// What all operations state.
    pub setup: Setup,
    /// The blade.
    pub blade: StraightBlade,
    /// Where the tips run, in the order in which they are cut; none for a lattice. Where they are given, `lattice`, `layer`
    /// and `step` are what they come nearest to, `residual`, `redundant`, `avoid` and `sequence` have no say, and the swing is given.
    pub tips: Option<Arc<Tips>>,
    /// How tips are laid out.
    pub lattice: Sourced<Auto<Lattice>>,
    /// Half the opening angle of the V; above 0 and below 90 degrees.
    pub swing: Sourced<Auto<Angle>>,
    /// Layer spacing; positive.
    pub layer: Sourced<Auto<Length>>,
    /// Spacing of tips within a layer; positive.
    pub step: Sourced<Auto<Length>>,
    /// Overlap of neighbouring cuts when the step is left open; 0 to below 1.
    pub overlap: Sourced<Auto<f64>>,
    /// What the open parameters are to make least. Default `time`.
    pub objective: Sourced<Objective>,
    /// By which formulas they are chosen. Default `exact`.
    pub formulas: Sourced<Formulas>,
    /// Bounds.
    pub limits: Limits,
    /// Material that must stay on the part, measured along its normal; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// What becomes of tips that would cut the part.
    pub residual: Sourced<Auto<Residual>>,
    /// What to do with redundant Vs.
    pub redundant: Sourced<Auto<Redundant>>,
    /// How a V keeps out of the part and of what stands where it does not fit as it is. Default `lift`.
    pub avoid: Sourced<Avoid>,
    /// Order of the flanks.
    pub order: Sourced<Auto<Order>>,
    /// Order of the Vs.
    pub sequence: Sourced<Auto<Sequence>>,
    /// Distance of the blade's middle plane from the material that stays; `auto` is half the blade's thickness.
    pub standoff: Sourced<Auto<Length>>,
    /// How the cuts follow a part that changes along y. Default `straight`.
    pub follow: Sourced<Follow>,
    /// The family of ways that they follow it by: the one that the job names, or the one that was chosen.
    pub family: Family,
    /// What tips are offset against. Default `nothing`.
    pub compensate: Sourced<Compensate>,
    /// What the cuts follow; none where they are level.
    pub along: Option<Along>,
}

/// Tips that a job gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Tips {
    /// The tips in the order in which they are cut, at least one, within the stock.
    pub tips: Vec<Tip>,
    /// Where the word `tips` stands.
    pub span: Span,
}

/// Fields that lay out a lattice or choose among several. They have no say where tips are given.
pub const OF_A_LATTICE: [&str; 10] = [
    "lattice",
    "layer",
    "step",
    "overlap",
    "objective",
    "model",
    "residual",
    "redundant",
    "avoid",
    "sequence",
];

/// A tip that a job gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Where it runs in the x-z plane of the workpiece, in mm.
    pub point: Point2,
    /// Where it is written.
    pub span: Span,
}

/// Bounds on what the planner may choose and on the result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The swing.
    pub swing: Bounds<Angle>,
    /// Layer spacing.
    pub layer: Bounds<Length>,
    /// Spacing of tips within a layer.
    pub step: Bounds<Length>,
    /// Largest height of material left standing: distance of the machined contour from the nearest point of the part.
    pub scallop: Option<Sourced<Length>>,
    /// How `scallop` was chosen, where the job sets no such limit and the compiler chose one; none in a job as written.
    pub chosen: Option<ChosenScallop>,
    /// Longest edge that a cut may use.
    pub edge: Option<Sourced<Length>>,
    /// Farthest that a flank may be off for the forces of the blade.
    pub deviation: Option<Sourced<Length>>,
    /// Longest time of the operation, as planned.
    pub time: Option<Sourced<Duration>>,
    /// Most V-cuts of the operation, as planned; at least 1.
    pub cuts: Option<Sourced<f64>>,
}

/// How a limit on the scallop was chosen for an operation that has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenScallop {
    /// The mean depth of what the operation is to take away, along the part.
    pub depth: Length,
    /// What the limit was taken for.
    pub why: WhyChosen,
}

/// Why a limit on the scallop is the chosen one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhyChosen {
    /// It is the widest of those tried under which at most a tenth stays of what is to go.
    LittleStays,
    /// It is the widest of those tried; under none of them, however tight, a tenth or less stayed.
    MoreStays,
    /// It is the tightest of those tried that a plan keeps.
    TightestKept,
}

/// What the open parameters of an operation are to make least, within its limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// Processing time.
    Time,
    /// Height of material left standing on the part.
    Scallop,
    /// Number of V-cuts.
    Cuts,
    /// Length of edge in the material.
    BladeLoad,
}

/// By which formulas open parameters are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulas {
    /// Those of the paper as printed [Cui 8-14].
    Paper,
    /// The blade's true reach and the lattice's true scallop (`docs/process.md`).
    Exact,
}

/// How tips are laid out [Cui fig. 4].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lattice {
    /// The same x in every layer.
    Orthogonal,
    /// Every other layer shifted by half a step.
    Interlaced,
    /// Every layer on its own, its outer tips on the part's profile.
    Free,
    /// The last row on the part, as wide apart as the scallop allows, and rows above it as wide apart as the blade's reach allows.
    Fitted,
}

/// In which order the Vs of an operation are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sequence {
    /// Layer by layer, each from left to right.
    Rows,
    /// Layer by layer, to and fro.
    Boustrophedon,
    /// Always the nearest one whose chip comes free.
    Nearest,
}

/// What becomes of a tip that would cut the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Residual {
    /// It is dropped.
    Discard,
    /// It is raised until it clears the part.
    Lift,
    /// It slides within its layer until it clears the part.
    Shift,
    /// Dropped where the residual stays within the limit, else raised, else moved if its chip does not come free there.
    /// Regular tips whose chips do not come free are raised by the least that frees them.
    Mixed,
}

/// What to do with a V without which every other chip comes free and no more material stays than the limit allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Redundant {
    /// It is cut.
    Keep,
    /// It is not cut.
    Skip,
}

/// How a V that does not fit keeps out of the part and of what stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Avoid {
    /// Its tip is raised, moved or dropped, by the residual strategy.
    Lift,
    /// The same where that keeps the limit on scallop; else each of its flanks is cut with the largest swing that is clear.
    Swing,
}

/// What tips are offset against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensate {
    /// Nothing: they run where they are planned.
    Nothing,
    /// What the forces of the blade do to the arm.
    Forces,
}

words! {
    Lattice { Orthogonal = "orthogonal", Interlaced = "interlaced", Free = "free", Fitted = "fitted" }
    Objective { Time = "time", Scallop = "scallop", Cuts = "cuts", BladeLoad = "blade_load" }
    Formulas { Paper = "paper", Exact = "exact" }
    Residual { Discard = "discard", Lift = "lift", Shift = "shift", Mixed = "mixed" }
    Redundant { Keep = "keep", Skip = "skip" }
    Avoid { Lift = "lift", Swing = "swing" }
    Compensate { Nothing = "nothing", Forces = "forces" }
    Sequence { Rows = "rows", Boustrophedon = "boustrophedon", Nearest = "nearest" }
}
