//! Lines of the machine's profile, which stand in the main program as they are and are not understood.

use super::codes::normalized_texts;
use crate::options::Settings;
use crate::statement::Style;
use vcutc_backend_api::readback::normalized;

/// Those that are still to come.
pub(super) struct OfProfile {
    header: Vec<String>,
    footer: Vec<String>,
    pub(super) stage: Stage,
}

/// How far the program is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// Nothing has been done.
    Head,
    /// Between the first thing done and the lines at the end.
    Body,
    /// A line at the end has been read.
    Foot,
}

impl OfProfile {
    pub(super) fn new(settings: &Settings<'_>, style: Style) -> Self {
        Self {
            header: normalized_texts(&settings.common.profile.header, style),
            footer: normalized_texts(&settings.common.profile.footer, style),
            stage: Stage::Head,
        }
    }

    /// Whether a statement of the main program is one of them; then it is used up.
    pub(super) fn takes(&mut self, code: &str) -> bool {
        let take = |lines: &mut Vec<String>| {
            let is = lines.iter().position(|line| *line == normalized(code));
            is.map(|at| lines.remove(at)).is_some()
        };
        if self.stage == Stage::Head && take(&mut self.header) {
            return true;
        }
        let is_foot = take(&mut self.footer);
        if is_foot {
            self.stage = Stage::Foot;
        }
        is_foot
    }
}
