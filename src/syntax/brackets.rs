//! Brackets, quotes and comments: checked and balanced before the grammar sees the text.
//!
//! A lost bracket is the mistake that spoils everything after it, and a grammar can only say that the file ended too
//! soon. So a look at the tokens comes first. When all is balanced nothing happens. When it is not, the tokens are gone
//! through again, and this time the indentation is believed: a line that begins no further in than the line of an open
//! bracket shows that the bracket should have been closed before. The result is a copy of the text, of the same length
//! up to closing brackets at its end, in which all brackets are balanced, so that the rest can be read.

use super::lexical::{Bracket, Token, TokenKind, tokens};
use super::reports::Reports;
use std::ops::Range;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_diagnostics::{Code, Diagnostic, Edit, Fix};

/// How deep brackets can be nested. Bounds all recursion of this stage and the next ones.
pub(super) const DEEPEST: usize = 64;

/// A text with balanced brackets, and what was wrong with it before.
#[derive(Debug)]
pub(super) struct Balanced {
    /// The text, byte for byte where it was, with blanks for what was taken out.
    pub(super) text: String,
    /// What was wrong, in the order found.
    pub(super) reports: Reports,
    /// Stretches that were corrected by guess: what cannot be read there has been reported already.
    pub(super) doubtful: Vec<Range<usize>>,
}

/// Balances the brackets of `text`.
pub(super) fn balance(file: FileId, text: &str) -> Balanced {
    let strict = Scan::run(file, text, Trust::Brackets);
    let scan = if strict.is_matched {
        strict
    } else {
        Scan::run(file, text, Trust::Indentation)
    };
    let balanced = scan.finish();
    if balanced.text == text {
        return balanced;
    }
    settle(file, balanced)
}

/// Repeats the repair until the text does not change any more. Where something was taken out, a number and a
/// quote may have become neighbours, which then read as inches, or a value and a bracket. Such a place has
/// been reported already.
fn settle(file: FileId, mut balanced: Balanced) -> Balanced {
    for _ in 0..MOST_ROUNDS {
        let again = Scan::run(file, &balanced.text, Trust::Brackets).finish();
        if again.text == balanced.text {
            return balanced;
        }
        balanced.doubtful.extend(again.doubtful);
        balanced.text = again.text;
    }
    let is_structure = |c: char| matches!(c, '(' | ')' | '{' | '}' | '"' | '/');
    balanced.text = balanced.text.replace(is_structure, " ");
    balanced.doubtful.push(0..balanced.text.len());
    balanced
}

/// Most repetitions of the repair, which bounds the work on hostile texts. After the last one all brackets
/// and quotes are taken out.
const MOST_ROUNDS: usize = 8;

/// Inches in mm, exact to a nanometre (1 in = 25.4 mm, international yard and pound agreement, 1959).
fn in_mm(inches: f64) -> String {
    let text = format!("{:.6}", inches * 25.4);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// What is believed when brackets do not match.
#[derive(Clone, Copy, PartialEq)]
enum Trust {
    /// The brackets alone.
    Brackets,
    /// The indentation, where it says where a bracket is missing.
    Indentation,
}

/// Going through the tokens once.
struct Scan<'t> {
    file: FileId,
    text: &'t str,
    trust: Trust,
    mended: Vec<u8>,
    open: Vec<(Bracket, Token)>,
    /// Where brackets became too deep, and how many more are open since.
    too_deep: Option<(usize, usize)>,
    /// Whether each bracket has its partner so far.
    is_matched: bool,
    /// The token before, comments left out.
    previous: Option<Token>,
    before_previous: Option<Token>,
    /// Where the last block of the file ended.
    last_end: usize,
    reports: Reports,
    doubtful: Vec<Range<usize>>,
}

