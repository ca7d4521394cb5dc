//! Dynamics: which torques an arm needs to carry out a program, and how far the forces of its blades bend it.
//!
//! | File | What |
//! | --- | --- |
//! | `chain` | the joints of an arm, and how they move what they carry |
//! | [`arm`] | an arm as bodies, and the torques of a state |
//! | [`arms`], [`drives`] | the arm of a program with each of its blades, and its torques at places |
//! | [`places`] | all that happens in places along a program: torques, forces, deviations |
//! | [`cuts`], [`blade`], [`condition`] | cuts by blades whose forces are known, and how they are made |
//! | `everywhere`, [`figures`], [`verdict`] | the most torque that each axis needs, anywhere; its figures; those above limits |
//! | `push`, `milling`, `springs` | how the work pushes a blade, the forces of teeth that mill, and how joints yield |
//! | [`deviation`] | how far cuts are off, everywhere on them; its figures and limits |
//! | [`modes`] | how the arm swings by itself: its mass matrix, its modes, and these over the cuts of a program |
//! | `peaks` | the most of quantities along motions, proven |

pub mod arm;
pub mod arms;
pub mod blade;
mod chain;
pub mod condition;
pub mod cuts;
pub mod deviation;
pub mod drives;
mod everywhere;
pub mod figures;
mod milling;
pub mod modes;
mod peaks;
pub mod places;
mod push;
mod springs;
mod turn;
mod vector;
pub mod verdict;

pub use push::Shift;
pub use turn::Turn;
pub use vector::Number;
