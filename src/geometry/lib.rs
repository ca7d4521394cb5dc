//! Plane geometry in the x-z plane of the workpiece frame: curves, the part's profile, what a blade must keep clear
//! of, and files of points. All coordinates in mm.
//!
//! The way from a job to the planner:
//!
//! 1. pieces of a profile are [`curve::Curve`]s, formulas are [`curve::sample`]d, files are read by [`import`];
//! 2. all of them end as one polyline, a [`profile::Profile`], which is a function of x;
//! 3. [`offset::offset_up`] lays the allowance over it, [`cone::clearance`] says how deep a V may go at each x.
//!
//! Approximations are one-sided or bounded, and each says which: curves are flattened within a stated tolerance, an
//! offset is never below the true one, a clearance is exact.

pub mod columns;
pub mod cone;
pub mod curve;
pub mod grid;
pub mod import;
pub mod number;
pub mod offset;
mod point;
pub mod profile;
pub mod spine;
