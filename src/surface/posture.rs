//! How a disc stands on a surface: axis, contact and centre.
//!
//! At the contact Q the surface has a normal n and the disc a feed f along the surface. The axis leans along the feed by `lead`
//! and then about the feed by `side` ([Yang fig. 5]: first the forward angle, then the roll angle):
//!
//! ```text
//! b = n x f
//! a = sin(lead) f + cos(lead) sin(side) b + cos(lead) cos(side) n
//! cos T = a.n        T the total tilt
//! e = ((a.n) a - n)/sin T        from the centre to the contact, in the face
//! C = Q - R e
//! ```
//!
//! A positive lead leans the spindle along the feed: the leading half of the rim cuts, and the heel is up, by `2 R sin T`. The
//! contact lies at the azimuth `atan2(cos(lead) sin(side), sin(lead))` from the feed, to its left, so that
//! `sin(lead) = sin T cos(azimuth)`.

use crate::disc::{Axis, Pose};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::vector::{cross, dot};

/// How an axis leans from the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lean {
    /// Along the feed.
    pub lead: Angle,
    /// About the feed, to its left.
    pub side: Angle,
}

impl Lean {
    /// The angle between axis and normal.
    #[must_use]
    pub fn tilt(self) -> Angle {
        // The tangent is precise for small angles too.
        Angle::rad(libm::atan2(self.flat(), self.lead.cos() * self.side.cos()))
    }

    /// The azimuth of the contact from the feed, to its left.
    #[must_use]
    pub fn azimuth(self) -> Angle {
        Angle::rad(libm::atan2(self.lead.cos() * self.side.sin(), self.lead.sin()))
    }

    /// The sine of the tilt.
    fn flat(self) -> f64 {
        libm::hypot(self.lead.sin(), self.lead.cos() * self.side.sin())
    }

    /// The radius at the contact of what the disc sweeps, seen along the feed: 0 of a disc that leans to a side only. None of one that
    /// lies on the tangent plane.
    #[must_use]
    pub fn swept_radius(self, radius: Length) -> Option<Length> {
        // An ellipse of half axes R and R sin(lead), rolled by the side: R cos^2(azimuth)/sin T.
        let (lead, tilt) = (self.lead.sin(), self.flat());
        (tilt > 0.0).then(|| radius * (lead * lead / (tilt * tilt * tilt)))
    }

    /// How far beside its centre, to the left of the feed, a disc touches.
    #[must_use]
    pub fn beside(self, radius: Length) -> Length {
        radius * (self.tilt().cos() * self.azimuth().sin())
    }

    /// How high above the tangent plane the rim stands where it is farthest from the centre, to the left of the feed. With a
    /// side tilt it is lower there than `R sin(lead)`.
    #[must_use]
    pub fn rim(self, radius: Length) -> Length {
        let q = self.lead.cos() * self.side.sin();
        let rest = (1.0 - q * q).max(0.0).sqrt();
        radius * (self.flat() - self.tilt().cos() * q / rest)
    }
}

/// Where a disc touches a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The place.
    pub place: Point3,
    normal: [f64; 3],
    feed: [f64; 3],
}

/// The shortest vector that has a direction.
const LEAST_LENGTH: f64 = 1e-12;

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(vector, vector).sqrt();
    (length > LEAST_LENGTH && length.is_finite()).then(|| vector.map(|part| part / length))
}

impl Contact {
    /// A place with the normal there (of any length, upwards) and the direction of the feed in plan: the disc moves along the
    /// surface in the upright plane of that direction. None without a direction, or if the normal does not point up.
    #[must_use]
    pub fn new(place: Point3, normal: [f64; 3], feed: [f64; 2]) -> Option<Self> {
        let normal = unit(normal).filter(|normal| normal[2] > LEAST_LENGTH)?;
        let plan = unit([feed[0], feed[1], 0.0])?;
        let feed = unit([normal[2] * plan[0], normal[2] * plan[1], -dot(normal, plan)])?;
        Some(Self { place, normal, feed })
    }

