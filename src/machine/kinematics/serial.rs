//! Arms of six revolute joints in any arrangement, as a product of exponentials.
//!
//! With all joints at zero each joint's axis is a line in the root: a point and a direction. Joint `i` turns all that comes
//! after it about its line, so that
//!
//! `flange_in_root = E1(J1) E2(J2) ... E6(J6) flange_at_zero`, `Ei(J)` the rotation by `J` about line `i`
//!
//! (Brockett, Robotic manipulators and the product of exponentials formula, 1984). No frames have to be agreed on between
//! the joints, and a joint that counts the other way is a line of the other direction. That makes it the common form of what
//! a URDF describes and of the closed-form arms, whose Jacobian is found here too.

use super::Joints;
use super::jacobian::{Jacobian, Twist};
use super::joint_axis::JointAxis;
use super::mounted::Mounted;
use super::opw::{Coupling, Opw};
use super::pose::Pose;
use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::MOST_AXES;

/// An arm of six revolute joints.
#[derive(Clone, Debug, PartialEq)]
pub struct SerialArm {
    axes: [JointAxis; MOST_AXES],
    flange_at_zero: Pose,
    coupling: Coupling,
    size: f64,
}

/// An arm in one of its poses: the axes where they are now, and the flange.
struct Posed {
    axes: [JointAxis; MOST_AXES],
    flange_in_root: Pose,
}

/// Shortest direction that still says where to; shorter ones are rounding.
const LEAST_DIRECTION: f64 = 1e-6;

impl SerialArm {
    /// An arm from its axes, from the foot outwards, and its flange in the root, both with all joints at zero. Directions
    /// are brought to length 1.
    ///
    /// None if a direction is zero or a number is not finite.
    #[must_use]
    pub fn new(axes: [JointAxis; MOST_AXES], flange_at_zero: Pose) -> Option<Self> {
        let mut unit = axes;
        for axis in &mut unit {
            let length = axis.direction.length();
            if !(length >= LEAST_DIRECTION && length.is_finite() && axis.point.is_finite()) {
                return None;
            }
            axis.direction /= length;
        }
        let finite = flange_at_zero.rotation.is_finite() && flange_at_zero.position.is_finite();
        finite.then(|| Self::of(unit, flange_at_zero, Coupling::Serial))
    }

    fn of(axes: [JointAxis; MOST_AXES], flange_at_zero: Pose, coupling: Coupling) -> Self {
        let farthest = |far: f64, axis: &JointAxis| far.max(axis.distance(flange_at_zero.position));
        Self {
            axes,
            flange_at_zero,
            coupling,
            size: axes.iter().fold(1.0, farthest),
        }
    }

    /// The axes with all joints at zero.
    #[must_use]
    pub const fn axes(&self) -> &[JointAxis; MOST_AXES] {
        &self.axes
    }

    /// The flange in the root with all joints at zero.
    #[must_use]
    pub const fn flange_at_zero(&self) -> &Pose {
        &self.flange_at_zero
    }

    /// How many mm one rad is worth where lengths are weighed against angles: the largest distance of the flange from an
    /// axis with all joints at zero, at least 1 mm.
    #[must_use]
    pub const fn size(&self) -> f64 {
        self.size
    }

    /// The flange in the root.
    #[must_use]
    pub fn forward(&self, joints: &Joints) -> Pose {
        self.posed(joints).flange_in_root
    }

    /// What each of the controller's joints does to the flange and to a point fixed to it, `point_in_flange` in mm. Columns
    /// are in mm/rad and rad/rad, along the axes of the root.
    #[must_use]
    pub fn jacobian(&self, joints: &Joints, point_in_flange: DVec3) -> Jacobian {
        self.flange_and_jacobian(joints, point_in_flange).1
    }

    /// Flange and Jacobian in one go.
    pub(super) fn flange_and_jacobian(&self, joints: &Joints, point_in_flange: DVec3) -> (Pose, Jacobian) {
        let Posed { axes, flange_in_root } = self.posed(joints);
        let point = flange_in_root.rotation * point_in_flange + flange_in_root.position;
        let mut columns = axes.map(|axis| Twist::about(&axis, point));
        match self.coupling {
            Coupling::Serial => {}
            Coupling::Parallelogram => {
                // The elbow turns by J3 - J2, so J2 alone turns it back.
                let [_, second, third, ..] = &mut columns;
                second.linear -= third.linear;
                second.angular -= third.angular;
            }
        }
        (flange_in_root, Jacobian { columns })
    }

    fn posed(&self, joints: &Joints) -> Posed {
        let mut axes = self.axes;
        let mut motion = Pose::IDENTITY;
        for (axis, angle) in axes.iter_mut().zip(self.turns(joints)) {
            let here = axis.moved(&motion);
            motion = motion * axis.turned(angle);
            *axis = here;
        }
        Posed {
            axes,
            flange_in_root: motion * self.flange_at_zero,
        }
    }

    /// By how much each joint turns.
    fn turns(&self, joints: &Joints) -> Joints {
        self.turns_of(*joints, |third, second| third - second)
    }

    /// By how much each joint turns, for any kind of number.
    pub fn turns_of<N: Copy>(
        &self,
        joints: [N; MOST_AXES],
        difference: impl Fn(N, N) -> N,
    ) -> [N; MOST_AXES] {
        let [j1, j2, j3, j4, j5, j6] = joints;
        match self.coupling {
            Coupling::Serial => joints,
            Coupling::Parallelogram => [j1, j2, difference(j3, j2), j4, j5, j6],
        }
    }
}

impl From<&Opw> for SerialArm {
    /// The same arm with the same joints: offsets go into the flange and the lines at zero, signs into the lines' directions.
    fn from(arm: &Opw) -> Self {
        let [q1, q2, q3, q4, q5, _] = arm.offsets.map(|offset| -offset);
        let upright = DMat3::from_rotation_z(q1);
        let upper = upright * DMat3::from_rotation_y(q2);
        let fore = upper * DMat3::from_rotation_y(q3);
        let rolled = fore * DMat3::from_rotation_z(q4);
        let hand = rolled * DMat3::from_rotation_y(q5);
        let shoulder = DVec3::new(0.0, 0.0, arm.c1) + upright * DVec3::new(arm.a1, arm.b, 0.0);
        let elbow = shoulder + upper * DVec3::new(0.0, 0.0, arm.c2);
        let wrist = elbow + fore * DVec3::new(arm.a2, 0.0, arm.c3);
        let lines = [
            (DVec3::ZERO, DVec3::Z),
            (shoulder, upright.y_axis),
            (elbow, upper.y_axis),
            (wrist, fore.z_axis),
            (wrist, rolled.y_axis),
            (wrist, hand.z_axis),
        ];
        let mut axes = lines.map(|(point, direction)| JointAxis { point, direction });
        for (axis, sign) in axes.iter_mut().zip(arm.signs) {
            axis.direction *= sign;
        }
        Self::of(axes, arm.forward(&[0.0; MOST_AXES]), arm.coupling)
    }
}

impl From<&Mounted> for SerialArm {
    fn from(mounted: &Mounted) -> Self {
        let inner = Self::from(&mounted.arm);
        Self::of(
            inner.axes.map(|axis| axis.moved(&mounted.foot_in_root)),
            mounted.foot_in_root * inner.flange_at_zero * mounted.flange_in_hand,
            inner.coupling,
        )
    }
}

#[cfg(test)]
mod tests;
