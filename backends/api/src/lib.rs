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
//! Two ops say where the axes go instead, all of them arriving together: [`ir::Action::Home`], to the values of home, and
//! [`ir::Action::AxisTravel`], to one of the ways in which the machine can hold the blade in a pose (KRL `PTP`, RAPID
//! `MoveJ`). The first way from home is always such a move, since the way of a straight move from axis values would
//! depend on the arm; later ones are where the arm has to stand differently, and lie above the stock.
//!
//! An op says where its motion ends. [`ir::Program::segments`] walks the ops and says of each where it begins, what moves and
//! how fast; everything that follows a program uses it.
//!
//! # How a machine carries it out
//!
//! The program says nothing of axes but at home. Which way of holding the blade is meant, and where the axes are at the end
//! of every op, is said by the [`motion::Motion`] that goes with it. Between two ops that are not moves of
//! all axes the machine stays on one [`motion::Branch`]; that the axes follow the tip there, within their
//! limits and rates, has been proven before.
//!
//! # From program to files
//!
//! Only a [`motion::ReachableProgram`] can reach a backend: it joins a [`verify::VerifiedProgram`], which only
//! [`verify::verify`] makes, and a motion, which [`motion::ReachableProgram::assemble`] checks against it. A
//! [`backend::Backend`] first checks whether its dialect can say the program (data, no text) and then writes
//! bytes into a [`bundle::Sink`]; it does no kinematics and invents no defaults. What it wrote is read again by the reader of
//! its dialect ([`readback`]) and compared with the program, op by op, before anything reaches a disk.

#![warn(missing_docs)]

pub mod arc;
pub mod arm;
pub mod backend;
pub mod builder;
pub mod bundle;
pub mod chains;
pub mod confdata;
pub mod corners;
pub mod exchange;
pub mod findings;
pub mod geometry;
pub mod ir;
pub mod motion;
pub mod namer;
pub mod number;
pub mod options;
pub mod profile;
pub mod protocol;
pub mod readback;
pub mod script;
pub mod segments;
pub mod state;
pub mod status;
pub mod swivel;
#[cfg(feature = "testkit")]
pub mod testkit;
pub mod units;
pub mod vector;
pub mod verify;
pub mod words;
pub mod wrist;
