//! Regions of the plan bounded by walls, and passes of a round tool over them.
//!
//! Everything here lies in the x-y plane of the workpiece frame, in mm and rad. A [`region::Region`] is bounded by
//! loops of lines and arcs. Arcs stay arcs: from the drawing to the program nothing is flattened.

pub mod boxes;
pub mod clearance;
pub mod coverage;
pub mod curve;
pub mod distance;
pub mod engagement;
pub mod foot;
pub mod freed;
pub mod links;
pub mod offset;
pub mod order;
pub mod outward;
pub mod pass;
pub mod pattern;
pub mod piece;
pub mod place;
pub mod plate;
pub mod region;
mod rounded;
pub mod rows;
pub mod slits;

#[cfg(any(test, feature = "testkit"))]
pub mod testkit;
