//! What the benchmarks run: jobs of a given size, the compiler's stages one by one, and what they are compared with.
//!
//! * [`jobs`] writes job texts of about so many V-cuts.
//! * [`stages`] runs one stage of the compiler each.
//! * [`emission`] writes the same program text in other ways: with the standard library's formatting, and as bytes
//!   that are already there.
//! * [`contour`] finds the same machined contour by polygon clipping.
//! * [`strips`] cuts layers of slits and strips, by us and by polygon clipping.
//! * [`processes`] writes jobs that are roughed by the faster of two processes, and by V cuts alone.
//! * [`surface`] reads surfaces of many triangles, and asks for their shadow, sections and what cuts leave.
//! * [`auto`] writes random jobs that leave their parameters to the compiler.
//! * [`drop`] lets leaning discs come down on such a surface, and bounds their moves.
//! * [`optimum`] asks for the parameters of least time, of us and of others.
//! * [`kinematics`] solves the inverse kinematics of the same poses, by us and by others.
//!
//! The criterion benchmarks under `benches/` and the program `measure` use the same functions, and each comparison
//! first makes sure that both sides give the same answer.

pub mod auto;
pub mod contour;
pub mod drop;
pub mod emission;
pub mod jobs;
pub mod kinematics;
pub mod optimum;
#[path = "../../src/machine/tests/kinematics/peer.rs"]
pub mod peer;
pub mod processes;
pub mod stages;
pub mod strips;
pub mod surface;
