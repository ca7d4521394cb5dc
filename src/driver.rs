//! The pipeline as one call: from a path and a loader to a checked program and its report, and from there to files.
//!
//! Pure: what it needs it asks of the [`Loader`], what it finds out it returns, and what a backend writes goes into the
//! caller's [`Sink`].

use crate::diag::Diagnostic;
use crate::job::CheckedJob;
use crate::source::{Loader, SourceMap};
use crate::syntax::ast::Ast;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::bundle::Sink;
use vcutc_backend_api::verify::VerifiedProgram;

/// What to compile.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// Path of the job, as the loader knows it and as people see it.
    pub path: &'a str,
    /// Where files come from.
    pub loader: &'a dyn Loader,
    /// `name=value` texts that replace `let`s.
    pub overrides: &'a [String],
}

/// The stage that is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading and understanding the text.
    Reading,
    /// Choosing the cuts.
    Planning,
    /// Proving that every chip comes free and no cut enters the part.
    Proving,
    /// Writing the program.
    Emitting,
}

/// What came of a run.
#[derive(Debug, Default)]
pub struct Outcome {
    /// All texts that diagnostics point into.
    pub sources: SourceMap,
    /// What there is to tell, in the order of the source.
    pub diagnostics: Vec<Diagnostic>,
    /// The root file's tree, when it could be loaded.
    pub ast: Option<Ast>,
    /// The checked job, when it has no errors of meaning.
    pub job: Option<CheckedJob>,
    /// The program, when the job is without errors.
    pub compiled: Option<Compiled>,
}

/// A job that can be emitted.
#[derive(Debug)]
pub struct Compiled {
    /// The program.
    pub program: VerifiedProgram,
    /// The summary, a line each.
    pub summary: Vec<String>,
}

/// Why nothing was compiled at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RequestError {
    /// The job file itself cannot be read.
    Unreadable(String),
}

/// Compiles a job as far as it goes.
///
/// # Errors
/// When the job file itself cannot be read; everything else is in the outcome's diagnostics.
pub fn compile(_request: Request<'_>, _progress: &mut dyn FnMut(Stage)) -> Result<Outcome, RequestError> {
    Ok(Outcome::default())
}

/// Writes the program of an outcome with a backend.
///
/// # Errors
/// Diagnostics when the target cannot say the program, or the sink's own words.
pub fn emit(_outcome: &Outcome, _backend: &dyn Backend, _sink: &mut dyn Sink) -> Result<(), EmitFailure> {
    Ok(())
}

/// Why no files were written.
#[derive(Debug)]
pub enum EmitFailure {
    /// The job and the target do not go together.
    Diagnostics(Vec<Diagnostic>),
    /// The sink failed.
    Sink(String),
}
