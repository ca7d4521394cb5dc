//! Changes of the blade: the call of the cell's routine or a stop for a person, and what is set up after it.

use crate::dialect::KrlDialect;
use crate::names::is_name;
use crate::options::{CHANGE_ROUTINE, Settings};
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::findings::Findings;
use vcutc_backend_api::ir::{Cell, Changer};
use vcutc_backend_api::script::{Dialect, ToolChange, Written};

impl KrlDialect<'_, '_, '_> {
    /// Everything between the move to the change place and the next one: the change, and all that a part says at its head. The
    /// controller plans ahead: `HALT` and the assignment of `$TOOL` stop that [K-SI], so that no motion is planned with the tool
    /// of the one before.
    pub(crate) fn put_in(&mut self, change: &ToolChange<'_>) -> Written {
        match change.place {
            Some(place) => {
                let routine = self.settings.change_routine;
                self.text.line(&format!("{routine}({place})"))?;
            }
            None => {
                self.comment("put in blade ", change.blade)?;
                self.text.line("HALT")?;
            }
        }
        // The routine, or whoever moved the robot meanwhile, may leave other frames, modes and speeds.
        self.motion_setup(change.id)?;
        self.said.rates = None;
        let later = change.op.0 as usize..self.source.program().ops.len();
        let turning = later.into_iter().find_map(|index| self.turns.at(index));
        self.turn_rates(turning)
    }
}

/// The routine must have a name where it is called.
pub(crate) fn routine(cell: &Cell, settings: &Settings<'_>, found: &mut Findings) {
    let calls = cell.changer() == Some(Changer::Program);
    let name = settings.change_routine;
    let key = CHANGE_ROUTINE;
    if calls && name.is_empty() {
        let why =
            "the blade is changed by a routine of the cell, and nothing says what it is called".to_owned();
        found.report(key, BackendIssue::OptionConflict { key, why });
    } else if !name.is_empty() && !is_name(name) {
        let why = format!(
            "`{name}` is not the name of a routine: a letter, then letters, digits and `_`, at most 24 in all, and no word of KRL"
        );
        found.report(key, BackendIssue::OptionConflict { key, why });
    }
}
