//! The blades of a program as its machine holds them, and how one takes the place of another.

use super::{AxisValues, Cell, Load, PlacedFrame, Registered};
use crate::units::Duration;
use serde::{Deserialize, Serialize};

/// Number of a blade and of the tool that holds it: their place in [`super::Program::blades`] and [`super::Cell::tools`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct ToolId(pub u16);

impl ToolId {
    /// The one that is at hand when a program begins.
    pub const FIRST: Self = Self(0);
}

/// How a machine holds a blade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tool {
    /// Blade frame T seen from the flange.
    pub frame: PlacedFrame,
    /// What the flange carries with this blade, when the job states it.
    pub load: Option<Registered<Load>>,
    /// Where the changer keeps the blade, counted from 1, when the job states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<u32>,
}

/// The tools of a machine, at least one, in the order of the program's blades.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Tool>", into = "Vec<Tool>")]
pub struct Tools {
    first: Tool,
    others: Vec<Tool>,
}

/// A list of tools that has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoTools;

impl core::fmt::Display for NoTools {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("a machine has at least one tool")
    }
}

impl TryFrom<Vec<Tool>> for Tools {
    type Error = NoTools;

    fn try_from(mut tools: Vec<Tool>) -> Result<Self, NoTools> {
        if tools.is_empty() {
            return Err(NoTools);
        }
        let others = tools.split_off(1);
        let [first] = tools.as_slice() else {
            return Err(NoTools);
        };
        Ok(Self {
            first: *first,
            others,
        })
    }
}

impl From<Tools> for Vec<Tool> {
    fn from(tools: Tools) -> Self {
        core::iter::once(tools.first).chain(tools.others).collect()
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Tools {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Tools".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "The tools of a machine, at least one, in the order of the program's blades.",
            "type": "array",
            "items": generator.subschema_for::<Tool>(),
            "minItems": 1,
        })
    }
}

impl Tools {
    /// The tools of a machine that holds one blade.
    #[must_use]
    pub const fn one(tool: Tool) -> Self {
        Self {
            first: tool,
            others: Vec::new(),
        }
    }

    /// The same with one more.
    #[must_use]
    pub fn and(mut self, tool: Tool) -> Self {
        self.others.push(tool);
        self
    }

    /// The tool with which a program begins.
    #[must_use]
    pub const fn first(&self) -> &Tool {
        &self.first
    }

    /// The same, to be changed.
    #[must_use]
    pub const fn first_mut(&mut self) -> &mut Tool {
        &mut self.first
    }

    /// A tool by its number; none where there are fewer.
    #[must_use]
    pub fn get(&self, id: ToolId) -> Option<&Tool> {
        match id.0.checked_sub(1) {
            None => Some(&self.first),
            Some(other) => self.others.get(usize::from(other)),
        }
    }

    /// A tool by its number (the first for a number of another program).
    #[must_use]
    pub fn at(&self, id: ToolId) -> &Tool {
        self.get(id).unwrap_or(&self.first)
    }

    /// All of them with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (ToolId, &Tool)> {
        let tools = core::iter::once(&self.first).chain(&self.others);
        (0..).map(ToolId).zip(tools)
    }

    /// The tool that is kept at a place of the changer.
    #[must_use]
    pub fn at_place(&self, place: u32) -> Option<ToolId> {
        let mut tools = self.iter();
        tools
            .find(|(_, tool)| tool.place == Some(place))
            .map(|(id, _)| id)
    }

    /// How many there are, at least one.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.others.len() + 1
    }

    /// Whether the program has to change them.
    #[must_use]
    pub const fn are_several(&self) -> bool {
        !self.others.is_empty()
    }
}

impl Cell {
    /// Who changes the blades of a program that has several.
    #[must_use]
    pub fn changer(&self) -> Option<Changer> {
        let change = self.change.filter(|_| self.tools.are_several())?;
        Some(change.by)
    }

    /// The place that a change to a tool names; none where a person changes the blades, or where they are not
    /// changed.
    #[must_use]
    pub fn named_place(&self, tool: ToolId) -> Option<u32> {
        match self.changer()? {
            Changer::Program => self.tools.get(tool)?.place,
            Changer::Hand => None,
        }
    }
}

/// How a blade takes the place of another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Change {
    /// Where the axes are meanwhile.
    pub at: AxisValues,
    /// How long it takes.
    pub time: Duration,
    /// Who does it.
    pub by: Changer,
}

/// Who changes blades.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Changer {
    /// A routine of the cell, which gets the place of the new blade.
    Program,
    /// A person, while the program waits.
    Hand,
}
