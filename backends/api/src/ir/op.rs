//! One op of a program: what of the job it serves, and what is done.

use super::{FeedId, OperationId, OrientationId, RateId, ToolId, ViaId};
use crate::geometry::Point3;
use crate::units::Duration;
use core::num::NonZeroU32;
use serde::{Deserialize, Serialize};

/// One op and what of the job it serves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Op {
    /// What of the job it serves; leads back to the source.
    pub site: Site,
    /// What is done.
    pub action: Action,
}

/// What of the job an op serves. Layers and cuts are counted from 1, as people on the shop floor do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Site {
    /// The program as a whole: its start and end.
    Program,
    /// An operation as a whole: its start and end.
    Operation(OperationId),
    /// A layer as a whole: getting there and leaving.
    Layer {
        /// The operation.
        operation: OperationId,
        /// The layer, from the top.
        layer: NonZeroU32,
    },
    /// One cut of a layer: a V, or a chain.
    Cut {
        /// The operation.
        operation: OperationId,
        /// The layer, from the top.
        layer: NonZeroU32,
        /// The cut within its layer.
        cut: NonZeroU32,
    },
}

/// What an op does. Every motion starts where the op before it ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", tag = "do")]
pub enum Action {
    /// All axes to the cell's home values, all arriving together.
    Home,
    /// Through the air, tip on a line, orientation turning along.
    Travel {
        /// Where the tip ends.
        to: Point3,
        /// How the blade is held there.
        orientation: OrientationId,
        /// Tip speed.
        feed: FeedId,
        /// Rate at which the orientation turns at most.
        rate: RateId,
    },
    /// Through the air above the work, every axis straight to its value at the pose, all arriving together. Which of the
    /// poses' axis values are meant is said by the [`crate::motion::Motion`] that goes with the program.
    AxisTravel {
        /// Where the tip ends.
        to: Point3,
        /// How the blade is held there.
        orientation: OrientationId,
    },
    /// Through the air towards the work, orientation kept; ends in an exact stop.
    Approach {
        /// Where the tip ends.
        to: Point3,
        /// Tip speed.
        feed: FeedId,
    },
    /// Through the air away from the work, orientation kept.
    Retract {
        /// Where the tip ends.
        to: Point3,
        /// Tip speed.
        feed: FeedId,
    },
    /// Through the work along y, orientation kept; starts and ends in an exact stop.
    Cut {
        /// Which flank of the V this cut makes.
        flank: Flank,
        /// Where the tip ends.
        to: Point3,
        /// Tip speed.
        feed: FeedId,
    },
    /// Along a line or an arc through the work, the orientation turning about one fixed axis at a constant rate: one piece of a
    /// chain.
    Follow {
        /// Where the tip ends.
        to: Point3,
        /// How the blade is held there.
        orientation: OrientationId,
        /// A point of the arc on which the tip moves, between its ends; none on a straight line.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        via: Option<ViaId>,
        /// Tip speed.
        feed: FeedId,
        /// Rate at which the orientation turns at most.
        rate: RateId,
        /// How the next piece follows.
        joint: Joint,
    },
    /// Orientation changes while the tip stays where it is.
    Turn {
        /// How the blade is held afterwards.
        to: OrientationId,
        /// Rate of turning.
        rate: RateId,
    },
    /// The ultrasonic generator is switched, exactly here.
    Ultrasonic {
        /// On or off.
        state: Switch,
    },
    /// The spindle is switched, exactly here. It turns the blade at hand at the speed that the blade states.
    Spin {
        /// On or off.
        state: Switch,
    },
    /// Waits until generator and spindle are up, as `ready` of the cell states.
    AwaitReady,
    /// Waits.
    Dwell {
        /// For so long.
        time: Duration,
    },
    /// All axes to the place at which the cell changes blades, all arriving together.
    ChangePlace,
    /// Another blade takes the place of the one at hand, at the change place. Where the tip is afterwards is not known until
    /// the next move of all axes.
    ToolChange {
        /// The blade at hand afterwards.
        tool: ToolId,
    },
}

/// What happens at the end of a piece of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Joint {
    /// The chain continues in the same direction without a stop; the tip may leave the pieces by the program's
    /// [`blend`](super::Program::blend).
    Through,
    /// An exact stop: the chain ends.
    Stop,
}

/// The two flanks of a V, seen looking along +y.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Flank {
    /// Rises towards -x; the shank leans to -x (swing negative).
    Left,
    /// Rises towards +x; the shank leans to +x (swing positive).
    Right,
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Switch {
    /// Running.
    On,
    /// Stopped.
    Off,
}

/// What kind of op an action is: its variant, with the flank for cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// [`Action::Home`].
    Home,
    /// [`Action::Travel`].
    Travel,
    /// [`Action::AxisTravel`].
    AxisTravel,
    /// [`Action::Approach`].
    Approach,
    /// [`Action::Retract`].
    Retract,
    /// [`Action::Cut`] of a left flank.
    CutLeft,
    /// [`Action::Cut`] of a right flank.
    CutRight,
    /// [`Action::Follow`].
    Follow,
    /// [`Action::Turn`].
    Turn,
    /// [`Action::Ultrasonic`].
    Ultrasonic,
    /// [`Action::Spin`].
    Spin,
    /// [`Action::AwaitReady`].
    AwaitReady,
    /// [`Action::Dwell`].
    Dwell,
    /// [`Action::ChangePlace`].
    ChangePlace,
    /// [`Action::ToolChange`].
    ToolChange,
}

