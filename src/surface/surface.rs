//! The surface of a part over the plan of the stock.
//!
//! A [`Surface`] is a mesh that was put in its place in the workpiece frame, clipped to the plan `0 <= x <= W`,
//! `0 <= y <= D` (corners within 1e-9 mm of its sides are put on them), and brought into one order: corners by their
//! coordinates, triangles by their corners, each from its least corner on. So the same triangles in another order make the
//! same surface to the last bit, and so does everything computed from it.
//!
//! The height of the surface over a place is the highest of its triangles there: what lies below stays covered. Proofs use
//! these triangles; the true surface lies within a stated tolerance of them.

mod bins;
mod clip;
mod cut;
mod order;

pub(crate) use bins::{Bins, Cell};
pub(crate) use clip::clipped;
pub(crate) use cut::cut;

use crate::mesh::{Mesh, is_in_range};
use core::fmt;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::vector::dot;
use vcutc_geometry::curve::LARGEST_COORDINATE;

/// The plan of the stock: `0 <= x <= width`, `0 <= y <= depth` in the workpiece frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Across the cuts.
    pub width: Length,
    /// Along the cuts.
    pub depth: Length,
}

/// Where a mesh lies in the workpiece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The mesh's own frame, seen from the workpiece.
    pub frame: Frame,
    /// The length of one unit of the mesh's coordinates.
    pub unit: Length,
}

/// How exactly a surface is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// The true surface lies within this of the triangles.
    pub tolerance: Length,
    /// Gaps between triangles that are at most this wide in plan are closed.
    pub weld: Length,
}

/// Why there is no surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceError {
    /// The plan is empty, or a given number is not finite or out of range.
    BadPlan,
    /// With its unit and in its place the mesh reaches beyond the largest coordinate.
    OutOfRange,
    /// No triangle lies over the plan. The least and the greatest coordinates of the mesh in its place.
    Elsewhere {
        /// The least.
        low: Point3,
        /// The greatest.
        high: Point3,
    },
}

impl fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadPlan => write!(f, "the plan is empty or out of range"),
            Self::OutOfRange => write!(f, "the surface reaches beyond the largest coordinate"),
            Self::Elsewhere { low, high } => write!(
                f,
                "the surface lies elsewhere: x {} to {}, y {} to {}",
                low.x, high.x, low.y, high.y
            ),
        }
    }
}

impl core::error::Error for SurfaceError {}

/// The surface of a part over the plan of the stock.
#[derive(Clone, Debug)]
pub struct Surface {
    mesh: Mesh,
    plan: Plan,
    accuracy: Accuracy,
    bins: Bins,
}

/// Two surfaces are equal when their triangles, their plan and their accuracy are.
impl PartialEq for Surface {
    fn eq(&self, other: &Self) -> bool {
        let Self {
            mesh,
            plan,
            accuracy,
            // They follow from the triangles and the plan.
            bins: _,
        } = self;
        *plan == other.plan && *accuracy == other.accuracy && *mesh == other.mesh
    }
}

impl Surface {
    /// The surface of a mesh in its place, over the plan.
    ///
    /// # Errors
    /// See [`SurfaceError`].
    pub fn new(
        mesh: &Mesh,
        placement: &Placement,
        plan: Plan,
        accuracy: Accuracy,
    ) -> Result<Self, SurfaceError> {
        let unit = placement.unit.to_mm();
        if !(unit > 0.0 && unit <= LARGEST_COORDINATE && placement.frame.origin.is_finite()) {
            return Err(SurfaceError::BadPlan);
        }
        let rotation = placement.frame.orientation.matrix();
        let origin = placement.frame.origin;
        let place = |point: &Point3| {
            let scaled = point.to_array().map(|part| part * unit);
            let turned = rotation.map(|row| dot(row, scaled));
            Point3::new(origin.x + turned[0], origin.y + turned[1], origin.z + turned[2])
        };
        let corners = mesh.corners().iter().map(place).collect();
        Self::of(corners, mesh.triangles().to_vec(), plan, accuracy)
    }

    /// The surface of triangles in the workpiece frame, of which all named corners exist.
    pub(crate) fn of(
        corners: Vec<Point3>,
        triangles: Vec<[u32; 3]>,
        plan: Plan,
        accuracy: Accuracy,
    ) -> Result<Self, SurfaceError> {
        let (width, depth) = (plan.width.to_mm(), plan.depth.to_mm());
        let proper = |length: f64| (1e-3..=LARGEST_COORDINATE).contains(&length);
        let small = |length: Length| length.to_mm() >= 0.0 && length.to_mm() <= LARGEST_COORDINATE;
        if !(proper(width) && proper(depth) && small(accuracy.tolerance) && small(accuracy.weld)) {
            return Err(SurfaceError::BadPlan);
        }
        if !corners.iter().all(|&corner| is_in_range(corner)) {
            return Err(SurfaceError::OutOfRange);
        }
        let whole = Mesh::new(corners, triangles).map_err(|_| SurfaceError::OutOfRange)?;
        let extent = whole.extent();
        let mesh = order::clipped_in_order(whole, width, depth);
        if mesh.triangles().is_empty() {
            let nowhere = Point3::new(0.0, 0.0, 0.0);
            let [low, high] = extent.unwrap_or([nowhere; 2]);
            return Err(SurfaceError::Elsewhere { low, high });
        }
        let bins = Bins::new(&mesh, width, depth);
        Ok(Self {
            mesh,
            plan,
            accuracy,
            bins,
        })
    }

    /// The triangles over the plan, clipped to it, in the workpiece frame, in mm.
    #[must_use]
    pub const fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The plan.
    #[must_use]
    pub const fn plan(&self) -> Plan {
        self.plan
    }

    /// How exactly it is known.
    #[must_use]
    pub const fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// The size of the plan along x and y, in mm.
    pub(crate) const fn size(&self) -> [f64; 2] {
        [self.plan.width.to_mm(), self.plan.depth.to_mm()]
    }

    pub(crate) const fn bins(&self) -> &Bins {
        &self.bins
    }

    /// The corners of a triangle by its number.
    pub(crate) fn triangle(&self, number: u32) -> [Point3; 3] {
        let named = self.mesh.triangles().get(number as usize).copied();
        self.mesh.face(named.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests;
