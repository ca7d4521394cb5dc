//! Lines of the machine's profile, which stand in the main program as they are and are not understood.

use super::codes::essences;
use super::lines::{Code, Style};
use super::tongue;
use crate::dialect::Controller;
use crate::options::Settings;
use vcutc_backend_api::readback::essence;

/// The statement of a line that is to be one block as it stands, empty for a comment. None where the control would read
/// something else into it: a number of its own, a comment in front, signs that mean something even in comments.
pub(crate) fn statement_of_line(line: &str, controller: Controller) -> Option<&str> {
    let is_sign = |byte: &u8| !matches!(byte, b'(' | b')');
    let signs: Vec<u8> = controller.dialect().layout().kept_out_of_comments.to_vec();
    let has_sign = |byte| {
        signs
            .iter()
            .filter(|sign| is_sign(sign))
            .any(|sign| *sign == byte)
    };
    if line.bytes().any(has_sign) {
        return None;
    }
    let line = line.trim();
    let style = tongue::of(controller).style();
    match style.code(line, 0) {
        Code::Is(span, code) => (span.start == 0).then_some(code),
        Code::None => line.starts_with(['(', ';', '*']).then_some(""),
        Code::Broken(..) | Code::Active(_) => None,
    }
}

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
            header: essences(&settings.common.profile.header, style),
            footer: essences(&settings.common.profile.footer, style),
            stage: Stage::Head,
        }
    }

    /// Whether a statement of the main program is one of them; then it is used up.
    pub(super) fn takes(&mut self, code: &str) -> bool {
        let take = |lines: &mut Vec<String>| {
            let is = lines.iter().position(|line| *line == essence(code));
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
