//! The results of `vcutc optimize`, for programs.

use super::bounds::Relaxed;
use super::others::{self, OtherBody, ProcessBody};
use super::rect::{RectBody, RectOptimum};
use super::{
    Came, Faster, FoundBy, GivenOperation, Loosened, OperationOptimum, Optimisation, Plan, Point, Role, Row,
    TradeOff,
};
use serde::Serialize;
use vcutc_vcut::plan::optimum::{Bound, Optimum};

/// The results of `vcutc optimize`.
#[derive(Debug, Serialize)]
pub struct OptimisationBody<'a> {
    job: &'a str,
    /// In mm, simulated.
    scallop: f64,
    operations: Vec<OperationBody<'a>>,
    /// Operations along tips that the job gives.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    given: Vec<GivenBody<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    others: Vec<OtherBody<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    processes: Vec<ProcessBody<'a>>,
    /// Rectangular roughing: limits and prices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rects: Vec<RectBody<'a>>,
}

#[derive(Debug, Serialize)]
struct GivenBody<'a> {
    operation: u16,
    place: &'a str,
    tips: usize,
}

#[derive(Debug, Serialize)]
struct OperationBody<'a> {
    operation: u16,
    place: &'a str,
    objective: &'static str,
    model: &'static str,
    lattice_given: Option<&'a str>,
    best: Vec<RowBody>,
    planned: PlannedBody,
    /// Of the formulas.
    binding: Vec<BindingBody<'a>>,
    wider: Vec<WiderBody<'a>>,
    /// Limits and values that were not made wider: too many cuts.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    not_wider: &'a [String],
    faster: Vec<FasterBody<'a>>,
    trade_off: TradeOffBody,
}

#[derive(Debug, Serialize)]
struct TradeOffBody {
    /// What the limits are on: `scallop`, `cuts` or `edge`.
    against: &'static str,
    /// The job's own limit, in mm or cuts.
    limit: Option<f64>,
    /// The job as it is, at programmed speeds.
    now: Option<PlanBody>,
    points: Vec<PointBody>,
}

/// A limit with the best plan and the optimum of the formulas within it.
#[derive(Debug, Serialize)]
struct PointBody {
    /// In mm or cuts.
    limit: f64,
    /// `planned`, `no_plan` or `not_planned`.
    outcome: &'static str,
    planned: Option<PlanBody>,
    formula: Option<ParametersBody>,
}

/// A limit or a value that is a tenth wider.
#[derive(Debug, Serialize)]
struct WiderBody<'a> {
    bound: &'static str,
    words: &'a str,
    place: Option<&'a str>,
    wider: &'a str,
    planned: PlanBody,
    /// Of the objective, in its unit: s, mm or cuts.
    gain: f64,
    /// Of the objective.
    share: f64,
}

#[derive(Debug, Serialize)]
struct FasterBody<'a> {
    change: &'a str,
    planned: PlanBody,
    share: f64,
}

/// Lengths in mm, angles in deg, times in s.
#[derive(Debug, Serialize)]
struct PlanBody {
    lattice: &'static str,
    swing: f64,
    layer: f64,
    step: f64,
    time: f64,
    cuts: usize,
    leaves: f64,
    edge: f64,
}

#[derive(Debug, Serialize)]
struct RowBody {
    lattice: &'static str,
    model: &'static str,
    chosen: bool,
    parameters: Option<ParametersBody>,
    trouble: Option<String>,
}

/// Lengths in mm, angles in deg, times in s.
#[derive(Debug, Serialize)]
struct ParametersBody {
    lattice: &'static str,
    swing: f64,
    layer: f64,
    step: f64,
    overlap: f64,
    time: f64,
    cuts: f64,
    scallop: f64,
    edge: f64,
    gap: f64,
}

#[derive(Debug, Serialize)]
struct PlannedBody {
    lattice: &'static str,
    swing: f64,
    layer: f64,
    step: f64,
    /// In s.
    time: f64,
    /// In s, by the model.
    model: f64,
    /// As a share of the planned time.
    model_above: Option<f64>,
    cuts: usize,
    layers: usize,
    /// Whether simulation found these parameters; `binding` then is that of the marked line alone.
    simulated: bool,
}

#[derive(Debug, Serialize)]
struct BindingBody<'a> {
    bound: &'static str,
    words: &'a str,
    place: Option<&'a str>,
    relaxed: &'a str,
    /// Of time by the model, in s, whatever the objective.
    saves: f64,
    /// Of the objective, in its unit: s, mm or cuts.
    gain: f64,
    /// Of the objective.
    share: f64,
}

/// The same as data.
#[must_use]
pub fn body(optimisation: &Optimisation) -> OptimisationBody<'_> {
    OptimisationBody {
        job: &optimisation.job,
        scallop: optimisation.scallop.to_mm(),
        operations: optimisation.operations.iter().map(operation_body).collect(),
        given: optimisation.given.iter().map(given_body).collect(),
        others: optimisation.others.iter().map(others::body).collect(),
        processes: optimisation
            .comparisons
            .iter()
            .flat_map(others::process_bodies)
            .collect(),
        rects: optimisation.rects.iter().map(RectOptimum::body).collect(),
    }
}

