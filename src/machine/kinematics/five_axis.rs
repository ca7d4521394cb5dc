//! Five-axis machines: three linear axes X, Y, Z, two rotary ones, and perhaps a spindle that turns the blade about itself.
//!
//! Rotary axes sit on the head, under the table, or one on each. Only the motion of the blade relative to the work counts,
//! so every arrangement is one product: seen from the work the spindle nose is turned by
//!
//! `R = R(k, phi) R(u, theta) N Rz(s)`
//!
//! where the rotary axis nearer to the work turns about `k` by `phi`, the one nearer to the blade about `u` by `theta`,
//! `N` is the nose at zero and `s` the turn of an orientable spindle. (A table turns the work and not the blade, so its
//! direction enters reversed.) `k` and `u` are square to one another, and `u` is square to the spindle: else the two could
//! not point the blade everywhere, and [`FiveAxis::new`] refuses them.
//!
//! **Without an orientable spindle** `s = 0`, and `R(k, phi) R(u, theta)` has two angles for the three of a rotation. Where
//! it is a rotation of that kind, both angles follow from it in one way; where it is not, the blade can point in the right
//! direction, but its plane stays turned about it by [`FiveAxis::blade_turned`], and the pose is out of reach.
//!
//! **With one** the direction of the blade alone decides: `phi` and `theta` bring the spindle there in two ways, one on each
//! side of the pose in which the spindle points along `k`, and the spindle does the rest. In that pose itself `phi` can have
//! any value and the two ways are one. It is taken from the axis values nearby where there are some, else it is 0.
//!
//! Positions follow from the angles: linear axes carry the nose to where it has to be.

use super::pose::Pose;
use super::{Joints, Solution, Solutions};
use core::f64::consts::{PI, TAU};
use glam::{DMat3, DVec3};
use vcutc_backend_api::motion::Branch;

/// A direction along an axis of the machine frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// `+X`.
    PlusX,
    /// `-X`.
    MinusX,
    /// `+Y`.
    PlusY,
    /// `-Y`.
    MinusY,
    /// `+Z`.
    PlusZ,
    /// `-Z`.
    MinusZ,
}

/// A rotary axis of the head or the table. It turns what it carries right-handed about its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotary {
    pub about: Direction,
    /// A point on the axis, seen from the machine frame with all axes at zero, in mm.
    pub centre: DVec3,
}

/// Where the two rotary axes are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrangement {
    /// Both on the head, from the frame outwards.
    HeadHead([Rotary; 2]),
    /// One on the head, one under the table.
    HeadTable {
        /// The one on the head.
        head: Rotary,
        /// The one under the table.
        table: Rotary,
    },
    /// Both under the table, from the frame to the work.
    TableTable([Rotary; 2]),
}

/// The sense in which an orientable spindle turns the blade, at zero rotary angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleSense {
    /// Right-handed about `+Z` of the machine.
    PlusZ,
    /// Right-handed about `-Z` of the machine, which is the direction out of the spindle.
    MinusZ,
}

/// Why two rotary axes do not make a five-axis machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfit {
    Parallel,
    /// The one nearer to the blade lies along the spindle, so that it does not tilt the blade.
    AlongSpindle,
}

/// Which way a spindle is pointed that can be turned about itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// The way with the small angles: `theta = 0` is on this side, or on the border and positive angles are.
    Usual,
    Other,
}

/// A five-axis machine. Axis values are X, Y, Z (mm), the two rotary axes (rad; those of the head first, then those of the
/// table, each in the order of the [`Arrangement`]), and the spindle's (rad; 0 without an orientable one).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FiveAxis {
    arrangement: Arrangement,
    spindle: Option<SpindleSense>,
    nose: DVec3,
    mount: DVec3,
}

/// How far the nose may be from where an answer should bring it, in mm and as Frobenius norm.
const RESIDUAL: (f64, f64) = (1e-6, 1e-9);
/// Sine of the angle between spindle and first rotary axis below which that axis is taken as free.
const ALONG: f64 = 1e-9;
/// The spindle nose at zero: x along +X, y along -Y, z (out of the spindle) along -Z.
const NOSE: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z);

/// The two rotary axes as the work sees them: directions, and places of their values among the [`Joints`].
#[derive(Clone, Copy, Debug)]
struct Tilting {
    /// The one nearer to the work.
    k: DVec3,
    /// The one nearer to the blade.
    u: DVec3,
    /// Place of the value of `k`.
    phi: usize,
    /// Place of the value of `u`.
    theta: usize,
}

