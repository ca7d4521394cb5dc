//! The tools of a machine as its control numbers them.

use crate::controller::{NumberOf, ToolNumbers};
use crate::options::{Settings, TOOL_NUMBER};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::findings::Findings;
use vcutc_backend_api::ir::{Cell, Changer, ToolId};

/// The number under which the control keeps the length of a tool: that of its frame. One without a number is known by
/// its place.
pub(crate) fn number(cell: &Cell, settings: &Settings<'_>, id: ToolId) -> u32 {
    let tool = cell.tools.at(id);
    let of_place = match (settings.facts().number_of, cell.change.map(|change| change.by)) {
        // Whether or not the program needs another one: the table of the control is the same for all programs.
        (NumberOf::Tool, _) | (NumberOf::Edge, Some(Changer::Hand)) => tool.place,
        // The place says which tool is in the spindle, and the number only which of its edges.
        (NumberOf::Edge, Some(Changer::Program) | None) => None,
    };
    tool.frame.number.or(of_place).unwrap_or(settings.tool_number)
}

/// All that the control knows a tool by.
pub(crate) fn numbers(cell: &Cell, settings: &Settings<'_>, id: ToolId) -> ToolNumbers {
    ToolNumbers {
        place: cell.named_place(id),
        number: number(cell, settings, id),
    }
}

/// The tool that the control keeps under a number.
pub(crate) fn numbered(cell: &Cell, settings: &Settings<'_>, is: u32) -> Option<ToolId> {
    let mut tools = cell.tools.iter().map(|(id, _)| id);
    tools.find(|&id| number(cell, settings, id) == is)
}

/// Two tools must not have the same length in the control's table, except that of an edge where the tool is
/// chosen separately.
pub(crate) fn are_distinct(cell: &Cell, settings: &Settings<'_>, found: &mut Findings) {
    let number_alone = match (settings.facts().number_of, cell.changer()) {
        (NumberOf::Tool, _) | (NumberOf::Edge, Some(Changer::Hand)) => true,
        (NumberOf::Edge, Some(Changer::Program) | None) => false,
    };
    let is_taken = |id| numbered(cell, settings, number(cell, settings, id)) != Some(id);
    let twice = cell.tools.iter().map(|(id, _)| id).find(|&id| is_taken(id));
    if let Some(id) = twice.filter(|_| number_alone) {
        let why = format!(
            "two tools of the machine would have the {} {}; give each tool a frame with a number of its own, such as `number(2, frame(...))`",
            settings.facts().tool_number_name,
            number(cell, settings, id),
        );
        found.report(
            TOOL_NUMBER,
            BackendIssue::OptionConflict {
                key: TOOL_NUMBER,
                why,
            },
        );
    }
}
