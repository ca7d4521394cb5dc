//! The forces that blades need, as somebody measured them: of an edge, of the rim of a disc, and of the teeth of a crusher.

mod edge;
mod rim;
mod teeth;

pub use edge::{EdgeForces, EdgeParts, MeasuredEdge};
pub use rim::{MeasuredRim, RimForces, RimParts};
pub use teeth::{ChipParts, MeasuredTeeth, TeethForces};

use super::Sourced;
use vcutc_diagnostics::source::Span;

/// What pushes a blade, by its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BladeForces<'b> {
    /// A straight blade.
    Edge(&'b EdgeForces),
    /// A disc.
    Rim(&'b RimForces),
    /// A crusher.
    Teeth(&'b TeethForces),
}

/// How sure forces are, and where they are from.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Where they are stated.
    pub span: Span,
    /// By which share of itself each part may be off, either way; at least 0 and below 1.
    pub spread: Sourced<f64>,
    pub source: String,
}

impl BladeForces<'_> {
    /// How sure they are, and where they are from.
    #[must_use]
    pub const fn statement(&self) -> &Statement {
        match self {
            Self::Edge(forces) => &forces.statement,
            Self::Rim(forces) => &forces.statement,
            Self::Teeth(forces) => &forces.statement,
        }
    }

    /// How many times as large they are where the ultrasound fails, when stated; at least 1.
    #[must_use]
    pub fn failed(&self) -> Option<f64> {
        let failed = match self {
            Self::Edge(forces) => forces.failed,
            Self::Rim(forces) => forces.failed,
            Self::Teeth(_) => None,
        };
        failed.map(|times| times.value)
    }
}

impl Statement {
    /// Replaces the places where it is written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.span = place;
        self.spread.forget_place(place);
    }
}
