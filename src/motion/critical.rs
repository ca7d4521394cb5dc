//! What shows soon whether a machine follows a program in a place: the poses and motions that lie farthest out.
//!
//! The reach of an arm ends at surfaces, so taught poses at the outside of the work decide almost everything ([`poses`]). They
//! are far fewer than the poses that the blade goes through, and cost one inverse kinematics each. For every branch the
//! smallest of all margins counts, and of the branches the best ([`margin`]). Whether the axes are fast enough is seen by a
//! few motions ([`motions`]). What is found so is promising and nothing more: whoever offers it has the whole program proven
//! first.

pub mod clearance;
pub mod margin;
pub mod motions;
pub mod poses;

use rayon::prelude::*;

/// Asks the same of all items, in parallel; the answers are in their order.
pub fn ask_all<T: Sync>(items: &[T], ask: impl Fn(&T) -> bool + Sync + Send) -> Vec<bool> {
    items.par_iter().map(ask).collect()
}
