//! Which bounds keep a problem from having parameters, and how far each is from allowing some.
//!
//! Bounds are dropped one after the other; one without which the rest still conflicts stays dropped (a deletion
//! filter: Chinneck, Feasibility and Infeasibility in Optimization, 2008). What remains conflicts, and without any one of it
//! nothing does.

use super::ground::Measure;
use super::problem::{Bound, Infeasible, Problem};
use super::{any, least, try_any};

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

/// Why a problem without parameters has none.
pub(super) fn explain(problem: &Problem) -> Infeasible {
    let mut rest = problem.clone();
    let mut bounds = Vec::new();
    for bound in ORDER {
        if bound.value(problem).is_none() {
            continue;
        }
        let without = bound.dropped(&rest);
        if any(&without).is_none() {
            rest = without;
        } else {
            bounds.push(bound);
        }
    }
    bounds.sort_unstable();
    let nearest = bounds.iter().map(|&bound| nearest(problem, bound)).collect();
    Infeasible::Conflict { bounds, nearest }
}

/// The nearest value of a bound that all others allow.
fn nearest(problem: &Problem, bound: Bound) -> Option<f64> {
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