impl<'t> Scan<'t> {
    fn run(file: FileId, text: &'t str, trust: Trust) -> Self {
        let mut scan = Self {
            file,
            text,
            trust,
            mended: text.as_bytes().to_vec(),
            open: Vec::new(),
            too_deep: None,
            is_matched: true,
            previous: None,
            before_previous: None,
            last_end: 0,
            reports: Reports::default(),
            doubtful: Vec::new(),
        };
        // A byte order mark is not a character of the text.
        if text.starts_with('\u{feff}') {
            scan.blank(0..3);
        }
        for token in tokens(text).skip_while(|token| scan_starts_with_mark(text, *token)) {
            scan.token(token);
        }
        scan.end();
        scan
    }

    fn span(&self, range: Range<usize>) -> Span {
        Span::of_bytes(self.file, range)
    }

    fn slice(&self, token: Token) -> &'t str {
        self.text.get(token.start..token.end).unwrap_or_default()
    }

    fn blank(&mut self, range: Range<usize>) {
        if let Some(bytes) = self.mended.get_mut(range) {
            for byte in bytes {
                if !matches!(byte, b'\n' | b'\r') {
                    *byte = b' ';
                }
            }
        }
    }

    fn token(&mut self, token: Token) {
        match token.kind {
            TokenKind::Comment => return,
            TokenKind::UnclosedComment => {
                self.unclosed_comment(token);
                return;
            }
            TokenKind::Open(_) if self.too_deep.is_some() => self.deeper(1),
            TokenKind::Close(_) if self.too_deep.is_some() => self.shallower(token),
            TokenKind::Open(bracket) => {
                self.believe_indentation(token);
                self.opened(bracket, token);
            }
            TokenKind::Close(bracket) => self.closed(bracket, token),
            TokenKind::UnclosedText => {
                self.believe_indentation(token);
                self.unclosed_text(token);
            }
            TokenKind::Text => {
                self.believe_indentation(token);
                self.escapes(token);
            }
            TokenKind::InchMark => self.inch_mark(token),
            TokenKind::Word | TokenKind::Number | TokenKind::Symbol => self.believe_indentation(token),
        }
        self.before_previous = self.previous;
        self.previous = Some(token);
    }

    fn opened(&mut self, bracket: Bracket, token: Token) {
        if let (Bracket::Round, true, Some(&(Bracket::Round, opener))) =
            (bracket, self.follows_value(), self.open.last())
        {
            self.open.pop();
            self.unclosed(Bracket::Round, opener, Some(token));
        }
        if self.open.len() < DEEPEST {
            self.open.push((bracket, token));
            return;
        }
        self.too_deep = Some((token.start, 1));
        self.reports.push(
            Diagnostic::new(
                Code::NestedTooDeeply,
                format!("brackets are nested more than {DEEPEST} deep"),
                self.span(token.start..token.end),
                format!("this is bracket number {}", DEEPEST + 1),
            )
            .help("name the inner part with `let`, or delete unnecessary brackets"),
        );
    }

    /// Whether the last token ends a number or its unit, after which no bracket opens: `40 mm (`.
    fn follows_value(&self) -> bool {
        let kind = |token: Option<Token>| token.map(|token| token.kind);
        match (kind(self.before_previous), kind(self.previous)) {
            (_, Some(TokenKind::Number)) => true,
            (Some(TokenKind::Number), Some(TokenKind::Word)) => true,
            (_, _) => false,
        }
    }

    fn deeper(&mut self, by: usize) {
        if let Some((_, depth)) = &mut self.too_deep {
            *depth = depth.saturating_add(by);
        }
    }

    /// Kinds of brackets are not compared down there: one message about the place is enough.
    fn shallower(&mut self, token: Token) {
        let Some((start, depth)) = self.too_deep else {
            return;
        };
        if depth > 1 {
            self.too_deep = Some((start, depth - 1));
            return;
        }
        self.too_deep = None;
        self.blank(start..token.end);
        self.doubtful.push(start..token.end);
    }

    fn closed(&mut self, bracket: Bracket, token: Token) {
        while let Some(&(kind, opener)) = self.open.last() {
            let fits = kind == bracket && !self.closes_further_out(bracket, opener, token);
            if fits {
                self.open.pop();
                if self.open.is_empty() {
                    self.last_end = token.end;
                }
                return;
            }
            if !self.open.iter().any(|&(kind, _)| kind == bracket) {
                break;
            }
            self.open.pop();
            self.unclosed(kind, opener, Some(token));
        }
        self.unopened(bracket, token);
    }

    /// Whether the indentation says that this bracket closes one further out than `opener`.
    fn closes_further_out(&self, bracket: Bracket, opener: Token, token: Token) -> bool {
        self.trust == Trust::Indentation
            && token.leads
            && token.line > opener.line
            && token.indent < opener.indent
            && self
                .open
                .iter()
                .rev()
                .skip(1)
                .any(|&(kind, outer)| kind == bracket && outer.indent == token.indent)
    }

    /// Closes what the indentation of a line's first token says should be closed before it.
    fn believe_indentation(&mut self, token: Token) {
        if self.trust == Trust::Brackets || !token.leads || token.kind != TokenKind::Word {
            return;
        }
        while let Some(&(kind, opener)) = self.open.last() {
            if token.line == opener.line || token.indent > opener.indent {
                return;
            }
            self.open.pop();
            self.unclosed(kind, opener, Some(token));
        }
    }

    /// Reports an opening bracket that nothing closes before `missed` (or the end of the file), and corrects the copy.
    fn unclosed(&mut self, bracket: Bracket, opener: Token, missed: Option<Token>) {
        self.is_matched = false;
        let (opening, closing) = (bracket.opening(), bracket.closing());
        let end = self.previous.map_or(opener.end, |token| token.end);
        let report = Diagnostic::new(
            Code::UnclosedBracket,
            format!("this `{opening}` is never closed"),
            self.span(opener.start..opener.end),
            "opened here",
        );
        let report = match missed {
            Some(_) => report.and(self.span(end..end), format!("expected `{closing}` here")),
            None => report.and(self.span(end..end), "the file ends here"),
        };
        let insertion = match bracket {
            Bracket::Round => closing.to_string(),
            Bracket::Curly if self.is_one_line(opener, end) => format!(" {closing}"),
            Bracket::Curly => format!("\n{}{closing}", " ".repeat(opener.indent)),
        };
        self.reports.push(report.fix(
            format!("close it with `{closing}`"),
            self.span(end..end),
            insertion,
        ));
        if bracket == Bracket::Round {
            // The value may lack more than its bracket, and the bracket put in is not the user's.
            self.doubtful.push(opener.start..end.max(opener.end));
        }
        let is_mended = match missed {
            Some(missed) => self.place(closing, end..missed.start),
            None => {
                self.append(bracket);
                true
            }
        };
        if !is_mended {
            self.blank(opener.start..opener.end);
            self.doubtful
                .push(opener.start..missed.map_or(self.text.len(), |token| token.start));
        }
    }

    fn is_one_line(&self, opener: Token, end: usize) -> bool {
        !self
            .text
            .get(opener.start..end)
            .unwrap_or_default()
            .contains('\n')
    }

    /// Puts a closing bracket on the first free blank of `range`, if there is one before anything else.
    fn place(&mut self, closing: char, range: Range<usize>) -> bool {
        let Some(bytes) = self.mended.get_mut(range) else {
            return false;
        };
        for byte in bytes {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' => {
                    *byte = u8::try_from(closing).unwrap_or(b' ');
                    return true;
                }
                b')' | b'}' => {}
                _ => return false,
            }
        }
        false
    }

    /// Puts a closing bracket after everything, on a line of its own as the last one may end in a comment.
    fn append(&mut self, bracket: Bracket) {
        let line = match bracket {
            Bracket::Round => b"\n)",
            Bracket::Curly => b"\n}",
        };
        self.mended.extend_from_slice(line);
    }

    fn unopened(&mut self, bracket: Bracket, token: Token) {
        self.is_matched = false;
        let closing = bracket.closing();
        let report = Diagnostic::new(
            Code::UnopenedBracket,
            format!("this `{closing}` closes nothing"),
            self.span(token.start..token.end),
            format!("no `{}` is open here", bracket.opening()),
        );
        let report = match self.headless_line(bracket, token) {
            Some(line) => {
                let end = self.span(line.end..line.end);
                report
                    .and(self.span(line), "is a `{` missing at the end of this line?")
                    .fix("open the block with `{`", end, " {")
            }
            None => report.fix(
                format!("delete the `{closing}`"),
                self.span(token.start..token.end),
                "",
            ),
        };
        self.reports.push(report);
        self.blank(token.start..token.end);
        if bracket == Bracket::Curly && self.open.is_empty() {
            // What stood before it was meant to be in a block and makes no sense outside of one.
            self.doubtful.push(self.last_end..token.end);
            self.last_end = token.end;
        } else {
            self.doubtful.push(token.start..token.end);
        }
    }

    /// The line that a leading `}` seems to belong to: the nearest above it that is indented as far.
    fn headless_line(&self, bracket: Bracket, token: Token) -> Option<Range<usize>> {
        if bracket == Bracket::Round || !token.leads || !self.open.is_empty() {
            return None;
        }
        let region = self.text.get(self.last_end..token.start)?;
        let mut found: Option<Range<usize>> = None;
        for other in tokens(region) {
            // The region begins in the middle of a line, whose indentation is then not known.
            let is_comment = other.kind == TokenKind::Comment;
            if other.leads && other.line > 0 && other.indent <= token.indent && !is_comment {
                found = Some(other.start..other.end);
            } else if let Some(found) = &mut found
                && !is_comment
                && !region.get(found.end..other.start)?.contains('\n')
            {
                found.end = other.end;
            }
        }
        found.map(|line| self.last_end + line.start..self.last_end + line.end)
    }

    /// Inches, written as on a drawing. Without the mark the number would get another unit when it is
    /// completed.
    fn inch_mark(&mut self, token: Token) {
        let number = self
            .previous
            .filter(|previous| previous.kind == TokenKind::Number);
        let Some(number) = number else { return };
        let inches = self.slice(number);
        let span = self.span(number.start..token.end);
        let mut report = Diagnostic::new(
            Code::UnknownUnit,
            "`\"` is not a unit",
            span,
            "inches are written with `in`",
        );
        if let Ok(value) = inches.parse::<f64>() {
            let millimetres = format!("{} mm", in_mm(value));
            let title = format!("write `{millimetres}`, which is {inches} in");
            report = report.fix(title, span, millimetres);
        }
        self.reports.push(report);
        // What cannot be read is left alone from here on; a number without a unit would be complained about once more.
        if let Some(mark) = self.mended.get_mut(token.start) {
            *mark = b'?';
        }
        self.doubtful.push(number.start..token.end);
    }

    fn unclosed_text(&mut self, token: Token) {
        let end = token.end;
        self.reports.push(
            Diagnostic::new(
                Code::UnclosedText,
                "this text has no second `\"`",
                self.span(token.start..end),
                "a text ends on the line it begins on",
            )
            .fix("end it with `\"`", self.span(end..end), "\""),
        );
        // A quote after a backslash would not end the text.
        let is_free = !self.slice(token).ends_with('\\');
        match self.mended.get_mut(end) {
            Some(byte @ (b' ' | b'\t' | b'\r' | b'\n')) if is_free => *byte = b'"',
            _ => {
                self.blank(token.start..token.end);
                self.doubtful.push(token.start..token.end);
            }
        }
    }

    fn unclosed_comment(&mut self, token: Token) {
        self.reports.push(
            Diagnostic::new(
                Code::UnclosedBracket,
                "this comment is never closed",
                self.span(token.start..token.start + 2),
                "everything from here on is comment",
            )
            .help("end the comment with `*/`, or begin it with `//` if it is one line"),
        );
        self.blank(token.start..token.end);
    }

    /// Reports backslashes that escape nothing: most likely a path of Windows.
    fn escapes(&mut self, token: Token) {
        let body = self.slice(token);
        let mut strays = Vec::new();
        let mut characters = body.char_indices();
        while let Some((at, c)) = characters.next() {
            if c == '\\' && !matches!(characters.next(), Some((_, '"' | '\\'))) {
                let start = token.start + at;
                strays.push(self.span(start..start + 1));
            }
        }
        let Some(&first) = strays.first() else {
            return;
        };
        let mut report = Diagnostic::new(
            Code::UnexpectedText,
            "a backslash without a meaning",
            first,
            "in a text, a backslash comes before `\"` or another backslash",
        )
        .help("for a backslash itself, write two");
        let edit = |span| Edit {
            span,
            replacement: "/".to_owned(),
        };
        report.fixes.push(Fix {
            title: "between the folders of a path, write `/`".to_owned(),
            edits: strays.into_iter().map(edit).collect(),
        });
        self.reports.push(report);
    }

    fn end(&mut self) {
        if let Some((start, _)) = self.too_deep {
            // One message about the place is enough; whatever is open there is closed without a word.
            self.blank(start..self.text.len());
            self.doubtful.push(start..self.text.len());
            while let Some((bracket, _)) = self.open.pop() {
                self.append(bracket);
            }
        }
        while let Some((bracket, opener)) = self.open.pop() {
            self.unclosed(bracket, opener, None);
        }
    }

    fn finish(self) -> Balanced {
        // Whole characters were replaced by ASCII only, so this is UTF-8 still.
        let text = String::from_utf8(self.mended).unwrap_or_default();
        Balanced {
            text,
            reports: self.reports,
            doubtful: self.doubtful,
        }
    }
}

