//! What straight cuts leave over a part that changes along y.
//!
//! They leave the same height at every y, so they cannot go below the part's shadow. What lies between shadow and part is left
//! whatever they do; it shows how well straight cuts suit the part.

use vcutc_geometry::curve::Point2;
use vcutc_job::Part;
use vcutc_surface::residual::{Machined, Standing, Volume};

/// What is left over a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOver {
    /// All that is left.
    pub all: Standing,
    /// What of it lies below the shadow.
    pub shaded: Volume,
}

impl LeftOver {
    /// What cuts leave that end at this contour, from left to right; none over a profile.
    pub(crate) fn of(part: &Part, contour: &[Point2]) -> Option<Self> {
        let surface = part.surface()?;
        let shadow = part.tessellated(Part::TOLERANCE)?;
        let below = |corners: &[Point2]| Machined::new(corners.to_vec()).ok();
        // Checking a job refuses surfaces that are too tangled for this.
        let all = surface.standing(&below(contour)?).ok()??;
        let shaded = surface.standing(&below(shadow.points())?).ok()??.volume;
        Some(Self { all, shaded })
    }
}
