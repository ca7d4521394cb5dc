//! From text to tree.
//!
//! [`parse`] never fails and never panics: what it cannot read it reports and leaves out, and goes on behind it.

pub mod ast;
