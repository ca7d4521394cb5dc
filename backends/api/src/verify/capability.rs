//! What a program may need of a dialect.

use serde::{Deserialize, Serialize};

/// Something a program may need and a dialect may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Capability {
    /// Straight moves with a turning blade.
    LinearMove,
    /// Moves of all axes, to the values of home or to those at a pose.
    JointMove,
    /// Turning about a still tip.
    StillTipTurn,
    /// A digital output.
    Output,
    /// Waiting for a digital input.
    AwaitInput,
    /// Waiting for some time.
    Dwell,
    /// Changing the blade.
    ToolChange,
    /// Lines and arcs through the work without a stop between them.
    Chain,
    /// A spindle of the control's own.
    Spindle,
}

impl Capability {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::LinearMove,
        Self::JointMove,
        Self::StillTipTurn,
        Self::Output,
        Self::AwaitInput,
        Self::Dwell,
        Self::ToolChange,
        Self::Chain,
        Self::Spindle,
    ];

    /// What it is, for people.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::LinearMove => "straight moves of the tip with a turning blade",
            Self::JointMove => "axis moves",
            Self::StillTipTurn => "turns about the still tip",
            Self::Output => "digital outputs",
            Self::AwaitInput => "waiting for a digital input",
            Self::Dwell => "waiting for some time",
            Self::ToolChange => "changes of the blade",
            Self::Chain => "lines and arcs without a stop between them",
            Self::Spindle => "a spindle of its own",
        }
    }
}

/// A set of [`Capability`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Capabilities(u32);

impl Capabilities {
    /// The set without members.
    pub const NONE: Self = Self(0);

    /// This set and one more.
    #[must_use]
    pub const fn with(self, capability: Capability) -> Self {
        Self(self.0 | (1 << capability as u32))
    }

    /// Whether it is in the set.
    #[must_use]
    pub const fn has(self, capability: Capability) -> bool {
        self.0 & (1 << capability as u32) != 0
    }

    /// Members of this set that `other` lacks.
    pub fn missing_from(self, other: Self) -> impl Iterator<Item = Capability> {
        Capability::ALL
            .into_iter()
            .filter(move |&c| self.has(c) && !other.has(c))
    }
}
