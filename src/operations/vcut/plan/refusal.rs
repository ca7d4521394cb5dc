//! What keeps an operation from being planned, and changes of the job that may fix it.
//!
//! Nothing is promised of these changes: each is the best guess of a formula. `choice` plans them before any
//! of them is reported, and of every ladder the first one that works is offered.

use crate::asked::RoughVcut;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_job::{Auto, Sourced};

/// Why an operation is not planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// What is reported.
    pub diagnostic: Diagnostic,
    /// Changes that may fix it, a ladder for each thing that can be changed.
    pub ladders: Vec<Ladder>,
    /// Changes that are tried where none of them works.
    pub resort: Ladder,
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
    fn from(diagnostic: Diagnostic) -> Self {
        Self {
            diagnostic,
            ladders: Vec::new(),
            resort: Vec::new(),
            otherwise: None,
        }
    }
}

impl Offer {
    /// What an operation gives of its cuts left to the compiler: one value after the other, and then all of them at once.
    #[must_use]
    pub fn openings(asked: &RoughVcut) -> Ladder {
        let given: Vec<Opening> = OPENINGS
            .into_iter()
            .filter(|opening| (opening.open)(&mut asked.clone()).is_some())
            .collect();
        let single = given.iter().map(std::slice::from_ref);
        let all = (given.len() > 1).then_some(given.as_slice());
        single
            .chain(all)
            .map(|openings| Self::opened(asked, openings))
            .collect()
    }

    /// The operation with some of its values left to the compiler.
    fn opened(asked: &RoughVcut, openings: &[Opening]) -> Self {
        let mut changed = asked.clone();
        let spans = openings.iter().filter_map(|opening| (opening.open)(&mut changed));
        let edits = spans.map(|span| (span, "auto".to_owned())).collect();
        let names: Vec<String> = openings
            .iter()
            .map(|opening| format!("`{} = auto`", opening.name))
            .collect();
        let title = match names.as_slice() {
            [one, other] => format!("let the compiler choose both: {one} and {other}"),
            [first @ .., last] if !first.is_empty() => {
                format!(
                    "let the compiler choose all of these: {} and {last}",
                    first.join(", ")
                )
            }
            few => format!("let the compiler choose: {}", few.join(", ")),
        };
        Self {
            title,
            edits,
            changed,
        }
    }
}

/// A value of an operation that can be left to the compiler.
#[derive(Clone, Copy)]
struct Opening {
    name: &'static str,
    /// Leaves a given value open, and says where it stands; none where it is not given.
    open: fn(&mut RoughVcut) -> Option<Span>,
}

/// Those that people give for the least reason first.
const OPENINGS: [Opening; 6] = [
    Opening {
        name: "step",
        open: |asked| left_open(&mut asked.step),
    },
    Opening {
        name: "layer",
        open: |asked| left_open(&mut asked.layer),
    },
    Opening {
        name: "overlap",
        open: |asked| left_open(&mut asked.overlap),
    },
    Opening {
        name: "residual",
        open: |asked| left_open(&mut asked.residual),
    },
    Opening {
        name: "lattice",
        open: |asked| left_open(&mut asked.lattice),
    },
    Opening {
        name: "swing",
        open: |asked| left_open(&mut asked.swing),
    },
];

fn left_open<T>(value: &mut Sourced<Auto<T>>) -> Option<Span> {
    let (Auto::Given(_), Some(span)) = (&value.value, value.span) else {
        return None;
    };
    value.value = Auto::Auto;
    Some(span)
}
