//! Surfaces of parts over the plan of the stock, in the workpiece frame: x across the cuts, y along them, z up. All
//! coordinates in mm.
//!
//! 1. Files of triangles are read by [`import`] into a [`mesh::Mesh`]. Heights on a [`grid`], rulings between profiles
//!    ([`loft`]), formulas ([`formula`]) and patches ([`patch`]) become meshes too.
//! 2. A mesh in its place, over the plan of the stock, is a [`surface::Surface`].
//! 3. [`coverage`] says whether each place of the plan lies under a triangle, and what is odd about them.
//! 4. A surface has a shadow along y, sections, a height at each place ([`shadow`]), a highest and a lowest place.
//! 5. [`residual`] says what straight cuts leave over it.
//! 6. A [`map`] has the highest place of each of its cells, of the surface or of what is left over it.

pub mod coverage;
mod envelope;
mod extremes;
pub mod formula;
mod frechet;
pub mod grid;
pub mod import;
pub mod loft;
pub mod map;
pub mod mesh;
mod nearest;
pub mod patch;
mod polyline;
mod region;
pub mod residual;
pub mod shadow;
pub mod surface;
#[cfg(test)]
mod testkit;
mod visible;
