//! The whole compiler on files of a folder or on texts in memory.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use vcutc::diagnostics::render::{ColorChoice, render};
use vcutc::diagnostics::source::{LoadError, Loader};
use vcutc::diagnostics::{Diagnostic, Fix, fix};
use vcutc::driver::{self, EmitFailure, Outcome, Request, SearchEffort, Typed};
use vcutc::registry;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::bundle::Bundle;

/// Files as the compiler sees them: those held in memory, then those of a folder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Files {
    folder: Option<PathBuf>,
    texts: BTreeMap<String, Vec<u8>>,
}

impl Files {
    /// The files below a folder.
    pub(crate) fn of(folder: impl AsRef<Path>) -> Self {
        Self {
            folder: Some(folder.as_ref().to_owned()),
            texts: BTreeMap::new(),
        }
    }

    /// With another file, or another text for one that is there.
    pub(crate) fn with(mut self, path: &str, text: impl Into<Vec<u8>>) -> Self {
        self.texts.insert(path.to_owned(), text.into());
        self
    }
}

impl Loader for Files {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        if let Some(text) = self.texts.get(path) {
            return Ok(text.clone());
        }
        let folder = self.folder.as_ref().ok_or(LoadError::NotFound)?;
        fs::read(folder.join(path)).map_err(|_| LoadError::NotFound)
    }
}

/// Compiles a job.
pub(crate) fn compile(path: &str, files: &Files) -> Outcome {
    compile_on(None, path, files)
}

/// Compiles a job on one of its machines.
pub(crate) fn compile_on(machine: Option<&str>, path: &str, files: &Files) -> Outcome {
    let request = Request {
        path,
        loader: files,
        overrides: &[],
        machine,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: vcutc::registry::OPERATIONS,
        targets: &vcutc::registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

/// The target that all jobs of these tests are written for.
pub(crate) fn krl() -> &'static dyn Backend {
    registry::backend("krl").unwrap()
}

/// The program of a compiled job, or what stands in its way.
pub(crate) fn emit(outcome: &Outcome) -> Result<Bundle, Vec<Diagnostic>> {
    emit_for(krl(), outcome)
}

/// The program of a compiled job for a target, or what stands in its way.
pub(crate) fn emit_for(target: &dyn Backend, outcome: &Outcome) -> Result<Bundle, Vec<Diagnostic>> {
    let mut bundle = Bundle::default();
    match driver::emit(outcome, target, &mut bundle) {
        Ok(()) => Ok(bundle),
        Err(EmitFailure::Diagnostics(diagnostics)) => Err(diagnostics),
        Err(EmitFailure::Sink(reason)) => panic!("{reason}"),
    }
}

/// All that the compiler reports of a job, the target's objections included.
pub(crate) fn all_diagnostics(outcome: &Outcome) -> Vec<Diagnostic> {
    let objections = emit(outcome).err().unwrap_or_default();
    [outcome.diagnostics.clone(), objections].concat()
}

/// Diagnostics as people see them.
pub(crate) fn rendered(diagnostics: &[Diagnostic], outcome: &Outcome) -> String {
    render(diagnostics, &outcome.sources, ColorChoice::Plain)
}

/// The numbers of their codes.
pub(crate) fn numbers(diagnostics: &[Diagnostic]) -> Vec<&'static str> {
    diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code.number())
        .collect()
}

/// The files after a fix has been made.
pub(crate) fn fixed(files: &Files, outcome: &Outcome, fix: &Fix) -> Files {
    let file = fix.edits[0].span.file;
    let source = outcome.sources.get(file).unwrap();
    let text = fix::apply(&source.text, file, &fix.edits).expect("the fix fits the text");
    files.clone().with(&source.name, text)
}
