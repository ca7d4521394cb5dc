//! A machine as lines about which its axes turn and along which they slide: one form for all mechanisms.
//!
//! Two chains of joints begin at the machine's frame, one ends at the flange, the other at the mount of the work. With all
//! axes at zero every joint is a line of the machine's frame, and moves all that comes after it in its chain:
//!
//! `flange_in_machine = E1 E2 ... En flange_at_zero`, and the mount likewise,
//!
//! where `Ei` is the rotation about line `i`, or the shift along it (the product of exponentials of [`super::serial`]). Who
//! draws a machine needs nothing else, and no kinematics of a kind of machine.

use super::five_axis::{Direction, FiveAxis, Rotary};
use super::joint_axis::JointAxis;
use super::pose::Pose;
use super::serial::SerialArm;
use super::{Joints, Mechanism};
use glam::DMat3;
use vcutc_backend_api::ir::{AxisKind, MOST_AXES};

/// A joint of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// How it moves.
    pub kind: AxisKind,
    /// Its line with all axes at zero, in the machine's frame.
    pub line: JointAxis,
    /// By how much it moves for each unit of each of the controller's axes: one of its own, but two where a parallelogram
    /// couples them.
    pub weights: [f64; MOST_AXES],
}

/// The chains of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// From the machine's frame to the flange.
    pub tool: Vec<Joint>,
    /// From the machine's frame to the mount of the work.
    pub work: Vec<Joint>,
    /// The flange at zero, in the machine's frame.
    pub flange_at_zero: Pose,
    /// The mount at zero, in the machine's frame: the root in which mechanisms have their flange.
    pub mount_at_zero: Pose,
}

impl Joint {
    /// What it carries, moved by the axes, seen from the same at zero.
    #[must_use]
    pub fn moved(&self, axes: &Joints) -> Pose {
        let amount = self.weights.iter().zip(axes).map(|(weight, axis)| weight * axis);
        let amount: f64 = amount.sum();
        let JointAxis { point, direction } = self.line;
        match self.kind {
            AxisKind::Rotary => {
                let rotation = DMat3::from_axis_angle(direction, amount);
                Pose {
                    rotation,
                    position: point - rotation * point,
                }
            }
            AxisKind::Linear => Pose {
                position: direction * amount,
                ..Pose::IDENTITY
            },
        }
    }
}

impl Linkage {
    /// The flange seen from the mount of the work.
    #[must_use]
    pub fn flange_in_mount(&self, axes: &Joints) -> Pose {
        let chain = |joints: &[Joint]| {
            let moved = joints.iter().map(|joint| joint.moved(axes));
            moved.fold(Pose::IDENTITY, |outer, inner| outer * inner)
        };
        let mount = chain(&self.work) * self.mount_at_zero;
        mount.inverse() * chain(&self.tool) * self.flange_at_zero
    }
}

impl From<&Mechanism> for Linkage {
    fn from(mechanism: &Mechanism) -> Self {
        match mechanism {
            Mechanism::OrthoParallel(arm) => Self::from(&SerialArm::from(arm)),
            Mechanism::Mounted(arm) => Self::from(&SerialArm::from(arm)),
            Mechanism::Serial(arm) => Self::from(arm),
            Mechanism::FiveAxis(machine) => Self::from(machine),
        }
    }
}

impl From<&SerialArm> for Linkage {
    fn from(arm: &SerialArm) -> Self {
        let units = core::array::from_fn(unit);
        let weights = arm.turns_of(units, |a, b| core::array::from_fn(|axis| a[axis] - b[axis]));
        let joints = arm.axes().iter().zip(weights).map(|(&line, weights)| Joint {
            kind: AxisKind::Rotary,
            line,
            weights,
        });
        Self {
            tool: joints.collect(),
            work: Vec::new(),
            flange_at_zero: *arm.flange_at_zero(),
            mount_at_zero: Pose::IDENTITY,
        }
    }
}

impl From<&FiveAxis> for Linkage {
    fn from(machine: &FiveAxis) -> Self {
        let flange_at_zero = machine.nose_at_zero();
        let slides = [Direction::PlusX, Direction::PlusY, Direction::PlusZ];
        let slides = slides.into_iter().enumerate().map(|(axis, along)| Joint {
            kind: AxisKind::Linear,
            line: JointAxis {
                point: flange_at_zero.position,
                direction: along.vector(),
            },
            weights: unit(axis),
        });
        let turns = |(rotary, axis): (Rotary, usize)| Joint {
            kind: AxisKind::Rotary,
            line: JointAxis {
                point: rotary.centre,
                direction: rotary.about.vector(),
            },
            weights: unit(axis),
        };
        Self {
            tool: slides.chain(machine.head().map(turns)).collect(),
            work: machine.table().map(turns).collect(),
            flange_at_zero,
            mount_at_zero: machine.mount_at_zero(),
        }
    }
}

/// One unit of an axis.
fn unit(axis: usize) -> [f64; MOST_AXES] {
    core::array::from_fn(|other| if other == axis { 1.0 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::kinematics::samples::{irb2400, kr210, mounted, ur10e};
    use proptest::prelude::*;

    fn agrees(mechanism: &Mechanism, axes: &Joints) {
        let linkage = Linkage::from(mechanism);
        let (apart, turned) = linkage
            .flange_in_mount(axes)
            .apart(&mechanism.flange_in_root(axes));
        assert!(apart < 1e-8 && turned < 1e-11, "{apart} mm, {turned}");
    }

    proptest! {
        #[test]
        fn arms_are_where_their_own_kinematics_has_them(axes in prop::array::uniform6(-3.0..3.0_f64)) {
            agrees(&Mechanism::OrthoParallel(kr210()), &axes);
            agrees(&Mechanism::OrthoParallel(irb2400()), &axes);
            agrees(&Mechanism::Mounted(mounted()), &axes);
            agrees(&Mechanism::Serial(ur10e()), &axes);
        }

        #[test]
        fn five_axis_machines_too(
            slides in prop::array::uniform3(-1000.0..1000.0_f64),
            turns in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            for name in catalogue::names().filter(|name| name.starts_with("generic/")) {
                let model = catalogue::find(name).unwrap();
                let mut axes = [slides, turns].concat();
                axes[model.axes.len()..].fill(0.0);
                agrees(&model.mechanism, &core::array::from_fn(|axis| axes[axis]));
            }
        }
    }
}
