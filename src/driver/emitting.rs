//! From a compiled job to the files of its program, each read back before anybody gets it.

use super::{Outcome, target};
use vcutc_backend_api::backend::{Backend, BackendIssue, EmitError, Origin};
use vcutc_backend_api::bundle::{Bundle, Sink};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::CheckedJob;
use vcutc_readback::{RoundTripError, Written};

/// Writes the program of an outcome with a backend. An outcome without a program writes nothing.
///
/// # Errors
/// Diagnostics when the job has no machine, or the target cannot say the program, or the sink's own words.
pub fn emit(outcome: &Outcome, backend: &dyn Backend, sink: &mut dyn Sink) -> Result<(), EmitFailure> {
    let Some(written) = write(outcome, backend)? else {
        return Ok(());
    };
    for (name, bytes) in written.bundle.files() {
        let taken = sink.file(name).and_then(|()| sink.write(bytes));
        taken.map_err(|error| EmitFailure::Sink(error.0))?;
    }
    Ok(())
}

/// The program of an outcome as a backend writes it, read back and found to be the same, with the place of every op in the
/// text. An outcome without a program has none.
///
/// # Errors
/// As for [`emit`].
pub fn write(outcome: &Outcome, backend: &dyn Backend) -> Result<Option<Written>, EmitFailure> {
    let (Some(job), Some(compiled)) = (&outcome.job, &outcome.compiled) else {
        return Ok(None);
    };
    if let Err(fault) = backend.ready() {
        let failed = target::failed(backend.id(), &fault, job.name_span);
        return Err(EmitFailure::Diagnostics(vec![failed]));
    }
    let options = target::options(job, backend).map_err(EmitFailure::Diagnostics)?;
    let Some(reached) = compiled.program.reached() else {
        return Err(EmitFailure::Diagnostics(vec![target::without_machine(
            job, backend,
        )]));
    };
    let refused = |issues: &[BackendIssue]| {
        let program = reached.program.program();
        EmitFailure::Diagnostics(target::diagnose(job, backend, program, issues, &outcome.drivers))
    };
    let missing = target::missing(backend, reached.program.verified());
    if !missing.is_empty() {
        return Err(refused(&missing));
    }
    let emission = backend
        .check(&reached.program, &options)
        .map_err(|issues| refused(&issues))?;
    let mut bundle = Bundle::default();
    emission.write(&mut bundle).map_err(|error| match error {
        EmitError::Sink(error) => EmitFailure::Sink(error.0),
        EmitError::Internal(what) => EmitFailure::Diagnostics(vec![not_written(job, what, &[])]),
    })?;
    drop(emission);
    Written::read_back(&reached.program, backend, options, bundle)
        .map(Some)
        .map_err(|RoundTripError(notes)| {
            let what = "the written program does not match the program that it was made from";
            EmitFailure::Diagnostics(vec![match backend.ready() {
                Ok(()) => match backend.origin() {
                    Origin::Linked => not_written(job, what, &notes),
                    Origin::Outside => target::departed(backend.id(), &notes, job.name_span),
                },
                // It could not be read at all.
                Err(fault) => target::failed(backend.id(), &fault, job.name_span),
            }])
        })
}

/// A program that was not written although nothing is wrong with the job.
fn not_written(job: &CheckedJob, what: &str, notes: &[String]) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::Internal,
        what,
        job.name_span,
        "while writing this job's program",
    );
    let diagnostic = notes.iter().fold(diagnostic, Diagnostic::note);
    diagnostic.help("nothing was written; please report the job together with this message")
}

/// Why no files were written.
#[derive(Debug)]
pub enum EmitFailure {
    /// The job and the target do not go together.
    Diagnostics(Vec<Diagnostic>),
    /// The sink failed.
    Sink(String),
}
