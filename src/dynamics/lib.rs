//! Dynamics: which torques an arm needs to carry out a program.
//!
//! | File | What |
//! | --- | --- |
//! | [`arm`] | the arm as bodies, and the torques of a state |
//! | [`body`] | masses |
//! | [`drives`] | torques at places along a program |
//! | [`figures`] | the most that each axis needs, for people and programs |
//! | [`verdict`] | torques above limits |

pub mod arm;
pub mod body;
pub mod drives;
pub mod figures;
mod vector;
pub mod verdict;

pub use vector::{Number, Turn};
