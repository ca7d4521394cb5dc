//! The forces of a straight blade's edge.

use super::Statement;
use crate::Sourced;
use vcutc_backend_api::units::{Angle, EdgeForce, Force, Speed};
use vcutc_diagnostics::source::Span;

/// The force of a straight blade's edge: so much on each millimetre of it that is in the material, and so much at the tip. All
/// parts are zero or more.
///
/// `drag` acts against the motion of the tip, `axial` pushes the blade up along its axis, and `side` pushes it along the normal
/// of its plane into the waste.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeForces {
    pub statement: Statement,
    pub edge: EdgeParts<EdgeForce>,
    /// What comes on top at the tip, however much of the edge is in the material.
    pub tip: EdgeParts<Force>,
    /// How many times as large they are where the ultrasound fails, when stated; at least 1.
    pub failed: Option<Sourced<f64>>,
    pub measured: MeasuredEdge,
}

/// A force by its parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeParts<F> {
    pub drag: F,
    pub axial: F,
    pub side: F,
}

/// How an edge was moved when its forces were measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredEdge {
    pub feed: Sourced<Speed>,
    pub rake: Sourced<Angle>,
    /// Of the flank that was cut; zero of an upright one.
    pub swing: Sourced<Angle>,
}

impl EdgeForces {
    /// Replaces the places where they are written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.statement.forget_places(place);
        if let Some(failed) = &mut self.failed {
            failed.forget_place(place);
        }
        self.measured.feed.forget_place(place);
        self.measured.rake.forget_place(place);
        self.measured.swing.forget_place(place);
    }
}
