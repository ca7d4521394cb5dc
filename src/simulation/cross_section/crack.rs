//! Slits that are still open in the material.

use super::sorted::Placed;

/// A vertical crack, from its bottom up to the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crack {
    /// Where, in mm.
    pub x: f64,
    /// Height of its lower end, in mm.
    pub bottom: f64,
}

impl Placed for Crack {
    fn x(&self) -> f64 {
        self.x
    }
}
