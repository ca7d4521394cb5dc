//! Slitting the walls of a region, `slit walls`: a straight blade parts the core along them, down to a floor, before a crusher takes
//! what is within.
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the plan: slits, in their order | [`plan`] |
//! | what prevents a plan | `refused` |
//! | every choice made, and what stages ask of it | `decided`, `planned` |
//! | motions | `lower` |
//! | the proof, from the finished program | `proof` |
//! | what a proof finds wrong, in words | `verdict` |
//! | words for summary, report and editor | `words` |

pub mod asked;
mod check;
mod decided;
mod lower;
mod operation;
pub mod plan;
mod planned;
mod proof;
mod refused;
mod verdict;
mod words;

pub use asked::SlitWalls;
pub use check::{SPEC, Slit};
pub use decided::Planned;