fn given_body(given: &GivenOperation) -> GivenBody<'_> {
    GivenBody {
        operation: given.number,
        place: &given.place,
        tips: given.tips,
    }
}

fn operation_body(operation: &OperationOptimum) -> OperationBody<'_> {
    let planned = &operation.planned;
    OperationBody {
        operation: operation.number,
        place: &operation.place,
        objective: operation.objective.word(),
        model: operation.formulas.word(),
        lattice_given: operation.lattice_given.as_deref(),
        best: operation.rows.iter().map(row_body).collect(),
        planned: PlannedBody {
            lattice: planned.parameters.lattice.word(),
            swing: planned.parameters.swing.to_deg(),
            layer: planned.parameters.layer.to_mm(),
            step: planned.parameters.step.to_mm(),
            time: planned.time.to_s(),
            model: planned.model.to_s(),
            model_above: planned.model_above(),
            cuts: planned.cuts,
            layers: planned.layers,
            simulated: match planned.found {
                FoundBy::Formulas => false,
                FoundBy::Simulation { .. } => true,
            },
        },
        binding: operation.binding.iter().map(binding_body).collect(),
        wider: operation.wider.found.iter().map(wider_body).collect(),
        not_wider: &operation.wider.not_planned,
        faster: operation.faster.iter().map(faster_body).collect(),
        trade_off: trade_off_body(&operation.trade_off),
    }
}

fn trade_off_body(trade_off: &TradeOff) -> TradeOffBody {
    TradeOffBody {
        against: trade_off.against.word(),
        limit: trade_off.limit,
        now: trade_off.now.plan().map(plan_body),
        points: trade_off.points.iter().map(point_body).collect(),
    }
}

fn point_body(point: &Point) -> PointBody {
    PointBody {
        limit: point.limit,
        outcome: match point.came {
            Came::Planned(_) => "planned",
            Came::Nothing => "no_plan",
            Came::TooLarge => "not_planned",
        },
        planned: point.came.plan().map(plan_body),
        formula: point.formula.as_ref().map(parameters_body),
    }
}

fn wider_body(loosened: &Loosened) -> WiderBody<'_> {
    WiderBody {
        bound: bound_key(loosened.bound),
        words: &loosened.words,
        place: loosened.place.as_deref(),
        wider: &loosened.loosened,
        planned: plan_body(&loosened.plan),
        gain: loosened.gain,
        share: loosened.share,
    }
}

fn faster_body(faster: &Faster) -> FasterBody<'_> {
    FasterBody {
        change: &faster.change,
        planned: plan_body(&faster.plan),
        share: faster.share,
    }
}

fn plan_body(plan: &Plan) -> PlanBody {
    let parameters = &plan.parameters;
    PlanBody {
        lattice: parameters.lattice.word(),
        swing: parameters.swing.to_deg(),
        layer: parameters.layer.to_mm(),
        step: parameters.step.to_mm(),
        time: plan.time.to_s(),
        cuts: plan.cuts,
        leaves: plan.leaves.to_mm(),
        edge: plan.edge.to_mm(),
    }
}

fn row_body(row: &Row) -> RowBody {
    RowBody {
        lattice: row.lattice.word(),
        model: row.formulas.word(),
        chosen: row.role == Role::Chosen,
        parameters: row.best.as_ref().ok().map(parameters_body),
        trouble: row.best.as_ref().err().cloned(),
    }
}

fn parameters_body(best: &Optimum) -> ParametersBody {
    ParametersBody {
        lattice: best.lattice.word(),
        swing: best.swing.to_deg(),
        layer: best.layer.to_mm(),
        step: best.step.to_mm(),
        overlap: best.overlap,
        time: best.time.to_s(),
        cuts: best.cuts,
        scallop: best.scallop.to_mm(),
        edge: best.edge.to_mm(),
        gap: best.gap,
    }
}

fn binding_body(relaxed: &Relaxed) -> BindingBody<'_> {
    BindingBody {
        bound: bound_key(relaxed.bound),
        words: &relaxed.words,
        place: relaxed.place.as_deref(),
        relaxed: &relaxed.relaxed,
        saves: relaxed.saves.to_s(),
        gain: relaxed.gain,
        share: relaxed.share,
    }
}

const fn bound_key(bound: Bound) -> &'static str {
    match bound {
        Bound::SwingLeast => "swing_least",
        Bound::SwingMost => "swing_most",
        Bound::LayerLeast => "layer_least",
        Bound::LayerMost => "layer_most",
        Bound::StepLeast => "step_least",
        Bound::StepMost => "step_most",
        Bound::OverlapLeast => "overlap_least",
        Bound::OverlapMost => "overlap_most",
        Bound::Scallop => "scallop",
        Bound::Edge => "edge",
        Bound::Time => "time",
        Bound::Cuts => "cuts",
    }
}
