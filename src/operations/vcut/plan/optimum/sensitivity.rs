//! What bounds cost: what relaxing one buys.

use super::conflict::solve;
use super::problem::{Bound, Optimum, Problem, Sensitivity};

/// What relaxing each bound that an optimum touches by a hundredth would buy on the optimum's own lattice, in the order of
/// [`Bound`]. Another lattice may have been better before; what that would buy has nothing to do with the bound.
#[must_use]
pub fn sensitivities(problem: &Problem, optimum: &Optimum) -> Vec<Sensitivity> {
    let alone = Problem {
        lattices: vec![optimum.lattice],
        ..problem.clone()
    };
    let relaxed = |&bound: &Bound| {
        let now = bound.value(problem)?;
        let relaxed = bound.relaxed(now);
        let then = solve(&bound.replaced(&alone, relaxed)).ok()?;
        Some(Sensitivity {
            bound,
            now,
            relaxed,
            then,
        })
    };
    optimum.binding.iter().filter_map(relaxed).collect()
}
