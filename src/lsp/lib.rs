//! A language server for job files: what an editor asks, answered from the same stages that compile a job.
//!
//! Nothing here reads a file, prints, or knows the time. A [`Server`] takes a message and gives messages; files are asked of
//! a [`Workspace`], planning is handed out as a [`Task`] and taken back when it is [`Done`]. `vcutc lsp` moves the messages
//! between standard input, this server, and a thread that plans.
//!
//! How an editor's text becomes diagnostics:
//!
//! 1. `documents` keeps the open texts, `text` counts in UTF-16 as the protocol does;
//! 2. `analysis` reads a root file with everything it uses, open texts standing for files: trees, names, values, and what is
//!    wrong with them. That takes as long as reading the text, so it is done whenever no more messages wait;
//! 3. for a job that is right so far, a task plans it and proves the plan. The result is shown with the text
//!    it was made from, or not at all.
//!
//! Questions about a place are answered by a file each, from [`sites`], the row of all places of a tree.

mod analysis;
mod chosen;
mod completion;
mod context;
mod diagnostics;
mod documents;
mod folding;
mod formatting;
mod hints;
mod hover;
mod manual;
mod names;
mod offer;
mod paths;
mod server;
mod sites;
mod slots;
mod spelling;
mod surroundings;
mod symbols;
mod text;
mod tokens;
mod uri;
mod values;
pub mod wire;

#[cfg(test)]
mod tests;

pub use analysis::{Done, Task};
pub use server::{Ending, Server};

use vcutc_diagnostics::source::Loader;

/// The files around the open documents.
pub trait Workspace: Loader {
    /// Paths of the job files in some folders and below: what a name is looked for in that is defined in one of them. No more
    /// than anybody would wait for.
    fn job_files(&self, folders: &[String]) -> Vec<String>;
}
