//! Which swing, layer, step, overlap and lattice make an operation's time (or another objective) least within its
//! limits: the optimisation problem of [Cui 14], by its formulas or by exact ones.

mod problem;

pub use problem::{Bound, Infeasible, Optimum, Problem, Range, Sensitivity, Work};

/// The best parameters there are.
///
/// # Errors
/// When no parameters keep all bounds: which of them conflict.
pub fn solve(problem: &Problem) -> Result<Optimum, Infeasible> {
    problem::by_search(problem)
}
