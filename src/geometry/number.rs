//! Arithmetic that proves and differentiates: intervals, and functions with their derivatives.
//!
//! * A [`Number`] is what the bounds of intervals are: a plain number, or one of each of several computed side by side.
//! * An [`Interval`] encloses a number; all bounds are rounded outward (`interval` says how far).
//! * An [`Along`] encloses a function of one parameter on a span, by Taylor's theorem, without branching on any value.
//! * A [`Jet`] is a function of one or two coordinates with its slopes and, where asked for, curvatures, at a place or over a
//!   box. Formulas that are written for any [`Scalar`] give values, enclosures, slopes and curvatures alike. Jets over boxes also have
//!   sines, arcs, roots and powers where these have a value (`functions`).

mod along;
mod functions;
mod interval;
mod jet;
mod plain;

pub use along::{Along, Held};
pub use interval::{HUGE, Interval};
pub use jet::{Jet, OnLine, OnPlane, Part, Scalar, Slopes};
pub use plain::Number;

#[cfg(test)]
mod tests;
