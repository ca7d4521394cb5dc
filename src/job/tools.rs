//! How a machine holds the blades of a job.

use super::Sourced;
use vcutc_backend_api::ir::{Change, Load, NoTools, PlacedFrame, Registered, Tool, Tools};
use vcutc_diagnostics::source::{Span, Spanned};

/// How a machine holds a blade.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldTool {
    /// The blade; none where the machine holds only one, whichever it is.
    pub blade: Option<Spanned<String>>,
    /// Blade frame seen from the flange.
    pub frame: Sourced<PlacedFrame>,
    /// What the flange carries.
    pub load: Option<Sourced<Registered<Load>>>,
    /// Where the changer keeps the blade.
    pub place: Option<Sourced<u32>>,
}

/// The tools of a machine, at least one. Those of a checked job are the ones that it uses, in the order of its operations.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldTools {
    first: HeldTool,
    others: Vec<HeldTool>,
}

/// How blades are changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldChange {
    /// Where, how fast and by whom.
    pub change: Change,
    /// Where the job says so.
    pub span: Span,
}

impl HeldTool {
    /// As programs say it.
    #[must_use]
    pub fn in_program(&self) -> Tool {
        Tool {
            frame: self.frame.value,
            load: self.load.map(|load| load.value),
            place: self.place.map(|place| place.value),
        }
    }

    /// Whether it holds the blade of this name.
    #[must_use]
    pub fn holds(&self, blade: &str) -> bool {
        self.blade.as_ref().is_none_or(|held| held.node == blade)
    }

    fn forget_places(&mut self, place: Span) {
        if let Some(blade) = &mut self.blade {
            blade.span = place;
        }
        self.frame.forget_place(place);
        if let Some(load) = &mut self.load {
            load.forget_place(place);
        }
        if let Some(number) = &mut self.place {
            number.forget_place(place);
        }
    }
}

impl HeldTools {
    /// The tools of a list; none where it is empty.
    #[must_use]
    pub fn of(mut tools: Vec<HeldTool>) -> Option<Self> {
        if tools.is_empty() {
            return None;
        }
        let first = tools.remove(0);
        Some(Self { first, others: tools })
    }

    /// The tool of a machine that holds one blade.
    #[must_use]
    pub const fn one(tool: HeldTool) -> Self {
        Self {
            first: tool,
            others: Vec::new(),
        }
    }

    /// The tool that is at hand when the program begins.
    #[must_use]
    pub const fn first(&self) -> &HeldTool {
        &self.first
    }

    /// The same, to be changed.
    pub const fn first_mut(&mut self) -> &mut HeldTool {
        &mut self.first
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &HeldTool> {
        core::iter::once(&self.first).chain(&self.others)
    }

    /// The tool that holds the blade of this name.
    #[must_use]
    pub fn holding(&self, blade: &str) -> Option<&HeldTool> {
        self.iter().find(|tool| tool.holds(blade))
    }

    /// The tools that hold these blades, in their order, as programs say them.
    #[must_use]
    pub fn in_program<'b>(&self, blades: impl IntoIterator<Item = &'b str>) -> Tools {
        let held = blades
            .into_iter()
            .map(|blade| self.holding(blade).unwrap_or(&self.first));
        let tools: Vec<Tool> = held.map(HeldTool::in_program).collect();
        Tools::try_from(tools).unwrap_or_else(|NoTools| Tools::one(self.first.in_program()))
    }

    /// Replaces the places where they are written by this one.
    pub(crate) fn forget_places(&mut self, place: Span) {
        self.first.forget_places(place);
        for tool in &mut self.others {
            tool.forget_places(place);
        }
    }
}
