//! The part's profile: a height for every x.

use super::curve::Point2;

/// A height over x, as a polyline with strictly increasing x. No vertical steps, at least two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    points: Vec<Point2>,
}

impl Profile {
    /// The corners, with strictly increasing x.
    #[must_use]
    pub fn points(&self) -> &[Point2] {
        &self.points
    }
}
