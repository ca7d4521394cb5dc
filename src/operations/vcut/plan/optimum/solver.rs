//! The best parameters over all lattices, or any: which search answers which question.

use super::formulas::Model;
use super::ground::{Found, Measure};
use super::line;
use super::problem::{Bound, Optimum, Problem, Refused};
use super::search::{self, Goal};
use crate::asked::{Lattice, Objective};
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_geometry::grid;

/// The least scallop or edge is found to this share of it.
const FINE: f64 = 1e-10;

/// That nothing keeps a limit tighter by this share is proven.
const PROVEN: f64 = 1e-7;

/// The best parameters there are.
///
/// # Errors
/// When no parameters keep all bounds, or when the objective can be made as small as one likes. To find out which bounds
/// conflict takes many times as long ([`solve`](super::solve)).
pub fn best(problem: &Problem) -> Result<Optimum, Refused> {
    if unbounded(problem) {
        return Err(Refused::Unbounded);
    }
    let best = match problem.objective {
        Objective::Time => least(problem, Measure::Time),
        Objective::Cuts => least(problem, Measure::Cuts),
        Objective::Scallop => tightest(problem, Bound::Scallop),
        Objective::BladeLoad => tightest(problem, Bound::Edge),
    };
    best.ok_or(Refused::Conflict)
}

/// Whether thinner layers are ever better and nothing asks for thick ones.
fn unbounded(problem: &Problem) -> bool {
    let asks = |least: Length| least.to_mm() > grid::SPACING;
    match problem.objective {
        Objective::Time | Objective::Cuts => false,
        Objective::Scallop | Objective::BladeLoad => {
            problem.time.is_none()
                && problem.cuts.is_none()
                && !asks(problem.layer.least)
                && !asks(problem.step.least)
        }
    }
}

/// The parameters of least time or fewest cuts, over all lattices.
pub(super) fn least(problem: &Problem, measure: Measure) -> Option<Optimum> {
    let value = |optimum: &Optimum| match measure {
        Measure::Time | Measure::Breach => optimum.time.to_s(),
        Measure::Cuts => optimum.cuts,
    };
    let mut best: Option<Optimum> = None;
    for &lattice in &problem.lattices {
        let found = on_lattice(problem, lattice, measure, Goal::Best);
        best = match (best, found) {
            (Some(best), Some(found)) if value(&found) < value(&best) => Some(found),
            (Some(best), _) => Some(best),
            (None, found) => found,
        };
    }
    best
}

/// Any parameters that keep the bounds; none is proven. Of a problem with one lattice, swing, layer and step these, if
/// they do.
pub(in crate::plan) fn any(problem: &Problem) -> Option<Optimum> {
    try_any(problem).or_else(|| by_goal(problem, Goal::Any))
}

/// Any parameters that keep the bounds, if a few tries meet some.
pub(super) fn try_any(problem: &Problem) -> Option<Optimum> {
    by_goal(problem, Goal::Quick)
}

fn by_goal(problem: &Problem, goal: Goal) -> Option<Optimum> {
    let mut lattices = problem.lattices.iter();
    lattices.find_map(|&lattice| on_lattice(problem, lattice, Measure::Breach, goal))
}

/// The parameters that keep the tightest limit on a scallop or an edge that any keep: what can be kept under one limit can be
/// under every slacker one, so the limit is found by halving. Descents say quickly where it is; that nothing tighter can be
/// kept is then proven once.
fn tightest(problem: &Problem, bound: Bound) -> Option<Optimum> {
    let mut best = any(problem)?;
    for find in [try_any, any] {
        best = halved(problem, bound, best, find);
        let tighter = bound.attained(&best) * (1.0 - PROVEN);
        match any(&bound.replaced(problem, tighter)) {
            Some(better) => best = better,
            None => break,
        }
    }
    best.gap = PROVEN;
    best.binding = touched(problem, &best);
    Some(best)
}

/// Parameters that keep a limit as tight as any are found for, beginning with some.
fn halved(
    problem: &Problem,
    bound: Bound,
    mut best: Optimum,
    find: impl Fn(&Problem) -> Option<Optimum>,
) -> Optimum {
    let mut fails = 0.0;
    loop {
        let works = bound.attained(&best);
        if works - fails <= FINE * works {
            return best;
        }
        let middle = 0.5 * (works + fails);
        match find(&bound.replaced(problem, middle)) {
            Some(better) => best = better,
            None => fails = middle,
        }
    }
}

fn on_lattice(problem: &Problem, lattice: Lattice, measure: Measure, goal: Goal) -> Option<Optimum> {
    let model = Model::new(problem, lattice);
    let decided = match goal {
        Goal::Best => line::best(&model, measure),
        Goal::Any | Goal::Quick => None,
    };
    let found = decided.or_else(|| search::best(&model, measure, goal))?;
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
    Bound::ALL
        .into_iter()
        .filter(|bound| bound.touched(problem, optimum))
        .collect()
}
