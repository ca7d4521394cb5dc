//! Clearing pockets, `clear pocket`: a crusher takes all core within a region of the plan, layer by layer, down to a floor
//! (after Yang, Cai, Yang, You, Machines 2023, 11(2):131).
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the plan: layers, pattern, entries, order | [`plan`] |
//! | why there is no plan | `refused` |
//! | every choice made, and what stages ask of it | `decided`, `planned` |
//! | motions | `lower` |
//! | the proof, and what pictures show, from the finished program | `proof`, `from_above` |
//! | what the proof finds wrong, in words | `verdict` |
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
mod verdict;
mod words;

pub use asked::ClearPocket;
pub use check::{Pocket, SPEC};
pub use decided::Planned;
