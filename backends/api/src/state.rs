//! What the machine is doing between two ops: where it is, and whether the blade vibrates and spins.

use crate::geometry::Point3;
use crate::ir::{Action, OrientationId, Switch, ToolId};

/// A pose of the blade frame T in the workpiece frame W, as a program states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipPose {
    /// The tip, which is the origin of T, in W.
    pub tip: Point3,
    /// The axes of T in W.
    pub orientation: OrientationId,
}

/// Where the machine is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Not known: nothing has moved yet.
    Unknown,
    /// At the home angles.
    Home,
    /// Where the cell changes blades.
    Change,
    /// With the blade in a pose.
    Pose(TipPose),
}

/// How far a drive is: the ultrasonic generator, or the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// Off.
    Off,
    /// Switched on.
    Starting,
    /// Switched on, and its readiness awaited.
    Running,
}

impl Drive {
    /// After it is switched.
    const fn switched(state: Switch) -> Self {
        match state {
            Switch::On => Self::Starting,
            Switch::Off => Self::Off,
        }
    }

    /// Whether it is switched on.
    #[must_use]
    pub const fn is_on(self) -> Switch {
        match self {
            Self::Off => Switch::Off,
            Self::Starting | Self::Running => Switch::On,
        }
    }

    /// After its readiness is awaited.
    const fn awaited(self) -> Self {
        match self {
            Self::Off => Self::Off,
            Self::Starting | Self::Running => Self::Running,
        }
    }
}

/// The state between two ops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Where the machine is.
    pub place: Place,
    /// Whether the blade vibrates.
    pub generator: Drive,
    /// Whether it spins.
    pub spindle: Drive,
    /// The blade at hand.
    pub tool: ToolId,
}

impl State {
    /// Before the first op.
    pub const START: Self = Self {
        place: Place::Unknown,
        generator: Drive::Off,
        spindle: Drive::Off,
        tool: ToolId::FIRST,
    };

    /// After an action. One that moves nothing leaves the machine where it is.
    #[must_use]
    #[inline]
    pub const fn after(mut self, action: &Action) -> Self {
        self.advance(action);
        self
    }

    /// The same in place: walks over millions of ops do not copy the state for each.
    #[inline]
    pub(crate) const fn advance(&mut self, action: &Action) {
        self.lead(action, action.leads_to(self.place.pose()));
    }

    /// The same with the pose to which the action leads, as [`Action::leads_to`] has it.
    #[inline(always)]
    pub(crate) const fn lead(&mut self, action: &Action, to: Option<TipPose>) {
        match action {
            Action::Home => self.place = Place::Home,
            Action::ChangePlace => self.place = Place::Change,
            Action::ToolChange { tool } => {
                self.tool = *tool;
                // The tip is another one.
                self.place = match self.place {
                    Place::Home | Place::Change => self.place,
                    Place::Unknown | Place::Pose(_) => Place::Unknown,
                };
            }
            Action::Ultrasonic { state } => self.generator = Drive::switched(*state),
            Action::Spin { state } => self.spindle = Drive::switched(*state),
            Action::AwaitReady => {
                self.generator = self.generator.awaited();
                self.spindle = self.spindle.awaited();
            }
            _ => {
                if let Some(pose) = to {
                    self.place = Place::Pose(pose);
                }
            }
        }
    }
}

impl Place {
    /// The pose of the blade, where it is known.
    #[must_use]
    #[inline]
    pub const fn pose(self) -> Option<TipPose> {
        match self {
            Self::Pose(pose) => Some(pose),
            Self::Unknown | Self::Home | Self::Change => None,
        }
    }
}

impl Action {
    /// The pose to which it leads the blade from another one; none for an action that moves no blade, or only the axes to
    /// home, and for one that needs to know where it begins.
    #[must_use]
    #[inline(always)]
    pub const fn leads_to(&self, from: Option<TipPose>) -> Option<TipPose> {
        match (self.tip(), self.orientation(), from) {
            (Some(tip), Some(orientation), _)
            | (Some(tip), None, Some(TipPose { orientation, .. }))
            | (None, Some(orientation), Some(TipPose { tip, .. })) => Some(TipPose { tip, orientation }),
            (Some(_), None, None) | (None, Some(_), None) | (None, None, _) => None,
        }
    }
}
