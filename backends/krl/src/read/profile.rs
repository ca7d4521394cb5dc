//! The lines of a machine's profile, which stand in the program as they are and are not understood.

use crate::syntax::{Phrase, Span, statements};
use vcutc_backend_api::readback::normalized;

/// What the statements among some lines are, without layout.
fn normalized_texts(lines: &[String]) -> Vec<String> {
    let statements = lines.iter().filter_map(|line| statements(line).next());
    statements.map(|statement| normalized(statement.text)).collect()
}

/// The lines at the head of the main routine, of which the first still to come is known.
#[derive(Debug)]
pub(super) struct Header {
    lines: Vec<String>,
    next: usize,
}

impl Header {
    pub(super) fn new(lines: &[String]) -> Self {
        Self {
            lines: normalized_texts(lines),
            next: 0,
        }
    }

    /// Whether a statement is the next of them; then it is used up.
    pub(super) fn takes(&mut self, code: &str) -> bool {
        let is_next = self
            .lines
            .get(self.next)
            .is_some_and(|line| *line == normalized(code));
        if is_next {
            self.next += 1;
        }
        is_next
    }
}

/// Where the lines at the end of a routine begin: in front of its `END`, all of them in order. None when they are not
/// there, or when there are none.
pub(super) fn footer(text: &str, routine: Span, lines: &[String]) -> Option<usize> {
    let lines = normalized_texts(lines);
    if lines.is_empty() {
        return None;
    }
    let mut expected = lines.iter().rev();
    let mut end = routine.end;
    let mut ended = false;
    while end > routine.start {
        let before = text.get(routine.start..end)?;
        let inner = before.strip_suffix('\n').unwrap_or(before);
        let start = routine.start + inner.rfind('\n').map_or(0, |at| at + 1);
        let last = statements(text.get(start..end)?).next();
        end = start;
        let Some(last) = last else { continue };
        if !ended {
            if last.phrase != Phrase::End {
                return None;
            }
            ended = true;
        } else if expected.next().is_none_or(|line| *line != normalized(last.text)) {
            return None;
        } else if expected.len() == 0 {
            return Some(start);
        }
    }
    None
}
