//! Surfaces of parts over the plan of the stock, in the workpiece frame: x across the cuts, y along them, z up. All
//! coordinates in mm.
//!
//! 1. Files of triangles are read by [`import`] into a [`mesh::Mesh`].
//! 2. A mesh in its place, over the plan of the stock, is a [`surface::Surface`].
//! 3. A surface has a shadow along y, sections, and a height at each place ([`shadow`]).

mod envelope;
pub mod import;
pub mod mesh;
pub mod shadow;
pub mod surface;
#[cfg(test)]
mod testkit;
