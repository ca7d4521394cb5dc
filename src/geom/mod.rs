//! Plane geometry in the x-z plane: curves, the part's profile, and files of points.

pub mod curve;
pub mod import;
pub mod profile;
