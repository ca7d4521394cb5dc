//! `vcutc explain`: the pages of the diagnostic codes, as they are where another program reads them, for people on a terminal.

mod page;

use super::Exit;
use super::console::{Console, Failure};
use std::env;
use std::fmt::Write;
use std::io::{self, IsTerminal};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Severity};

/// Prints the page of a code, or the list of all.
pub(super) fn explain(code: Option<&str>, console: &Console) -> Exit {
    match code {
        None => console.document(&list()),
        Some(text) => match find(text) {
            Some(code) if io::stdout().is_terminal() => console.document(&page::plain(code.page(), width())),
            Some(code) => console.document(code.page()),
            None => console.failure(&unknown(text)),
        },
    }
}

/// Most columns of a page: longer lines are hard to read.
const WIDEST: usize = 100;
/// Columns of a terminal that does not say.
const USUAL: usize = 80;

/// How wide pages are on this terminal.
fn width() -> usize {
    let columns = env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    columns.unwrap_or(USUAL).clamp(40, WIDEST)
}

/// The code that people mean by `VC0203`, `vc0203`, `0203` or `203`.
fn find(text: &str) -> Option<Code> {
    let text = text.trim();
    let is_number = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if is_number {
        Code::from_number(&format!("VC{text:0>4}"))
    } else {
        Code::from_number(text)
    }
}

fn unknown(text: &str) -> Failure {
    let failure = Failure::new(format!("there is no diagnostic code `{text}`"));
    let failure = match nearest(text, Code::ALL.iter().map(|code| code.number())).first() {
        Some(number) => failure.help(format!("did you mean `{number}`?")),
        None => failure,
    };
    failure.help("run `vcutc explain` for the list of all codes")
}

fn list() -> String {
    let mut text = String::new();
    for code in Code::ALL {
        let severity = match code.severity() {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}  {severity:<8} {}", code.number(), code.title());
    }
    text.push_str("\nRun `vcutc explain CODE` for its meaning and how to fix it.\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_found_in_every_spelling() {
        for spelling in ["VC0203", "vc0203", "0203", "203", " VC0203 "] {
            assert_eq!(find(spelling), Some(Code::WrongDimension), "{spelling}");
        }
        for spelling in ["", "VC", "0", "99999", "VC02033", "²"] {
            assert_eq!(find(spelling), None, "{spelling}");
        }
    }

    #[test]
    fn the_list_names_every_code_once() {
        let list = list();
        for code in Code::ALL {
            let lines = list.lines().filter(|line| line.starts_with(code.number()));
            assert_eq!(lines.count(), 1, "{}", code.number());
        }
    }
}
