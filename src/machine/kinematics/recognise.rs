//! Recognises an ortho-parallel arm with a spherical wrist among serial arms, so that a robot described by others gets the
//! closed form of [`super::opw`].
//!
//! The lines of the joints at zero determine everything: line 2 is square to line 1, line 3 parallel to line 2, line 4 square to line 3,
//! line 5 square to lines 4 and 6, and lines 4, 5 and 6 meet in a point, the wrist. The lengths are then distances between
//! them, the offsets are the angles of the arm at zero, and a sign says whether a line points the way in which
//! the model counts. Where that leaves a choice, it is made so that arms are as in their makers' data sheets: axis 1
//! upwards, axis 2 before it (`a1 > 0`), the forearm outwards, the hand rolled by a quarter turn at most.
//!
//! Numbers in descriptions are rounded, a right angle often to `1.5708`, so lines are square and meet only nearly. The model
//! is therefore compared with the arm in many poses and taken only if the flange is the same within [`FIT`].

use super::Mechanism;
use super::joint_axis::JointAxis;
use super::mounted::Mounted;
use super::newton::spread;
use super::opw::{Coupling, Opw};
use super::pose::Pose;
use super::serial::SerialArm;
use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::MOST_AXES;

/// How far the model's flange may be from the arm's, in mm and as Frobenius norm. A right angle rounded to four decimals
/// moves the flange of an arm of 3 m by 0.01 mm, and a chain has several of them.
pub const FIT: (f64, f64) = (0.1, 1e-4);

/// In how many poses the two are compared.
const POSES: u32 = 64;

/// Lines are square or parallel if cosine or sine is below this: more than a rounded right angle is off, less than any angle
/// that is meant.
const STRAIGHT: f64 = 1e-4;

/// Lengths up to this count as 0, in mm.
const NO_LENGTH: f64 = 1e-3;

/// Angles up to this count as 0, in rad: rounding of the arithmetic.
const NO_ANGLE: f64 = 1e-12;

/// A constant pose that differs by less from none at all, in mm and as Frobenius norm, is rounding.
const NO_CORRECTION: (f64, f64) = (1e-6, 1e-9);

/// The mechanism with a closed form that moves as this arm does, if there is one.
#[must_use]
pub fn closed_form(arm: &SerialArm) -> Option<Mechanism> {
    let mounted = model(arm)?;
    let fits = (0..POSES).all(|pose| {
        let joints = spread(pose);
        let (apart, turned) = mounted.forward(&joints).apart(&arm.forward(&joints));
        apart <= FIT.0 && turned <= FIT.1
    });
    let is_bare = is_idle(&mounted.foot_in_root) && is_idle(&mounted.flange_in_hand);
    fits.then_some(if is_bare {
        Mechanism::OrthoParallel(mounted.arm)
    } else {
        Mechanism::Mounted(mounted)
    })
}

fn is_idle(correction: &Pose) -> bool {
    let (apart, turned) = correction.apart(&Pose::IDENTITY);
    apart <= NO_CORRECTION.0 && turned <= NO_CORRECTION.1
}

/// The model that the lines suggest, not yet compared with the arm.
fn model(arm: &SerialArm) -> Option<Mounted> {
    if !is_shaped(arm.axes()) {
        return None;
    }
    let [one, ..] = arm.axes();
    let foot_in_root = foot(one);
    let root_in_foot = foot_in_root.inverse();
    let [one, two, three, four, five, six] = arm.axes().map(|axis| axis.moved(&root_in_foot));
    let flange_in_foot = root_in_foot * *arm.flange_at_zero();
    let wrist = between(&four, &five);

    let (front, s2) = front(&two);
    let s3 = sign(three.direction.dot(front.y_axis));
    let flat = |v: DVec3| Flat {
        x: v.dot(front.x_axis),
        z: v.z,
    };
    let (shoulder, upper) = (flat(two.point), flat(three.point - two.point));
    let reach = flat(wrist - three.point);
    let s4 = sign(flat(four.direction).dot(reach));
    let fore = flat(four.direction * s4);
    if upper.length() <= NO_LENGTH || reach.length() <= NO_LENGTH {
        return None;
    }
    let forearm = front * DMat3::from_rotation_y(fore.lean());
    let (q4, s5) = roll(&(forearm.transpose() * five.direction));
    let rolled = forearm * DMat3::from_rotation_z(q4);
    let outwards = flange_in_foot.position - wrist;
    let s6 = sign(outwards.dot(six.direction));
    let pointing = rolled.transpose() * six.direction * s6;
    let q5 = libm::atan2(pointing.x, pointing.z);
    let hand = rolled * DMat3::from_rotation_y(q5);
    let at_zero = [
        libm::atan2(front.x_axis.y, front.x_axis.x),
        upper.lean(),
        fore.lean() - upper.lean(),
        q4,
        q5,
        spin(&(hand.transpose() * flange_in_foot.rotation)),
    ];
    let arm = Opw {
        a1: shoulder.x,
        a2: reach.dot(fore.across()),
        b: wrist.dot(front.y_axis),
        c1: shoulder.z,
        c2: upper.length(),
        c3: reach.dot(fore),
        c4: outwards.dot(hand.z_axis),
        offsets: at_zero.map(|angle| if angle.abs() <= NO_ANGLE { 0.0 } else { -angle }),
        signs: [sign(one.direction.z), s2, s3, s4, s5, s6],
        coupling: Coupling::Serial,
    };
    let hand_in_foot = arm.forward(&[0.0; MOST_AXES]);
    Some(Mounted {
        foot_in_root,
        arm,
        flange_in_hand: hand_in_foot.inverse() * flange_in_foot,
    })
}

