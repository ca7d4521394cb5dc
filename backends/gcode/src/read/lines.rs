//! Lines of a file, and what of a line is statement.

/// A stretch of bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    /// First byte.
    pub(super) start: usize,
    /// One past the last byte.
    pub(super) end: usize,
}

/// What comments and block numbers look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// `( )` and `;`, numbers behind N.
    Brackets,
    /// `;`, numbers behind N. Brackets have a meaning.
    Semicolon,
    /// `;`, and lines that begin with `*`; every line has a number.
    Numbered,
}

/// What of a line is statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Code<'t> {
    /// Nothing: it is blank, or a comment.
    None,
    /// This, without number and outer comments.
    Is(Span, &'t str),
    /// A comment begins and does not end.
    Open(Span),
    /// A comment that LinuxCNC carries out: it stops the program, runs another, or writes files.
    Active(Span),
}

/// How such comments begin, in small letters [L-OV].
const ACTIVE: [&str; 8] = [
    "abort,",
    "py,",
    "probeopen",
    "probeclose",
    "logopen",
    "logappend",
    "logclose",
    "log,",
];

/// The line that begins at a byte, and where the next one begins. None at the end of the text.
pub(super) fn line(text: &str, start: usize) -> Option<(&str, usize)> {
    let rest = text.get(start..)?;
    if rest.is_empty() {
        return None;
    }
    let end = rest.bytes().position(|byte| matches!(byte, b'\n' | b'\r'));
    let end = end.unwrap_or(rest.len());
    Some((rest.get(..end)?, start + (end + 1).min(rest.len())))
}

impl Style {
    /// The statement of a line that begins at a byte of its text.
    pub(super) fn code(self, line: &str, start: usize) -> Code<'_> {
        let whole = || {
            let (from, to) = trimmed(line);
            Span {
                start: start + from,
                end: start + to,
            }
        };
        let Some((from, to)) = self.bounds(line) else {
            return Code::Open(whole());
        };
        if self == Self::Brackets && has_active_comment(line) {
            return Code::Active(whole());
        }
        let code = line.get(from..to).unwrap_or_default();
        let number = self.number(code);
        let behind = code.get(number..).unwrap_or_default();
        // A comment may stand between number and statement.
        let (inner, to) = match self.bounds(behind) {
            Some((inner, end)) => (number + inner, number + end),
            None => (number, code.len()),
        };
        let code = code.get(inner..to).unwrap_or_default();
        let is_heading = self == Self::Numbered && code.starts_with('*');
        if code.is_empty() || is_heading {
            return Code::None;
        }
        let span = Span {
            start: start + from + inner,
            end: start + from + to,
        };
        Code::Is(span, code)
    }

    /// Where the first byte stands that is neither blank nor comment, and one past the last. None when a comment does not
    /// end.
    fn bounds(self, line: &str) -> Option<(usize, usize)> {
        let mut first = line.len();
        let mut last = 0;
        let mut at = 0;
        let mut quoted = false;
        let bytes = line.as_bytes();
        while let Some(&byte) = bytes.get(at) {
            match (self, byte) {
                (Self::Brackets, b'(') => {
                    let rest = bytes.get(at..)?;
                    at += rest.iter().position(|&byte| byte == b')')? + 1;
                    continue;
                }
                (_, b';') if !quoted => break,
                (Self::Semicolon, b'"') => quoted = !quoted,
                (_, _) => {}
            }
            if !byte.is_ascii_whitespace() {
                first = first.min(at);
                last = at + 1;
            }
            at += 1;
        }
        Some((first.min(last), last))
    }

    /// How many bytes the number of a block takes.
    fn number(self, code: &str) -> usize {
        let digits_from = match self {
            Self::Numbered => 0,
            Self::Brackets | Self::Semicolon if code.starts_with(['N', 'n']) => 1,
            Self::Brackets | Self::Semicolon => return 0,
        };
        let rest = code.get(digits_from..).unwrap_or_default();
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        match rest.as_bytes().get(digits) {
            // `N1=5` is a value, and `12X` no number of a line.
            Some(b'=' | b'.') => 0,
            _ if digits == 0 => 0,
            _ => digits_from + digits,
        }
    }
}

/// Whether a line has a comment that is carried out.
fn has_active_comment(line: &str) -> bool {
    let comments = line.split(['(', ';']).skip(1);
    comments.map(str::trim_ascii_start).any(|comment| {
        let begins = |word: &&str| {
            let start = comment.get(..word.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(word))
        };
        ACTIVE.iter().any(begins)
    })
}

fn trimmed(line: &str) -> (usize, usize) {
    let from = line.len() - line.trim_ascii_start().len();
    (from, line.trim_ascii_end().len().max(from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn code(style: Style, line: &str) -> Option<&str> {
        match style.code(line, 0) {
            Code::None => None,
            Code::Is(span, code) => {
                assert_eq!(line.get(span.start..span.end), Some(code));
                Some(code)
            }
            Code::Open(_) => Some("open"),
            Code::Active(_) => Some("active"),
        }
    }

    #[test]
    fn numbers_and_comments_are_no_statement() {
        for (style, line, is) in [
            (Style::Brackets, "", None),
            (Style::Brackets, " (only words) ; more", None),
            (Style::Brackets, "N10", None),
            (Style::Brackets, "N10 (words)", None),
            (Style::Brackets, "n010 G1 X1. (a) ; b", Some("G1 X1.")),
            (Style::Brackets, "(a) N10 (b) G1", Some("G1")),
            (Style::Brackets, "G1 (a) X1.", Some("G1 (a) X1.")),
            (Style::Brackets, "G1 (a", Some("open")),
            (Style::Brackets, "G1 ( Abort, now) X1", Some("active")),
            (Style::Brackets, "G1 X1 ;py,run()", Some("active")),
            (Style::Brackets, "(abort it)", None),
            (Style::Semicolon, "N5 FGROUP(X,Y,Z) ; all", Some("FGROUP(X,Y,Z)")),
            (Style::Semicolon, "MSG(\"a;b\")", Some("MSG(\"a;b\")")),
            (Style::Semicolon, "N1=5", Some("N1=5")),
            (Style::Numbered, "12 L X+1 ; here", Some("L X+1")),
            (Style::Numbered, "12 ; here", None),
            (Style::Numbered, "12 * - heading", None),
            (Style::Numbered, "L X+1", Some("L X+1")),
        ] {
            assert_eq!(code(style, line), is, "{line}");
        }
    }

    #[test]
    fn lines_end_as_every_system_ends_them() {
        let text = "a\r\nb\rc\n";
        let mut lines = Vec::new();
        let mut at = 0;
        while let Some((line, next)) = line(text, at) {
            lines.push(line);
            at = next;
        }
        assert_eq!(lines, ["a", "", "b", "c"]);
    }

    proptest! {
        #[test]
        fn every_line_has_an_answer(text in any::<String>()) {
            for style in [Style::Brackets, Style::Semicolon, Style::Numbered] {
                let mut at = 0;
                while let Some((one, next)) = line(&text, at) {
                    prop_assert!(next > at);
                    match style.code(one, at) {
                        Code::Is(span, code) => prop_assert_eq!(text.get(span.start..span.end), Some(code)),
                        Code::Open(span) | Code::Active(span) => prop_assert!(text.get(span.start..span.end).is_some()),
                        Code::None => {}
                    }
                    at = next;
                }
                prop_assert_eq!(at, text.len());
            }
        }
    }
}
