//! The forces of a crusher's teeth, by the coefficients of milling.

use super::Statement;
use crate::Sourced;
use core::num::NonZeroU32;
use vcutc_backend_api::units::{Angle, AngularSpeed, CuttingPressure, EdgeForce, Length};
use vcutc_diagnostics::source::Span;

/// The force of a crusher with teeth on its outside, as an end mill has them: in proportion to the thickness of the chip that a
/// tooth takes, and to the length of its edge [Ha 2019, equations 32 to 36].
#[derive(Clone, Debug, PartialEq)]
pub struct TeethForces {
    pub statement: Statement,
    /// How many teeth there are on its outside.
    pub count: NonZeroU32,
    /// The angle between teeth and axis; at least 0 and below 90 degrees.
    pub helix: Sourced<Angle>,
    /// On each area of a chip.
    pub cutting: ChipParts<CuttingPressure>,
    /// On each length of a tooth in the material, however thin the chip is.
    pub edge: ChipParts<EdgeForce>,
    pub measured: MeasuredTeeth,
}

/// A force by its parts, all of them zero or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChipParts<F> {
    /// Against the motion of the tooth.
    pub tangential: F,
    /// From the tooth to the axis.
    pub radial: F,
    /// Along the axis, towards the shank.
    pub axial: F,
}

/// How a crusher was moved when its forces were measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredTeeth {
    /// The thickest chip of a tooth.
    pub chip: Sourced<Length>,
    pub spin: Sourced<AngularSpeed>,
}

impl TeethForces {
    /// Replaces the places where they are written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.statement.forget_places(place);
        self.helix.forget_place(place);
        self.measured.chip.forget_place(place);
        self.measured.spin.forget_place(place);
    }
}
