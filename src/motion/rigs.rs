//! A machine with each of its program's blades in turn.

use super::rig::Rig;
use core::ops::Range;
use vcutc_backend_api::ir::{Action, Cell, OpId, Program, ToolId};
use vcutc_backend_api::segments::Path;
use vcutc_machine::Model;

/// A machine set up in its cell, with the blade that each op has at hand.
#[derive(Clone, Debug)]
pub struct Rigs<'m> {
    /// With each tool, in the order of their numbers.
    rigs: Vec<Rig<'m>>,
    first: Rig<'m>,
    /// From which op on which blade is at hand.
    turns: Vec<(OpId, ToolId)>,
}

impl<'m> Rigs<'m> {
    /// A machine as a program's cell sets it up.
    #[must_use]
    pub fn of(model: &'m Model, cell: &Cell, program: &Program) -> Self {
        let base = cell.base.frame;
        let rigs = cell.tools.iter();
        Self {
            rigs: rigs
                .map(|(_, tool)| Rig::new(model, tool.frame.frame, base))
                .collect(),
            first: Rig::new(model, cell.tools.first().frame.frame, base),
            turns: turns(program)
                .into_iter()
                .map(|turn| (OpId(u32::try_from(turn.ops.start).unwrap_or(u32::MAX)), turn.tool))
                .collect(),
        }
    }

    /// With the blade with which the program begins.
    #[must_use]
    pub const fn first(&self) -> &Rig<'m> {
        &self.first
    }

    /// With a blade.
    #[must_use]
    pub fn with(&self, tool: ToolId) -> &Rig<'m> {
        self.rigs.get(usize::from(tool.0)).unwrap_or(&self.first)
    }

    /// With the blade that an op has at hand when it begins.
    #[must_use]
    pub fn during(&self, op: OpId) -> &Rig<'m> {
        self.with(self.tool_during(op))
    }

    /// The blade that an op has at hand when it begins.
    #[must_use]
    pub fn tool_during(&self, op: OpId) -> ToolId {
        let begun = self.turns.partition_point(|(from, _)| *from <= op);
        let turn = begun.checked_sub(1).and_then(|turn| self.turns.get(turn));
        turn.map_or(ToolId::FIRST, |(_, tool)| *tool)
    }
}

/// The ops between two changes of the blade.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turn {
    /// The blade at hand.
    pub(super) tool: ToolId,
    /// Their places in the program; the last may be the change to another blade.
    pub(super) ops: Range<usize>,
}

/// A program by the blades that it has at hand, one after the other: at least one turn.
pub(super) fn turns(program: &Program) -> Vec<Turn> {
    let mut turns = Vec::new();
    let (mut tool, mut start) = (ToolId::FIRST, 0);
    for (index, op) in program.ops.iter().enumerate() {
        if let Action::ToolChange { tool: next } = op.action {
            let ops = start..index + 1;
            turns.push(Turn { tool, ops });
            (tool, start) = (next, index + 1);
        }
    }
    turns.push(Turn {
        tool,
        ops: start..program.ops.len(),
    });
    turns
}

impl Turn {
    /// The paths of a program as if nothing moved but in this turn. The move to where the blade was put in belongs to it, for
    /// there its first motion begins.
    pub(super) fn alone(&self, paths: &[Path]) -> Vec<Path> {
        let before = paths.get(..self.ops.start).unwrap_or_default();
        let begins = before.iter().rposition(|path| *path != Path::Still);
        let ops = begins.unwrap_or(self.ops.start)..self.ops.end;
        let alone = paths.iter().enumerate();
        alone
            .map(|(index, path)| if ops.contains(&index) { *path } else { Path::Still })
            .collect()
    }
}
