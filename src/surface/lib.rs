//! Surfaces of parts over the plan of the stock, in the workpiece frame: x across the cuts, y along them, z up. All
//! coordinates in mm.
//!
//! 1. Files of triangles are read by [`import`] into a [`mesh::Mesh`]. Heights on a [`grid`], rulings between profiles
//!    ([`loft`]), formulas ([`formula`]) and patches ([`patch`]) become meshes too.
//! 2. A mesh in its place, over the plan of the stock, is a [`surface::Surface`].
//! 3. [`coverage`] says whether each place of the plan lies under a triangle, and what is odd about them.
//! 4. A surface has a shadow along y, sections, a height at each place ([`shadow`]), a highest and a lowest place.
//! 5. A [`mod@spine`] that suits it says how cuts may rise and fall with it; with that taken off, it is roughed as by level ones.
//!    Or [`mod@columns`] cover it, with a way of its own for each cut. [`residual`] says what cuts leave over it.
//! 6. A [`deviation`] is the part's upper side as a file, with what is left above each corner.
//! 7. A [`map`] has the highest place of each of its cells, of the surface or of what is left over it.
//! 8. A [`mod@bend`] is the curvature at a place, exact or estimated from triangles, and puts it into a [`mod@class`].
//!
//! For discs that finish surfaces:
//!
//! 1. A [`disc`] with its hub and holder comes down on a surface exactly, however it leans ([`mod@drop`]).
//! 2. A [`posture`] says how it stands at a contact; [`curvature`] bounds the least [`tilt`] from below, and the drop says the least
//!    [`lead`].
//! 3. Between two poses the depth to which it may enter the surface is bounded ([`gouge`]).
//! 4. A [`section`] in any direction, with [`normals`], carries a [`track`] of poses, as close as that bound asks for.
//! 5. [`scallop`] and [`swath`] say what tracks leave, [`strip`] what comes free.

pub mod bend;
pub mod class;
pub mod columns;
pub mod coverage;
pub mod curvature;
pub mod deviation;
pub mod disc;
pub mod drop;
mod envelope;
mod extremes;
pub mod formula;
mod frechet;
pub mod gouge;
pub mod grid;
pub mod import;
mod knots;
pub mod lead;
pub mod loft;
pub mod map;
pub mod mesh;
mod nearest;
pub mod normals;
pub mod patch;
mod polyline;
pub mod posture;
mod region;
pub mod residual;
pub mod scallop;
pub mod section;
pub mod shadow;
pub mod spine;
pub mod strip;
pub mod surface;
pub mod swath;
#[cfg(test)]
mod testkit;
pub mod tilt;
pub mod track;
mod visible;
