//! The joints of an arm, one after the other, and how they move a point that the last one carries.
//!
//! Each joint has a frame whose origin lies on its axis, and whose axes are those of the root when all joints are at zero: so every
//! joint is a turn about a constant axis. What the last joint carries is seen from its frame, the frame of the hand.

use crate::turn::{Axis, Turn};
use crate::vector::{Number, Vector, cross_plain, dot_plain, sum};
use glam::DVec3;
use vcutc_geometry::number::{Along, Interval};
use vcutc_machine::body::MILLIMETRES;
use vcutc_machine::kinematics::linkage::Linkage;
use vcutc_machine::kinematics::opw::Coupling;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// How many joints an arm has.
pub const JOINTS: usize = 6;

/// The joints of an arm, at the controller's axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    pub(crate) hinges: [Hinge; JOINTS],
    /// The origins with all joints at zero, in the root, in m.
    pub(crate) origins: [DVec3; JOINTS],
    /// The flange in the root with all joints at zero.
    pub(crate) flange_at_zero: Pose,
    /// What the third axis counts.
    coupling: Coupling,
}

/// A joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hinge {
    pub(crate) axis: Axis,
    /// Its origin seen from the one before, in m.
    pub(crate) offset: Vector<f64>,
}

/// How an axis moves a point of the hand: seen from the hand, for each rad/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column<N> {
    /// How fast the point goes, in m/s.
    way: Vector<N>,
    /// How fast the hand turns, in rad/s.
    turn: Vector<N>,
}

impl<N: Number> Column<N> {
    /// The torque about the axis of a force on the point, in N, and of a moment, in Nm; also how fast the point goes along a
    /// direction while the hand turns along another.
    #[inline(always)]
    pub(crate) fn of(&self, force: Vector<f64>, moment: Vector<f64>) -> N {
        self.of_force(force) + self.of_moment(moment)
    }

    #[inline(always)]
    pub(crate) fn of_force(&self, force: Vector<f64>) -> N {
        dot_plain(self.way, force)
    }

    #[inline(always)]
    pub(crate) fn of_moment(&self, moment: Vector<f64>) -> N {
        dot_plain(self.turn, moment)
    }
}

impl Chain {
    /// None for a machine that is not an arm.
    pub(crate) fn of(mechanism: &Mechanism) -> Option<Self> {
        let linkage = match mechanism {
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
                Linkage::from(mechanism)
            }
            Mechanism::FiveAxis(_) => return None,
        };
        let joints: [_; JOINTS] = linkage.tool.as_slice().try_into().ok()?;
        let mut before = DVec3::ZERO;
        let hinges = joints.map(|joint| {
            let origin = joint.line.point / MILLIMETRES;
            let offset = (origin - before).to_array();
            before = origin;
            Hinge {
                axis: Axis::new(joint.line.direction),
                offset,
            }
        });
        Some(Self {
            hinges,
            origins: joints.map(|joint| joint.line.point / MILLIMETRES),
            flange_at_zero: linkage.flange_at_zero,
            coupling: mechanism
                .ortho_parallel()
                .map_or(Coupling::Serial, |arm| arm.coupling),
        })
    }

    /// By how much each joint has turned at these axis values.
    pub(crate) fn turns(&self, axes: &Joints) -> [Turn<f64>; JOINTS] {
        self.of_joints(*axes).map(Turn::by)
    }

    /// The same along a part of a motion.
    pub(crate) fn turns_along(&self, axes: [Along; JOINTS]) -> [Turn<Along>; JOINTS] {
        self.of_joints(axes).map(Turn::along)
    }

    /// A pose of the flange's as one of the hand's, its place in m.
    pub(crate) fn in_hand(&self, in_flange: Pose) -> Pose {
        let [.., last] = self.origins;
        let at_zero = self.flange_at_zero * in_flange;
        Pose {
            rotation: at_zero.rotation,
            position: at_zero.position / MILLIMETRES - last,
        }
    }

    /// How the controller's axes move a point of the hand, in m.
    pub(crate) fn columns<N: Number>(
        &self,
        turns: &[Turn<N>; JOINTS],
        point: Vector<f64>,
    ) -> [Column<N>; JOINTS] {
        let zero = [N::zero(); 3];
        let mut columns = [Column {
            way: zero,
            turn: zero,
        }; JOINTS];
        for (place, (hinge, turn)) in self.hinges.iter().zip(turns).enumerate() {
            for column in columns.iter_mut().take(place.saturating_sub(1)) {
                let way = sum(column.way, cross_plain(column.turn, hinge.offset));
                column.way = turn.back(hinge.axis, way);
                column.turn = turn.back(hinge.axis, column.turn);
            }
            // The axis before is constant there, which takes less work.
            if let Some(last) = place.checked_sub(1) {
                let axis = self.hinges[last].axis.direction;
                columns[last] = Column {
                    way: turn.back_plain(hinge.axis, cross_plain(axis, hinge.offset)),
                    turn: turn.back_plain(hinge.axis, axis),
                };
            }
        }
        columns[JOINTS - 1].turn = self.hinges[JOINTS - 1].axis.direction.map(N::plain);
        let at_point = columns.map(|column| Column {
            way: sum(column.way, cross_plain(column.turn, point)),
            turn: column.turn,
        });
        self.at_axes(at_point)
    }

    pub(crate) fn of_joints<N: Number>(&self, axes: [N; JOINTS]) -> [N; JOINTS] {
        match self.coupling {
            Coupling::Serial => axes,
            Coupling::Parallelogram => {
                let [a, b, c, d, e, f] = axes;
                [a, b, c - b, d, e, f]
            }
        }
    }

    /// Torques of joints as those of axes, by virtual work; and likewise columns.
    pub(crate) fn at_axes<T: Copy + core::ops::Sub<Output = T>>(&self, joints: [T; JOINTS]) -> [T; JOINTS] {
        match self.coupling {
            Coupling::Serial => joints,
            Coupling::Parallelogram => {
                let [a, b, c, d, e, f] = joints;
                [a, b - c, c, d, e, f]
            }
        }
    }
}

impl Column<Along> {
    /// The most that a force of 1 N pushes the axis with, in Nm, that acts up to so far from the point, in m.
    pub(crate) fn largest(&self, off: f64) -> f64 {
        let length =
            |vector: Vector<Along>| DVec3::from_array(vector.map(|part| part.value().magnitude())).length();
        length(self.way) + off * length(self.turn)
    }

    /// The torque about the axis of a moment of 1 Nm about whatever axis, at most, where `view` looks.
    pub(crate) fn turning(&self, view: fn(Along) -> Interval) -> f64 {
        DVec3::from_array(self.turn.map(|part| view(part).magnitude())).length()
    }
}

impl<N: Number> core::ops::Sub for Column<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            way: core::array::from_fn(|part| self.way[part] - other.way[part]),
            turn: core::array::from_fn(|part| self.turn[part] - other.turn[part]),
        }
    }
}

#[cfg(test)]
mod tests;
