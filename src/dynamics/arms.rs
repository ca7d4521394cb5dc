//! The arm of a program with each of its blades.

use crate::arm::Arm;
use vcutc_backend_api::ir::{Cell, Registered, ToolId};
use vcutc_machine::Model;

/// Why the torques of an arm are not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The machine is not an arm, or its description has no masses.
    Masses,
    /// The job does not state what the flange carries, or by a number of the controller only.
    Load,
}

/// An arm with each blade, in the order of their numbers.
#[derive(Clone, Debug)]
pub struct Arms(Vec<Arm>);

impl Arms {
    /// Of a machine in its cell.
    ///
    /// # Errors
    /// Why its torques are not known.
    pub fn of(model: &Model, cell: &Cell) -> Result<Self, Unknown> {
        let arms = cell.tools.iter().map(|(_, tool)| match tool.load {
            Some(Registered::Value(load)) => Arm::of(model, Some(load)).ok_or(Unknown::Masses),
            Some(Registered::Number(_)) | None => match Arm::of(model, None) {
                Some(_) => Err(Unknown::Load),
                None => Err(Unknown::Masses),
            },
        });
        Ok(Self(arms.collect::<Result<_, _>>()?))
    }

    /// With a blade.
    #[must_use]
    pub fn with(&self, tool: ToolId) -> Option<&Arm> {
        self.0.get(usize::from(tool.0)).or_else(|| self.0.first())
    }

    /// The same arms where nothing weighs: what they need is for motion alone.
    pub(crate) fn weightless(&self) -> Self {
        Self(self.0.iter().map(Arm::weightless).collect())
    }
}
