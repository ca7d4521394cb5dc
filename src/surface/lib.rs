//! Surfaces of parts over the plan of the stock, in the workpiece frame: x across the cuts, y along them, z up. All
//! coordinates in mm.
//!
//! 1. Files of triangles are read by [`import`] into a [`mesh::Mesh`].

pub mod import;
pub mod mesh;
