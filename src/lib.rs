//! vcutc.

pub mod diag;
pub mod driver;
pub mod geom;
pub mod job;
pub mod plan;
pub mod sim;
pub mod source;
pub mod syntax;
