//! The intermediate program (IR) of vcutc, its verifier, and the trait a backend implements.
//!
//! # What the IR means
//!
//! A [`ir::Program`] is a flat, ordered list of [`ir::Op`]s carried out one after the other by a machine that
//! carries one blade. Nothing is implied: every op names where the blade tip ends, how the blade is held there,
//! and how fast it goes. Poses are poses of the **blade frame T in the workpiece frame W**:
//!
//! * W: x across the cuts, y along them (feed), z up out of the stock; millimetres; the stock is the box
//!   `0 <= x <= width`, `0 <= y <= depth`, `0 <= z <= height`.
//! * T: origin at the blade tip; `z_t` points from the shank out through the tip, `x_t` lies in the blade plane
//!   square to the tool axis on the side of the edge that leads on a +y feed, `y_t = z_t x x_t`.
//!
//! Between two poses the tip moves on a straight line while the orientation turns about one fixed axis, both
//! finishing together: that is what KRL `LIN`, RAPID `MoveL` and a G-code `G1` with tool-tip control do. A
//! rotation between consecutive poses is therefore always less than 180 degrees (there would be two ways
//! round); [`verify::verify`] refuses anything else.
//!
//! # From program to files
//!
//! Only a [`verify::VerifiedProgram`] can reach a backend, and only [`verify::verify`] makes one. A
//! [`backend::Backend`] first checks whether its dialect can say the program (data, no text) and then writes
//! bytes into a [`bundle::Sink`]; it does no kinematics, reads nothing and invents no defaults.

pub mod backend;
pub mod bundle;
pub mod geometry;
pub mod ir;
pub mod motion;
pub mod namer;
pub mod number;
#[cfg(feature = "testkit")]
pub mod testkit;
pub mod units;
pub mod verify;
