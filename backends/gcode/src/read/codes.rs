//! Blocks that the job gives, because only the builder of the machine knows them.
//!
//! They are compared as texts, because only the job knows what they are for. One that has several
//! lines is there when its last line is.

use crate::codes::Role;
use crate::controller::Codes;
use crate::statement::{Code, Style};
use vcutc_backend_api::readback::normalized;

/// What a statement is to the blocks of the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// None of them.
    Nothing,
    /// A line of one of them, with more to come.
    Part(Role),
    /// The last line of one of them.
    Whole(Role),
}

/// The blocks, and how far each has been read.
pub(super) struct Given {
    blocks: Vec<GivenBlock>,
}

struct GivenBlock {
    role: Role,
    lines: Vec<String>,
    read: usize,
}

impl Given {
    /// Those of a job.
    pub(super) fn new(codes: Codes<'_>, style: Style) -> Self {
        let blocks = codes.all().into_iter().filter_map(|(role, lines)| {
            let lines = normalized_texts(lines, style);
            let read = 0;
            (!lines.is_empty()).then_some(GivenBlock { role, lines, read })
        });
        Self {
            blocks: blocks.collect(),
        }
    }

    /// Takes the next statement.
    pub(super) fn visit(&mut self, code: &str) -> Found {
        if !self.may_be(code) {
            for block in &mut self.blocks {
                block.read = 0;
            }
            return Found::Nothing;
        }
        let normalized = normalized(code);
        let mut found = Found::Nothing;
        for block in &mut self.blocks {
            found = match (block.visit(&normalized), found) {
                (Found::Nothing, found) | (Found::Part(_), found @ Found::Whole(_)) => found,
                (one, Found::Nothing | Found::Part(_)) => one,
                // Of two that end here the longer one is meant, and it was read first or is read now.
                (Found::Whole(_), found @ Found::Whole(_)) => found,
            };
        }
        found
    }

    /// Most statements are coordinates, and no block begins as they do.
    fn may_be(&self, code: &str) -> bool {
        let first = |text: &str| text.bytes().next().map(|byte| byte.to_ascii_uppercase());
        let lines = self.blocks.iter().flat_map(|block| &block.lines);
        lines.into_iter().any(|line| first(line) == first(code))
    }
}

impl GivenBlock {
    fn visit(&mut self, normalized: &str) -> Found {
        let is_line = |at: usize| self.lines.get(at).is_some_and(|line| line == normalized);
        self.read = if is_line(self.read) {
            self.read + 1
        } else {
            usize::from(is_line(0))
        };
        match self.read {
            0 => Found::Nothing,
            read if read == self.lines.len() => {
                self.read = 0;
                Found::Whole(self.role)
            }
            _ => Found::Part(self.role),
        }
    }
}

/// The statements among some lines, without layout.
pub(super) fn normalized_texts(lines: &[String], style: Style) -> Vec<String> {
    let codes = lines.iter().filter_map(|line| match style.code(line, 0) {
        Code::Is(_, code) => Some(normalized(code)),
        Code::None | Code::Broken(..) | Code::Active(_) => None,
    });
    codes.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(lines: &[&str]) -> Vec<String> {
        lines.iter().map(|&line| line.to_owned()).collect()
    }

    #[test]
    fn a_block_of_several_lines_is_there_with_its_last() {
        let (tcp_on, tcp_off) = (
            lines(&["M68 E3 Q1", "M66 E0 L0"]),
            lines(&["M68 E3 Q0", "M66 E0 L0"]),
        );
        let on = lines(&["M50"]);
        let codes = Codes {
            tcp_on: &tcp_on,
            tcp_off: &tcp_off,
            on: &on,
            off: &[],
            ready: &[],
        };
        let mut given = Given::new(codes, Style::Brackets);
        for (code, found) in [
            ("m68e3q1.0", Found::Part(Role::TcpOn)),
            ("M66 E0 L0", Found::Whole(Role::TcpOn)),
            ("M66 E0 L0", Found::Nothing),
            ("M68 E3 Q0", Found::Part(Role::TcpOff)),
            ("G1 X1", Found::Nothing),
            ("M66 E0 L0", Found::Nothing),
            ("M050", Found::Whole(Role::On)),
            ("M51", Found::Nothing),
        ] {
            assert_eq!(given.visit(code), found, "{code}");
        }
    }
}
