//! Changes of a job that help its machine, each of them tried before it is offered.
//!
//! There is one loop: of a list of candidates, each a [`Change`], those that look promising by a cheap test go through the whole
//! pipeline, and what works is kept, until the [`Budget`] is spent. The lists are
//!
//! - `remedies`: for a plan that the machine does not carry out;
//! - [`hints`]: for a job that its machine made slow;
//! - [`fallback`]: what the job itself leaves open, routes and swings, before it is refused at all.
//!
//! The cheap test looks at the critical motions of a program ([`trial::looks_promising`]): a program that fails as a whole is
//! expensive to refute, since every branch is proven from end to end, and they usually show the same.

mod base;
mod budget;
mod case;
mod change;
mod extension;
pub mod fallback;
pub mod hints;
mod home;
mod nearer;
mod process;
mod remedies;
mod speed;
pub mod trial;
pub mod wording;

pub use budget::{Budget, Size};
pub use change::{Change, Edits};
pub use extension::farther_out;
pub use nearer::base_nearer;
pub use remedies::diagnose;
