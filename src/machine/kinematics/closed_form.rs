//! The closed form of [`super::opw`]: from a pose to the joints of one branch, and back.
//!
//! Three stages follow the arm: axis 1 turns the arm's plane to the wrist centre, axes 2 and 3 are a triangle in that plane,
//! axes 4, 5 and 6 turn the hand. All of it works on sines and cosines; angles are made at the end, by `atan2`, since `acos`
//! loses half of the digits where an arm is nearly stretched. Each stage is free of branches, so that [`super::batch`] can
//! run it on lanes (see [`super::trig`]), and each choice between two solutions is a factor of 1 or -1.
//!
//! Nothing here asks whether a pose can be reached. Where a root would have to be drawn of less than nothing it is zero, the
//! arm then points to the pose as well as it can, and the check of the finished angles by forward kinematics, which every
//! answer has to pass, rejects it. NaN fails that check too, so no answer contains one.
//!
//! The check takes from the stages nothing but the angles.

use super::Joints;
use super::dimensions::{Coupling, Opw};
use super::pose::Pose;
use super::trig::{Turn, WIDEST, wrapped};
use core::f64::consts::PI;
use glam::{DMat3, DVec3};

/// How far the flange may be from where an answer should bring it, in mm and as Frobenius norm.
const RESIDUAL: (f64, f64) = (1e-6, 1e-9);

/// Nearer to axis 1 than this, in mm, a wrist centre has no direction from it: that would be rounding.
const ON_AXIS: f64 = 1e-12;

/// Sine of axis 5 up to which the directions of axes 4 and 6 are the same but for rounding.
const IN_LINE: f64 = 1e-13;

/// An arm with what the closed form needs of its lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm {
    a1: f64,
    a2: f64,
    b: f64,
    c1: f64,
    c2: f64,
    c3: f64,
    c4: f64,
    offsets: Joints,
    signs: Joints,
    /// 1 where J3 counts from J2, 0 where it does not.
    coupled: f64,
    /// From axis 3 to the wrist centre.
    fore: f64,
    /// The angle at axis 3 from axis 4 to that line.
    tilt: Turn,
    /// Square of the wrist centre's distance from axis 2, stretched and folded.
    stretched: f64,
    folded: f64,
    /// `1 / (2 c2 fore)`.
    per_triangle: f64,
}

/// A branch in factors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    /// 1 in front, -1 behind.
    pub(super) shoulder: f64,
    /// 1 folded forward, -1 backward.
    pub(super) elbow: f64,
    /// 1 where J5 is positive, -1 where it is negative.
    pub(super) wrist: f64,
}

/// Where axes 1 and 4 are in singular poses, which leave them free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    /// Model angle of axis 1.
    pub(super) base: Turn,
    /// Model angle of axis 4.
    pub(super) hand: Turn,
}

impl Rest {
    /// Model angles of zero.
    pub(super) const ZERO: Self = Self {
        base: Turn::NONE,
        hand: Turn::NONE,
    };
}

/// A wrist centre seen from axis 2 in the plane of the arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Base {
    /// Axis 1.
    pub(super) turn: Turn,
    pub(super) along: f64,
    pub(super) up: f64,
    /// Whether axis 1 is free.
    pub(super) is_free: bool,
}

/// The triangle of upper arm and forearm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Axis 2.
    pub(super) upper: Turn,
    /// Axis 3.
    pub(super) elbow: Turn,
    /// Both: from upright to the forearm's axis 4.
    pub(super) fore: Turn,
}

/// The hand of the branch on which the model angle of axis 5 is positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hand {
    /// Axes 4, 5 and 6.
    pub(super) turns: [Turn; 3],
    /// Whether axis 4 is free.
    pub(super) is_free: bool,
}

/// The model angles of the six axes as sines and cosines, that of axis 5 positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    pub(super) turns: [Turn; 6],
    /// Whether the pose leaves axis 1 free.
    pub(super) is_base_free: bool,
    /// Whether the pose leaves axis 4 free.
    pub(super) is_hand_free: bool,
}

