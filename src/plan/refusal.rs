//! What keeps an operation from being planned, and changes of the job that may mend it.
//!
//! Nothing is promised of these changes: each is the best guess of a formula. `choice` plans them before any of them is
//! told, and of every ladder the first one that works is offered.

use crate::diag::Diagnostic;
use crate::job::RoughVcut;
use crate::source::Span;

/// Why an operation is not planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// What there is to tell.
    pub told: Diagnostic,
    /// Changes that may mend it, a ladder for each thing that can be changed.
    pub ladders: Vec<Ladder>,
    /// What to do where none of them works.
    pub otherwise: Option<String>,
}

/// Values for one place, the nearest to what the job says first.
pub type Ladder = Vec<Offer>;

/// A change of an operation, in the form in which it is offered.
#[derive(Clone, Debug, PartialEq)]
pub struct Offer {
    /// What it does, in the imperative.
    pub title: String,
    /// What is replaced in the job's text, and by what.
    pub edits: Vec<(Span, String)>,
    /// The operation then.
    pub changed: RoughVcut,
}

impl From<Diagnostic> for Refused {
    fn from(told: Diagnostic) -> Self {
        Self {
            told,
            ladders: Vec::new(),
            otherwise: None,
        }
    }
}
