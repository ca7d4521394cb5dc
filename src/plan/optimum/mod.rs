//! Which swing, layer, step, overlap and lattice make an operation's time (or another objective) least within its
//! limits: the optimisation problem of [Cui 14], by its formulas or by exact ones.

mod chart;
mod formulas;
mod number;
mod polish;
mod problem;
mod search;

pub use problem::{Bound, Extension, Infeasible, Optimum, Problem, Range, Sensitivity, Work};

use crate::job::{Lattice, Objective};
use formulas::Model;
use search::{Found, Goal, Measure};
use vcutc_backend_api::units::{Angle, Duration, Length};

/// How near to a bound parameters touch it, as a share of it.
const TOUCHES: f64 = 1e-7;

/// The best parameters there are.
///
/// # Errors
/// When no parameters keep all bounds: which of them conflict.
pub fn solve(problem: &Problem) -> Result<Optimum, Infeasible> {
    let mut best: Option<Optimum> = None;
    for &lattice in &problem.lattices {
        let found = solve_on(problem, lattice);
        if let Some(found) = found
            && best.as_ref().is_none_or(|best| found.time < best.time)
        {
            best = Some(found);
        }
    }
    best.ok_or(Infeasible::Conflict {
        bounds: Vec::new(),
        nearest: Vec::new(),
    })
}

fn solve_on(problem: &Problem, lattice: Lattice) -> Option<Optimum> {
    let model = Model::new(problem, lattice);
    let measure = match problem.objective {
        Objective::Time | Objective::Scallop | Objective::BladeLoad => Measure::Time,
        Objective::Cuts => Measure::Cuts,
    };
    let found = search::best(&model, measure, Goal::Best)?;
    Some(optimum(problem, &model, lattice, &found))
}

fn optimum(problem: &Problem, model: &Model, lattice: Lattice, found: &Found) -> Optimum {
    let (shape, outcome) = (found.shape, found.outcome);
    let layer = outcome.layer;
    let mut optimum = Optimum {
        lattice,
        swing: Angle::rad(libm::atan(shape.tangent)),
        layer: Length::mm(layer),
        step: Length::mm(2.0 * shape.aspect * layer),
        overlap: 1.0 - shape.share,
        time: Duration::s(outcome.time),
        scallop: Length::mm(model.stays(shape.tangent) + model.scallop_factor(shape) * layer),
        edge: Length::mm(model.edge(shape, layer)),
        cuts: outcome.cuts,
        binding: Vec::new(),
        gap: found.gap,
    };
    optimum.binding = touched(problem, &optimum);
    optimum
}

/// The bounds that parameters touch.
fn touched(problem: &Problem, optimum: &Optimum) -> Vec<Bound> {
    let edge = problem.edge.map_or(problem.work.cutting_length, |edge| {
        edge.min(problem.work.cutting_length)
    });
    let bounds = [
        (
            Bound::SwingLeast,
            optimum.swing.to_rad(),
            Some(problem.swing.least.to_rad()),
        ),
        (
            Bound::SwingMost,
            optimum.swing.to_rad(),
            Some(problem.swing.most.to_rad()),
        ),
        (
            Bound::LayerLeast,
            optimum.layer.to_mm(),
            Some(problem.layer.least.to_mm()),
        ),
        (
            Bound::LayerMost,
            optimum.layer.to_mm(),
            Some(problem.layer.most.to_mm()),
        ),
        (
            Bound::StepLeast,
            optimum.step.to_mm(),
            Some(problem.step.least.to_mm()),
        ),
        (
            Bound::StepMost,
            optimum.step.to_mm(),
            Some(problem.step.most.to_mm()),
        ),
        // Of the overlap the share counts: an overlap of 0 has no share of its own.
        (
            Bound::OverlapLeast,
            1.0 - optimum.overlap,
            Some(1.0 - problem.overlap.least),
        ),
        (
            Bound::OverlapMost,
            1.0 - optimum.overlap,
            Some(1.0 - problem.overlap.most),
        ),
        (
            Bound::Scallop,
            optimum.scallop.to_mm(),
            problem.scallop.map(Length::to_mm),
        ),
        (Bound::Edge, optimum.edge.to_mm(), Some(edge.to_mm())),
        (Bound::Time, optimum.time.to_s(), problem.time.map(Duration::to_s)),
        (Bound::Cuts, optimum.cuts, problem.cuts),
    ];
    bounds
        .into_iter()
        .filter(|(_, value, bound)| bound.is_some_and(|bound| (value - bound).abs() <= TOUCHES * bound.abs()))
        .map(|(bound, _, _)| bound)
        .collect()
}

#[cfg(test)]
mod tests;
