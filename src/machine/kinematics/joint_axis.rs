//! The line about which a joint turns.

use super::pose::Pose;
use glam::{DMat3, DVec3};

/// The line about which a joint turns, in the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAxis {
    /// A point of the line, in mm.
    pub point: DVec3,
    /// Its direction, of length 1: the joint counts positive as a right-hand screw turns.
    pub direction: DVec3,
}

impl JointAxis {
    /// The rotation by an angle about the line.
    pub(super) fn turned(&self, angle: f64) -> Pose {
        let rotation = DMat3::from_axis_angle(self.direction, angle);
        Pose {
            rotation,
            position: self.point - rotation * self.point,
        }
    }

    /// The line where a motion of its body brings it; the line in an outer frame, for `inner_in_outer`.
    #[must_use]
    pub fn moved(&self, motion: &Pose) -> Self {
        Self {
            point: motion.rotation * self.point + motion.position,
            direction: motion.rotation * self.direction,
        }
    }

    pub(super) fn distance(&self, point: DVec3) -> f64 {
        (point - self.point).cross(self.direction).length()
    }
}