    /// The normal, of length 1.
    #[must_use]
    pub const fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// The feed along the surface, of length 1.
    #[must_use]
    pub const fn feed(&self) -> [f64; 3] {
        self.feed
    }

    /// What lies to the left of the feed, along the surface, of length 1.
    #[must_use]
    pub fn left(&self) -> [f64; 3] {
        cross(self.normal, self.feed)
    }

    /// The axis that leans so. None if it does not point up.
    #[must_use]
    pub fn axis(&self, lean: Lean) -> Option<Axis> {
        let ((sl, cl), (ss, cs)) = (libm::sincos(lean.lead.to_rad()), libm::sincos(lean.side.to_rad()));
        let left = self.left();
        Axis::new(core::array::from_fn(|i| {
            sl * self.feed[i] + cl * ss * left[i] + cl * cs * self.normal[i]
        }))
    }

    /// What leads from the centre of a disc to its contact, of length 1 and square to its axis. Along the feed if the face lies on
    /// the tangent plane.
    fn outwards(&self, axis: Axis) -> [f64; 3] {
        let a = axis.to_array();
        let along = dot(a, self.normal);
        unit(core::array::from_fn(|i| along * a[i] - self.normal[i])).unwrap_or(self.feed)
    }

    /// A disc that touches here and leans so. None if its axis does not point up.
    #[must_use]
    pub fn pose(&self, radius: Length, lean: Lean) -> Option<Pose> {
        let axis = self.axis(lean)?;
        let out = self.outwards(axis);
        let from = self.place.to_array();
        let centre: [f64; 3] = core::array::from_fn(|i| from[i] - radius.to_mm() * out[i]);
        Some(Pose {
            centre: centre.into(),
            axis,
        })
    }

    /// The frame of a tool that stands so: z into the part, x from the centre to the contact.
    #[must_use]
    pub fn frame(&self, pose: &Pose) -> Option<Frame> {
        let x = self.outwards(pose.axis);
        let z = pose.axis.to_array().map(|part| -part);
        let orientation = with_axes([x, cross(z, x), z])?;
        Some(Frame {
            origin: pose.centre,
            orientation,
        })
    }
}

/// The frame of a tool in a pose: z into the part, x as near to a direction as that allows. None if that is along the axis.
#[must_use]
pub fn frame_towards(pose: &Pose, direction: [f64; 3]) -> Option<Frame> {
    let z = pose.axis.to_array().map(|part| -part);
    let along = dot(z, direction);
    let x = unit(core::array::from_fn(|i| direction[i] - along * z[i]))?;
    Some(Frame {
        origin: pose.centre,
        orientation: with_axes([x, cross(z, x), z])?,
    })
}

/// The orientation with these axes, of length 1 and square to each other.
fn with_axes([x, y, z]: [[f64; 3]; 3]) -> Option<Orientation> {
    let trace = x[0] + y[1] + z[2];
    // The largest of the four parts of the quaternion is never small (Shepperd: Quaternion from rotation matrix, 1978).
    let largest = [trace, x[0], y[1], z[2]]
        .into_iter()
        .fold(f64::NEG_INFINITY, f64::max);
    let [w, i, j, k] = if largest == trace {
        [1.0 + trace, y[2] - z[1], z[0] - x[2], x[1] - y[0]]
    } else if largest == x[0] {
        [y[2] - z[1], 1.0 + x[0] - y[1] - z[2], x[1] + y[0], z[0] + x[2]]
    } else if largest == y[1] {
        [z[0] - x[2], x[1] + y[0], 1.0 - x[0] + y[1] - z[2], y[2] + z[1]]
    } else {
        [x[1] - y[0], z[0] + x[2], y[2] + z[1], 1.0 - x[0] - y[1] + z[2]]
    };
    Orientation::from_quaternion(w, i, j, k)
}

#[cfg(test)]
mod tests;
