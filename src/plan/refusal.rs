//! What keeps an operation from being planned, and changes of the job that may mend it.
//!
//! Nothing is promised of these changes: each is the best guess of a formula. `choice` plans them before any of them is
//! told, and of every ladder the first one that works is offered.

use crate::diag::Diagnostic;
use crate::job::{Auto, RoughVcut, Sourced};
use crate::source::Span;

/// Why an operation is not planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// What there is to tell.
    pub told: Diagnostic,
    /// Changes that may mend it, a ladder for each thing that can be changed.
    pub ladders: Vec<Ladder>,
    /// A change that is tried where none of them works.
    pub resort: Option<Offer>,
    /// What to do where that does not work either.
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
            resort: None,
            otherwise: None,
        }
    }
}

impl Offer {
    /// All that an operation gives of its cuts left to the compiler; none where it gives nothing.
    #[must_use]
    pub fn all_open(asked: &RoughVcut) -> Option<Self> {
        fn open<T>(name: &'static str, value: &mut Sourced<Auto<T>>, opened: &mut Vec<(&'static str, Span)>) {
            if let (Auto::Given(_), Some(span)) = (&value.value, value.span) {
                value.value = Auto::Auto;
                opened.push((name, span));
            }
        }
        let mut changed = asked.clone();
        let mut opened = Vec::new();
        open("lattice", &mut changed.lattice, &mut opened);
        open("swing", &mut changed.swing, &mut opened);
        open("layer", &mut changed.layer, &mut opened);
        open("step", &mut changed.step, &mut opened);
        open("overlap", &mut changed.overlap, &mut opened);
        open("residual", &mut changed.residual, &mut opened);
        let names: Vec<String> = opened
            .iter()
            .map(|(name, _)| format!("`{name} = auto`"))
            .collect();
        (!opened.is_empty()).then(|| Self {
            title: format!("let the compiler choose: {}", names.join(", ")),
            edits: opened
                .into_iter()
                .map(|(_, span)| (span, "auto".to_owned()))
                .collect(),
            changed,
        })
    }
}
