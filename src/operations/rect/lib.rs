//! Rectangular roughing, `rough rect`: a straight blade cuts upright slits, then a disc frees the strips between them [Yu 2019].
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the plan: layers, strips, slits, their order | [`plan`] |
//! | counts and times by formulas | [`plan::model`] |
//! | what limits and blades cost | [`prices`] |
//! | why there is no plan | `refused` |
//! | every choice made | `decided`, `planned` |
//! | motions | `lower` |
//! | messages of the proof | `verdict` |
//! | words for summary, report and editor | `words` |

pub mod asked;
mod check;
mod decided;
mod lower;
mod operation;
pub mod plan;
mod planned;
pub mod prices;
mod refused;
mod verdict;
mod words;

pub use asked::RoughRect;
pub use check::{Rect, SPEC};
pub use decided::Planned;
