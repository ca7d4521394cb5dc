//! Flaws: what is wrong with a machine's description, and where in its text.
//!
//! Readers of sheets and of URDF collect flaws instead of stopping at the first, and know nothing of jobs: who asked for
//! the file turns each flaw into a diagnostic that points into it.

use crate::source::{FileId, Span};
use crate::{Code, Diagnostic};
use core::ops::Range;

/// One thing that is wrong with a description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// The bytes of the text that have to change; empty where something is missing.
    pub span: Range<usize>,
    /// What is wrong: one sentence in lower case without full stop, with numbers and units.
    pub message: String,
    /// A remark for the place itself, of a few words.
    pub label: String,
    /// What to do, in the imperative, with a value that works where there is one.
    pub help: Option<String>,
}

impl Flaw {
    /// A flaw at a place.
    #[must_use]
    pub fn new(span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
            label: label.into(),
            help: None,
        }
    }

    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// What people get to see under a code, when the description is that file.
    #[must_use]
    pub fn diagnostic(&self, code: Code, file: FileId) -> Diagnostic {
        let span = Span::of_bytes(file, self.span.clone());
        let diagnostic = Diagnostic::new(code, &*self.message, span, &*self.label);
        match &self.help {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        }
    }
}
