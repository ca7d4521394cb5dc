//! The language server as an editor meets it.

mod answers;
mod editor;
mod edits;
mod library;
mod planning;
#[cfg(feature = "cli")]
mod stdio;