impl Direction {
    /// The unit vector.
    #[must_use]
    pub const fn vector(self) -> DVec3 {
        match self {
            Self::PlusX => DVec3::X,
            Self::MinusX => DVec3::NEG_X,
            Self::PlusY => DVec3::Y,
            Self::MinusY => DVec3::NEG_Y,
            Self::PlusZ => DVec3::Z,
            Self::MinusZ => DVec3::NEG_Z,
        }
    }

    fn rotation(self, angle: f64) -> DMat3 {
        match self {
            Self::PlusX => DMat3::from_rotation_x(angle),
            Self::MinusX => DMat3::from_rotation_x(-angle),
            Self::PlusY => DMat3::from_rotation_y(angle),
            Self::MinusY => DMat3::from_rotation_y(-angle),
            Self::PlusZ => DMat3::from_rotation_z(angle),
            Self::MinusZ => DMat3::from_rotation_z(-angle),
        }
    }
}

impl Rotary {
    /// What it carries, turned by an angle, seen from the same at zero.
    pub fn turned(&self, angle: f64) -> Pose {
        let rotation = self.about.rotation(angle);
        Pose {
            rotation,
            position: self.centre - rotation * self.centre,
        }
    }
}

impl SpindleSense {
    /// The turn about the nose's own z by a value of the spindle axis. That z points along `-Z` at zero.
    const fn about_nose(self, value: f64) -> f64 {
        match self {
            Self::PlusZ => -value,
            Self::MinusZ => value,
        }
    }
}

impl FiveAxis {
    /// A machine. `nose` is the middle of the spindle nose and `mount` the origin of the frame in which work is mounted,
    /// both seen from the machine frame with all axes at zero, in mm; the mount's axes are then those of the machine.
    ///
    /// # Errors
    /// When its rotary axes cannot point the blade everywhere.
    pub fn new(
        arrangement: Arrangement,
        spindle: Option<SpindleSense>,
        nose: DVec3,
        mount: DVec3,
    ) -> Result<Self, Unfit> {
        let machine = Self {
            arrangement,
            spindle,
            nose,
            mount,
        };
        let Tilting { k, u, .. } = machine.tilting();
        if k.cross(u) == DVec3::ZERO {
            Err(Unfit::Parallel)
        } else if u.cross(DVec3::Z) == DVec3::ZERO {
            Err(Unfit::AlongSpindle)
        } else {
            Ok(machine)
        }
    }

    /// Where the rotary axes are.
    #[must_use]
    pub const fn arrangement(&self) -> Arrangement {
        self.arrangement
    }

    /// How an orientable spindle turns, if it has one.
    #[must_use]
    pub const fn spindle(&self) -> Option<SpindleSense> {
        self.spindle
    }

    /// Whether the head reaches all postures of a V-cut without an orientable spindle: its rotary axes compose to
    /// `Ry Rx` between work and blade (`docs/process.md`, "Frames and posture").
    #[must_use]
    pub fn swings_then_rakes(&self) -> bool {
        let Tilting { k, u, .. } = self.tilting();
        k.cross(DVec3::Y) == DVec3::ZERO && u.cross(DVec3::X) == DVec3::ZERO
    }

    /// The spindle nose in the mount's frame.
    #[must_use]
    pub fn forward(&self, joints: &Joints) -> Pose {
        let [x, y, z, ..] = *joints;
        let mut nose_in_frame = self.nose_in_carriage(joints);
        nose_in_frame.position += DVec3::new(x, y, z);
        self.mount_in_frame(joints).inverse() * nose_in_frame
    }

    /// All ways to bring the nose there.
    #[must_use]
    pub fn inverse(&self, nose_in_mount: &Pose) -> Solutions {
        let mut solutions = Solutions::NONE;
        for number in self.branches() {
            let branch = Branch::Numbered(number);
            if let Some(joints) = self.on_branch(nose_in_mount, branch, &Joints::default()) {
                solutions.push(Solution { branch, joints });
            }
        }
        solutions
    }

    /// The way on a branch, each angle within half a turn of `near`. Without an orientable spindle there is one branch,
    /// `Numbered(0)`; with one, 0 is that of the small angles and 1 the other.
    #[must_use]
    pub fn on_branch(&self, nose_in_mount: &Pose, branch: Branch, near: &Joints) -> Option<Joints> {
        let Branch::Numbered(number) = branch else {
            return None;
        };
        let side = match number {
            0 => Side::Usual,
            1 => Side::Other,
            _ => return None,
        };
        let tilting = self.tilting();
        let tilted = nose_in_mount.rotation * NOSE.transpose();
        let mut joints = match (self.spindle, side) {
            (Some(sense), _) => self.pointed(&tilting, nose_in_mount, side, sense, near),
            (None, Side::Usual) => angles_of(&tilting, tilted),
            (None, Side::Other) => return None,
        };
        for (joint, near) in joints.iter_mut().zip(near).skip(3) {
            *joint += TAU * ((near - *joint) / TAU).round();
        }
        let xyz = (self.mount_in_frame(&joints) * *nose_in_mount).position
            - self.nose_in_carriage(&joints).position;
        [joints[0], joints[1], joints[2]] = xyz.to_array();
        let (apart, turned) = self.forward(&joints).apart(nose_in_mount);
        (apart <= RESIDUAL.0 && turned <= RESIDUAL.1).then_some(joints)
    }

