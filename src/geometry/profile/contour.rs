//! A machined contour: a polyline from left to right that may have walls, straight up or down at one x.
//!
//! It does not have a height for every x, so it is not a [`Profile`]. But where it comes nearest to a point
//! is found in the same way: a search by blocks asks for x that nowhere falls, not for x that rises.

use super::{Point2, Profile, least_step};

/// A polyline whose x nowhere falls.
#[derive(Clone, Debug)]
pub struct Contour(Profile);

impl Contour {
    /// Through corners from left to right. Corners closer to the one before than 1e-9 mm are dropped; one that lies left of the
    /// one before, which only rounding can bring about, is moved to its x.
    #[must_use]
    pub fn new(corners: &[Point2]) -> Self {
        let mut kept: Vec<Point2> = Vec::with_capacity(corners.len());
        for &corner in corners {
            let mut corner = corner;
            if let Some(last) = kept.last() {
                corner.x = corner.x.max(last.x);
                let least = least_step(corner.x);
                if corner.x - last.x < least && (corner.z - last.z).abs() < least {
                    continue;
                }
            }
            kept.push(corner);
        }
        Self(Profile::from_ascending(kept))
    }
}

/// What a point can be near to.
pub trait Nearest {
    /// The number of the segment nearest to a point, counted from the left, and its distance in mm; infinite where there is no
    /// segment.
    fn nearest_segment(&self, point: Point2) -> (usize, f64);
}

impl Nearest for Profile {
    fn nearest_segment(&self, point: Point2) -> (usize, f64) {
        self.nearest_segment(point)
    }
}

impl Nearest for Contour {
    fn nearest_segment(&self, point: Point2) -> (usize, f64) {
        self.0.nearest_segment(point)
    }
}
