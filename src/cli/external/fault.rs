//! What an outside program did instead of its work, in words that can be shown.

use vcutc_backend_api::backend::Fault;
use vcutc_backend_api::ir::OpId;

/// Most lines of a program's own words that are shown.
const MOST_LINES: usize = 5;

/// Most letters of a line that comes from a program.
const MOST_LETTERS: usize = 200;

/// A fault; `what` stands after "the program".
pub(super) fn fault(what: impl Into<String>) -> Fault {
    Fault {
        op: None,
        what: what.into(),
        said: Vec::new(),
    }
}

/// A fault about one op.
pub(super) fn fault_at(op: OpId, what: impl Into<String>) -> Fault {
    Fault {
        op: Some(op),
        ..fault(what)
    }
}

/// The end of what a program wrote to standard error, line by line.
pub(super) fn last_lines(bytes: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<String> = text.lines().map(line).filter(|line| !line.is_empty()).collect();
    let first = lines.len().saturating_sub(MOST_LINES);
    lines.get(first..).unwrap_or_default().to_vec()
}

/// A text of a program as it can be shown in one line of a terminal.
pub(super) fn line(text: &str) -> String {
    let shown = |letter: char| if letter.is_control() { ' ' } else { letter };
    let mut letters = text.trim().chars().map(shown);
    let mut line: String = letters.by_ref().take(MOST_LETTERS).collect();
    if letters.next().is_some() {
        line.push_str("...");
    }
    line
}