    /// By how much (rad) the blade plane stays turned about the blade's axis, the shorter way, when the rotary axes point
    /// the blade where it should. None when the pose is within reach of rotary axes without limits.
    #[must_use]
    pub fn blade_turned(&self, nose_in_mount: &Pose) -> Option<f64> {
        let home = Joints::default();
        if self
            .on_branch(nose_in_mount, Branch::Numbered(0), &home)
            .is_some()
        {
            return None;
        }
        let tilting = self.tilting();
        let turned = [Side::Usual, Side::Other].map(|side| {
            let joints = self.pointed(&tilting, nose_in_mount, side, SpindleSense::MinusZ, &home);
            joints[5]
        });
        let least = turned.into_iter().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        least.is_finite().then_some(least)
    }

    /// How fast the blade turns at most while all rotary axes go evenly from values to others, in rad a motion.
    ///
    /// The axes turn it about `k`, about `u` as `k` has turned it, and about the spindle as both have. `u` is square to both others,
    /// so only the angle between `k` and the spindle counts, which `theta` alone changes; its cosine is greatest and least at the
    /// ends of the motion, or where the spindle passes along `k` or against it most nearly.
    #[must_use]
    pub fn fastest_turn(&self, from: &Joints, to: &Joints) -> f64 {
        let Tilting { k, u, phi, theta } = self.tilting();
        let change = |place: usize| to[place] - from[place];
        let spun = self.spindle.map_or(0.0, |sense| sense.about_nose(change(5)));
        let nose = NOSE.z_axis;
        let (on_cosine, on_sine) = (k.dot(nose), k.dot(u.cross(nose)));
        let along = |theta: f64| on_cosine * libm::cos(theta) + on_sine * libm::sin(theta);
        let (low, high) = (from[theta].min(to[theta]), from[theta].max(to[theta]));
        let nearest = libm::atan2(on_sine, on_cosine);
        let first = ((low - nearest) / PI).ceil();
        let passed = [first, first + 1.0].map(|half_turns| nearest + half_turns * PI);
        let passed = passed.into_iter().filter(|&place| place <= high);
        let squares = change(phi) * change(phi) + change(theta) * change(theta) + spun * spun;
        let fastest = [low, high]
            .into_iter()
            .chain(passed)
            .map(|theta| squares + 2.0 * change(phi) * spun * along(theta))
            .fold(0.0, f64::max);
        fastest.sqrt()
    }

    /// The numbers of the branches.
    fn branches(&self) -> core::ops::Range<u8> {
        match self.spindle {
            Some(SpindleSense::PlusZ | SpindleSense::MinusZ) => 0..2,
            None => 0..1,
        }
    }

    /// What turns the blade, from the frame outwards, each with the place of its value among the [`Joints`].
    pub fn head(&self) -> impl DoubleEndedIterator<Item = (Rotary, usize)> {
        let spindle = self.spindle.map(|sense| {
            let about = match sense {
                SpindleSense::PlusZ => Direction::PlusZ,
                SpindleSense::MinusZ => Direction::MinusZ,
            };
            let centre = self.nose;
            (Rotary { about, centre }, 5)
        });
        let head = match self.arrangement {
            Arrangement::HeadHead([outer, inner]) => [Some((outer, 3)), Some((inner, 4)), spindle],
            Arrangement::HeadTable { head, .. } => [Some((head, 3)), None, spindle],
            Arrangement::TableTable(_) => [None, None, spindle],
        };
        head.into_iter().flatten()
    }

    /// What turns the work, from the frame to the work, each with the place of its value among the [`Joints`].
    pub fn table(&self) -> impl DoubleEndedIterator<Item = (Rotary, usize)> {
        let table = match self.arrangement {
            Arrangement::HeadHead(_) => [None, None],
            Arrangement::HeadTable { table, .. } => [Some((table, 4)), None],
            Arrangement::TableTable([outer, inner]) => [Some((outer, 3)), Some((inner, 4))],
        };
        table.into_iter().flatten()
    }

