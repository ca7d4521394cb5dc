//! Reach: proves that a machine can carry out a program, and how.
//!
//! A [`rig::Rig`] is a machine with its tool and base frames; it turns poses of the blade in the workpiece into poses of the
//! flange in the machine's root. Every motion of a program is a [`path::Course`] of the blade; [`path`] proves that the
//! axes follow it.

pub mod axis_range;
pub mod ceiling;
pub mod critical;
pub mod demand;
pub mod describe;
pub mod figures;
pub mod ladder;
pub mod moves;
pub mod pace;
pub mod parts;
pub mod path;
pub mod reorient;
pub mod rig;
pub mod rigs;
mod runs;
pub mod solve;
mod stands;
pub mod stray;
pub mod summary;
mod survey;
pub mod sweep;
pub mod trajectory;
pub mod trouble;
pub mod verdict;
pub mod way;
mod waypoints;
mod ways;
