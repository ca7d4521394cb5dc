//! Which bounds keep a problem from having parameters, and how far each is from allowing some.
//!
//! Bounds are dropped one after the other; one without which the rest still conflicts stays dropped (a deletion
//! filter: Chinneck, Feasibility and Infeasibility in Optimization, 2008). What remains conflicts, and without any one of it
//! nothing does.

use super::ground::Measure;
use super::problem::{Bound, Infeasible, Optimum, Problem, Refused};
use super::solver::{any, best, least, try_any};

/// The order in which bounds are dropped: first those that people rarely set, so that what remains is what they know.
const ORDER: [Bound; 12] = [
    Bound::OverlapMost,
    Bound::LayerMost,
    Bound::StepMost,
    Bound::SwingLeast,
    Bound::OverlapLeast,
    Bound::StepLeast,
    Bound::Cuts,
    Bound::SwingMost,
    Bound::Time,
    Bound::LayerLeast,
    Bound::Scallop,
    Bound::Edge,
];

/// The nearest value is found to this share of it.
const FINE: f64 = 1e-7;

/// Most halvings on the way to it.
const MOST_HALVINGS: u32 = 120;

/// The best parameters there are.
///
/// # Errors
/// When no parameters keep all bounds: which of them conflict. When the objective can be made as small as one likes.
pub fn solve(problem: &Problem) -> Result<Optimum, Infeasible> {
    best(problem).map_err(|refused| match refused {
        Refused::Unbounded => Infeasible::Unbounded,
        Refused::Conflict => {
            let bounds = conflicting(problem);
            let nearest = nearest(problem, &bounds);
            Infeasible::Conflict { bounds, nearest }
        }
    })
}

/// The bounds that conflict in a problem without parameters.
#[must_use]
pub fn conflicting(problem: &Problem) -> Vec<Bound> {
    let said: Vec<Bound> = ORDER
        .into_iter()
        .filter(|bound| bound.value(problem).is_some())
        .collect();
    let mut bounds = Vec::new();
    needed(problem.clone(), &said, &mut bounds);
    bounds.sort_unstable();
    bounds
}

/// The nearest value of each of some conflicting bounds that all others allow.
#[must_use]
pub fn nearest(problem: &Problem, bounds: &[Bound]) -> Vec<Option<f64>> {
    bounds.iter().map(|&bound| nearest_of(problem, bound)).collect()
}

/// Drops those of some bounds without which the rest still conflicts, in their order, and names the others. Neighbours are
/// dropped together where they can be: what conflicts without all of them does without each.
fn needed(problem: Problem, bounds: &[Bound], named: &mut Vec<Bound>) -> Problem {
    if bounds.is_empty() {
        return problem;
    }
    let without = bounds
        .iter()
        .fold(problem.clone(), |rest, bound| bound.dropped(&rest));
    if any(&without).is_none() {
        return without;
    }
    if let [bound] = bounds {
        named.push(*bound);
        return problem;
    }
    let (first, second) = bounds.split_at(bounds.len() / 2);
    let rest = needed(problem, first, named);
    needed(rest, second, named)
}

/// The nearest value of a bound that all others allow.
fn nearest_of(problem: &Problem, bound: Bound) -> Option<f64> {
    match bound {
        Bound::Time => within_least(problem, bound, Measure::Time),
        Bound::Cuts => within_least(problem, bound, Measure::Cuts),
        Bound::SwingLeast
        | Bound::SwingMost
        | Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::OverlapLeast
        | Bound::OverlapMost
        | Bound::Scallop
        | Bound::Edge => by_halving(problem, bound),
    }
}

/// The nearest limit of what can be made least itself.
fn within_least(problem: &Problem, bound: Bound, measure: Measure) -> Option<f64> {
    let asked = bound.value(problem)?;
    let value = bound.attained(&least(&bound.dropped(problem), measure)?);
    eased(problem, bound, value, value - asked)
}

fn by_halving(problem: &Problem, bound: Bound) -> Option<f64> {
    let asked = bound.value(problem)?;
    let mut works = bound.attained(&any(&bound.dropped(problem))?);
    let mut fails = asked;
    // Descents say quickly where it is, a search then whether it is nearer still.
    for find in [try_any, any] {
        for _ in 0..MOST_HALVINGS {
            if (works - fails).abs() <= FINE * works.abs().max(fails.abs()) {
                break;
            }
            // Evenly in shares while they are far apart.
            let middle = if fails > 0.0 && works / fails > 4.0 {
                (works * fails).sqrt()
            } else {
                0.5 * (works + fails)
            };
            if middle == works || middle == fails {
                break;
            }
            match find(&bound.replaced(problem, middle)).map(|optimum| bound.attained(&optimum)) {
                // What it comes to may be nearer still.
                Some(attained) if (attained - asked).abs() < (middle - asked).abs() => works = attained,
                Some(_) => works = middle,
                None => fails = middle,
            }
            // Descents may have missed some.
            if (works - asked).abs() < (fails - asked).abs() {
                fails = asked;
            }
        }
        let nearer = works - 2.0 * FINE * works.abs().max(fails.abs()).copysign(works - asked);
        if any(&bound.replaced(problem, nearer)).is_none() {
            break;
        }
        fails = asked;
    }
    eased(problem, bound, works, works - asked)
}

/// A value that was just found to do, or one as little farther on as parameters are found under it for certain: at the very
/// edge rounding decides.
fn eased(problem: &Problem, bound: Bound, value: f64, onward: f64) -> Option<f64> {
    let mut ease = 0.0;
    while ease < 1e-3 {
        let value = value + ease * value.abs().max(FINE).copysign(onward);
        if least(&bound.replaced(problem, value), Measure::Time).is_some() {
            return Some(value);
        }
        ease = (8.0 * ease).max(0.1 * FINE);
    }
    None
}
