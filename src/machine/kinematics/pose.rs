//! Rigid poses for computing with: rotation matrix and position.

use glam::{DMat3, DQuat, DVec3};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};

/// The pose of an inner frame in an outer one: `v_outer = rotation * v_inner + position`. Variables are named
/// `inner_in_outer`, so that `b_in_a * c_in_b` is `c_in_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Columns are the axes of the inner frame seen from the outer one.
    pub rotation: DMat3,
    /// Origin of the inner frame in the outer one, in mm.
    pub position: DVec3,
}

impl Pose {
    /// Both frames the same.
    pub const IDENTITY: Self = Self {
        rotation: DMat3::IDENTITY,
        position: DVec3::ZERO,
    };

    /// The outer frame seen from the inner one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self {
            rotation,
            position: -(rotation * self.position),
        }
    }

    /// How far apart two poses are: in mm, and the Frobenius norm of the difference of their rotations.
    #[must_use]
    pub fn apart(&self, other: &Self) -> (f64, f64) {
        let turned = self.rotation - other.rotation;
        let square =
            turned.x_axis.length_squared() + turned.y_axis.length_squared() + turned.z_axis.length_squared();
        (self.position.distance(other.position), square.sqrt())
    }
}

impl core::ops::Mul for Pose {
    type Output = Self;
    fn mul(self, inner: Self) -> Self {
        Self {
            rotation: self.rotation * inner.rotation,
            position: self.rotation * inner.position + self.position,
        }
    }
}

impl From<Frame> for Pose {
    fn from(frame: Frame) -> Self {
        let [w, x, y, z] = frame.orientation.quaternion();
        Self {
            rotation: DMat3::from_quat(DQuat::from_xyzw(x, y, z, w)),
            position: DVec3::new(frame.origin.x, frame.origin.y, frame.origin.z),
        }
    }
}

impl From<Pose> for Frame {
    fn from(pose: Pose) -> Self {
        let q = DQuat::from_mat3(&pose.rotation);
        Self {
            origin: Point3::new(pose.position.x, pose.position.y, pose.position.z),
            orientation: Orientation::from_quaternion(q.w, q.x, q.y, q.z).unwrap_or(Orientation::IDENTITY),
        }
    }
}
