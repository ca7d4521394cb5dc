//! Diagnostics: what the compiler reports about a job.
//!
//! Every stage pushes [`Diagnostic`]s, which are plain data; two renderers turn them into text ([`render`]) and JSON
//! lines ([`json`]). A diagnostic names a permanent [`Code`], points at the place to change, points at the other party
//! where the cause lies elsewhere, and says what to do.

mod codes;
pub mod document;
pub mod fix;
pub mod github;
pub mod json;
pub mod number;
pub mod overlay;
pub mod position;
pub mod render;
pub mod schema;
pub mod source;
pub mod suggest;

pub use codes::Code;

use crate::source::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The job compiles; it may not be what was meant.
    Warning,
    /// The job does not compile.
    Error,
}

/// A remark at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    pub span: Span,
    /// The remark.
    pub text: String,
}

/// A change of the source that corrects the fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What it does, in the imperative: `use degrees`.
    pub title: String,
    /// The edits, which do not overlap.
    pub edits: Vec<Edit>,
}

/// One replacement in a source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; an empty span is an insertion.
    pub span: Span,
    pub replacement: String,
}

/// One report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its permanent code.
    pub code: Code,
    /// The headline: one sentence without full stop.
    pub message: String,
    /// The place to change.
    pub primary: Label,
    /// Other parties: a first definition, the blade's length.
    pub secondary: Vec<Label>,
    /// Background.
    pub notes: Vec<String>,
    /// What to do, in the imperative, with values.
    pub help: Vec<String>,
    /// Changes a machine can make.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// A diagnostic that points at one place.
    #[must_use]
    pub fn new(code: Code, message: impl Into<String>, span: Span, label: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
            primary: Label {
                span,
                text: label.into(),
            },
            secondary: Vec::new(),
            notes: Vec::new(),
            help: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// Points at another party too.
    #[must_use]
    pub fn and(mut self, span: Span, label: impl Into<String>) -> Self {
        self.secondary.push(Label {
            span,
            text: label.into(),
        });
        self
    }

    /// Adds background.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Adds how many more there are, of so many in all: `the same holds for 2 more tracks`.
    #[must_use]
    pub fn and_more(self, count: usize, says: &str, [one, many]: [&str; 2]) -> Self {
        match count {
            0 | 1 => self,
            2 => self.note(format!("{says} one more {one}")),
            _ => self.note(format!("{says} {} more {many}", count - 1)),
        }
    }

    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Offers a change of one place; its title is shown as a help line too.
    #[must_use]
    pub fn fix(mut self, title: impl Into<String>, span: Span, replacement: impl Into<String>) -> Self {
        let edits = vec![Edit {
            span,
            replacement: replacement.into(),
        }];
        self.fixes.push(Fix {
            title: title.into(),
            edits,
        });
        self
    }

    /// Offers a change of several places; its title is shown as a help line too.
    #[must_use]
    pub fn fix_all(mut self, title: impl Into<String>, edits: &[(Span, String)]) -> Self {
        let edits = edits
            .iter()
            .map(|(span, replacement)| Edit {
                span: *span,
                replacement: replacement.clone(),
            })
            .collect();
        self.fixes.push(Fix {
            title: title.into(),
            edits,
        });
        self
    }

    /// How bad it is; a property of its code.
    #[must_use]
    pub const fn severity(&self) -> Severity {
        self.code.severity()
    }
}

/// Whether the job fails.
#[must_use]
pub fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity() == Severity::Error)
}
