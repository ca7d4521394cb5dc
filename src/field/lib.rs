//! Sound fields over regions of the plan, and the passes along their zero lines.
//!
//! A line source lies along every piece of the medial axis of a region and sends plane waves to the walls on both sides.
//! The lines on which the sum of all waves is zero are half a wave apart; they are the passes of Yang, Cai, Yang, You,
//! *Novel Tool Path Generation Method for Pocket Machining Using Sound Field Synthesis Theory*, Machines 2023, 11(2):131.
//! Waves that leave are `exp(-i k r)`. Lengths are in mm, angles in rad, wave numbers in 1/mm.

pub mod axis;
pub mod complex;
pub mod domain;
pub mod field;
pub mod fresnel;
pub mod hankel;
pub mod lines;
pub mod passes;
pub mod source;
pub mod wall;
pub mod wave;

mod biarc;
mod lanes;
mod tail;
mod touch;