/// Whether the directions of the lines are those of an ortho-parallel arm. Whether the last three meet is seen from the
/// comparison.
fn is_shaped(axes: &[JointAxis; MOST_AXES]) -> bool {
    let [one, two, three, four, five, six] = axes.map(|axis| axis.direction);
    let is_square = |a: DVec3, b: DVec3| a.dot(b).abs() <= STRAIGHT;
    is_square(one, two)
        && two.cross(three).length() <= STRAIGHT
        && is_square(three, four)
        && is_square(four, five)
        && is_square(five, six)
}

/// The foot of the model in the root: z along axis 1 and upwards, the origin at the height of the root's, x as near to the
/// root's as can be.
fn foot(one: &JointAxis) -> Pose {
    // A level axis has no upward direction; then both ways of counting are equally good.
    let z = one.direction * sign(one.direction.z + STRAIGHT);
    let ahead = if z.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
    let x = (ahead - z * ahead.dot(z)).normalize_or_zero();
    Pose {
        rotation: DMat3::from_cols(x, z.cross(x), z),
        position: one.point - z * one.point.dot(z),
    }
}

/// The frame that turns with axis 1, in the foot: x to the front, y along axis 2; and the sign of axis 2.
fn front(two: &JointAxis) -> (DMat3, f64) {
    let y = DVec3::new(two.direction.x, two.direction.y, 0.0).normalize_or_zero();
    let x = y.cross(DVec3::Z);
    let before = two.point.dot(x);
    // An axis 2 that crosses axis 1 lies before it on neither side; then the front is where the foot's x points.
    let side = if before.abs() > NO_LENGTH {
        sign(before)
    } else {
        sign(x.x + STRAIGHT)
    };
    (DMat3::from_cols(x * side, y * side, DVec3::Z), side)
}

/// The roll of the hand at zero, and the sign of axis 5, from the direction of axis 5 in the forearm.
fn roll(five: &DVec3) -> (f64, f64) {
    let side = sign(five.y + STRAIGHT);
    (libm::atan2(-five.x * side, five.y * side), side)
}

/// By how much a flange is turned about the hand's z.
fn spin(flange_in_hand: &DMat3) -> f64 {
    let (x, y) = (flange_in_hand.x_axis, flange_in_hand.y_axis);
    // A flange whose x is not square to the hand's z turns with its y.
    if x.z.abs() < 0.5 {
        libm::atan2(x.y, x.x)
    } else {
        libm::atan2(-y.x, y.y)
    }
}

/// The point between two lines where they are nearest to one another.
fn between(a: &JointAxis, b: &JointAxis) -> DVec3 {
    // Both are square to one another (`is_shaped`), so each is met where the other's direction is left out.
    let apart = b.point - a.point;
    let on_a = a.point + a.direction * apart.dot(a.direction);
    let on_b = b.point - b.direction * apart.dot(b.direction);
    (on_a + on_b) / 2.0
}

/// A vector in the plane of the arm.
#[derive(Clone, Copy)]
struct Flat {
    /// To the front.
    x: f64,
    /// Up.
    z: f64,
}

impl Flat {
    fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.z * other.z
    }

    fn length(self) -> f64 {
        libm::hypot(self.x, self.z)
    }

    /// The angle from upright, positive to the front: that of `Ry`.
    fn lean(self) -> f64 {
        libm::atan2(self.x, self.z)
    }

    /// The x axis of the frame whose z axis it is.
    const fn across(self) -> Self {
        Self {
            x: self.z,
            z: -self.x,
        }
    }
}

/// 1 or -1, 1 for zero.
fn sign(number: f64) -> f64 {
    if number < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests;
