//! vcutc.

pub mod diag;
pub mod driver;
pub mod geom;
pub mod job;
pub mod source;
pub mod syntax;
