#![doc = include_str!("../ARCHITECTURE.md")]

#[cfg(feature = "cli")]
pub mod cli;
pub mod diag;
pub mod driver;
pub mod geom;
pub mod job;
pub mod lower;
pub mod plan;
pub mod posture;
pub mod registry;
pub mod sema;
pub mod sim;
pub mod source;
pub mod summary;
pub mod syntax;
pub mod verdict;
