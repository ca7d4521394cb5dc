//! Which swing, layer, step, overlap and lattice make an operation's time (or another objective) least within its
//! limits: the optimisation problem of [Cui 14], by its formulas or by exact ones.
//!
//! * [`problem`](self) says what is asked and answered, [`Bound`] names what is bounded.
//! * `formulas` turns a swing and an overlap into the thickest layer that the bounds allow and what that costs, for
//!   numbers and for boxes of numbers ([`vcutc_geometry::number`]). `docs/process.md`, "The optimum", proves that no other
//!   layer is better.
//! * `solver` answers over all lattices, by the searches below.
//! * `ground` says what a shape comes to by which functions.
//! * `line` proves the least in a few microseconds where one coordinate decides it; else
//! * `descent` goes down to where it is best around a shape, by slopes and curvatures, `certain` proves that, and
//!   `search` that there is nothing better elsewhere, by branch and bound in the coordinates of `chart`. `polish` helps out
//!   where a descent comes to no rest.
//! * `conflict` says why nothing keeps all bounds, `sensitivity` what a bound costs.
//!
//! Between equals the lattice that is named first is taken, and of one lattice what the search meets first, which does
//! not depend on the platform.

mod bounds;
mod certain;
mod chart;
mod conflict;
mod descent;
mod formulas;
mod ground;
mod line;
mod polish;
mod problem;
pub mod published;
mod search;
mod sensitivity;
mod solver;

pub use conflict::{conflicting, nearest, solve};
pub use problem::{Bound, End, Extension, Infeasible, Optimum, Problem, Range, Refused, Sensitivity, Work};
pub use sensitivity::sensitivities;
pub(in crate::plan) use solver::any;
pub use solver::best;

#[cfg(test)]
mod tests;
