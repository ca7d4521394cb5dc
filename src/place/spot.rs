//! A place for the base, on the lattice that is searched: what is found is what people paste.

use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::units::Angle;
use vcutc_machine::kinematics::pose::Pose;

/// A place for the base: its origin in whole millimetres in the machine's root, and by how many tenths of a degree the work
/// is turned about the root's z against how it stands now.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Spot {
    /// Along the root's x, in mm.
    pub x: i32,
    /// Along the root's y, in mm.
    pub y: i32,
    /// Along the root's z, in mm.
    pub z: i32,
    /// Turn about z, in tenths of a degree.
    pub yaw: i32,
}

impl Spot {
    /// The place of a base that is not turned, to the next whole millimetre.
    #[must_use]
    pub fn near(base: &Frame) -> Self {
        let whole = |value: f64| value.round() as i32;
        Self {
            x: whole(base.origin.x),
            y: whole(base.origin.y),
            z: whole(base.origin.z),
            yaw: 0,
        }
    }

    /// The work in the root when the base stands here instead of at `base`.
    #[must_use]
    pub fn work_in_root(self, base: &Frame) -> Pose {
        let yaw = glam::DMat3::from_rotation_z(self.turn().to_rad());
        Pose {
            rotation: yaw * Pose::from(*base).rotation,
            position: glam::DVec3::new(f64::from(self.x), f64::from(self.y), f64::from(self.z)),
        }
    }

    /// The base frame that stands here instead of at `base`, as people write it: A grows by the turn, B and C stay.
    #[must_use]
    pub fn frame(self, base: &Frame) -> Frame {
        let now = base.orientation.to_zyx();
        Frame {
            origin: Point3::new(f64::from(self.x), f64::from(self.y), f64::from(self.z)),
            orientation: Orientation::from_zyx(Zyx {
                a: now.a + self.turn(),
                ..now
            }),
        }
    }

    /// The turn about z.
    #[must_use]
    pub fn turn(self) -> Angle {
        Angle::deg(f64::from(self.yaw) / 10.0)
    }

    /// x, y, z and turn, in mm and tenths of a degree.
    #[must_use]
    pub const fn parts(self) -> [i32; 4] {
        [self.x, self.y, self.z, self.yaw]
    }

    /// The spot with this x, y, z and turn, in mm and tenths of a degree.
    #[must_use]
    pub const fn from_parts([x, y, z, yaw]: [i32; 4]) -> Self {
        Self { x, y, z, yaw }
    }
}
