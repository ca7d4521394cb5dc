//! The forces of a disc's rim.

use super::Statement;
use crate::Sourced;
use vcutc_backend_api::units::{AngularSpeed, EdgeForce, Speed};
use vcutc_diagnostics::source::Span;

/// The force of a disc: so much on each millimetre of its rim that is in the material. All parts are zero or more.
#[derive(Clone, Debug, PartialEq)]
pub struct RimForces {
    pub statement: Statement,
    pub rim: RimParts,
    /// How many times as large they are where the ultrasound fails, when stated; at least 1.
    pub failed: Option<Sourced<f64>>,
    pub measured: MeasuredRim,
}

/// A force by its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimParts {
    /// Against the motion of the disc.
    pub drag: EdgeForce,
    /// Along its axis, towards the shank.
    pub axial: EdgeForce,
    /// Square to both, to either side.
    pub radial: EdgeForce,
}

/// How a disc was moved when its forces were measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredRim {
    pub feed: Sourced<Speed>,
    pub spin: Sourced<AngularSpeed>,
}

impl RimForces {
    /// Replaces the places where they are written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.statement.forget_places(place);
        if let Some(failed) = &mut self.failed {
            failed.forget_place(place);
        }
        self.measured.feed.forget_place(place);
        self.measured.spin.forget_place(place);
    }
}