/// The model angles of axis 1, axis 2, axes 2 and 3 together, and axes 4, 5 and 6: what forward kinematics needs the sines
/// and cosines of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inclinations(pub(super) [f64; 6]);

impl Arm {
    #[inline(always)]
    pub(super) fn new(arm: &Opw) -> Self {
        let fore = (arm.a2 * arm.a2 + arm.c3 * arm.c3).sqrt();
        let (longest, shortest) = (arm.c2 + fore, arm.c2 - fore);
        Self {
            a1: arm.a1,
            a2: arm.a2,
            b: arm.b,
            c1: arm.c1,
            c2: arm.c2,
            c3: arm.c3,
            c4: arm.c4,
            offsets: arm.offsets,
            signs: arm.signs,
            coupled: match arm.coupling {
                Coupling::Serial => 0.0,
                Coupling::Parallelogram => 1.0,
            },
            fore,
            tilt: Turn {
                sin: arm.a2 / fore,
                cos: arm.c3 / fore,
            },
            stretched: longest * longest,
            folded: shortest * shortest,
            per_triangle: 0.5 / (arm.c2 * fore),
        }
    }

    /// Where the axes point on a branch.
    #[inline(always)]
    pub(super) fn aim(&self, flange_in_root: &Pose, sides: Sides, rest: Rest) -> Aim {
        let base = self.base(flange_in_root, sides.shoulder, rest.base);
        let triangle = self.triangle(&base, sides.elbow);
        let hand = hand(&flange_in_root.rotation, base.turn, triangle.fore, rest.hand);
        let [q4, q5, q6] = hand.turns;
        Aim {
            turns: [base.turn, triangle.upper, triangle.elbow, q4, q5, q6],
            is_base_free: base.is_free,
            is_hand_free: hand.is_free,
        }
    }

    /// The joints for the model angles of an aim, within half a turn.
    #[inline(always)]
    pub(super) fn joints(&self, model: [f64; 6], is_hand_free: bool, side: f64) -> Joints {
        let [q1, q2, q3, q4, q5, q6] = model;
        let j1 = self.base_joint(q1);
        let [j2, j3] = self.triangle_joints([q2, q3]);
        let [j4, j5, j6] = self.hand_joints([q4, q5, q6], is_hand_free, side);
        [j1, j2, j3, j4, j5, j6]
    }

    /// Turns the arm's plane to the wrist centre. In the frame that turns with axis 1 that lies at `(x, b)`.
    #[inline(always)]
    pub(super) fn base(&self, flange_in_root: &Pose, side: f64, rest: Turn) -> Base {
        let centre = flange_in_root.position - flange_in_root.rotation.z_axis * self.c4;
        let distance = centre.x * centre.x + centre.y * centre.y;
        let x = side * root(distance - self.b * self.b);
        let is_free = distance < ON_AXIS * ON_AXIS;
        let turn = Turn {
            sin: (centre.y * x - centre.x * self.b) / distance,
            cos: (centre.x * x + centre.y * self.b) / distance,
        };
        Base {
            turn: either(is_free, rest, turn),
            along: x - self.a1,
            up: centre.z - self.c1,
            is_free,
        }
    }

    /// The triangle of axis 2, axis 3 and the wrist centre, with `psi` the angle between the upper arm, prolonged, and the
    /// line from axis 3 to the wrist centre. The sine is found as in Heron's formula, from the distances to stretched and
    /// folded: there the cosine is blind.
    #[inline(always)]
    pub(super) fn triangle(&self, base: &Base, side: f64) -> Triangle {
        let (along, up) = (base.along, base.up);
        let distance = along * along + up * up;
        let doubled = root((self.stretched - distance) * (distance - self.folded));
        let psi = Turn {
            sin: side * doubled * self.per_triangle,
            cos: clamped((distance - self.c2 * self.c2 - self.fore * self.fore) * self.per_triangle),
        };
        // The wrist centre seen from axis 2, along the upper arm and square to it.
        let (far, aside) = (self.c2 + self.fore * psi.cos, self.fore * psi.sin);
        let is_folded_up = distance < ON_AXIS * ON_AXIS;
        let upper = either(
            is_folded_up,
            Turn::NONE,
            Turn {
                sin: (along * far - up * aside) / distance,
                cos: (up * far + along * aside) / distance,
            },
        );
        let elbow = psi + self.tilt.back();
        Triangle {
            upper,
            elbow,
            fore: upper + elbow,
        }
    }

