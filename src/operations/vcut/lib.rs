//! V-shaped roughing, `rough vcut`: chips of a V from left and right flanks, in layers, down to the part [Cui 2020].
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the choice of what is open, and the plan | [`choice`], [`plan`] |
//! | motions | `lower` |
//! | messages of the proof | `verdict` |
//! | words for summary, report and editor | `summary`, `tables` |

pub mod asked;
#[cfg(test)]
mod avoid_tests;
#[cfg(test)]
mod body_tests;
mod check;
pub mod choice;
mod lower;
mod operation;
pub mod plan;
mod planned;
#[cfg(test)]
mod replayed;
#[cfg(any(test, feature = "samples"))]
pub mod samples;
mod summary;
mod tables;
mod verdict;

pub use asked::RoughVcut;
pub use check::{SPEC, Vcut};
pub use plan::PlannedVcut;
