//! The lengths and senses of an arm with an ortho-parallel basis and a spherical wrist.

use super::Joints;

/// Lengths (mm), zero offsets (rad) and senses of an ortho-parallel arm with a spherical wrist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opw {
    /// From axis 1 to axis 2, forward.
    pub a1: f64,
    /// From axis 3 to the line of axis 4, forward when the forearm points up.
    pub a2: f64,
    /// From the arm's plane to axis 1, sideways.
    pub b: f64,
    /// Height of axis 2.
    pub c1: f64,
    /// Length of the upper arm, from axis 2 to axis 3.
    pub c2: f64,
    /// From axis 3 to the wrist centre, along axis 4.
    pub c3: f64,
    /// From the wrist centre to the flange.
    pub c4: f64,
    /// `offset_i`. The wrist's branch is the sign of J5 where that of axis 5 is zero, as on all arms known to us; otherwise the
    /// sign of J5 counted from the stretched hand.
    pub offsets: Joints,
    /// `sign_i`, 1 or -1.
    pub signs: Joints,
    /// Whether J3 counts the elbow's angle or the upper arm's inclination.
    pub coupling: Coupling,
}

/// What J3 counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// The angle at the elbow.
    Serial,
    /// The inclination of the upper arm, which a rod keeps while only axis 2 moves: the elbow's angle is `J3 - J2`.
    Parallelogram,
}

impl Opw {
    /// All lengths from the root to the flange together, in mm: no point of the arm is farther away, but for what stands out.
    #[must_use]
    pub fn length(&self) -> f64 {
        let Self {
            a1,
            a2,
            b,
            c1,
            c2,
            c3,
            c4,
            ..
        } = self;
        [a1, a2, b, c1, c2, c3, c4]
            .into_iter()
            .map(|length| length.abs())
            .sum()
    }
}
