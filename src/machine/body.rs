//! Rigid bodies: masses, and how several of them make one.

use crate::kinematics::pose::Pose;
use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::{Inertia, Load};

/// Millimetres in a metre.
pub const MILLIMETRES: f64 = 1000.0;

/// By which share of its size an inertia may fail to be that of a body: numbers are printed with some decimals only.
const PRINTED: f64 = 1e-3;

/// A rigid body, in kg and m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    pub mass: f64,
    pub centre: DVec3,
    /// About the centre, in kg m2.
    pub inertia: DMat3,
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

    /// Several bodies that move as one. Without mass it is in the origin.
    #[must_use]
    pub fn joined(bodies: &[Self]) -> Self {
        let mass: f64 = bodies.iter().map(|body| body.mass).sum();
        let moment: DVec3 = bodies.iter().map(|body| body.moment(DVec3::ZERO)).sum();
        let centre = if mass > 0.0 { moment / mass } else { DVec3::ZERO };
        let inertia = bodies
            .iter()
            .fold(DMat3::ZERO, |sum, body| sum + body.inertia_about(centre));
        Self {
            mass,
            centre,
            inertia,
        }
    }

    /// The same body seen from an outer frame.
    #[must_use]
    pub fn moved(&self, inner_in_outer: &Pose) -> Self {
        let rotation = inner_in_outer.rotation;
        Self {
            mass: self.mass,
            centre: rotation * self.centre + inner_in_outer.position / MILLIMETRES,
            inertia: rotation * self.inertia * rotation.transpose(),
        }
    }

    /// Whether a body can have its inertia; none at all counts as one.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        // The second moments of its mass make a matrix without negative eigenvalues. That includes the triangle of its moments of
        // inertia.
        let [x, y, z] = [self.inertia.x_axis, self.inertia.y_axis, self.inertia.z_axis];
        let size = x.x + y.y + z.z;
        let moments = DMat3::from_diagonal(DVec3::splat(size / 2.0)) - self.inertia;
        self.inertia == DMat3::ZERO || has_no_negative(moments, PRINTED * size.abs())
    }

    /// The mass times the place of the centre, seen from a point.
    #[must_use]
    pub fn moment(&self, point: DVec3) -> DVec3 {
        self.mass * (self.centre - point)
    }

    /// The inertia about a point (Steiner).
    #[must_use]
    pub fn inertia_about(&self, point: DVec3) -> DMat3 {
        let off = self.centre - point;
        let outer = DMat3::from_cols(off * off.x, off * off.y, off * off.z);
        self.inertia + (DMat3::from_diagonal(DVec3::splat(off.length_squared())) - outer) * self.mass
    }
}

impl From<Load> for Body {
    /// Seen from the flange.
    fn from(load: Load) -> Self {
        let inertia = load.inertia.unwrap_or(Inertia::POINT);
        Self {
            mass: load.mass.to_kg(),
            centre: DVec3::from_array(load.centre.to_array()) / MILLIMETRES,
            inertia: DMat3::from_diagonal(DVec3::from_array(inertia.to_array())),
        }
    }
}

/// Whether a symmetric matrix has no eigenvalue below `-slack`, about.
fn has_no_negative(matrix: DMat3, slack: f64) -> bool {
    let matrix = matrix + DMat3::from_diagonal(DVec3::splat(slack));
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let minors = [
        x.x * y.y - x.y * x.y,
        x.x * z.z - x.z * x.z,
        y.y * z.z - y.z * y.z,
    ];
    [x.x, y.y, z.z].iter().all(|entry| *entry >= 0.0)
        && minors.iter().all(|minor| *minor >= 0.0)
        && matrix.determinant() >= 0.0
}
