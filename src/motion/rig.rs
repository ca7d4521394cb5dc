//! A machine set up in its cell: mechanism, axes, and the frames between flange and blade, root and work.

use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::Axis;
use vcutc_job::Machine;
use vcutc_machine::Model;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// A machine set up in its cell.
#[derive(Clone, Debug)]
pub struct Rig<'m> {
    /// How the axes carry the flange.
    pub mechanism: &'m Mechanism,
    pub axes: &'m [Axis],
    /// The flange seen from the blade frame T.
    pub flange_in_blade: Pose,
    /// The workpiece frame W seen from the root.
    pub work_in_root: Pose,
}

impl<'m> Rig<'m> {
    /// Sets a machine up. `tool` is T seen from the flange, `base` is W seen from the root.
    #[must_use]
    pub fn new(model: &'m Model, tool: Frame, base: Frame) -> Self {
        Self {
            mechanism: &model.mechanism,
            axes: &model.axes,
            flange_in_blade: Pose::from(tool).inverse(),
            work_in_root: Pose::from(base),
        }
    }

    /// The machine of a job.
    #[must_use]
    pub fn of(machine: &'m Machine) -> Self {
        Self::new(
            &machine.model,
            machine.tools.first().frame.value.frame,
            machine.base.value.frame,
        )
    }

    /// Where the flange is in the root when the blade is there in the work.
    #[must_use]
    pub fn flange_in_root(&self, blade_in_work: &Pose) -> Pose {
        self.work_in_root * *blade_in_work * self.flange_in_blade
    }

    /// The same with the work in another place.
    #[must_use]
    pub fn with_work(&self, work_in_root: Pose) -> Self {
        Self {
            work_in_root,
            ..self.clone()
        }
    }

    /// Where a point of the work is in the root.
    #[must_use]
    pub fn point_in_root(&self, point: Point3) -> Point3 {
        let there = Frame {
            origin: point,
            orientation: Orientation::IDENTITY,
        };
        Frame::from(self.work_in_root * Pose::from(there)).origin
    }

    /// Where the blade is in the work at these axis values.
    #[must_use]
    pub fn blade_in_work(&self, joints: &Joints) -> Pose {
        let flange_in_root = self.mechanism.flange_in_root(joints);
        self.work_in_root.inverse() * flange_in_root * self.flange_in_blade.inverse()
    }
}