impl ActionKind {
    /// The names of all of them, in their order.
    pub const NAMES: [&'static str; 15] = [
        "home",
        "travel",
        "axis_travel",
        "approach",
        "retract",
        "cut_left",
        "cut_right",
        "follow",
        "turn",
        "ultrasonic",
        "spin",
        "await_ready",
        "dwell",
        "change_place",
        "tool_change",
    ];

    /// Its name in tables of ops.
    #[must_use]
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

impl Action {
    /// Where it leads the tip; none for an action that leaves the tip where it is, or goes home.
    // Copies of an action are taken apart in halves of numbers where they are matched: these match references.
    #[must_use]
    #[inline(always)]
    pub const fn tip(&self) -> Option<Point3> {
        match self {
            Self::Travel { to, .. }
            | Self::AxisTravel { to, .. }
            | Self::Approach { to, .. }
            | Self::Retract { to, .. }
            | Self::Cut { to, .. }
            | Self::Follow { to, .. } => Some(*to),
            Self::Home
            | Self::Turn { .. }
            | Self::Ultrasonic { .. }
            | Self::Spin { .. }
            | Self::AwaitReady
            | Self::Dwell { .. }
            | Self::ChangePlace
            | Self::ToolChange { .. } => None,
        }
    }

    /// How the blade is held after it; none for an action that keeps the orientation, or goes home.
    #[must_use]
    #[inline(always)]
    pub const fn orientation(&self) -> Option<OrientationId> {
        match self {
            Self::Travel { orientation, .. }
            | Self::AxisTravel { orientation, .. }
            | Self::Follow { orientation, .. }
            | Self::Turn { to: orientation, .. } => Some(*orientation),
            Self::Home
            | Self::Approach { .. }
            | Self::Retract { .. }
            | Self::Cut { .. }
            | Self::Ultrasonic { .. }
            | Self::Spin { .. }
            | Self::AwaitReady
            | Self::Dwell { .. }
            | Self::ChangePlace
            | Self::ToolChange { .. } => None,
        }
    }

    /// The speed of the ops that move the tip on a line.
    #[must_use]
    #[inline(always)]
    pub const fn feed(&self) -> Option<FeedId> {
        match self {
            Self::Travel { feed, .. }
            | Self::Approach { feed, .. }
            | Self::Retract { feed, .. }
            | Self::Cut { feed, .. }
            | Self::Follow { feed, .. } => Some(*feed),
            Self::Home
            | Self::AxisTravel { .. }
            | Self::Turn { .. }
            | Self::Ultrasonic { .. }
            | Self::Spin { .. }
            | Self::AwaitReady
            | Self::Dwell { .. }
            | Self::ChangePlace
            | Self::ToolChange { .. } => None,
        }
    }

    /// The rate of the ops that turn the blade at one.
    #[must_use]
    #[inline(always)]
    pub const fn rate(&self) -> Option<RateId> {
        match self {
            Self::Travel { rate, .. } | Self::Follow { rate, .. } | Self::Turn { rate, .. } => Some(*rate),
            Self::Home
            | Self::AxisTravel { .. }
            | Self::Approach { .. }
            | Self::Retract { .. }
            | Self::Cut { .. }
            | Self::Ultrasonic { .. }
            | Self::Spin { .. }
            | Self::AwaitReady
            | Self::Dwell { .. }
            | Self::ChangePlace
            | Self::ToolChange { .. } => None,
        }
    }

    /// The point by which an arc is known; none for an action whose tip moves on a line, or not at all.
    #[must_use]
    #[inline(always)]
    pub const fn via(&self) -> Option<ViaId> {
        match self {
            Self::Follow { via, .. } => *via,
            _ => None,
        }
    }

    /// What kind of op it is.
    #[must_use]
    pub const fn kind(&self) -> ActionKind {
        match self {
            Self::Home => ActionKind::Home,
            Self::Travel { .. } => ActionKind::Travel,
            Self::AxisTravel { .. } => ActionKind::AxisTravel,
            Self::Approach { .. } => ActionKind::Approach,
            Self::Retract { .. } => ActionKind::Retract,
            Self::Cut {
                flank: Flank::Left, ..
            } => ActionKind::CutLeft,
            Self::Cut {
                flank: Flank::Right, ..
            } => ActionKind::CutRight,
            Self::Follow { .. } => ActionKind::Follow,
            Self::Turn { .. } => ActionKind::Turn,
            Self::Ultrasonic { .. } => ActionKind::Ultrasonic,
            Self::Spin { .. } => ActionKind::Spin,
            Self::AwaitReady => ActionKind::AwaitReady,
            Self::Dwell { .. } => ActionKind::Dwell,
            Self::ChangePlace => ActionKind::ChangePlace,
            Self::ToolChange { .. } => ActionKind::ToolChange,
        }
    }
}

impl Site {
    /// The operation it belongs to, if to one.
    #[must_use]
    pub const fn operation(self) -> Option<OperationId> {
        match self {
            Self::Program => None,
            Self::Operation(operation) | Self::Layer { operation, .. } | Self::Cut { operation, .. } => {
                Some(operation)
            }
        }
    }
}