    /// The nose at zero in the machine frame.
    pub const fn nose_at_zero(&self) -> Pose {
        Pose {
            rotation: NOSE,
            position: self.nose,
        }
    }

    /// The mount at zero in the machine frame.
    pub const fn mount_at_zero(&self) -> Pose {
        Pose {
            rotation: DMat3::IDENTITY,
            position: self.mount,
        }
    }

    /// The nose seen from the carriage of the head, that is from the machine frame with X, Y and Z at zero.
    fn nose_in_carriage(&self, joints: &Joints) -> Pose {
        let turned = self.head().map(|(rotary, place)| rotary.turned(joints[place]));
        turned.fold(Pose::IDENTITY, |outer, inner| outer * inner) * self.nose_at_zero()
    }

    /// The mount seen from the machine frame.
    fn mount_in_frame(&self, joints: &Joints) -> Pose {
        let turned = self.table().map(|(rotary, place)| rotary.turned(joints[place]));
        turned.fold(Pose::IDENTITY, |outer, inner| outer * inner) * self.mount_at_zero()
    }

    fn tilting(&self) -> Tilting {
        match self.arrangement {
            Arrangement::HeadHead([outer, inner]) => Tilting {
                k: outer.about.vector(),
                u: inner.about.vector(),
                phi: 3,
                theta: 4,
            },
            Arrangement::HeadTable { head, table } => Tilting {
                k: -table.about.vector(),
                u: head.about.vector(),
                phi: 4,
                theta: 3,
            },
            Arrangement::TableTable([outer, inner]) => Tilting {
                k: -inner.about.vector(),
                u: -outer.about.vector(),
                phi: 4,
                theta: 3,
            },
        }
    }

    /// Rotary angles that point the spindle as wanted, on one side, and the spindle's own that does the rest. Linear axes
    /// are left at 0.
    fn pointed(
        &self,
        tilting: &Tilting,
        nose_in_mount: &Pose,
        side: Side,
        sense: SpindleSense,
        near: &Joints,
    ) -> Joints {
        let &Tilting { k, u, phi, theta } = tilting;
        let wanted = nose_in_mount.rotation.z_axis;
        let at_zero = NOSE.z_axis;
        // The spindle turns about u in the plane of k and m; k is at the angle beta from where it points at zero.
        // (Adding 0 makes a positive zero of a negative one, which atan2 would take for just below half a turn.)
        let beta = libm::atan2(k.dot(u.cross(at_zero)) + 0.0, k.dot(at_zero));
        let toward = match side {
            Side::Usual => usual_sense(beta),
            Side::Other => -usual_sense(beta),
        };
        let off_k = wanted - k * wanted.dot(k);
        let mut joints = Joints::default();
        joints[theta] = beta + toward * libm::atan2(off_k.length(), wanted.dot(k));
        let pointed = rotation_about(u, joints[theta]) * at_zero;
        joints[phi] = if off_k.length() < ALONG {
            near[phi]
        } else {
            let off_k_before = pointed - k * pointed.dot(k);
            libm::atan2(k.dot(off_k_before.cross(off_k)), off_k_before.dot(off_k))
        };
        let reached = rotation_about(k, joints[phi]) * rotation_about(u, joints[theta]) * NOSE;
        let rest = reached.transpose() * nose_in_mount.rotation;
        joints[5] = sense.about_nose(libm::atan2(rest.x_axis.y, rest.x_axis.x));
        joints
    }
}

/// The sense of turning about `u`, away from `k`, that makes the usual side. `beta` is 0 or half a turn where `k` lies along
/// the spindle at zero: then positive angles are usual. Else it is a quarter, and the way back to zero is.
fn usual_sense(beta: f64) -> f64 {
    if beta == 0.0 { 1.0 } else { -beta.signum() }
}

/// `phi` and `theta` of a rotation `R(k, phi) R(u, theta)`: it takes `u` to where `R(k, phi)` takes it, and its inverse takes
/// `k` to where `R(u, -theta)` does.
fn angles_of(tilting: &Tilting, tilted: DMat3) -> Joints {
    let &Tilting { k, u, phi, theta } = tilting;
    let mut joints = Joints::default();
    let u_after = tilted * u;
    joints[phi] = libm::atan2(k.dot(u.cross(u_after)), u.dot(u_after));
    let k_before = tilted.transpose() * k;
    joints[theta] = libm::atan2(u.dot(k_before.cross(k)), k_before.dot(k));
    joints
}

fn rotation_about(unit: DVec3, angle: f64) -> DMat3 {
    DMat3::from_axis_angle(unit, angle)
}

#[cfg(test)]
mod tests;
