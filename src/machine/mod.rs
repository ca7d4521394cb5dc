//! Machines: what axes a machine has and how they carry the blade. The catalogue, sheets of users, and robots described
//! by URDF all end as a [`Model`].

pub mod catalogue;
pub mod flaw;
pub mod urdf;

use crate::kinematics::Mechanism;
use vcutc_backend_api::ir::{Axis, MachineKind, Maker};

/// A machine as the compiler needs it, wherever its description came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The name under which a job asks for it, such as `kuka/kr210_r3100_ultra`.
    pub name: String,
    /// Who made its controller.
    pub maker: Maker,
    /// Its axes, in the controller's order and sense.
    pub axes: Vec<Axis>,
    /// How the axes move the flange (of a robot) or the spindle nose (of a five-axis machine).
    pub mechanism: Mechanism,
}

impl Model {
    /// What it is.
    #[must_use]
    pub const fn kind(&self) -> MachineKind {
        match self.mechanism {
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => MachineKind::Robot,
        }
    }
}
