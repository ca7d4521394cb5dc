//! The language server as an editor meets it.

mod answers;
pub(crate) mod editor;
mod edits;
#[cfg(feature = "cli")]
mod files;
mod library;
#[cfg(feature = "cli")]
mod places;
mod planning;
#[cfg(feature = "cli")]
mod process;
#[cfg(feature = "cli")]
mod stdio;
#[cfg(feature = "cli")]
mod understanding;
