//! Points, orientations and frames.

use crate::units::{Angle, Length};
use serde::{Deserialize, Serialize};

/// A point in a named frame; millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Point3 {
    /// Along x, in mm.
    pub x: f64,
    /// Along y, in mm.
    pub y: f64,
    /// Along z, in mm.
    pub z: f64,
}

impl Point3 {
    /// The point (x, y, z), in mm.
    #[must_use]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// Its coordinates, in mm.
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Straight distance to another point.
    #[must_use]
    pub fn distance(self, other: Self) -> Length {
        let (dx, dy, dz) = (other.x - self.x, other.y - self.y, other.z - self.z);
        Length::mm((dx * dx + dy * dy + dz * dz).sqrt())
    }

    /// Whether all three coordinates are numbers.
    #[must_use]
    pub const fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl From<[f64; 3]> for Point3 {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

/// A rotation, held as a unit quaternion.
///
/// Of the two quaternions of a rotation it is the one in which the first of `w, x, y, z` that is not nearly zero (beyond
/// 1e-12) is positive, so that equal rotations are equal values up to rounding.
///
/// As a matrix `R` its columns are the axes of the inner frame seen from the outer one:
/// `v_outer = R v_inner`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "QuaternionParts", into = "QuaternionParts")]
pub struct Orientation {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

/// The exchange form of an [`Orientation`]: a unit quaternion, scalar part first.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct QuaternionParts {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

impl From<Orientation> for QuaternionParts {
    fn from(o: Orientation) -> Self {
        Self {
            w: o.w,
            x: o.x,
            y: o.y,
            z: o.z,
        }
    }
}

/// How far the length of a quaternion that was normalised is from 1 at most, by rounding.
const UNIT: f64 = 4.0 * f64::EPSILON;

impl TryFrom<QuaternionParts> for Orientation {
    type Error = &'static str;
    fn try_from(q: QuaternionParts) -> Result<Self, Self::Error> {
        let norm = (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z).sqrt();
        if (norm - 1.0).abs() >= 1e-6 {
            return Err("an orientation is a unit quaternion");
        }
        let read = Self::from_quaternion(q.w, q.x, q.y, q.z).ok_or("not a rotation")?;
        // What was normalised before comes back to the last bit; only its sign is chosen.
        let is_of_its_sign = read.w * q.w + read.x * q.x + read.y * q.y + read.z * q.z > 0.0;
        let is_normalised = (norm - 1.0).abs() <= UNIT;
        Ok(if is_normalised && is_of_its_sign {
            let QuaternionParts { w, x, y, z } = q;
            Self { w, x, y, z }
        } else {
            read
        })
    }
}

/// Angles A, B, C of `R = Rz(A) Ry(B) Rx(C)`, as KUKA controllers and the language's `frame(...)` use them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zyx {
    /// About z.
    pub a: Angle,
    /// About the turned y.
    pub b: Angle,
    /// About the twice turned x.
    pub c: Angle,
}

impl Orientation {
    /// No rotation.
    pub const IDENTITY: Self = Self {
        w: 1.0,
        x: 0.0,
        y: 0.0,
        z: 0.0,
    };

    /// From a quaternion of any length; none when the length is zero or not a number.
    #[must_use]
    pub fn from_quaternion(w: f64, x: f64, y: f64, z: f64) -> Option<Self> {
        let norm = (w * w + x * x + y * y + z * z).sqrt();
        if !norm.is_finite() || norm < 1e-12 {
            return None;
        }
        // Of the two quaternions of a rotation take the one whose first non-zero part is positive.
        let leading = [w, x, y, z]
            .into_iter()
            .find(|part| part.abs() > 1e-12)
            .unwrap_or(1.0);
        let scale = leading.signum() / norm;
        Some(Self {
            w: w * scale,
            x: x * scale,
            y: y * scale,
            z: z * scale,
        })
    }

    /// `Rz(A) Ry(B) Rx(C)`.
    #[must_use]
    pub fn from_zyx(angles: Zyx) -> Self {
        let (sa, ca) = libm::sincos(angles.a.to_rad() / 2.0);
        let (sb, cb) = libm::sincos(angles.b.to_rad() / 2.0);
        let (sc, cc) = libm::sincos(angles.c.to_rad() / 2.0);
        Self::from_quaternion(
            ca * cb * cc + sa * sb * sc,
            ca * cb * sc - sa * sb * cc,
            ca * sb * cc + sa * cb * sc,
            sa * cb * cc - ca * sb * sc,
        )
        .unwrap_or(Self::IDENTITY)
    }

    /// A, B, C with A and C from -180 to 180 degrees and B from -90 to 90. Half a turn comes out with either sign, by the
    /// last bits of the quaternion. Where B is +-90 only a sum or difference of A and C is defined; C is then 0.
    #[must_use]
    pub fn to_zyx(self) -> Zyx {
        let m = self.matrix();
        let horizontal = libm::hypot(m[0][0], m[1][0]);
        let b = libm::atan2(-m[2][0], horizontal);
        let (a, c) = if horizontal < 1e-9 {
            (libm::atan2(-m[0][1], m[1][1]), 0.0)
        } else {
            (libm::atan2(m[1][0], m[0][0]), libm::atan2(m[2][1], m[2][2]))
        };
        Zyx {
            a: Angle::rad(a),
            b: Angle::rad(b),
            c: Angle::rad(c),
        }
    }

    /// Rows of the rotation matrix: `matrix()[row][column]`, columns are the inner axes in the outer frame.
    #[must_use]
    pub fn matrix(self) -> [[f64; 3]; 3] {
        let Self { w, x, y, z } = self;
        [
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ]
    }

    /// The parts `[w, x, y, z]` of the unit quaternion; the first that is not nearly zero is positive.
    #[must_use]
    pub const fn quaternion(self) -> [f64; 4] {
        [self.w, self.x, self.y, self.z]
    }

    /// The orientation on the shortest way to `other` when so much of it is done, from 0 to 1: turned about one fixed axis.
    #[must_use]
    pub fn towards(self, other: Self, done: f64) -> Self {
        let [a, b] = [self, other].map(Self::quaternion);
        let along: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
        // The nearer of the two quaternions of the rotation.
        let b = b.map(|part| if along < 0.0 { -part } else { part });
        let half = self.angle_to(other).to_rad() / 2.0;
        let (to_go, gone) = match libm::sin(half) {
            sine if sine > 1e-12 => (
                libm::sin(half * (1.0 - done)) / sine,
                libm::sin(half * done) / sine,
            ),
            _ => (1.0 - done, done),
        };
        let [w, x, y, z] = core::array::from_fn(|part| a[part] * to_go + b[part] * gone);
        Self::from_quaternion(w, x, y, z).unwrap_or(self)
    }

    /// The angle of the one rotation that leads from `self` to `other`; 0 to 180 degrees.
    #[must_use]
    pub fn angle_to(self, other: Self) -> Angle {
        // 2 atan2(|sin|, |cos|) of the half angle: precise for small angles too, where acos is not.
        let (dw, dx, dy, dz) = (
            self.w - other.w,
            self.x - other.x,
            self.y - other.y,
            self.z - other.z,
        );
        let (sw, sx, sy, sz) = (
            self.w + other.w,
            self.x + other.x,
            self.y + other.y,
            self.z + other.z,
        );
        let apart = (dw * dw + dx * dx + dy * dy + dz * dz).sqrt();
        let along = (sw * sw + sx * sx + sy * sy + sz * sz).sqrt();
        Angle::rad(4.0 * libm::atan2(apart.min(along), apart.max(along)))
    }
}

impl Orientation {
    /// The rotation that leads from `self` to `other` as a vector in the outer frame: about its direction, by its length in
    /// rad, from 0 to a half turn.
    #[must_use]
    pub fn rotation_to(self, other: Self) -> [f64; 3] {
        // other * self^-1
        let [a, b] = [other.quaternion(), self.quaternion()];
        let (v, u) = ([a[1], a[2], a[3]], [-b[1], -b[2], -b[3]]);
        let scalar = a[0] * b[0] - (v[0] * u[0] + v[1] * u[1] + v[2] * u[2]);
        let cross = [
            v[1] * u[2] - v[2] * u[1],
            v[2] * u[0] - v[0] * u[2],
            v[0] * u[1] - v[1] * u[0],
        ];
        let sign = if scalar < 0.0 { -1.0 } else { 1.0 };
        let vector: [f64; 3] = core::array::from_fn(|i| sign * (a[0] * u[i] + b[0] * v[i] + cross[i]));
        let sine = (vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]).sqrt();
        if sine < 1e-14 {
            return [0.0; 3];
        }
        let angle = 2.0 * libm::atan2(sine, scalar.abs());
        vector.map(|part| part * angle / sine)
    }
}

/// A frame: where its origin lies and how it is turned, both seen from the frame it is given in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Frame {
    /// Origin, in mm.
    pub origin: Point3,
    /// Axes.
    pub orientation: Orientation,
}
