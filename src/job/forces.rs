//! The forces that an edge needs, as somebody measured them.

use super::Sourced;
use vcutc_backend_api::units::{Angle, EdgeForce, Force, Speed};
use vcutc_diagnostics::source::Span;

/// The force of a straight blade's edge: so much on each millimetre of it that is in the material, and so much at the tip. All
/// parts are zero or more.
///
/// `drag` acts against the motion of the tip, `axial` pushes the blade up along its axis, and `side` pushes it along the normal
/// of its plane into the waste.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Where they are stated.
    pub span: Span,
    pub edge: Parts<EdgeForce>,
    /// What comes on top at the tip, however much of the edge is in the material.
    pub tip: Parts<Force>,
    /// By which share of itself each part may be off, either way; at least 0 and below 1.
    pub spread: Sourced<f64>,
    /// How many times as large they are where the ultrasound fails, when stated; at least 1.
    pub failed: Option<Sourced<f64>>,
    pub measured: Measured,
    pub source: String,
}

/// A force by its parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts<F> {
    pub drag: F,
    pub axial: F,
    pub side: F,
}

/// How an edge was moved when its forces were measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    pub feed: Sourced<Speed>,
    pub rake: Sourced<Angle>,
    /// Of the flank that was cut; zero of an upright one.
    pub swing: Sourced<Angle>,
}

impl Forces {
    /// Replaces the places where they are written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.span = place;
        self.spread.forget_place(place);
        if let Some(failed) = &mut self.failed {
            failed.forget_place(place);
        }
        self.measured.feed.forget_place(place);
        self.measured.rake.forget_place(place);
        self.measured.swing.forget_place(place);
    }
}