    /// Joint 1 for its model angle, within half a turn.
    #[inline(always)]
    pub(super) fn base_joint(&self, q1: f64) -> f64 {
        wrapped(self.joint(0, q1))
    }

    /// Joints 2 and 3 for their model angles, within half a turn.
    #[inline(always)]
    pub(super) fn triangle_joints(&self, [q2, q3]: [f64; 2]) -> [f64; 2] {
        let j2 = wrapped(self.joint(1, q2));
        let j3 = wrapped(self.joint(2, q3) + self.coupled * j2);
        [j2, j3]
    }

    /// The last three joints for their model angles, within half a turn. The other side of the wrist is reached by half a
    /// turn of axes 4 and 6; where axis 4 is free, both sides are the same.
    #[inline(always)]
    pub(super) fn hand_joints(&self, [q4, q5, q6]: [f64; 3], is_free: bool, side: f64) -> [f64; 3] {
        let is_turned = (side * self.signs[4] < 0.0) & !is_free;
        let half = if is_turned { PI } else { 0.0 };
        let q5 = if is_turned { -q5 } else { q5 };
        [
            wrapped(self.joint(3, q4 - half.copysign(q4))),
            wrapped(self.joint(4, q5)),
            wrapped(self.joint(5, q6 - half.copysign(q6))),
        ]
    }

    /// The controller's angle for a model angle, coupling apart.
    #[inline(always)]
    fn joint(&self, axis: usize, model: f64) -> f64 {
        (model + self.offsets[axis]) * self.signs[axis]
    }

    /// The model angle for a joint's angle, coupling apart.
    #[inline(always)]
    fn model(&self, axis: usize, joint: f64) -> f64 {
        self.signs[axis] * joint - self.offsets[axis]
    }

    /// What forward kinematics needs of joint 1.
    #[inline(always)]
    pub(super) fn base_inclination(&self, j1: f64) -> f64 {
        self.model(0, j1)
    }

    /// What forward kinematics needs of joints 2 and 3.
    #[inline(always)]
    pub(super) fn triangle_inclinations(&self, [j2, j3]: [f64; 2]) -> [f64; 2] {
        let q2 = self.model(1, j2);
        [q2, q2 + self.model(2, j3 - self.coupled * j2)]
    }

    /// What forward kinematics needs of joints 4, 5 and 6.
    #[inline(always)]
    pub(super) fn hand_inclinations(&self, [j4, j5, j6]: [f64; 3]) -> [f64; 3] {
        [self.model(3, j4), self.model(4, j5), self.model(5, j6)]
    }

    /// What forward kinematics needs of all joints.
    #[inline(always)]
    pub(super) fn inclinations(&self, joints: &Joints) -> Inclinations {
        let [j1, j2, j3, j4, j5, j6] = *joints;
        let [upper, fore] = self.triangle_inclinations([j2, j3]);
        let [q4, q5, q6] = self.hand_inclinations([j4, j5, j6]);
        Inclinations([self.base_inclination(j1), upper, fore, q4, q5, q6])
    }

    /// Forward kinematics.
    #[inline(always)]
    pub(super) fn flange(&self, [base, upper, fore, q4, q5, q6]: [Turn; 6]) -> Pose {
        let [x, y, z] = forearm(base, fore);
        let along = self.a1 + self.c2 * upper.sin + self.a2 * fore.cos + self.c3 * fore.sin;
        let up = self.c1 + self.c2 * upper.cos - self.a2 * fore.sin + self.c3 * fore.cos;
        let centre = DVec3::new(
            base.cos * along - base.sin * self.b,
            base.sin * along + base.cos * self.b,
            up,
        );
        let (outward, sideways) = (x * q4.cos + y * q4.sin, y * q4.cos - x * q4.sin);
        let (down, out) = (outward * q5.cos - z * q5.sin, outward * q5.sin + z * q5.cos);
        Pose {
            rotation: DMat3::from_cols(
                down * q6.cos + sideways * q6.sin,
                sideways * q6.cos - down * q6.sin,
                out,
            ),
            position: centre + out * self.c4,
        }
    }

