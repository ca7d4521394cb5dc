//! Pockets cleared by slit and free, `free pocket`: a straight blade slits the core of a region into strips, layer by layer, and a disc
//! undercuts them one after the other, so that they come out whole.
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the plan: layers, strips, slits, passes of the disc | [`plan`] |
//! | what prevents a plan | `refused` |
//! | every choice made, and what stages ask of it | `decided`, `planned` |
//! | motions | `lower` |
//! | the proof, and what pictures show, from the finished program | `proof`, `from_above` |
//! | what a proof finds wrong, in words | `verdict` |
//! | words for summary, report and editor | `words` |

pub mod asked;
mod check;
mod decided;
mod from_above;
mod lower;
mod operation;
pub mod plan;
mod planned;
mod proof;
mod refused;
mod remedy;
mod verdict;
mod words;

pub use asked::FreePocket;
pub use check::{Free, SPEC};
pub use decided::Planned;
