//! Finishing, `finish disc`: a disc takes what roughing has left off the part, in tracks along y [Yang, Hu, Wang].
//!
//! | Stage | Here |
//! | --- | --- |
//! | what is asked, and its check | [`asked`], `check` |
//! | the plan: tracks, lead, side tilt, order | [`plan`] |
//! | why there is no plan | `refused` |
//! | every choice made, and what stages ask of it | `decided`, `planned` |
//! | motions | `lower` |
//! | the same on parts that change along y | [`on_surface`] |
//! | words for summary, report and editor | `words` |

pub mod asked;
mod check;
mod decided;
mod lower;
pub mod on_surface;
mod operation;
pub mod plan;
mod planned;
mod refused;
mod words;

pub use asked::FinishDisc;
pub use check::{Finish, SPEC};
pub use decided::Planned;