    /// Whether joints bring the flange there.
    #[inline(always)]
    pub(super) fn reaches(&self, joints: &Joints, flange_in_root: &Pose) -> bool {
        let inclinations = self.inclinations(joints);
        inclinations.are_exact() & is_same(&self.flange(each(inclinations.0, Turn::of)), flange_in_root)
    }
}

impl Inclinations {
    /// Whether [`Turn::of`] may be asked for them.
    #[inline(always)]
    pub(super) fn are_exact(&self) -> bool {
        let [q1, q2, q23, q4, q5, q6] = each(self.0, is_exact);
        q1 & q2 & q23 & q4 & q5 & q6
    }
}

/// Whether [`Turn::of`] may be asked for an angle.
#[inline(always)]
pub(super) fn is_exact(angle: f64) -> bool {
    angle.abs() <= WIDEST
}

/// Turns the hand. In singular poses, and near to them, axes 4 and 6 are ill-defined, but not what they do together: so axis
/// 6 is found from the axis 4 that was chosen, however bad that is.
#[inline(always)]
pub(super) fn hand(rotation: &DMat3, base: Turn, fore: Turn, rest: Turn) -> Hand {
    let [x, y, z] = forearm(base, fore);
    let out = rotation.z_axis;
    let (forward, aside) = (x.dot(out), y.dot(out));
    let bent = (forward * forward + aside * aside).sqrt();
    let is_free = bent < IN_LINE;
    let q4 = either(
        is_free,
        rest,
        Turn {
            sin: aside / bent,
            cos: forward / bent,
        },
    );
    let q5 = Turn {
        sin: forward * q4.cos + aside * q4.sin,
        cos: z.dot(out),
    };
    let sideways = y * q4.cos - x * q4.sin;
    let q6 = Turn {
        sin: sideways.dot(rotation.x_axis),
        cos: sideways.dot(rotation.y_axis),
    };
    Hand {
        turns: [q4, q5, q6],
        is_free,
    }
}

/// The axes of the forearm in the root: to the front, aside, and along axis 4.
#[inline(always)]
fn forearm(base: Turn, fore: Turn) -> [DVec3; 3] {
    [
        DVec3::new(base.cos * fore.cos, base.sin * fore.cos, -fore.sin),
        DVec3::new(-base.sin, base.cos, 0.0),
        DVec3::new(base.cos * fore.sin, base.sin * fore.sin, fore.cos),
    ]
}

/// Whether two poses are the same but for rounding.
#[inline(always)]
pub(super) fn is_same(one: &Pose, other: &Pose) -> bool {
    let apart = (one.position - other.position).length_squared();
    let turned = one.rotation - other.rotation;
    let turned =
        turned.x_axis.length_squared() + turned.y_axis.length_squared() + turned.z_axis.length_squared();
    (apart <= RESIDUAL.0 * RESIDUAL.0) & (turned <= RESIDUAL.1 * RESIDUAL.1)
}

/// A function of each axis, written out: loops within the loop over lanes would keep it from becoming vector instructions.
#[inline(always)]
pub(super) fn each<T: Copy, U>([a, b, c, d, e, f]: [T; 6], of: impl Fn(T) -> U) -> [U; 6] {
    [of(a), of(b), of(c), of(d), of(e), of(f)]
}

/// The square root, or zero of what has none.
#[inline(always)]
fn root(square: f64) -> f64 {
    let square = if square > 0.0 { square } else { 0.0 };
    square.sqrt()
}

#[inline(always)]
fn clamped(cosine: f64) -> f64 {
    let cosine = if cosine > 1.0 { 1.0 } else { cosine };
    if cosine < -1.0 { -1.0 } else { cosine }
}

/// A selection without a branch.
#[inline(always)]
fn either(first: bool, one: Turn, other: Turn) -> Turn {
    Turn {
        sin: if first { one.sin } else { other.sin },
        cos: if first { one.cos } else { other.cos },
    }
}
