//! Which tool a program has at hand.

use super::setup::Wanted;
use crate::syntax::is_same_name;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Changer, PlacedFrame, ToolId};
use vcutc_backend_api::readback::FrameSetting;

/// The place that a call of the cell's routine names, if it is one.
pub(super) fn called(wanted: Wanted<'_>, name: &str, arguments: &str) -> Option<u32> {
    let is_it =
        wanted.cell.changer() == Some(Changer::Program) && is_same_name(name, wanted.settings.change_routine);
    arguments.parse().ok().filter(|_| is_it)
}

/// Whether a stop of the program is for a person who changes the blade.
pub(super) fn are_changed_by_hand(wanted: Wanted<'_>) -> bool {
    wanted.cell.changer() == Some(Changer::Hand)
}

/// The tool with a frame as it is printed.
pub(super) fn of_frame(wanted: Wanted<'_>, setting: &FrameSetting) -> Option<ToolId> {
    let is_it = |should: &PlacedFrame| match (*setting, should.number) {
        (FrameSetting::Number(is), Some(number)) => is == number,
        (FrameSetting::Value(is), None) => is_near(&is, &should.frame, wanted),
        (FrameSetting::Number(_) | FrameSetting::Value(_), _) => false,
    };
    let mut tools = wanted.cell.tools.iter();
    tools.find(|(_, tool)| is_it(&tool.frame)).map(|(id, _)| id)
}

/// Twice of what is lost in print, so that rounding never decides.
fn is_near(is: &Frame, should: &Frame, wanted: Wanted<'_>) -> bool {
    let settings = wanted.settings;
    let (way, turn) = (settings.common.lengths.half_unit(), settings.angles.half_unit());
    is.origin.distance(should.origin).to_mm() <= 4.0 * way
        && is.orientation.angle_to(should.orientation).to_deg() <= 6.0 * turn
}
