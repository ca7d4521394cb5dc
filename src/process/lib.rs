//! From a checked job to a proven program: planning, lowering and the messages of a proof, over whatever operations there are.
//!
//! What an operation does at each stage is its own affair (`src/operations`); here is what they have in common.

pub mod beside;
pub mod chains;
pub mod comparison;
pub mod from_above;
pub mod lower;
pub mod pen;
pub mod plan;
pub mod posture;
pub mod slits;
pub mod standoff;
pub mod verdict;
