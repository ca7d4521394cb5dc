//! The V-cuts of a job: planned, chosen, lowered to motions, and proven

pub mod choice;
pub mod lower;
pub mod plan;
pub mod posture;
#[cfg(test)]
mod replayed;
pub mod verdict;
