//! Changes that make an unreachable job reachable, each of them tried.

pub mod trial;
pub mod wording;
