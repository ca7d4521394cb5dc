//! Slits of a straight blade over a region of the plan, in programs: how they are written, how they are read back, and their proof.

pub mod fit;
pub mod lower;
pub mod proof;
pub mod stated;
mod turns;
pub mod ways;

/// The shortest lines that may stand for an arc, in mm: the rounding of their ends turns shorter ones by more than 0.2 deg, and a program
/// lets a way leave the plane of its blade by 0.45 deg.
const SHORTEST_STEP: f64 = 0.6;