/// The byte order mark would be a token of its own.
fn scan_starts_with_mark(text: &str, token: Token) -> bool {
    token.start == 0 && text.starts_with('\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::TOKENS;
    use proptest::prelude::*;
    use vcutc_diagnostics::source::SourceMap;

    proptest! {
        /// What was balanced is balanced: the grammar relies on it for its speed.
        #[test]
        fn nothing_is_left_to_balance(tokens in prop::collection::vec(prop::sample::select(TOKENS), 0..80)) {
            let text = tokens.concat();
            let file = SourceMap::default().add("t", "");
            let balanced = balance(file, &text).text;
            let again = Scan::run(file, &balanced, Trust::Brackets);
            prop_assert!(again.is_matched, "{text:?} became {balanced:?}");
            let has_loose_end = tokens_of(&balanced).any(|kind| {
                matches!(kind, TokenKind::UnclosedText | TokenKind::UnclosedComment)
            });
            prop_assert!(!has_loose_end, "{text:?} became {balanced:?}");
            prop_assert!(balanced.len() >= text.len());
        }
    }

    #[test]
    fn what_is_taken_out_makes_no_new_inches_or_values() {
        for text in ["1)\"(job job \n", "1 } \"(\"\n", "((1(", "(1}("] {
            let file = SourceMap::default().add("t", "");
            let balanced = balance(file, text).text;
            assert!(
                Scan::run(file, &balanced, Trust::Brackets).is_matched,
                "{text:?} became {balanced:?}"
            );
            assert!(!tokens_of(&balanced).any(|kind| kind == TokenKind::InchMark));
        }
    }

    fn tokens_of(text: &str) -> impl Iterator<Item = TokenKind> {
        tokens(text).map(|token| token.kind)
    }
}
