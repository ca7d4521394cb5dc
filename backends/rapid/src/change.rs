//! Changes of the blade: the call of the cell's routine, or a stop for a person. The moves after it name another tool.

use crate::dialect::RapidDialect;
use crate::names::is_name;
use crate::options::{CHANGE_ROUTINE, Settings, TOOL_NAME};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::findings::Findings;
use vcutc_backend_api::ir::{Cell, Changer};
use vcutc_backend_api::script::{Dialect, ToolChange, Written};

/// Longest text on a line of the pendant [A-INS].
const LONGEST_TEXT: usize = 40;

impl RapidDialect<'_, '_, '_> {
    /// Every move before this ends in a stop point, so that the arm stands.
    pub(crate) fn put_in(&mut self, change: &ToolChange<'_>) -> Written {
        match change.place {
            Some(place) => {
                let routine = self.settings.given(CHANGE_ROUTINE).unwrap_or_default();
                self.begin(b"");
                self.text.line(&format!("{routine} {place};"))?;
                // The routine may leave other modes.
                self.modes()
            }
            None => {
                self.comment("put in blade ", change.blade)?;
                self.begin(b"TPWrite \"");
                self.text.put(request(change).as_bytes());
                self.text.line("\";")?;
                self.begin(b"Stop;");
                Ok(self.text.line("")?)
            }
        }
    }
}

/// What the pendant asks of the person: the name of the blade, where a text of RAPID can have it.
fn request(change: &ToolChange<'_>) -> String {
    let text = format!("Put in blade {}", change.blade);
    let is_plain = text
        .bytes()
        .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b' ');
    if is_plain && text.len() <= LONGEST_TEXT {
        text
    } else {
        format!("Put in blade {}", u32::from(change.id.0) + 1)
    }
}

/// The routine must have a name where it is called, and one name is not that of several tools.
pub(crate) fn names(cell: &Cell, settings: &Settings<'_>, findings: &mut Findings) {
    let mut conflict = |key, why: String| findings.report(key, BackendIssue::OptionConflict { key, why });
    let calls = cell.changer() == Some(Changer::Program);
    match settings.given(CHANGE_ROUTINE) {
        None if calls => conflict(
            CHANGE_ROUTINE,
            "the blade is changed by a routine of the cell, and nothing says what it is called".to_owned(),
        ),
        Some(name) if !is_name(name) => conflict(
            CHANGE_ROUTINE,
            format!(
                "`{name}` is not the name of a routine: a letter, then letters, digits and `_`, at most 32 in all, and no word of \
                 RAPID"
            ),
        ),
        Some(_) | None => {}
    }
    if cell.tools.are_several() && settings.given(TOOL_NAME).is_some() {
        conflict(TOOL_NAME, "the program has several tools".to_owned());
    }
}
