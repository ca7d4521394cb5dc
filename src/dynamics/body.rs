//! Rigid bodies: masses, and how several of them make one.

use glam::{DMat3, DVec3};
use vcutc_machine::masses::Link;

/// Millimetres in a metre.
pub(crate) const MILLIMETRES: f64 = 1000.0;

/// A rigid body, in kg and m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    pub mass: f64,
    pub centre: DVec3,
    /// About the centre, in kg m2.
    pub inertia: DMat3,
}

impl From<&Link> for Body {
    fn from(link: &Link) -> Self {
        Self {
            mass: link.mass,
            centre: link.centre_mm / MILLIMETRES,
            inertia: link.inertia,
        }
    }
}

impl Body {
    /// A mass in a place.
    #[must_use]
    pub const fn point(mass: f64, centre: DVec3) -> Self {
        Self {
            mass,
            centre,
            inertia: DMat3::ZERO,
        }
    }

    /// The mass times the place of the centre, seen from a point.
    pub(crate) fn moment(&self, point: DVec3) -> DVec3 {
        self.mass * (self.centre - point)
    }

    /// The inertia about a point (Steiner).
    pub(crate) fn inertia_about(&self, point: DVec3) -> DMat3 {
        let off = self.centre - point;
        let outer = DMat3::from_cols(off * off.x, off * off.y, off * off.z);
        self.inertia + (DMat3::from_diagonal(DVec3::splat(off.length_squared())) - outer) * self.mass
    }
}
