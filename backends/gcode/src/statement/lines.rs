//! Lines of a file, and what of a line is statement.

/// A stretch of bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// First byte.
    pub(crate) start: usize,
    /// One past the last byte.
    pub(crate) end: usize,
}

/// What comments and block numbers look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// `( )` and `;`, numbers after N.
    Brackets,
    /// `( )`, numbers after N; `;` ends the block.
    Blocks,
    /// `;`, numbers after N. Brackets have a meaning.
    Semicolon,
    /// `;`, and lines that begin with `*`; every line has a number.
    Numbered,
}

/// What of a line is statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code<'t> {
    /// Nothing: it is blank, or a comment.
    None,
    /// This, without number and outer comments.
    Is(Span, &'t str),
    /// The control does not accept the line, and expects this instead.
    Broken(Span, &'static str),
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
///
/// LF or CR LF ends a line. A CR alone ends it for some controls and is a blank to others, so it stays in the line, which it
/// breaks.
pub(crate) fn line(text: &str, start: usize) -> Option<(&str, usize)> {
    let rest = text.get(start..)?;
    if rest.is_empty() {
        return None;
    }
    let (line, next) = match rest.bytes().position(|byte| byte == b'\n') {
        Some(end) => {
            let line = rest.get(..end)?;
            (line.strip_suffix('\r').unwrap_or(line), end + 1)
        }
        None => (rest, rest.len()),
    };
    Some((line, start + next))
}

/// What a line may not hold, whatever its dialect: controls end a text there, end the line, or stop.
fn unprintable(line: &str) -> Option<&'static str> {
    let control = line
        .bytes()
        .find(|byte| byte.is_ascii_control() && *byte != b'\t')?;
    Some(match control {
        b'\r' => "lines that end with LF or CR LF",
        _ => "a line without control characters",
    })
}

impl Style {
    /// What begins and ends a comment that is written.
    pub(crate) const fn comment_signs(self) -> [&'static str; 2] {
        match self {
            Self::Brackets | Self::Blocks => ["(", ")"],
            Self::Semicolon | Self::Numbered => ["; ", ""],
        }
    }

    /// The statement of a line that begins at a byte of its text.
    pub(crate) fn code(self, line: &str, start: usize) -> Code<'_> {
        let whole = || {
            let (from, to) = trimmed(line);
            Span {
                start: start + from,
                end: start + to,
            }
        };
        let bounds = unprintable(line).map_or_else(|| self.bounds(line), Err);
        let (from, to) = match bounds {
            Ok(bounds) => bounds,
            Err(expected) => return Code::Broken(whole(), expected),
        };
        if self == Self::Brackets && has_active_comment(line) {
            return Code::Active(whole());
        }
        let code = line.get(from..to).unwrap_or_default();
        let number = self.number(code);
        let after = code.get(number..).unwrap_or_default();
        // A comment may stand between number and statement.
        let (inner, to) = match self.bounds(after) {
            Ok((inner, end)) => (number + inner, number + end),
            Err(_) => (number, code.len()),
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

    /// Where the first byte stands that is neither blank nor comment, and one past the last.
    ///
    /// # Errors
    /// What is expected where a comment, or a block, does not end as it should.
    fn bounds(self, line: &str) -> Result<(usize, usize), &'static str> {
        let mut first = line.len();
        let mut last = 0;
        let mut at = 0;
        let mut quoted = false;
        let bytes = line.as_bytes();
        while let Some(&byte) = bytes.get(at) {
            match (self, byte) {
                (Self::Brackets | Self::Blocks, b'(') => {
                    at += self.comment(line.get(at..).unwrap_or_default())?;
                    continue;
                }
                (Self::Blocks, b';') => {
                    let after = line.get(at + 1..).unwrap_or_default();
                    if after.trim_ascii().is_empty() {
                        break;
                    }
                    return Err("the end of the line after `;`, which ends a block");
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
        Ok((first.min(last), last))
    }

    /// How many bytes the comment in brackets takes with which a text begins.
    fn comment(self, text: &str) -> Result<usize, &'static str> {
        let length = text.find(')').ok_or("the end of the comment")?;
        let inside = text.get(1..length).unwrap_or_default();
        match self {
            Self::Brackets | Self::Blocks if inside.contains('(') => Err("a comment without `(` inside"),
            Self::Blocks if inside.contains(';') => Err("a comment without `;`, which ends a block"),
            Self::Brackets | Self::Blocks | Self::Semicolon | Self::Numbered => Ok(length + 1),
        }
    }

    /// How many bytes the number of a block takes.
    fn number(self, code: &str) -> usize {
        let digits_from = match self {
            Self::Numbered => 0,
            Self::Brackets | Self::Blocks | Self::Semicolon if code.starts_with(['N', 'n']) => 1,
            Self::Brackets | Self::Blocks | Self::Semicolon => return 0,
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

    const STYLES: [Style; 4] = [Style::Brackets, Style::Blocks, Style::Semicolon, Style::Numbered];

    fn code(style: Style, line: &str) -> Option<&str> {
        match style.code(line, 0) {
            Code::None => None,
            Code::Is(span, code) => {
                assert_eq!(line.get(span.start..span.end), Some(code));
                Some(code)
            }
            Code::Broken(_, expected) => Some(expected),
            Code::Active(_) => Some("active"),
        }
    }

    #[test]
    fn numbers_and_comments_are_not_statements() {
        for (style, line, is) in [
            (Style::Brackets, "", None),
            (Style::Brackets, " (only words) ; more", None),
            (Style::Brackets, "N10", None),
            (Style::Brackets, "N10 (words)", None),
            (Style::Brackets, "n010 G1 X1. (a) ; b", Some("G1 X1.")),
            (Style::Brackets, "(a) N10 (b) G1", Some("G1")),
            (Style::Brackets, "G1 (a) X1.", Some("G1 (a) X1.")),
            (Style::Brackets, "G1 (a", Some("the end of the comment")),
            (
                Style::Brackets,
                "G1 (a (b) X1.",
                Some("a comment without `(` inside"),
            ),
            (Style::Brackets, "G1 (a ; b) X1. ; (c", Some("G1 (a ; b) X1.")),
            (
                Style::Brackets,
                "G1 X1. \u{0} Y2",
                Some("a line without control characters"),
            ),
            (
                Style::Brackets,
                "G1 X1. ; \u{c}",
                Some("a line without control characters"),
            ),
            (Style::Brackets, "G1\tX1.", Some("G1\tX1.")),
            (Style::Blocks, "N10 G1 (a) X1. ; ", Some("G1 (a) X1.")),
            (Style::Blocks, ";", None),
            (
                Style::Blocks,
                "G1 X8. ; G0 Z-20.",
                Some("the end of the line after `;`, which ends a block"),
            ),
            (
                Style::Blocks,
                "; (words)",
                Some("the end of the line after `;`, which ends a block"),
            ),
            (
                Style::Blocks,
                "G1 (a; b) X8.",
                Some("a comment without `;`, which ends a block"),
            ),
            (
                Style::Blocks,
                "G1 (a (b) X8.",
                Some("a comment without `(` inside"),
            ),
            (Style::Blocks, "G1 (a", Some("the end of the comment")),
            (Style::Semicolon, "G1 (a", Some("G1 (a")),
            (Style::Numbered, "3 L (a) X+1", Some("L (a) X+1")),
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
    fn lines_end_with_lf_or_cr_lf() {
        let text = "a\r\n\r\nb\nc\r";
        let mut lines = Vec::new();
        let mut at = 0;
        while let Some((line, next)) = line(text, at) {
            lines.push(line);
            at = next;
        }
        assert_eq!(lines, ["a", "", "b", "c\r"]);
    }

    #[test]
    fn a_cr_alone_is_read_in_two_ways() {
        for style in STYLES {
            for line in ["; off\rG1 X8.7", "G1 X8.7\rG1 X9", "G1 X8.7\r", "(a\r)", "\r"] {
                assert_eq!(
                    code(style, line),
                    Some("lines that end with LF or CR LF"),
                    "{line:?}"
                );
            }
        }
    }

    proptest! {
        #[test]
        fn every_line_has_an_answer(text in any::<String>()) {
            for style in STYLES {
                let mut at = 0;
                while let Some((one, next)) = line(&text, at) {
                    prop_assert!(next > at);
                    match style.code(one, at) {
                        Code::Is(span, code) => prop_assert_eq!(text.get(span.start..span.end), Some(code)),
                        Code::Broken(span, _) | Code::Active(span) => prop_assert!(text.get(span.start..span.end).is_some()),
                        Code::None => {}
                    }
                    at = next;
                }
                prop_assert_eq!(at, text.len());
            }
        }
    }
}
